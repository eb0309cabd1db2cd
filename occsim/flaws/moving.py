"""A sheet that is scaled and turned about its centre, and shifted, onto another."""

import math

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray

EDGE_EPS_PX = 1e-6
"""Far above rounding: a point on the edge of two pixels falls to the same one on every
machine."""


def moved_walls(
    walls: BoolArray,
    scale: float,
    rotation_rad: float,
    shift_px: tuple[float, float],
    shape: tuple[int, int] | None = None,
) -> BoolArray:
    """Return the walls scaled and turned about the sheet's centre, and shifted.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        The mask.
    scale, rotation_rad : float
        Factor, and angle from +x towards +y.
    shift_px : tuple of float
        Along x and y, of the centre from that of the new sheet.
    shape : tuple of int, optional
        Height and width of the new sheet, px; by default those of the old one.

    Returns
    -------
    ndarray of bool, of that shape
        A pixel is wall if the centre of a wall pixel falls into it, or its own centre
        into a wall pixel.
    """
    a, b = scale * math.cos(rotation_rad), scale * math.sin(rotation_rad)
    shift = shift_px[::-1]
    height, width = shape or walls.shape
    if (a, b, *shift, height, width) == (1.0, 0.0, 0.0, 0.0, *walls.shape):
        return walls
    if not np.allclose((a, b), np.rint((a, b)), rtol=0.0, atol=EDGE_EPS_PX):
        walls = _bridged(walls)
    # How far a pixel whose centre lies in a wall pixel can be from the pixel into which
    # that one's own centre falls.
    margin = int(math.sqrt(0.5) * scale + 0.5 + EDGE_EPS_PX)
    sheet = slice(margin, margin + height), slice(margin, margin + width)
    moved = np.zeros((height + 2 * margin, width + 2 * margin), dtype=np.bool_)
    row, col = _points(walls)
    forth = b * col + a * row + shift[0], a * col - b * row + shift[1]
    at, _ = _pixels(forth, moved.shape, EDGE_EPS_PX)
    moved.ravel()[at] = True
    side = np.ones((2 * margin + 1,) * 2, dtype=np.uint8)
    near = cv2.dilate(moved.view(np.uint8), side).view(np.bool_) & ~moved
    moved, near = np.ascontiguousarray(moved[sheet]), np.ascontiguousarray(near[sheet])
    row, col = (v - d for v, d in zip(_points(near), shift, strict=True))
    area = a * a + b * b
    back = (a * row - b * col) / area, (a * col + b * row) / area
    at, inside = _pixels(back, walls.shape, -EDGE_EPS_PX)
    moved.ravel()[np.flatnonzero(near)[inside]] = walls.ravel()[at]
    return moved


def _points(flags: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Return the centres of the true pixels, px down and right of the sheet's."""
    height, width = flags.shape
    row, col = np.divmod(np.flatnonzero(flags), width)
    return row - 0.5 * (height - 1), col - 0.5 * (width - 1)


def _pixels(
    points: tuple[FloatArray, FloatArray], shape: tuple[int, ...], eps: float
) -> tuple[IntArray, BoolArray]:
    """Return the flat pixels that points fall into, and which points fall into one."""
    height, width = shape
    row = np.floor(points[0] + (0.5 * height + eps))
    col = np.floor(points[1] + (0.5 * width + eps))
    inside = (row >= 0) & (row < height) & (col >= 0) & (col < width)
    return (row[inside] * width + col[inside]).astype(np.int64), inside


def _bridged(walls: BoolArray) -> BoolArray:
    """Return the walls with pixels that touch at a corner joined by their sides."""
    bridged = walls.copy()
    for left, right in ((slice(-1), slice(1, None)), (slice(1, None), slice(-1))):
        top, bottom = walls[:-1], walls[1:]
        link = top[:, left] & bottom[:, right] & ~top[:, right] & ~bottom[:, left]
        bridged[1:][:, left] |= link
    return bridged

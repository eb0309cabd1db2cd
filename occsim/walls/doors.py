"""Doors: quarter circles among thin strokes, and the leaves at their ends."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.raster import Components, box, components, flipped, opened
from occsim.walls.strokes import DOOR, Measures, level_lines

STRAIGHT_SHARE = 0.03
"""Length from which a stroke is straight, share of the longer side: arcs bend before;
thin walls say little of doors."""

ON_ARC = 0.7
"""Share of a stroke's pixels that must lie on the circle."""

LEAF_SHARE = 0.12
"""Thickness of a leaf as drawn, as a share of its length; what is thicker is wall."""

LONGER = 1.3
"""Length from which a line is no leaf's, in usual leaves."""

LEAF_COVER = 0.8
"""Share of a leaf's length along which there must be ink."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Door:
    """A door leaf, standing open at one end of its swing.

    Parameters
    ----------
    x_px, y_px : float
        Hinge, pixel indices.
    radius_px : float
        Length of the leaf, px.
    open_rad, shut_rad : float
        Bearing of the leaf as drawn, and of the doorway that it closes.
    """

    x_px: float
    y_px: float
    radius_px: float
    open_rad: float
    shut_rad: float


def find_doors(
    ink: ByteArray, thin: ByteArray, m: Measures, fit: float
) -> tuple[Door, ...]:
    """Return the doors of an upright sheet, from the thin part of its ink.

    An arc may stray from a circle by the share `fit` of its radius; 0 finds none.
    """
    if fit == 0:
        return ()
    length = STRAIGHT_SHARE * max(ink.shape)
    straight = opened(thin, box(length, 1)) | opened(thin, box(1, length))
    parts = components(thin & ~straight)
    low, high = DOOR / 2 * m.wall, 4 * DOOR * m.wall
    likely = (parts.longest >= low / 3) & (parts.longest <= high)
    likely &= np.minimum(parts.width, parts.height) > 2 * m.line
    doors = (_door(ink, swing, m.line) for swing in _swings(parts, likely, fit, m.line))
    return tuple(door for door in doors if door and low <= door.radius_px <= high)


def _swings(
    parts: Components, likely: BoolArray, fit: float, line_px: int
) -> FloatArray:
    """Return the arcs among strokes, shape (K, 4): hinge x, y, radius, bearing.

    All strokes are fitted at once; there are hundreds in a sheet.
    """
    x, y, piece = _strokes(parts, likely)
    if not len(piece):
        return np.zeros((0, 4))
    kept = np.ones(len(x), dtype=bool)
    for _ in range(3):  # what hangs on an arc is left out round by round
        cx, cy, radius = _circles(x, y, piece, kept)
        stray = np.abs(np.hypot(x - cx[piece], y - cy[piece]) - radius[piece])
        least = np.maximum(fit * radius + line_px / 2, _quantile(stray, piece, 0.5))
        kept = stray <= least[piece]
    on_arc = stray <= (fit * radius + line_px / 2)[piece]
    share = _mean(on_arc, piece)
    x, y, piece = x[on_arc], y[on_arc], piece[on_arc]
    bearing = np.arctan2(y - cy[piece], x - cx[piece])
    sine, cosine = (_sum(f(bearing), piece, len(share)) for f in (np.sin, np.cos))
    middle = np.arctan2(sine, cosine)
    swings = np.stack([cx, cy, radius, middle], axis=1)
    return np.asarray(swings[share >= ON_ARC])


def _strokes(
    parts: Components, likely: BoolArray
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return x, y and stroke number of the pixels of likely strokes, in order."""
    width = parts.labels.shape[1]
    at = np.flatnonzero(likely[parts.labels])
    _, piece = np.unique(parts.labels.ravel()[at], return_inverse=True)
    order = np.argsort(piece, kind="stable")
    y, x = np.divmod(at[order].astype(np.float64), width)
    return x, y, piece[order]


def _sum(values: FloatArray, piece: IntArray, n: int) -> FloatArray:
    """Return the sum for each stroke."""
    return np.asarray(np.bincount(piece, values, n), np.float64)


def _mean(values: FloatArray | BoolArray, piece: IntArray) -> FloatArray:
    """Return the mean for each stroke."""
    return np.asarray(np.bincount(piece, values) / np.bincount(piece))


def _quantile(values: FloatArray, piece: IntArray, share: float) -> FloatArray:
    """Return for each stroke the value below which a share of its values lies."""
    ordered = values[np.lexsort((values, piece))]
    count = np.bincount(piece)
    at = np.cumsum(count) - count + (share * (count - 1)).astype(np.int64)
    return np.asarray(ordered[np.clip(at, 0, max(len(ordered) - 1, 0))])


def _circles(
    x: FloatArray, y: FloatArray, piece: IntArray, kept: BoolArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return centres and radii of the circles of least squares (Kasa's fit)."""
    x0, y0 = _mean(x, piece), _mean(y, piece)
    piece = piece[kept]
    x, y = x[kept] - x0[piece], y[kept] - y0[piece]
    columns = (2 * x, 2 * y, np.ones_like(x))
    n = len(x0)
    normal = np.array([[_sum(a * b, piece, n) for b in columns] for a in columns])
    right = np.array([_sum(a * (x * x + y * y), piece, n) for a in columns])
    normal += 1e-9 * np.trace(normal) * np.eye(3)[:, :, None]  # pixels in one line
    solved = np.linalg.solve(normal.transpose(2, 0, 1), right.T[:, :, None])
    cx, cy, c = solved[:, :, 0].T
    return cx + x0, cy + y0, np.sqrt(np.maximum(c + cx * cx + cy * cy, 0.0))


def _door(ink: ByteArray, swing: FloatArray, line_px: int) -> Door | None:
    """Return the door of a swing: its leaf stands at the end where there is ink."""
    x, y, radius, middle = swing.tolist()
    middle = np.round(middle / (np.pi / 2) - 0.5) * np.pi / 2 + np.pi / 4
    ends = middle - np.pi / 4, middle + np.pi / 4
    doors = [
        Door(x_px=x, y_px=y, radius_px=radius, open_rad=ends[i], shut_rad=ends[1 - i])
        for i in (0, 1)
    ]
    cover = [_cover(ink, door, line_px) for door in doors]
    best = int(np.argmax(cover))
    return doors[best] if cover[best] >= LEAF_COVER else None


def _cover(ink: ByteArray, door: Door, line_px: int) -> float:
    """Return the share of a leaf's length in which there is ink."""
    half = LEAF_SHARE * door.radius_px + line_px
    along = np.arange(0.2, 0.95, 1 / door.radius_px) * door.radius_px
    across = np.arange(-half, half + 0.5)
    cos, sin = np.cos(door.open_rad), np.sin(door.open_rad)
    cols = np.rint(door.x_px + along[:, None] * cos - across * sin).astype(np.int64)
    rows = np.rint(door.y_px + along[:, None] * sin + across * cos).astype(np.int64)
    inside = (rows >= 0) & (rows < ink.shape[0]) & (cols >= 0) & (cols < ink.shape[1])
    on_ink = ink[np.where(inside, rows, 0), np.where(inside, cols, 0)] > 0
    return float(np.mean((on_ink & inside).any(axis=1)))


def leaves(ink: ByteArray, doors: tuple[Door, ...], m: Measures) -> ByteArray:
    """Return the ink of door leaves; what is thicker than a leaf is left out."""
    mask = np.zeros_like(ink)
    for door in doors:
        half = LEAF_SHARE * door.radius_px + m.line
        _band(mask, door, door.open_rad, (0.04, 1.08), half)
    if not doors:
        return mask
    usual = float(np.median([door.radius_px for door in doors]))
    # A leaf that stands along a wall must not take the wall's face with it.
    longer = level_lines(ink, LONGER * usual)
    longer |= flipped(level_lines(flipped(ink), LONGER * usual))
    return mask & ink & ~longer


def doorways_of(shape: tuple[int, int], doors: tuple[Door, ...]) -> ByteArray:
    """Return where the leaves would stand if they were shut."""
    mask = np.zeros(shape, np.uint8)
    for door in doors:
        _band(mask, door, door.shut_rad, (0.1, 0.9), 2 * LEAF_SHARE * door.radius_px)
    return mask


def _band(
    mask: ByteArray,
    door: Door,
    bearing: float,
    reach: tuple[float, float],
    half_px: float,
) -> None:
    """Set the pixels of a band along a radius in a mask that the caller has made."""
    along = np.array([np.cos(bearing), np.sin(bearing)])
    across = half_px * np.array([-along[1], along[0]])
    near, far = (
        np.array([door.x_px, door.y_px]) + r * door.radius_px * along for r in reach
    )
    corners = np.array([near - across, far - across, far + across, near + across])
    cv2.fillConvexPoly(mask, np.rint(corners).astype(np.int32), 1)

"""Single pixels: the seen surface of walls, and the robot's own pixel."""

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.grid import Grid
from occsim.rays.outline import NO_FACE, Outline, lateral_slopes
from occsim.rays.ragged import ragged_ranges
from occsim.rays.reach import SeenFaces, View, first_pixel_is_wall
from occsim.rays.scan import CountArray, Windows
from occsim.sensor import EDGE_EPS, OWN_PIXEL_EPS_PX, SURFACE_DEPTH_PX


def count_surface(
    outline: Outline,
    faces: SeenFaces,
    occupied: BoolArray,
    windows: Windows,
    view: View,
) -> CountArray:
    """Return how many pixels of each cell are wall surface that is seen.

    These are the wall pixels whose centre lies at most SURFACE_DEPTH_PX beyond the hit
    on their own bearing: `BehindHit.UNSEEN`.

    Parameters
    ----------
    outline : Outline
        Pieces of bearing and their nearest faces.
    faces : SeenFaces
        Those faces.
    occupied : ndarray of bool, shape (H, W)
        Wall pixels.
    windows : Windows
        Cells to count in.
    view : View
        N readings.

    Returns
    -------
    ndarray of int32, shape (windows.size,)
    """
    pieces = np.flatnonzero(outline.face != NO_FACE)
    pieces = pieces[faces.depth[outline.face[pieces]] > 0.0]
    cut = faces.take(outline.face[pieces])
    slopes = lateral_slopes(outline, faces, pieces)
    found = [_wall_next_to_robot(occupied, view)]
    # Centres lie 0.5, 1.5, ... px behind their face: no others can be near enough.
    for behind in range(int(SURFACE_DEPTH_PX + 0.5)):
        found.append(_row_behind(behind, cut, slopes, view))
    reading, row, col = (np.concatenate(part) for part in zip(*found, strict=True))
    wall = _is_wall(occupied, row, col)
    counter = windows.pixel_counters(reading[wall], row[wall], col[wall])
    return windows.sums(counter, np.ones(counter.size, dtype=np.int32))


def _row_behind(
    behind: int, faces: SeenFaces, slopes: FloatArray, view: View
) -> tuple[IntArray, IntArray, IntArray]:
    """Return reading, row and column of pixels `behind` rows behind pieces of face.

    The pixels are those whose own bearing lies in the piece, near enough to the hit
    and within reach.
    """
    centre = faces.depth + (behind + 0.5)
    # On a bearing of tangent t the centre lies (behind + 0.5) sqrt(1 + t^2) px beyond.
    secant = (SURFACE_DEPTH_PX + EDGE_EPS) / (behind + 0.5)
    chord = np.sqrt(np.maximum(view.reach**2 - centre**2, 0.0))
    farthest = np.minimum(centre * np.sqrt(secant**2 - 1.0), chord)
    farthest = np.where(centre > view.reach, -1.0, farthest)
    low = np.maximum(slopes[0] * centre, -farthest)
    high = np.minimum(slopes[1] * centre, farthest)

    x, y = view.places.take(faces.reading, axis=1)
    horizontal = faces.side % 2 == 1
    along, across = np.where(horizontal, (y, x), (x, y))
    # Bearings ascend clockwise: with the axis when looking right or up, else against.
    with_axis = (faces.side == 0) | (faces.side == 3)
    first = np.where(
        with_axis, np.ceil(across + low - 0.5), np.floor(across - high - 0.5) + 1
    )
    stop = np.where(
        with_axis, np.ceil(across + high - 0.5), np.floor(across - low - 0.5) + 1
    )
    piece, index = ragged_ranges(first.astype(np.int64), stop.astype(np.int64))
    sign = np.where(faces.side < 2, 1.0, -1.0)
    line = np.floor(along + sign * centre).astype(np.int64)[piece]
    swap = horizontal[piece]
    row, col = np.where(swap, (line, index), (index, line))
    return faces.reading[piece], row, col


def _wall_next_to_robot(
    occupied: BoolArray, view: View
) -> tuple[IntArray, IntArray, IntArray]:
    """Return reading, row and column of pixels near robots that stand in wall.

    There the hit is at distance 0 on every bearing that leads straight into wall.
    """
    starts_in_wall = first_pixel_is_wall(occupied, view)
    reading = np.flatnonzero(starts_in_wall.any(axis=1))
    (x, y), theta = view.places[:, reading], view.theta[reading]
    span = np.arange(-2, 3)
    row, col = np.meshgrid(span, span, indexing="ij")
    row = np.floor(y).astype(np.int64)[:, None] + row.ravel()
    col = np.floor(x).astype(np.int64)[:, None] + col.ravel()
    dx, dy = col + 0.5 - x[:, None], row + 0.5 - y[:, None]
    distance = np.hypot(dx, dy)
    off = np.abs(wrap_angle(np.arctan2(dy, dx) - theta[:, None]))
    quadrant = np.where(dy > 0, np.where(dx > 0, 0, 1), np.where(dx > 0, 3, 2))
    kept = np.take_along_axis(starts_in_wall[reading], quadrant, axis=1)
    kept &= (distance > OWN_PIXEL_EPS_PX) & (off <= view.half)
    kept &= distance <= min(SURFACE_DEPTH_PX + EDGE_EPS, view.reach)
    owner, _ = np.nonzero(kept)
    return reading[owner], row[kept], col[kept]


def _is_wall(occupied: BoolArray, row: IntArray, col: IntArray) -> IntArray:
    """Return which of the pixels lie in the image and are wall."""
    height, width = occupied.shape
    inside = (row >= 0) & (col >= 0) & (row < height) & (col < width)
    which = np.flatnonzero(inside)
    return which[occupied[row[which], col[which]]]


def robots_on_centres(grid: Grid, view: View) -> tuple[IntArray, IntArray, IntArray]:
    """Return which robots stand on the centre of a pixel, and on which.

    Parameters
    ----------
    grid : Grid
        Gives the size of the image.
    view : View
        N readings; only robots in the image count.

    Returns
    -------
    reading, row, col : ndarray of int64, shape (Q,)
    """
    pixel = np.floor(view.places)
    reading = (np.hypot(*(view.places - pixel - 0.5)) <= OWN_PIXEL_EPS_PX).nonzero()[0]
    if reading.size:  # few robots stand on a centre
        x, y = pixel[:, reading]
        inside = (x >= 0) & (y >= 0) & (x < grid.width_px) & (y < grid.height_px)
        reading = reading[inside]
    col, row = pixel[:, reading].astype(np.int64)
    return reading, row, col

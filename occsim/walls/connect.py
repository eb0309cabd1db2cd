"""Walls hold together: groups joined through doorways, stray pieces dropped."""

import numpy as np

from occsim._types import BoolArray, ByteArray
from occsim.walls.raster import Components, box, closed, components, depth, opened

MAIN_SHARE = 0.25
"""Area of a piece, as a share of the largest one's, from which it spans a building."""

STRAY_SHARE = 0.12
"""Area of a group, as a share of the largest one's, from which it is kept."""

BRIDGE = 0.35, 1.5
"""Thickness of what joins two walls across a doorway, in walls."""

LINE_WALL_SHARE = 0.1
"""Shortest line that is a wall by itself, as a share of the shorter side."""


def connected_walls(walls: ByteArray, door_px: float, shortest_px: float) -> ByteArray:
    """Return the walls without stray pieces.

    Pieces belong together if they touch, or face each other end-on across a doorway.

    Parameters
    ----------
    walls : ndarray of uint8, shape (h, w)
        Walls and stray pieces.
    door_px : float
        Widest doorway, px.
    shortest_px : float
        Groups shorter than this are dropped, px.
    """
    if not walls.any():
        return walls
    thick_px = 2 * float(np.percentile(depth(walls)[walls > 0], 95))
    pieces = components(walls)
    kept = pieces.chosen(_in_building(pieces) & (pieces.area >= thick_px**2))
    groups = components(kept | _bridges(kept, door_px, thick_px))
    area = groups.total(kept)
    area[0] = 0.0
    large = area >= STRAY_SHARE * area.max()
    large &= np.hypot(groups.width, groups.height) >= shortest_px
    return kept & groups.chosen(large)


def _in_building(pieces: Components) -> BoolArray:
    """Which pieces reach into the box around the large ones; titles do not."""
    area = pieces.area.copy()
    area[0] = 0
    right, bottom = pieces.left + pieces.width, pieces.top + pieces.height
    main = area >= MAIN_SHARE * area.max()
    inside = (right > pieces.left[main].min()) & (pieces.left < right[main].max())
    inside &= bottom > pieces.top[main].min()
    return np.asarray(inside & (pieces.top < bottom[main].max()))


def _bridges(walls: ByteArray, door_px: float, thick_px: float) -> ByteArray:
    """Return the gaps between walls that face each other end-on."""
    low, high = BRIDGE[0] * thick_px, BRIDGE[1] * thick_px
    along = components(closed(walls, box(door_px, 1)) & ~walls)
    down = components(closed(walls, box(1, door_px)) & ~walls)
    return along.chosen((along.height >= low) & (along.height <= high)) | down.chosen(
        (down.width >= low) & (down.width <= high)
    )


def line_walls(lines: ByteArray, extent_px: float) -> ByteArray:
    """Return long straight lines: the walls of a drawing that has no thick ones."""
    length = LINE_WALL_SHARE * extent_px
    long = opened(lines, box(length, 1)) | opened(lines, box(1, length))
    groups = components(lines)
    # Oblique walls hang on upright ones.
    return lines & groups.chosen(groups.total(long) > 0)

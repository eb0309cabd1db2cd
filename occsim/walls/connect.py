"""Walls hold together: groups joined through doorways, stray pieces dropped."""

import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.walls.doors import Doors
from occsim.walls.raster import (
    Components,
    box,
    closed,
    components,
    depth,
    dilated,
    opened,
)

MAIN_SHARE = 0.25
"""Area of a piece, as a share of the largest one's, from which it spans a building."""

STRAY_SHARE = 0.15
"""Area of a group, as a share of the largest one's, from which it is kept."""

BRIDGE = 0.35, 1.5
"""Thickness of what joins two walls across a doorway, in walls."""

SHORTEST_HOLLOW = 3.0
"""Length over thickness of the shortest piece of hollow wall that stands alone."""

LONG_PIECE = 0.6
"""Length, in widest doorways, from which a hollow piece is a wall without a door."""

NARROWEST = 0.25
"""Narrowest doorway, as a share of the widest; furniture stands closer to walls."""

CRACK = 0.6
"""Longest crack in a wall, in walls: what blur or a crossing line has eaten."""

OUTLINE_SHARE = 0.5
"""Reach of a building of single lines, as a share of that of all lines."""

LINE_WALL_SHARE = 0.1
"""Shortest line that is a wall by itself, as a share of the shorter side."""


def connected_walls(
    walls: ByteArray, mass: ByteArray, doors: Doors, shortest_px: float
) -> ByteArray:
    """Return the walls without stray pieces.

    Pieces belong together if they touch, or face each other end-on across a doorway.

    Parameters
    ----------
    walls : ndarray of uint8, shape (h, w)
        Walls and stray pieces.
    mass : ndarray of uint8, shape (h, w)
        Where they are solid; short solid pieces are columns, short hollow ones chairs.
    doors : Doors
        Doors found, and the widest doorway.
    shortest_px : float
        Groups shorter than this are dropped, px.
    """
    if not walls.any():
        return walls
    deep = depth(walls)
    thick_px = 2 * float(np.percentile(deep[walls > 0], 95))
    pieces = components(walls)
    kept, sure = _pieces(pieces, deep, mass, doors)
    groups = components(kept | _bridges(kept, kept & ~sure, doors, thick_px))
    area = groups.total(kept)
    area[0] = 0.0
    large = area >= STRAY_SHARE * area.max()
    large &= np.hypot(groups.width, groups.height) >= shortest_px
    return kept & groups.chosen(large)


def _pieces(
    pieces: Components, deep: FloatArray, mass: ByteArray, doors: Doors
) -> tuple[ByteArray, ByteArray]:
    """Return the pieces in the building, and those that need no door to be walls."""
    width = np.maximum(4 * pieces.total(deep) / pieces.area - 2, 1.0)
    solid = pieces.total(mass) >= pieces.area / 2
    slender = pieces.area >= SHORTEST_HOLLOW * width**2
    inside = _in_building(pieces)
    long = pieces.longest >= LONG_PIECE * doors.reach_px
    return pieces.chosen(inside & (solid | slender)), pieces.chosen(
        inside & (solid | long)
    )


def _in_building(pieces: Components) -> BoolArray:
    """Which pieces reach into the box around the large ones; titles do not."""
    area = pieces.area.copy()
    area[0] = 0
    right, bottom = pieces.left + pieces.width, pieces.top + pieces.height
    main = area >= MAIN_SHARE * area.max()
    inside = (right > pieces.left[main].min()) & (pieces.left < right[main].max())
    inside &= bottom > pieces.top[main].min()
    return np.asarray(inside & (pieces.top < bottom[main].max()))


def _bridges(
    walls: ByteArray, unsure: ByteArray, doors: Doors, thick_px: float
) -> ByteArray:
    """Return the doorways between walls that face each other end-on.

    What is not sure to be a wall needs a door to be joined to one.
    """
    along = components(closed(walls, box(doors.reach_px, 1)) & ~walls)
    down = components(closed(walls, box(1, doors.reach_px)) & ~walls)
    near_unsure = dilated(unsure, box(3))
    found = np.zeros_like(walls)
    for parts, across, length in (
        (along, along.height, along.width),
        (down, down.width, down.height),
    ):
        like_wall = (across >= BRIDGE[0] * thick_px) & (across <= BRIDGE[1] * thick_px)
        doorway = length >= NARROWEST * doors.reach_px
        doorway |= length <= CRACK * thick_px
        safe = (parts.total(near_unsure) == 0) | (parts.total(doors.openings) > 0)
        found |= parts.chosen(like_wall & doorway & safe)
    return found


def line_walls(lines: ByteArray, doors: Doors, extent_px: float) -> ByteArray:
    """Return networks of long lines: the walls of a drawing that has no thick ones.

    Parameters
    ----------
    lines : ndarray of uint8, shape (h, w)
        Ink without text and door leaves.
    doors : Doors
        Doors found; their swings are no walls.
    extent_px : float
        Shorter side of the drawing, px.
    """
    strokes = lines & ~doors.swings
    length = LINE_WALL_SHARE * extent_px
    long = opened(strokes, box(length, 1)) | opened(strokes, box(1, length))
    groups = components(strokes)
    if groups.count == 1:
        return strokes
    right, bottom = groups.left + groups.width, groups.top + groups.height
    whole = max(
        right[1:].max() - groups.left[1:].min(), bottom[1:].max() - groups.top[1:].min()
    )
    if groups.longest.max() < OUTLINE_SHARE * whole:
        return np.zeros_like(strokes)  # furniture does not reach far
    far = groups.longest >= OUTLINE_SHARE / 2 * whole
    # Oblique walls hang on upright ones.
    return groups.chosen(far & (groups.total(long) > 0))

"""Which pieces belong to a building: those that hang together, also across doorways."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from occsim._types import ByteArray, IntArray
from occsim.walls.raster import box, components, dilated, filled, flipped
from occsim.walls.strokes import DOOR, PART, Measures, column_runs

FRAME_MARGIN = 0.06
"""Farthest that a sheet's frame is from its borders, share of the longer side."""

CLEAR = 0.02
"""Width of the paper inside a frame, where the other face of a wall would be, share of
the sheet's longer side."""

ROOMS = 0.05
"""Least room of a plan in its frame that is closed on all sides, of its own."""

FULL = 0.9
"""Share of the box around it that a column fills, and a letter does not."""


def without_strays(walls: ByteArray, solid: ByteArray, m: Measures) -> ByteArray:
    """Drop hollow pieces that belong to no building: carpets, rulers, pairs of lines.

    Solid pieces stay where walls are solid, whatever they are: nothing that is plainly
    a wall may go. Where walls are hollow, what is solid is a column or a blot.
    """
    opening, _ = doorways(walls, m)
    groups = components(dilated(walls, box(3)) | opening)
    inked = groups.total(solid)
    shorter = np.minimum(groups.width, groups.height)
    kept = inked >= PART * np.maximum(groups.total(walls), 1.0)
    if not m.thick:
        full = inked >= FULL * groups.width * groups.height
        kept &= full
    kept |= (groups.longest > 2 * DOOR * m.wall) & (shorter > 2 * m.wall)
    return walls & groups.chosen(kept)


def frame_of(ink: ByteArray) -> ByteArray:
    """Return the frame of a sheet: a plain closed rectangle along all of its borders.

    A house has doors and partitions; what has neither, and stands around more ink than
    it is itself or around closed rooms, is drawn around the plan.
    """
    groups = components(ink)
    k = int(np.argmax(groups.width * groups.height))
    left, top, width, height = (
        int(side[k]) for side in (groups.left, groups.top, groups.width, groups.height)
    )
    rows, cols = ink.shape
    none = np.zeros_like(ink)
    margin = max(left, top, cols - left - width, rows - top - height)
    if not groups.area[k] or margin > FRAME_MARGIN * max(ink.shape):
        return none
    frame = groups.labels[top : top + height, left : left + width] == k
    px = -(-int(groups.area[k]) // (width + height))  # twice as thick as it is drawn
    inside = slice(px, -px)
    sides = frame[:px], frame[-px:], frame[:, :px].T, frame[:, -px:].T
    is_plain = not frame[inside, inside].any()
    if not is_plain or not all(side.any(axis=0).all() for side in sides):
        return none
    plan = np.ascontiguousarray(ink[top : top + height, left : left + width])
    plan = np.ascontiguousarray(plan[inside, inside])
    clear = max(round(CLEAR * max(ink.shape)), 1)
    beside = plan[:clear], plan[-clear:], plan[:, :clear].T, plan[:, -clear:].T
    faced = [side.any(axis=0) for side in beside]
    if np.concatenate(faced).mean() > PART:
        return none
    paper = components(plan ^ np.uint8(1), connectivity=4)
    rooms = paper.area.sum() - paper.area.max()
    if 2 * groups.area[k] > ink.sum() and rooms < ROOMS * frame.size:
        return none
    return np.asarray(groups.labels == k, dtype=np.uint8)


def without_short(walls: ByteArray, shortest_px: float) -> ByteArray:
    """Drop groups of connected walls that are shorter than a length, px."""
    groups = components(walls)
    return groups.chosen(groups.longest >= shortest_px)


def doorways(walls: ByteArray, m: Measures) -> tuple[ByteArray, list[float]]:
    """Return the openings between walls that face each other, and widths, px."""
    level, some = _facing(flipped(walls), m)
    upright, others = _facing(walls, m)
    return flipped(level) | upright, some + others


def _facing(walls: ByteArray, m: Measures) -> tuple[ByteArray, list[float]]:
    """Return the openings down columns that begin at the end of a wall."""
    runs = column_runs(walls)
    gap = np.flatnonzero((runs.value == 0) & (runs.length <= 2 * DOOR * m.wall))
    gap = gap[(gap > 0) & (gap < len(runs.value) - 1)]
    gap = gap[(runs.value[gap - 1] == 1) & (runs.value[gap + 1] == 1)]
    column, top = runs.column[gap], runs.start[gap]
    bottom = top + runs.length[gap]
    mask = np.zeros_like(walls)
    widths: list[float] = []
    for edge in (top, bottom - 1):
        part, side, depth = _ends(column, edge, len(walls))
        like_wall = (np.abs(side - m.wall) <= m.wall / 2) & (depth <= m.wall)
        these = like_wall[part] & (bottom - top >= DOOR / 2 * m.wall)
        mask |= filled(walls.shape, top[these], bottom[these], column[these])
        _, first = np.unique(part[these], return_index=True)
        widths += (bottom - top)[these][first].tolist()
    return mask, widths


def _ends(
    column: IntArray, row: IntArray, height: int
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the wall's end that each pixel is part of, and their widths and depths.

    Pixels, ordered down columns, are of one end where they touch: far quicker on
    some hundred pixels than components of the whole sheet.
    """
    place = column * height + row
    pairs = []
    for step in (height - 1, height, height + 1):
        other = np.searchsorted(place, place + step)
        near = np.flatnonzero(np.append(place, -1)[other] == place + step)
        pairs.append(np.stack([near, other[near]]))
    one, other = np.concatenate(pairs, axis=1)
    n = len(place)
    _, part = connected_components(coo_array((np.ones(len(one)), (one, other)), (n, n)))
    order = np.argsort(part, kind="stable")
    start = np.flatnonzero(np.diff(part[order], prepend=-1))
    if not n:
        return part, part, part
    width, depth = (
        np.maximum.reduceat(along[order], start)
        - np.minimum.reduceat(along[order], start)
        + 1
        for along in (column, row)
    )
    return part, width, depth

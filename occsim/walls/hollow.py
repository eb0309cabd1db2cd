"""Hollow and hatched walls, and windows: long lines beside each other.

Hatching, text and curved lines are no long lines along rows or columns, so that a
hatched wall is a hollow one. A wall at another angle is found on a turned sheet.
"""

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.raster import (
    Components,
    as_bytes,
    box,
    closed,
    components,
    dilated,
    filled,
    flipped,
)
from occsim.walls.sheet import turned_by
from occsim.walls.strokes import (
    DOOR,
    PART,
    ROOM,
    Measures,
    Runs,
    column_runs,
    level_lines,
)

SEED_LENGTH = 6.0
"""Length, in usual walls, from which a strip with room on both sides is a wall."""

PANES = 2
"""Lines between the faces of a window; fewer are sills, doors or furniture."""


@dataclass(frozen=True, eq=False)
class Strips:
    """Strips between two lines, as far as they may be part of a wall.

    Parameters
    ----------
    parts : Components
        Each of them.
    upright : bool
        Whether they run down columns.
    sure, likely : ndarray of float64, shape (N,)
        Share of each strip with room on both sides, and on one side at least.
    """

    parts: Components
    upright: bool
    sure: FloatArray
    likely: FloatArray

    @cached_property
    def slices(self) -> tuple[IntArray, IntArray, IntArray]:
        """Pixels of all strips, the slice each lies in, and the strip of each slice.

        A slice is what a strip has of a column, or of a row where it runs down.
        """
        at = np.flatnonzero(self.parts.labels)
        height, width = self.parts.labels.shape
        along = at // width if self.upright else at % width
        side = max(height, width)
        slices = self.parts.labels.ravel()[at].astype(np.int64) * side + along
        unique, number = np.unique(slices, return_inverse=True)
        return at, number, unique // side

    def touched(self, near: ByteArray) -> IntArray:
        """Return along how much of its length each strip has pixels of a mask, px."""
        at, number, strip = self.slices
        hit = np.zeros(len(strip), dtype=bool)
        hit[number[near.ravel()[at] > 0]] = True
        return np.bincount(strip[hit], minlength=len(self.length))

    @property
    def length(self) -> IntArray:
        """Length of each strip along its lines, px."""
        return self.parts.height if self.upright else self.parts.width

    @property
    def width(self) -> FloatArray:
        """Mean width of each strip, px."""
        return np.asarray(self.parts.area / np.maximum(self.length, 1))


def hollow_walls(ink: ByteArray, solid: ByteArray, m: Measures) -> ByteArray:
    """Return the hollow and hatched walls, and the windows, with their faces.

    They lie along rows and columns of an upright sheet, and may hang on solid walls.
    """
    every = [_strips(ink, m, False), _strips(flipped(ink), m, True)]
    found = [s.parts.chosen(_seeds(s, m)) for s in every]
    walls = _with_ends(found, ink, m)
    for _ in range(3):  # walls that hang on walls that hang on seeds
        sure, firm = walls | solid, [one | solid for one in found]
        more = [s.parts.chosen(_joined(s, sure, firm, m)) for s in every]
        if not any(one.any() for one in more):
            break
        found = [a | b for a, b in zip(found, more, strict=True)]
        walls = _with_ends(found, ink, m)
    return walls | (dilated(walls, box(2 * m.line + 3)) & ink)


def oblique_walls(
    ink: ByteArray, solid: ByteArray, direction_rad: float, m: Measures
) -> ByteArray:
    """Return the hollow walls along another direction, and across it."""
    turned, turn = turned_by(ink * np.uint8(255), direction_rad)
    solid, _ = turned_by(solid * np.uint8(255), direction_rad)
    walls = hollow_walls(as_bytes(turned > 127), as_bytes(solid > 127), m)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    back = cv2.warpAffine(walls * np.uint8(255), turn, ink.shape[::-1], flags=flags)
    return as_bytes(np.asarray(back) > 127)


def _seeds(s: Strips, m: Measures) -> BoolArray:
    """Which strips are walls by themselves."""
    return (s.sure >= PART) & _long(s, m) & ~_rare(s, m)


def _long(s: Strips, m: Measures) -> BoolArray:
    return np.asarray(s.length >= SEED_LENGTH * m.wall)


def _rare(s: Strips, m: Measures) -> BoolArray:
    return _one_of(s.width, m.rare) & ~_one_of(s.width, m.gaps)


def _joined(
    s: Strips, walls: ByteArray, found: list[ByteArray], m: Measures
) -> BoolArray:
    """Return which strips touch walls at their ends, but do not lie along one.

    Strips may open into the corner or junction that walls were let go on to, and go on
    from a wall in line with them; across a line they may only touch what is surely
    wall.
    """
    line, ahead = 4 * m.line + 1, 2 * DOOR * m.wall
    joined = (s.likely >= PART) & (s.length >= m.wall)
    joined &= ~_rare(s, m) | _long(s, m)
    joined &= s.touched(_grown(walls, s, across=line)) <= PART * s.length
    in_line, crossing = found[s.upright], found[not s.upright]
    near = dilated(walls, box(3)) | _grown(in_line, s, along=ahead)
    near |= _grown(crossing, s, along=line)
    reached = s.touched(near) > 0
    # What stands in the corner of a room may hide where a long wall meets another.
    corner = _grown(crossing, s, along=DOOR * m.wall, across=line)
    return joined & (reached | (_long(s, m) & (s.touched(corner) > 0)))


def _grown(
    mask: ByteArray, s: Strips, *, along: float = 1, across: float = 1
) -> ByteArray:
    """Return a mask grown along strips and across them, full widths in px."""
    return dilated(mask, box(across, along) if s.upright else box(along, across))


def _strips(view: ByteArray, m: Measures, upright: bool) -> Strips:
    """Return the strips along the rows of a view of the sheet, in the sheet's frame."""
    runs = column_runs(level_lines(view, max(1.2 * m.wall, 10.0)))
    between = ((0, 1, PANES) if not m.thick else (0, PANES)) if m.gaps else (PANES,)
    masks = [np.zeros_like(view) for _ in range(3)]
    for lines in between:
        top, bottom, column, rooms = _pairs(runs, m, lines)
        for least in (0, 1, 2):
            # What holds lines and has no room beside it is a stair or a shelf.
            fits = rooms >= max(least, min(lines, 1))
            masks[least] |= filled(view.shape, top[fits], bottom[fits], column[fits])
    if not m.thick:
        for holes in (0, 1, 2):
            thick = filled(view.shape, *_run_together(runs, m, holes))
            masks = [mask | thick for mask in masks]
    masks[0] = closed(masks[0], box(2 * m.line + 1, 1))
    if upright:
        masks = [flipped(mask) for mask in masks]
    parts = components(masks[0], 4)
    likely, sure = (parts.total(mask) / np.maximum(parts.area, 1) for mask in masks[1:])
    return Strips(parts, upright, sure, likely)


def _pairs(
    runs: Runs, m: Measures, lines_between: int
) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Return the pairs of lines at a usual distance: rows, column, and sides with room.

    The rows are the first between the lines and the one after the last; a side has
    room where there is more of it beyond the lines than between them.
    """
    step = 2 * (lines_between + 1)
    first = np.flatnonzero(runs.value[1 : -step - 1] == 1) + 1
    last = first + step
    whole = (runs.column[first] == runs.column[last]) & (runs.value[last] == 1)
    thin = runs.length <= 3 * m.line
    # Furniture that stands against a wall hides one of its faces, not both.
    whole &= thin[first] | thin[last]
    for line in range(2, step, 2):
        whole &= runs.length[first + line] <= 2 * m.line
    first, last = first[whole], last[whole]
    top = runs.start[first] + runs.length[first]
    bottom = runs.start[last]
    fits = _one_of(bottom - top, m.gaps + m.rare)
    if lines_between:
        thick = bottom - top + runs.length[first] + runs.length[last]
        fits |= _one_of(thick, m.thick)
    first, last, top, bottom = first[fits], last[fits], top[fits], bottom[fits]
    widest = np.max([runs.length[first + gap] for gap in range(1, step, 2)], axis=0)
    rooms = np.zeros(len(first), dtype=np.int64)
    for beyond in (first - 1, last + 1):
        rooms += runs.length[beyond] >= ROOM * widest + m.line
    return top, bottom, runs.column[first], rooms


def _run_together(
    runs: Runs, m: Measures, holes: int
) -> tuple[IntArray, IntArray, IntArray]:
    """Return where ink with small holes is as thick as a wall, with room on both sides.

    Small drawings have such walls, and those with an axis or a fill between the faces.
    """
    first = np.flatnonzero(runs.value[1 : -2 * holes - 1] == 1) + 1
    last = first + 2 * holes
    thick = runs.start[last] + runs.length[last] - runs.start[first]
    fits = _one_of(thick, (round(m.wall),)) & (runs.value[last] == 1)
    fits &= runs.column[first] == runs.column[last]
    for beyond in (first - 1, last + 1):
        fits &= runs.length[beyond] >= ROOM * thick
    for hole in range(1, 2 * holes, 2):
        fits &= runs.length[first + hole] <= m.line
    top = (runs.start[first] + m.line)[fits]
    bottom = np.maximum(top + 1, top + thick[fits] - 2 * m.line)
    return top, bottom, runs.column[first[fits]]


def _one_of(lengths: IntArray | FloatArray, usual: tuple[int, ...]) -> BoolArray:
    """Which lengths are a usual one, as drawn: to a tenth and a pixel."""
    found = np.zeros(len(lengths), dtype=bool)
    for px in usual:
        found |= np.abs(lengths - px) <= 1 + 0.1 * px
    return found


def _with_ends(found: list[ByteArray], ink: ByteArray, m: Measures) -> ByteArray:
    """Return strips, gone on to the next line across: corners and junctions."""
    level = closed(found[0], box(DOOR / 2 * m.wall, 1))
    upright = closed(found[1], box(1, DOOR / 2 * m.wall))
    level_ends = flipped(_ends(flipped(level), flipped(ink), m))
    return level | upright | level_ends | _ends(upright, ink, m)


def _ends(walls: ByteArray, ink: ByteArray, m: Measures) -> ByteArray:
    """Return the short runs of paper at the ends of walls that run down columns."""
    kind = np.where(walls > 0, 3, 1 - ink).astype(np.uint8)
    # Columns without a wall have no ends; most of the sheet is left out.
    used = np.flatnonzero(walls.any(axis=0))
    runs = column_runs(kind[:, used])
    rest = np.flatnonzero((runs.value == 1) & (runs.length <= DOOR / 2 * m.wall))
    rest = rest[(rest > 0) & (rest < len(runs.value) - 1)]
    rest = rest[(runs.value[rest - 1] == 3) | (runs.value[rest + 1] == 3)]
    top = runs.start[rest]
    return filled(walls.shape, top, top + runs.length[rest], used[runs.column[rest]])

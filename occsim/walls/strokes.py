"""How thick lines and walls are, and how far apart the faces of hollow walls."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import ByteArray, FloatArray, IntArray
from occsim.walls.raster import box, dilated, opened

THICKEST_PX = 60
"""Thickest stroke and widest gap that are told apart, px of the sheet."""

RISE = 1.7
"""How much more of a thicker stroke there must be, than of those between, for it to
be another kind of stroke: blur and oblique strokes fill the valley in part."""

COMMON_SHARE = 0.2
"""Share of the commonest thickness' length from which a thickness is common, too."""

THINNEST_WALL = 0.2, 0.6
"""Thickness of the thinnest walls that are told from lines, in usual walls."""

BLOT = 3.5
"""Thickness from which ink is more than two lines that touch, in lines."""

DOOR = 4.0
"""Length of a usual door leaf, in usual walls: 0.9 m and 0.2 m."""

PART = 0.3
"""Share from which a part tells what the whole is: of a group that is solid, of a strip
with room or a wall beside it, of hollow walls beside all lines or all walls, of a gap
beside the commonest one. More than that may be hidden by furniture."""

ROOM = 1.5
"""Least room beyond a hollow wall's faces, in its own gap: treads and tiles have 1."""

LONG_SHARE = 0.08
"""Length from which lines count as the faces of walls, share of the longer side."""

KINDS_SHARE = 0.77
"""Share of the two commonest gaps from which gaps are walls' and not chance."""

RARE_SHARE = 0.1
"""Share of all thick strokes, or of the commonest kind of gap, from which a kind is no
chance: walls if they are thick, and if narrow gaps those that other walls hold."""


@dataclass(frozen=True, kw_only=True)
class Measures:
    """Lengths of a drawing, px of the sheet.

    Parameters
    ----------
    line : int
        Thickness of most of its lines.
    solid : int
        Thinnest stroke that is a solid wall.
    wall : float
        Thickness of most of its walls, solid or hollow.
    gaps : tuple of int
        Usual gaps between the faces of hollow walls; none where it has no such walls.
    rare : tuple of int
        Gaps that are rare, so that only what hangs on other walls is one.
    thick : tuple of int
        Usual thicknesses of solid walls; none where it has no such walls.
    bare : bool
        Whether nothing is thinner than the walls.
    """

    line: int
    solid: int
    wall: float
    gaps: tuple[int, ...]
    rare: tuple[int, ...]
    thick: tuple[int, ...]
    bare: bool


def stroke_lengths(ink: ByteArray) -> FloatArray:
    """Return how long the strokes of each thickness are, shape (THICKEST_PX + 1,), px.

    A square of k pixels fits into a stroke of n at n - k + 1 places for each pixel of
    its length. Where the squares fit, counted for every k, falls in steps; the second
    difference is the length of the strokes of k pixels.
    """
    places = np.zeros(THICKEST_PX + 3)
    shrunk = ink
    for size in range(1, THICKEST_PX + 3):
        places[size] = np.count_nonzero(shrunk)
        if not places[size]:
            break
        shrunk = np.asarray(cv2.erode(shrunk, box(2), anchor=(0, 0)), np.uint8)
    lengths = places[:-2] - 2 * places[1:-1] + places[2:]
    lengths[0] = 0.0
    return np.maximum(lengths, 0.0)


def commonest_line(lengths: FloatArray) -> int:
    """Return the thickness of a drawing's lines: the first of its common strokes."""
    near = with_neighbours(lengths)
    first = int(np.argmax(near >= COMMON_SHARE * near.max()))
    while first + 1 < len(near) and near[first + 1] > near[first]:
        first += 1
    return max(first, 1)


def thinnest_solid(lengths: FloatArray, line: int, wall: float) -> int:
    """Return the least thickness of solid walls.

    Between the lines and the walls there is little of any thickness. Going up from
    the lines, the bottom of that valley is where strokes become walls.
    """
    low = start = max(line + 1, int(THINNEST_WALL[0] * wall))
    for px in range(start, round(THINNEST_WALL[1] * wall) + 1):
        if lengths[px] < lengths[low]:
            low = px
        elif lengths[px] > RISE * lengths[low]:
            return low + 1
    return low


@dataclass(frozen=True, eq=False)
class Runs:
    """Runs of equal pixels down the columns of a mask, in order.

    Parameters
    ----------
    column, start, length : ndarray of int64, shape (N,)
        Column, first row and length, px.
    value : ndarray of uint8, shape (N,)
        1 for ink, 0 for paper, 2 between two columns.
    """

    column: IntArray
    start: IntArray
    length: IntArray
    value: ByteArray


def column_runs(mask: ByteArray) -> Runs:
    """Return the runs down the columns of a mask of shape (H, W)."""
    height, width = mask.shape
    padded = np.full((width, height + 2), 2, dtype=np.uint8)
    padded[:, 1:-1] = mask.T
    flat = padded.ravel()
    change = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    first = change[:-1]
    column, row = np.divmod(first, height + 2)
    return Runs(column, row - 1, np.diff(change), flat[first])


def level_lines(ink: ByteArray, length_px: float) -> ByteArray:
    """Return the ink that belongs to long horizontal lines.

    Scanned lines step by a pixel now and then; that does not end them.
    """
    thicker = dilated(ink, box(1, 3))
    return opened(thicker, box(length_px, 1)) & ink


def gap_lengths(ink: ByteArray, length_px: float, line_px: int) -> FloatArray:
    """Return for how long two lines run beside each other at each distance, px.

    Only lines with more room beyond them than between them count, which treads, tiles
    and panes have not.
    """
    total = np.zeros(THICKEST_PX + 1)
    for view in (ink, np.ascontiguousarray(ink.T)):
        runs = column_runs(level_lines(view, length_px))
        gap = np.flatnonzero((runs.value == 0) & (runs.length <= THICKEST_PX))
        gap = gap[(gap > 1) & (gap < len(runs.length) - 2)]
        for side in (-1, 1):
            gap = gap[runs.value[gap + side] == 1]
            gap = gap[runs.length[gap + side] <= 3 * line_px]
            beyond = gap + 2 * side
            gap = gap[runs.length[beyond] >= ROOM * runs.length[gap] + line_px]
        total += np.bincount(runs.length[gap], minlength=THICKEST_PX + 1)
    return total


def with_neighbours(lengths: FloatArray) -> FloatArray:
    """Return the sum of each thickness and the next either way."""
    padded = np.pad(lengths, 1)
    return np.asarray(padded[:-2] + padded[1:-1] + padded[2:])


def kinds_share(lengths: FloatArray) -> float:
    """Return the share of the two commonest kinds: buildings have few, chance many."""
    near = with_neighbours(lengths)
    first = int(np.argmax(near))
    both = near[first]
    near[max(first - 2, 0) : first + 3] = 0.0
    return float((both + near.max()) / max(lengths.sum(), 1.0))


def usual(lengths: FloatArray, share: float) -> tuple[int, ...]:
    """Return the thicknesses that, with their neighbours, are common; most first."""
    near = with_neighbours(lengths)
    common = (near >= share * near.max()) & (lengths > near / 4)
    found = np.flatnonzero(common)
    return tuple(found[np.argsort(-lengths[found], kind="stable")].tolist())


def measure(ink: ByteArray) -> Measures:
    """Return the lengths of a drawing."""
    lengths = stroke_lengths(ink)
    line = commonest_line(lengths)
    area = lengths * np.arange(len(lengths))
    hollow = _likely_gaps(ink, line)
    between = hollow * (np.arange(len(hollow)) + 2 * line)
    thick = area.copy()
    thick[: 2 * line + 1] = 0.0
    least = between.sum()
    if thick.sum() >= RARE_SHARE * area.sum() and (
        not least or _long_solid(ink, line) >= least
    ):
        return _of_solid(lengths, thick, hollow, line)
    alike = area[round(0.8 * line) : round(1.2 * line) + 1].sum()
    if between.sum() >= PART * alike:
        wall = half_way(between) + 2 * line
        return _of(line, round(BLOT * line), wall, hollow)
    wall = half_way(area)
    return _of(line, max(round(wall / 2), 1), wall, bare=True)


def _long_solid(ink: ByteArray, line: int) -> int:
    """Return the area of long thick strokes, px: blots of text are short."""
    thick = opened(ink, box(2 * line + 1))
    length = LONG_SHARE / 2 * max(ink.shape)
    long = opened(thick, box(length, 1)) | opened(thick, box(1, length))
    return int(np.count_nonzero(long))


def _likely_gaps(ink: ByteArray, line: int) -> FloatArray:
    """Return the lengths of gaps, none where they are of too many kinds."""
    hollow = gap_lengths(ink, LONG_SHARE * max(ink.shape), line)
    hollow[:2] = 0.0
    return hollow if kinds_share(hollow) >= KINDS_SHARE else np.zeros_like(hollow)


def _of_solid(
    lengths: FloatArray, thick: FloatArray, hollow: FloatArray, line: int
) -> Measures:
    """Return the measures of a drawing of solid walls, some perhaps hollow."""
    wall = half_way(thick)
    solid = thinnest_solid(lengths, line, wall)
    both = with_neighbours(hollow).max() >= PART * lengths[solid:].sum()
    gaps = hollow if both else None
    return _of(line, solid, wall, gaps, thick=usual(thick, PART))


def _of(
    line: int,
    solid: int,
    wall: float,
    hollow: FloatArray | None = None,
    *,
    thick: tuple[int, ...] = (),
    bare: bool = False,
) -> Measures:
    """Return measures with the gaps of some lengths."""
    gaps = usual(hollow, PART) if hollow is not None else ()
    every = usual(hollow, RARE_SHARE) if hollow is not None else ()
    return Measures(
        line=line,
        solid=solid,
        wall=max(wall, 1.0),
        gaps=gaps,
        rare=tuple(gap for gap in every if gap not in gaps and gap < max(gaps)),
        thick=thick,
        bare=bare,
    )


def half_way(weights: FloatArray) -> float:
    """Return the index up to which half the weight lies."""
    return float(np.searchsorted(np.cumsum(weights), weights.sum() / 2))

"""Run lengths: how thick lines and walls are, and how wide the gaps between lines."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray

OUTSIDE = 2  # what lies above the first and below the last row

MAX_LINE_PX = 64
"""Thickest run that may be a line, px; keeps the histogram short."""

LINE_SHARE = 0.08
"""Share of all runs that the thinnest hill must hold to be the drawing's line."""

SAME_STRIP_GAP_PX = 3
"""Columns that a strip may miss, px: where a line ends on it."""


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
    padded = np.full((width, height + 2), OUTSIDE, dtype=np.uint8)
    padded[:, 1:-1] = mask.T
    flat = padded.ravel()
    change = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    first = change[:-1]
    column, row = np.divmod(first, height + 2)
    return Runs(column, row - 1, np.diff(change), flat[first])


def line_thickness(ink: ByteArray) -> int:
    """Return the thickness of the drawing's lines, px, at least 1.

    The thinnest hill in the histogram of run lengths, both ways, that holds a fair
    share of all runs.
    """
    counts = np.zeros(MAX_LINE_PX + 2)
    for mask in (ink, ink.T):
        runs = column_runs(mask)
        lengths = runs.length[(runs.value == 1) & (runs.length <= MAX_LINE_PX)]
        counts += np.bincount(lengths, minlength=MAX_LINE_PX + 2)
    before, here, after = counts[:-2], counts[1:-1], counts[2:]
    hill = (here >= before) & (here >= after)
    hill &= before + here + after >= LINE_SHARE * max(counts.sum(), 1.0)
    return int(np.argmax(hill)) + 1


def strip_votes(mask: ByteArray, value: int, max_px: int, line_px: int) -> FloatArray:
    """Return how much straight strips of each thickness there is.

    Strips are runs that begin on the same row, have the same length, and follow each
    other over many columns (and the same for rows). Long strips say more than many
    short ones, so that each adds the square of its length.

    Parameters
    ----------
    mask : ndarray of uint8, shape (H, W)
        Ink.
    value : int
        1 for strips of ink; 0 for strips of paper between two lines, with more room
        than the gap on either side (which treads and tiles do not have).
    max_px : int
        Thickest strip of interest, px.
    line_px : int
        Thickness of the drawing's lines, px.

    Returns
    -------
    ndarray of float64, shape (max_px + 1,)
        Sum of squared lengths for each thickness, px**2.
    """
    votes = np.zeros(max_px + 1)
    for view in (mask, mask.T):
        runs = column_runs(view)
        index = np.flatnonzero((runs.value == value) & (runs.length <= max_px))
        index = index[(index > 1) & (index < len(runs.length) - 2)]
        if value == 0:
            index = index[_between_lines(runs, index, line_px)]
        votes += _strip_lengths(runs, index, max_px)
    return votes


def _between_lines(runs: Runs, index: IntArray, line_px: int) -> BoolArray:
    """Which runs of paper lie between two thin lines with room beyond both."""
    gap = runs.length[index]
    flags = np.ones(len(index), dtype=bool)
    for side in (-1, 1):
        line, beyond = index + side, index + 2 * side
        flags &= (runs.value[line] == 1) & (runs.length[line] <= 3 * line_px)
        roomy = runs.length[beyond] >= 1.5 * gap + line_px
        flags &= roomy | (runs.value[beyond] != 0)
    return flags


def _strip_lengths(runs: Runs, index: IntArray, max_px: int) -> FloatArray:
    """Sum squared lengths of strips, by thickness, shape (max_px + 1,)."""
    if len(index) == 0:
        return np.zeros(max_px + 1)
    column, start, thick = runs.column[index], runs.start[index], runs.length[index]
    order = np.lexsort((column, thick, start))
    column, start, thick = column[order], start[order], thick[order]
    begins = np.ones(len(order), dtype=bool)
    begins[1:] = (np.diff(start) != 0) | (np.diff(thick) != 0)
    begins[1:] |= np.diff(column) > SAME_STRIP_GAP_PX
    length = np.bincount(np.cumsum(begins) - 1)
    thick = thick[begins]
    slender = length >= np.maximum(12, 3 * thick)
    squared = (length[slender] ** 2).astype(np.float64)
    votes = np.bincount(thick[slender], squared, max_px + 1)
    return np.asarray(votes, dtype=np.float64)

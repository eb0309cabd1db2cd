"""Run lengths: how thick lines and walls are, and how wide the gaps between lines."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.raster import Components

OUTSIDE = 2  # what lies above the first and below the last row

LINE_QUANTILE = 0.5
"""Share of the length of all thin strokes that is no thicker than `line_px`."""

SHORTEST_STRIP_PX = 12
"""Shortest chain of like runs that makes a strip, px."""


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


def run_lengths(mask: ByteArray) -> IntArray:
    """Return, for each pixel, the length of the column's run that it lies in, px."""
    height, width = mask.shape
    runs = column_runs(mask)
    # Each column is preceded by one pixel of outside (two at a seam, one run).
    flat = np.repeat(
        runs.length[runs.value != OUTSIDE], runs.length[runs.value != OUTSIDE]
    )
    return flat.reshape(width, height).T


def steadiness(mask: ByteArray, parts: Components, widest_px: float) -> FloatArray:
    """Return the share of each component's area that has one of its two usual widths.

    Two, because walls of two thicknesses meet. Wedges, letters and hangers have many.

    Parameters
    ----------
    mask : ndarray of uint8, shape (H, W)
        The components' pixels.
    parts : Components
        Components of the mask.
    widest_px : float
        Widths beyond this are all the same, px.

    Returns
    -------
    ndarray of float64, shape (N,)
    """
    rows, cols = np.nonzero(mask)
    across = np.minimum(
        run_lengths(mask)[rows, cols], run_lengths(mask.T).T[rows, cols]
    )
    bins = int(widest_px) + 4
    across = np.minimum(across, bins - 2)
    table = np.bincount(
        parts.labels[rows, cols] * bins + across, minlength=parts.count * bins
    ).reshape(-1, bins)
    total = 0.0
    for _ in range(2):
        # A width and its two neighbours: lines are a pixel thicker here and there.
        near = table.copy()
        near[:, 1:] += table[:, :-1]
        near[:, :-1] += table[:, 1:]
        best = near.argmax(axis=1)
        total = total + near[np.arange(len(near)), best]
        for offset in (-1, 0, 1):
            table[np.arange(len(table)), np.clip(best + offset, 0, bins - 1)] = 0
    return np.asarray(total / parts.area, dtype=np.float64)


def line_thickness(ink: ByteArray, thickest_px: float) -> int:
    """Return the thickness of most of the drawing's lines, px, at least 1.

    Parameters
    ----------
    ink : ndarray of uint8, shape (H, W)
        Ink.
    thickest_px : float
        Strokes thicker than this are no lines, px.
    """
    longest = int(thickest_px)
    lengths = np.zeros(longest + 1)
    for view in (ink, ink.T):
        runs = column_runs(view)
        index = np.flatnonzero((runs.value == 1) & (runs.length <= longest))
        thick, length = _strips(runs, index)
        lengths += np.bincount(thick, length, longest + 1)
    below = np.cumsum(lengths)
    return max(int(np.searchsorted(below, LINE_QUANTILE * below[-1])), 1)


def strip_votes(mask: ByteArray, value: int, max_px: int, line_px: int) -> FloatArray:
    """Return how much straight strips of each thickness there is.

    Strips are like runs that follow each other over many columns (and the same for
    rows). Long strips say more than many short ones, so that each adds the square of
    its length.

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
        thick, length = _strips(runs, index)
        votes += np.bincount(thick, length**2, max_px + 1)
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


def _strips(runs: Runs, index: IntArray) -> tuple[IntArray, FloatArray]:
    """Join like runs of neighbouring columns; thickness and length of the long chains.

    A run continues in the next column if start and length change by a pixel at most.

    Parameters
    ----------
    runs : Runs
        Runs of a mask.
    index : ndarray of int64, shape (K,)
        Those of interest, ascending.

    Returns
    -------
    thick : ndarray of int64, shape (M,)
    length : ndarray of float64, shape (M,)
    """
    if len(index) == 0:
        return np.zeros(0, np.int64), np.zeros(0)
    column, start, thick = runs.column[index], runs.start[index], runs.length[index]
    height = int(start.max()) + 3  # room for a shift by one either way
    place = column * height + start
    left, right = [], []
    for shift in (-1, 0, 1):
        wanted = place + height + shift
        at = np.minimum(np.searchsorted(place, wanted), len(place) - 1)
        like = (place[at] == wanted) & (np.abs(thick[at] - thick) <= 1)
        left.append(np.flatnonzero(like))
        right.append(at[like])
    first, second = np.concatenate(left), np.concatenate(right)
    links = coo_array((np.ones(len(first)), (first, second)), shape=(len(index),) * 2)
    _, chain = connected_components(links, directed=False)
    length = np.bincount(chain)
    mean = np.rint(np.bincount(chain, thick) / length).astype(np.int64)
    long = length >= np.maximum(SHORTEST_STRIP_PX, 3 * mean)
    return mean[long], length[long].astype(np.float64)

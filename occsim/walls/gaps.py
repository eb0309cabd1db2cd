"""Gaps between lines, and what they touch: the stuff that hollow walls are made of."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.raster import (
    Components,
    as_bytes,
    box,
    components,
    dilated,
    narrow_places,
)
from occsim.walls.runs import column_runs, steadiness

THICK_LINE = 2.5
"""Ink thicker than this many lines is taken for a mass, not for a line."""


@dataclass(frozen=True, eq=False)
class Gaps:
    """Narrow places between ink; number 0 is everything else.

    Parameters
    ----------
    parts : Components
        The narrow places.
    width, length : ndarray of float64, shape (N,)
        Mean width, and area over width, px.
    mass : ndarray of float64, shape (N,)
        Length of boundary against masses of ink, px.
    ajar : ndarray of float64, shape (N,)
        Length of boundary against open floor, without ink between, px.
    steady : ndarray of float64, shape (N,)
        Share of the area where the width does not change.
    beside : sparse array of float64, shape (N, N)
        Length of boundary shared across a line, px; symmetric.
    """

    parts: Components
    width: FloatArray
    length: FloatArray
    mass: FloatArray
    ajar: FloatArray
    steady: FloatArray
    beside: csr_array

    @property
    def slenderness(self) -> FloatArray:
        """Length over width."""
        return self.length / self.width

    @property
    def straightness(self) -> FloatArray:
        """Diagonal of the bounding box over the length: 1 for a straight strip."""
        return np.hypot(self.parts.width, self.parts.height) / self.length

    @property
    def boundary(self) -> FloatArray:
        """Length of all boundary, px."""
        across_lines = np.asarray(self.beside.sum(axis=1), dtype=np.float64).ravel()
        return np.asarray(self.mass + self.ajar + across_lines, dtype=np.float64)

    def neighbours(self, index: int) -> tuple[IntArray, FloatArray]:
        """Return the gaps beside one, and the boundary shared with each, px."""
        part = slice(self.beside.indptr[index], self.beside.indptr[index + 1])
        return self.beside.indices[part], self.beside.data[part]

    def shared(self, which: BoolArray) -> FloatArray:
        """Return the boundary that each gap shares with the chosen ones, px."""
        flags = which.astype(np.float64)
        flags[0] = 0.0
        return np.asarray(self.beside @ flags, dtype=np.float64)

    def stacks(self, which: BoolArray) -> IntArray:
        """Return the number of the stack that each gap is in, shape (N,).

        Two of the chosen gaps belong to one stack if they are of about one width and
        lie side by side, over two fifths of the length of the longer. Treads, ribs and
        tiles make tall stacks; a window's gaps make one of three.
        """
        pairs = self.beside.tocoo()
        first, second = pairs.coords
        longer = np.maximum(self.length[first], self.length[second])
        along = pairs.data >= 0.4 * longer
        wide, other = self.width[first], self.width[second]
        along &= np.abs(wide - other) <= 0.5 * np.maximum(wide, other) + 1
        along &= which[first] & which[second] & (first > 0) & (second > 0)
        links = coo_array(
            (np.ones(along.sum()), (first[along], second[along])), shape=pairs.shape
        )
        _, stack = connected_components(links, directed=False)
        return np.asarray(stack, dtype=np.int64)


def find_gaps(ink: ByteArray, widest_px: float, line_px: int) -> Gaps:
    """Return the places between ink that are at most so wide.

    Parameters
    ----------
    ink : ndarray of uint8, shape (h, w)
        Lines and masses.
    widest_px : float
        Widest gap, px.
    line_px : int
        Thickness of the drawing's lines, px.
    """
    narrow, depth_px = narrow_places(as_bytes(ink == 0), widest_px)
    parts = components(narrow, 4)
    # The mean depth of a strip of n pixels is (n + 2) / 4, near enough.
    width = np.maximum(4 * parts.total(depth_px) / parts.area - 2, 1.0)
    mass, beside = _contacts(ink, parts, THICK_LINE * line_px)
    floor = as_bytes(ink == 0) & ~narrow
    ajar = parts.total(dilated(floor, box(3)) & narrow)
    steady = steadiness(narrow, parts, widest_px)
    return Gaps(parts, width, parts.area / width, mass, ajar, steady, beside)


def _contacts(
    ink: ByteArray, parts: Components, line_px: float
) -> tuple[FloatArray, csr_array]:
    """Measure boundaries against masses, and between gaps across lines."""
    shape = (parts.count, parts.count)
    mass = np.zeros(parts.count)
    beside = csr_array(shape)
    for picture, labels in ((ink, parts.labels), (ink.T, parts.labels.T)):
        before, after, thick = _neighbours(picture, labels)
        heavy = thick > line_px
        for side in (before, after):
            mass += np.bincount(side[heavy], minlength=parts.count)
        first, second = before[~heavy], after[~heavy]
        link = coo_array((np.ones(len(first)), (first, second)), shape=shape)
        beside = beside + link.tocsr() + link.T.tocsr()
    return mass, beside.tocsr()


def _neighbours(
    ink: ByteArray, labels: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """For each run of ink in a column: gaps before and after it, and its length."""
    runs = column_runs(ink)
    inner = np.flatnonzero(runs.value[1:-1] == 1) + 1
    inner = inner[(runs.value[inner - 1] == 0) & (runs.value[inner + 1] == 0)]
    column, start, length = runs.column[inner], runs.start[inner], runs.length[inner]
    return labels[start - 1, column], labels[start + length, column], length

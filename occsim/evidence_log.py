"""Stored evidence: a log of all readings, or only the totals of each cell."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self, TypeVar

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, ShortRepr
from occsim.errors import ParameterError, expect, real_array, whole_number
from occsim.grid import Grid
from occsim.logodds import EXACT_BELOW_NATS, on_lattice

CellArray = npt.NDArray[np.int32]

_Whole = TypeVar("_Whole", np.int32, np.int64)


@dataclass(frozen=True, eq=False, repr=False)
class EvidenceTotals(ShortRepr):
    """The sum and the number of each cell's readings: all that a final map needs.

    Parameters
    ----------
    grid : Grid
        The cells.
    sums : ndarray of float64, shape (R, C)
        Summed log-odds S of the readings, nats; rounded to the lattice.
    counts : ndarray of int64, shape (R, C)
        Number k of readings.

    Raises
    ------
    TypeError, ParameterError
        Where the arrays are of another type or shape, sums are not finite, or counts
        are negative.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import EvidenceTotals, Grid, Prior, build_prior, fuse
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> totals = EvidenceTotals(grid, np.array([[2.0, 0.0]]), np.array([[1, 0]]))
    >>> blank = build_prior(np.zeros((1, 2), bool), grid, Prior.uninformative())
    >>> fuse(totals, blank).p_free.round(2)
    array([[0.88, 0.5 ]])
    """

    grid: Grid
    sums: FloatArray
    counts: IntArray

    def __post_init__(self) -> None:
        expect("grid", self.grid, Grid)
        sums = _log_odds_of("sums", self.sums)
        counts = _whole_numbers("counts", self.counts, np.int64)
        if not sums.shape == counts.shape == self.grid.shape:
            raise ParameterError(
                f"sums and counts must have the grid's shape {self.grid.shape}; "
                f"got {sums.shape} and {counts.shape}"
            )
        if counts.min() < 0:
            raise ParameterError(f"counts must not be negative; got {counts.min()}")
        _keep(self, grid=self.grid, sums=sums, counts=counts)

    def totals(self, n_readings: int | None = None) -> tuple[FloatArray, IntArray]:
        """Return `sums` and `counts`; `n_readings` must be None."""
        if n_readings is not None:
            raise ParameterError(
                f"totals are those of all readings; got n_readings={n_readings!r}"
            )
        return self.sums, self.counts


@dataclass(frozen=True, eq=False, repr=False)
class EvidenceLog(ShortRepr):
    """Per reading, the cells that it updated and their log-odds.

    Parameters
    ----------
    grid : Grid
        The cells.
    indptr : ndarray of int64, shape (S + 1,)
        Reading s owns the entries ``indptr[s]:indptr[s + 1]``.
    cell : ndarray of int32, shape (N,)
        Flat row-major cell of each entry; one entry per cell and reading.
    log_odds : ndarray of float64, shape (N,)
        ``logit(p_free(reading))`` of Eq. 4.22, nats; rounded to the lattice of
        `occsim.logodds`.

    Raises
    ------
    TypeError
        Where an array holds values of another type.
    ParameterError
        Where the arrays do not fit one another, a cell lies outside the grid or stands
        twice in a reading, or log-odds are not finite.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, logit
    >>> grid = Grid(height_px=1, width_px=3, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 2, 3], [0, 1, 1], logit([0.9, 0.1, 0.1]))
    >>> log.totals()[1]  # how often each cell was read
    array([[1, 2, 0]])
    """

    grid: Grid
    indptr: IntArray
    cell: CellArray
    log_odds: FloatArray

    def __post_init__(self) -> None:
        expect("grid", self.grid, Grid)
        indptr = _whole_numbers("indptr", self.indptr, np.int64)
        cell = _whole_numbers("cell", self.cell, np.int32)
        log_odds = _log_odds_of("log_odds", self.log_odds)
        _require_parts(indptr, cell, log_odds)
        _require_cells_once(indptr, cell, self.grid.n_cells)
        _keep(self, indptr=indptr, cell=cell, log_odds=log_odds)

    @classmethod
    def known_sound(
        cls, grid: Grid, indptr: IntArray, cell: CellArray, log_odds: FloatArray
    ) -> Self:
        """Return a log unchecked: checks would add a tenth to the computing time."""
        log = object.__new__(cls)
        _keep(log, grid=grid, indptr=indptr, cell=cell, log_odds=log_odds)
        return log

    @property
    def n_readings(self) -> int:
        """Number S of readings."""
        return self.indptr.size - 1

    @cached_property
    def reading(self) -> npt.NDArray[np.int32]:
        """Reading of each entry, ndarray of int32 of shape (N,)."""
        return np.repeat(
            np.arange(self.n_readings, dtype=np.int32), np.diff(self.indptr)
        )

    def totals(self, n_readings: int | None = None) -> tuple[FloatArray, IntArray]:
        """Return the sum and the number of each cell's readings.

        Parameters
        ----------
        n_readings : int, optional
            Only the first ones, 0 to S; all by default.

        Returns
        -------
        sums : ndarray of float64, shape (R, C)
            Summed log-odds S of the readings, nats; exact.
        counts : ndarray of int64, shape (R, C)
            Number k of readings.

        Raises
        ------
        ParameterError
            Where there are not that many readings.
        """
        most = self.n_readings
        n = most if n_readings is None else n_readings
        n = whole_number("n_readings", n, 0, most)
        return self._all_totals if n == most else self._sum_entries(self.indptr[n])

    @cached_property
    def _all_totals(self) -> tuple[FloatArray, IntArray]:
        # Every prior that is tried on this log needs the same two arrays.
        return self._sum_entries(self.cell.size)

    def _sum_entries(self, n_entries: int) -> tuple[FloatArray, IntArray]:
        cell, size = self.cell[:n_entries], self.grid.n_cells
        weights = self.log_odds[:n_entries]
        sums: FloatArray = np.bincount(cell, weights=weights, minlength=size).astype(
            np.float64, copy=False
        )
        counts = np.bincount(cell, minlength=size).astype(np.int64)
        for array in (sums, counts):
            array.setflags(write=False)
        return sums.reshape(self.grid.shape), counts.reshape(self.grid.shape)


Evidence = EvidenceLog | EvidenceTotals
"""Accepted where only totals are needed."""


def require_evidence(evidence: object) -> None:
    """Raise a `TypeError` for anything but a log or totals."""
    expect("evidence", evidence, EvidenceLog, EvidenceTotals)


def _keep(owner: object, **arrays: object) -> None:
    # Totals are cached, so the arrays that they were computed from must not change.
    for array in arrays.values():
        if isinstance(array, np.ndarray):
            array.setflags(write=False)
    vars(owner).update(arrays)


def _log_odds_of(name: str, values: npt.ArrayLike) -> FloatArray:
    array = on_lattice(real_array(name, values))
    if not (np.abs(array) < EXACT_BELOW_NATS).all():
        raise ParameterError(
            f"{name} must be finite and below {EXACT_BELOW_NATS:,.0f} nats in size"
        )
    return array


def _whole_numbers(
    name: str, values: npt.ArrayLike, kind: type[_Whole]
) -> npt.NDArray[_Whole]:
    array = np.asarray(values)
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} must hold whole numbers; got {array.dtype}")
    bounds = np.iinfo(kind)
    if array.size and not bounds.min <= array.min() <= array.max() <= bounds.max:
        raise ParameterError(f"{name} must lie in {bounds.min} to {bounds.max}")
    return array.astype(kind)


def _require_parts(indptr: IntArray, cell: CellArray, log_odds: FloatArray) -> None:
    one_each = indptr.ndim == 1 and cell.ndim == 1 and cell.shape == log_odds.shape
    if not one_each or not indptr.size or indptr[0] != 0 or indptr[-1] != cell.size:
        raise ParameterError(
            "indptr must run from 0 to the number of entries, and cell and log_odds "
            f"have one value each; got indptr {indptr[:1]} to {indptr[-1:]}, shapes "
            f"{indptr.shape}, {cell.shape} and {log_odds.shape}"
        )
    if (np.diff(indptr) < 0).any():
        raise ParameterError("indptr must not fall from one reading to the next")


def _require_cells_once(indptr: IntArray, cell: CellArray, n_cells: int) -> None:
    if cell.size and not 0 <= cell.min() <= cell.max() < n_cells:
        raise ParameterError(
            f"cell must lie in 0 to {n_cells - 1}; got {cell.min()} to {cell.max()}"
        )
    reading = np.repeat(np.arange(indptr.size - 1), np.diff(indptr))
    entries = np.sort(reading * n_cells + cell)  # fast where it is sorted, as usual
    if (entries[1:] == entries[:-1]).any():
        raise ParameterError("a reading must name each cell at most once")

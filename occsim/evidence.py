"""The evidence log: what the readings say, before any prior."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, Progress
from occsim.errors import ParameterError
from occsim.grid import Grid
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory
from occsim.world import World


@dataclass(frozen=True, eq=False)
class EvidenceLog:
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
        ``logit(p_free(reading))`` of Eq. 4.22, nats.
    """

    grid: Grid
    indptr: IntArray
    cell: npt.NDArray[np.int32]
    log_odds: FloatArray

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
            Summed log-odds S of the readings, nats.
        counts : ndarray of int64, shape (R, C)
            Number k of readings.

        Raises
        ------
        ParameterError
            Where there are not that many readings.
        """
        if n_readings is None or n_readings == self.n_readings:
            return self._all_totals
        if not 0 <= n_readings <= self.n_readings:
            raise ParameterError(
                f"n_readings must lie in 0 to {self.n_readings}; got {n_readings!r}"
            )
        return self._sum_entries(int(self.indptr[n_readings]))

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


def collect_evidence(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    grid: Grid,
    on_progress: Progress | None = None,
) -> EvidenceLog:
    """Simulate all readings; see the module's owner for the kernels."""
    raise NotImplementedError

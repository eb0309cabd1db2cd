"""gmapping's cell model: how often beams end in a cell, of how often they pass it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import ParameterError, expect, real_number
from occsim.grid import Grid
from occsim.mapping import OccupancyMap
from occsim.rays.outline import run_ends
from occsim.rays.ragged import ragged_ranges
from occsim.scan.log import ScanLog
from occsim.sensor import EDGE_EPS, LOG_ODDS_MAX, Sensor

OCCUPIED_ABOVE = 0.25
"""Share of hits above which gmapping publishes a cell as occupied."""

CELLS_AT_ONCE = 1 << 21
"""Most cells that the beams of a batch pass, save a single scan's: bounds memory."""

FAR_CELLS = 1e6
"""Ends of beams are cut to this many cells from the grid's corner: farther ones would
overflow whole numbers."""


@dataclass(frozen=True, eq=False, repr=False)
class HitsVisits(ShortRepr):
    """Counts of beams, cell by cell.

    Parameters
    ----------
    grid : Grid
        The cells.
    hits : ndarray of int64, shape (R, C)
        Beams that end in each cell.
    visits : ndarray of int64, shape (R, C)
        Beams that end in it or pass it.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, HitsVisits
    >>> counts = HitsVisits(Grid(height_px=1, width_px=2, cell_px=1),
    ...     np.array([[1, 2]]), np.array([[8, 4]]))
    >>> counts.declared().p_free
    array([[0.9, 0.1]])
    """

    grid: Grid
    hits: IntArray
    visits: IntArray

    @property
    def occupied_share(self) -> FloatArray:
        """Hits by visits, ndarray of float64 of shape (R, C); NaN where unvisited."""
        share = np.full(self.grid.shape, np.nan)
        np.divide(self.hits, self.visits, out=share, where=self.visits > 0)
        return share

    def is_occupied(self, threshold: float = OCCUPIED_ABOVE) -> BoolArray:
        """Return which cells are declared occupied.

        Parameters
        ----------
        threshold : float, default OCCUPIED_ABOVE
            Share of hits that must be exceeded, in [0, 1).

        Returns
        -------
        ndarray of bool, shape (R, C)

        Raises
        ------
        ParameterError
            Where the threshold lies outside its domain.
        """
        threshold = real_number("threshold", threshold)
        if not 0.0 <= threshold < 1.0:
            raise ParameterError(f"threshold must lie in [0, 1); got {threshold}")
        return np.asarray(self.hits > threshold * self.visits)

    def declared(self, threshold: float = OCCUPIED_ABOVE) -> OccupancyMap:
        """Return the map as gmapping publishes it: occupied, free, or unknown.

        Parameters
        ----------
        threshold : float, default OCCUPIED_ABOVE
            As in `is_occupied`.

        Returns
        -------
        OccupancyMap
            p_free is 0.1, 0.9 or one half, so that `score` can compare it with others;
            what it says beyond the three classes is not gmapping's.
        """
        sign = np.where(self.is_occupied(threshold), -1.0, 1.0) * (self.visits > 0)
        return OccupancyMap(self.grid, sign * LOG_ODDS_MAX, self.visits)


def hits_visits(scan_log: ScanLog, sensor: Sensor, grid: Grid) -> HitsVisits:
    """Return how often beams end in each cell and pass it, as gmapping counts.

    A beam without width passes the cells of a line from the robot's cell to that in
    which it ends. It takes no prior: that is why a drawing cannot help it.

    Parameters
    ----------
    scan_log : ScanLog
        S scans.
    sensor : Sensor
        `range_px` is the usable range: a hit at or beyond it passes the cells as far as
        it, and ends in none. gmapping skips beams without return, as `clear_no_hit`
        False does; with True they pass the cells as far as the range.
    grid : Grid
        The cells; what lies outside does not count.

    Returns
    -------
    HitsVisits

    Raises
    ------
    TypeError
        Where an argument is of another type.

    Notes
    -----
    Lines are Bresenham's, half-way steps away from the robot. A range of 0 is skipped,
    as gmapping does.

    References
    ----------
    .. [1] G. Grisetti, C. Stachniss and W. Burgard, gmapping: `PointAccumulator` and
       `ScanMatcher::registerScan`; published above 0.25 by slam_gmapping.

    Examples
    --------
    >>> from occsim import Grid, ScanLog, Sensor, hits_visits
    >>> grid = Grid(height_px=1, width_px=5, cell_px=1)
    >>> log = ScanLog([[0.5, 0.5, 0.0]] * 2, [0.0], [[3.0], [2.0]], 20.0)
    >>> found = hits_visits(log, Sensor(), grid)
    >>> found.hits, found.visits
    (array([[0, 0, 1, 1, 0]]), array([[2, 2, 2, 1, 0]]))
    """
    expect("scan_log", scan_log, ScanLog)
    expect("sensor", sensor, Sensor)
    expect("grid", grid, Grid)
    hits, visits = (np.zeros(grid.n_cells, dtype=np.int64) for _ in range(2))
    for (_, passed), (_, hit) in _visits(scan_log, sensor, grid):
        visits += np.bincount(passed, minlength=grid.n_cells)
        hits += np.bincount(hit, minlength=grid.n_cells)
    visits += hits
    return HitsVisits(grid, hits.reshape(grid.shape), visits.reshape(grid.shape))


@dataclass(frozen=True, eq=False, repr=False)
class BeamCounts(ShortRepr):
    """Counts of beams, scan by scan: what `HitsVisits` adds up.

    Parameters
    ----------
    grid : Grid
        The cells.
    indptr : ndarray of int64, shape (S + 1,)
        Scan s owns the entries ``indptr[s]:indptr[s + 1]``.
    cell : ndarray of int32, shape (N,)
        Flat row-major cell of each entry, ascending within a scan.
    hits, visits : ndarray of int64, shape (N,)
        Beams of the scan that end in the cell, and that end in it or pass it.
    """

    grid: Grid
    indptr: IntArray
    cell: npt.NDArray[np.int32]
    hits: IntArray
    visits: IntArray


def beam_counts(scan_log: ScanLog, sensor: Sensor, grid: Grid) -> BeamCounts:
    """Return how often the beams of each scan end in each cell and pass it.

    Parameters
    ----------
    scan_log, sensor, grid
        As in `hits_visits`, whose counts are the sums of these over the scans.

    Returns
    -------
    BeamCounts

    Raises
    ------
    TypeError
        Where an argument is of another type.
    """
    expect("scan_log", scan_log, ScanLog)
    expect("sensor", sensor, Sensor)
    expect("grid", grid, Grid)
    n_cells = grid.n_cells
    parts = [np.zeros((3, 0), dtype=np.int64)]
    for batch in _visits(scan_log, sensor, grid):
        passed, hit = (scan * n_cells + cell for scan, cell in batch)
        # The last bit says which visits are hits.
        visits = np.concatenate([2 * passed, 2 * hit + 1])
        if visits.size:
            visits.sort()
            key = visits >> 1
            first, last = run_ends(key[1:] != key[:-1])
            hits = np.add.reduceat(visits & 1, first)
            parts.append(np.stack([key[first], hits, last - first + 1]))
    key, hits, visits = np.concatenate(parts, axis=1)
    bounds = np.arange(scan_log.n_scans + 1) * n_cells
    cell = (key % n_cells).astype(np.int32)
    return BeamCounts(grid, key.searchsorted(bounds), cell, hits, visits)


_Visits = tuple[IntArray, IntArray]
"""The scan and the flat cell of each visit of a beam to a cell of the grid, (V,)."""


def _visits(
    scan_log: ScanLog, sensor: Sensor, grid: Grid
) -> Iterator[tuple[_Visits, _Visits]]:
    """Yield, by batches, where beams pass, and where they end in a hit."""
    for scan, start, ends, is_hit in _beams(scan_log, sensor, grid):
        beam, passed = _passed(start, ends)
        inside = _inside(passed, grid)
        hit, hit_inside = ends[:, is_hit], _inside(ends[:, is_hit], grid)
        yield (
            (scan[beam[inside]], _flat(passed[:, inside], grid)),
            (scan[is_hit][hit_inside], _flat(hit[:, hit_inside], grid)),
        )


def _beams(
    scan_log: ScanLog, sensor: Sensor, grid: Grid
) -> Iterator[tuple[IntArray, IntArray, IntArray, BoolArray]]:
    """Yield, by batches, scans (N,), starts and ends (2, N), and which are hits.

    Starts and ends are rows and columns of cells.
    """
    usable = min(sensor.range_px, scan_log.max_range_px)
    across = int(min(usable / grid.cell_px, FAR_CELLS)) + 1
    step = max(CELLS_AT_ONCE // (across * scan_log.n_beams), 1)
    for first in range(0, scan_log.n_scans, step):
        part = slice(first, first + step)
        ranges = scan_log.ranges_px[part]
        counts = np.isfinite(ranges) | ((ranges == np.inf) & sensor.clear_no_hit)
        scan, beam = np.nonzero(counts & (ranges > 0.0))
        # A wall's surface often lies between two cells: the beam ends in the one
        # behind it.
        z = np.minimum(ranges[scan, beam] + EDGE_EPS, usable)
        x, y, theta = scan_log.poses[part][scan].T
        bearing = theta + scan_log.bearings_rad[beam]
        ends = y + z * np.sin(bearing), x + z * np.cos(bearing)
        start, end = _cells(np.array([y, x]), grid), _cells(np.array(ends), grid)
        yield first + scan, start, end, np.asarray(ranges[scan, beam] < usable)


def _cells(points_px: FloatArray, grid: Grid) -> IntArray:
    cells = np.floor(points_px / grid.cell_px)
    return np.clip(cells, -FAR_CELLS, FAR_CELLS).astype(np.int64)


def _inside(cells: IntArray, grid: Grid) -> BoolArray:
    """Return which of rows and columns (2, T) lie in the grid."""
    row, col = cells
    inside = (row >= 0) & (col >= 0) & (row < grid.n_rows) & (col < grid.n_cols)
    return np.asarray(inside)


def _flat(cells: IntArray, grid: Grid) -> IntArray:
    row, col = cells
    return np.asarray(row * grid.n_cols + col)


def _passed(start: IntArray, end: IntArray) -> tuple[IntArray, IntArray]:
    """Return the line (T,) and the row and column (2, T) of the cells of lines.

    The last cell of each line is left out.
    """
    way = end - start
    length = np.abs(way).max(axis=0)
    beam, step = ragged_ranges(np.zeros_like(length), length)
    # The nearest whole number to step way / n, half-way ones away from 0. Quotients of
    # whole numbers this small are never rounded up to a whole one.
    twice, half_way = (
        np.repeat(both, length, axis=1)
        for both in (2.0 * way, np.copysign(length.astype(np.float64), way))
    )
    off = np.trunc((step * twice + half_way) / (2.0 * length[beam]))
    return beam, np.repeat(start, length, axis=1) + off.astype(np.int64)

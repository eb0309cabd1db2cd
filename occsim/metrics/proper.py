"""Scores of the probabilities themselves: log loss, Brier score, reliability.

Precision and recall see on which side of one half a probability lies. These scores are
best, on average, for whoever states what is true as often as it is true.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import whole_number
from occsim.logodds import logit, p_free_from_log_odds, softplus
from occsim.mapping import OccupancyMap
from occsim.metrics.counts import Region, ratio, scored_cells


def surprise_bits(log_odds: npt.ArrayLike, wall: npt.ArrayLike) -> FloatArray:
    """Return ``-log2 p`` of what is true, for log-odds of free against occupied.

    Parameters
    ----------
    log_odds : array_like of float
        Nats.
    wall : array_like of bool
        Whether it is a wall in truth.

    Returns
    -------
    ndarray of float64
        Finite wherever the log-odds are: 5000 nats of belief in what is not so cost
        7213 bits.
    """
    against = np.where(wall, log_odds, np.negative(log_odds))
    return np.asarray(softplus(against) / np.log(2.0), dtype=np.float64)


def log_loss(
    occupancy_map: OccupancyMap, truth: BoolArray, region: Region = Region.ALL
) -> float:
    """Return the mean of ``-log2 p(truth of the cell)``, bits per cell.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    region : Region, default Region.ALL
        Which cells count.

    Returns
    -------
    float
        0 for certainty that is right, 1 where every cell is at one half, more for
        certainty that is wrong; NaN where no cell counts.

    Raises
    ------
    TypeError
        Where the map is no `OccupancyMap`, or the truth not bool.
    ParameterError
        Where the shapes differ or the region is no `Region`.

    Examples
    --------
    >>> from occsim import Grid, OccupancyMap, log_loss, logit
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> seen = OccupancyMap(grid, logit([[0.5, 0.75]]), np.array([[0, 1]]))
    >>> round(log_loss(seen, [[True, True]]), 6)  # -log2 of 0.5 and of 0.25
    1.5
    """
    log_odds, wall = scored_cells(occupancy_map, truth, region)
    return float(ratio(surprise_bits(log_odds, wall).sum(), wall.size))


def brier(
    occupancy_map: OccupancyMap, truth: BoolArray, region: Region = Region.ALL
) -> float:
    """Return the Brier score: the mean squared error of p_free against 1 and 0.

    Parameters
    ----------
    occupancy_map, truth, region
        As in `log_loss`.

    Returns
    -------
    float
        0 for certainty that is right, 0.25 where every cell is at one half, 1 for
        certainty that is wrong; NaN where no cell counts.

    Raises
    ------
    TypeError, ParameterError
        As in `log_loss`.

    Examples
    --------
    >>> from occsim import Grid, OccupancyMap, brier, logit
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> seen = OccupancyMap(grid, logit([[0.5, 0.75]]), np.array([[0, 1]]))
    >>> round(brier(seen, [[True, True]]), 6)  # mean of 0.25 and 0.5625
    0.40625
    """
    log_odds, wall = scored_cells(occupancy_map, truth, region)
    error = p_free_from_log_odds(log_odds) - ~wall
    return float(ratio(error @ error, wall.size))


@dataclass(frozen=True, eq=False, repr=False)
class Reliability(ShortRepr):
    """How often cells are free, by how probably the map says that they are.

    Parameters
    ----------
    edges : ndarray of float64, shape (n_bins + 1,)
        Bounds of the bins of p_free; a bin holds its lower bound, the last both.
    mean_p_free : ndarray of float64, shape (n_bins,)
        Mean p_free of the cells of each bin; NaN in an empty one.
    share_free : ndarray of float64, shape (n_bins,)
        Share of them that is free in truth; NaN in an empty one.
    count : ndarray of int64, shape (n_bins,)
        Number of cells.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Prior, reliability
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> bins = reliability(run.map(Prior()), run.truth_cells)
    >>> int(bins.count.sum()) == run.grid.n_cells
    True
    """

    edges: FloatArray
    mean_p_free: FloatArray
    share_free: FloatArray
    count: IntArray

    @property
    def expected_calibration_error(self) -> float:
        """Mean distance of stated and true share, over cells; NaN without a cell."""
        used = self.count > 0
        gap = np.abs(self.mean_p_free - self.share_free)[used]
        return float(ratio(gap @ self.count[used], self.count.sum()))


def reliability(
    occupancy_map: OccupancyMap,
    truth: BoolArray,
    region: Region = Region.ALL,
    n_bins: int = 10,
) -> Reliability:
    """Return the reliability diagram of a map: stated against true shares of free.

    Parameters
    ----------
    occupancy_map, truth, region
        As in `log_loss`.
    n_bins : int, default 10
        Bins of equal width over [0, 1], 1 to 1,000.

    Returns
    -------
    Reliability

    Raises
    ------
    TypeError, ParameterError
        As in `log_loss`; also where `n_bins` lies outside its domain.

    Examples
    --------
    >>> from occsim import Grid, OccupancyMap, logit, reliability
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> seen = OccupancyMap(grid, logit([[0.8, 0.8]]), np.array([[1, 1]]))
    >>> diagram = reliability(seen, [[True, False]], n_bins=2)
    >>> diagram.count, diagram.share_free
    (array([0, 2]), array([nan, 0.5]))
    >>> round(diagram.expected_calibration_error, 6)
    0.3
    """
    log_odds, wall = scored_cells(occupancy_map, truth, region)
    n_bins = whole_number("n_bins", n_bins, 1, 1000)
    p_free = p_free_from_log_odds(log_odds)
    edges = np.linspace(0.0, 1.0, n_bins + 1)
    # On the lattice a prior that is an edge is in its bin: p_free is rounded.
    own = np.searchsorted(logit(edges)[1:-1], log_odds, side="right")
    count = np.bincount(own, minlength=n_bins).astype(np.int64, copy=False)
    stated, free = (
        np.bincount(own, weights=values, minlength=n_bins) for values in (p_free, ~wall)
    )
    return Reliability(edges, ratio(stated, count), ratio(free, count), count)

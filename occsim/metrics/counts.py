"""How well a map separates wall from space: counts of cells, and what follows.

Positive means wall. A cell is declared wall where :func:`occsim.logodds.is_occupied`
says so: ties are not. A measure that is undefined is NaN.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import choice, expect
from occsim.grid import cells_of
from occsim.logodds import is_occupied
from occsim.mapping import OccupancyMap


class Region(Enum):
    """Which cells are scored.

    Examples
    --------
    >>> from occsim import Region
    >>> [region.value for region in Region]
    ['explored', 'all', 'unexplored']
    """

    EXPLORED = "explored"
    """Cells that at least one reading updated."""
    ALL = "all"
    """Every cell; where nothing was seen the prior decides."""
    UNEXPLORED = "unexplored"
    """Cells that no reading updated: there the prior decides alone."""

    def scored(self, n_updates: IntArray) -> BoolArray:
        """Return which cells are scored, from how often each was updated."""
        if self is Region.ALL:
            return np.ones(n_updates.shape, dtype=np.bool_)
        explored = n_updates > 0
        return explored if self is Region.EXPLORED else ~explored


def ratio(part: npt.ArrayLike, whole: npt.ArrayLike) -> FloatArray:
    """Return ``part / whole``, NaN where the whole is zero.

    Parameters
    ----------
    part, whole : array_like of int
        Counts of cells, of shapes that broadcast.

    Returns
    -------
    ndarray of float64
        Shares; no warning is raised for an empty whole.
    """
    denominator = np.asarray(whole, dtype=np.float64)
    defined = np.where(denominator == 0.0, np.nan, denominator)
    return np.asarray(np.asarray(part) / defined, dtype=np.float64)


def precision_of(tp: npt.ArrayLike, fp: npt.ArrayLike) -> FloatArray:
    """Return TP / (TP + FP): the share of declared walls that are walls."""
    hits = np.asarray(tp)
    return ratio(hits, hits + np.asarray(fp))


def recall_of(tp: npt.ArrayLike, fn: npt.ArrayLike) -> FloatArray:
    """Return TP / (TP + FN): the share of walls that are declared."""
    return precision_of(tp, fn)


def f_beta_of(
    tp: npt.ArrayLike, fp: npt.ArrayLike, fn: npt.ArrayLike, beta: float
) -> FloatArray:
    """Return the F measure that weighs recall `beta` times as much as precision.

    Written in counts it needs no precision, and so is 0 where walls exist but none is
    declared; it is NaN only where there are neither walls nor declarations.
    """
    hits = (1.0 + beta**2) * np.asarray(tp, dtype=np.float64)
    return ratio(hits, hits + beta**2 * np.asarray(fn) + np.asarray(fp))


@dataclass(frozen=True, slots=True)
class Scores:
    """Counts of correct and wrong cells, and the measures computed from them.

    Parameters
    ----------
    tp, fp, fn, tn : int
        Walls found, false walls, walls missed, and space left free.

    Examples
    --------
    >>> from occsim import Scores
    >>> scores = Scores(tp=8, fp=2, fn=0, tn=90)
    >>> scores.precision, scores.recall, round(scores.f2, 3)
    (0.8, 1.0, 0.952)
    """

    tp: int
    fp: int
    fn: int
    tn: int

    @property
    def precision(self) -> float:
        """TP / (TP + FP); NaN where nothing is declared wall."""
        return float(precision_of(self.tp, self.fp))

    @property
    def recall(self) -> float:
        """TP / (TP + FN); NaN where there is no wall to find."""
        return float(recall_of(self.tp, self.fn))

    @property
    def f1(self) -> float:
        """Precision and recall in equal weight (see `f_beta_of`)."""
        return float(f_beta_of(self.tp, self.fp, self.fn, 1.0))

    @property
    def f2(self) -> float:
        """Recall in twice the weight of precision (see `f_beta_of`)."""
        return float(f_beta_of(self.tp, self.fp, self.fn, 2.0))

    @property
    def iou(self) -> float:
        """TP / (TP + FP + FN): overlap of declared and true walls."""
        return float(ratio(self.tp, self.tp + self.fp + self.fn))

    @property
    def accuracy(self) -> float:
        """Share of cells classified correctly; NaN where no cell is scored."""
        right = self.tp + self.tn
        return float(ratio(right, right + self.fp + self.fn))


def score(
    occupancy_map: OccupancyMap, truth: BoolArray, region: Region = Region.EXPLORED
) -> Scores:
    """Return how a map compares with the ground truth.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    region : Region, default Region.EXPLORED
        Which cells count.

    Returns
    -------
    Scores

    Raises
    ------
    TypeError
        Where the map is no `OccupancyMap`, or the truth not bool.
    ParameterError
        Where the shapes differ or the region is no `Region`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, OccupancyMap, score
    >>> grid = Grid(height_px=1, width_px=3, cell_px=1)
    >>> seen = OccupancyMap(grid, np.array([[-1.0, -1.0, 1.0]]), np.array([[1, 1, 1]]))
    >>> score(seen, [[True, False, False]])
    Scores(tp=1, fp=1, fn=0, tn=1)
    """
    log_odds, wall = scored_cells(occupancy_map, truth, region)
    outcome = outcome_of(is_occupied(log_odds), wall)
    tn, fp, fn, tp = np.bincount(outcome, minlength=4).tolist()
    return Scores(tp=tp, fp=fp, fn=fn, tn=tn)


def scored_cells(
    occupancy_map: OccupancyMap, truth: BoolArray, region: Region
) -> tuple[FloatArray, BoolArray]:
    """Return log-odds and truth of the cells of a region, each of shape (N,).

    Parameters
    ----------
    occupancy_map, truth, region
        As in `score`.

    Returns
    -------
    log_odds : ndarray of float64, shape (N,)
        Nats.
    wall : ndarray of bool, shape (N,)
        Cells that are wall in truth.

    Raises
    ------
    TypeError, ParameterError
        As in `score`.
    """
    expect("occupancy_map", occupancy_map, OccupancyMap)
    truth = cells_of("truth", truth, occupancy_map.grid)
    scored = choice("region", region, Region).scored(occupancy_map.n_updates)
    return occupancy_map.log_odds[scored], truth[scored]


def coverage(occupancy_map: OccupancyMap) -> float:
    """Return the share of cells that at least one reading updated.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.

    Returns
    -------
    float
        From 0 to 1.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Prior, coverage
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> 0.0 < coverage(run.map(Prior())) <= 1.0
    True
    """
    expect("occupancy_map", occupancy_map, OccupancyMap)
    return float(np.mean(occupancy_map.n_updates > 0))


def mean_entropy_bits(occupancy_map: OccupancyMap) -> float:
    """Return the mean entropy of all cells, in bits.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.

    Returns
    -------
    float
        1 where every cell is at one half, towards 0 as cells become certain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Prior, mean_entropy_bits
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> before, after = run.map(Prior(), n_readings=0), run.map(Prior())
    >>> mean_entropy_bits(before) > mean_entropy_bits(after)
    True
    """
    expect("occupancy_map", occupancy_map, OccupancyMap)
    # In log-odds l the entropy is ln(1 + e^-|l|) + |l| / (1 + e^|l|) nats, which
    # stays finite where p itself would round to 1.
    size = np.abs(occupancy_map.log_odds)
    small = np.exp(-size)
    # Beyond 800 nats e^-|l| is 0 in binary: the product is 0, also where l is infinite.
    nats = np.log1p(small) + np.minimum(size, 800.0) * small / (1.0 + small)
    return float(np.mean(nats) / np.log(2.0))


def outcome_of(occupied: BoolArray, wall: BoolArray) -> IntArray:
    """Return 0 true negative, 1 false positive, 2 false negative, 3 true positive."""
    return occupied + 2 * wall.astype(np.int64)

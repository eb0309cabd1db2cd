"""Scores: how well a map tells wall from space, at its end and at every step.

Positive means wall. A cell is declared wall where :func:`occsim.logodds.is_occupied`
says so: ties are not. A measure that is undefined is NaN.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, require_choice
from occsim.evidence import EvidenceLog
from occsim.grid import cells_of
from occsim.logodds import is_occupied
from occsim.mapping import OccupancyMap, UpdateRule, prior_weight
from occsim.prior import PriorMap


class Region(Enum):
    """Which cells are scored."""

    EXPLORED = "explored"
    """Cells that at least one reading updated."""
    ALL = "all"
    """Every cell; where nothing was seen the prior decides."""


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
    """Counts of cells right and wrong, and the measures made of them.

    Parameters
    ----------
    tp, fp, fn, tn : int
        Walls found, false walls, walls missed, and space left free.
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
        """Share of cells told rightly; NaN where no cell is scored."""
        right = self.tp + self.tn
        return float(ratio(right, right + self.fp + self.fn))


@dataclass(frozen=True, eq=False)
class ScoreCurves:
    """Scores after 0, 1, ..., S readings.

    Parameters
    ----------
    tp, fp, fn, tn : ndarray of int64, shape (S + 1,)
        Counts of cells, as in `Scores`; the first entry is the bare prior.
    coverage : ndarray of float64, shape (S + 1,)
        Share of all cells that are explored.
    """

    tp: IntArray
    fp: IntArray
    fn: IntArray
    tn: IntArray
    coverage: FloatArray

    @property
    def precision(self) -> FloatArray:
        """TP / (TP + FP), ndarray of float64 of shape (S + 1,)."""
        return precision_of(self.tp, self.fp)

    @property
    def recall(self) -> FloatArray:
        """TP / (TP + FN), ndarray of float64 of shape (S + 1,)."""
        return recall_of(self.tp, self.fn)

    @property
    def f1(self) -> FloatArray:
        """F1 after each reading, ndarray of float64 of shape (S + 1,)."""
        return f_beta_of(self.tp, self.fp, self.fn, 1.0)

    @property
    def f2(self) -> FloatArray:
        """F2 after each reading, ndarray of float64 of shape (S + 1,)."""
        return f_beta_of(self.tp, self.fp, self.fn, 2.0)

    def at(self, n_readings: int) -> Scores:
        """Return the scores after the first `n_readings`, 0 to S."""
        counts = (self.tp, self.fp, self.fn, self.tn)
        return Scores(*(int(count[n_readings]) for count in counts))


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
    ParameterError
        Where the shapes differ or the region is no `Region`.
    """
    require_choice("region", region, Region)
    truth = cells_of("truth", truth, occupancy_map.grid)
    outcome = _outcome(is_occupied(occupancy_map.log_odds), truth)
    if region is Region.EXPLORED:
        outcome = outcome[occupancy_map.n_updates > 0]
    tn, fp, fn, tp = np.bincount(outcome.ravel(), minlength=4).tolist()
    return Scores(tp=tp, fp=fp, fn=fn, tn=tn)


def coverage(occupancy_map: OccupancyMap) -> float:
    """Return the share of cells that at least one reading updated."""
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
    """
    # In log-odds l the entropy is ln(1 + e^-|l|) + |l| / (1 + e^|l|) nats, which
    # stays finite where p itself would round to 1.
    size = np.abs(occupancy_map.log_odds)
    small = np.exp(-size)
    # Beyond 800 nats e^-|l| is 0 in binary: the product is 0, also where l is infinite.
    nats = np.log1p(small) + np.minimum(size, 800.0) * small / (1.0 + small)
    return float(np.mean(nats) / np.log(2.0))


def scores_by_reading(
    evidence: EvidenceLog,
    prior_map: PriorMap,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR,
    region: Region = Region.EXPLORED,
) -> ScoreCurves:
    """Return the scores of the map after every reading.

    Equal to `fuse` and `score` at each ``n_readings``, in one pass: an entry of the
    log changes the state of one cell, so the counts are running sums of changes.

    Parameters
    ----------
    evidence : EvidenceLog
        What S readings said.
    prior_map : PriorMap
        The prior on the same grid.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    rule : UpdateRule, default UpdateRule.SUBTRACT_PRIOR
        How a reading enters the map.
    region : Region, default Region.EXPLORED
        Which cells count.

    Returns
    -------
    ScoreCurves

    Raises
    ------
    ParameterError
        Where grids or shapes differ, or the rule or region is no member of its enum.
    """
    if evidence.grid != prior_map.grid:
        raise ParameterError(
            "evidence and prior map must lie on the same grid; got "
            f"{evidence.grid} and {prior_map.grid}"
        )
    require_choice("region", region, Region)
    truth = cells_of("truth", truth, evidence.grid)
    wall = truth.ravel()
    start = _outcome(is_occupied(prior_map.log_odds).ravel(), wall)
    order, first = _by_cell(evidence)
    cell, step = evidence.cell[order], evidence.reading[order].astype(np.int64)
    log_odds = _running_sums(evidence.log_odds[order], first)
    log_odds += prior_weight(_visit(first), rule) * prior_map.log_odds.ravel()[cell]
    after = _outcome(is_occupied(log_odds), wall[cell])
    before = np.where(first, start[cell], np.roll(after, 1))
    # Among the explored cells only, a cell's first entry takes it out of no state.
    leaves = slice(None) if region is Region.ALL else ~first
    n_readings = evidence.n_readings
    changes = _tally(after, step, n_readings)
    changes -= _tally(before[leaves], step[leaves], n_readings)
    if region is Region.ALL:
        changes[:, 0] = np.bincount(start, minlength=4)
    tn, fp, fn, tp = np.cumsum(changes, axis=1)
    explored = np.cumsum(np.bincount(step[first] + 1, minlength=n_readings + 1))
    return ScoreCurves(tp, fp, fn, tn, coverage=explored / evidence.grid.n_cells)


def _outcome(occupied: BoolArray, wall: BoolArray) -> IntArray:
    # 0 true negative, 1 false positive, 2 false negative, 3 true positive.
    return occupied + 2 * wall.astype(np.int64)


def _tally(outcome: IntArray, step: IntArray, n_readings: int) -> IntArray:
    # How often each outcome occurs at each reading, one column of zeros before them.
    width = n_readings + 1
    counts = np.bincount(outcome * width + step + 1, minlength=4 * width)
    return counts.astype(np.int64, copy=False).reshape(4, width)


def _by_cell(evidence: EvidenceLog) -> tuple[IntArray, BoolArray]:
    # Entries of a cell side by side in the order of the readings, and where each
    # cell's run begins. The smallest integer type that holds the cells sorts fastest.
    small = evidence.cell.astype(np.min_scalar_type(evidence.grid.n_cells))
    order = np.argsort(small, kind="stable")
    first = np.diff(small[order], prepend=small[order][:1]) != 0
    first[:1] = True
    return order, first


def _visit(first: BoolArray) -> IntArray:
    # 1 for a cell's first entry, 2 for its second, ...
    index = np.arange(first.size)
    starts = np.flatnonzero(first)
    return np.asarray(index - starts[np.cumsum(first) - 1] + 1, dtype=np.int64)


def _running_sums(values: FloatArray, first: BoolArray) -> FloatArray:
    """Return the sum of each run's values so far, ties exact.

    One running sum over all runs, less its value before the run, would lose the small
    digits in which ties live once a long log has made it large. In fixed point nothing
    is lost: integer sums wrap, and their differences are right as long as a single
    run's sum fits.
    """
    if not values.size:
        return values.copy()
    longest = float(_visit(first).max())
    largest = max(float(np.abs(values).max()), 1.0)
    # 62 bits for the largest possible sum of a run: at least 2^-40 nats for any log
    # of fewer than a million readings of one cell.
    scale = 2.0 ** np.floor(61.0 - np.log2(longest * largest))
    fixed = np.rint(values * scale).astype(np.int64)
    total = np.cumsum(fixed)
    base = (total - fixed)[first]
    return np.asarray((total - base[np.cumsum(first) - 1]) / scale, dtype=np.float64)

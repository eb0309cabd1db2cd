"""Scores: how well a map separates wall from space, at its end and at every step.

Positive means wall. A cell is declared wall where :func:`occsim.logodds.is_occupied`
says so: ties are not. A measure that is undefined is NaN.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import choice, expect
from occsim.evidence_log import EvidenceLog
from occsim.grid import cells_of, same_grid
from occsim.logodds import is_occupied
from occsim.mapping import OccupancyMap, UpdateRule
from occsim.prior import PriorMap

ENTRIES_AT_ONCE = 1 << 16
"""Entries whose changes are counted together: bounds the memory of `scores_by_reading`,
and they stay in the processor's cache."""


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
    """Counts of correct and wrong cells, and the measures computed from them.

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
        """Share of cells classified correctly; NaN where no cell is scored."""
        right = self.tp + self.tn
        return float(ratio(right, right + self.fp + self.fn))


@dataclass(frozen=True, eq=False, repr=False)
class ScoreCurves(ShortRepr):
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
    expect("occupancy_map", occupancy_map, OccupancyMap)
    truth = cells_of("truth", truth, occupancy_map.grid)
    outcome = _outcome(is_occupied(occupancy_map.log_odds), truth)
    if choice("region", region, Region) is Region.EXPLORED:
        outcome = outcome[occupancy_map.n_updates > 0]
    tn, fp, fn, tp = np.bincount(outcome.ravel(), minlength=4).tolist()
    return Scores(tp=tp, fp=fp, fn=fn, tn=tn)


def coverage(occupancy_map: OccupancyMap) -> float:
    """Return the share of cells that at least one reading updated."""
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
    """
    expect("occupancy_map", occupancy_map, OccupancyMap)
    # In log-odds l the entropy is ln(1 + e^-|l|) + |l| / (1 + e^|l|) nats, which
    # stays finite where p itself would round to 1.
    size = np.abs(occupancy_map.log_odds)
    small = np.exp(-size)
    # Beyond 800 nats e^-|l| is 0 in binary: the product is 0, also where l is infinite.
    nats = np.log1p(small) + np.minimum(size, 800.0) * small / (1.0 + small)
    return float(np.mean(nats) / np.log(2.0))


def scores_by_reading(
    evidence: EvidenceLog | Iterable[EvidenceLog],
    prior_map: PriorMap,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
) -> ScoreCurves:
    """Return the scores of the map after every reading.

    Equal to `fuse` and `score` at each ``n_readings``, in one pass and in memory that
    grows with the number of readings, not of entries: every reading moves a few cells
    from one count to another.

    Parameters
    ----------
    evidence : EvidenceLog or iterable of EvidenceLog
        The S readings, whole or in parts, as `stream_evidence` yields them for logs
        that would not fit into memory.
    prior_map : PriorMap
        The prior on the same grid.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    region : Region, default Region.EXPLORED
        Which cells count.

    Returns
    -------
    ScoreCurves

    Raises
    ------
    TypeError
        Where an argument is of another type; totals are not accepted, as they have no
        single readings.
    ParameterError
        Where grids or shapes differ, or the rule or region is no member of its enum.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, Prior, build_prior, logit
    >>> from occsim import scores_by_reading
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 1, 2], [0, 1], logit([0.1, 0.1]))
    >>> walls = [[True, False]]
    >>> scores_by_reading(log, build_prior(walls, grid, Prior()), walls).tp
    array([0, 1, 1])
    """
    expect("evidence", evidence, EvidenceLog, Iterable)
    expect("prior_map", prior_map, PriorMap)
    truth = cells_of("truth", truth, prior_map.grid)
    tally = _Tally(
        prior_map,
        truth.ravel(),
        once=choice("rule", rule, UpdateRule) is UpdateRule.PRIOR_ONCE,
        everywhere=choice("region", region, Region) is Region.ALL,
    )
    changes = [tally.start()]
    for part in [evidence] if isinstance(evidence, EvidenceLog) else evidence:
        expect("evidence", part, EvidenceLog)
        same_grid(evidence=part.grid, prior_map=prior_map.grid)
        cuts = np.arange(0, part.cell.size, ENTRIES_AT_ONCE)
        bounds = [0, *np.searchsorted(part.indptr, cuts).tolist(), part.n_readings]
        for first, stop in pairwise(sorted(set(bounds))):
            changes.append(tally.read(part, first, stop))
    tn, fp, fn, tp, explored = np.cumsum(np.concatenate(changes, axis=1), axis=1)
    return ScoreCurves(tp, fp, fn, tn, coverage=explored / prior_map.grid.n_cells)


class _Tally:
    """A map that is updated by its recursion, and how its scores change with it.

    Parameters
    ----------
    prior_map : PriorMap
        Where the map starts.
    wall : ndarray of bool, shape (R * C,)
        Cells that are wall in truth.
    once, everywhere : bool
        Rule and region.
    """

    def __init__(
        self, prior_map: PriorMap, wall: BoolArray, *, once: bool, everywhere: bool
    ) -> None:
        self._log_odds = prior_map.log_odds.ravel().copy()
        self._taken_off = None if once else self._log_odds.copy()
        self._wall, self._everywhere = wall, everywhere
        self._explored = np.zeros(wall.size, dtype=np.bool_)

    def start(self) -> IntArray:
        """Return the counts of the bare prior, (5, 1): see `read`."""
        outcome = _outcome(is_occupied(self._log_odds), self._wall)
        counts = np.bincount(outcome, minlength=5) * self._everywhere
        return counts.astype(np.int64, copy=False)[:, None]

    def read(self, log: EvidenceLog, first: int, stop: int) -> IntArray:
        """Return how readings `first` to `stop` - 1 change the counts.

        Returns
        -------
        ndarray of int64, shape (5, stop - first)
            True negatives, false positives, false negatives, true positives, and
            cells explored: changes with each reading.
        """
        ends = log.indptr[first : stop + 1]
        own = slice(ends[0], ends[-1])
        ends = ends - ends[0]
        cell, added = log.cell[own].astype(np.intp), log.log_odds[own]
        if self._taken_off is not None:
            added = added - self._taken_off[cell]
        after = self._update(cell, added, ends)
        # On the lattice the difference is exactly the previous value.
        occupied, before = is_occupied(after), is_occupied(after - added)
        new = self._newly_explored(cell)
        moved = np.flatnonzero((occupied != before) | new)
        step, wall = np.searchsorted(ends, moved, "right") - 1, self._wall[cell[moved]]
        arrives, leaves = (_outcome(x[moved], wall) for x in (occupied, before))
        new = new[moved]
        # Only explored cells count: at its first reading a cell leaves no earlier
        # outcome.
        left = slice(None) if self._everywhere else ~new
        changes = _by_step(arrives, step, stop - first)
        changes -= _by_step(leaves[left], step[left], stop - first)
        changes[4] = np.bincount(step[new], minlength=stop - first)
        return changes

    def _update(self, cell: IntArray, added: FloatArray, ends: IntArray) -> FloatArray:
        # l_k = l_(k-1) + logit(p_free(reading k)), less l_0 with SUBTRACT_PRIOR; a
        # reading names a cell once.
        after = np.empty_like(added)
        for start, stop in pairwise(ends.tolist()):
            own = cell[start:stop]
            log_odds = self._log_odds[own]
            log_odds += added[start:stop]
            self._log_odds[own] = after[start:stop] = log_odds
        return after

    def _newly_explored(self, cell: IntArray) -> BoolArray:
        new = ~self._explored[cell]
        entry = np.flatnonzero(new)
        cells, nth = np.unique(cell[entry], return_index=True)
        self._explored[cells] = True
        new[entry] = False
        new[entry[nth]] = True
        return new


def _outcome(occupied: BoolArray, wall: BoolArray) -> IntArray:
    # 0 true negative, 1 false positive, 2 false negative, 3 true positive.
    return occupied + 2 * wall.astype(np.int64)


def _by_step(outcome: IntArray, step: IntArray, n_steps: int) -> IntArray:
    # How often each outcome occurs at each reading, and a row of zeros.
    counts = np.bincount(outcome * n_steps + step, minlength=5 * n_steps)
    return counts.astype(np.int64, copy=False).reshape(5, n_steps)

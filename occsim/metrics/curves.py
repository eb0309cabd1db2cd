"""Scores after every reading, in one pass."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import choice, expect
from occsim.evidence_log import EvidenceLog
from occsim.grid import cells_of, same_grid
from occsim.logodds import is_occupied
from occsim.mapping import UpdateRule
from occsim.metrics.counts import (
    Region,
    Scores,
    f_beta_of,
    outcome_of,
    precision_of,
    ratio,
    recall_of,
)
from occsim.metrics.proper import surprise_bits
from occsim.prior import PriorMap

ENTRIES_AT_ONCE = 1 << 16
"""Entries whose changes are counted together: bounds the memory of `scores_by_reading`,
and they stay in the processor's cache."""


@dataclass(frozen=True, eq=False, repr=False)
class ScoreCurves(ShortRepr):
    """Scores after 0, 1, ..., S readings.

    Parameters
    ----------
    tp, fp, fn, tn : ndarray of int64, shape (S + 1,)
        Counts of cells, as in `Scores`; the first entry is the bare prior.
    coverage : ndarray of float64, shape (S + 1,)
        Share of all cells that are explored.
    bits : ndarray of float64, shape (S + 1,), optional
        Log loss, bits per cell, NaN where no cell counts; None where it was not asked
        for.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Prior, scores_by_reading
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> prior_map = run.prior_map(Prior())
    >>> curves = scores_by_reading(run.evidence, prior_map, run.truth_cells)
    >>> len(curves.recall) == run.evidence.n_readings + 1
    True
    """

    tp: IntArray
    fp: IntArray
    fn: IntArray
    tn: IntArray
    coverage: FloatArray
    bits: FloatArray | None = None

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


def scores_by_reading(
    evidence: EvidenceLog | Iterable[EvidenceLog],
    prior_map: PriorMap,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    *,
    bits: bool = False,
) -> ScoreCurves:
    """Return the scores of the map after every reading.

    Equal to `fuse` and `score` (and `log_loss`) at each ``n_readings``, in one pass and
    in memory that grows with the number of readings, not of entries: every reading
    moves a few cells from one count to another.

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
    bits : bool, default False
        Whether the log loss is wanted too: it takes about as long as all counts.

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
    expect("bits", bits, bool)
    truth = cells_of("truth", truth, prior_map.grid)
    tally = _Tally(
        prior_map,
        truth.ravel(),
        once=choice("rule", rule, UpdateRule) is UpdateRule.PRIOR_ONCE,
        region=choice("region", region, Region),
        bits=bits,
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
    coverage = explored / prior_map.grid.n_cells
    per_cell = tally.lost_bits(tn + fp + fn + tp) if bits else None
    return ScoreCurves(tp, fp, fn, tn, coverage, per_cell)


class _Tally:
    """A map that is updated by its recursion, and how its scores change with it.

    Parameters
    ----------
    prior_map : PriorMap
        Where the map starts.
    wall : ndarray of bool, shape (R * C,)
        Cells that are wall in truth.
    once : bool
        Whether the prior is counted once; else it is subtracted at every reading.
    region : Region
        Which cells count.
    bits : bool
        Whether the log loss is followed too.
    """

    def __init__(
        self,
        prior_map: PriorMap,
        wall: BoolArray,
        *,
        once: bool,
        region: Region,
        bits: bool,
    ) -> None:
        self._log_odds = prior_map.log_odds.ravel().copy()
        self._taken_off = None if once else self._log_odds.copy()
        self._wall, self._region = wall, region
        self._explored = np.zeros(wall.size, dtype=np.bool_)
        self._lost: list[FloatArray] | None = [] if bits else None

    def start(self) -> IntArray:
        """Return the counts of the bare prior, (5, 1): see `read`."""
        outcome = outcome_of(is_occupied(self._log_odds), self._wall)
        counts = np.bincount(outcome, minlength=5).astype(np.int64, copy=False)
        counted = self._region is not Region.EXPLORED
        if self._lost is not None:
            lost = surprise_bits(self._log_odds, self._wall).sum()
            self._lost.append(np.array([lost * counted]))
        return counts[:, None] * counted

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
        if self._lost is not None:
            self._lost.append(self._lost_by(cell, after, after - added, new, ends))
        moved = np.flatnonzero((occupied != before) | new)
        step, wall = np.searchsorted(ends, moved, "right") - 1, self._wall[cell[moved]]
        arrives, leaves = (outcome_of(x[moved], wall) for x in (occupied, before))
        enters, left = self._crossing(new[moved])
        changes = _by_step(arrives, step, stop - first) * enters
        changes -= _by_step(leaves[left], step[left], stop - first)
        changes[4] = np.bincount(step[new[moved]], minlength=stop - first)
        return changes

    def _crossing(self, new: BoolArray) -> tuple[bool, BoolArray]:
        # Whether the new values of cells count, and which of the old ones did. At its
        # first reading a cell becomes explored: it enters the explored cells with no
        # earlier value, and leaves the unexplored ones for good.
        if self._region is Region.ALL:
            return True, np.ones_like(new)
        return (True, ~new) if self._region is Region.EXPLORED else (False, new)

    def _lost_by(
        self,
        cell: IntArray,
        after: FloatArray,
        before: FloatArray,
        new: BoolArray,
        ends: IntArray,
    ) -> FloatArray:
        """Return how each reading changes the summed log loss, (stop - first,) bits."""
        wall, (enters, left) = self._wall[cell], self._crossing(new)
        change = surprise_bits(after, wall) * enters
        change -= surprise_bits(before, wall) * left
        step = np.repeat(np.arange(ends.size - 1), np.diff(ends))
        lost = np.bincount(step, weights=change, minlength=ends.size - 1)
        return lost.astype(np.float64, copy=False)

    def lost_bits(self, n_scored: IntArray) -> FloatArray:
        """Return the log loss per scored cell after every reading, (S + 1,)."""
        lost = np.cumsum(np.concatenate(self._lost or [np.empty(0)]))
        return ratio(lost, n_scored)

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


def _by_step(outcome: IntArray, step: IntArray, n_steps: int) -> IntArray:
    # How often each outcome occurs at each reading, and a row of zeros.
    counts = np.bincount(outcome * n_steps + step, minlength=5 * n_steps)
    return counts.astype(np.int64, copy=False).reshape(5, n_steps)

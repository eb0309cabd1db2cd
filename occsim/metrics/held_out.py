"""Bits of a map on readings that it has not seen: a score without a ground truth."""

from dataclasses import dataclass

import numpy as np

from occsim._types import FloatArray, IntArray, ShortRepr
from occsim.errors import ParameterError, expect, whole_number
from occsim.evidence_log import EvidenceLog, EvidenceTotals
from occsim.grid import same_grid
from occsim.logodds import logit
from occsim.mapping import UpdateRule, fuse
from occsim.metrics.counts import ratio
from occsim.metrics.proper import surprise_bits
from occsim.prior import PriorMap

CLEAR_NATS = float(logit(0.9))
"""Held-out readings must say at least as much as one clear look, nats."""

CLEAR_SHARE = 0.8
"""Of what they would say if all of them were clear and agreed: what nine of ten that
do, and one that says the opposite, come to."""

MAX_FOLDS = 100


@dataclass(frozen=True, eq=False, repr=False)
class HeldOut(ShortRepr):
    """How well maps predict readings that were held out.

    Parameters
    ----------
    bits : float
        Mean of ``-log2 p`` of what the held-out readings say, bits per cell; NaN where
        they say nothing clearly.
    bits_by_fold : ndarray of float64, shape (F,)
        The same for each block; NaN where it says nothing clearly.
    cells_by_fold : ndarray of int64, shape (F,)
        Cells of each block that are predicted.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, Prior, held_out_bits, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> held = held_out_bits(run.evidence, run.prior_map(Prior()), n_folds=4)
    >>> held.bits_by_fold.shape, held.cells_by_fold.shape
    ((4,), (4,))
    """

    bits: float
    bits_by_fold: FloatArray
    cells_by_fold: IntArray


def held_out_bits(
    evidence: EvidenceLog,
    prior_map: PriorMap,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    n_folds: int = 5,
) -> HeldOut:
    """Return how well a prior and some readings predict the others, bits per cell.

    Parameters
    ----------
    evidence : EvidenceLog
        S readings, in the order in which they were taken.
    prior_map : PriorMap
        The prior on the same grid.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    n_folds : int, default 5
        Number F of blocks, 2 to 100 and at most S.

    Returns
    -------
    HeldOut

    Raises
    ------
    TypeError
        Where evidence or prior map is of another type.
    ParameterError
        Where the grids differ, there are fewer readings than blocks, or the number of
        blocks lies outside its domain.

    Notes
    -----
    The readings are cut into F blocks of consecutive ones: neighbours see nearly the
    same, so readings held out one by one would be predicted by their neighbours. Each
    block is held out once. It counts in the cells of which it speaks clearly: where its
    log-odds sum to at least those of one clear look, `logit(0.9)`, and to at least
    `CLEAR_SHARE` of what its k readings would say if all were clear and agreed. The
    sign says free or wall. The map of the prior and of all other blocks gives the
    probability of that, and the log loss is averaged over the cells of all blocks.

    Cells that no reading shows count nowhere, and an error that all readings share, a
    wrong pose or a glass wall, is not seen. On simulated drives through the samples a
    to e, priors that differed by more than 0.01 bits were ranked as the ground truth of
    the same cells ranks them.

    References
    ----------
    .. [1] T. Hastie, R. Tibshirani and J. Friedman, "The Elements of Statistical
       Learning", 2nd edition, section 7.10: cross-validation.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, Prior, build_prior, held_out_bits, logit
    >>> grid = Grid(height_px=1, width_px=1, cell_px=1)
    >>> twice = EvidenceLog(grid, [0, 1, 2], [0, 0], logit([0.9, 0.9]))
    >>> blank = build_prior([[False]], grid, Prior.uninformative())
    >>> round(held_out_bits(twice, blank, n_folds=2).bits, 3)  # -log2 of 0.9
    0.152
    """
    expect("evidence", evidence, EvidenceLog)
    expect("prior_map", prior_map, PriorMap)
    same_grid(evidence=evidence.grid, prior_map=prior_map.grid)
    n_folds = whole_number("n_folds", n_folds, 2, MAX_FOLDS)
    if n_folds > evidence.n_readings:
        raise ParameterError(
            f"n_folds must be at most the number of readings, {evidence.n_readings}; "
            f"got {n_folds}"
        )
    ends = np.arange(n_folds + 1) * evidence.n_readings // n_folds
    bits, cells = np.zeros(n_folds), np.zeros(n_folds, dtype=np.int64)
    for fold, (start, stop) in enumerate(zip(ends[:-1], ends[1:], strict=True)):
        missed = _missed_bits(evidence, prior_map, rule, int(start), int(stop))
        bits[fold], cells[fold] = missed.sum(), missed.size
    return HeldOut(float(ratio(bits.sum(), cells.sum())), ratio(bits, cells), cells)


def _missed_bits(
    evidence: EvidenceLog, prior_map: PriorMap, rule: UpdateRule, start: int, stop: int
) -> FloatArray:
    """Return the bits of each cell that one block shows clearly."""
    sums, counts = evidence.totals()
    until, n_until = evidence.totals(stop)
    before, n_before = evidence.totals(start)
    # Differences of sums on the lattice are exact.
    own, n_own = until - before, n_until - n_before
    others = EvidenceTotals(evidence.grid, sums - own, counts - n_own)
    clear = np.abs(own) >= CLEAR_NATS * np.maximum(CLEAR_SHARE * n_own, 1.0)
    log_odds = fuse(others, prior_map, rule).log_odds
    return surprise_bits(log_odds[clear], own[clear] < 0.0)

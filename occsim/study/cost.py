"""What one mapping step costs: the recursion taken literally, and timed.

`fuse` uses a closed form. A robot cannot, because it does not know later readings. Here
the map is updated reading by reading, as it would be on board, so that the cost of a
step can be measured with one prior and with another.

References
----------
.. [1] S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", Table 9.1.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occsim._types import FloatArray
from occsim.errors import choice, expect, whole_number
from occsim.evidence_log import EvidenceLog
from occsim.grid import same_grid
from occsim.mapping import OccupancyMap, UpdateRule
from occsim.prior import PriorMap

FINE_S = 1e-5
"""Resolution that a clock needs, s: a run takes some milliseconds."""

# Processor time leaves out what other programs take; some systems count it coarsely.
_FINE = time.get_clock_info("thread_time").resolution <= FINE_S
_now = time.thread_time if _FINE else time.perf_counter


@dataclass(frozen=True, eq=False)
class StepCost:
    """How long the update of the map takes for one reading.

    Parameters
    ----------
    seconds : ndarray of float64, shape (repeats,)
        Time of a whole run divided by its number of readings, run by run.
    """

    seconds: FloatArray

    @property
    def median_us(self) -> float:
        """Median over the runs, microseconds."""
        return float(np.median(self.seconds) * 1e6)

    @property
    def range_us(self) -> tuple[float, float]:
        """Fastest and slowest run, microseconds."""
        return float(self.seconds.min() * 1e6), float(self.seconds.max() * 1e6)


def fuse_stepwise(
    evidence: EvidenceLog,
    prior_map: PriorMap,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
) -> OccupancyMap:
    """Return the map of all readings, updated by one reading after another.

    Parameters
    ----------
    evidence : EvidenceLog
        What the readings said.
    prior_map : PriorMap
        The prior on the same grid.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.

    Returns
    -------
    OccupancyMap
        What `fuse` gives, to the last bit.

    Raises
    ------
    TypeError
        Where evidence or prior map is of another type.
    ParameterError
        Where the grids differ.
    """
    expect("evidence", evidence, EvidenceLog)
    expect("prior_map", prior_map, PriorMap)
    same_grid(evidence=evidence.grid, prior_map=prior_map.grid)
    log_odds = prior_map.log_odds.ravel()
    # Every prior and either rule take the same operations; some subtract zeros.
    once = choice("rule", rule, UpdateRule) is UpdateRule.PRIOR_ONCE
    subtracted = np.zeros_like(log_odds) if once else log_odds.copy()
    n_updates = np.zeros(log_odds.size, dtype=np.int64)
    for start, stop in zip(evidence.indptr[:-1], evidence.indptr[1:], strict=True):
        cell = evidence.cell[start:stop]
        # l_k = l_(k-1) + logit(p_free(reading k)), less l_0 with SUBTRACT_PRIOR; a
        # reading names a cell once.
        log_odds[cell] += evidence.log_odds[start:stop] - subtracted[cell]
        n_updates[cell] += 1
    shape = evidence.grid.shape
    return OccupancyMap(
        evidence.grid, log_odds.reshape(shape), n_updates.reshape(shape)
    )


def step_costs(
    evidence: EvidenceLog,
    prior_maps: Sequence[PriorMap],
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    repeats: int = 7,
) -> list[StepCost]:
    """Measure what one reading's update costs with each of some priors.

    The runs of the priors alternate, so that other load on the machine affects all
    alike; where the system counts it finely, processor time is measured. The simulation
    of the readings is left out: it does not depend on the prior.

    Parameters
    ----------
    evidence : EvidenceLog
        What the readings said.
    prior_maps : sequence of PriorMap
        Priors on the same grid.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    repeats : int, default 7
        Runs for each prior, at least 1.

    Returns
    -------
    list of StepCost
        One a prior, in their order.

    Raises
    ------
    ParameterError
        Where the grids differ or `repeats` is below 1.
    """
    repeats = whole_number("repeats", repeats, 1, 1_000_000)
    seconds = np.empty((len(prior_maps), repeats))
    for turn in range(repeats):
        for i, prior_map in enumerate(prior_maps):
            start = _now()
            fuse_stepwise(evidence, prior_map, rule)
            seconds[i, turn] = _now() - start
    return [StepCost(row / max(evidence.n_readings, 1)) for row in seconds]

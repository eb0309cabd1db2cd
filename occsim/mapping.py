"""Fusion: the occupancy map that evidence and a prior give together."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, ShortRepr
from occsim.errors import choice, expect
from occsim.evidence_log import Evidence, require_evidence
from occsim.grid import Grid, same_grid
from occsim.logodds import p_free_from_log_odds
from occsim.prior import PriorMap


class UpdateRule(Enum):
    """How a reading enters the map.

    With a prior of one half both rules agree.

    Examples
    --------
    >>> from occsim import UpdateRule
    >>> [rule.value for rule in UpdateRule]
    ['prior_once', 'subtract_prior']
    """

    PRIOR_ONCE = "prior_once"
    """The prior enters once, at the start; each reading adds its log-odds. This is
    Bayes' rule for these readings: their 0.9 and 0.1 were set for a cell about which
    nothing is known, so they contain no prior to subtract."""
    SUBTRACT_PRIOR = "subtract_prior"
    """Each reading adds its log-odds less the cell's prior: Thrun, Burgard and Fox,
    Table 9.1, with the cell's own prior as l_0. The source, as we reconstruct it: it
    prints no recursion. From the second reading on, it pushes a cell away from its
    prior."""


@dataclass(frozen=True, eq=False, repr=False)
class OccupancyMap(ShortRepr):
    """A map after some number of readings.

    Parameters
    ----------
    grid : Grid
        The cells.
    log_odds : ndarray of float64, shape (R, C)
        Log-odds of free against occupied, nats.
    n_updates : ndarray of int64, shape (R, C)
        Readings that updated each cell; 0 where only the prior counts.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, OccupancyMap
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> seen = OccupancyMap(grid, np.array([[2.2, -2.2]]), np.array([[1, 1]]))
    >>> seen.p_free.round(2)
    array([[0.9, 0.1]])
    """

    grid: Grid
    log_odds: FloatArray
    n_updates: IntArray

    @property
    def p_free(self) -> FloatArray:
        """Probability of free, Eq. 4.21, ndarray of float64 of shape (R, C)."""
        return p_free_from_log_odds(self.log_odds)


def prior_weight(n_updates: npt.ArrayLike, rule: UpdateRule) -> FloatArray:
    """Return how many times the prior's log-odds count in the map's.

    Parameters
    ----------
    n_updates : array_like of int
        Readings k that updated each cell.
    rule : UpdateRule
        With PRIOR_ONCE the closed form is ``l = S + l_0``, with SUBTRACT_PRIOR
        ``l = S + (1 - k) l_0``.

    Returns
    -------
    ndarray of float64
        1, or 1 - k.

    Raises
    ------
    ParameterError
        Where the rule is no `UpdateRule`.
    """
    k = np.asarray(n_updates, dtype=np.float64)
    once = choice("rule", rule, UpdateRule) is UpdateRule.PRIOR_ONCE
    return np.ones_like(k) if once else 1.0 - k


def fuse(
    evidence: Evidence,
    prior_map: PriorMap,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    n_readings: int | None = None,
) -> OccupancyMap:
    """Return the map that the first readings and a prior give together.

    The readings' log-odds do not depend on the prior, so both recursions have a closed
    form per cell, with S the sum and k the number of its readings:
    ``l_k = l_(k-1) + logit(p_free(reading k))`` gives ``l = S + l_0``, and the same
    less l_0 at each reading gives ``l = S + (1 - k) l_0``. On the lattice of
    `occsim.logodds` they agree to the last bit.

    Parameters
    ----------
    evidence : EvidenceLog or EvidenceTotals
        The S readings.
    prior_map : PriorMap
        The prior on the same grid.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    n_readings : int, optional
        Use only the first ones, 0 to S; all by default. Totals allow only all.

    Returns
    -------
    OccupancyMap

    Raises
    ------
    TypeError
        Where evidence or prior map is of another type.
    ParameterError
        Where the grids differ, there are not that many readings, or the rule is no
        `UpdateRule`.

    References
    ----------
    .. [1] S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", Table 9.1.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, Prior, build_prior, fuse, logit
    >>> grid = Grid(height_px=1, width_px=1, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 1], [0], logit([0.1]))
    >>> prior_map = build_prior([[False]], grid, Prior(p_space=1.0))
    >>> fuse(log, prior_map).p_free  # 0.9 and 0.1 cancel
    array([[0.5]])
    """
    require_evidence(evidence)
    expect("prior_map", prior_map, PriorMap)
    grid = same_grid(evidence=evidence.grid, prior_map=prior_map.grid)
    sums, counts = evidence.totals(n_readings)
    log_odds = sums + prior_weight(counts, rule) * prior_map.log_odds
    return OccupancyMap(grid=grid, log_odds=log_odds, n_updates=counts)

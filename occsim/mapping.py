"""Fusion: the occupancy map that evidence and a prior give together."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray
from occsim.errors import ParameterError, require_choice
from occsim.evidence import EvidenceLog
from occsim.grid import Grid
from occsim.logodds import p_free_from_log_odds
from occsim.prior import PriorMap


class UpdateRule(Enum):
    """How a reading enters the map."""

    SUBTRACT_PRIOR = "subtract_prior"
    """Thrun, Burgard and Fox, Table 9.1: each reading's log-odds less the prior's."""
    PRIOR_ONCE = "prior_once"
    """The prior enters once, at the start; each reading adds its log-odds."""


@dataclass(frozen=True, eq=False)
class OccupancyMap:
    """A map after some number of readings.

    Parameters
    ----------
    grid : Grid
        The cells.
    log_odds : ndarray of float64, shape (R, C)
        Log-odds of free against occupied, nats.
    n_updates : ndarray of int64, shape (R, C)
        Readings that updated each cell; 0 where only the prior speaks.
    """

    grid: Grid
    log_odds: FloatArray
    n_updates: IntArray

    @property
    def p_free(self) -> FloatArray:
        """Probability of free, Eq. 4.21, ndarray of float64 of shape (R, C)."""
        return p_free_from_log_odds(self.log_odds)


def prior_weight(n_updates: npt.ArrayLike, rule: UpdateRule) -> FloatArray:
    """Return how many times the prior's log-odds stand in the map's.

    Parameters
    ----------
    n_updates : array_like of int
        Readings k that updated each cell.
    rule : UpdateRule
        With SUBTRACT_PRIOR the closed form is ``l = S + (1 - k) l_0``, with
        PRIOR_ONCE ``l = S + l_0``.

    Returns
    -------
    ndarray of float64
        1 - k, or 1.

    Raises
    ------
    ParameterError
        Where the rule is no `UpdateRule`.
    """
    require_choice("rule", rule, UpdateRule)
    k = np.asarray(n_updates, dtype=np.float64)
    if rule is UpdateRule.SUBTRACT_PRIOR:
        return np.asarray(1.0 - k, dtype=np.float64)
    return np.ones_like(k)


def fuse(
    evidence: EvidenceLog,
    prior_map: PriorMap,
    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR,
    n_readings: int | None = None,
) -> OccupancyMap:
    """Return the map that the first readings and a prior give together.

    The readings' log-odds do not depend on the prior, so the recursion
    ``l_k = l_(k-1) + logit(p_free(reading k)) - l_0`` has the closed form
    ``l = S + (1 - k) l_0`` per cell, with S the sum and k the number of its readings.

    Parameters
    ----------
    evidence : EvidenceLog
        What S readings said.
    prior_map : PriorMap
        The prior on the same grid.
    rule : UpdateRule, default UpdateRule.SUBTRACT_PRIOR
        How a reading enters the map.
    n_readings : int, optional
        Use only the first ones, 0 to S; all by default.

    Returns
    -------
    OccupancyMap

    Raises
    ------
    ParameterError
        Where the grids differ, there are not that many readings, or the rule is no
        `UpdateRule`.

    References
    ----------
    .. [1] S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", Table 9.1.
    """
    if evidence.grid != prior_map.grid:
        raise ParameterError(
            "evidence and prior map must lie on the same grid; got "
            f"{evidence.grid} and {prior_map.grid}"
        )
    sums, counts = evidence.totals(n_readings)
    log_odds = sums + prior_weight(counts, rule) * prior_map.log_odds
    return OccupancyMap(grid=evidence.grid, log_odds=log_odds, n_updates=counts)

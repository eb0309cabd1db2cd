"""Probability and log-odds of a cell being free."""

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray

DECISION_EPS = 1e-9
"""Width of the tie band about zero, in nats.

A prior of 0.9 and one reading of 0.1 cancel exactly on paper but leave 1e-16 in
binary; a cell counts as occupied only where its log-odds lie below ``-DECISION_EPS``.
Scores, sweep, exact front and player all decide by this one test.
"""


def logit(p_free: npt.ArrayLike) -> FloatArray:
    """Return the log-odds ``ln(p_free / (1 - p_free))``.

    Parameters
    ----------
    p_free : array_like
        Probability that a cell is free, in (0, 1). The ends give infinities, what lies
        beyond them NaN.

    Returns
    -------
    ndarray of float64, the shape of `p_free`
        Log-odds of free against occupied, in nats.
    """
    p = np.asarray(p_free, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.log(p) - np.log1p(-p), dtype=np.float64)


def p_free_from_log_odds(log_odds: npt.ArrayLike) -> FloatArray:
    """Return the probability of free, the inverse of `logit` (Eq. 4.21).

    Parameters
    ----------
    log_odds : array_like
        Log-odds of free against occupied, in nats.

    Returns
    -------
    ndarray of float64, the shape of `log_odds`
        ``1 / (1 + exp(-log_odds))``, without overflow for any input.
    """
    l_free = np.asarray(log_odds, dtype=np.float64)
    # exp of a number that is never positive cannot overflow.
    small = np.exp(-np.abs(l_free))
    return np.asarray(
        np.where(l_free >= 0, 1.0, small) / (1.0 + small), dtype=np.float64
    )


def is_occupied(log_odds: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Return where a map declares wall: ``p_free < 0.5``, ties excluded.

    Parameters
    ----------
    log_odds : array_like
        Log-odds of free against occupied, in nats.

    Returns
    -------
    ndarray of bool, the shape of `log_odds`
        True where ``log_odds < -DECISION_EPS``: exactly one half is not occupied.
    """
    return np.asarray(log_odds, dtype=np.float64) < -DECISION_EPS

"""What a drawing is worth, in readings."""

from enum import Enum

import numpy as np

from occsim._types import FloatArray
from occsim.errors import ParameterError, choice, expect, whole_number
from occsim.metrics.curves import ScoreCurves

SAME_SCORE = 1e-12
"""Scores closer than this are the same: sums of log losses are rounded."""


class Measure(Enum):
    """By which score maps are compared.

    Examples
    --------
    >>> from occsim import Measure
    >>> Measure("bits") is Measure.BITS
    True
    """

    F2 = "f2"
    """F2: more is better."""
    BITS = "bits"
    """Log loss, bits per cell: less is better."""


def worth_in_readings(
    drawing: ScoreCurves,
    blank: ScoreCurves,
    n_readings: int = 0,
    measure: Measure = Measure.BITS,
) -> int | None:
    """Return how many readings a robot without the drawing needs to know as much.

    Parameters
    ----------
    drawing, blank : ScoreCurves
        Curves over the same S readings, of a map with the drawing and of one whose
        prior is one half. They must hold `bits` where these are compared.
    n_readings : int, default 0
        Readings that the map with the drawing has, 0 to S.
    measure : Measure, default Measure.BITS
        What is compared.

    Returns
    -------
    int or None
        The fewest readings at which the blank map is at least as good; None where it
        never is on this tour, or the score with the drawing is undefined. Fewer than
        `n_readings` for a drawing that is worse than none.

    Raises
    ------
    TypeError
        Where the curves are no `ScoreCurves`.
    ParameterError
        Where they differ in length, lack the bits that are compared, there are not that
        many readings, or the measure is no `Measure`.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, Prior, build_prior, logit
    >>> from occsim import scores_by_reading, worth_in_readings
    >>> grid = Grid(height_px=1, width_px=1, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 1, 2], [0, 0], logit([0.3, 0.3]))
    >>> walls = [[True]]
    >>> drawing, blank = (
    ...     scores_by_reading(log, start, walls, region="all", bits=True)
    ...     for prior in (Prior(p_wall=0.2), Prior.uninformative())
    ...     for start in [build_prior(walls, grid, prior)]
    ... )
    >>> worth_in_readings(drawing, blank)  # 0.18 is as sure as two readings of 0.3
    2
    """
    expect("drawing", drawing, ScoreCurves)
    expect("blank", blank, ScoreCurves)
    measure = choice("measure", measure, Measure)
    ours, theirs = (_ascending(curves, measure) for curves in (drawing, blank))
    if ours.shape != theirs.shape:
        raise ParameterError(
            "the curves must be over the same readings; got "
            f"{ours.size - 1} and {theirs.size - 1}"
        )
    n = whole_number("n_readings", n_readings, 0, ours.size - 1)
    reached = np.flatnonzero(theirs >= ours[n] - SAME_SCORE)
    return int(reached[0]) if reached.size else None


def _ascending(curves: ScoreCurves, measure: Measure) -> FloatArray:
    """Return a score that is better the higher it is, (S + 1,)."""
    if measure is Measure.F2:
        return curves.f2
    if curves.bits is None:
        raise ParameterError("the curves must hold bits to be compared by them")
    return -curves.bits

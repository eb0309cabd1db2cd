"""Which prior pairs score nearly as well as a front.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", sec. 4.6: Fig. 4.7; C. Georgiou, S. Anderson and T. Dodd, IJRR 2017,
   doi 10.1177/0278364916687027.
"""

from collections.abc import Sequence

import numpy as np

from occsim._types import BoolArray
from occsim.errors import ParameterError, expect, real_number
from occsim.priors.front import ParetoFront
from occsim.priors.sweep import PriorSweep

ROUNDING = 1e-12
"""Slack of comparisons with a tolerance, far below one cell's share of any score."""


def near_front(sweep: PriorSweep, front: ParetoFront, tolerance: float) -> BoolArray:
    """Return which pairs of a sweep score within a tolerance of a front.

    A pair is near where some point of the front beats it by at most the tolerance in
    precision and by at most the tolerance in recall.

    Parameters
    ----------
    sweep : PriorSweep
        Scores of (A, B) pairs.
    front : ParetoFront
        Front of the same drawing and cells.
    tolerance : float
        In [0, 1], of precision and of recall alike.

    Returns
    -------
    ndarray of bool, shape (A, B)
        False where precision or recall is undefined, or the front is empty.

    Raises
    ------
    TypeError
        Where sweep or front is of another type.
    ParameterError
        Where the tolerance lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import near_front
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> sweep = run.sweep()
    >>> front = run.front()
    >>> near_front(sweep, front, 1.0).shape
    (10, 10)
    """
    expect("sweep", sweep, PriorSweep)
    expect("front", front, ParetoFront)
    tolerance = real_number("tolerance", tolerance)
    if not 0.0 <= tolerance <= 1.0:
        raise ParameterError(f"tolerance must lie in [0, 1]; got {tolerance!r}")
    slack = tolerance + ROUNDING
    # Along the front precision falls as recall rises: of the points that are not too
    # far above in recall, the last is the easiest to match in precision.
    last = np.searchsorted(front.recall, sweep.recall + slack, side="right")
    lowest = np.concatenate(([np.inf], front.precision))[last]
    return np.asarray(lowest - sweep.precision <= slack) & ~np.isnan(sweep.recall)


def good_region(
    sweeps: Sequence[PriorSweep], fronts: Sequence[ParetoFront], tolerance: float
) -> BoolArray:
    """Return which prior pairs are near the front of every drawing.

    Parameters
    ----------
    sweeps : sequence of PriorSweep
        One a drawing, over the same axes.
    fronts : sequence of ParetoFront
        The front of each of them.
    tolerance : float
        In [0, 1]; see `near_front`.

    Returns
    -------
    ndarray of bool, shape (A, B)

    Raises
    ------
    TypeError
        Where the arguments are not sequences of sweeps and fronts.
    ParameterError
        Where there is no drawing, the axes or the numbers of drawings differ, or the
        tolerance lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import good_region
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> sweep = run.sweep()
    >>> front = run.front()
    >>> good_region([sweep, sweep], [front, front], 0.03).shape
    (10, 10)
    """
    _expect_each("sweeps", sweeps, PriorSweep)
    _expect_each("fronts", fronts, ParetoFront)
    if not sweeps or len(sweeps) != len(fronts):
        raise ParameterError(
            "good_region needs one front a sweep and at least one of each; got "
            f"{len(sweeps)} sweeps and {len(fronts)} fronts"
        )
    first = sweeps[0]
    for sweep in sweeps[1:]:
        same_wall = np.array_equal(sweep.p_wall, first.p_wall)
        if not (same_wall and np.array_equal(sweep.p_space, first.p_space)):
            raise ParameterError("the sweeps must have the same axes")
    near = [near_front(s, f, tolerance) for s, f in zip(sweeps, fronts, strict=True)]
    return np.asarray(np.logical_and.reduce(near), dtype=np.bool_)


def _expect_each(name: str, values: object, kind: type) -> None:
    expect(name, values, Sequence)
    for value in values:  # type: ignore[attr-defined]
        expect(f"each of {name}", value, kind)

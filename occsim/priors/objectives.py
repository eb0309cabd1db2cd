"""The search's objectives: precision and recall of a prior pair."""

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError, expect
from occsim.evidence_log import Evidence
from occsim.mapping import UpdateRule
from occsim.metrics import Region, precision_of, recall_of
from occsim.prior import PRIOR_SCALE
from occsim.priors.surface import PriorSurface, prior_surface
from occsim.priors.sweep import Objective, PriorSweep, interpolate

ObjectiveFunction = Callable[[FloatArray], FloatArray]
"""From pairs (N, 2) of p_wall and p_space to precision and recall (N, 2)."""

AnyObjective = ObjectiveFunction | Callable[..., Any] | PriorSweep | PriorSurface
"""What `as_objective` takes."""

ROUNDING = 1e-9
"""How far a score may pass 1: bilinear weights sum to 1 only to the last bits."""


def interpolated_objective(sweep: PriorSweep) -> ObjectiveFunction:
    """Return the source's objective: a sweep, bilinearly interpolated.

    Parameters
    ----------
    sweep : PriorSweep
        Usually 0.1, 0.2, ..., 1 on both axes.

    Returns
    -------
    callable
        Precision and recall of pairs within the sweep's axes.

    Raises
    ------
    TypeError
        Where the sweep is no `PriorSweep`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import interpolated_objective
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> objective = interpolated_objective(run.sweep())
    >>> objective(np.array([[0.25, 0.85]])).shape
    (1, 2)
    """
    expect("sweep", sweep, PriorSweep)

    def evaluate(pairs: FloatArray) -> FloatArray:
        p_wall, p_space = pairs.T
        scores = [interpolate(sweep, p_wall, p_space, which) for which in Objective]
        return np.stack(scores, axis=1)

    return evaluate


def exact_objective(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    scale: float = PRIOR_SCALE,
) -> ObjectiveFunction:
    """Return the objective that scores the map of each pair.

    Parameters
    ----------
    evidence, is_wall, truth, rule, region, scale
        As in `prior_surface`.

    Returns
    -------
    callable
        Precision and recall of pairs in (0, 1].

    Raises
    ------
    TypeError, ParameterError
        As in `prior_surface`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import exact_objective
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> objective = exact_objective(run.evidence, run.wall_cells, run.truth_cells)
    >>> objective(np.array([[0.2, 0.9], [1.0, 1.0]])).shape
    (2, 2)
    """
    surface = prior_surface(evidence, is_wall, truth, rule, region, scale)
    return surface_objective(surface)


def surface_objective(surface: PriorSurface) -> ObjectiveFunction:
    """Return the exact objective of a known surface; see `exact_objective`."""
    expect("surface", surface, PriorSurface)

    def evaluate(pairs: FloatArray) -> FloatArray:
        tp, fp = surface.counts(*pairs.T)
        scores = (precision_of(tp, fp), recall_of(tp, surface.n_wall - tp))
        return np.stack(scores, axis=1)

    return evaluate


def as_objective(objective: AnyObjective) -> ObjectiveFunction:
    """Return anything that gives precision and recall of a prior pair as one function.

    Parameters
    ----------
    objective : callable, PriorSweep or PriorSurface
        A function of pairs (N, 2) that returns precision and recall, as (N, 2) or as
        a tuple of two arrays (N,); a function of two numbers, p_wall and p_space,
        called pair by pair; a sweep, to be interpolated; or an exact surface.

    Returns
    -------
    callable
        Of pairs (N, 2); it raises `ParameterError` where what the function returns
        has another shape, or is neither in [0, 1] nor NaN.

    Raises
    ------
    TypeError
        Where it is none of these.
    """
    if isinstance(objective, PriorSweep):
        return interpolated_objective(objective)
    if isinstance(objective, PriorSurface):
        return surface_objective(objective)
    if not callable(objective):
        raise TypeError(
            "objective must be a function of prior pairs, a PriorSweep or a "
            f"PriorSurface; got {type(objective).__name__}"
        )
    pair_by_pair = _takes_two_numbers(objective)

    def evaluate(pairs: FloatArray) -> FloatArray:
        if pair_by_pair:
            return _checked([objective(*pair) for pair in pairs.tolist()], len(pairs))
        scores = objective(pairs)
        return _checked(scores, len(pairs), in_columns=isinstance(scores, tuple))

    return evaluate


def _takes_two_numbers(function: Callable[..., Any]) -> bool:
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # some compiled functions have no signature
        return False
    needed = [
        parameter
        for parameter in parameters
        if parameter.default is parameter.empty
        and parameter.kind
        in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD)
    ]
    return len(needed) == 2


def _checked(scores: Any, n_pairs: int, *, in_columns: bool = False) -> FloatArray:
    """Check scores and return them as an array of precision and recall."""
    try:
        array = np.asarray(scores, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError(
            "what objective returned could not be read as numbers, precision and "
            f"recall of every pair; got {type(scores).__name__}"
        ) from None
    if in_columns:
        array = array.T
    if array.shape != (n_pairs, 2):
        raise ParameterError(
            "objective must return precision and recall of every pair, shape "
            f"({n_pairs}, 2); got shape {array.shape}"
        )
    off = array[(array < 0.0) | (array > 1.0 + ROUNDING)]
    if off.size:
        raise ParameterError(
            "objective must return precision and recall, in [0, 1] or NaN (the search "
            f"itself takes 1/precision and 1/recall); got {float(off[0])!r}"
        )
    return array

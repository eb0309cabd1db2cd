"""Which prior pair is good: surfaces of scores, exact fronts, and searches for them."""

from occsim.priors.exact import exact_front, rectangles_at, surface_front
from occsim.priors.front import (
    MIN_RECALL,
    ParetoFront,
    dominates,
    front_of,
    hypervolume,
    non_dominated,
    recommend,
    reference_point,
    set_c,
)
from occsim.priors.loss import (
    LossSurface,
    best_log_loss_pair,
    loss_surface,
)
from occsim.priors.near import good_region, near_front
from occsim.priors.nsga2 import (
    PARETO_FRACTION,
    Elitism,
    Generation,
    nsga2_front,
    nsga2_generations,
)
from occsim.priors.objectives import (
    AnyObjective,
    ObjectiveFunction,
    exact_objective,
    interpolated_objective,
    surface_objective,
)
from occsim.priors.shares import geometric_shares
from occsim.priors.surface import PriorSurface, StepCount, prior_levels, prior_surface
from occsim.priors.sweep import (
    SOURCE_AXIS,
    Maxima,
    Objective,
    PriorSweep,
    interpolate,
    maxima,
    sweep_priors,
    sweep_surface,
    ties_text,
)

__all__ = [
    "MIN_RECALL",
    "PARETO_FRACTION",
    "SOURCE_AXIS",
    "AnyObjective",
    "Elitism",
    "Generation",
    "LossSurface",
    "Maxima",
    "Objective",
    "ObjectiveFunction",
    "ParetoFront",
    "PriorSurface",
    "PriorSweep",
    "StepCount",
    "best_log_loss_pair",
    "dominates",
    "exact_front",
    "exact_objective",
    "front_of",
    "geometric_shares",
    "good_region",
    "hypervolume",
    "interpolate",
    "interpolated_objective",
    "loss_surface",
    "maxima",
    "near_front",
    "non_dominated",
    "nsga2_front",
    "nsga2_generations",
    "prior_levels",
    "prior_surface",
    "recommend",
    "rectangles_at",
    "reference_point",
    "set_c",
    "surface_front",
    "surface_objective",
    "sweep_priors",
    "sweep_surface",
    "ties_text",
]

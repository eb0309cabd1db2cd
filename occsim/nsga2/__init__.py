"""The source's optimiser: NSGA-II and its controlled-elitist variant."""

from occsim.nsga2.objectives import (
    AnyObjective,
    ObjectiveFunction,
    exact_objective,
    interpolated_objective,
    surface_objective,
)
from occsim.nsga2.search import (
    PARETO_FRACTION,
    Elitism,
    Generation,
    nsga2_front,
    nsga2_generations,
)
from occsim.nsga2.shares import geometric_shares

__all__ = [
    "PARETO_FRACTION",
    "AnyObjective",
    "Elitism",
    "Generation",
    "ObjectiveFunction",
    "exact_objective",
    "geometric_shares",
    "interpolated_objective",
    "nsga2_front",
    "nsga2_generations",
    "surface_objective",
]

"""Pareto fronts of precision and recall: the exact one, and choices made on it."""

from occsim.pareto.exact import exact_front, rectangles_at, surface_front
from occsim.pareto.front import (
    MIN_RECALL,
    ParetoFront,
    dominates,
    front_of,
    good_region,
    hypervolume,
    near_front,
    non_dominated,
    recommend,
    reference_point,
    set_c,
)

__all__ = [
    "MIN_RECALL",
    "ParetoFront",
    "dominates",
    "exact_front",
    "front_of",
    "good_region",
    "hypervolume",
    "near_front",
    "non_dominated",
    "recommend",
    "rectangles_at",
    "reference_point",
    "set_c",
    "surface_front",
]

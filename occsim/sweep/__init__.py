"""What every prior pair scores: exact counts, tables of them, and their maxima."""

from occsim.sweep.surface import PriorSurface, StepCount, prior_levels, prior_surface
from occsim.sweep.table import (
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
    "Maxima",
    "Objective",
    "PriorSurface",
    "PriorSweep",
    "StepCount",
    "interpolate",
    "maxima",
    "prior_levels",
    "prior_surface",
    "sweep_priors",
    "sweep_surface",
    "ties_text",
]

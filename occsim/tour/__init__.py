"""Tours through a building that nobody has planned: coverage, and random poses."""

from occsim.tour.coverage import coverage_tour, default_tour, random_poses
from occsim.tour.space import clearance_map, free_space, inside_building

__all__ = [
    "clearance_map",
    "coverage_tour",
    "default_tour",
    "free_space",
    "inside_building",
    "random_poses",
]

"""Tours through a building that nobody has planned, and random poses."""

from occsim.tour.plan import MAX_READINGS, default_tour, random_poses
from occsim.tour.space import clearance_map, free_space, inside_building

__all__ = [
    "MAX_READINGS",
    "clearance_map",
    "default_tour",
    "free_space",
    "inside_building",
    "random_poses",
]

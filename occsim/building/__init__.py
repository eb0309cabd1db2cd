"""A building: the drawing with everything that is needed to map it."""

from occsim.building.building import (
    DOOR_WIDTH_M,
    TOUR_READINGS,
    Building,
    Sketch,
)
from occsim.building.make import (
    building_from_drawing,
    mask_of_size,
    proposed_sensor,
    truth_from_image,
)
from occsim.building.poses import random_trajectory, sketched_trajectory

__all__ = [
    "DOOR_WIDTH_M",
    "TOUR_READINGS",
    "Building",
    "Sketch",
    "building_from_drawing",
    "mask_of_size",
    "proposed_sensor",
    "random_trajectory",
    "sketched_trajectory",
    "truth_from_image",
]

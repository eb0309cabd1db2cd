"""A building: the drawing with everything that is needed to map it."""

from occsim.building.make import (
    building_from_drawing,
    building_from_sample,
    random_trajectory,
    sketched_trajectory,
    truth_from_image,
)
from occsim.building.model import DOOR_WIDTH_M, Building, CorrectedMask, empty_mask
from occsim.building.reshape import transformed

__all__ = [
    "DOOR_WIDTH_M",
    "Building",
    "CorrectedMask",
    "building_from_drawing",
    "building_from_sample",
    "empty_mask",
    "random_trajectory",
    "sketched_trajectory",
    "truth_from_image",
    "transformed",
]

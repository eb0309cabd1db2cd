"""A building: the drawing with everything that is needed to map it."""

from occsim.building.make import (
    TOUR_READINGS,
    building_from_drawing,
    building_from_sample,
    random_trajectory,
    sketched_trajectory,
    truth_from_image,
)
from occsim.building.model import DOOR_WIDTH_M, Building, CorrectedMask, empty_mask
from occsim.building.reshape import cropped, straightened, turned

__all__ = [
    "DOOR_WIDTH_M",
    "TOUR_READINGS",
    "Building",
    "CorrectedMask",
    "building_from_drawing",
    "building_from_sample",
    "cropped",
    "empty_mask",
    "random_trajectory",
    "sketched_trajectory",
    "straightened",
    "truth_from_image",
    "turned",
]

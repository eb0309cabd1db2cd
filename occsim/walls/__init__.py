"""Wall detection: from an architectural drawing to a wall mask, by named stages."""

from occsim.walls.compare import MaskComparison, MaskError, compare_masks
from occsim.walls.detect import detect_walls
from occsim.walls.notes import STAGE_NOTES
from occsim.walls.params import Slider, Stage, StageNote, WallDetection, WallParams

__all__ = [
    "STAGE_NOTES",
    "MaskComparison",
    "MaskError",
    "Slider",
    "Stage",
    "StageNote",
    "WallDetection",
    "WallParams",
    "compare_masks",
    "detect_walls",
]

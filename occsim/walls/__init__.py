"""Wall detection: from an architectural drawing to a wall mask, by named stages."""

from occsim.walls.compare import MaskComparison, MaskError, compare_masks
from occsim.walls.detect import detect_walls
from occsim.walls.notes import STAGE_NOTES
from occsim.walls.params import Bounds, Slider, StageNote, WallParams
from occsim.walls.result import Certainty, Stage, WallDetection
from occsim.walls.scale import ScaleProposal, ScaleSource, propose_scale

__all__ = [
    "STAGE_NOTES",
    "Bounds",
    "Certainty",
    "MaskComparison",
    "MaskError",
    "ScaleProposal",
    "ScaleSource",
    "Slider",
    "Stage",
    "StageNote",
    "WallDetection",
    "WallParams",
    "compare_masks",
    "detect_walls",
    "propose_scale",
]

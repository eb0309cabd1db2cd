"""Wall detection: from an architectural drawing to a wall mask, by named stages."""

from occsim._bounds import Bounds
from occsim.walls.compare import MaskComparison, MaskError, compare_masks
from occsim.walls.detect import detect_walls
from occsim.walls.params import WallParams
from occsim.walls.result import Certainty, Stage, WallDetection
from occsim.walls.scale import ScaleProposal, ScaleSource, propose_scale

__all__ = [
    "Bounds",
    "Certainty",
    "MaskComparison",
    "MaskError",
    "ScaleProposal",
    "ScaleSource",
    "Stage",
    "WallDetection",
    "WallParams",
    "compare_masks",
    "detect_walls",
    "propose_scale",
]

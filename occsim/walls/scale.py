"""The scale of a drawing, proposed from its doors."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from occsim.imaging import Drawing
from occsim.walls.detect import detect_walls
from occsim.walls.result import WallDetection
from occsim.walls.strokes import DOOR

SPREAD = 0.15
"""Share by which doors of one building may differ in length from their median."""


class ScaleSource(Enum):
    """What a proposed scale was read from."""

    DOOR_LEAVES = "door leaves"
    DOORWAYS = "doorways"
    WALL_THICKNESS = "wall thickness"


@dataclass(frozen=True, kw_only=True, slots=True)
class ScaleProposal:
    """How long a door is in a drawing, which gives its scale and the sensor's range.

    Parameters
    ----------
    door_px : float
        Length of a usual door leaf, px of the drawing.
    source : ScaleSource
        What it was read from.
    confidence : float
        In [0, 1].
    count : int
        How many doors or doorways agree; 0 where it is read from the walls.
    """

    door_px: float
    source: ScaleSource
    confidence: float
    count: int = 0


def propose_scale(found: Drawing | WallDetection) -> ScaleProposal | None:
    """Propose the scale of a drawing.

    Parameters
    ----------
    found : Drawing or WallDetection
        A drawing, or what :func:`occsim.walls.detect_walls` found in it.

    Returns
    -------
    ScaleProposal or None
        From the swings of doors if two or more agree, else from the openings between
        walls, else from the thickness of walls; None where no wall was found.
    """
    detection = detect_walls(found) if isinstance(found, Drawing) else found
    sure = detection.certainty
    for lengths, source, most in (
        (sure.doors_px, ScaleSource.DOOR_LEAVES, 0.95),
        (sure.doorways_px, ScaleSource.DOORWAYS, 0.6),
    ):
        door_px, count = _agreed(lengths)
        if count >= 2:
            share = count / len(lengths)
            confidence = most * share * count / (count + 1)
            return ScaleProposal(
                door_px=door_px, source=source, confidence=confidence, count=count
            )
    if not np.isfinite(sure.wall_px):
        return None
    return ScaleProposal(
        door_px=DOOR * sure.wall_px,
        source=ScaleSource.WALL_THICKNESS,
        confidence=0.2,
    )


def _agreed(lengths: tuple[float, ...]) -> tuple[float, int]:
    """Return the length around which most lengths lie, and how many do."""
    values = np.asarray(lengths, dtype=np.float64)
    if not len(values):
        return float("nan"), 0
    near = np.abs(values[:, None] - values) <= SPREAD * values
    best = int(np.argmax(near.sum(axis=0)))
    return float(np.median(values[near[:, best]])), int(near[:, best].sum())

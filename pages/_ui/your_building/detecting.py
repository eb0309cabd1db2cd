"""Costly results on a drawing: its walls, its tilt, its pictures."""

from occsim.building import Building
from occsim.corrections import pack_mask
from occsim.imaging import Drawing
from occsim.imaging.tilt import estimate_tilt
from occsim.imaging.transform import Transform
from occsim.io.images import drawing_png, png
from occsim.walls import (
    MaskComparison,
    WallDetection,
    WallParams,
    compare_masks,
    detect_walls,
)
from pages._ui.compute import core, with_walls
from pages._ui.shared import shared


def detection(drawing: Drawing, params: WallParams) -> WallDetection:
    """The walls found in a drawing, with the picture of each stage."""
    return _detection(drawing.digest, params, drawing)


@shared("Looking for walls")
def _detection(digest: str, params: WallParams, _drawing: Drawing) -> WallDetection:
    with core():
        return detect_walls(_drawing, params)


def doubtful(building: Building) -> bytes:
    """The doubtful pieces of a building's walls, packed; none if they were not found
    in its drawing."""
    found = detection(building.drawing, building.wall_params)
    if found.certainty.doubtful and (found.mask == building.walls_found).all():
        return pack_mask(found.doubtful)
    return b""


def stage_pictures(drawing: Drawing, params: WallParams) -> list[tuple[str, bytes]]:
    """The stages of wall detection: title and PNG."""
    return _stage_pictures(drawing.digest, params, drawing)


@shared()
def _stage_pictures(
    digest: str, params: WallParams, _drawing: Drawing
) -> list[tuple[str, bytes]]:
    stages = detection(_drawing, params).stages
    with core():
        return [(title, png(image)) for title, image in stages]


def backdrop(drawing: Drawing) -> bytes:
    """A drawing as PNG, to draw on."""
    return _backdrop(drawing.digest, drawing)


@shared()
def _backdrop(digest: str, _drawing: Drawing) -> bytes:
    with core():
        return drawing_png(_drawing)


def reshaped(building: Building, transform: Transform) -> Building:
    """A building with its drawing cropped or turned; kept in the session."""
    with core():
        return with_walls(building.transformed(transform))


def tilt(drawing: Drawing) -> float | None:
    """Tilt of a drawing, rad; None where it is not clear."""
    return _tilt(drawing.digest, drawing)


@shared()
def _tilt(digest: str, _drawing: Drawing) -> float | None:
    with core():
        return estimate_tilt(_drawing)


def comparison(building: Building) -> MaskComparison:
    """Scores of the wall mask against the world, pixel by pixel."""
    return _comparison(building.digest, building)


@shared()
def _comparison(digest: str, _building: Building) -> MaskComparison:
    with core():
        return compare_masks(_building.wall_mask, _building.world.occupied)

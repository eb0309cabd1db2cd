"""Wall detection: from a drawing to a wall mask, stage by stage."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import ByteArray, FloatArray
from occsim.imaging import Drawing
from occsim.walls.arcs import find_swings
from occsim.walls.bands import textured, wall_bands
from occsim.walls.connect import connected_walls, line_walls
from occsim.walls.doors import Doors, find_doors
from occsim.walls.gaps import find_gaps
from occsim.walls.hollow import gap_limits, hollow_walls
from occsim.walls.ink import darkness, find_fills, find_ink
from occsim.walls.measures import Measures, measure
from occsim.walls.params import Stage, WallDetection, WallParams
from occsim.walls.raster import box, closed, components, dilated, opened
from occsim.walls.runs import strip_votes
from occsim.walls.upright import Frame, reduced, working_frame

HOLLOW_SHARE = 0.1
"""Share of all walls that hollow ones must have for a drawing to use them."""

INKED_SHARE = 0.6
"""Share of thick areas that must be ink for solid walls to be the drawing's own."""

SPECK = 1.75
"""Side of the smallest mass that may be a column, in thinnest walls."""


@dataclass(frozen=True, eq=False)
class _Strokes:
    """What is left of the ink once text and doors are out.

    Lines, ink thicker than lines, grey and coloured fills, and the doors.
    """

    lines: ByteArray
    mass: ByteArray
    fills: ByteArray
    doors: Doors


def detect_walls(
    drawing: Drawing,
    params: WallParams = WallParams(),  # noqa: B008 - frozen
) -> WallDetection:
    """Find the walls in a drawing by image processing.

    Solid walls are found by their thickness, hollow ones as long narrow gaps between
    lines, hatched and filled ones as bands of even thickness. Text, doors, stairs,
    tiles and furniture are left out by rules of shape, so that the result is imperfect.

    Parameters
    ----------
    drawing : Drawing
        The drawing, shape (H, W); dark on light or light on dark, upright or tilted.
    params : WallParams, optional
        Settings; by default all are estimated from the drawing.

    Returns
    -------
    WallDetection
        The mask, shape (H, W), and a picture for each stage.
    """
    rgb, reduction = reduced(drawing.rgb)
    dark = darkness(rgb, params.shadow_window_px * reduction)
    frame = working_frame(dark, params.straighten, drawing.shape)
    ink = find_ink(frame.dark, params.ink_level)
    m = measure(ink, params, frame.scale)
    letters = _letters(ink, m)
    strokes = _strokes(frame.dark, ink & ~letters, letters, params, m)
    gaps, bands, walls = _walls(strokes, params, m)
    shortest = params.min_piece_px * m.scale
    found = connected_walls(walls, strokes.mass, strokes.doors, shortest)
    if found.sum() < m.extent * m.thin:
        walls = line_walls(strokes.lines, strokes.doors, m.extent)
        found = connected_walls(walls, walls, strokes.doors, shortest)
    stages = (
        Stage("Darkness", _full_size(255 - dark, drawing.shape)),
        _stage(frame, "Ink", ink),
        _stage(frame, "Text and symbols removed", ink & ~letters),
        _stage(frame, "Doors removed", strokes.lines, strokes.doors.openings),
        _stage(frame, "Solid walls", strokes.mass),
        _stage(frame, "Filled and hatched walls", bands, strokes.fills),
        _stage(frame, "Hollow walls and windows", gaps[0], gaps[1]),
        _stage(frame, "Connected walls", found, walls),
    )
    return WallDetection(mask=frame.back(found), stages=stages)


def _full_size(image: ByteArray, shape: tuple[int, int]) -> ByteArray:
    """Return a picture at the drawing's size."""
    if image.shape == shape:
        return image
    return np.asarray(cv2.resize(image, shape[::-1]), dtype=np.uint8)


def _stage(
    frame: Frame, title: str, black: ByteArray, grey: ByteArray | None = None
) -> Stage:
    """Draw a stage: what it keeps in black, what it only considered in grey."""
    image = np.where(frame.back(black), 0, 255).astype(np.uint8)
    if grey is not None:
        image[frame.back(grey) & (image > 0)] = 190
    return Stage(title, image)


def _letters(ink: ByteArray, m: Measures) -> ByteArray:
    """Return text and symbols: small, or larger but without any long stroke."""
    parts = components(ink)
    straight = opened(ink, box(m.symbol, 1)) | opened(ink, box(1, m.symbol))
    curly = (parts.total(straight) == 0) & (parts.longest <= 0.15 * m.extent)
    return parts.chosen(curly | (parts.longest <= m.symbol))


def _strokes(
    dark: ByteArray,
    ink: ByteArray,
    letters: ByteArray,
    params: WallParams,
    m: Measures,
) -> _Strokes:
    """Tell lines, masses and fills apart, and take the doors out of them."""
    mass = _without_specks(opened(ink, box(m.thin)), m)
    fills = find_fills(dark, letters, m, params.fill_level)
    swings = find_swings(ink & ~dilated(mass, box(3)), m, params.door_fit)
    doors = find_doors(swings, ink, m)
    return _Strokes(
        ink & ~doors.leaves, mass & ~doors.leaves, fills & ~doors.leaves, doors
    )


def _without_specks(mass: ByteArray, m: Measures) -> ByteArray:
    """Drop what is hardly larger than it is thick: crossings of lines, arrowheads."""
    parts = components(mass)
    return parts.chosen(parts.area >= (SPECK * m.thin) ** 2)


def _walls(
    s: _Strokes, params: WallParams, m: Measures
) -> tuple[tuple[ByteArray, ByteArray], ByteArray, ByteArray]:
    """Return gaps taken and considered, bands taken, and all walls."""
    areas = textured(s.lines | s.fills, m.line) | s.fills
    votes = _votes(s, areas, m)
    limits = gap_limits(votes["gaps"], votes["areas"], params, m)
    solid = s.mass
    if not limits.hollow and s.mass.sum() < INKED_SHARE * (s.mass | areas).sum():
        solid = np.zeros_like(solid)  # blots in the hatching, not walls
    bands = np.zeros_like(solid)
    if not limits.hollow:
        bands = wall_bands(areas & ~solid, solid, m)
    gaps = find_gaps(s.lines | solid | bands, limits.widest_px, m.line)
    taken = gaps.parts.chosen(hollow_walls(gaps, s.doors.openings, limits))
    faces = dilated(taken, box(2 * m.line + 1)) & s.lines
    walls = solid | bands | taken | faces
    if limits.hollow:
        bands = wall_bands(areas & ~walls, walls, m)
    walls = opened(closed(walls | bands, box(2)), box(m.thin))
    return (taken, gaps.parts.chosen(gaps.slenderness > 1)), bands, walls


def _votes(s: _Strokes, areas: ByteArray, m: Measures) -> dict[str, FloatArray]:
    """Return how much of each way of drawing walls there is, by thickness."""
    longest = int(m.thick)
    gaps = strip_votes(s.lines | s.mass, 0, longest, m.line)
    gaps[: max(2, m.line)] = 0.0  # the inside of a door leaf
    masses = strip_votes(areas | s.mass, 1, longest, m.line)
    if gaps.sum() < HOLLOW_SHARE * (gaps.sum() + masses.sum()):
        gaps[:] = 0.0
    ink = strip_votes(s.mass, 1, longest, m.line)
    return {"gaps": gaps, "areas": masses, "mass": ink}

"""Wall detection: from a drawing to a wall mask, stage by stage."""

from dataclasses import dataclass, replace

import cv2
import numpy as np

from occsim._types import ByteArray
from occsim.imaging import Drawing
from occsim.imaging.tilt import direction_peaks, main_direction
from occsim.walls.doors import Door, doorways_of, find_doors, leaves
from occsim.walls.groups import (
    FULL,
    doorways,
    frame_of,
    without_short,
    without_strays,
)
from occsim.walls.hollow import hollow_walls, oblique_walls
from occsim.walls.params import WallParams
from occsim.walls.raster import as_bytes, box, components, dilated, opened
from occsim.walls.result import Certainty, Stage, WallDetection
from occsim.walls.sheet import Sheet, find_ink, first_scale, scaled, sheet_of
from occsim.walls.strokes import Measures, measure
from occsim.walls.text import lettering

LONG_STROKE = 3.0
"""Length, in usual walls, from which a thin stroke may be a partition."""

ALL_LONG = 0.9
"""Share of the thin strokes that must be long for all of them to be partitions."""

THIN_WALL = 0.2
"""Thickness of the thinnest partition among thicker walls, in usual walls."""

OBLIQUE_SHARE = 0.05
"""Contrast in a direction, as a share of the main one's, from which walls lie in it."""

LINE_WALLS = 0.1, 0.5
"""Length of a group, and of the longest group, of a drawing of bare lines, in lengths
of all of it: a building reaches across its drawing, furniture does not."""

SHIFT = 0.25
"""Change of the thinnest wall, as a share, under which sure walls stay."""


@dataclass(frozen=True, eq=False)
class _Ink:
    """Ink of a sheet, the doors taken out of it, and the solid walls in it."""

    every: ByteArray
    rest: ByteArray
    doors: tuple[Door, ...]
    solid: ByteArray
    m: Measures


def detect_walls(
    drawing: Drawing,
    params: WallParams = WallParams(),  # noqa: B008 - frozen
) -> WallDetection:
    """Return the walls that image processing finds in a drawing.

    How thick lines and walls are is read from the drawing; every other length follows
    from that. Solid walls are what an opening leaves; hollow and hatched ones are
    found as long lines at usual distances. The result is imperfect.

    Parameters
    ----------
    drawing : Drawing
        The drawing, shape (H, W); dark on light or light on dark, upright or tilted.
    params : WallParams, optional
        Settings; by default all are estimated from the drawing.

    Returns
    -------
    WallDetection
        The mask, shape (H, W), a picture for each stage, what is doubtful, and how
        sure all of it is.

    Examples
    --------
    >>> from occsim import detect_walls, load_sample
    >>> sample = load_sample("d")
    >>> walls = detect_walls(sample.drawing).mask
    >>> round(float((walls & sample.world.occupied).sum() / walls.sum()), 1)
    1.0
    """
    sheet = _sheet(drawing, params)
    ink = _ink(find_ink(sheet.dark, params.ink_level), sheet.scale, params)
    hollow = _hollow(sheet.dark, ink)
    walls = ink.solid | hollow
    found = without_strays(walls, ink.solid, ink.m) if ink.m.gaps else walls
    if params.min_piece_px:
        found = without_short(found, params.min_piece_px * sheet.scale)
    certainty, shaky = _certainty(ink, walls, found, sheet.scale)
    doubtful = sheet.back(shaky)
    # Counted as they are given back, but on no more pixels than were worked on.
    counted = components(shaky if sheet.scale < 1 else as_bytes(doubtful))
    stages = (
        Stage("Darkness", sheet.picture(255 - sheet.dark)),
        _stage(sheet, "Ink", ink.every),
        _stage(sheet, "Doors removed", ink.rest, doorways_of(found.shape, ink.doors)),
        _stage(sheet, "Solid walls", ink.solid),
        _stage(sheet, "Hollow walls and windows", hollow),
        _stage(sheet, "Connected walls", found, walls),
    )
    return WallDetection(
        sheet.back(found),
        stages,
        doubtful=doubtful,
        certainty=replace(certainty, doubtful=len(counted.area) - 1),
    )


def _sheet(drawing: Drawing, params: WallParams) -> Sheet:
    """Return the working copy of a drawing, upright."""
    gray = cv2.cvtColor(drawing.rgb, cv2.COLOR_RGB2GRAY).astype(np.uint8, copy=False)
    scale = first_scale(drawing.shape)
    small = scaled(gray, scale)
    tilt_rad = main_direction(small) if params.straighten else 0.0
    return sheet_of(small, drawing.shape, scale, tilt_rad, params.shadow_window_px)


def _ink(every: ByteArray, scale: float, params: WallParams) -> _Ink:
    """Take doors out of the ink, and find the solid walls in the rest."""
    if 2 * np.count_nonzero(every) > every.size:  # a photograph or an even sheet
        every = np.zeros_like(every)
    every = every & ~frame_of(every)
    written = lettering(every)
    m = _measured(every, scale, params)
    solid = _solid(every, m) & ~written
    doors = find_doors(every, every & ~dilated(solid, box(3)), m, params.door_fit)
    leaf = leaves(every, doors, m)
    rest = every & ~leaf
    if leaf.any():
        m = _measured(rest, scale, params)
        solid = _solid(rest, m) & ~written
    return _Ink(every, rest, doors, solid, m)


def _measured(ink: ByteArray, scale: float, params: WallParams) -> Measures:
    """Return the lengths of a drawing, or those that are given."""
    m = measure(ink)
    if params.min_wall_px:
        m = replace(m, solid=max(round(params.min_wall_px * scale), 1))
    if params.max_gap_px:
        widest = params.max_gap_px * scale
        m = replace(m, gaps=tuple(gap for gap in m.gaps if gap <= widest))
    return m


def _solid(ink: ByteArray, m: Measures) -> ByteArray:
    """Return the solid walls: strokes that are thick enough."""
    solid = opened(ink, box(m.solid))
    if m.bare:
        return _line_walls(solid)
    if not m.thick or m.line < THIN_WALL * m.wall:
        return solid
    thin = components(ink & ~dilated(solid, box(3)))
    long = thin.longest >= LONG_STROKE * m.wall
    if thin.area[long].sum() < ALL_LONG * thin.area.sum():
        return solid
    # No text, no doors, no furniture: what is thin here are thin walls.
    return opened(ink, box(m.line / 2))


def _line_walls(ink: ByteArray) -> ByteArray:
    """Return the groups of lines that reach across a drawing of one kind of stroke."""
    groups = components(ink)
    rows, cols = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    if not len(rows):
        return ink
    extent = max(np.ptp(rows), np.ptp(cols)) + 1
    if groups.longest.max() < LINE_WALLS[1] * extent:
        return np.zeros_like(ink)
    # A block is a column or a shaft, however small.
    block = groups.area >= FULL * groups.width * groups.height
    return ink & groups.chosen(block | (groups.longest >= LINE_WALLS[0] * extent))


def _hollow(dark: ByteArray, ink: _Ink) -> ByteArray:
    """Return hollow walls and windows, along rows and columns and at other angles."""
    m = ink.m
    if not m.gaps and not m.thick:
        return np.zeros_like(dark)
    firm = ink.solid if m.thick else np.zeros_like(ink.solid)
    hollow = hollow_walls(ink.rest, firm, m)
    if m.gaps:
        peaks = direction_peaks(dark, OBLIQUE_SHARE)
        # Peaks are told to a degree: what is nearer to 0 are the upright walls.
        for direction in [one for one in peaks if abs(one) > np.radians(1.0)][:2]:
            hollow |= oblique_walls(ink.rest, firm, direction, m)
    return hollow


def _stage(
    sheet: Sheet, title: str, black: ByteArray, grey: ByteArray | None = None
) -> Stage:
    """Draw a stage: what it keeps in black, what it only considered in grey."""
    image = np.where(black > 0, 0, 255).astype(np.uint8)
    if grey is not None:
        image[(grey > 0) & (black == 0)] = 190
    return Stage(title, sheet.picture(image))


def _certainty(
    ink: _Ink, walls: ByteArray, found: ByteArray, scale: float
) -> tuple[Certainty, ByteArray]:
    """Return how sure the walls are, and which pieces are doubtful."""
    m = ink.m
    dropped = walls & ~found
    thicker = opened(ink.rest, box(np.ceil((1 + SHIFT) * m.solid)))
    thinner = opened(ink.rest, box(np.floor((1 - SHIFT) * m.solid)))
    shaky = (ink.solid & ~dilated(thicker, box(3))) | (
        thinner & ~dilated(ink.solid, box(3))
    )
    pieces = components(shaky)
    doubtful = dropped | pieces.chosen(pieces.longest >= m.wall)
    area = int(np.count_nonzero(found))
    kept = int(np.count_nonzero(ink.rest & found))
    removed = 1 - kept / max(int(np.count_nonzero(ink.every)), 1)
    shaking = int(np.count_nonzero(shaky)) / max(area, 1)
    notes = []
    if not area:
        notes.append("No walls were found.")
    if dropped.any():
        notes.append("Pieces that belong to no building were dropped.")
    if m.gaps and not m.thick:
        notes.append("Walls are drawn as pairs of lines here.")
    return (
        Certainty(
            confidence=max(min(1 - shaking, 1 - removed), 0.0) if area else 0.0,
            removed_share=removed,
            dropped=len(components(dropped).area) - 1,
            wall_px=m.wall / scale if area else float("nan"),
            doors_px=tuple((door.radius_px + m.line) / scale for door in ink.doors),
            doorways_px=tuple(w / scale for w in doorways(found, m)[1]),
            notes=tuple(notes),
        ),
        doubtful,
    )

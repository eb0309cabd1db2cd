"""Wall detection: from a drawing to a wall mask, stage by stage."""

import numpy as np

from occsim._types import ByteArray
from occsim.drawing import Drawing
from occsim.walls.doors import find_swings, leaves
from occsim.walls.ink import darkness, find_ink, find_tone
from occsim.walls.params import Stage, WallDetection, WallParams
from occsim.walls.raster import (
    as_bytes,
    box,
    closed,
    components,
    dilated,
    narrow_places,
    opened,
)
from occsim.walls.runs import line_thickness, strip_votes
from occsim.walls.upright import working_frame


def detect_walls(
    drawing: Drawing,
    params: WallParams = WallParams(),  # noqa: B008 - frozen
) -> WallDetection:
    """Find the walls in a drawing by image processing.

    Parameters
    ----------
    drawing : Drawing
        The drawing, shape (H, W).
    params : WallParams, optional
        Settings; by default all are estimated from the drawing.

    Returns
    -------
    WallDetection
        The mask, and a picture for each stage.
    """
    frame = working_frame(
        darkness(drawing.rgb, params.shadow_window_px), params.straighten
    )
    dark, scale = frame.dark, frame.scale
    extent = min(dark.shape)
    ink = find_ink(dark, params.ink_level)
    line = min(line_thickness(ink), round(max(2.0 * scale, 0.009 * extent)))
    parts = components(ink)
    symbol = max(12 * scale, 0.035 * extent)
    strokes = ink & ~parts.chosen(parts.longest <= symbol)
    thin_px = max(int(np.ceil(2.2 * line)), 3)
    solid = opened(ink, box(thin_px)) | _fills(dark, ink, max(thin_px, line + 2))
    small_px = 2.5 * line
    holes, _ = narrow_places(as_bytes(strokes | solid == 0), small_px)
    pieces = components(holes, 4)
    textured = strokes | solid | pieces.chosen(pieces.area <= (4 * small_px) ** 2)
    solid |= opened(textured, box(3.2 * line))
    thin = strokes & ~dilated(solid, box(3))
    swings = find_swings(
        thin, (max(0.04 * extent, 8 * scale), 0.3 * extent), params.door_fit, scale
    )
    leaf, _ = leaves(swings, ink, line)
    strokes &= ~leaf
    strips = _hollow(strokes, solid, line, params, int(0.06 * extent))
    faces = dilated(strips, box(2 * line + 1)) & strokes
    wall = (solid & ~leaf) | strips | faces
    wall = opened(closed(wall, box(line + 1)), box(thin_px))
    groups = components(wall)
    reach = np.hypot(groups.width, groups.height)
    reach[0] = 0.0
    found = groups.chosen(reach >= 0.2 * reach.max())
    pictures = {
        "Ink": ink,
        "Text and symbols removed": strokes,
        "Solid walls": solid,
        "Hollow walls": strips,
        "Connected walls": found,
    }
    stages = tuple(
        Stage(title, np.where(frame.back(mask), 0, 255).astype(np.uint8))
        for title, mask in pictures.items()
    )
    return WallDetection(mask=frame.back(found), stages=stages)


def _fills(dark: ByteArray, ink: ByteArray, size: float) -> ByteArray:
    """Return the grey and coloured fills that are thin enough for walls."""
    tone = opened(find_tone(dark) | ink, box(size))
    fat = opened(tone, box(0.08 * min(dark.shape)))
    areas = components(tone)
    mostly_fat = areas.total(fat) > 0.3 * areas.area
    return tone & ~areas.chosen(mostly_fat) & ~dilated(fat, box(3))


def _hollow(
    strokes: ByteArray, solid: ByteArray, line: int, params: WallParams, max_px: int
) -> ByteArray:
    """Return the clear gaps between the two lines of hollow walls."""
    solid_votes = strip_votes(solid, 1, max_px, line)
    gap_votes = strip_votes(strokes | solid, 0, max_px, line)
    gap_votes[: max(2, int(0.6 * line))] = 0.0
    total = gap_votes.sum()
    if total <= 0.1 * (total + solid_votes.sum()):
        return np.zeros_like(strokes)
    usual = np.flatnonzero(gap_votes > 0.08 * total)
    if len(usual) == 0:
        return np.zeros_like(strokes)
    widest = params.max_gap_px or 1.25 * usual.max() + 1
    narrow, depth_px = narrow_places(as_bytes(strokes | solid == 0), widest)
    gaps = components(narrow, 4)
    width = np.maximum(4 * gaps.total(depth_px) / gaps.area - 1, 1.0)
    slender = gaps.area / width >= params.min_slenderness * width
    return gaps.chosen(slender & (width >= usual.min() - 1) & (width <= widest + 1))

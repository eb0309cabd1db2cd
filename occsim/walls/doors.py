"""Door swings: quarter circles, the leaves that they belong to, and both removed."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, IntArray
from occsim.walls.raster import box, components, opened

STRAIGHT_PX = 9
"""Length from which a stroke is straight, px of the drawing; arcs bend before."""

SPAN_RAD = np.radians(40.0), np.radians(115.0)
"""Angle that a swing covers; part of a quarter circle may be hidden by other ink."""

LEAF_COVER = 0.8
"""Share of a leaf's length along which there must be ink."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Swing:
    """A door's swing: an arc about the hinge.

    Parameters
    ----------
    x_px, y_px : float
        Hinge, in pixel indices.
    radius_px : float
        Length of the leaf, px.
    start_rad, end_rad : float
        Bearings of the arc's two ends, start before end.
    """

    x_px: float
    y_px: float
    radius_px: float
    start_rad: float
    end_rad: float


def find_swings(
    thin: ByteArray, radius_px: tuple[float, float], fit: float, scale: int
) -> tuple[Swing, ...]:
    """Return the door swings among thin strokes.

    Parameters
    ----------
    thin : ndarray of uint8, shape (h, w)
        Strokes that are no solid wall, upright.
    radius_px : tuple of float
        Shortest and longest leaf, px.
    fit : float
        How far an arc may stray from a circle, share of its radius.
    scale : int
        Working pixels along a pixel of the drawing.
    """
    length = STRAIGHT_PX * scale
    straight = opened(thin, box(length, 1)) | opened(thin, box(1, length))
    bent = components(thin & ~straight)
    size = bent.longest
    likely = (size >= radius_px[0] / 2) & (size <= 1.1 * radius_px[1])
    swings = []
    for index in np.flatnonzero(likely[1:]) + 1:
        left, top = int(bent.left[index]), int(bent.top[index])
        window = bent.labels[
            top : top + int(bent.height[index]), left : left + int(bent.width[index])
        ]
        rows, cols = np.nonzero(window == index)
        swing = _fitted(cols + left, rows + top, fit)
        if swing and radius_px[0] <= swing.radius_px <= radius_px[1]:
            swings.append(swing)
    return tuple(swings)


def _fitted(cols: IntArray, rows: IntArray, fit: float) -> Swing | None:
    """Fit a circle by least squares; None where the pixels are not an arc of one."""
    x, y = cols.astype(np.float64), rows.astype(np.float64)
    system = np.column_stack([2 * x, 2 * y, np.ones_like(x)])
    (cx, cy, c), *_ = np.linalg.lstsq(system, x * x + y * y, rcond=None)
    radius = float(np.sqrt(max(c + cx * cx + cy * cy, 0.0)))
    stray = np.percentile(np.abs(np.hypot(x - cx, y - cy) - radius), 90)
    if stray > max(fit * radius, 1.0):
        return None
    bearing = np.sort(np.arctan2(y - cy, x - cx))
    gaps = np.diff(np.append(bearing, bearing[0] + 2 * np.pi))
    widest = int(np.argmax(gaps))  # the arc is all but the widest gap between bearings
    span = 2 * np.pi - float(gaps[widest])
    if not SPAN_RAD[0] <= span <= SPAN_RAD[1]:
        return None
    start = float(bearing[(widest + 1) % len(bearing)])
    return Swing(
        x_px=float(cx),
        y_px=float(cy),
        radius_px=radius,
        start_rad=start,
        end_rad=start + span,
    )


def leaves(
    swings: tuple[Swing, ...], ink: ByteArray, line_px: int
) -> tuple[ByteArray, ByteArray]:
    """Return the door leaves, and the openings that they close.

    Of an arc's two ends, the leaf stands at the one that ink joins to the hinge; the
    opening lies towards the other.

    Returns
    -------
    leaf, opening : ndarray of uint8, shape (h, w)
    """
    leaf, opening = np.zeros_like(ink), np.zeros_like(ink)
    for swing in swings:
        half = max(2.0 * line_px, 0.12 * swing.radius_px)
        bearings = [_snapped(b) for b in (swing.start_rad, swing.end_rad)]
        cover = [_cover(ink, swing, b, half) for b in bearings]
        best = int(np.argmax(cover))
        if cover[best] < LEAF_COVER:
            continue
        _stroke(leaf, swing, bearings[best], half, (0.06, 1.08))
        _stroke(opening, swing, bearings[1 - best], half, (0.1, 0.9))
    return leaf, opening


def _snapped(bearing: float) -> float:
    """Return the bearing, or the right angle it lies close to."""
    quarters = bearing / (np.pi / 2)
    return float(np.round(quarters)) * np.pi / 2 if _near_whole(quarters) else bearing


def _near_whole(value: float) -> bool:
    return bool(abs(value - np.round(value)) < 0.25)


def _cover(ink: ByteArray, swing: Swing, bearing: float, half: float) -> float:
    """Return the share of a radius beside which there is ink."""
    rows, cols, inside = _band(ink.shape, swing, bearing, half, (0.2, 0.95))
    hit: BoolArray = (ink[rows, cols] > 0) & inside
    return float(hit.any(axis=1).mean())


def _stroke(
    mask: ByteArray,
    swing: Swing,
    bearing: float,
    half: float,
    reach: tuple[float, float],
) -> None:
    """Mark the band along a radius, in place."""
    rows, cols, inside = _band(mask.shape, swing, bearing, half, reach)
    mask[rows[inside], cols[inside]] = 1


def _band(
    shape: tuple[int, ...],
    swing: Swing,
    bearing: float,
    half: float,
    reach: tuple[float, float],
) -> tuple[IntArray, IntArray, BoolArray]:
    """Rows and columns of points of a band along a radius; which lie inside."""
    along = np.arange(reach[0] * swing.radius_px, reach[1] * swing.radius_px, 0.5)
    across = np.arange(-half, half + 0.5, 0.5)
    cos, sin = np.cos(bearing), np.sin(bearing)
    x = swing.x_px + along[:, None] * cos - across * sin
    y = swing.y_px + along[:, None] * sin + across * cos
    rows, cols = np.rint(y).astype(np.int64), np.rint(x).astype(np.int64)
    inside = (rows >= 0) & (rows < shape[0]) & (cols >= 0) & (cols < shape[1])
    return np.clip(rows, 0, shape[0] - 1), np.clip(cols, 0, shape[1] - 1), inside

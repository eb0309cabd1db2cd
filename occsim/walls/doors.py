"""Door swings: quarter circles, the leaves that they belong to, and both removed."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, IntArray
from occsim.walls.measures import Measures
from occsim.walls.raster import box, components, dilated, opened

STRAIGHT_PX = 9
"""Length from which a stroke is straight, px of the drawing; arcs bend before."""

STRAIGHT_SHARE = 0.026
"""The same as a share of the drawing's shorter side: larger arcs bend later."""

SPAN_RAD = np.radians(40.0), np.radians(115.0)
"""Angle that a swing covers; part of a quarter circle may be hidden by other ink."""

TRIMS = 4
"""Rounds of fitting a circle and leaving out what strays most."""

ON_ARC = 0.7
"""Share of a stroke's pixels that must lie on the circle."""

SNAP_QUARTERS = 0.25
"""How close to a multiple of a right angle a leaf's bearing is taken for one."""

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

    @property
    def middle(self) -> tuple[float, float]:
        """Middle of the arc, x and y, px."""
        bearing = (self.start_rad + self.end_rad) / 2
        return (
            self.x_px + self.radius_px * float(np.cos(bearing)),
            self.y_px + self.radius_px * float(np.sin(bearing)),
        )


def find_swings(thin: ByteArray, m: Measures, fit: float) -> tuple[Swing, ...]:
    """Return the door swings among thin strokes.

    Parameters
    ----------
    thin : ndarray of uint8, shape (h, w)
        Strokes that are no solid wall, upright.
    m : Measures
        Lengths of the drawing.
    fit : float
        How far an arc may stray from a circle, share of its radius; 0 finds none.
    """
    if fit == 0:
        return ()
    low, high = m.radius
    length = max(STRAIGHT_PX * m.scale, STRAIGHT_SHARE * m.extent)
    straight = opened(thin, box(length, 1)) | opened(thin, box(1, length))
    bent = thin & ~straight
    # Grown back over the lines that an arc crosses; but there two arcs may merge.
    whole = thin & dilated(bent, box(m.line + 1))
    swings: list[Swing] = []
    for mask in (bent, whole):
        for cols, rows in _strokes(mask, (low / 2, 1.1 * high)):
            found = _swings_of(thin, cols, rows, fit)
            swings += [s for s in found if low <= s.radius_px <= high]
    return _distinct(swings)


def _strokes(
    mask: ByteArray, size_px: tuple[float, float]
) -> Iterator[tuple[IntArray, IntArray]]:
    """Yield columns and rows of the pixels of each stroke of a likely size."""
    parts = components(mask)
    likely = (parts.longest >= size_px[0]) & (parts.longest <= size_px[1])
    for index in np.flatnonzero(likely[1:]) + 1:
        left, top = int(parts.left[index]), int(parts.top[index])
        right, bottom = left + int(parts.width[index]), top + int(parts.height[index])
        rows, cols = np.nonzero(parts.labels[top:bottom, left:right] == index)
        yield cols + left, rows + top


def _swings_of(
    thin: ByteArray, cols: IntArray, rows: IntArray, fit: float
) -> list[Swing]:
    """Return the swing that a stroke is, or the two that meet in it: double doors."""
    whole = _swing(thin, cols, rows, fit)
    if whole:
        return [whole]
    along = cols if np.ptp(cols) > np.ptp(rows) else rows
    first = along < (along.min() + along.max()) / 2
    halves = [half for half in (first, ~first) if half.sum() >= 3]
    found = [_swing(thin, cols[half], rows[half], fit) for half in halves]
    return [swing for swing in found if swing]


def _distinct(swings: list[Swing]) -> tuple[Swing, ...]:
    """Drop repeated finds of one swing: those whose middles of arc coincide."""
    kept: list[Swing] = []
    for swing in swings:
        x, y = swing.middle
        if all(
            np.hypot(x - other.middle[0], y - other.middle[1]) > 0.3 * swing.radius_px
            for other in kept
        ):
            kept.append(swing)
    return tuple(kept)


def _swing(thin: ByteArray, cols: IntArray, rows: IntArray, fit: float) -> Swing | None:
    """Fit a circle to part of an arc, then to all of it; None where there is none."""
    first = _fitted(cols, rows, fit)
    if first is None:
        return None
    x, y, radius = first
    reach = int(1.5 * radius)
    left, top = max(int(x) - reach, 0), max(int(y) - reach, 0)
    near_rows, near_cols = np.nonzero(
        thin[top : int(y) + reach + 1, left : int(x) + reach + 1]
    )
    dx, dy = near_cols + left - x, near_rows + top - y
    middle = np.arctan2(rows.mean() - y, cols.mean() - x)
    turn = np.abs((np.arctan2(dy, dx) - middle + np.pi) % (2 * np.pi) - np.pi)
    on_arc = np.abs(np.hypot(dx, dy) - radius) < max(2 * fit * radius, 1.5)
    on_arc &= turn < SPAN_RAD[1] / 2
    cols, rows = near_cols[on_arc] + left, near_rows[on_arc] + top
    second = _fitted(cols, rows, fit)
    return _with_span(cols, rows, second) if second else None


def _fitted(
    cols: IntArray, rows: IntArray, fit: float
) -> tuple[float, float, float] | None:
    """Fit a circle to most of the pixels: centre and radius; None where none fits.

    What hangs on an arc's ends is left out of the fit, round by round.
    """
    x, y = cols.astype(np.float64), rows.astype(np.float64)
    kept = np.ones(len(x), dtype=bool)
    for _ in range(TRIMS):
        system = np.column_stack([2 * x[kept], 2 * y[kept], np.ones(kept.sum())])
        squares = x[kept] ** 2 + y[kept] ** 2
        (cx, cy, c), *_ = np.linalg.lstsq(system, squares, rcond=None)
        radius = float(np.sqrt(max(c + cx * cx + cy * cy, 0.0)))
        stray = np.abs(np.hypot(x - cx, y - cy) - radius)
        kept = stray <= max(fit * radius, 1.0, float(np.median(stray)))
    if np.mean(stray <= max(fit * radius, 1.0)) < ON_ARC:
        return None
    return float(cx), float(cy), radius


def _with_span(
    cols: IntArray, rows: IntArray, circle: tuple[float, float, float]
) -> Swing | None:
    """Add the bearings that an arc covers; None where they are not a door's."""
    x, y, radius = circle
    bearing = np.sort(np.arctan2(rows - y, cols - x))
    gaps = np.diff(np.append(bearing, bearing[0] + 2 * np.pi))
    widest = int(np.argmax(gaps))  # the arc is all but the widest gap between bearings
    span = 2 * np.pi - float(gaps[widest])
    if not SPAN_RAD[0] <= span <= SPAN_RAD[1]:
        return None
    start = float(bearing[(widest + 1) % len(bearing)])
    return Swing(
        x_px=x, y_px=y, radius_px=radius, start_rad=start, end_rad=start + span
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
        ends = [_snapped(b) for b in (swing.start_rad, swing.end_rad)]
        thick = 0.1 * swing.radius_px + line_px
        slack = max(1.5 * line_px, 0.04 * swing.radius_px)
        # A leaf's thickness lies on the side of the opening that it closes.
        bands = [
            _band(ink.shape, swing, ends[0], (0.06, 1.06), (-slack, thick)),
            _band(ink.shape, swing, ends[1], (0.06, 1.06), (-thick, slack)),
        ]
        cover = [_cover(ink, band) for band in bands]
        best = int(np.argmax(cover))
        if cover[best] < LEAF_COVER:
            continue
        bands[best].mark(leaf)
        wide = (-2 * thick, 2 * thick)
        _band(ink.shape, swing, ends[1 - best], (0.1, 0.9), wide).mark(opening)
    return leaf, opening


def _snapped(bearing: float) -> float:
    """Return the bearing, or the right angle that it lies close to."""
    quarters = bearing / (np.pi / 2)
    whole = float(np.round(quarters))
    return whole * np.pi / 2 if abs(quarters - whole) < SNAP_QUARTERS else bearing


@dataclass(frozen=True, eq=False)
class _Band:
    """Pixels of a band along a radius: rows from the hinge on, columns across it."""

    rows: IntArray
    cols: IntArray
    inside: BoolArray

    def mark(self, mask: ByteArray) -> None:
        """Set the band's pixels in a mask that the caller has just made."""
        mask[self.rows[self.inside], self.cols[self.inside]] = 1


def _band(
    shape: tuple[int, ...],
    swing: Swing,
    bearing: float,
    reach: tuple[float, float],
    side_px: tuple[float, float],
) -> _Band:
    """Return a band along a radius: from and to as shares of it, and to its sides.

    Sides are positive towards growing bearings.
    """
    along = np.arange(reach[0] * swing.radius_px, reach[1] * swing.radius_px, 0.5)
    across = np.arange(side_px[0], side_px[1] + 0.5, 0.5)
    cos, sin = np.cos(bearing), np.sin(bearing)
    x = swing.x_px + along[:, None] * cos - across * sin
    y = swing.y_px + along[:, None] * sin + across * cos
    rows, cols = np.rint(y).astype(np.int64), np.rint(x).astype(np.int64)
    inside = (rows >= 0) & (rows < shape[0]) & (cols >= 0) & (cols < shape[1])
    rows, cols = np.clip(rows, 0, shape[0] - 1), np.clip(cols, 0, shape[1] - 1)
    return _Band(rows, cols, inside)


def _cover(ink: ByteArray, band: _Band) -> float:
    """Return the share of a band's length in which there is ink."""
    on_ink = (ink[band.rows, band.cols] > 0) & band.inside
    hit = np.any(on_ink, axis=1)
    clear_of_wall = slice(len(hit) // 6, -(len(hit) // 12) or None)
    return float(np.mean(hit[clear_of_wall]))

"""Door swings: quarter circles among thin strokes."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from occsim._types import ByteArray, FloatArray, IntArray
from occsim.walls.measures import Measures
from occsim.walls.raster import box, components, dilated, opened

STRAIGHT_PX = 9
"""Length from which a stroke is straight, px of the drawing; arcs bend before."""

STRAIGHT_SHARE = 0.026
"""The same as a share of the drawing's shorter side: larger arcs bend later."""

SPAN_RAD = np.radians(40.0), np.radians(115.0)
"""Angle that a swing covers; part of a quarter circle may be hidden by other ink."""

TRIMS = 3
"""Rounds of fitting a circle and leaving out what strays most."""

ON_ARC = 0.7
"""Share of a stroke's pixels that must lie on the circle."""

AROUND = 0.5
"""Share of the rest of its circle with ink on it from which an arc is no swing."""

FEWEST_PX = 8
"""Fewest pixels of a stroke to which a circle is fitted."""

FAR_OFF = 4.0
"""Typical stray, in allowed ones, from which trimming cannot save a fit."""

FLATTEST = 0.25
"""Least width over length of the box around a swing or two, or most of one."""

MOST_STROKES = 2000
"""Strokes that are tried, the longest first: bounds the time on a page of noise."""


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


@dataclass(frozen=True, eq=False)
class _Search:
    """Thin strokes, the radii looked for (px), and how far an arc may stray."""

    thin: ByteArray
    low: float
    high: float
    fit: float

    def stray_px(self, radius: float) -> float:
        return max(self.fit * radius, 1.0)


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
    search = _Search(thin, *m.radius, fit)
    length = max(STRAIGHT_PX * m.scale, STRAIGHT_SHARE * m.extent)
    straight = opened(thin, box(length, 1)) | opened(thin, box(1, length))
    bent = thin & ~straight
    # Grown back over the lines that an arc crosses; but there two arcs may merge.
    whole = thin & dilated(bent, box(m.line + 1))
    swings: list[Swing] = []
    for mask in (bent, whole):
        for cols, rows in _strokes(mask, search, m.line):
            swings += _swings_of(search, cols, rows)
    return _distinct(swings)


def _strokes(
    mask: ByteArray, search: _Search, line_px: int
) -> Iterator[tuple[IntArray, IntArray]]:
    """Yield columns and rows of the pixels of each stroke of a likely size."""
    parts = components(mask)
    size = parts.longest
    likely = (size >= search.low / 2) & (size <= 1.1 * search.high)
    likely &= (parts.area >= FEWEST_PX) & (parts.area <= 3 * line_px * size)
    # Two quarter circles in a row are twice as long as wide; a line is much longer.
    likely &= np.minimum(parts.width, parts.height) >= FLATTEST * size
    likely[0] = False
    order = np.flatnonzero(likely)
    order = order[np.argsort(-size[order], kind="stable")][:MOST_STROKES]
    for index in order:
        left, top = int(parts.left[index]), int(parts.top[index])
        right, bottom = left + int(parts.width[index]), top + int(parts.height[index])
        rows, cols = np.nonzero(parts.labels[top:bottom, left:right] == index)
        yield cols + left, rows + top


def _swings_of(search: _Search, cols: IntArray, rows: IntArray) -> list[Swing]:
    """Return the swing that a stroke is, or the two that meet in it: double doors."""
    whole = _swing(search, cols, rows)
    if whole:
        return [whole]
    along, across = (cols, rows) if np.ptp(cols) > np.ptp(rows) else (rows, cols)
    long, wide = int(np.ptp(along)), int(np.ptp(across))
    if not 1.5 * wide <= long <= 3 * wide:
        return []
    first = along < (along.min() + along.max()) / 2
    halves = (_swing(search, cols[half], rows[half]) for half in (first, ~first))
    return [swing for swing in halves if swing]


def _distinct(swings: list[Swing]) -> tuple[Swing, ...]:
    """Drop repeated finds of one swing: those whose middles of arc coincide."""
    kept: list[Swing] = []
    for swing in swings:
        x, y = swing.middle
        apart = [
            np.hypot(x - other.middle[0], y - other.middle[1]) > 0.3 * swing.radius_px
            for other in kept
        ]
        if all(apart):
            kept.append(swing)
    return tuple(kept)


def _swing(search: _Search, cols: IntArray, rows: IntArray) -> Swing | None:
    """Fit a circle to part of an arc, then to all of it; None where there is none."""
    first = _fitted(search, cols, rows)
    if first is None:
        return None
    towards = np.arctan2(rows.mean() - first[1], cols.mean() - first[0])
    cols, rows = _near_arc(search, first, float(towards))
    second = _fitted(search, cols, rows)
    swing = _with_span(cols, rows, second) if second else None
    return None if swing is None or _goes_on(search, swing) else swing


def _goes_on(search: _Search, swing: Swing) -> bool:
    """Whether ink goes on around the circle: a table, not a door."""
    rest = 2 * np.pi - (swing.end_rad - swing.start_rad)
    bearing = swing.end_rad + rest * np.linspace(0.15, 0.85, 48)
    stray = search.stray_px(swing.radius_px)
    radius = swing.radius_px + np.linspace(-stray, stray, 5)[:, None]
    cols = np.rint(swing.x_px + radius * np.cos(bearing)).astype(np.int64)
    rows = np.rint(swing.y_px + radius * np.sin(bearing)).astype(np.int64)
    height, width = search.thin.shape
    inside = (rows >= 0) & (rows < height) & (cols >= 0) & (cols < width)
    ink = search.thin[np.where(inside, rows, 0), np.where(inside, cols, 0)] > 0
    return bool(np.mean(np.any(ink & inside, axis=0)) > AROUND)


def _near_arc(
    search: _Search, circle: tuple[float, float, float], towards_rad: float
) -> tuple[IntArray, IntArray]:
    """Return columns and rows of the pixels along a quarter circle or so."""
    x, y, radius = circle
    reach = int(1.5 * radius)
    left, top = max(int(x) - reach, 0), max(int(y) - reach, 0)
    right, bottom = max(int(x) + reach + 1, 0), max(int(y) + reach + 1, 0)
    rows, cols = np.nonzero(search.thin[top:bottom, left:right])
    dx, dy = cols + left - x, rows + top - y
    turn = np.arctan2(dy, dx) - towards_rad
    turn = np.abs((turn + np.pi) % (2 * np.pi) - np.pi)
    near = np.abs(np.hypot(dx, dy) - radius) < 2 * search.stray_px(radius)
    near &= turn < SPAN_RAD[1] / 2
    return cols[near] + left, rows[near] + top


def _fitted(
    search: _Search, cols: IntArray, rows: IntArray
) -> tuple[float, float, float] | None:
    """Fit a circle to most of the pixels: centre and radius; None where none fits.

    What hangs on an arc's ends is left out of the fit, round by round.
    """
    if len(cols) < FEWEST_PX:
        return None
    origin = float(cols.mean()), float(rows.mean())
    x = np.asarray(cols - origin[0], dtype=np.float64)
    y = np.asarray(rows - origin[1], dtype=np.float64)
    kept = np.ones(len(x), dtype=bool)
    for _ in range(TRIMS):
        cx, cy, radius = _circle(x[kept], y[kept])
        stray = np.abs(np.hypot(x - cx, y - cy) - radius)
        middle = float(np.partition(stray, len(stray) // 2)[len(stray) // 2])
        if middle > FAR_OFF * search.stray_px(radius):
            return None
        kept = stray <= max(search.stray_px(radius), middle)
    on_arc = np.count_nonzero(stray <= search.stray_px(radius)) / len(x)
    if on_arc < ON_ARC or not search.low <= radius <= search.high:
        return None
    return cx + origin[0], cy + origin[1], radius


def _circle(x: FloatArray, y: FloatArray) -> tuple[float, float, float]:
    """Return centre and radius of the circle of least squares (Kasa's fit)."""
    square = x * x + y * y
    ones = np.ones_like(x)
    system = np.asarray([2 * x, 2 * y, ones])
    normal = system @ system.T
    normal[np.diag_indices(3)] += 1e-9 * normal.trace()  # pixels in one line
    cx, cy, c = np.linalg.solve(normal, system @ square)
    return float(cx), float(cy), float(np.sqrt(max(c + cx * cx + cy * cy, 0.0)))


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

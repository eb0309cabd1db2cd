"""Doors: quarter circles among thin strokes, and the leaves at their ends."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import ByteArray, FloatArray
from occsim.walls.raster import Components, box, components, flipped, opened
from occsim.walls.strokes import Measures, level_lines

RADIUS = 2.0, 16.0
"""Shortest and longest leaf, in usual walls."""

STRAIGHT = 1.5
"""Length from which a stroke is straight, in usual walls: arcs bend before."""

STRAIGHT_SHARE = 0.03
"""The same as a share of the longer side: thin walls say little of doors."""

ON_ARC = 0.7
"""Share of a stroke's pixels that must lie on the circle."""

FLATTEST = 0.3
"""Least width over length of the box around an arc, or two arcs in a row."""

SPAN_RAD = np.radians(25.0), np.radians(100.0)
"""Angle that a swing's bent part covers; its ends, along rows, are straight."""

LEAF_SHARE = 0.12
"""Thickness of a leaf as drawn, as a share of its length; what is thicker is wall."""

LONGER = 1.3
"""Length from which a line is no leaf's, in usual leaves."""

LEAF_COVER = 0.8
"""Share of a leaf's length along which there must be ink."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Door:
    """A door leaf, standing open at one end of its swing.

    Parameters
    ----------
    x_px, y_px : float
        Hinge, pixel indices.
    radius_px : float
        Length of the leaf, px.
    open_rad, shut_rad : float
        Bearing of the leaf as drawn, and of the doorway that it closes.
    """

    x_px: float
    y_px: float
    radius_px: float
    open_rad: float
    shut_rad: float


def find_doors(
    ink: ByteArray, thin: ByteArray, m: Measures, fit: float
) -> tuple[Door, ...]:
    """Return the doors of an upright sheet.

    Parameters
    ----------
    ink : ndarray of uint8, shape (h, w)
        Ink.
    thin : ndarray of uint8, shape (h, w)
        What of it is no solid wall.
    m : Measures
        Lengths of the drawing.
    fit : float
        How far an arc may stray from a circle, share of its radius; 0 finds none.
    """
    if fit == 0:
        return ()
    length = max(STRAIGHT * m.wall, STRAIGHT_SHARE * max(ink.shape))
    straight = opened(thin, box(length, 1)) | opened(thin, box(1, length))
    parts = components(thin & ~straight)
    low, high = RADIUS[0] * m.wall, RADIUS[1] * m.wall
    likely = (parts.longest >= low / 3) & (parts.longest <= high)
    likely &= parts.area <= 3 * m.line * parts.longest
    # The middle of a quarter circle runs at about 45 degrees, as long as wide.
    shorter = np.minimum(parts.width, parts.height)
    likely &= (shorter >= FLATTEST * parts.longest) & (shorter > 2 * m.line)
    found = []
    for index in np.flatnonzero(likely):
        for x, y in _halves(*_pixels(parts, int(index))):
            swing = _swing(x, y, fit, m.line)
            door = _door(ink, swing, m.line) if swing else None
            if door and low <= door.radius_px <= high:
                found.append(door)
    return tuple(found)


def _halves(x: FloatArray, y: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
    """Return a stroke, or its halves if it may be the two arcs of a double door."""
    along, across = (x, y) if np.ptp(x) > np.ptp(y) else (y, x)
    if not 1.5 * np.ptp(across) <= np.ptp(along) <= 3 * np.ptp(across):
        return [(x, y)]
    first = along < (along.min() + along.max()) / 2
    return [(x[first], y[first]), (x[~first], y[~first])]


def _pixels(parts: Components, index: int) -> tuple[FloatArray, FloatArray]:
    """Return x and y of the pixels of a component."""
    left, top = int(parts.left[index]), int(parts.top[index])
    window = parts.labels[
        top : top + int(parts.height[index]), left : left + int(parts.width[index])
    ]
    rows, cols = np.nonzero(window == index)
    return np.asarray(cols + float(left)), np.asarray(rows + float(top))


def _swing(
    x: FloatArray, y: FloatArray, fit: float, line_px: int
) -> tuple[float, float, float, float] | None:
    """Return hinge, radius and middle bearing of the arc that pixels make, or None."""
    kept = np.ones(len(x), dtype=bool)
    for _ in range(3):  # what hangs on an arc is left out round by round
        cx, cy, radius = _circle(x[kept], y[kept])
        stray = np.abs(np.hypot(x - cx, y - cy) - radius)
        kept = stray <= max(fit * radius + line_px / 2, float(np.median(stray)))
    on_arc = stray <= fit * radius + line_px / 2
    if np.mean(on_arc) < ON_ARC:
        return None
    x, y = x[on_arc], y[on_arc]
    bearing = np.arctan2(y - cy, x - cx)
    middle = float(np.arctan2(np.sin(bearing).mean(), np.cos(bearing).mean()))
    apart = np.abs((bearing - middle + np.pi) % (2 * np.pi) - np.pi)
    if not SPAN_RAD[0] <= 2 * np.percentile(apart, 95) <= SPAN_RAD[1]:
        return None
    return cx, cy, radius, middle


def _circle(x: FloatArray, y: FloatArray) -> tuple[float, float, float]:
    """Return centre and radius of the circle of least squares (Kasa's fit)."""
    origin = x.mean(), y.mean()
    x, y = x - origin[0], y - origin[1]
    system = np.stack([2 * x, 2 * y, np.ones_like(x)])
    normal = system @ system.T
    normal[np.diag_indices(3)] += 1e-9 * normal.trace()  # pixels in one line
    cx, cy, c = np.linalg.solve(normal, system @ (x * x + y * y))
    radius = float(np.sqrt(max(c + cx * cx + cy * cy, 0.0)))
    return float(cx + origin[0]), float(cy + origin[1]), radius


def _door(
    ink: ByteArray, swing: tuple[float, float, float, float], line_px: int
) -> Door | None:
    """Return the door of a swing: its leaf stands at the end where there is ink."""
    x, y, radius, middle = swing
    middle = np.round(middle / (np.pi / 2) - 0.5) * np.pi / 2 + np.pi / 4
    ends = middle - np.pi / 4, middle + np.pi / 4
    doors = [
        Door(x_px=x, y_px=y, radius_px=radius, open_rad=ends[i], shut_rad=ends[1 - i])
        for i in (0, 1)
    ]
    cover = [_cover(ink, door, line_px) for door in doors]
    best = int(np.argmax(cover))
    return doors[best] if cover[best] >= LEAF_COVER else None


def _cover(ink: ByteArray, door: Door, line_px: int) -> float:
    """Return the share of a leaf's length in which there is ink."""
    half = LEAF_SHARE * door.radius_px + line_px
    along = np.arange(0.2, 0.95, 1 / door.radius_px) * door.radius_px
    across = np.arange(-half, half + 0.5)
    cos, sin = np.cos(door.open_rad), np.sin(door.open_rad)
    cols = np.rint(door.x_px + along[:, None] * cos - across * sin).astype(np.int64)
    rows = np.rint(door.y_px + along[:, None] * sin + across * cos).astype(np.int64)
    inside = (rows >= 0) & (rows < ink.shape[0]) & (cols >= 0) & (cols < ink.shape[1])
    on_ink = ink[np.where(inside, rows, 0), np.where(inside, cols, 0)] > 0
    return float(np.mean((on_ink & inside).any(axis=1)))


def leaves(ink: ByteArray, doors: tuple[Door, ...], m: Measures) -> ByteArray:
    """Return the ink of door leaves; what is thicker than a leaf is left out."""
    mask = np.zeros_like(ink)
    for door in doors:
        half = LEAF_SHARE * door.radius_px + m.line
        _band(mask, door, door.open_rad, (0.04, 1.08), half)
    if not doors:
        return mask
    usual = float(np.median([door.radius_px for door in doors]))
    thick = opened(ink, box(LEAF_SHARE * usual + m.line))
    # A leaf that stands along a wall must not take the wall's face with it.
    longer = level_lines(ink, LONGER * usual)
    longer |= flipped(level_lines(flipped(ink), LONGER * usual))
    return mask & ink & ~thick & ~longer


def doorways_of(shape: tuple[int, int], doors: tuple[Door, ...]) -> ByteArray:
    """Return where the leaves would stand if they were shut."""
    mask = np.zeros(shape, np.uint8)
    for door in doors:
        _band(mask, door, door.shut_rad, (0.1, 0.9), 2 * LEAF_SHARE * door.radius_px)
    return mask


def _band(
    mask: ByteArray,
    door: Door,
    bearing: float,
    reach: tuple[float, float],
    half_px: float,
) -> None:
    """Set the pixels of a band along a radius in a mask that the caller has made."""
    along = np.array([np.cos(bearing), np.sin(bearing)])
    across = half_px * np.array([-along[1], along[0]])
    near, far = (
        np.array([door.x_px, door.y_px]) + r * door.radius_px * along for r in reach
    )
    corners = np.array([near - across, far - across, far + across, near + across])
    cv2.fillConvexPoly(mask, np.rint(corners).astype(np.int32), 1)

"""A plan: walls with openings, from which drawing and ground truth both come.

One set of sub-pixel masks holds the structure. The drawing renders it in the wall
style of the office that drew it; the ground truth reduces the same masks, so that the
two are registered exactly: a pixel is wall if walls cover at least half of it.
"""

from dataclasses import dataclass
from enum import Enum

import cv2
import numpy as np

from .sheet import (
    BLACK,
    HAIR,
    MEDIUM,
    PAPER,
    SCALE,
    THIN,
    Point,
    Sheet,
    convex_mask,
)

FACE_PEN = 0.95  # px, the line along each face of an outlined wall


class Style(Enum):
    """How a wall that is cut is shown."""

    SOLID = "filled black"
    HOLLOW = "two lines"
    GREY = "two lines, grey between them"
    HATCHED = "two lines, hatched between them"


@dataclass(frozen=True)
class Layer:
    """Walls of one style; `mask` covers them before openings are cut."""

    style: Style
    mask: np.ndarray


def perpendicular(direction: Point) -> Point:
    """Unit vector to the right of `direction` as seen on screen."""
    return -direction[1], direction[0]


def along(point: Point, direction: Point, distance: float) -> Point:
    """Go `distance` px from `point`."""
    return point[0] + direction[0] * distance, point[1] + direction[1] * distance


def unit(start: Point, end: Point) -> Point:
    """Direction from `start` to `end`."""
    delta = np.subtract(end, start)
    return tuple(float(v) for v in delta / np.hypot(*delta))


def strip(start: Point, end: Point, thickness: float) -> list[Point]:
    """Corners of a band of the given thickness about the segment start-end."""
    side = perpendicular(unit(start, end))
    half = thickness / 2
    return [
        along(start, side, half),
        along(end, side, half),
        along(end, side, -half),
        along(start, side, -half),
    ]


class Plan:
    """A sheet and the structure on it."""

    def __init__(self, width: int, height: int):
        self.sheet = Sheet(width, height)
        self.layers: list[Layer] = []
        self.doorways = self._blank()
        self.glazing = self._blank()
        self._fittings: list[tuple] = []

    def _blank(self) -> np.ndarray:
        return np.zeros(self.sheet.ink.shape, bool)

    def _cover(self, corners: list[Point]) -> np.ndarray:
        return convex_mask(self.sheet.ink.shape, corners)

    def walls(self, style: Style, boxes=(), polygons=()):
        """Add walls: upright boxes (x0, y0, x1, y1) and convex polygons, merged."""
        mask = self._blank()
        for x0, y0, x1, y1 in boxes:
            rows = slice(round(y0 * SCALE), round(y1 * SCALE))
            mask[rows, round(x0 * SCALE) : round(x1 * SCALE)] = True
        for corners in polygons:
            mask |= self._cover(corners)
        self.layers.append(Layer(style, mask))

    def opening(self, start: Point, end: Point, thickness: float):
        """Cut a doorway of the wall's thickness from start to end on its axis."""
        self.doorways |= self._cover(strip(start, end, thickness))

    def door(self, hinge: Point, jamb: Point, swing: Point, thickness: float):
        """Hang a door leaf at `hinge`, shutting on `jamb`; `swing` points into the room
        that it opens to (a unit vector across the wall)."""
        self.opening(hinge, jamb, thickness)
        self._fittings.append(("leaf", hinge, jamb, swing, thickness))

    def double_door(self, start: Point, end: Point, swing: Point, thickness: float):
        """Hang two leaves that meet half-way between start and end."""
        middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        self.door(start, middle, swing, thickness)
        self.door(end, middle, swing, thickness)

    def window(self, start: Point, end: Point, thickness: float):
        """Glaze the wall from start to end on its axis; it stays wall in the truth."""
        self.glazing |= self._cover(strip(start, end, thickness))
        self._fittings.append(("window", start, end, None, thickness))

    def render_structure(self):
        """Draw walls, then doors and windows, over what is on the sheet."""
        cut = self.doorways | self.glazing
        for layer in self.layers:
            self._render_walls(layer.style, layer.mask & ~cut)
        for kind, start, end, swing, thickness in self._fittings:
            if kind == "window":
                self._render_window(start, end, thickness)
            else:
                self._render_leaf(start, end, swing, thickness)

    def _render_walls(self, style: Style, mask: np.ndarray):
        if style is Style.SOLID:
            self.sheet.fill(mask, BLACK)
            return
        size = 2 * round(FACE_PEN * SCALE) + 1
        core = cv2.erode(mask.astype(np.uint8), np.ones((size, size), np.uint8)) > 0
        self.sheet.fill(mask, BLACK)
        self.sheet.fill(core, 185 if style is Style.GREY else PAPER)
        if style is Style.HATCHED:
            self.sheet.hatch(core, spacing=2.6)

    def _render_window(self, start: Point, end: Point, thickness: float):
        frame = strip(start, end, thickness - THIN)
        self.sheet.polygon(frame, THIN, PAPER)
        glass = strip(start, end, thickness / 3)
        self.sheet.polyline(glass[:2], HAIR)
        self.sheet.polyline(glass[2:], HAIR)

    def _render_leaf(self, hinge: Point, jamb: Point, swing: Point, thickness: float):
        across = unit(hinge, jamb)
        width = float(np.hypot(*np.subtract(jamb, hinge)))
        foot = along(hinge, swing, thickness / 2)
        tip = along(foot, swing, width)
        angles = np.linspace(0, np.pi / 2, 24)
        arc = [
            along(along(foot, across, width * np.cos(t)), swing, width * np.sin(t))
            for t in angles
        ]
        self.sheet.polyline(arc, HAIR)
        leaf = max(1.2, width / 20)  # px, a real leaf is about 1/20 of its width
        inner = along(foot, across, leaf), along(tip, across, leaf)
        self.sheet.polygon([foot, tip, inner[1], inner[0]], MEDIUM * 0.6, PAPER)

    def truth(self) -> np.ndarray:
        """(H, W) bool: wall where structure covers at least half of the pixel."""
        wall = np.any([layer.mask for layer in self.layers], axis=0) & ~self.doorways
        height, width = self.sheet.height, self.sheet.width
        blocks = wall.reshape(height, SCALE, width, SCALE)
        return blocks.sum((1, 3), dtype=int) * 2 >= SCALE**2

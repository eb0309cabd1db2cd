"""A sheet of paper drawn at eight times its size and reduced: anti-aliased ink.

Coordinates are pixels of the finished picture, x right, y down, origin at the outer
corner of the top-left pixel, as everywhere in the project. Pen widths are in the same
pixels. Ink levels run from 0 (black) to 255 (paper).
"""

from functools import lru_cache
from math import cos, pi, radians, sin

import cv2
import numpy as np
from PIL import Image, ImageDraw, ImageFont

SCALE = 8  # sub-pixels along a pixel's side
HAIR, THIN, MEDIUM, BOLD = 0.6, 0.8, 1.1, 1.6  # pens, px
BLACK, PAPER = 0, 255

Point = tuple[float, float]


def turned(point: Point, degrees: float, about: Point = (0.0, 0.0)) -> Point:
    """Turn `point` clockwise on screen."""
    c, s = cos(radians(degrees)), sin(radians(degrees))
    x, y = point
    return about[0] + c * x - s * y, about[1] + s * x + c * y


def arc_points(centre: Point, radius: float, start: float, end: float, n: int = 24):
    """Points along a circular arc; angles in degrees from +x towards +y."""
    angles = np.radians(np.linspace(start, end, n))
    return [(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in angles]


def convex_mask(shape: tuple[int, int], corners: list[Point]) -> np.ndarray:
    """Sub-pixels whose centres lie in a convex polygon; shape is that of the mask."""
    points = np.asarray(corners, float) * SCALE
    low = np.clip(np.floor(points.min(0)).astype(int), 0, None)
    high = np.minimum(np.ceil(points.max(0)).astype(int), shape[::-1])
    mask = np.zeros(shape, bool)
    x = np.arange(low[0], high[0]) + 0.5
    y = (np.arange(low[1], high[1]) + 0.5)[:, None]
    side = [
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        for (ax, ay), (bx, by) in zip(points, np.roll(points, -1, 0), strict=True)
    ]
    inside = np.all([s >= 0 for s in side], 0) | np.all([s <= 0 for s in side], 0)
    mask[low[1] : high[1], low[0] : high[0]] = inside
    return mask


@lru_cache(maxsize=512)
def lettering(words: str, height: float, turn: int) -> np.ndarray:
    """Ink of a line of text as a bool array in sub-pixels, turned counter-clockwise."""
    font = ImageFont.load_default(size=height * SCALE)
    left, top, right, bottom = font.getbbox(words)
    image = Image.new("L", (int(right - left) + 2, int(bottom - top) + 2))
    ImageDraw.Draw(image).text((1 - left, 1 - top), words, fill=255, font=font)
    return np.asarray(image.rotate(turn, expand=True)) > 127


class Sheet:
    """Paper of `width` x `height` px; everything is drawn opaquely, in order."""

    def __init__(self, width: int, height: int):
        self.width, self.height = width, height
        self.ink = np.full((height * SCALE, width * SCALE), PAPER, np.uint8)

    def polyline(self, points, pen=THIN, level=BLACK, closed=False):
        """Stroke a path."""
        fixed = np.round(np.asarray(points, float) * SCALE - 0.5).astype(np.int32)
        width = max(1, round(pen * SCALE))
        cv2.polylines(self.ink, [fixed], closed, int(level), width)

    def line(self, start: Point, end: Point, pen=THIN, level=BLACK):
        """Stroke one straight line."""
        self.polyline([start, end], pen, level)

    def dashed(self, start: Point, end: Point, dash=(4.0, 2.5), pen=HAIR, level=BLACK):
        """Stroke alternating dashes and gaps of the lengths in `dash`, in turn."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        length = float(np.hypot(*(b - a)))
        at, turn = 0.0, 0
        while at < length:
            to = min(at + dash[turn % len(dash)], length)
            if turn % 2 == 0:
                unit = (b - a) / length
                self.line(tuple(a + unit * at), tuple(a + unit * to), pen, level)
            at, turn = to, turn + 1

    def polygon(self, points, pen=THIN, fill=None, level=BLACK):
        """Fill (a grey level, or not at all) and outline."""
        if fill is not None:
            fixed = np.round(np.asarray(points, float) * SCALE - 0.5).astype(np.int32)
            cv2.fillPoly(self.ink, [fixed], int(fill))
        if pen:
            self.polyline(points, pen, level, closed=True)

    def rect(self, x0, y0, x1, y1, pen=THIN, fill=None, level=BLACK):
        """Outline, and fill if asked, an upright rectangle."""
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        self.polygon(corners, pen, fill, level)

    def circle(self, centre: Point, radius: float, pen=THIN, fill=None):
        """Outline, and fill if asked, a circle."""
        self.polygon(arc_points(centre, radius, 0, 360, 48)[:-1], pen, fill)

    def ellipse(self, centre: Point, rx: float, ry: float, turn=0.0, pen=THIN):
        """Outline an ellipse whose first axis is turned by `turn` degrees."""
        ring = [(rx * cos(t), ry * sin(t)) for t in np.linspace(0, 2 * pi, 49)[:-1]]
        self.polygon([turned(p, turn, centre) for p in ring], pen, PAPER)

    def text(self, x, y, words, height=8.0, turn=0, halo=0.0, level=BLACK):
        """Set a line of text centred on (x, y); `halo` px of paper round its box."""
        stamp = lettering(words, height, turn)
        rows, cols = stamp.shape
        top, left = round(y * SCALE - rows / 2), round(x * SCALE - cols / 2)
        if halo:
            pad = round(halo * SCALE)
            box = np.s_[
                max(top - pad, 0) : top + rows + pad,
                max(left - pad, 0) : left + cols + pad,
            ]
            self.ink[box] = PAPER
        self.ink[top : top + rows, left : left + cols][stamp] = level

    def fill(self, mask: np.ndarray, level: int):
        """Paint the sub-pixels of `mask`."""
        self.ink[mask] = level

    def hatch(self, mask, spacing=3.0, slope=1, pen=HAIR, level=BLACK):
        """Rule 45-degree lines over `mask`; spacing is measured across the lines."""
        rows, cols = np.nonzero(mask)
        period = spacing * SCALE * 2**0.5
        ruled = (cols + slope * rows) % period < pen * SCALE * 2**0.5
        self.ink[rows[ruled], cols[ruled]] = level

    def tiles(self, x0, y0, x1, y1, side, pen=HAIR, level=150):
        """Rule a square grid of floor tiles."""
        for x in np.arange(x0 + side, x1 - 1, side):
            self.line((x, y0), (x, y1), pen, level)
        for y in np.arange(y0 + side, y1 - 1, side):
            self.line((x0, y), (x1, y), pen, level)

    def picture(self) -> np.ndarray:
        """The finished drawing, (H, W) uint8."""
        size = (self.width, self.height)
        return cv2.resize(self.ink, size, interpolation=cv2.INTER_AREA)

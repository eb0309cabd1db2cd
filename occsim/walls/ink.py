"""From colours to ink: how dark each pixel is beside the paper around it."""

import cv2
import numpy as np

from occsim._types import ByteArray
from occsim.walls.measures import Measures
from occsim.walls.raster import as_bytes, box, components, dilated, opened
from occsim.walls.runs import line_thickness

SMALL_SIDE_PX = 160
"""Shorter side to which a picture is reduced to find its paper, px."""

WINDOW_SHARE = 1 / 8
"""Automatic window for shadows, share of the shorter side: wider than any wall."""

OTSU_SHARE = 0.85
"""Ink begins below Otsu's threshold: half-covered pixels of hairlines count."""

FAINTEST_INK = 30
"""Darkness below which nothing is ink, of 255: paper grain and compression noise."""

FAINTEST_FILL = 20
"""Darkness below which no area is a fill, of 255."""

BLURRED_LINE_SHARE = 0.012
"""Thickest line with its blurred edges, as a share of the shorter side."""

FAT_SHARE = 0.08
"""Thickness from which a fill is a room's, as a share of the shorter side."""

MOSTLY_FAT = 0.3
"""Share of a fill's area so thick from which all of it is a room's."""

EVEN_PAPER = 3
"""Spread of the paper's brightness up to which it is taken for even, of 255."""


def darkness(rgb: ByteArray, window_px: float = 0.0) -> ByteArray:
    """Return how dark each pixel is beside the paper around it.

    A pixel's darkness is that of its darkest channel, so that red and grey walls count
    like black ones. Drawings in white on black are inverted.

    Parameters
    ----------
    rgb : ndarray of uint8, shape (H, W, 3)
        The drawing.
    window_px : float, default 0
        Window over which the paper's brightness is followed; 0 for automatic.

    Returns
    -------
    ndarray of uint8, shape (H, W)
        0 for paper, 255 for black.
    """
    height, width = rgb.shape[:2]
    factor = max(1, min(height, width) // SMALL_SIDE_PX)
    size = max(width // factor, 1), max(height // factor, 1)
    small = cv2.resize(rgb, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
    if np.median(small) < 128:
        rgb, small = 255 - rgb, 255 - small
    window = window_px / factor or min(small.shape[:2]) * WINDOW_SHARE
    paper = _paper(small, max(round(window), 3))
    if np.ptp(paper.reshape(-1, 3), axis=0).max() <= EVEN_PAPER:
        full = np.broadcast_to(paper[0, 0], rgb.shape).copy()
    else:
        full = np.asarray(cv2.resize(paper, (width, height)), dtype=np.uint8)
    share = np.asarray(cv2.divide(rgb, full, scale=255))
    red, green, blue = cv2.split(share)
    return np.asarray(255 - cv2.min(cv2.min(red, green), blue), dtype=np.uint8)


def _paper(small: ByteArray, window: int) -> ByteArray:
    """Return the brightness of the paper over a reduced picture, (h, w, 3)."""
    kernel = np.ones((window, window), np.uint8)
    brightest = np.asarray(cv2.morphologyEx(small, cv2.MORPH_CLOSE, kernel))
    usual = np.median(brightest.reshape(-1, 3), axis=0)
    # Darker than half the usual paper is a large dark fill, not a shadow.
    light = np.where(brightest < usual / 2, usual, brightest).astype(np.uint8)
    smooth = np.asarray(cv2.blur(light, (window, window)), dtype=np.uint8)
    return np.maximum(smooth, 1)


def ink_threshold(dark: ByteArray, level: float = 0.0) -> float:
    """Return the darkness from which a pixel is ink, of 255."""
    if level:
        return 255 * level
    otsu, _ = cv2.threshold(dark, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)
    return max(OTSU_SHARE * float(otsu), FAINTEST_INK)


def find_ink(dark: ByteArray, level: float = 0.0) -> ByteArray:
    """Return the pixels that are ink."""
    return as_bytes(dark > ink_threshold(dark, level))


def find_fills(
    dark: ByteArray, letters: ByteArray, m: Measures, level: float = 0.0
) -> ByteArray:
    """Return grey and coloured areas that are thick enough, and thin enough, for walls.

    Parameters
    ----------
    dark : ndarray of uint8, shape (h, w)
        Darkness.
    letters : ndarray of uint8, shape (h, w)
        Text and symbols.
    m : Measures
        Lengths of the drawing.
    level : float, default 0
        Darkness from which an area is filled, in [0, 1); 0 for automatic.
    """
    calm = np.asarray(cv2.medianBlur(dark, 3), dtype=np.uint8)
    calm *= 1 - dilated(letters, box(5))
    grain = 2 * _percentile(dark, 60)  # drawings are mostly paper
    threshold = 255 * level or max(FAINTEST_FILL, grain)
    blur = max(3.0 * m.scale, BLURRED_LINE_SHARE * m.extent)
    line_px = line_thickness(as_bytes(calm > threshold), blur)
    areas = _thick_tone(calm, threshold, max(m.thin, line_px + 2))
    fat = opened(areas, box(FAT_SHARE * m.extent))
    parts = components(areas)
    rooms = parts.chosen(parts.total(fat) > MOSTLY_FAT * parts.area)
    return areas & ~rooms & ~dilated(fat, box(3))


def _percentile(levels: ByteArray, percent: float) -> float:
    """Return the level that so many percent of the pixels do not exceed."""
    counts = np.cumsum(np.bincount(levels.ravel(), minlength=256))
    return float(np.searchsorted(counts, percent / 100 * counts[-1]))


def _thick_tone(dark: ByteArray, threshold: float, size_px: float) -> ByteArray:
    """Return what is darker than paper all over a box of the given size.

    A wall filled with grey between two black lines passes, a line or a letter of the
    same darkness does not.
    """
    level = opened(dark, box(size_px))
    # Blurred edges are cut at half the level beside them.
    half = dilated(level, box(3)) // 2
    return as_bytes((level > threshold) & (dark >= half))

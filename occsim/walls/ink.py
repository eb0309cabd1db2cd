"""From colours to ink: how dark each pixel is beside the paper around it."""

import cv2
import numpy as np

from occsim._types import ByteArray
from occsim.walls.raster import as_bytes

SMALL_SIDE_PX = 160
"""Shorter side to which a picture is reduced to find its paper, px."""

WINDOW_SHARE = 1 / 8
"""Automatic window for shadows, share of the shorter side: wider than any wall."""

OTSU_SHARE = 0.7
"""Ink begins below Otsu's threshold: half-covered pixels of hairlines count."""

FAINTEST_INK = 30
"""Darkness below which nothing is ink, of 255: paper grain and compression noise."""

FAINTEST_FILL = 20
"""Darkness below which no area is a fill, of 255."""

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
    return np.asarray(255 - share.min(axis=2), dtype=np.uint8)


def _paper(small: ByteArray, window: int) -> ByteArray:
    """Return the brightness of the paper over a reduced picture, (h, w, 3)."""
    brightest = np.asarray(cv2.dilate(small, np.ones((window, window), np.uint8)))
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


def find_tone(dark: ByteArray, level: float = 0.0) -> ByteArray:
    """Return the pixels that are darker than paper, light fills among them."""
    grain = 2 * float(np.percentile(dark, 60))  # drawings are mostly paper
    threshold = 255 * level if level else max(FAINTEST_FILL, grain)
    return as_bytes(np.asarray(cv2.blur(dark, (3, 3))) > threshold)

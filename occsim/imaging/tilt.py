"""How far a scanned or photographed drawing is turned."""

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.imaging.drawing import Drawing
from occsim.imaging.transform import Transform

MAX_TILT_RAD = np.radians(12.0)
"""Largest tilt that `estimate_tilt` looks for; a larger one is taken as intended."""

# A smaller picture gives the same tilt in less time. Walls of a thousand px move by a
# pixel in 0.06 degrees.
_TILT_SIDE_PX = 1000
_TILT_POINTS = 20_000
_COARSE_STEP_RAD = np.radians(0.25)
_FINE_STEP_RAD = np.radians(0.03)
# An edge changes brightness by this much from pixel to pixel, of 255.
_EDGE_CONTRAST = 24.0
_FEWEST_EDGES = 200
# Edge pixels in rows at the best angle against those at a usual angle.
_CLEAR_PEAK = 1.3
# Share of the peak's height above which its centre is taken.
_PEAK_FLOOR = 0.8
# Blur that hides the steps of oblique lines, px, and how far from the direction of
# most contrast the lines may then lie.
_STEPS_PX = 3.0
_HISTOGRAM_ERROR_RAD = np.radians(2.0)


def estimate_tilt(drawing: Drawing) -> float | None:
    """Return by how much a scanned or photographed drawing is turned.

    Parameters
    ----------
    drawing : Drawing
        Any size; most of its long lines at right angles to each other.

    Returns
    -------
    float or None
        Direction, from +x towards +y, of the lines that should be horizontal, rad;
        within `MAX_TILT_RAD` either way. None where no direction stands out.

    Notes
    -----
    At the right angle, the edges of horizontal lines, seen along them, gather in few
    rows, and those of vertical lines in few columns. The angle of the largest sum of
    squared row and column counts is sought, in steps of 0.25 and then 0.03 degrees.
    """
    small = Transform.fit(drawing.shape, _TILT_SIDE_PX).drawing(drawing)
    return _sought(small.gray, 0.0, MAX_TILT_RAD, _CLEAR_PEAK)


def main_direction(gray: ByteArray) -> float:
    """Return the direction of most of a drawing's lines, however it is turned.

    Parameters
    ----------
    gray : ndarray of uint8, shape (H, W)
        Brightness or darkness.

    Returns
    -------
    float
        From +x towards +y, modulo a right angle, rad in [-pi/4, pi/4); 0 where there
        is no line.

    Notes
    -----
    A histogram of the directions of contrast gives the angle to about a degree; the
    search of `estimate_tilt` around it gives the rest.
    """
    scale = min(1.0, _TILT_SIDE_PX / max(gray.shape))
    size = [max(1, round(side * scale)) for side in gray.shape[::-1]]
    small = cv2.resize(gray, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
    coarse = direction_peaks(small)
    if not coarse:
        return 0.0
    # One clear histogram peak is enough: the search only makes it finer.
    fine = _sought(small, coarse[0], _HISTOGRAM_ERROR_RAD, 1.0)
    best = coarse[0] if fine is None else fine
    return (best + np.pi / 4) % (np.pi / 2) - np.pi / 4


def direction_peaks(gray: ByteArray, least_share: float = 1.0) -> list[float]:
    """Return the directions in which contrast gathers, the strongest first.

    Parameters
    ----------
    gray : ndarray of uint8, shape (H, W)
        Brightness or darkness.
    least_share : float, default 1
        Height, as a share of the highest peak, from which a peak counts.

    Returns
    -------
    list of float
        Modulo a right angle, rad in [-pi/4, pi/4), to about a degree.
    """
    smooth = cv2.GaussianBlur(gray, (0, 0), _STEPS_PX)
    across = cv2.Scharr(smooth, cv2.CV_32F, 1, 0)
    down = cv2.Scharr(smooth, cv2.CV_32F, 0, 1)
    strength, angle = cv2.cartToPolar(across, down, angleInDegrees=True)
    strong = strength > 0.2 * strength.max()
    if not strong.any():
        return []
    bins = (np.asarray(angle)[strong] * 4).astype(np.int64) % 360
    votes = np.bincount(bins, np.asarray(strength)[strong], 360)
    near = np.convolve(np.r_[votes[-4:], votes, votes[:4]], np.hanning(9), "valid")
    hills = near[:360]
    top = np.maximum.reduce([np.roll(hills, shift) for shift in range(-20, 21)])
    peaks = np.flatnonzero((hills == top) & (hills >= least_share * hills.max()))
    peaks = peaks[np.argsort(-hills[peaks], kind="stable")]
    degrees = (peaks + 0.5) / 4
    return [float(np.radians((one + 45) % 90 - 45)) for one in degrees]


def _sought(
    gray: ByteArray, about_rad: float, reach_rad: float, clear: float
) -> float | None:
    """Return the angle, around one, at which edges gather best in rows and columns."""
    level, upright = _edge_points(gray, about_rad)
    if len(level) + len(upright) < _FEWEST_EDGES:
        return None
    n_coarse = round(reach_rad / _COARSE_STEP_RAD)
    coarse = about_rad + np.arange(-n_coarse, n_coarse + 1) * _COARSE_STEP_RAD
    gathered = np.array([_gathering(level, upright, angle) for angle in coarse])
    best = coarse[int(np.argmax(gathered))]
    if gathered.max() < clear * np.median(gathered):
        return None
    n_fine = round(2.0 * _COARSE_STEP_RAD / _FINE_STEP_RAD)
    fine = best + np.arange(-n_fine, n_fine + 1) * _FINE_STEP_RAD
    gathered = np.array([_gathering(level, upright, angle) for angle in fine])
    # The centre of the peak, which short lines leave flat and jagged on top.
    weight = np.maximum(gathered - _PEAK_FLOOR * gathered.max(), 0.0)
    return float(fine @ weight / weight.sum())


def _edge_points(gray: ByteArray, about_rad: float) -> tuple[FloatArray, FloatArray]:
    """Return edge pixels of lines nearly along and nearly across, each (K, 2)."""
    across = cv2.Sobel(gray, cv2.CV_32F, 1, 0, scale=0.125)
    down = cv2.Sobel(gray, cv2.CV_32F, 0, 1, scale=0.125)
    cos, sin = np.float32(np.cos(about_rad)), np.float32(np.sin(about_rad))
    across, down = cos * across + sin * down, cos * down - sin * across
    # Well beyond the largest tilt; text and arcs at other angles stay out.
    slope = np.tan(2.0 * MAX_TILT_RAD)
    level = (np.abs(down) > _EDGE_CONTRAST) & (np.abs(across) < slope * np.abs(down))
    upright = (np.abs(across) > _EDGE_CONTRAST) & (
        np.abs(down) < slope * np.abs(across)
    )
    return _some_points(level), _some_points(upright)


def _some_points(mask: BoolArray) -> FloatArray:
    """Return x, y of the pixels, or of evenly spread ones where there are many."""
    pixels = np.flatnonzero(mask)
    # A golden-ratio stride does not fall in step with rows, as a fixed one could.
    if len(pixels) > _TILT_POINTS:
        spread = np.arange(_TILT_POINTS) * 0.6180339887498949 % 1.0
        pixels = pixels[np.unique((spread * len(pixels)).astype(np.int64))]
    rows, cols = np.divmod(pixels, mask.shape[1])
    return np.stack([cols, rows], axis=1).astype(np.float64)


def _gathering(level: FloatArray, upright: FloatArray, tilt_rad: float) -> float:
    """Return how much edges gather in rows and columns of a page turned so."""
    cos, sin = np.cos(tilt_rad), np.sin(tilt_rad)
    total = 0.0
    for points, normal in ((level, (-sin, cos)), (upright, (cos, sin))):
        if len(points):
            place = points @ np.array(normal)
            count = np.bincount((place - place.min()).astype(np.int64))
            total += float(count @ count)
    return total

"""The frame in which walls are looked for: enlarged if small, turned upright."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.walls.raster import as_bytes

SMALL_DRAWING_PX = 400_000
"""Pixels below which a drawing is enlarged: its walls are only a few pixels thick."""

LARGE_DRAWING_PX = 3_000_000
"""Pixels above which a drawing is reduced; its walls are many pixels thick."""

LEAST_TILT_DEG = 0.5
"""Tilt that is left as it is, degrees: turning blurs more than the tilt costs."""

BINS_PER_DEG = 10
SMOOTHING_PX = 3.0  # wide enough to hide the steps of lines drawn without grey


@dataclass(frozen=True, eq=False)
class Frame:
    """Working frame of a drawing and the way back.

    Parameters
    ----------
    dark : ndarray of uint8, shape (h, w)
        Darkness in the working frame.
    scale : float
        Working pixels along a pixel of the drawing.
    turn : ndarray of float64, shape (2, 3), or None
        Affine from the drawing's pixels to the frame's; None for no turn.
    shape : tuple of int
        Height and width of the drawing, px.
    """

    dark: ByteArray
    scale: float
    turn: FloatArray | None
    shape: tuple[int, int]

    def back(self, mask: ByteArray) -> BoolArray:
        """Return a mask of the working frame over the drawing's own pixels."""
        height, width = self.shape
        levels = as_bytes(mask) * np.uint8(255)
        if self.turn is not None:
            # Blurred as much as a reduction by area would do.
            reach = max(round(self.scale), 1)
            smooth = cv2.blur(levels, (reach, reach), anchor=(0, 0))
            flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
            levels = np.asarray(
                cv2.warpAffine(smooth, self.turn, (width, height), flags=flags)
            )
        elif self.scale != 1:
            how = cv2.INTER_AREA if self.scale > 1 else cv2.INTER_LINEAR
            levels = np.asarray(cv2.resize(levels, (width, height), interpolation=how))
        return levels > 127


def reduced(rgb: ByteArray) -> tuple[ByteArray, float]:
    """Return a drawing at a size that is worked on, and the factor; 1 if small."""
    height, width = rgb.shape[:2]
    if height * width <= LARGE_DRAWING_PX:
        return rgb, 1.0
    scale = float(np.sqrt(LARGE_DRAWING_PX / (height * width)))
    size = max(round(width * scale), 1), max(round(height * scale), 1)
    small = cv2.resize(rgb, size, interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8), scale


def working_frame(
    dark: ByteArray,
    straighten: bool = True,
    shape: tuple[int, int] | None = None,
) -> Frame:
    """Return the frame in which most walls run along rows and columns.

    Parameters
    ----------
    dark : ndarray of uint8, shape (h, w)
        Darkness of the drawing, or of a reduced copy.
    straighten : bool, default True
        Whether a tilt is looked for and taken out.
    shape : tuple of int, optional
        Height and width of the drawing where `dark` is reduced, px.
    """
    height, width = dark.shape
    shape = shape or (height, width)
    enlarged = 2 if dark.size < SMALL_DRAWING_PX else 1
    large = dark
    if enlarged > 1:
        size = width * enlarged, height * enlarged
        large = np.asarray(cv2.resize(dark, size, interpolation=cv2.INTER_CUBIC))
    scale = enlarged * width / shape[1]
    tilt_deg = tilt(dark, SMOOTHING_PX / enlarged) if straighten else 0.0
    if abs(tilt_deg) <= LEAST_TILT_DEG:
        return Frame(dark=large, scale=scale, turn=None, shape=shape)
    turned, turn = _turned(dark, tilt_deg, enlarged)
    if shape != (height, width):
        # From the drawing's pixels to those of the reduced copy, then turned.
        shrink = np.array([width / shape[1], height / shape[0]])
        turn[:, 2] += turn[:, :2] @ (shrink / 2 - 0.5)
        turn[:, :2] *= shrink
    return Frame(dark=turned, scale=scale, turn=turn, shape=shape)


def tilt(dark: ByteArray, smoothing_px: float = SMOOTHING_PX) -> float:
    """Return the tilt of the lines in a drawing, degrees in [-45, 45).

    The direction, modulo a right angle, in which most of the contrast lies.

    Parameters
    ----------
    dark : ndarray of uint8, shape (H, W)
        Darkness.
    smoothing_px : float
        Standard deviation of the blur that hides the steps of oblique lines, px.
    """
    smooth = cv2.GaussianBlur(dark, (0, 0), smoothing_px)
    across = cv2.Scharr(smooth, cv2.CV_32F, 1, 0)
    down = cv2.Scharr(smooth, cv2.CV_32F, 0, 1)
    strength, angle = cv2.cartToPolar(across, down, angleInDegrees=True)
    strong = strength > 0.2 * strength.max()
    if not strong.any():
        return 0.0
    n_bins = 90 * BINS_PER_DEG
    bins = (np.asarray(angle)[strong] * BINS_PER_DEG).astype(np.int64) % n_bins
    votes = np.bincount(bins, weights=np.asarray(strength)[strong], minlength=n_bins)
    return _circular_peak(np.asarray(votes, np.float64)) / BINS_PER_DEG


def _circular_peak(votes: FloatArray) -> float:
    """Return the position of the highest hill of a ring of bins, in [-n/2, n/2)."""
    n_bins = len(votes)
    reach = BINS_PER_DEG
    ring = np.concatenate([votes[-reach:], votes, votes[:reach]])
    hills = np.convolve(ring, np.hanning(13), "same")[reach:-reach]
    offsets = np.arange(-reach, reach + 1)
    top = int(np.argmax(hills))
    near = votes[(top + offsets) % n_bins]
    centre = top + float((offsets * near).sum() / near.sum()) + 0.5
    return (centre + n_bins / 2) % n_bins - n_bins / 2


def _turned(
    dark: ByteArray, tilt_deg: float, scale: int
) -> tuple[ByteArray, FloatArray]:
    """Turn a picture by a tilt and enlarge it, on a canvas that holds all of it."""
    height, width = dark.shape
    turn = cv2.getRotationMatrix2D((width / 2 - 0.5, height / 2 - 0.5), tilt_deg, scale)
    cos, sin = abs(turn[0, 0]), abs(turn[0, 1])
    size = (
        int(np.ceil(height * sin + width * cos)),
        int(np.ceil(height * cos + width * sin)),
    )
    turn[:, 2] += np.divide(size, 2) - 0.5 - (width / 2 - 0.5, height / 2 - 0.5)
    turned = cv2.warpAffine(dark, turn, size, flags=cv2.INTER_CUBIC, borderValue=0)
    return np.asarray(turned, dtype=np.uint8), np.asarray(turn, dtype=np.float64)

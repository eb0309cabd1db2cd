"""The sheet that walls are looked for on: one size, upright, ink dark."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.walls.raster import as_bytes, box

WORKING_PIXELS = 1_500_000
"""Pixels of a sheet: enough for walls of a few pixels, and found in little time."""

MOST_ENLARGED = 3.0
"""Largest enlargement; beyond it a copy only gets smoother."""

LEAST_TILT_RAD = np.radians(0.3)
"""Tilt that is left: long walls still fill their rows, and turning costs sharpness."""

WINDOW_SHARE = 1 / 8
"""Automatic window of the paper, share of the shorter side: no wall is as thick."""

SMALL_SIDE_PX = 200
"""Shorter side to which a sheet is reduced to find its paper, px."""

FAINTEST = 20
"""Least difference from black of paper, and from paper of ink, of 255: what is below is
a black block, or grain and compression noise."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """Working copy of a drawing and the way back.

    Parameters
    ----------
    dark : ndarray of uint8, shape (h, w)
        Darkness beside the paper around, 0 for paper, 255 for black.
    scale : float
        Working pixels along a pixel of the drawing.
    turn : ndarray of float64, shape (2, 3), or None
        Affine from the drawing's pixels to the sheet's; None for no turn.
    shape : tuple of int
        Height and width of the drawing, px.
    """

    dark: ByteArray
    scale: float
    turn: FloatArray | None
    shape: tuple[int, int]

    def back(self, mask: ByteArray) -> BoolArray:
        """Return a mask of the sheet over the drawing's own pixels."""
        height, width = self.shape
        levels = mask * np.uint8(255)
        if self.turn is not None:
            flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
            back = cv2.warpAffine(levels, self.turn, (width, height), flags=flags)
            return np.asarray(back) > 127
        if levels.shape != self.shape:
            how = cv2.INTER_AREA if self.scale > 1 else cv2.INTER_LINEAR
            back = cv2.resize(levels, (width, height), interpolation=how)
            return np.asarray(back) > 127
        return levels > 127

    def picture(self, image: ByteArray) -> ByteArray:
        """Return a picture of the sheet, upright as the drawing and no larger."""
        if self.turn is None:
            if self.scale <= 1:
                return image
            size = self.shape[::-1]
            return np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA))
        factor = min(self.scale, 1.0)
        height, width = (max(round(side * factor), 1) for side in self.shape)
        turn = self.turn.copy()
        turn[:, 2] += turn[:, :2] @ np.full(2, 0.5 / factor - 0.5)
        turn[:, :2] /= factor
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        return np.asarray(
            cv2.warpAffine(image, turn, (width, height), flags=flags, borderValue=255)
        )


def first_scale(shape: tuple[int, int]) -> float:
    """Return the scale at which a drawing is first looked at."""
    return min(float(np.sqrt(WORKING_PIXELS / (shape[0] * shape[1]))), MOST_ENLARGED)


def scaled(gray: ByteArray, scale: float) -> ByteArray:
    """Return a brightness picture at another size, dark lines kept."""
    # A line of one pixel would leave a tenth of its ink in a reduction by ten.
    thicker = round(0.5 / scale)
    if thicker > 1:
        gray = np.asarray(cv2.erode(gray, box(thicker)), dtype=np.uint8)
    size = [max(round(side * scale), 1) for side in gray.shape[::-1]]
    how = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    return np.asarray(cv2.resize(gray, size, interpolation=how), dtype=np.uint8)


def sheet_of(
    small: ByteArray,
    shape: tuple[int, int],
    scale: float,
    tilt_rad: float,
    window_px: float,
) -> Sheet:
    """Return the sheet of a drawing of some shape, from its brightness at the scale.

    Its lines, tilted from +x towards +y, are turned upright. The window in which the
    paper is followed is px of the drawing; 0 for automatic.
    """
    dark = darkness(small, window_px * scale)
    if abs(tilt_rad) <= LEAST_TILT_RAD:
        return Sheet(dark, scale, None, shape)
    turned, turn = turned_by(dark, tilt_rad)
    # Pixel centres of the drawing to those of the copy, then turned.
    shrink = np.array([dark.shape[1] / shape[1], dark.shape[0] / shape[0]])
    turn[:, 2] += turn[:, :2] @ (shrink / 2 - 0.5)
    turn[:, :2] *= shrink
    return Sheet(turned, scale, turn, shape)


def turned_by(image: ByteArray, tilt_rad: float) -> tuple[ByteArray, FloatArray]:
    """Turn a picture back by a tilt, on a canvas that holds it; also its affine."""
    height, width = image.shape
    middle = width / 2 - 0.5, height / 2 - 0.5
    turn = cv2.getRotationMatrix2D(middle, np.degrees(tilt_rad), 1.0)
    cos, sin = abs(turn[0, 0]), abs(turn[0, 1])
    size = [
        int(np.ceil(height * sin + width * cos)),
        int(np.ceil(height * cos + width * sin)),
    ]
    turn[:, 2] += np.divide(size, 2) - 0.5 - middle
    turned = cv2.warpAffine(image, turn, size, flags=cv2.INTER_CUBIC, borderValue=0)
    return np.asarray(turned, np.uint8), np.asarray(turn, np.float64)


def darkness(gray: ByteArray, window_px: float = 0.0) -> ByteArray:
    """Return how dark each pixel is beside the paper around it.

    The paper is followed over the sheet, so that shadows, tinted paper and the colour
    of a room are paper. Light lines on dark paper are inverted first.
    """
    factor = max(1.0, min(gray.shape) / SMALL_SIDE_PX)
    size = [max(round(side / factor), 1) for side in gray.shape[::-1]]
    small = np.asarray(cv2.resize(gray, size, interpolation=cv2.INTER_AREA), np.uint8)
    if lines_are_light(small):
        gray, small = 255 - gray, 255 - small
    window = max(round(window_px / factor or WINDOW_SHARE * min(small.shape)), 3)
    paper = cv2.morphologyEx(small, cv2.MORPH_CLOSE, box(window))
    paper = np.maximum(cv2.blur(paper, (5, 5)), FAINTEST)
    paper = cv2.resize(paper, gray.shape[::-1])
    return 255 - np.asarray(cv2.divide(gray, paper, scale=255), dtype=np.uint8)


def lines_are_light(gray: ByteArray) -> bool:
    """Whether a drawing is light on dark.

    Lines take less room than paper, so that beside the mean around them they stand out
    further than paper does: the third power of what stands out tells its side.
    """
    levels = gray.astype(np.float32)
    reach = max(min(gray.shape) // 10, 3)
    beside = levels - cv2.blur(levels, (reach, reach))
    return bool(np.mean(beside**3) > 0)


def find_ink(dark: ByteArray, level: float = 0.0) -> ByteArray:
    """Return the pixels that are ink: darker than a level, or than Otsu's threshold."""
    if not level:
        otsu, _ = cv2.threshold(dark, 0, 255, cv2.THRESH_BINARY | cv2.THRESH_OTSU)
        inked = dark[dark > otsu]
        half = 0.4 * float(np.median(inked)) if inked.size else 0.0
        level = max(otsu, half, FAINTEST) / 255
    return as_bytes(dark > 255 * level)

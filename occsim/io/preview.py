"""A small picture of a drawing, for the screen only."""

import cv2
import numpy as np

from occsim._types import ByteArray
from occsim.imaging import Drawing

PREVIEW_MAX_PX = 1200
"""Longest side of the preview, px: no screen shows more."""
PREVIEW_STEP = 17
"""Quantisation of the preview: 16 levels, black and white among them."""
PNG_MAX_BYTES = 96_000
"""A preview beyond this is a photograph or a noisy scan, where JPEG may be smaller."""
JPEG_QUALITY = 75
COLOUR_SPREAD = 12
"""Channels that differ by less than this are one grey."""


def encode_preview(drawing: Drawing) -> bytes:
    """Return a small picture of a drawing, for the screen only.

    Parameters
    ----------
    drawing : Drawing
        The drawing at full size.

    Returns
    -------
    bytes
        PNG of 16 levels a channel, at most `PREVIEW_MAX_PX` long; JPEG where a
        photograph or noisy scan is smaller that way.
    """
    image = _screen_pixels(drawing)
    levels = (np.rint(np.arange(256) / PREVIEW_STEP) * PREVIEW_STEP).astype(np.uint8)
    png = _encode(".png", levels[image], [])
    if len(png) <= PNG_MAX_BYTES:
        return png
    jpeg = _encode(".jpg", image, [int(cv2.IMWRITE_JPEG_QUALITY), JPEG_QUALITY])
    return min(png, jpeg, key=len)


def _screen_pixels(drawing: Drawing) -> ByteArray:
    """Return the drawing at screen size, one channel where it has no colour."""
    rgb = drawing.rgb
    shrink = PREVIEW_MAX_PX / max(drawing.shape)
    if shrink < 1.0:
        height, width = (max(1, round(side * shrink)) for side in drawing.shape)
        rgb = np.asarray(
            cv2.resize(rgb, (width, height), interpolation=cv2.INTER_AREA), np.uint8
        )
    red, green, blue = cv2.split(rgb)
    spread = max(
        cv2.absdiff(red, green).max(initial=0), cv2.absdiff(green, blue).max(initial=0)
    )
    if spread < COLOUR_SPREAD:
        return np.asarray(green, dtype=np.uint8)
    return np.asarray(cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR), dtype=np.uint8)


def _encode(extension: str, image: ByteArray, options: list[int]) -> bytes:
    _, encoded = cv2.imencode(extension, image, options)
    return encoded.tobytes()

"""Masks, drawings and class pictures as PNG files."""

from collections.abc import Sequence

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray
from occsim.imaging import Drawing

WALL_LEVEL, FREE_LEVEL = 0, 255
"""Brightness of wall and free pixels in the picture of a mask."""


def drawing_png(drawing: Drawing) -> bytes:
    """Return a drawing as a PNG file.

    Parameters
    ----------
    drawing : Drawing
        Any size.

    Returns
    -------
    bytes
        What `occsim.load_drawing` reads back, pixel by pixel.
    """
    return png(drawing.rgb)


def mask_png(mask: BoolArray) -> bytes:
    """Return a mask as a PNG file: black is wall, white is free.

    Parameters
    ----------
    mask : ndarray of bool, shape (H, W)
        True on wall pixels.

    Returns
    -------
    bytes
        What `occsim.world.world_from_image` reads back.
    """
    return png(np.where(mask, WALL_LEVEL, FREE_LEVEL).astype(np.uint8))


def class_png(classes: ByteArray, colours: Sequence[str]) -> bytes:
    """Return a picture of classes, one colour each, as a PNG file.

    Parameters
    ----------
    classes : ndarray of uint8, shape (H, W)
        Number of the class of each pixel.
    colours : sequence of str
        ``#rrggbb`` by class.

    Returns
    -------
    bytes
    """
    palette = np.array([list(bytes.fromhex(c.removeprefix("#"))) for c in colours])
    return png(palette.astype(np.uint8)[classes])


def png(image: ByteArray) -> bytes:
    """Return an image as a PNG file.

    Parameters
    ----------
    image : ndarray of uint8, shape (H, W) or (H, W, 3)
        Grey levels, or colours with red first.

    Returns
    -------
    bytes
    """
    if image.ndim == 3:
        image = np.asarray(cv2.cvtColor(image, cv2.COLOR_RGB2BGR), dtype=np.uint8)
    _, encoded = cv2.imencode(".png", image)
    return encoded.tobytes()

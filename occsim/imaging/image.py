"""Drawings from image files, decoded by Pillow."""

import io
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from occsim._types import ByteArray
from occsim.errors import DrawingError
from occsim.imaging.drawing import Drawing
from occsim.imaging.pdf import load_pdf_page
from occsim.imaging.source import (
    ALLOWED_FORMATS,
    MAX_PIXELS,
    check_size,
    decoding,
    guess,
    has_pdf_mark,
    read_drawing_file,
)

IMAGE_FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "GIF", "PPM")


def load_drawing(source: bytes | str | Path, *, name: str | None = None) -> Drawing:
    """Return the drawing in an image file, or on the first page of a PDF.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        What to call the drawing; by default the file's name, or "drawing".

    Returns
    -------
    Drawing
        Eight bits a colour. Sixteen-bit brightness is scaled, transparency laid on
        white, the camera's orientation (EXIF) applied; of an animation or a file of
        several pages the first is taken.

    Raises
    ------
    DrawingError
        Where the file is missing, empty, damaged, of another format, or an image
        of more than `MAX_PIXELS` or with a side outside `MIN_SIDE_PX` to
        `MAX_SIDE_PX`.
    """
    data, file_name = read_drawing_file(source)
    name = name or file_name
    if has_pdf_mark(data):
        return load_pdf_page(data, name=name)
    with decoding():
        image = _open_image(data, name)
        check_size(*image.size)
        return Drawing(rgb=_pixels(image, name), name=name)


def _open_image(data: bytes, name: str) -> Image.Image:
    """Return the image with its header read and its pixels not yet decoded."""
    try:
        return Image.open(io.BytesIO(data), formats=IMAGE_FORMATS)
    except Image.DecompressionBombError:
        # Pillow refuses on its own before it tells the size.
        limit = 2 * (Image.MAX_IMAGE_PIXELS or 0)
        raise DrawingError(
            f"{name} has more than {limit / 1e6:.0f} megapixels; "
            f"at most {MAX_PIXELS / 1e6:.0f} are allowed"
        ) from None
    except UnidentifiedImageError:
        raise DrawingError(
            f"{name} is not an image that can be read; allowed are "
            f"{ALLOWED_FORMATS}, got {guess(data)}"
        ) from None
    except Exception as error:  # damaged headers end in errors of many types
        raise _damaged(name, error) from None


def _pixels(image: Image.Image, name: str) -> ByteArray:
    """Decode to uint8 of shape (H, W, 3), upright and opaque."""
    try:
        image.load()
        ImageOps.exif_transpose(image, in_place=True)
        if image.mode.startswith(("I", "F")):
            gray = _eight_bits(np.asarray(image))
            return np.repeat(gray[:, :, None], 3, axis=2)
        if image.has_transparency_data:
            image = _on_white(image)
        # Large images: no copy that is not needed.
        opaque = image if image.mode == "RGB" else image.convert("RGB")
        return np.asarray(opaque, dtype=np.uint8)
    except Exception as error:  # damaged pixels end in errors of many types
        raise _damaged(name, error) from None


def _eight_bits(levels: np.ndarray[Any, Any]) -> ByteArray:
    """Scale brightness of more than eight bits (H, W) to 0..255.

    Integers span sixteen bits, or whatever they reach if that is more; floating-point
    images span 0 to 1, or what they reach.
    """
    finite = np.nan_to_num(levels.astype(np.float32), nan=0.0, posinf=0.0, neginf=0.0)
    usual = 1.0 if levels.dtype.kind == "f" else 65535.0
    white = max(usual, float(finite.max()))
    scaled = np.clip(finite * (255.0 / white), 0.0, 255.0)
    return np.asarray(np.rint(scaled), dtype=np.uint8)


def _on_white(image: Image.Image) -> Image.Image:
    """Lay a partly transparent image on white paper."""
    layer = image.convert("RGBA")
    paper = Image.new("RGBA", layer.size, "white")
    return Image.alpha_composite(paper, layer)


def _damaged(name: str, error: Exception) -> DrawingError:
    detail = " ".join(str(error).split())[:100] or type(error).__name__
    return DrawingError(
        f"{name} is damaged or cut short and cannot be decoded; "
        f"a complete image file is needed (the decoder says: {detail})"
    )

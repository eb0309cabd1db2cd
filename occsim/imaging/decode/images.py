"""Images, decoded by Pillow."""

import io
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageFile, TiffImagePlugin, UnidentifiedImageError

from occsim.imaging.decode.limits import (
    MAX_DECODED_BYTES,
    Refused,
    check_size,
)
from occsim.imaging.decode.reduce import Bytes, reduced_size, strips

ALLOWED_FORMATS = "PNG, JPEG, TIFF, BMP, WebP, GIF, PGM or PDF"
PILLOW_FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "GIF", "PPM")

_BYTES_PER_PX = {"1": 1, "L": 1, "P": 1, "I;16": 2, "I;16L": 2, "I;16B": 2}
_PHOTOMETRIC, _BITS, _ORIENTATION = 262, 258, 0x0112
_WHITE_IS_ZERO = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """A picture while it is decoded.

    Parameters
    ----------
    width, height : int
        Of what `strips` give, px.
    strips : iterator of ndarray of uint8, shape (m, width, 3)
        The rows from the top.
    orientation : int
        EXIF orientation; 1 is upright.
    """

    width: int
    height: int
    strips: Iterator[Bytes]
    orientation: int = 1


def take_over_pillow() -> None:
    """Configure Pillow here: our limits, no warnings, more kinds of TIFF."""
    warnings.simplefilter("ignore")
    Image.MAX_IMAGE_PIXELS = None
    # Pillow's unpackers for black-is-zero also work for white-is-zero, and the one for
    # 12 bits a sample works in both byte orders.
    known = TiffImagePlugin.OPEN_INFO
    known.setdefault((b"MM", 1, (1,), 1, (12,), ()), ("I;16", "I;12"))
    for (order, photometric, kind, fill, bits, more), modes in list(known.items()):
        if photometric == 1 and len(bits) == 1 and bits[0] > 8:
            key = (order, _WHITE_IS_ZERO, kind, fill, bits, more)
            known.setdefault(key, modes)


def decode_image(
    data: bytes, name: str, max_side_px: int | None, keep_dark: bool
) -> Picture:
    """Return the picture in an image file.

    Parameters
    ----------
    data : bytes
        The file's content.
    name : str
        What to call it.
    max_side_px : int or None
        Longer side of the result, px, where the image's own is longer.
    keep_dark : bool
        Whether a reduced pixel is the darkest of those it covers, or their mean.

    Returns
    -------
    Picture

    Raises
    ------
    Refused
    """
    try:
        image = Image.open(io.BytesIO(data), formats=PILLOW_FORMATS)
        wanted = _wanted(image, name, max_side_px)
        image.load()
        levels = _Levels(image)
        orientation = int(image.getexif().get(_ORIENTATION, 1))
    except (Refused, MemoryError):
        raise
    except UnidentifiedImageError:
        raise Refused(
            f"{name} is not an image that can be read; allowed are {ALLOWED_FORMATS}"
        ) from None
    except Exception as error:  # damaged files end in errors of many types
        raise _damaged(name, error) from None
    rows = strips(levels.rows, image.size, wanted, keep_dark)
    return Picture(
        width=wanted[0], height=wanted[1], strips=rows, orientation=orientation
    )


def _wanted(
    image: ImageFile.ImageFile, name: str, max_side_px: int | None
) -> tuple[int, int]:
    """Return the size of the result, once it is known that the image can be decoded."""
    wanted = reduced_size(*image.size, max_side_px)
    check_size(name, *image.size, max_pixels=None)
    check_size(name, *wanted)
    scale = 1
    while _decoded_bytes(image, scale) > MAX_DECODED_BYTES:
        scale *= 2
        if image.format != "JPEG" or max(image.size) // scale < max(wanted):
            raise Refused(
                f"decoding {name}, {image.width:,} x {image.height:,} px, takes "
                f"{_decoded_bytes(image) / 1e6:.0f} MB; at most "
                f"{MAX_DECODED_BYTES / 1e6:.0f} MB are allowed"
            )
    if scale > 1:
        # No further than memory requires: averaging here makes thin lines paler.
        image.draft(image.mode, (image.width // scale, image.height // scale))
    return reduced_size(*image.size, max_side_px)


def _decoded_bytes(image: ImageFile.ImageFile, scale: int = 1) -> int:
    """Return what an image takes in memory, a JPEG at a half, quarter or eighth."""
    n_px = image.width * image.height
    decoded = n_px // scale**2 * _BYTES_PER_PX.get(image.mode, 4)
    return decoded + (_coefficient_bytes(image) if "progressive" in image.info else 0)


def _coefficient_bytes(image: ImageFile.ImageFile) -> int:
    """Return what a progressive JPEG holds until its last scan, at every scale."""
    samples = [(h, v) for _, h, v, _ in getattr(image, "layer", [])]
    widest, highest = max(h for h, _ in samples), max(v for _, v in samples)
    n_samples = sum(h * v for h, v in samples) / (widest * highest)
    return int(2 * image.width * image.height * n_samples)


class _Levels:
    """Rows of an image that is decoded, in eight bits a colour."""

    def __init__(self, image: ImageFile.ImageFile) -> None:
        self._image = image
        self._is_deep = image.mode.startswith(("I", "F"))
        self._is_clear = not self._is_deep and image.has_transparency_data
        tags: Any = getattr(image, "tag_v2", {})
        self._is_negative = self._is_deep and tags.get(_PHOTOMETRIC) == _WHITE_IS_ZERO
        bits = tags.get(_BITS, (16,))[0] if self._is_deep else 8
        self._white = self._find_white(bits if bits < 16 else 16)

    def rows(self, top: int, end: int) -> Bytes:
        """Return some rows, shape (n, W, 1) in grey or (n, W, 3) in colour."""
        part = self._part(top, end)
        if self._is_deep:
            return self._eight_bits(np.asarray(part))[:, :, None]
        if self._is_clear:
            return _on_white(np.asarray(part.convert("RGBA")))
        if part.mode in ("1", "L"):
            return np.asarray(part.convert("L"))[:, :, None]
        return np.asarray(part.convert("RGB"))

    def _part(self, top: int, end: int) -> Image.Image:
        return self._image.crop((0, top, self._image.width, end))

    def _find_white(self, bits: int) -> float:
        """Return the level of white.

        Integers span their bits, or whatever they reach if that is more;
        floating-point images span 0 to 1, or what they reach.
        """
        white = 1.0 if self._image.mode == "F" else 2.0**bits - 1.0
        if self._image.mode in ("I", "F"):
            for top in range(0, self._image.height, 64):
                part = np.asarray(self._part(top, min(top + 64, self._image.height)))
                white = max(white, float(_finite(part).max()))
        return white

    def _eight_bits(self, levels: np.ndarray[Any, Any]) -> Bytes:
        """Scale brightness of more than eight bits, shape (H, W), to 0..255."""
        scaled = np.clip(_finite(levels) * (255.0 / self._white), 0.0, 255.0)
        if self._is_negative:
            scaled = 255.0 - scaled
        return np.asarray(np.rint(scaled), np.uint8)


def _finite(levels: np.ndarray[Any, Any]) -> npt.NDArray[np.float32]:
    return np.where(np.isfinite(levels), levels, 0.0).astype(np.float32)


def _on_white(rgba: Bytes) -> Bytes:
    """Lay rows of a partly transparent image on white paper."""
    colour, alpha = rgba[:, :, :3].astype(np.uint32), rgba[:, :, 3:].astype(np.uint32)
    return ((colour * alpha + 255 * (255 - alpha) + 127) // 255).astype(np.uint8)


def _damaged(name: str, error: Exception) -> Refused:
    detail = " ".join(str(error).split())[:100] or type(error).__name__
    return Refused(
        f"{name} is damaged or cut short and cannot be decoded; "
        f"a complete image file is needed (the decoder says: {detail})"
    )

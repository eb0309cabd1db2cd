"""A drawing: the image an architect gives, and its safe loading from a file.

Files are hostile until checked: sizes are read from the header before any pixel is
decoded, only the formats of a short list are tried, and every failure becomes a
`DrawingError` of one sentence.
"""

import hashlib
import io
import math
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from PIL import Image, ImageOps, UnidentifiedImageError

from occsim._types import ByteArray
from occsim.errors import DrawingError

MAX_PIXELS = 40_000_000
"""Largest drawing, px: 40 megapixels, an A3 sheet scanned at 380 dots an inch."""

MIN_SIDE_PX = 8
"""Smallest side, px: nothing narrower holds two walls and a passage between them."""

MAX_SIDE_PX = 30_000
"""Longest side, px: OpenCV warps no image longer than 32,767 px."""

MAX_FILE_BYTES = 100_000_000
"""Largest file, bytes; 40 megapixels of uncompressed 16-bit grey fit."""

DEFAULT_PDF_SIDE_PX = 2000
"""Longer side of a rendered PDF page, px: thin walls stay two or more px wide."""

IMAGE_FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "GIF", "PPM")
ALLOWED_FORMATS = "PNG, JPEG, TIFF, BMP, WebP, GIF, PGM or PDF"

# Held while Pillow or PDFium works: PDFium is not safe in threads, the record of
# warnings is global, and one decoder at a time bounds the memory.
_DECODER = threading.Lock()


@dataclass(frozen=True, eq=False)
class Drawing:
    """An architectural drawing as pixels.

    Parameters
    ----------
    rgb : ndarray of uint8, shape (H, W, 3)
        Colours, red first. Never written to.
    name : str
        What to call it on screen.
    digest : str
        Identifies the pixels: equal digests mean equal images.
    """

    rgb: ByteArray
    name: str = "drawing"
    digest: str = field(default="")

    def __post_init__(self) -> None:
        rgb = np.ascontiguousarray(self.rgb)
        if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3:
            raise DrawingError(
                "rgb must be uint8 of shape (H, W, 3); "
                f"got {rgb.dtype} of shape {rgb.shape}"
            )
        if not rgb.size:
            raise DrawingError(f"rgb must hold at least one pixel; got {rgb.shape}")
        if not self.digest:
            content = hashlib.sha256(repr(rgb.shape).encode())
            content.update(rgb.data)
            object.__setattr__(self, "digest", content.hexdigest())
        rgb.setflags(write=False)
        object.__setattr__(self, "rgb", rgb)

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, px."""
        height, width, _ = self.rgb.shape
        return height, width

    @cached_property
    def gray(self) -> ByteArray:
        """Brightness (0 black, 255 white), ndarray of uint8 of shape (H, W)."""
        return np.asarray(cv2.cvtColor(self.rgb, cv2.COLOR_RGB2GRAY), dtype=np.uint8)


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
    data, file_name = _read(source)
    name = name or file_name
    if _is_pdf(data):
        return load_pdf_page(data, name=name)
    with _decoding():
        image = _open_image(data, name)
        _check_size(*image.size)
        return Drawing(rgb=_pixels(image, name), name=name)


def pdf_page_count(source: bytes | str | Path) -> int:
    """Return the number of pages of a PDF.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.

    Returns
    -------
    int

    Raises
    ------
    DrawingError
        Where the file cannot be read as a PDF.
    """
    data, name = _read(source)
    with _decoding(), _pdf(data, name) as document:
        return len(document)


def load_pdf_page(
    source: bytes | str | Path,
    page: int = 1,
    *,
    long_side_px: int = DEFAULT_PDF_SIDE_PX,
    name: str | None = None,
) -> Drawing:
    """Return a page of a PDF as a drawing.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    page : int, default 1
        Page number, from 1.
    long_side_px : int, default 2000
        Longer side of the drawing, px.
    name : str, optional
        What to call the drawing; by default the file's name, or "drawing".

    Returns
    -------
    Drawing
        The page on white.

    Raises
    ------
    DrawingError
        Where the file cannot be read as a PDF, has no such page, or the page is so
        long and narrow, or `long_side_px` such, that the size is not allowed.
    """
    data, file_name = _read(source)
    name = name or file_name
    with _decoding(), _pdf(data, name) as document:
        if not 1 <= page <= len(document):
            raise DrawingError(
                f"page must lie between 1 and {len(document)}, the last page of "
                f"{name}; got {page!r}"
            )
        sheet = document[page - 1]
        width_pt, height_pt = sheet.get_size()
        scale = long_side_px / max(width_pt, height_pt, 1e-6)
        _check_size(math.ceil(width_pt * scale), math.ceil(height_pt * scale))
        rgb = sheet.render(scale=scale, rev_byteorder=True).to_numpy()[:, :, :3]
        return Drawing(rgb=rgb.copy(), name=name)


def is_pdf(source: bytes | str | Path) -> bool:
    """Return whether a file is a PDF by its first bytes, whatever its name says.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.

    Returns
    -------
    bool

    Raises
    ------
    DrawingError
        Where the file cannot be opened, is empty or too large.
    """
    return _is_pdf(_read(source)[0])


def _is_pdf(data: bytes) -> bool:
    # Readers accept some bytes of junk before the mark.
    return b"%PDF-" in data[:1024]


def _read(source: bytes | str | Path) -> tuple[bytes, str]:
    """Return a file's content and its name, once its size is known to be sensible."""
    if isinstance(source, bytes | bytearray | memoryview):
        data, name, size = bytes(source), "drawing", len(source)
    else:
        path = Path(source)
        name = path.name
        try:
            size = path.stat().st_size
            data = path.read_bytes() if size <= MAX_FILE_BYTES else b""
        except OSError as error:
            reason = error.strerror or "it cannot be read"
            raise DrawingError(
                f"{name} cannot be opened ({reason}); an image file in "
                f"{ALLOWED_FORMATS} is needed"
            ) from None
    if size > MAX_FILE_BYTES:
        raise DrawingError(
            f"{name} has {size / 1e6:.1f} MB; at most "
            f"{MAX_FILE_BYTES / 1e6:.0f} MB are allowed"
        )
    if size == 0:
        raise DrawingError(
            f"{name} is empty (0 bytes); an image in {ALLOWED_FORMATS} is needed"
        )
    return data, name


@contextmanager
def _decoding() -> Iterator[None]:
    """Let one decoder work at a time, and keep its remarks on odd files to itself."""
    with _DECODER, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


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
            f"{ALLOWED_FORMATS}, got {_guess(data)}"
        ) from None
    except Exception as error:  # damaged headers end in errors of many types
        raise _damaged(name, error) from None


def _guess(data: bytes) -> str:
    """Return what a file that is no image seems to be."""
    known = {
        b"PK\x03\x04": "a zip archive",
        b"AC10": "a DWG file (export it as PDF or PNG)",
        b"\x93NUMPY": "a NumPy array",
    }
    for mark, what in known.items():
        if data.startswith(mark):
            return what
    if b"ftyphei" in data[:32] or b"ftypmif" in data[:32]:
        return "a HEIC photograph (export it as JPEG)"
    if b"<svg" in data[:1000]:
        return "an SVG file (export it as PDF or PNG)"
    try:
        data[:1000].decode("ascii")
    except UnicodeDecodeError:
        return f"{len(data):,} bytes of another kind"
    return "plain text"


def _check_size(width: int, height: int) -> None:
    """Refuse sizes that are too small or too large, before anything is decoded."""
    if min(width, height) < MIN_SIDE_PX or max(width, height) > MAX_SIDE_PX:
        raise DrawingError(
            f"each side of a drawing must lie between {MIN_SIDE_PX} and "
            f"{MAX_SIDE_PX:,} px; got {width:,} x {height:,} px"
        )
    if width * height > MAX_PIXELS:
        raise DrawingError(
            f"a drawing may have at most {MAX_PIXELS / 1e6:.0f} megapixels; "
            f"got {width:,} x {height:,} px, {width * height / 1e6:.1f} megapixels"
        )


def _pixels(image: Image.Image, name: str) -> ByteArray:
    """Decode to uint8 of shape (H, W, 3), upright and opaque."""
    try:
        image.load()
        upright = ImageOps.exif_transpose(image)
        if upright.mode.startswith(("I", "F")):
            gray = _eight_bits(np.asarray(upright))
            return np.repeat(gray[:, :, None], 3, axis=2)
        if upright.has_transparency_data:
            upright = _on_white(upright)
        return np.array(upright.convert("RGB"), dtype=np.uint8)
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


@contextmanager
def _pdf(data: bytes, name: str) -> Iterator[Any]:
    """Open a PDF; anything that PDFium cannot do becomes a `DrawingError`."""
    # Here, because few drawings are PDFs; the library carries no types.
    import pypdfium2  # type: ignore[import-untyped]

    if not _is_pdf(data):
        raise DrawingError(f"{name} is not a PDF; got {_guess(data)}")
    try:
        document = pypdfium2.PdfDocument(data)
        try:
            yield document
        finally:
            document.close()
    except pypdfium2.PdfiumError as error:
        reason = str(error).split("PDFium: ")[-1].rstrip(").")
        raise DrawingError(
            f"{name} cannot be read as a PDF ({reason}); "
            "an undamaged PDF without password is needed"
        ) from None

"""What image and PDF files have in common: limits, reading, one decoder at a time."""

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from occsim._files import read_source
from occsim.errors import DrawingError

MAX_PIXELS = 40_000_000
"""Largest drawing, px: 40 megapixels, an A3 sheet scanned at 380 dots an inch."""

MIN_SIDE_PX = 8
"""Smallest side, px: nothing narrower holds two walls and a passage between them."""

MAX_SIDE_PX = 30_000
"""Longest side, px: OpenCV warps no image longer than 32,767 px."""

MAX_FILE_BYTES = 100_000_000
"""Largest file, bytes; 40 megapixels of uncompressed 16-bit grey fit."""

ALLOWED_FORMATS = "PNG, JPEG, TIFF, BMP, WebP, GIF, PGM or PDF"

# Held while Pillow or PDFium works: PDFium is not safe in threads, the record of
# warnings is global, and one decoder at a time bounds the memory.
_DECODER = threading.Lock()


def read_drawing_file(source: bytes | str | Path) -> tuple[bytes, str]:
    """Return the content and name of a drawing's file, of any format."""
    return read_source(
        source,
        what="drawing",
        needed=f"an image in {ALLOWED_FORMATS}",
        max_bytes=MAX_FILE_BYTES,
        error=DrawingError,
    )


def has_pdf_mark(data: bytes) -> bool:
    """Return whether the first bytes are those of a PDF."""
    # Readers accept some bytes of junk before the mark.
    return b"%PDF-" in data[:1024]


def guess(data: bytes) -> str:
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


def check_size(width: int, height: int) -> None:
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


@contextmanager
def decoding() -> Iterator[None]:
    """Let one decoder work at a time, and keep its remarks on odd files to itself."""
    with _DECODER, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield

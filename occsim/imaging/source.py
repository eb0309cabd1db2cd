"""What image and PDF files have in common: how they are read, and their limits."""

from numbers import Integral
from pathlib import Path
from typing import Any

from occsim._files import printable, read_source
from occsim.errors import DrawingError, ParameterError
from occsim.imaging.decode.images import ALLOWED_FORMATS
from occsim.imaging.decode.limits import (
    MAX_PIXELS,
    MAX_SIDE_PX,
    MIN_SIDE_PX,
)

__all__ = [
    "ALLOWED_FORMATS",
    "MAX_FILE_BYTES",
    "MAX_PIXELS",
    "MAX_SIDE_PX",
    "MIN_SIDE_PX",
    "checked_side",
    "read_drawing_file",
]

MAX_FILE_BYTES = 100_000_000
"""Largest file, bytes; 50 megapixels of uncompressed 16-bit grey fit."""


def read_drawing_file(
    source: bytes | str | Path, name: str | None = None
) -> tuple[bytes, str]:
    """Return the content of a drawing's file, of any format, and what to call it."""
    data, file_name = read_source(
        source,
        what=printable(name or "drawing"),
        needed=f"an image in {ALLOWED_FORMATS}",
        max_bytes=MAX_FILE_BYTES,
        error=DrawingError,
    )
    return data, printable(name or file_name)


def checked_side(name: str, value: Any) -> int:
    """Check and return the longer side wanted, px."""
    is_whole = isinstance(value, Integral) and not isinstance(value, bool)
    if not is_whole or not MIN_SIDE_PX <= int(value) <= MAX_SIDE_PX:
        raise ParameterError(
            f"{name} must be a whole number between {MIN_SIDE_PX} and "
            f"{MAX_SIDE_PX:,}; got {value!r:.60}"
        )
    return int(value)

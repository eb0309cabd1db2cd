"""Drawings from files of any kind."""

import math
import struct
from pathlib import Path

import numpy as np

from occsim._types import ByteArray
from occsim.errors import DrawingError
from occsim.imaging.decode.images import decode_image
from occsim.imaging.decode.limits import Refused
from occsim.imaging.drawing import Drawing
from occsim.imaging.kinds import IMAGES, FileKind, kind_of_file, png_size
from occsim.imaging.pdf import DEFAULT_PDF_SIDE_PX, load_pdf_page
from occsim.imaging.pool import POOL
from occsim.imaging.source import ALLOWED_FORMATS, checked_side, read_drawing_file

PLAIN_PNG_PIXELS = 4_000_000
"""Largest PNG that is decoded in this process, px."""

PLAIN_PNG_BYTES = 8_000_000
"""Largest file of such a PNG, bytes."""

_PLAIN_CHUNKS = {
    *{b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS", b"bKGD", b"sBIT"},
    *{b"gAMA", b"cHRM", b"sRGB", b"pHYs", b"tIME"},
}
_MAX_CHUNKS = 2000


def load_drawing(
    source: bytes | str | Path,
    *,
    name: str | None = None,
    max_side_px: int | None = None,
    keep_dark: bool = False,
    allow_robot_map: bool = False,
) -> Drawing:
    """Return the drawing in an image file, or on the first page of a PDF.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        What to call the drawing; by default the file's name, or "drawing".
    max_side_px : int, optional
        Longer side of the drawing, px: a larger image is reduced while it is decoded,
        a page of a PDF rendered at this size. By default images keep their size, and
        pages have 2000 px.
    keep_dark : bool, default False
        How an image is reduced. False, for drawings: each new pixel is the mean of
        those it covers, but at least 0.6 as dark as the darkest of them, so that thin
        lines stay ink. True, for pictures of walls alone: the darkest of them, so that
        every wall stays wall.
    allow_robot_map : bool, default False
        Whether a robot's map in ROS format is taken as a drawing.

    Returns
    -------
    Drawing
        Eight bits a colour. Sixteen-bit brightness is scaled, transparency laid on
        white, the camera's orientation (EXIF) applied; of an animation or a file of
        several pages the first is taken.

    Raises
    ------
    DrawingError
        Where the file is missing, empty, damaged, of another kind or a robot's map;
        where the drawing would have more than `MAX_PIXELS`, a side outside
        `MIN_SIDE_PX` to `MAX_SIDE_PX` or be more than 50 times as long as wide; where
        decoding takes more than 8 s, or more memory than an image of 100 million
        pixels in colour or 400 million in grey does.
    ParameterError
        Where `max_side_px` lies outside `MIN_SIDE_PX` to `MAX_SIDE_PX`.

    Notes
    -----
    Files are decoded in a separate process, see :mod:`occsim.imaging.pool`; only small
    plain PNG files are decoded in this one.

    Examples
    --------
    >>> load_drawing("scan.png", max_side_px=1500).shape  # doctest: +SKIP
    (1060, 1500)
    """
    data, name = read_drawing_file(source, name)
    if max_side_px is not None:
        max_side_px = checked_side("max_side_px", max_side_px)
    kind = kind_of_file(data, name)
    if kind is FileKind.PDF:
        side_px = max_side_px or DEFAULT_PDF_SIDE_PX
        return load_pdf_page(data, long_side_px=side_px, name=name)
    if kind not in IMAGES:
        raise DrawingError(
            f"{name} is {kind.about}, not an image in {ALLOWED_FORMATS}; {kind.advice}"
        )
    if not allow_robot_map and (kind is FileKind.ROBOT_MAP or _has_yaml(source)):
        map_kind = FileKind.ROBOT_MAP
        raise DrawingError(
            f"{name} is {map_kind.about}, not a drawing; {map_kind.advice}"
        )
    return Drawing.from_decoder(_pixels(data, name, max_side_px, keep_dark), name)


def _has_yaml(source: bytes | str | Path) -> bool:
    """Return whether the description of a robot's map lies beside an image."""
    if not isinstance(source, str | Path):
        return False
    path = Path(source)
    for beside in (path.with_suffix(suffix) for suffix in (".yaml", ".yml")):
        try:
            with beside.open("rb") as file:
                text = file.read(4096)
        except OSError:
            continue
        if kind_of_file(text) is FileKind.MAP_YAML and path.name.encode() in text:
            return True
    return False


def _pixels(
    data: bytes, name: str, max_side_px: int | None, keep_dark: bool
) -> ByteArray:
    """Return an image's pixels, uint8 of shape (H, W, 3), upright."""
    if _is_plain_png(data):
        try:
            picture = decode_image(data, name, max_side_px, keep_dark)
            return np.concatenate(list(picture.strips))
        except Refused as error:
            raise DrawingError(str(error)) from None
    reply, stored = POOL.answer(
        data, name, task="image", max_side_px=max_side_px, keep_dark=keep_dark
    )
    return _upright(stored, reply["orientation"])


def _is_plain_png(data: bytes) -> bool:
    """Return whether a PNG is small and has no chunk that could be costly to read.

    Width and height then bound every buffer and the unpacked pixels; besides, only the
    checksums of a limited number of chunks are computed: 64 MB and half a second at
    most. Profiles, texts and metadata can unpack to any size, so a file with them goes
    to the decoder's process.
    """
    shape = png_size(data)
    if shape is None or len(data) > PLAIN_PNG_BYTES:
        return False
    at, n_chunks = 8, 0
    while at + 8 <= len(data) and n_chunks < _MAX_CHUNKS:
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind not in _PLAIN_CHUNKS or (at == 8) != (kind == b"IHDR"):
            return False
        at, n_chunks = at + 12 + size, n_chunks + 1
    return n_chunks < _MAX_CHUNKS and math.prod(shape) <= PLAIN_PNG_PIXELS


def _upright(stored: ByteArray, orientation: int) -> ByteArray:
    """Turn and mirror an image as its orientation in EXIF says."""
    if orientation in (5, 6, 7, 8):
        stored = stored.transpose(1, 0, 2)
    # In terms of the current rows and columns.
    flip_rows, flip_columns = orientation in (3, 4, 7, 8), orientation in (2, 3, 6, 7)
    if flip_rows:
        stored = stored[::-1]
    if flip_columns:
        stored = stored[:, ::-1]
    return np.ascontiguousarray(stored)

"""The image of a ROS map: PGM and PNG, with what transparency says."""

import re
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.errors import OccsimError, RobotFileError
from occsim.imaging import load_drawing, png_size
from occsim.io.metric import MAX_MAP_PIXELS

_SPACE_OR_COMMENT = rb"(?:\s|#[^\r\n]*[\r\n])+"
_PGM = re.compile(
    rb"(P[25])" + (_SPACE_OR_COMMENT + rb"(\d{1,9})") * 3 + rb"(?:#[^\r\n]*[\r\n]|\s)"
)

_HEADER_BYTES = 10_000
"""Most that a header may take: each space and comment in it costs memory."""

_MAX_COMMENTS = 10_000


@dataclass(frozen=True, eq=False)
class MapImage:
    """Brightness and transparency of each pixel.

    Parameters
    ----------
    colour : ndarray of float64, shape (H, W)
        Mean of red, green and blue, 0 black to 1 white.
    alpha : ndarray of float64, shape (H, W), or None
        0 transparent to 1 opaque; None where the image has no transparency.
    """

    colour: FloatArray
    alpha: FloatArray | None

    @property
    def is_opaque(self) -> BoolArray:
        """Which pixels are opaque."""
        if self.alpha is None:
            return np.ones(self.colour.shape, dtype=np.bool_)
        return np.asarray(self.alpha == 1.0)

    def rows(self, top: int, end: int) -> "MapImage":
        """Return some rows of the image."""
        alpha = None if self.alpha is None else self.alpha[top:end]
        return MapImage(self.colour[top:end], alpha)


def read_image(data: bytes, name: str) -> MapImage:
    """Return the image of a map.

    Parameters
    ----------
    data : bytes
        The file's content: PGM (P2 or P5), PNG, or what `load_drawing` reads.
    name : str
        What to call it.

    Returns
    -------
    MapImage

    Raises
    ------
    RobotFileError
        Where it is damaged, too large, or no image.
    """
    if data.startswith((b"P2", b"P5")):
        return MapImage(_read_pgm(data, name), None)
    size = png_size(data)
    if size is not None:
        return _read_png(data, name, *size)
    try:
        drawing = load_drawing(data, name=name, allow_robot_map=True)
    except OccsimError as error:
        raise RobotFileError(str(error)) from None
    _check_size(*drawing.shape, name)
    return MapImage(drawing.rgb.sum(axis=2, dtype=np.int64) / 765.0, None)


def pgm(levels: ByteArray) -> bytes:
    """Return grey levels, uint8 of shape (H, W), as a binary PGM file."""
    height, width = levels.shape
    return f"P5\n{width} {height}\n255\n".encode() + levels.tobytes()


def transparent_png(levels: ByteArray, is_opaque: BoolArray) -> bytes:
    """Return grey levels as a PNG file in colour with transparency.

    Parameters
    ----------
    levels : ndarray of uint8, shape (H, W)
        Brightness.
    is_opaque : ndarray of bool, shape (H, W)
        Where the image is opaque; elsewhere it is transparent.
    """
    alpha = np.where(is_opaque, np.uint8(255), np.uint8(0))
    _, encoded = cv2.imencode(".png", np.dstack([levels, levels, levels, alpha]))
    return encoded.tobytes()


def _read_pgm(data: bytes, name: str) -> FloatArray:
    header = _PGM.match(data[:_HEADER_BYTES])
    if header is None:
        raise RobotFileError(f"the header of {name} is damaged; PGM is needed")
    width, height, most = (int(header[k]) for k in (2, 3, 4))
    _check_size(height, width, name)
    if not 0 < most < 65536:
        raise RobotFileError(
            f"the largest level of {name} must lie in 1 to 65535; got {most}"
        )
    body = data[header.end() :]
    read = _plain_levels if header[1] == b"P2" else _binary_levels
    levels = read(body, width * height, most)
    if levels is None:
        raise RobotFileError(
            f"{name} is damaged: {width} x {height} levels are announced, others follow"
        )
    shades = np.minimum(levels, most) / most
    return shades.reshape(height, width)


def _binary_levels(
    body: bytes, count: int, most: int
) -> npt.NDArray[np.generic] | None:
    kind = np.dtype(np.uint8 if most < 256 else ">u2")
    if len(body) < count * kind.itemsize:
        return None
    return np.frombuffer(body, kind, count)


def _plain_levels(body: bytes, count: int, most: int) -> FloatArray | None:
    if body.count(b"#") > _MAX_COMMENTS:
        return None
    body = re.sub(rb"#[^\r\n]*", b"", body)
    # No level and the gap behind it take more than twelve bytes in a sensible file.
    if len(body) > 12 * count + 1000 or body.translate(None, b"0123456789 \t\r\n\v\f"):
        return None
    levels = np.fromstring(body.decode("ascii"), dtype=np.float64, sep=" ")
    return levels[:count] if levels.size >= count else None


def _read_png(data: bytes, name: str, width: int, height: int) -> MapImage:
    _check_size(height, width, name)
    try:
        found = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        found = None
    if found is None or found.shape[:2] != (height, width):
        raise RobotFileError(f"{name} is a damaged PNG image")
    levels = found.reshape(height, width, -1)
    most = 65535 if found.dtype == np.uint16 else 255
    alpha = levels[:, :, 3] / most if levels.shape[2] == 4 else None
    colours = levels[:, :, :3]
    # Whole numbers first: three equal levels then have exactly their own mean.
    sums = colours.sum(axis=2, dtype=np.int64)
    return MapImage(sums / (most * colours.shape[2]), alpha)


def _check_size(height: int, width: int, name: str) -> None:
    if min(height, width) < 1 or height * width > MAX_MAP_PIXELS:
        raise RobotFileError(
            f"{name} has {width:,} x {height:,} px; a map may have 1 to "
            f"{MAX_MAP_PIXELS:,} px in all"
        )

"""A mask as a few bytes: one bit a pixel, compressed."""

import zlib

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray
from occsim.errors import ParameterError


def pack_mask(mask: npt.NDArray[np.generic]) -> bytes:
    """Return a mask as compressed bits, row after row.

    Parameters
    ----------
    mask : ndarray of bool, shape (H, W)
        One flag a pixel.

    Returns
    -------
    bytes
        zlib of the flags, eight a byte, the first in the highest bit.
    """
    return zlib.compress(np.packbits(np.asarray(mask) != 0).tobytes(), level=6)


def unpack_mask(packed: bytes, shape: tuple[int, int]) -> BoolArray:
    """Return the mask that `pack_mask` packed.

    Parameters
    ----------
    packed : bytes
        Compressed bits; empty for a mask without any.
    shape : tuple of int
        Height and width, px.

    Returns
    -------
    ndarray of bool, shape (H, W)

    Raises
    ------
    ParameterError
        Where the bytes do not hold a mask of that size.
    """
    n_pixels = shape[0] * shape[1]
    n_bytes = -(-n_pixels // 8)
    if not packed:
        return np.zeros(shape, dtype=bool)
    try:
        # One byte more than expected is enough to see that there is too much.
        bits = zlib.decompressobj().decompress(packed, n_bytes + 1)
    except zlib.error:
        raise ParameterError("a packed mask must be zlib data; this is not") from None
    if len(bits) != n_bytes:
        raise ParameterError(
            f"a packed mask of {shape[1]} x {shape[0]} px must hold {n_bytes} bytes; "
            f"this one holds {'more' if len(bits) > n_bytes else len(bits)}"
        )
    flags = np.unpackbits(np.frombuffer(bits, dtype=np.uint8), count=n_pixels)
    return flags.astype(bool).reshape(shape)

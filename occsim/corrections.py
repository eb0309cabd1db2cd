"""Corrections of a wall mask by hand: which pixels were added, and which erased.

They are an overlay, kept apart from the mask: walls can be found again below it, and
the corrections stay. One bit a pixel and plane, compressed, is small enough to keep
many of them.
"""

import zlib
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, ByteArray
from occsim.errors import ParameterError
from occsim.imaging.transform import Transform

TILE_PX = 64
"""Side of the tiles in which `Corrections.with_tiles` takes changes, px."""

_TILE_BYTES = 2 * TILE_PX * TILE_PX // 8


@dataclass(frozen=True, repr=False)
class Corrections:
    """An overlay over a mask: pixels added to it, and pixels erased from it.

    Made by `none`, `from_masks` or `between`; two are equal where they hold the same
    pixels.

    Parameters
    ----------
    shape : tuple of int
        Height and width of the mask, px.
    packed : bytes, optional
        Both planes, added before erased, packed by `pack_mask`; empty for no
        correction.

    Examples
    --------
    >>> import numpy as np
    >>> found = np.array([[True, False, False]])
    >>> by_hand = Corrections.between(found, np.array([[False, True, False]]))
    >>> by_hand
    Corrections(3 x 1 px: 1 px added, 1 px erased)
    >>> by_hand.apply(np.array([[True, True, True]])).tolist()
    [[False, True, True]]
    """

    shape: tuple[int, int]
    packed: bytes = b""

    @classmethod
    def none(cls, shape: tuple[int, int]) -> "Corrections":
        """Return the overlay that corrects nothing.

        Parameters
        ----------
        shape : tuple of int
            Height and width of the mask, px.

        Returns
        -------
        Corrections
        """
        return cls(shape)

    @classmethod
    def from_masks(cls, added: BoolArray, erased: BoolArray) -> "Corrections":
        """Return the overlay of two planes.

        Parameters
        ----------
        added, erased : ndarray of bool, shape (H, W)
            Pixels that are wall, and pixels that are not, whatever the mask says.

        Returns
        -------
        Corrections

        Raises
        ------
        ParameterError
            Where the planes differ in shape, or a pixel is in both.
        """
        if added.ndim != 2 or added.shape != erased.shape:
            raise ParameterError(
                "added and erased must have one shape (H, W); got "
                f"{added.shape} and {erased.shape}"
            )
        if (added & erased).any():
            n_both = int((added & erased).sum())
            raise ParameterError(
                f"a pixel may be added or erased, not both; got {n_both} in both"
            )
        height, width = added.shape
        if not (added.any() or erased.any()):
            return cls((height, width))
        return cls((height, width), pack_mask(np.stack([added, erased])))

    @classmethod
    def between(cls, before: BoolArray, after: BoolArray) -> "Corrections":
        """Return the smallest overlay that takes one mask to another.

        Parameters
        ----------
        before, after : ndarray of bool, shape (H, W)
            The masks.

        Returns
        -------
        Corrections

        Raises
        ------
        ParameterError
            Where the masks differ in shape.
        """
        if before.shape != after.shape:
            raise ParameterError(
                "before and after must have one shape (H, W); got "
                f"{before.shape} and {after.shape}"
            )
        return cls.from_masks(after & ~before, before & ~after)

    def __repr__(self) -> str:
        height, width = self.shape
        added, erased = (int(plane.sum()) for plane in self.planes)
        return (
            f"Corrections({width} x {height} px: {added} px added, {erased} px erased)"
        )

    @property
    def is_empty(self) -> bool:
        """Whether nothing is corrected."""
        return not self.packed

    @property
    def planes(self) -> BoolArray:
        """Added and erased pixels, ndarray of bool of shape (2, H, W); a new array."""
        return unpack_mask(self.packed, (2, *self.shape))

    def apply(self, mask: BoolArray) -> BoolArray:
        """Return the corrected mask, ``(mask | added) & ~erased``.

        Parameters
        ----------
        mask : ndarray of bool, shape (H, W)
            True on wall pixels; not written to.

        Returns
        -------
        ndarray of bool, shape (H, W)
            The mask itself where nothing is corrected.

        Raises
        ------
        ParameterError
            Where the mask has another shape.
        """
        if mask.shape != self.shape:
            raise ParameterError(
                f"mask must have the corrections' shape {self.shape}; got {mask.shape}"
            )
        if self.is_empty:
            return mask
        added, erased = self.planes
        return np.asarray((mask | added) & ~erased)

    def transformed(self, transform: Transform) -> "Corrections":
        """Return the corrections on a drawing that was moved.

        Parameters
        ----------
        transform : Transform
            Of the corrections' shape.

        Returns
        -------
        Corrections
            Where scaling down merges an added and an erased pixel, the result is added,
            so that no wall is lost.

        Raises
        ------
        DrawingError
            Where the transform is of another shape.
        """
        added, erased = (transform.mask(plane) for plane in self.planes)
        return Corrections.from_masks(added, erased & ~added)

    def with_tiles(self, tiles: bytes) -> "Corrections":
        """Return the corrections with some tiles replaced; all bytes are checked.

        Parameters
        ----------
        tiles : bytes
            zlib of one bit for each tile of `TILE_PX` x `TILE_PX` px, row after row,
            high bit first, padded to whole bytes: whether it is replaced. Then, for
            each that is, its added pixels, one bit each, row after row, and its erased
            pixels. A tile may reach beyond the mask; its pixels there have no effect.

        Returns
        -------
        Corrections

        Raises
        ------
        ParameterError
            Where the bytes do not hold such tiles.
        """
        n_rows, n_cols = (-(-side // TILE_PX) for side in self.shape)
        n_head = -(-n_rows * n_cols // 8)
        content = _inflated(tiles, n_head + n_rows * n_cols * _TILE_BYTES)
        flags = np.unpackbits(content[:n_head])
        chosen = np.flatnonzero(flags)
        if (
            len(content) != n_head + len(chosen) * _TILE_BYTES
            or (chosen >= n_rows * n_cols).any()
        ):
            raise ParameterError(
                f"tiles must hold {n_head} bytes of flags and {_TILE_BYTES} bytes for "
                f"each tile that is set; got {len(content)} bytes"
            )
        size = (n_rows, TILE_PX, n_cols, TILE_PX)
        padded = np.zeros((2, n_rows * TILE_PX, n_cols * TILE_PX), dtype=bool)
        padded[:, : self.shape[0], : self.shape[1]] = self.planes
        new = np.unpackbits(content[n_head:]).reshape(-1, 2, TILE_PX, TILE_PX)
        row, col = np.divmod(chosen, n_cols)
        padded.reshape(2, *size)[:, row, :, col] = new
        added, erased = padded[:, : self.shape[0], : self.shape[1]]
        return Corrections.from_masks(added, erased)


def pack_mask(mask: npt.NDArray[np.generic]) -> bytes:
    """Return a mask as compressed bits, row after row.

    Parameters
    ----------
    mask : ndarray of bool, any shape
        One flag a pixel.

    Returns
    -------
    bytes
        zlib of the flags, eight a byte, the first in the highest bit.
    """
    return zlib.compress(np.packbits(np.asarray(mask) != 0).tobytes(), level=6)


def unpack_mask(packed: bytes, shape: tuple[int, ...]) -> BoolArray:
    """Return the mask that `pack_mask` packed.

    Parameters
    ----------
    packed : bytes
        Compressed bits; empty for a mask without any.
    shape : tuple of int
        As of the mask that was packed.

    Returns
    -------
    ndarray of bool

    Raises
    ------
    ParameterError
        Where the bytes do not hold a mask of that size.
    """
    if not packed:
        return np.zeros(shape, dtype=bool)
    n_pixels = int(np.prod(shape))
    n_bytes = -(-n_pixels // 8)
    bits = _inflated(packed, n_bytes)
    if len(bits) != n_bytes:
        raise ParameterError(
            f"a packed mask of shape {shape} must hold {n_bytes} bytes; got {len(bits)}"
        )
    return np.unpackbits(bits, count=n_pixels).view(bool).reshape(shape)


def _inflated(packed: bytes, most: int) -> ByteArray:
    """Unpack zlib data; refuse it before more than `most` bytes are unpacked.

    Raises
    ------
    ParameterError
    """
    stream = zlib.decompressobj()
    try:
        # One byte more than allowed shows that there is too much.
        content = stream.decompress(packed, most + 1)
    except zlib.error:
        raise ParameterError("packed pixels must be zlib data; these are not") from None
    if len(content) > most:
        raise ParameterError(f"packed pixels may hold {most} bytes; these hold more")
    if not stream.eof:
        raise ParameterError("packed pixels must be complete; these are cut short")
    if stream.unused_data:
        n_more = len(stream.unused_data)
        raise ParameterError(f"packed pixels must end; {n_more} bytes follow")
    return np.frombuffer(content, dtype=np.uint8)

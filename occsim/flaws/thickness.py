"""Walls made thicker, or thinner without losing one."""

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray


def thickened_walls(walls: BoolArray, radius_px: int) -> BoolArray:
    """Return every pixel within `radius_px` of a wall pixel, centre to centre."""
    steps = np.arange(-radius_px, radius_px + 1) ** 2
    disc = (steps[:, None] + steps <= radius_px**2).astype(np.uint8)
    return cv2.dilate(walls.view(np.uint8), disc).view(np.bool_)


def thinned_walls(walls: BoolArray, thickness_px: int) -> BoolArray:
    """Return the walls with so many layers taken off each side, lines kept.

    Taking all pixels that may go from one side at a time leaves the number of pieces
    and of holes as it was [1]_.

    References
    ----------
    .. [1] A. Rosenfeld, "A characterization of parallel thinning algorithms",
       Information and Control 29, 1975.
    """
    # Eight pixels to a byte: a sheet then fits into the processor's cache. The frame is
    # free, so that no bit runs over from one row into the next.
    bits = np.packbits(np.pad(walls, 1), axis=1)
    for _ in range(thickness_px):
        before = bits[1:-1].copy()
        for north_south_west_east in (0, 4, 6, 2):
            bits[1:-1] &= ~_removable(bits, north_south_west_east)
        if np.array_equal(before, bits[1:-1]):
            break  # only lines are left
    height, width = walls.shape
    flags = np.unpackbits(bits, axis=1)[1 : height + 1, 1 : width + 1]
    return np.ascontiguousarray(flags).view(np.bool_)


def _removable(bits: ByteArray, side: int) -> ByteArray:
    """Return the pixels that may be taken off from one side.

    Such a pixel is free on that side, no end of a line, and the only link of nothing:
    the wall pixels round it form one connected group.
    """
    near = _neighbours(bits)
    groups = [
        ~near[i] & (near[i + 1] | near[(i + 2) % 8])  # one begins after a free side
        for i in (0, 2, 4, 6)
    ]
    n, e, s, w = groups
    one_group = (n ^ e ^ s ^ w) & ~((n & e) | (s & w))
    some, two = near[0], np.zeros_like(near[0])
    for other in near[1:]:
        two, some = two | (some & other), some | other
    return one_group & two & ~near[side]


def _neighbours(bits: ByteArray) -> list[ByteArray]:
    """Return each pixel's neighbours N, NE, E, SE, S, SW, W, NW, the frame left out."""
    flat = bits.ravel()
    west = np.right_shift(flat, 1, dtype=np.uint8)
    east = np.left_shift(flat, 1, dtype=np.uint8)
    west[1:] |= flat[:-1] << 7
    east[:-1] |= flat[1:] >> 7
    west, east = west.reshape(bits.shape), east.reshape(bits.shape)
    above, level, below = slice(-2), slice(1, -1), slice(2, None)
    right = [bits[above], east[above], east[level], east[below]]
    return [*right, bits[below], west[below], west[level], west[above]]

"""Faces: the straight pieces of wall surface that can stop a ray."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, IntArray

N_SIDES = 4
"""Looking right, down, left, up: side k is seen when looking along bearing k pi/2."""


@dataclass(frozen=True, eq=False)
class SideFaces:
    """All faces of a world that are seen when looking one way.

    Parameters
    ----------
    position : ndarray of int64, shape (K,)
        Where the face lies on the axis that is looked along, px; ascending.
    start, stop : ndarray of int64, shape (K,)
        Its ends on the other axis, px, start < stop.
    """

    position: IntArray
    start: IntArray
    stop: IntArray


def wall_faces(occupied: BoolArray) -> tuple[SideFaces, ...]:
    """Return the surface of all walls, sides of pixels in a line merged.

    What lies outside the image is free, so walls at its edge have faces there too.

    Parameters
    ----------
    occupied : ndarray of bool, shape (H, W)
        Wall pixels.

    Returns
    -------
    tuple of SideFaces, length 4
        Seen looking right, down, left and up.
    """
    transposed = cv2.transpose(occupied.view(np.uint8)).view(np.bool_)
    left, right = _near_and_far_faces(transposed)
    top, bottom = _near_and_far_faces(occupied)
    return left, top, right, bottom


def _near_and_far_faces(occupied: BoolArray) -> tuple[SideFaces, SideFaces]:
    """Return the upper and the lower faces of walls in an (H, W) image."""
    height, width = occupied.shape
    above = np.zeros((height + 1, width), dtype=np.bool_)
    above[1:] = occupied
    below = np.zeros_like(above)
    below[:-1] = occupied
    return _runs(below & ~above), _runs(above & ~below)


def _runs(sides: npt.NDArray[np.bool_]) -> SideFaces:
    """Return the runs of true values along each row of an (L, W) array."""
    n_lines, width = sides.shape
    padded = np.zeros((n_lines, width + 2), dtype=np.bool_)
    padded[:, 1:-1] = sides
    # Along a row that begins and ends with False, changes alternate: start, stop.
    line, column = np.divmod(np.flatnonzero(padded[:, 1:] != padded[:, :-1]), width + 1)
    return SideFaces(position=line[::2], start=column[::2], stop=column[1::2])

"""Faces: the straight pieces of wall surface that can stop a ray."""

from dataclasses import dataclass

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray

_Runs = tuple[IntArray, IntArray, IntArray]

N_SIDES = 4
"""Looking right, down, left, up: side k is seen when looking along bearing k pi/2."""


@dataclass(frozen=True, eq=False)
class WallFaces:
    """All faces of a world, those seen when looking one way after the other.

    Parameters
    ----------
    bounds : tuple of int, length 5
        Side k has the faces ``bounds[k]`` to ``bounds[k + 1] - 1``.
    position : ndarray of float64, shape (K,)
        Where the face lies on the axis that is looked along, px; ascending on each
        side. A whole number, but compared with those of the robot.
    start, stop : ndarray of float64, shape (K,)
        Its ends on the other axis, px, start < stop.
    first_at : ndarray of int64, shape (4, L)
        Of each side, the first face at a whole position 0 to L - 1 or beyond it. No
        face lies at L - 1 or beyond.
    """

    bounds: tuple[int, ...]
    position: FloatArray
    start: FloatArray
    stop: FloatArray
    first_at: IntArray


def wall_faces(occupied: BoolArray) -> WallFaces:
    """Return the surface of all walls, sides of pixels in a line merged.

    What lies outside the image is free, so walls at its edge have faces there too.

    Parameters
    ----------
    occupied : ndarray of bool, shape (H, W)
        Wall pixels.

    Returns
    -------
    WallFaces
        Read-only.
    """
    transposed = cv2.transpose(occupied.view(np.uint8)).view(np.bool_)
    left, right = _near_and_far_faces(transposed)
    top, bottom = _near_and_far_faces(occupied)
    sides = (left, top, right, bottom)
    bounds = np.cumsum([0, *(position.size for position, _, _ in sides)])
    position, start, stop = (
        np.concatenate(parts, dtype=np.float64) for parts in zip(*sides, strict=True)
    )
    whole = np.arange(max(occupied.shape) + 2)
    first_at = np.array([side[0].searchsorted(whole) for side in sides])
    first_at += bounds[:-1, None]
    for array in (position, start, stop, first_at):
        array.setflags(write=False)
    return WallFaces(tuple(bounds.tolist()), position, start, stop, first_at)


def _near_and_far_faces(occupied: BoolArray) -> tuple[_Runs, _Runs]:
    """Return the upper and the lower faces of walls in an (H, W) image."""
    height, width = occupied.shape
    above = np.zeros((height + 1, width), dtype=np.bool_)
    above[1:] = occupied
    below = np.zeros_like(above)
    below[:-1] = occupied
    return _runs(below & ~above), _runs(above & ~below)


def _runs(sides: BoolArray) -> _Runs:
    """Return line, start and stop of the runs of true values along each row."""
    n_lines, width = sides.shape
    padded = np.zeros((n_lines, width + 2), dtype=np.bool_)
    padded[:, 1:-1] = sides
    # Along a row that begins and ends with False, changes alternate: start, stop.
    line, column = np.divmod(np.flatnonzero(padded[:, 1:] != padded[:, :-1]), width + 1)
    return line[::2], column[::2], column[1::2]

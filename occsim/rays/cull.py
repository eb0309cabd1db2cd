"""Leaving out faces that others certainly hide, where there are very many."""

import numpy as np

from occsim._types import BoolArray, IntArray
from occsim.rays.faces import N_SIDES
from occsim.rays.ragged import ragged_ranges
from occsim.rays.reach import SeenFaces, View
from occsim.sensor import EDGE_EPS

N_BINS = 1024
"""Bins of bearing in a full turn: a side of one pixel fills a bin up to 80 px away."""

_QUARTER = N_BINS // N_SIDES
_BIN_RAD = 2.0 * np.pi / N_BINS
_EDGE_SECANTS = 1.0 / np.cos(_BIN_RAD * np.arange(-_QUARTER, _QUARTER + 1))


def without_hidden(faces: SeenFaces, view: View) -> SeenFaces:
    """Return the faces without most of those that nearer ones hide.

    Each bin of bearing is closed off by the nearest face that fills it; a face that
    begins farther away than that in every bin that it touches cannot be seen.

    Parameters
    ----------
    faces : SeenFaces
        Faces in view.
    view : View
        N readings.

    Returns
    -------
    SeenFaces
        Every face that is nearest on any bearing is there.
    """
    face, place, fills = _bins_touched(faces)
    counter = faces.reading[face] * N_BINS
    counter += (place + faces.side[face] * _QUARTER) % N_BINS
    secants = _EDGE_SECANTS[place + _QUARTER], _EDGE_SECANTS[place + _QUARTER + 1]
    depth = faces.depth[face]
    closed_at = np.full(view.size * N_BINS, np.inf)
    np.minimum.at(closed_at, counter[fills], depth[fills] * np.maximum(*secants)[fills])
    visible = np.zeros(faces.size, dtype=np.bool_)
    visible[face[depth * np.minimum(*secants) <= closed_at[counter] + EDGE_EPS]] = True
    return faces.take(visible.nonzero()[0])


def _bins_touched(faces: SeenFaces) -> tuple[IntArray, IntArray, BoolArray]:
    """Return the bins that faces touch, and which of them they fill.

    Returns
    -------
    face : ndarray of int64, shape (T,)
        Face of each pair.
    place : ndarray of int64, shape (T,)
        Bin, counted from straight ahead of the face's side, -256 to 255.
    fills : ndarray of bool, shape (T,)
        Whether the face covers all of the bin.
    """
    left, right = np.arctan2(faces.line[1:], faces.depth) / _BIN_RAD
    # Wall that begins at the robot closes a whole quadrant.
    right = np.where(faces.depth == 0.0, float(_QUARTER), right)
    # Ends are not widened for grazing rays: what fills the bin up to its edge is, too.
    first = np.maximum(np.floor(left), -_QUARTER).astype(np.int64)
    stop = np.minimum(np.ceil(right), _QUARTER).astype(np.int64)
    face, place = ragged_ranges(first, stop)
    return face, place, (place >= left[face]) & (place + 1 <= right[face])

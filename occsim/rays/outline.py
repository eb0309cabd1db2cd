"""The outline of what each reading sees: its nearest faces, bearing by bearing."""

from typing import NamedTuple

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import CARDINAL_HEADINGS_RAD, wrap_angle
from occsim.rays.ragged import ragged_ranges
from occsim.rays.reach import SIDE_COS, SIDE_SIN, SeenFaces, View

SLIVER_RAD = 1e-12
"""Bearings closer than this are one: a thousandth of the tolerance of an edge."""

PAIRS_AT_ONCE = 1 << 20
"""Bounds the memory of comparing faces (about 50 bytes for each face and interval)."""

NO_FACE = -1

_TURNS = np.array(CARDINAL_HEADINGS_RAD)[:, None]


class Outline(NamedTuple):
    """Pieces of bearing in each of which one face, or none within reach, is nearest.

    Parameters
    ----------
    reading : ndarray of int64, shape (P,)
        Reading of the batch, ascending; within one, bearings ascend without a gap.
    face : ndarray of int64, shape (P,)
        Index into the seen faces, or NO_FACE.
    ends : ndarray of float64, shape (2, 2, P)
        x and y of unit vectors along the bearings at which the piece starts and ends.
        No piece crosses a cardinal bearing: arcs then only fall or only rise, and no
        chord comes near the robot.
    begin : ndarray of float64, shape (P,)
        Bearing at which the piece starts, relative to the heading, rad.
    ahead_min : ndarray of float64, shape (K,)
        `SeenFaces.ahead_min`.
    """

    reading: IntArray
    face: IntArray
    ends: FloatArray
    begin: FloatArray
    ahead_min: FloatArray


class _Intervals(NamedTuple):
    """What lies between neighbouring bearings at which any face begins or ends.

    Shapes (J,): reading, bearings begin and end relative to the heading, unit vector
    of the middle. `first` and `stop`, shape (K,), are the intervals of each face.
    """

    reading: IntArray
    begin: FloatArray
    end: FloatArray
    middle_x: FloatArray
    middle_y: FloatArray
    first: IntArray
    stop: IntArray


def trace_outline(faces: SeenFaces, view: View) -> Outline:
    """Return the outline that the nearest faces of each reading form.

    Parameters
    ----------
    faces : SeenFaces
        Faces in view. They come from a world of pixels, so none crosses another, and
        the one that is nearest half-way between two neighbouring ends is so all the
        way.
    view : View
        N readings.

    Returns
    -------
    Outline
    """
    intervals, least = _intervals(faces, view), faces.ahead_min()
    nearest = _nearest(faces, intervals, least)
    first, last, owner = _runs(intervals, nearest)
    begin = intervals.begin[first]
    bearings = np.array([begin, intervals.end[last]])
    ends = unit_vectors(bearings, view.theta[owner])
    return Outline(owner, nearest[first], ends, begin, least)


def _intervals(faces: SeenFaces, view: View) -> _Intervals:
    """Return the intervals between all ends of faces, sorted within each reading."""
    n, k = view.size, faces.size
    bearing = np.empty(6 * n + 2 * k)
    bearing[:n], bearing[n : 2 * n] = -view.half, view.half
    bearing[2 * n : 6 * n] = cardinal_cuts(view).ravel()
    bearing[6 * n :] = faces.bearing.ravel()
    owner = np.concatenate([np.arange(n)] * 6 + [faces.reading] * 2)
    # One sort for all readings: bearings lie within pi of 0, so 8 keeps them apart.
    order = (8.0 * owner + bearing).argsort()
    bearing, owner = bearing[order], owner[order]
    real = owner[1:] == owner[:-1]
    real &= bearing[1:] - bearing[:-1] > SLIVER_RAD
    # rank[p]: intervals before the end that was at place p before sorting.
    rank = np.empty(order.size, dtype=np.int64)
    rank[order[0]] = 0
    rank[order[1:]] = real.cumsum()
    left = real.nonzero()[0]
    begin, end, reading = bearing[left], bearing[left + 1], owner[left]
    middle = 0.5 * (begin + end) + view.theta[reading]
    first, stop = rank[6 * n : 6 * n + k], rank[6 * n + k :]
    return _Intervals(reading, begin, end, np.cos(middle), np.sin(middle), first, stop)


def cardinal_cuts(view: View) -> FloatArray:
    """Return the four cardinal bearings relative to each heading, shape (4, N), rad.

    Those that are out of view lie at the edge of it.
    """
    turns = wrap_angle(_TURNS - view.theta)
    return np.minimum(np.maximum(turns, -view.half), view.half)


def _nearest(
    faces: SeenFaces, intervals: _Intervals, ahead_min: FloatArray
) -> IntArray:
    """Return the nearest face of each interval, or NO_FACE, shape (J,)."""
    n_intervals = intervals.reading.size
    distance = np.full(n_intervals, np.inf)
    nearest = np.full(n_intervals, NO_FACE, dtype=np.int64)
    # How far ahead a middle points, by the side that is looked at: one gather a pair.
    x, y = intervals.middle_x, intervals.middle_y
    ahead = np.concatenate([x, y, -x, -y])
    offset = faces.side * n_intervals
    covered = (intervals.stop - intervals.first).cumsum()
    n_chunks = (int(covered[-1]) if covered.size else 0) // PAIRS_AT_ONCE
    cuts = covered.searchsorted(np.arange(1, n_chunks + 1) * PAIRS_AT_ONCE, "right")
    start = 0
    for stop in sorted({*cuts.tolist(), faces.size}):
        pair, interval = ragged_ranges(
            intervals.first[start:stop], intervals.stop[start:stop]
        )
        pair += start
        cosine = np.maximum(ahead[offset[pair] + interval], ahead_min[pair])
        z = faces.depth[pair] / cosine
        np.minimum.at(distance, interval, z)
        wins = z == distance[interval]
        nearest[interval[wins]] = pair[wins]
        start = stop
    return nearest


def _runs(
    intervals: _Intervals, nearest: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Return first and last of the intervals that make one piece, and its reading."""
    quadrant = 2 * (intervals.middle_x > 0) + (intervals.middle_y > 0)
    reading = intervals.reading
    differs = (reading[1:] != reading[:-1]) | (nearest[1:] != nearest[:-1])
    differs |= quadrant[1:] != quadrant[:-1]
    first, last = run_ends(differs)
    return first, last, reading[first]


def run_ends(differs: BoolArray) -> tuple[IntArray, IntArray]:
    """Return the first and the last place of each run of equal things.

    Parameters
    ----------
    differs : ndarray of bool, shape (P - 1,)
        Whether each place but the first differs from the one before it.

    Returns
    -------
    first, last : ndarray of int64, shape (Q,)
    """
    cuts = differs.nonzero()[0]
    before = np.empty(cuts.size + 2, dtype=np.int64)
    before[0], before[1:-1], before[-1] = -1, cuts, differs.size
    return before[:-1] + 1, before[1:]


def unit_vectors(bearing: FloatArray, theta: FloatArray) -> FloatArray:
    """Return unit vectors (2, ...) of bearings, (...), relative to headings, rad."""
    # A full turn ends where it began, to the last bit: its seam must cancel.
    absolute = np.where(bearing >= np.pi, -np.pi, bearing) + theta
    return np.array([np.cos(absolute), np.sin(absolute)])


def points_on_faces(outline: Outline, faces: SeenFaces, piece: IntArray) -> FloatArray:
    """Return where pieces of an outline start and end on their faces.

    Parameters
    ----------
    outline : Outline
        Pieces of bearing.
    faces : SeenFaces
        Their faces.
    piece : ndarray of int64, shape (Q,)
        Those wanted; each has a face. A bearing may pass the face's end by the
        tolerance; the point then lies on the face's prolongation.

    Returns
    -------
    ndarray of float64, shape (2, 2, Q)
        x and y from the robot, px, of start and end.
    """
    face = outline.face[piece]
    side, depth = faces.side[face], faces.depth[face]
    cos, sin = SIDE_COS[side], SIDE_SIN[side]
    sideways = depth * lateral_slopes(outline, faces, piece)
    return np.array([depth * cos - sideways * sin, depth * sin + sideways * cos])


def lateral_slopes(outline: Outline, faces: SeenFaces, piece: IntArray) -> FloatArray:
    """Return how far sideways rays move per step ahead, in their face's frame.

    Parameters
    ----------
    outline, faces, piece
        As in `points_on_faces`.

    Returns
    -------
    ndarray of float64, shape (2, Q)
        The tangents of the angles between looking direction and the rays at which the
        pieces start and end.
    """
    x, y = outline.ends.take(piece, axis=2)
    face = outline.face[piece]
    side = faces.side[face]
    cos, sin = SIDE_COS[side], SIDE_SIN[side]
    ahead = np.maximum(x * cos + y * sin, outline.ahead_min[face])
    return np.asarray((y * cos - x * sin) / ahead, dtype=np.float64)

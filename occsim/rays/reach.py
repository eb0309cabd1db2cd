"""The faces that each reading of a batch can see: within reach, within the cone."""

from typing import NamedTuple, Self

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.rays.faces import N_SIDES, WallFaces
from occsim.rays.ragged import ragged_ranges, whole_within
from occsim.sensor import EDGE_EPS, Sensor

SIDE_COS = np.array([1.0, 0.0, -1.0, 0.0])
SIDE_SIN = np.array([0.0, 1.0, 0.0, -1.0])
"""Unit vector of each side's looking direction (right, down, left, up), exactly."""

# The axis, x or y, of each side's looking direction, and the other one.
_ALONG, _ACROSS = np.array([0, 1, 0, 1]), np.array([1, 0, 1, 0])

# Of each quadrant, whether its pixel lies before the robot, along x and along y.
_QUADRANT_X, _QUADRANT_Y = np.array([0, 1, 1, 0]), np.array([0, 0, 1, 1])

REACH_MAX_PX = 1e6
"""A longer reach is cut to this, farther than any image extends: the tolerances must
not vanish beside its square."""


class View(NamedTuple):
    """Where a batch of readings is taken, and how far and wide each one looks.

    Parameters
    ----------
    places : ndarray of float64, shape (2, N)
        x and y of the robot, px.
    theta : ndarray of float64, shape (N,)
        Its heading, rad; 0 where the field of view is a full turn.
    reach : float
        Range with its tolerance, px.
    half : float
        Half the field of view with its tolerance, rad, at most pi.
    """

    places: FloatArray
    theta: FloatArray
    reach: float
    half: float

    @classmethod
    def of(cls, poses: FloatArray, sensor: Sensor) -> Self:
        """Return the view of a sensor at poses of shape (N, 3)."""
        coordinates = np.ascontiguousarray(poses.T)
        half = min(0.5 * sensor.fov_rad + EDGE_EPS, np.pi)
        # Bearings are small beside no heading: what they add to 1e16 rad would be lost.
        theta = wrap_angle(coordinates[2])
        if half == np.pi:
            # A full turn has no heading, only a seam. Laid along a row of pixels it
            # meets no pixel centre whose ray grazes a corner, which on the seam would
            # be stopped on one of its sides alone.
            theta = np.zeros(len(poses))
        reach = min(sensor.range_px, REACH_MAX_PX) + EDGE_EPS
        return cls(coordinates[:2], theta, reach, half)

    @property
    def size(self) -> int:
        """Number N of readings."""
        return self.theta.size


class SeenFaces(NamedTuple):
    """Faces from where the robot stands, cut to its reach and field of view.

    In the frame of its side a face is the line ``depth`` ahead, from ``low`` to
    ``high`` to the right (clockwise) of straight ahead. A face of depth 0 stands for
    wall that begins at the robot itself.

    Parameters
    ----------
    reading, side : ndarray of int64, shape (K,)
        Reading of the batch, and the way that one looks to see the face.
    line : ndarray of float64, shape (3, K)
        Depth, low and high, px.
    bearing : ndarray of float64, shape (2, K)
        Bearings of begin and end relative to the heading, rad, begin < end.
    """

    reading: IntArray
    side: IntArray
    line: FloatArray
    bearing: FloatArray

    @property
    def size(self) -> int:
        """Number K of faces."""
        return self.side.size

    @property
    def depth(self) -> FloatArray:
        """How far ahead each face lies, (K,), px."""
        depth: FloatArray = self.line[0]
        return depth

    def take(self, which: IntArray) -> "SeenFaces":
        """Return some of the faces."""
        return SeenFaces(
            self.reading[which],
            self.side[which],
            self.line.take(which, axis=1),
            self.bearing.take(which, axis=1),
        )

    def ahead_min(self) -> FloatArray:
        """Return the least cosine between looking direction and a point of each face.

        Shape (K,), in (0, 1]; bounds the division that places a bearing on the face.
        """
        depth, low, high = self.line
        here = depth == 0.0
        least = depth / np.hypot(depth + here, np.maximum(-low, high))
        # Grazing rays pass the end by the tolerance. Half of the least keeps the
        # division sound where the robot is all but in line with the face.
        least = np.maximum(least - 2.0 * EDGE_EPS, 0.5 * least)
        return np.asarray(np.where(here, 1.0, least), dtype=np.float64)


def _joined(one: SeenFaces, other: SeenFaces) -> SeenFaces:
    return SeenFaces(
        np.concatenate([one.reading, other.reading]),
        np.concatenate([one.side, other.side]),
        np.concatenate([one.line, other.line], axis=1),
        np.concatenate([one.bearing, other.bearing], axis=1),
    )


def seen_faces(faces: WallFaces, occupied: BoolArray, view: View) -> SeenFaces:
    """Return every face that may stop a ray of a batch of readings.

    Parameters
    ----------
    faces : WallFaces
        The world's.
    occupied : ndarray of bool, shape (H, W)
        Its wall pixels.
    view : View
        N readings.

    Returns
    -------
    SeenFaces
        Faces that hide one another are all there.
    """
    seen = _in_field_of_view(_in_reach(faces, view), view.half)
    reading, quadrant = first_pixel_is_wall(occupied, view).nonzero()
    if not reading.size:
        return seen
    here = _wall_at_robot(reading, quadrant, view)
    return _joined(seen, _in_field_of_view(here, view.half))


def _in_reach(faces: WallFaces, view: View) -> SeenFaces:
    """Return the faces that come within reach of each reading."""
    n, n_places = view.size, faces.first_at.shape[1]
    along, across = view.places[_ALONG], view.places[_ACROSS]
    # A face in line with the robot cannot stop a ray: depths run from EDGE_EPS.
    reach = np.array([view.reach, view.reach, -EDGE_EPS, -EDGE_EPS])[:, None]
    # Faces lie at whole positions: the first within, and the first beyond.
    place = np.array([np.ceil(along - reach[::-1]), np.floor(along + reach) + 1.0])
    at = (
        whole_within(place, n_places - 1)
        + np.arange(0, N_SIDES * n_places, n_places)[:, None]
    )
    # Side by side, all readings at each: reading r looks along side k as k n + r.
    first, stop = faces.first_at.ravel()[at].reshape(2, -1)
    look, face = ragged_ranges(first, stop)
    line = np.empty((3, look.size))
    depth, low, high = line
    np.abs(faces.position[face] - along.ravel()[look], out=depth)
    middle = across.ravel()[look]
    np.subtract(faces.start[face], middle, out=low)
    np.subtract(faces.stop[face], middle, out=high)
    # Looking down and left, clockwise runs against the axis.
    turned = slice(*look.searchsorted([n, 3 * n]))
    low[turned], high[turned] = -high[turned], -low[turned]
    chord = np.sqrt(np.maximum(view.reach**2 - depth**2, 0.0))
    np.maximum(low, -chord, out=low)
    np.minimum(high, chord, out=high)
    kept = (low < high).nonzero()[0]
    side, reading = np.divmod(look[kept], n)
    line = line.take(kept, axis=1)
    bearing = _relative_bearings(
        side, np.arctan2(line[1:], line[0]), view.theta[reading]
    )
    return SeenFaces(reading, side, line, bearing)


def _relative_bearings(
    side: IntArray, ends: FloatArray, theta: FloatArray
) -> FloatArray:
    """Return bearings relative to the heading, widened so that grazing rays stop."""
    begin = wrap_angle(ends[0] + (side * (0.5 * np.pi) - EDGE_EPS) - theta)
    return np.array([begin, begin + (ends[1] - ends[0] + 2.0 * EDGE_EPS)])


def first_pixel_is_wall(occupied: BoolArray, view: View) -> BoolArray:
    """Return whether a ray leads straight into wall, by the quadrant it leads into.

    On a pixel's edge or corner the answer differs between quadrants; elsewhere it is
    whether the robot stands in a wall pixel.

    Parameters
    ----------
    occupied : ndarray of bool, shape (H, W)
        Wall pixels.
    view : View
        N readings.

    Returns
    -------
    ndarray of bool, shape (N, 4)
        Quadrant q holds the bearings from ``q pi / 2`` to ``(q + 1) pi / 2``.
    """
    height, width = occupied.shape
    # The pixels after the robot, and before it, along x and along y.
    near = np.array([np.floor(view.places), np.ceil(view.places) - 1.0])
    pixel = whole_within(near, np.array([[width - 1.0], [height - 1.0]]))
    inside = pixel == near
    col, row = pixel[_QUADRANT_X, 0], pixel[_QUADRANT_Y, 1]
    inside = inside[_QUADRANT_X, 0] & inside[_QUADRANT_Y, 1]
    return np.asarray((inside & occupied[row, col]).T)


def _wall_at_robot(reading: IntArray, quadrant: IntArray, view: View) -> SeenFaces:
    """Return faces of depth 0 for the quadrants in which wall begins at once."""
    ends = np.zeros((2, reading.size))
    ends[1] = 0.5 * np.pi
    bearing = _relative_bearings(quadrant, ends, view.theta[reading])
    return SeenFaces(reading, quadrant, np.zeros((3, reading.size)), bearing)


def _in_field_of_view(faces: SeenFaces, half: float) -> SeenFaces:
    """Return the faces cut to bearings within half of the heading."""
    # Behind the robot bearings jump from pi to -pi: such a face is seen at both ends.
    turned = faces.bearing - 2.0 * np.pi
    across = (turned[1] > -half).nonzero()[0]
    if across.size:
        behind = faces._replace(bearing=turned).take(across)
        faces = _joined(faces, behind)
    bearing = np.minimum(np.maximum(faces.bearing, -half), half)
    kept = (bearing[0] < bearing[1]).nonzero()[0]
    return faces._replace(bearing=bearing).take(kept)

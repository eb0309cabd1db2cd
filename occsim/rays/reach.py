"""The faces that each reading of a batch can see: within reach, within the cone."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.rays.faces import N_SIDES, WallFaces
from occsim.rays.ragged import ragged_ranges
from occsim.sensor import EDGE_EPS, Sensor

SIDE_COS = np.array([1.0, 0.0, -1.0, 0.0])
SIDE_SIN = np.array([0.0, 1.0, 0.0, -1.0])
"""Unit vector of each side's looking direction (right, down, left, up), exactly."""

REACH_MAX_PX = 1e6
"""A longer reach is cut to this, farther than any image extends: the tolerances must
not vanish beside its square."""


@dataclass(frozen=True, eq=False)
class View:
    """Where a batch of readings is taken, and how far and wide each one looks.

    Parameters
    ----------
    x, y : ndarray of float64, shape (N,)
        The robot, px.
    theta : ndarray of float64, shape (N,)
        Its heading, rad; 0 where the field of view is a full turn.
    reach : float
        Range with its tolerance, px.
    half : float
        Half the field of view with its tolerance, rad, at most pi.
    """

    x: FloatArray
    y: FloatArray
    theta: FloatArray
    reach: float
    half: float

    @classmethod
    def of(cls, poses: FloatArray, sensor: Sensor) -> Self:
        """Return the view of a sensor at poses of shape (N, 3)."""
        x, y, theta = np.ascontiguousarray(poses.T)
        half = min(0.5 * sensor.fov_rad + EDGE_EPS, np.pi)
        # Bearings are small beside no heading: what they add to 1e16 rad would be lost.
        theta = wrap_angle(theta)
        if half == np.pi:
            # A full turn has no heading, only a seam. Laid along a row of pixels it
            # meets no pixel centre whose ray grazes a corner, which on the seam would
            # be stopped on one of its sides alone.
            theta = np.zeros_like(x)
        reach = min(sensor.range_px, REACH_MAX_PX) + EDGE_EPS
        return cls(x, y, theta, reach, half)

    @property
    def size(self) -> int:
        """Number N of readings."""
        return self.x.size

    def axes(self) -> tuple[tuple[FloatArray, FloatArray], ...]:
        """Return the coordinates along, and across, looking right and down."""
        return (self.x, self.y), (self.y, self.x)


@dataclass(frozen=True, eq=False)
class SeenFaces:
    """Faces from where the robot stands, cut to its reach and field of view.

    In the frame of its side a face is the line ``depth`` ahead, from ``low`` to
    ``high`` to the right (clockwise) of straight ahead. A face of depth 0 stands for
    wall that begins at the robot itself.

    Parameters
    ----------
    reading, side : ndarray of int64, shape (K,)
        Reading of the batch, and the way that one looks to see the face.
    depth, low, high : ndarray of float64, shape (K,)
        px.
    begin, end : ndarray of float64, shape (K,)
        Bearings of its ends relative to the heading, rad, begin < end.
    """

    reading: IntArray
    side: IntArray
    depth: FloatArray
    low: FloatArray
    high: FloatArray
    begin: FloatArray
    end: FloatArray

    def take(self, which: BoolArray | IntArray) -> "SeenFaces":
        """Return some of the faces."""
        return SeenFaces(*(getattr(self, name)[which] for name in _FIELDS))

    def ahead_min(self) -> FloatArray:
        """Return the least cosine between looking direction and a point of each face.

        Returns
        -------
        ndarray of float64, shape (K,)
            In (0, 1]; bounds the division that places a bearing on the face.
        """
        farthest = np.maximum(-self.low, self.high)
        here = self.depth == 0.0
        least = self.depth / np.hypot(self.depth + here, farthest)
        # Grazing rays pass the end by the tolerance. Half of the least keeps the
        # division sound where the robot is all but in line with the face.
        least = np.maximum(least - 2.0 * EDGE_EPS, 0.5 * least)
        return np.asarray(np.where(here, 1.0, least), dtype=np.float64)


_FIELDS = tuple(SeenFaces.__dataclass_fields__)


def _joined(parts: list[SeenFaces]) -> SeenFaces:
    return SeenFaces(
        *(np.concatenate([getattr(part, name) for part in parts]) for name in _FIELDS)
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
    around = first_pixel_is_wall(occupied, view)
    if not around.any():
        return seen
    return _joined([seen, _in_field_of_view(_wall_at_robot(around, view), view.half)])


def _in_reach(faces: WallFaces, view: View) -> SeenFaces:
    """Return the faces that come within reach of each reading."""
    n, first, stop = view.size, list[IntArray](), list[IntArray]()
    for k in range(N_SIDES):
        along = view.x if k % 2 == 0 else view.y
        # A face in line with the robot cannot stop a ray: depths run from EDGE_EPS.
        ends = (EDGE_EPS, view.reach) if k < 2 else (-view.reach, -EDGE_EPS)
        position = faces.position[faces.bounds[k] : faces.bounds[k + 1]]
        first.append(position.searchsorted(along + ends[0], "left") + faces.bounds[k])
        stop.append(position.searchsorted(along + ends[1], "right") + faces.bounds[k])
    # Side by side, all readings at each: reading r looks along side k as k n + r.
    look, face = ragged_ranges(np.concatenate(first), np.concatenate(stop))
    along, across = (np.concatenate(pair * 2) for pair in view.axes())
    depth = np.abs(faces.position[face] - along[look])
    across = across[look]
    low, high = faces.start[face] - across, faces.stop[face] - across
    # Looking down and left, clockwise runs against the axis.
    turned = slice(*look.searchsorted([n, 3 * n]))
    low[turned], high[turned] = -high[turned], -low[turned]
    chord = np.sqrt(np.maximum(view.reach**2 - depth**2, 0.0))
    low, high = np.maximum(low, -chord), np.minimum(high, chord)
    kept = (low < high).nonzero()[0]
    look, depth, low, high = look[kept], depth[kept], low[kept], high[kept]
    side, reading = np.divmod(look, n)
    left, right = np.arctan2(low, depth), np.arctan2(high, depth)
    begin, end = _relative_bearings(side, left, right, view.theta[reading])
    return SeenFaces(reading, side, depth, low, high, begin, end)


def _relative_bearings(
    side: IntArray, left: FloatArray, right: FloatArray, theta: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return bearings relative to the heading, widened so that grazing rays stop."""
    begin = wrap_angle(left + (side * (0.5 * np.pi) - EDGE_EPS) - theta)
    return begin, begin + (right - left + 2.0 * EDGE_EPS)


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
    right, left = np.floor(view.x), np.ceil(view.x) - 1.0
    down, up = np.floor(view.y), np.ceil(view.y) - 1.0
    col = np.stack([right, left, left, right], axis=1)
    row = np.stack([down, down, up, up], axis=1)
    inside = (col >= 0) & (row >= 0) & (col < width) & (row < height)
    col, row = np.where(inside, col, 0), np.where(inside, row, 0)
    return np.asarray(inside & occupied[row.astype(np.intp), col.astype(np.intp)])


def _wall_at_robot(around: BoolArray, view: View) -> SeenFaces:
    """Return faces of depth 0 for the quadrants in which wall begins at once."""
    reading, quadrant = np.nonzero(around)
    zero = np.zeros(reading.size)
    begin, end = _relative_bearings(
        quadrant, zero, zero + 0.5 * np.pi, view.theta[reading]
    )
    return SeenFaces(reading, quadrant, zero, zero, zero, begin, end)


def _in_field_of_view(faces: SeenFaces, half: float) -> SeenFaces:
    """Return the faces cut to bearings within half of the heading."""
    # Behind the robot bearings jump from pi to -pi: such a face is seen at both ends.
    across = (faces.end > np.pi).nonzero()[0]
    if across.size:
        behind = faces.take(across)
        turned = (behind.begin - 2.0 * np.pi, behind.end - 2.0 * np.pi)
        faces = _joined([faces, replace(behind, begin=turned[0], end=turned[1])])
    begin, end = np.maximum(faces.begin, -half), np.minimum(faces.end, half)
    kept = (begin < end).nonzero()[0]
    return SeenFaces(
        faces.reading[kept],
        faces.side[kept],
        faces.depth[kept],
        faces.low[kept],
        faces.high[kept],
        begin[kept],
        end[kept],
    )

"""A trajectory: the poses at which the robot takes its readings."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError, TrajectoryError, choice
from occsim.geometry import CARDINAL_HEADINGS_RAD, snap_heading
from occsim.world import World

MAX_RESAMPLED = 50_000
"""Most poses that `resample` makes; as many as a trajectory file may hold."""

# Positions nearer than this, px, are the same: far below what a drawing can show.
_SAME_PLACE_PX = 1e-6


class HeadingMode(Enum):
    """Where the robot looks along a path.

    Examples
    --------
    >>> from occsim import HeadingMode, resample
    >>> path = [(0.0, 0.0), (10.0, 5.0)]
    >>> resample(path, 20.0, heading_mode=HeadingMode.CARDINAL).poses[:, 2]
    array([0., 0.])
    """

    ALONG = "along"
    """Along the path."""
    CARDINAL = "cardinal"
    """The nearest of right, down, left and up."""
    FOUR = "four"
    """All of the four at each position, one reading each."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses in the image frame, one reading each, in order.

    Parameters
    ----------
    poses : array_like of shape (S, 3)
        Columns x_px, y_px, theta_rad; S at least 1. Any sub-pixel position and any
        heading. A private float64 copy is kept, never written to.

    Raises
    ------
    TrajectoryError
        Where the shape is another, or a value is not finite.

    Examples
    --------
    >>> from occsim import Trajectory
    >>> trajectory = Trajectory([(10.5, 4.0, 0.0), (12.5, 4.0, 0.0)])
    >>> len(trajectory), trajectory.poses.shape
    (2, (2, 3))
    """

    poses: FloatArray

    def __post_init__(self) -> None:
        try:
            poses = np.array(self.poses, dtype=np.float64, order="C")
        except (TypeError, ValueError):
            raise TrajectoryError(
                "poses must be numbers in rows of x_px, y_px, theta_rad; got "
                f"{type(self.poses).__name__} that does not convert"
            ) from None
        if poses.ndim != 2 or poses.shape[1] != 3 or poses.shape[0] < 1:
            raise TrajectoryError(
                "poses must have shape (S, 3) with at least one row of "
                f"x_px, y_px, theta_rad; got shape {poses.shape}"
            )
        finite = np.isfinite(poses).all(axis=1)
        if not finite.all():
            row = int(np.flatnonzero(~finite)[0])
            raise TrajectoryError(
                f"every pose must be finite; pose {row + 1} is {poses[row].tolist()}"
            )
        poses.setflags(write=False)
        object.__setattr__(self, "poses", poses)

    def __len__(self) -> int:
        return len(self.poses)


def outside_drawing(trajectory: Trajectory, world: World) -> BoolArray:
    """Return which poses lie outside the drawing.

    Parameters
    ----------
    trajectory : Trajectory
        S poses.
    world : World
        Gives the size of the drawing.

    Returns
    -------
    ndarray of bool, shape (S,)
    """
    height, width = world.shape
    x, y = trajectory.poses[:, 0], trajectory.poses[:, 1]
    return np.asarray((x < 0) | (y < 0) | (x >= width) | (y >= height))


def inside_walls(trajectory: Trajectory, world: World) -> BoolArray:
    """Return which poses stand in a wall pixel.

    Parameters
    ----------
    trajectory : Trajectory
        S poses.
    world : World
        Ground truth.

    Returns
    -------
    ndarray of bool, shape (S,)
        False for poses outside the drawing (see `outside_drawing`).
    """
    off = outside_drawing(trajectory, world)
    cols, rows = np.floor(
        np.where(off[:, None], 0.0, trajectory.poses[:, :2])
    ).T.astype(np.int64)
    return np.asarray(world.occupied[rows, cols] & ~off)


def drop_poses(trajectory: Trajectory, drop: BoolArray) -> Trajectory:
    """Return the trajectory without the marked poses.

    Parameters
    ----------
    trajectory : Trajectory
        S poses.
    drop : ndarray of bool, shape (S,)
        True for poses to leave out.

    Returns
    -------
    Trajectory

    Raises
    ------
    TrajectoryError
        Where nothing would remain.
    """
    if drop.all():
        raise TrajectoryError(
            f"all {len(trajectory)} poses are in walls or outside the drawing; "
            "at least one must stand in free space"
        )
    return Trajectory(poses=trajectory.poses[~drop])


def resample(
    waypoints_px: npt.ArrayLike,
    step_px: float,
    *,
    heading_mode: HeadingMode = HeadingMode.ALONG,
    turn_at_waypoints: bool | npt.ArrayLike = False,
) -> Trajectory:
    """Return poses at equal steps along a path.

    Parameters
    ----------
    waypoints_px : array_like of shape (K, 2)
        x, y of the path's corners, px; K at least 1. A waypoint that repeats the one
        before it is left out.
    step_px : float
        Along the path from one position to the next, px, above 0.
    heading_mode : HeadingMode, default HeadingMode.ALONG
        Where the robot looks. At a corner, along the part that leaves it; at the end,
        along the last part. A path of one waypoint looks right.
    turn_at_waypoints : bool or array_like of bool, shape (K,), default False
        Whether the robot stops at each waypoint, or at these, and looks in the four
        directions, starting with the one nearest to its heading, clockwise on the
        screen.

    Returns
    -------
    Trajectory
        Positions every `step_px` from the first waypoint on, the last waypoint, and
        the waypoints at which it turns.

    Raises
    ------
    TrajectoryError
        Where there are no waypoints, or they are not pairs of finite numbers, or more
        than `MAX_RESAMPLED` poses would result.
    ParameterError
        Where the step is not above 0, the mode is no `HeadingMode`, or
        `turn_at_waypoints` has another shape.

    Examples
    --------
    >>> from occsim import resample
    >>> resample([(0.0, 0.0), (10.0, 0.0)], 5.0).poses
    array([[ 0.,  0.,  0.],
           [ 5.,  0.,  0.],
           [10.,  0.,  0.]])
    """
    points, is_new = _waypoints(waypoints_px)
    turning = _turning(turn_at_waypoints, is_new)
    if not 0.0 < step_px < np.inf:
        raise ParameterError(f"step_px must be above 0 and finite; got {step_px!r}")
    heading_mode = choice("heading_mode", heading_mode, HeadingMode)
    leg = np.diff(points, axis=0)
    passed_px = np.concatenate([[0.0], np.cumsum(np.hypot(leg[:, 0], leg[:, 1]))])
    _require_few_poses(passed_px[-1], step_px, heading_mode, int(turning.sum()))
    stops = np.union1d(passed_px[turning], passed_px[-1:])
    along, is_stop = _positions_along(passed_px[-1], step_px, stops)
    x, y = (np.interp(along, passed_px, axis) for axis in points.T)
    way = np.arctan2(leg[:, 1], leg[:, 0]) if len(leg) else np.zeros(1)
    leaving = np.searchsorted(passed_px, along, side="right") - 1
    theta = way[np.clip(leaving, 0, len(way) - 1)]
    turns = is_stop & np.isin(along, passed_px[turning])
    return Trajectory(poses=_with_looks(x, y, theta, turns, heading_mode))


def _waypoints(waypoints_px: npt.ArrayLike) -> tuple[FloatArray, BoolArray]:
    """Return the waypoints that differ from the one before, and flags for them."""
    try:
        points = np.asarray(waypoints_px, dtype=np.float64)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.ndim != 2 or points.shape[1] != 2 or not len(points):
        raise TrajectoryError(
            "waypoints must be one or more pairs x_px, y_px; "
            f"got {np.shape(points)} values that are not"
        )
    if not np.isfinite(points).all():
        raise TrajectoryError("every waypoint must be finite; got NaN or infinity")
    moved = np.hypot(*np.diff(points, axis=0).T) > _SAME_PLACE_PX
    is_new = np.concatenate([[True], moved])
    return np.asarray(points[is_new]), is_new


def _turning(turn_at_waypoints: bool | npt.ArrayLike, is_new: BoolArray) -> BoolArray:
    """Return at which of the waypoints that are new the robot turns."""
    turning = np.asarray(turn_at_waypoints, dtype=bool)
    if turning.ndim and turning.shape != is_new.shape:
        raise ParameterError(
            "turn_at_waypoints must be one truth value, or one for each of the "
            f"{len(is_new)} waypoints; got shape {turning.shape}"
        )
    # Of waypoints at one place, one that turns is enough.
    each = np.broadcast_to(turning, is_new.shape)
    return np.asarray(np.logical_or.reduceat(each, np.flatnonzero(is_new)))


def _require_few_poses(
    length_px: float, step_px: float, mode: HeadingMode, n_turns: int
) -> None:
    n_steps, n_looks = length_px / step_px + 1.0, len(CARDINAL_HEADINGS_RAD)
    n_poses = n_steps * (n_looks if mode is HeadingMode.FOUR else 1)
    n_poses += n_looks * n_turns
    if n_poses > MAX_RESAMPLED:
        raise TrajectoryError(
            f"a path of {length_px:,.0f} px in steps of {step_px:g} px makes about "
            f"{n_poses:,.0f} poses; at most {MAX_RESAMPLED:,} are allowed"
        )


def _positions_along(
    total_px: float, step_px: float, stops_px: FloatArray
) -> tuple[FloatArray, BoolArray]:
    """Return the distances along the path of all positions, and which are stops."""
    regular = np.arange(0.0, total_px, step_px)
    # A regular position within rounding of a stop is that stop.
    after = np.searchsorted(stops_px, regular)
    beyond = np.append(stops_px, np.inf)[after] - regular
    before = regular - np.insert(stops_px, 0, -np.inf)[after]
    regular = regular[np.minimum(beyond, before) > _SAME_PLACE_PX]
    along = np.concatenate([regular, stops_px])
    order = np.argsort(along, kind="stable")
    return along[order], order >= len(regular)


def _with_looks(
    x: FloatArray, y: FloatArray, theta: FloatArray, turns: BoolArray, mode: HeadingMode
) -> FloatArray:
    """Return poses, one at each position, or four where the robot turns."""
    turns = turns | (mode is HeadingMode.FOUR)
    nearest = snap_heading(theta)
    around = np.mod(nearest[:, None] + CARDINAL_HEADINGS_RAD, 2.0 * np.pi)
    ahead = theta if mode is HeadingMode.ALONG else nearest
    around[:, 0] = np.where(turns, nearest, ahead)
    looks = np.repeat(turns[:, None], around.shape[1], axis=1)
    looks[:, 0] = True
    position = np.nonzero(looks)[0]
    return np.stack([x[position], y[position], around[looks]], axis=1)

"""Metric frames with y up, as ROS, TUM and CARMEN use them, each way."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray
from occsim.errors import ParameterError
from occsim.geometry import wrap_angle
from occsim.trajectory import Trajectory

MAX_MAP_PIXELS = 16_000_000
"""Largest map of a robot, px: 200 m x 200 m at 5 cm."""


@dataclass(frozen=True, kw_only=True, slots=True)
class MetricFrame:
    """Where a drawing lies in a metric frame: x right, y up, headings to the left.

    The convention of a ROS map file.

    Parameters
    ----------
    height_px : int
        Height of the drawing, px, 1 or more.
    metres_per_px : float
        Scale (a map file's ``resolution``), above 0.
    origin_x_m, origin_y_m : float, default 0
        Where the drawing's lower left corner lies, m (a map file's ``origin``).
    origin_yaw_rad : float, default 0
        By how much the drawing is turned to the left about that corner, rad.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim.io.metric import MetricFrame, poses_to_image
    >>> frame = MetricFrame(height_px=100, metres_per_px=0.05)
    >>> poses_to_image([[1.0, 0.0, 0.0]], frame).poses
    array([[ 20., 100.,   0.]])
    """

    height_px: int
    metres_per_px: float
    origin_x_m: float = 0.0
    origin_y_m: float = 0.0
    origin_yaw_rad: float = 0.0

    def __post_init__(self) -> None:
        if self.height_px < 1:
            raise ParameterError(f"height_px must be 1 or more; got {self.height_px!r}")
        if not 0.0 < self.metres_per_px < np.inf:
            raise ParameterError(
                f"metres_per_px must be above 0 and finite; got {self.metres_per_px!r}"
            )
        origin = self.origin_x_m, self.origin_y_m, self.origin_yaw_rad
        if not np.isfinite(origin).all():
            raise ParameterError(f"the origin must be finite; got {origin!r}")


def poses_to_image(poses_m: npt.ArrayLike, frame: MetricFrame) -> Trajectory:
    """Return metric poses in the image frame.

    Parameters
    ----------
    poses_m : array_like of shape (S, 3)
        x, y, m, and heading, rad, counted from +x towards +y, that is to the left;
        for example the `values` of a `TrajectoryTable` read from a TUM file.
    frame : MetricFrame
        Where the drawing lies.

    Returns
    -------
    Trajectory
        Headings in [-pi, pi).

    Raises
    ------
    TrajectoryError
        Where the poses are not finite rows of three.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim.io.metric import MetricFrame, poses_to_image
    >>> frame = MetricFrame(height_px=100, metres_per_px=0.05)
    >>> poses_to_image([[1.0, 1.0, np.pi / 2]], frame).poses.round(3)
    array([[20.   , 80.   , -1.571]])
    """
    metric = Trajectory(poses=np.asarray(poses_m))
    x_m, y_m, yaw = metric.poses.T
    with np.errstate(over="ignore", invalid="ignore"):  # infinity is refused below
        dx, dy = x_m - frame.origin_x_m, y_m - frame.origin_y_m
        right, up = _turned(dx, dy, -frame.origin_yaw_rad)
        x_px = right / frame.metres_per_px
        y_px = frame.height_px - up / frame.metres_per_px
    theta = wrap_angle(frame.origin_yaw_rad - yaw)
    return Trajectory(poses=np.stack([x_px, y_px, theta], axis=1))


def poses_to_metric(trajectory: Trajectory, frame: MetricFrame) -> FloatArray:
    """Return a trajectory's poses in the metric frame.

    Parameters
    ----------
    trajectory : Trajectory
        S poses in the image frame.
    frame : MetricFrame
        Where the drawing lies.

    Returns
    -------
    ndarray of float64, shape (S, 3)
        x, y, m, and heading, rad, from +x towards +y, in [-pi, pi).

    Examples
    --------
    >>> from occsim import Trajectory
    >>> from occsim.io.metric import MetricFrame, poses_to_metric
    >>> frame = MetricFrame(height_px=100, metres_per_px=0.05)
    >>> poses_to_metric(Trajectory([(20.0, 80.0, 0.5)]), frame)
    array([[ 1. ,  1. , -0.5]])
    """
    x_px, y_px, theta = trajectory.poses.T
    right = x_px * frame.metres_per_px
    up = (frame.height_px - y_px) * frame.metres_per_px
    dx, dy = _turned(right, up, frame.origin_yaw_rad)
    x_m, y_m = frame.origin_x_m + dx, frame.origin_y_m + dy
    return np.stack([x_m, y_m, wrap_angle(frame.origin_yaw_rad - theta)], axis=1)


def _turned(
    x: FloatArray, y: FloatArray, yaw_rad: float
) -> tuple[FloatArray, FloatArray]:
    """Return vectors turned to the left, exactly as they are for a turn of 0."""
    cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
    return x * cos - y * sin, x * sin + y * cos

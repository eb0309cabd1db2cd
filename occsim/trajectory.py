"""A trajectory: the poses at which the robot takes its readings."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.errors import TrajectoryError
from occsim.world import World


@dataclass(frozen=True, eq=False, kw_only=True)
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


def outside(trajectory: Trajectory, world: World) -> BoolArray:
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
        False for poses outside the drawing (see `outside`).
    """
    off = outside(trajectory, world)
    cols, rows = np.floor(
        np.where(off[:, None], 0.0, trajectory.poses[:, :2])
    ).T.astype(np.int64)
    return np.asarray(world.occupied[rows, cols] & ~off)


def without(trajectory: Trajectory, drop: BoolArray) -> Trajectory:
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

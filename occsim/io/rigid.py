"""Poses in space by time, and what they are in the plane of a map."""

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation, Slerp

from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError


def poses_at(times_s: FloatArray, samples: npt.ArrayLike) -> FloatArray:
    """Return poses at any time, interpolated between samples.

    Parameters
    ----------
    times_s : ndarray of float64, shape (S,)
        When they are wanted; within those of the samples where there is more than one.
    samples : array_like of shape (K, 8)
        t, x, y, z, qx, qy, qz, qw, as a TUM file has them: s, m, and quaternions of any
        length but 0, in any order. Of samples of one time the first counts. One sample
        alone stands for all times.

    Returns
    -------
    ndarray of float64, shape (S, 4, 4)
        Homogeneous matrices: positions on a line between their neighbours, turns at
        constant speed (spherical linear interpolation).

    Raises
    ------
    ParameterError
        Where there is no sample, a value is not finite, or a quaternion is 0.

    Examples
    --------
    >>> from occsim.io.rigid import in_plane, poses_at
    >>> half_turn = [[0, 0, 0, 0, 0, 0, 0, 1], [2, 4, 0, 0, 0, 0, 1, 0]]
    >>> in_plane(poses_at(np.array([1.0]), half_turn))[0].round(3)
    array([[2.   , 0.   , 1.571]])
    """
    rows = np.asarray(samples, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 8 or not len(rows):
        raise ParameterError(
            "samples of poses must have shape (K, 8), t x y z qx qy qz qw, K at least "
            f"1; got shape {rows.shape}"
        )
    lengths = np.linalg.norm(rows[:, 4:], axis=1)
    if not (np.isfinite(rows).all() and (lengths > 1e-9).all()):
        raise ParameterError("samples of poses must be finite, and no quaternion 0")
    at, first = np.unique(rows[:, 0], return_index=True)
    rows = rows[first]
    poses = np.tile(np.eye(4), (len(times_s), 1, 1))
    turns = Rotation.from_quat(rows[:, 4:])
    if at.size == 1:
        poses[:, :3, 3], poses[:, :3, :3] = rows[0, 1:4], turns.as_matrix()[0]
        return poses
    poses[:, :3, :3] = Slerp(at, turns)(times_s).as_matrix()
    for axis in range(3):
        poses[:, axis, 3] = np.interp(times_s, at, rows[:, 1 + axis])
    return poses


def covered(times_s: FloatArray, samples: FloatArray) -> BoolArray:
    """Return which times lie within those of the samples; all where there is one."""
    at = samples[:, 0]
    if at.size == 1:
        return np.ones(len(times_s), dtype=np.bool_)
    return np.asarray((times_s >= at.min()) & (times_s <= at.max()))


def in_plane(poses: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return poses in space as a map sees them from above.

    Parameters
    ----------
    poses : ndarray of float64, shape (S, 4, 4)
        Homogeneous matrices.

    Returns
    -------
    poses_m : ndarray of float64, shape (S, 3)
        x, y, m, and heading, rad, to the left: that of the x axis. Height and tilt are
        dropped.
    upside_down : ndarray of bool, shape (S,)
        Where the z axis points down: what is to the left there is to the right here.
    """
    heading = np.arctan2(poses[:, 1, 0], poses[:, 0, 0])
    return np.column_stack([poses[:, :2, 3], heading]), poses[:, 2, 2] < 0.0

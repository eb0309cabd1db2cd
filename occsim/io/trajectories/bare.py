"""Poses from tables without titles, recognised by the number of columns.

Three are x, y, theta; eight are the TUM format's; twelve are KITTI's.
"""

import numpy as np

from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.io.trajectories.columns import PoseColumns

TUM_COLUMNS = ("timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw")
_TUM = PoseColumns(indices=(1, 2, 4, 5, 6, 7))
_LENGTH_OFF = 0.02
"""How far the length of a quaternion, or of a rotation's rows, may differ from one:
files have three digits or more."""
_FLAT = 0.05
"""Largest sine of half the tilt of a robot that counts as upright."""


def bare_columns(n_fields: int, where: str, got: str) -> PoseColumns:
    """Return what the columns of a table without titles are.

    Parameters
    ----------
    n_fields : int
        Columns in the table.
    where, got : str
        Position of the first row, and the row itself, for the message.

    Returns
    -------
    PoseColumns
        For a KITTI file, all twelve in order.

    Raises
    ------
    TrajectoryError
        Where there are neither 3 nor 8 nor 12.
    """
    if n_fields == 3:
        return PoseColumns(indices=(0, 1, 2))
    if n_fields == len(TUM_COLUMNS):
        return _TUM
    if n_fields == 12:
        return _Kitti(indices=tuple(range(12)))
    raise TrajectoryError(
        f"{where}: three columns x, y, theta are needed, or a header that names them; "
        f"got {n_fields} column{'s' * (n_fields != 1)}: {got}"
    )


class _Kitti(PoseColumns):
    """Three rows of a matrix: rotation, and place in the last column."""

    @property
    def titles(self) -> tuple[str, ...]:
        return tuple(f"number {k + 1}" for k in range(12))


def bare_poses(
    values: FloatArray, line_numbers: list[int], name: str
) -> tuple[FloatArray, dict[str, str]]:
    """Return the poses of a table without titles, and their units.

    Parameters
    ----------
    values : ndarray of float64, shape (S, 3), (S, 6) or (S, 12)
        The columns that `bare_columns` chose.
    line_numbers : list of int
        Where each row stands.
    name : str
        What to call the file.

    Returns
    -------
    poses : ndarray of float64, shape (S, 3)
    units : dict of str
        By axis, as in `PoseColumns.units`.

    Raises
    ------
    TrajectoryError
        Where the numbers cannot be rotations.
    """
    if values.shape[1] == 3:
        return values, {}
    if values.shape[1] == 12:
        return _from_matrices(values, line_numbers, name), {"x": "m", "theta": "rad"}
    _check_quaternions(values[:, 2:], line_numbers, name)
    return _TUM.poses(values), _TUM.units


def _check_quaternions(
    quaternions: FloatArray, line_numbers: list[int], name: str
) -> None:
    """Refuse eight columns that are not the TUM format's."""
    length = np.linalg.norm(quaternions, axis=1)
    bad = np.flatnonzero(np.abs(length - 1.0) > _LENGTH_OFF)
    if bad.size:
        raise TrajectoryError(
            f"{name}, line {line_numbers[bad[0]]}: the quaternion qx qy qz qw must "
            f"have length 1; got {length[bad[0]]:.3g}; eight columns other than the "
            "TUM format's need a header with their names"
        )
    # Of an upright robot, x and y of the axis are zero. With qw first they are one
    # column later.
    if not _is_flat(quaternions[:, :2]) and _is_flat(quaternions[:, 1:3]):
        raise TrajectoryError(
            f"{name}: the quaternions seem to have qw first; add a header with the "
            "names (timestamp tx ty tz qw qx qy qz)"
        )


def _is_flat(axis_xy: FloatArray) -> bool:
    return bool((np.abs(axis_xy) < _FLAT).all())


def _from_matrices(
    values: FloatArray, line_numbers: list[int], name: str
) -> FloatArray:
    """Return the poses on the floor of rows of KITTI's format.

    Its frame is a camera's, x right, y down, z ahead, so the floor is x and z; robots
    that write the format have z up. The axis that turns least is the vertical one.
    """
    matrices = values.reshape(-1, 3, 4)
    rotation, place = matrices[:, :, :3], matrices[:, :, 3]
    gram = rotation @ rotation.transpose(0, 2, 1)
    bad = np.flatnonzero(np.abs(gram - np.eye(3)).max(axis=(1, 2)) > _LENGTH_OFF)
    if bad.size:
        raise TrajectoryError(
            f"{name}, line {line_numbers[bad[0]]}: twelve numbers must be the first "
            "three rows of a pose's matrix, as in KITTI's format; these hold no "
            "rotation"
        )
    upright_y, upright_z = rotation[:, 1, 1].mean(), rotation[:, 2, 2].mean()
    across, ahead, forward = (0, 2, 2) if upright_y >= upright_z else (0, 1, 0)
    heading = np.arctan2(rotation[:, ahead, forward], rotation[:, across, forward])
    return np.column_stack([place[:, across], place[:, ahead], heading])

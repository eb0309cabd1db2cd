"""What a trajectory file says: numbers, and what is known of their units."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.trajectory import Trajectory

MAX_FILE_BYTES = 20_000_000
"""Largest file, bytes."""

MAX_POSES = 50_000
"""Most poses in a file: ten times the longest tour that maps at interactive speed."""

# A heading may be written as a full turn; text rounds it.
_FULL_TURN_RAD = 2.0 * np.pi + 1e-3

_AXES = {
    "x": {"x", "xpos", "posx", "xposition", "positionx", "tx"},
    "y": {"y", "ypos", "posy", "yposition", "positiony", "ty"},
    "theta": {
        *{"theta", "θ", "th", "yaw", "heading", "angle", "psi", "bearing"},
        *{"orientation", "direction", "rotation"},
    },
}
_UNITS = {
    **dict.fromkeys(("deg", "degree", "degrees", "°"), "deg"),
    **dict.fromkeys(("rad", "radian", "radians"), "rad"),
    **dict.fromkeys(("px", "pixel", "pixels"), "px"),
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters"), "m"),
}
_WORD = re.compile(r"[^\W\d_]+|°")


@dataclass(frozen=True, eq=False, kw_only=True)
class TrajectoryTable:
    """The poses of a file as they stand in it.

    Parameters
    ----------
    values : ndarray of float64, shape (S, 3)
        Columns x, y, theta, in the units of the file.
    degrees : bool or None
        Whether the file says that headings are in degrees (True) or radians
        (False); None where it does not say.
    metres : bool
        Whether the file says that positions are in metres.
    name : str
        What to call the file.
    """

    values: FloatArray
    degrees: bool | None = None
    metres: bool = False
    name: str = "trajectory"

    @property
    def needs_angle_unit(self) -> bool:
        """Whether somebody has to be asked for the unit of the headings."""
        return self.degrees is None

    def to_trajectory(self, degrees: bool | None = None) -> Trajectory:
        """Return the trajectory, once the unit of its headings is known.

        Parameters
        ----------
        degrees : bool, optional
            Whether headings are in degrees; overrides what the file says.
            By default what the file says; where it says nothing, radians, as long
            as every heading lies within one turn either way.

        Returns
        -------
        Trajectory

        Raises
        ------
        TrajectoryError
            Where positions are in metres, or the headings reach beyond one turn in
            radians and neither the file nor the caller gives their unit.
        """
        if self.metres:
            raise TrajectoryError(
                f"positions in {self.name} are in metres; px in the drawing are "
                "needed (columns x_px, y_px)"
            )
        unit = self.degrees if degrees is None else degrees
        poses = self.values.copy()
        if unit is None:
            self._require_within_a_turn()
        elif unit:
            poses[:, 2] = np.radians(poses[:, 2])
        return Trajectory(poses=poses)

    def _require_within_a_turn(self) -> None:
        row = int(np.argmax(np.abs(self.values[:, 2])))
        theta = float(self.values[row, 2])
        if abs(theta) > _FULL_TURN_RAD:
            raise TrajectoryError(
                f"{self.name} does not say whether headings are in degrees or "
                f"radians, and pose {row + 1} has {theta:g}, beyond one turn in "
                "radians; name the column theta_deg or theta_rad, or choose the unit"
            )


def column_axis(title: str) -> tuple[str, str]:
    """Return the axis that a column's title names, and its unit.

    Parameters
    ----------
    title : str
        For example ``"x"``, ``"Y [px]"``, ``"theta_deg"``, ``"Heading (°)"``.

    Returns
    -------
    axis : str
        "x", "y", "theta", or "" for anything else.
    unit : str
        "px", "m", "deg", "rad", or "" where none is named.
    """
    words = _WORD.findall(title.lower())
    unit = _UNITS.get(words[-1], "") if len(words) > 1 else ""
    base = "".join(words[:-1] if unit else words)
    axis = next((axis for axis, names in _AXES.items() if base in names), "")
    return axis, unit


def find_columns(titles: Sequence[str]) -> tuple[list[int], dict[str, str]] | None:
    """Return where x, y and theta stand among the titles, and their units.

    Parameters
    ----------
    titles : sequence of str
        A file's column titles.

    Returns
    -------
    indices : list of int
        Of x, y and theta; the first of each.
    units : dict of str
        By axis.

    None is returned where one of the three is missing.
    """
    found: dict[str, tuple[int, str]] = {}
    for index, title in enumerate(titles):
        axis, unit = column_axis(title)
        if axis and axis not in found:
            found[axis] = index, unit
    if len(found) < len(_AXES):
        return None
    return [found[axis][0] for axis in _AXES], {a: u for a, (_, u) in found.items()}


def table_from(values: FloatArray, units: dict[str, str], name: str) -> TrajectoryTable:
    """Return the table of some values whose units are known by axis.

    Parameters
    ----------
    values : ndarray of float64, shape (S, 3)
        Columns x, y, theta.
    units : dict of str
        By axis, as from `find_columns`; may be empty.
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
        Where there is no pose, too many, or one is not finite.
    """
    check_count(len(values), name)
    finite = np.isfinite(values).all(axis=1)
    if not finite.all():
        row = int(np.flatnonzero(~finite)[0])
        raise TrajectoryError(
            f"{name}, pose {row + 1}: every number must be finite; "
            f"got {', '.join(f'{value:g}' for value in values[row])}"
        )
    angle = units.get("theta", "")
    return TrajectoryTable(
        values=values,
        degrees={"deg": True, "rad": False}.get(angle),
        metres="m" in (units.get("x"), units.get("y")),
        name=name,
    )


def check_count(n_poses: int, name: str) -> None:
    """Refuse a file with no pose, or with too many.

    Parameters
    ----------
    n_poses : int
        Poses in the file.
    name : str
        What to call the file.

    Raises
    ------
    TrajectoryError
    """
    if n_poses < 1:
        raise TrajectoryError(
            f"{name} has no poses; at least one row of x, y, theta is needed"
        )
    if n_poses > MAX_POSES:
        raise TrajectoryError(
            f"{name} has {n_poses:,} poses; at most {MAX_POSES:,} are allowed"
        )


def check_array(shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> None:
    """Refuse an array that is no table of poses, by its header alone.

    Parameters
    ----------
    shape : tuple of int
        The array's.
    dtype : numpy.dtype
        Of its elements.
    name : str
        What to call the file.

    Raises
    ------
    TrajectoryError
    """
    if len(shape) != 2 or shape[1] != 3:
        raise TrajectoryError(
            f"the array in {name} must have shape (S, 3), rows of x, y, theta; "
            f"got {tuple(shape)}"
        )
    if dtype.kind not in "iuf":
        raise TrajectoryError(
            f"the array in {name} must hold real numbers; got {dtype}"
        )
    check_count(shape[0], name)

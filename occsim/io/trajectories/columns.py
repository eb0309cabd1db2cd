"""Find x, y and the heading in a table by the titles of its columns."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occsim._types import FloatArray

LENGTHS = {
    **dict.fromkeys(("px", "pixel", "pixels"), "px"),
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters"), "m"),
    **{"cm": "cm", "mm": "mm"},
}
METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
"""Metres by unit."""

_UNITS = LENGTHS | {
    **dict.fromkeys(("deg", "degree", "degrees", "°"), "deg"),
    **dict.fromkeys(("rad", "radian", "radians"), "rad"),
}
_NAMES = {
    **dict.fromkeys(("x", "xpos", "posx", "xposition", "tx", "px"), "x"),
    **dict.fromkeys(("y", "ypos", "posy", "yposition", "ty", "py"), "y"),
    **dict.fromkeys(("theta", "θ", "th", "yaw", "heading", "angle", "psi"), "theta"),
    **dict.fromkeys(("bearing", "orientation", "direction", "rotation"), "theta"),
    **{axis: axis for axis in ("qx", "qy", "qz", "qw")},
}
# Titles of several words, as in ROS, PlotJuggler and EuRoC: words that say what the
# last one (x, y, z or w) belongs to; words that exclude a pose; words without meaning.
_POSITION = {"p", "pos", "position", "t", "trans", "translation", "pose", "location"}
_QUATERNION = {"q", "quat", "quaternion", "orientation", "rot", "rotation"}
_OTHER = {
    *{"v", "vel", "velocity", "speed", "linear", "angular", "twist", "omega", "gyro"},
    *{"a", "acc", "accel", "acceleration", "b", "bias", "goal", "target", "error"},
    *{"cov", "covariance", "std", "sigma"},
}
_NEUTRAL = {"robot", "field", "odom", "base", "link", "map", "world", "msg", "state"}
_ROS_POSE = {"pose", "position"}  # of geometry_msgs, in metres
_WORD = re.compile(r"[^\W\d_]+|°")

QUATERNION = ("qx", "qy", "qz", "qw")


@dataclass(frozen=True, kw_only=True)
class PoseColumns:
    """Which columns of a table make its poses.

    Parameters
    ----------
    indices : tuple of int
        Of x, y and theta, or of x, y, qx, qy, qz, qw.
    length : str
        Unit of x and y: "px", "m", "cm", "mm", or "" where none is named.
    angle : str
        Unit of the heading: "deg", "rad", or "".
    """

    indices: tuple[int, ...]
    length: str = ""
    angle: str = ""

    @property
    def titles(self) -> tuple[str, ...]:
        """What to call the columns."""
        return ("x", "y", *(QUATERNION if self.is_turned else ("theta",)))

    @property
    def is_turned(self) -> bool:
        """Whether headings come as quaternions."""
        return len(self.indices) > 3

    @property
    def units(self) -> dict[str, str]:
        """Units of what `poses` gives, by axis.

        Quaternions come from robots, whose positions are in metres unless stated.
        """
        length = "m" if self.length in METRES else self.length
        if self.is_turned:
            return {"x": length or "m", "theta": "rad"}
        return {"x": length, "theta": self.angle}

    def poses(self, values: FloatArray) -> FloatArray:
        """Return x, y and heading of the chosen columns.

        Parameters
        ----------
        values : ndarray of float64, shape (S, len(indices))
            Quaternions need not be of length one.

        Returns
        -------
        ndarray of float64, shape (S, 3)
            Of a quaternion the yaw about z; tilt is dropped.
        """
        xy = values[:, :2] * METRES.get(self.length, 1.0)
        heading = values[:, 2]
        if self.is_turned:
            qx, qy, qz, qw = values[:, 2:].T
            # Of the matrix of the rotation, the direction of its first column.
            heading = np.arctan2(
                2.0 * (qw * qz + qx * qy), qw**2 + qx**2 - qy**2 - qz**2
            )
        return np.column_stack([xy, heading])


def column_axis(title: str) -> tuple[str, str]:
    """Return the axis that a column's title names, and its unit.

    Parameters
    ----------
    title : str
        For example ``"x"``, ``"Y [px]"``, ``"theta_deg"``, ``"Heading (°)"``,
        ``"p_RS_R_x [m]"``, ``"field.pose.pose.orientation.w"``.

    Returns
    -------
    axis : str
        "x", "y", "theta", "qx", "qy", "qz", "qw", or "" for anything else.
    unit : str
        "px", "m", "cm", "mm", "deg", "rad", or "" where none is named.
    """
    words = _WORD.findall(title.lower())
    unit = _UNITS.get(words[-1], "") if len(words) > 1 else ""
    words = words[:-1] if unit else words
    axis = _NAMES.get("".join(words)) or _part(words)
    if axis in ("x", "y") and set(words) >= _ROS_POSE:
        unit = unit or "m"
    return axis, unit


def _part(words: list[str]) -> str:
    """Return the axis that the last of several words names."""
    if len(words) < 2 or set(words) & _OTHER:
        return ""
    *before, last = words
    if last in ("x", "y", "z", "w") and set(before) & _QUATERNION:
        return "q" + last
    of_a_pose = set(before) & _POSITION or set(before) <= _NEUTRAL
    return _NAMES.get(last, "") if of_a_pose else ""


def find_columns(titles: Sequence[str]) -> PoseColumns | None:
    """Return which columns make the poses, by their titles in any order.

    Parameters
    ----------
    titles : sequence of str
        A file's column titles. Where several name one axis, px are taken before
        other units, else the first.

    Returns
    -------
    PoseColumns or None
        None where x, y or a heading is missing, or x and y are in different units.
    """
    found: dict[str, list[tuple[str, int]]] = {}
    for index, title in enumerate(titles):
        axis, unit = column_axis(title)
        found.setdefault(axis, []).append((unit, index))
    if "x" not in found or "y" not in found:
        return None
    x, y = (_preferred(found[axis]) for axis in ("x", "y"))
    lengths = {x[0], y[0]} - {""}
    if len(lengths) > 1 or not lengths <= set(LENGTHS.values()):
        return None
    length = next(iter(lengths), "")
    angle, index = found.get("theta", [("", -1)])[0]
    has_quaternion = all(axis in found for axis in QUATERNION)
    if has_quaternion and not angle:
        turned = (found[axis][0][1] for axis in QUATERNION)
        return PoseColumns(indices=(x[1], y[1], *turned), length=length)
    if index < 0 or angle not in ("", "deg", "rad"):
        return None
    return PoseColumns(indices=(x[1], y[1], index), length=length, angle=angle)


def _preferred(columns: list[tuple[str, int]]) -> tuple[str, int]:
    return next((column for column in columns if column[0] == "px"), columns[0])

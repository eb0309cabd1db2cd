"""What can be adjusted in wall detection; every bound is declared here, once."""

import math
from dataclasses import dataclass, field, fields
from typing import NamedTuple

from occsim.errors import ParameterError, real_number

MAX_LENGTH_PX = 1_000.0
"""Largest length that a parameter takes, px: thicker than any wall of a drawing."""


class Bounds(NamedTuple):
    """Least and largest value of a parameter, both allowed, and a handy step."""

    low: float
    high: float
    step: float


def _bounded(default: float, low: float, high: float, step: float) -> float:
    """Declare a field with its bounds; typed as the value that the field holds."""
    value: float = field(default=default, metadata={"bounds": Bounds(low, high, step)})
    return value


@dataclass(frozen=True, kw_only=True, slots=True)
class WallParams:
    """Settings of :func:`occsim.walls.detect_walls`; zero means estimated.

    Lengths are px of the drawing as given. Bounds are in :meth:`bounds`.

    Parameters
    ----------
    ink_level : float, default 0
        Darkness, as a share of the paper's brightness, from which a pixel is ink.
        Estimated: Otsu's threshold.
    shadow_window_px : float, default 0
        Window over which the paper's brightness is followed. Estimated: an eighth of
        the shorter side.
    door_fit : float, default 0.04
        How far, as a share of its radius, an arc may stray from a circle to be taken
        for a door's swing; 0 looks for no doors.
    min_wall_px : float, default 0
        Thinnest stroke that is a solid wall.
    max_gap_px : float, default 0
        Widest clear gap between the two lines of a hollow wall.
    min_piece_px : float, default 0
        Shortest group of connected walls that is kept.
    straighten : bool, default True
        Whether a tilted drawing is turned upright while its walls are looked for.

    Raises
    ------
    ParameterError
        Where a value is of the wrong type or lies outside its bounds.

    Examples
    --------
    >>> WallParams.bounds("door_fit")
    Bounds(low=0.0, high=0.2, step=0.01)
    """

    ink_level: float = _bounded(0.0, 0.0, 0.95, 0.05)
    shadow_window_px: float = _bounded(0.0, 0.0, MAX_LENGTH_PX, 10.0)
    door_fit: float = _bounded(0.04, 0.0, 0.2, 0.01)
    min_wall_px: float = _bounded(0.0, 0.0, MAX_LENGTH_PX, 0.5)
    max_gap_px: float = _bounded(0.0, 0.0, MAX_LENGTH_PX, 0.5)
    min_piece_px: float = _bounded(0.0, 0.0, MAX_LENGTH_PX, 5.0)
    straighten: bool = True

    def __post_init__(self) -> None:
        for item in fields(self):
            value = getattr(self, item.name)
            if "bounds" in item.metadata:
                object.__setattr__(self, item.name, _checked(item.name, value))
            elif not isinstance(value, bool):
                raise ParameterError(
                    f"{item.name} must be true or false; got {value!r}"
                )

    @classmethod
    def bounds(cls, name: str) -> Bounds:
        """Return the bounds of a parameter.

        Raises
        ------
        ParameterError
            Where no parameter of that name has bounds.
        """
        for item in fields(cls):
            if item.name == name and "bounds" in item.metadata:
                found: Bounds = item.metadata["bounds"]
                return found
        raise ParameterError(f"no parameter with bounds is named {name!r}")


def _checked(name: str, value: object) -> float:
    """Return a parameter's value as a float within its bounds."""
    if isinstance(value, bool):
        raise ParameterError(f"{name} must be a number; got {value!r}")
    number = real_number(name, value)
    low, high, _ = WallParams.bounds(name)
    if not (low <= number <= high and math.isfinite(number)):
        raise ParameterError(f"{name} must lie in [{low:g}, {high:g}]; got {value!r}")
    return number

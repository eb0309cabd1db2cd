"""What can be wrong with a drawing; every range is declared here, once."""

import math
from dataclasses import dataclass, field, fields, replace
from typing import NamedTuple

from occsim.errors import ParameterError, real_number, whole_number
from occsim.walls.params import Bounds


class _Domain(NamedTuple):
    """What a field allows, and the narrower range that a slider offers."""

    low: float
    high: float
    slider: Bounds
    is_whole: bool = False


def _declared(default: float, domain: _Domain) -> float:
    """Declare a field with its domain; typed as the value that the field holds."""
    value: float = field(default=default, metadata={"domain": domain})
    return value


_DEGREE = math.pi / 180.0
_SHIFT = _Domain(-1e4, 1e4, Bounds(-20.0, 20.0, 1.0))
_SHARE = _Domain(0.0, 1.0, Bounds(0.0, 1.0, 0.05))


@dataclass(frozen=True, kw_only=True, slots=True)
class DrawingFlaws:
    """Errors of a drawing; the defaults are none.

    Parameters
    ----------
    thickness_px : int, default 0
        Below 0 walls are thinned by that many px from both sides, and a line of one px
        stays of what would vanish; above 0 they are thickened on both sides.
    shift_x_px, shift_y_px : float, default 0
        How far the sheet is shifted to the right and down.
    rotation_rad : float, default 0
        How far it is turned about its centre, from +x towards +y (clockwise on the
        screen).
    scale : float, default 1
        Factor by which it is scaled about its centre.
    missing_share : float, default 0
        Share of the walls' length that is left out, in [0, 1].
    false_share : float, default 0
        Length of false walls, as a share of the walls' length, in [0, 1].
    seed : int, default 0
        Of the places of missing and false walls.

    Raises
    ------
    ParameterError
        Where a value is of the wrong type or lies outside its domain.

    Examples
    --------
    >>> DrawingFlaws.bounds("shift_x_px")
    Bounds(low=-20.0, high=20.0, step=1.0)
    """

    thickness_px: int = _declared(0, _Domain(-50, 50, Bounds(-5, 5, 1), True))  # type: ignore[assignment]
    shift_x_px: float = _declared(0.0, _SHIFT)
    shift_y_px: float = _declared(0.0, _SHIFT)
    rotation_rad: float = _declared(
        0.0, _Domain(-math.tau, math.tau, Bounds(-10 * _DEGREE, 10 * _DEGREE, _DEGREE))
    )
    scale: float = _declared(1.0, _Domain(0.1, 10.0, Bounds(0.8, 1.25, 0.01)))
    missing_share: float = _declared(0.0, _SHARE)
    false_share: float = _declared(0.0, _SHARE)
    seed: int = _declared(0, _Domain(0, 2**32 - 1, Bounds(0, 99, 1), True))  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for item in fields(self):
            value = _checked(item.name, getattr(self, item.name))
            object.__setattr__(self, item.name, value)

    @classmethod
    def bounds(cls, name: str) -> Bounds:
        """Return the range that a slider offers for a field; more is allowed.

        Raises
        ------
        ParameterError
            Where there is no field of that name.
        """
        return _domain(name).slider

    @property
    def are_none(self) -> bool:
        """Whether the drawing is left as it is, whatever the seed."""
        return replace(self, seed=0) == DrawingFlaws()


def _domain(name: str) -> _Domain:
    for item in fields(DrawingFlaws):
        if item.name == name:
            found: _Domain = item.metadata["domain"]
            return found
    raise ParameterError(f"no flaw of a drawing is named {name!r}")


def _checked(name: str, value: object) -> float:
    low, high, _, is_whole = _domain(name)
    if is_whole:
        return whole_number(name, value, int(low), int(high))
    number = real_number(name, value)
    if isinstance(value, bool) or not low <= number <= high:
        raise ParameterError(f"{name} must lie in [{low:g}, {high:g}]; got {value!r}")
    return number

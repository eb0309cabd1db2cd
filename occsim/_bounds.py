"""Parameter classes that declare the bounds of their fields, checked in one place."""

import math
from dataclasses import field, fields
from typing import Any, NamedTuple

from occsim.errors import ParameterError, real_number, whole_number


class Bounds(NamedTuple):
    """Least and largest value of a parameter, both allowed, and a handy step."""

    low: float
    high: float
    step: float


class _Domain(NamedTuple):
    """What a field allows, and the range that a slider offers."""

    low: float
    high: float
    slider: Bounds
    is_whole: bool


def bounded(
    default: float,
    slider: Bounds,
    allowed: tuple[float, float] | None = None,
    *,
    is_whole: bool = False,
) -> Any:
    """Declare a field with its bounds; typed as the value that the field holds.

    Parameters
    ----------
    default : float
        Of the field.
    slider : Bounds
        The range that a slider offers.
    allowed : tuple of float, optional
        Least and largest value, where more is allowed than a slider offers; infinity
        for no largest one.
    is_whole : bool, default False
        Whether the field holds a whole number.
    """
    low, high = allowed or (slider.low, slider.high)
    domain = _Domain(low, high, slider, is_whole)
    return field(default=default, metadata={"domain": domain})


def check_bounds(parameters: Any) -> None:
    """Check the fields with bounds of a frozen parameter class; keep plain numbers.

    Raises
    ------
    ParameterError
        Where a value is of the wrong type or lies outside its bounds.
    """
    for item in fields(parameters):
        if "domain" in item.metadata:
            value = getattr(parameters, item.name)
            number = _checked(item.name, value, item.metadata["domain"])
            object.__setattr__(parameters, item.name, number)


def slider_of(kind: Any, name: str, what: str) -> Bounds:
    """Return the range that a slider offers for a field.

    Parameters
    ----------
    kind : dataclass
        The parameter class.
    name : str
        Of the field.
    what : str
        What the fields with bounds are, for the message.

    Raises
    ------
    ParameterError
        Where no field of that name has bounds.
    """
    for item in fields(kind):
        if item.name == name and "domain" in item.metadata:
            domain: _Domain = item.metadata["domain"]
            return domain.slider
    raise ParameterError(f"no {what} is named {name!r}")


def _checked(name: str, value: object, domain: _Domain) -> float:
    low, high, _, is_whole = domain
    if is_whole:
        return whole_number(name, value, int(low), int(high))
    if isinstance(value, bool):
        raise ParameterError(f"{name} must be a number; got {value!r}")
    number = real_number(name, value)
    if high == math.inf and not low <= number < high:
        raise ParameterError(
            f"{name} must be {low:g} or more, and finite; got {number}"
        )
    if not low <= number <= high:
        raise ParameterError(f"{name} must lie in [{low:g}, {high:g}]; got {value!r}")
    return number

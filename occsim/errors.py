"""The few errors that the library raises on bad input.

Each message says what is wrong, what is allowed and what was got, so that an
application can show it as it stands.
"""

from enum import Enum
from numbers import Real


class OccsimError(ValueError):
    """Base of every error that bad input to :mod:`occsim` raises."""


class ParameterError(OccsimError):
    """A parameter, or the combination of several, lies outside its domain."""


class DrawingError(OccsimError):
    """An image cannot be used as a drawing."""


class TrajectoryError(OccsimError):
    """Poses, or the file they come from, cannot be used as a trajectory."""


def require_choice(name: str, value: object, kind: type[Enum]) -> None:
    """Refuse what is no member of an enum: a name in quotes would pass for the other.

    Raises
    ------
    ParameterError
    """
    if not isinstance(value, kind):
        choices = ", ".join(f"{kind.__name__}.{choice.name}" for choice in kind)
        raise ParameterError(f"{name} must be one of {choices}; got {value!r}")


def real_number(name: str, value: object) -> float:
    """Return a scalar as a float of full precision.

    A float32 would draw everything computed from it down to seven digits, in which
    the exact ties between a prior and a reading are lost.

    Raises
    ------
    ParameterError
        Where the value is no real number.
    """
    if not isinstance(value, Real):
        raise ParameterError(f"{name} must be a number; got {value!r}")
    return float(value)

"""The few errors that the library raises on bad input, and the checks they share.

Every public function promises:

- Wrong *values* (a share of 1.4, NaN in an array, sizes that do not match, a choice
  that does not exist) and wrong *files* raise an `OccsimError`.
- Wrong *types* of whole arguments (a list for a trajectory, a number for a grid, a grey
  image for a mask) raise a `TypeError`.

Either message is one sentence that says what is wrong, what is allowed and what was
got, so that an application can show it as it stands.
"""

from enum import Enum
from numbers import Real
from typing import TypeVar

import numpy as np
import numpy.typing as npt

SHOWN_MOST = 60
"""Characters of a wrong value that a message shows."""

_Choice = TypeVar("_Choice", bound=Enum)


class OccsimError(ValueError):
    """Base of every error that bad input to :mod:`occsim` raises.

    Examples
    --------
    >>> from occsim import OccsimError, load_sample
    >>> try:
    ...     load_sample("z")
    ... except OccsimError as error:
    ...     print(type(error).__name__)
    ParameterError
    """


class ParameterError(OccsimError):
    """A parameter, or the combination of several, lies outside its domain.

    Examples
    --------
    >>> from occsim import ParameterError, Prior
    >>> try:
    ...     Prior(p_wall=1.4)
    ... except ParameterError as error:
    ...     print(error)
    p_wall must lie in (0, 1]; got 1.4
    """


class DrawingError(OccsimError):
    """An image cannot be used as a drawing.

    Examples
    --------
    >>> from occsim import DrawingError, load_drawing
    >>> try:
    ...     load_drawing(b"no picture")
    ... except DrawingError as error:
    ...     print(str(error).split(" in ")[0])
    drawing is plain text, not an image
    """


class TrajectoryError(OccsimError):
    """Poses, or the file they come from, cannot be used as a trajectory.

    Examples
    --------
    >>> from occsim import Trajectory, TrajectoryError
    >>> try:
    ...     Trajectory([[1.0, 2.0, float("nan")]])
    ... except TrajectoryError as error:
    ...     print(error)
    every pose must be finite; pose 1 is [1.0, 2.0, nan]
    """


class RobotFileError(OccsimError):
    """A file of a robot, a map or a log of scans, cannot be used.

    Examples
    --------
    >>> from occsim import Mapper, RobotFileError
    >>> try:
    ...     Mapper.load(b"no map")
    ... except RobotFileError as error:
    ...     print(str(error).split(":")[0])
    it is not an undamaged file of a map saved by Mapper.save
    """


def choice(name: str, value: object, kind: type[_Choice]) -> _Choice:
    """Return the member of an enum that a parameter names, by itself or its value.

    Parameters
    ----------
    name : str
        What to call the parameter in a message.
    value : object
        A member of `kind`, or the value of one.
    kind : type of Enum
        The choices.

    Returns
    -------
    member of `kind`

    Raises
    ------
    ParameterError
        Where the value is neither.
    """
    if isinstance(value, kind):
        return value
    for member in kind:
        if isinstance(value, str) and value == member.value:
            return member
    choices = ", ".join(f"{kind.__name__}.{m.name} ({m.value!r})" for m in kind)
    raise ParameterError(f"{name} must be one of {choices}; got {shown(value)}")


def expect(name: str, value: object, *kinds: type) -> None:
    """Refuse an argument of another type.

    Parameters
    ----------
    name : str
        What to call the argument in the message.
    value : object
        What was given.
    *kinds : type
        What is allowed.

    Raises
    ------
    TypeError
        Where the value is an instance of none of the types.
    """
    if not isinstance(value, kinds):
        allowed = " or ".join(kind.__name__ for kind in kinds)
        raise TypeError(f"{name} must be of type {allowed}; got {_type_of(value)}")


def bool_array(
    name: str, values: npt.ArrayLike, shape: tuple[int, ...] | None = None
) -> npt.NDArray[np.bool_]:
    """Check truth values and return them as an array.

    Parameters
    ----------
    name : str
        What to call the values in a message.
    values : array_like of bool
        A mask of pixels or of cells. Numbers are refused: in a grey image, white is not
        zero and would count as wall.
    shape : tuple of int, optional
        The shape that the array must have.

    Returns
    -------
    ndarray of bool

    Raises
    ------
    TypeError
        Where the values are not bool.
    ParameterError
        Where the shape is another.
    """
    array = _array(values)
    if array.dtype != np.bool_:
        raise TypeError(f"{name} must be an array of bool; got {_type_of(values)}")
    if shape is not None and array.shape != shape:
        raise ParameterError(
            f"{name} must be bool of shape {shape}; got bool of shape {array.shape}"
        )
    return array.view(np.bool_)


def real_array(name: str, values: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Return an array_like of real numbers as an array of full precision.

    Parameters
    ----------
    name : str
        What to call the values in a message.
    values : array_like
        One number, or nested sequences of them.

    Returns
    -------
    ndarray of float64

    Raises
    ------
    TypeError
        Where the values are not real numbers.
    """
    array = _array(values)
    if array.dtype.kind not in "biuf" and array.size:
        raise TypeError(f"{name} must hold real numbers; got {_type_of(values)}")
    return array.astype(np.float64, copy=False)


def shared_shape(**arrays: npt.NDArray[np.generic]) -> tuple[int, ...]:
    """Return the shape to which arrays, given by their names, broadcast.

    Raises
    ------
    ParameterError
        Where they do not.
    """
    shapes = [array.shape for array in arrays.values()]
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        names, got = " and ".join(arrays), " and ".join(map(str, shapes))
        raise ParameterError(
            f"the shapes of {names} must broadcast; got {got}"
        ) from None


def shown(value: object) -> str:
    """Return a value as a message shows it: on one line, shortened if long."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # thousands of digits
        text = f"a very long {type(value).__name__}"
    return text if len(text) <= SHOWN_MOST else f"{text[:SHOWN_MOST]}..."


def _array(values: npt.ArrayLike) -> npt.NDArray[np.generic]:
    try:
        return np.asarray(values)
    except ValueError:  # rows of unequal length
        return np.asarray(values, dtype=object)


def _type_of(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} of shape {value.shape}"
    return type(value).__name__


def real_number(name: str, value: object) -> float:
    """Return a scalar as a float of full precision.

    A float32 would limit everything computed from it to seven digits, and exact ties
    between a prior and a reading would be lost.

    Raises
    ------
    ParameterError
        Where the value is not a real number, or too large for a float.
    """
    if not isinstance(value, Real):
        raise ParameterError(f"{name} must be a number; got {shown(value)}")
    try:
        return float(value)
    except OverflowError:
        raise ParameterError(f"{name} must be a number below 1e308") from None


def whole_number(name: str, value: object, least: int, most: int) -> int:
    """Return a scalar as an int within bounds, both included.

    Raises
    ------
    ParameterError
        Where the value is not a whole number, or lies outside the bounds.
    """
    number = None if isinstance(value, bool) else value
    if isinstance(number, (int, np.integer)) and least <= number <= most:
        return int(number)
    raise ParameterError(
        f"{name} must be a whole number, {least:,} to {most:,}; got {shown(value)}"
    )

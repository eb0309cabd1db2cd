"""A stroke: one correction of a wall mask, and the way it is written down."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from occsim.errors import ParameterError

LATTICE = 4
"""Steps per pixel in which coordinates and widths are kept."""
MAX_WIDTH_PX = 512.0
MAX_COORDINATE_PX = 100_000.0
MAX_STROKES = 2048
MAX_POINTS = 65_536
"""In one list of strokes; a long day at the board stays far below."""


class StrokeKind(Enum):
    """What a stroke does to the mask."""

    BRUSH = "brush"
    """Adds a free line."""
    LINE = "line"
    """Adds a straight line between two points."""
    RECTANGLE = "rectangle"
    """Adds a filled rectangle between two corners."""
    OUTLINE = "outline"
    """Adds the four sides of a rectangle."""
    ERASER = "eraser"
    """Takes a free line away."""
    CLEAR = "clear"
    """Takes a filled rectangle away."""


ERASING = frozenset({StrokeKind.ERASER, StrokeKind.CLEAR})
FILLED = frozenset({StrokeKind.RECTANGLE, StrokeKind.CLEAR})
BOXES = FILLED | {StrokeKind.OUTLINE}
TWO_POINTS = BOXES | {StrokeKind.LINE}


@dataclass(frozen=True, kw_only=True, slots=True)
class Stroke:
    """One correction of a wall mask.

    Parameters
    ----------
    kind : StrokeKind
        What it does.
    points : tuple of (float, float)
        x, y in the image frame, px; rounded to quarters of a pixel. At least one for
        brush and eraser, exactly two for the others. They may lie outside the image.
    width_px : float, default 1
        Full width of the line, px, in [1, 512]; rounded to quarters. A filled rectangle
        has none.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.
    """

    kind: StrokeKind
    points: tuple[tuple[float, float], ...]
    width_px: float = 1.0

    def __post_init__(self) -> None:
        if not isinstance(self.kind, StrokeKind):
            raise ParameterError(f"kind must be a StrokeKind; got {self.kind!r}")
        if not 1.0 <= self.width_px <= MAX_WIDTH_PX:
            raise ParameterError(
                f"width_px must lie in [1, {MAX_WIDTH_PX:g}]; got {self.width_px!r}"
            )
        points = tuple((_snapped(x), _snapped(y)) for x, y in self.points)
        if self.kind in TWO_POINTS and len(points) != 2:
            raise ParameterError(
                f"a {self.kind.value} has exactly 2 points; got {len(points)}"
            )
        if not 1 <= len(points) <= MAX_POINTS:
            raise ParameterError(
                f"a stroke has 1 to {MAX_POINTS} points; got {len(points)}"
            )
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "width_px", _snapped(self.width_px))

    @property
    def erases(self) -> bool:
        """Whether it takes wall pixels away."""
        return self.kind in ERASING


def _snapped(value: float) -> float:
    """Return a coordinate rounded to the lattice of quarters of a pixel."""
    # Also false for NaN, which compares with nothing.
    if not -MAX_COORDINATE_PX <= value <= MAX_COORDINATE_PX:
        raise ParameterError(
            f"a point of a stroke must lie within {MAX_COORDINATE_PX:g} px of the "
            f"image; got {value!r}"
        )
    return round(value * LATTICE) / LATTICE


def encode_strokes(strokes: Iterable[Stroke]) -> list[list[str | int]]:
    """Return strokes as lists that JSON can hold, a few bytes a point.

    Parameters
    ----------
    strokes : iterable of Stroke
        Any number.

    Returns
    -------
    list of list
        Per stroke ``[kind, width, x, y, dx, dy, ...]``: whole quarters of a pixel, each
        point but the first as the difference from the one before.
    """
    encoded: list[list[str | int]] = []
    for stroke in strokes:
        row: list[str | int] = [stroke.kind.value, round(stroke.width_px * LATTICE)]
        last_x = last_y = 0
        for x_px, y_px in stroke.points:
            x, y = round(x_px * LATTICE), round(y_px * LATTICE)
            row += [x - last_x, y - last_y]
            last_x, last_y = x, y
        encoded.append(row)
    return encoded


def decode_strokes(
    encoded: object, *, max_strokes: int = MAX_STROKES, max_points: int = MAX_POINTS
) -> tuple[Stroke, ...]:
    """Return the strokes that `encode_strokes` wrote; nothing of it is trusted.

    Parameters
    ----------
    encoded : object
        Whatever JSON gave.
    max_strokes, max_points : int
        Most that is accepted, in total.

    Returns
    -------
    tuple of Stroke

    Raises
    ------
    ParameterError
        Where it is not such a list, too long, or a value lies outside its domain.
    """
    if not isinstance(encoded, Sequence) or isinstance(encoded, (str, bytes)):
        raise ParameterError(
            f"strokes must be a list of lists; got {type(encoded).__name__}"
        )
    if len(encoded) > max_strokes:
        raise ParameterError(
            f"at most {max_strokes} strokes are accepted; got {len(encoded)}"
        )
    n_points = sum(len(row) // 2 - 1 for row in encoded if isinstance(row, list))
    if n_points > max_points:
        raise ParameterError(
            f"at most {max_points} points of strokes are accepted; got {n_points}"
        )
    return tuple(_decoded(row) for row in encoded)


def _decoded(row: object) -> Stroke:
    """Return one stroke from its list of a kind and whole numbers."""
    if not isinstance(row, list) or len(row) < 4 or len(row) % 2:
        raise ParameterError("a stroke must be [kind, width, x, y, dx, dy, ...]")
    kind, *numbers = row
    # bool is an int to Python, and a huge int would overflow below.
    if any(
        type(n) is not int or abs(n) > 2 * MAX_COORDINATE_PX * LATTICE for n in numbers
    ):
        raise ParameterError("widths and points of a stroke must be whole numbers")
    if not isinstance(kind, str) or kind not in _KINDS:
        raise ParameterError(
            f"a stroke's kind must be one of {', '.join(_KINDS)}; got {kind!r:.40}"
        )
    steps = np.array(numbers[1:], dtype=np.int64).reshape(-1, 2)
    points = np.cumsum(steps, axis=0) / LATTICE
    return Stroke(
        kind=StrokeKind(kind),
        width_px=numbers[0] / LATTICE,
        points=tuple((x, y) for x, y in points.tolist()),
    )


_KINDS = tuple(kind.value for kind in StrokeKind)

"""What can be adjusted in wall detection; every bound is declared here, once."""

from dataclasses import dataclass

from occsim._bounds import Bounds, bounded, check_bounds, slider_of
from occsim.errors import ParameterError

MAX_LENGTH_PX = 1_000.0
"""Largest length that a parameter takes, px: thicker than any wall of a drawing."""


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

    ink_level: float = bounded(0.0, Bounds(0.0, 0.95, 0.05))
    shadow_window_px: float = bounded(0.0, Bounds(0.0, MAX_LENGTH_PX, 10.0))
    door_fit: float = bounded(0.04, Bounds(0.0, 0.2, 0.01))
    min_wall_px: float = bounded(0.0, Bounds(0.0, MAX_LENGTH_PX, 0.5))
    max_gap_px: float = bounded(0.0, Bounds(0.0, MAX_LENGTH_PX, 0.5))
    min_piece_px: float = bounded(0.0, Bounds(0.0, MAX_LENGTH_PX, 5.0))
    straighten: bool = True

    def __post_init__(self) -> None:
        check_bounds(self)
        if not isinstance(self.straighten, bool):
            raise ParameterError(
                f"straighten must be true or false; got {self.straighten!r}"
            )

    @classmethod
    def bounds(cls, name: str) -> Bounds:
        """Return the bounds of a parameter.

        Raises
        ------
        ParameterError
            Where no parameter of that name has bounds.
        """
        return slider_of(cls, name, "parameter with bounds")

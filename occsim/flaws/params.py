"""What can be wrong with a drawing; every range is declared here, once."""

import math
from dataclasses import dataclass, replace

from occsim._bounds import Bounds, bounded, check_bounds, slider_of

_DEGREE = math.pi / 180.0
_SHIFT = Bounds(-20.0, 20.0, 1.0), (-1e4, 1e4)
_SHARE = Bounds(0.0, 1.0, 0.05)


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

    thickness_px: int = bounded(0, Bounds(-5, 5, 1), (-50, 50), is_whole=True)
    shift_x_px: float = bounded(0.0, *_SHIFT)
    shift_y_px: float = bounded(0.0, *_SHIFT)
    rotation_rad: float = bounded(
        0.0, Bounds(-10 * _DEGREE, 10 * _DEGREE, _DEGREE), (-math.tau, math.tau)
    )
    scale: float = bounded(1.0, Bounds(0.8, 1.25, 0.01), (0.1, 10.0))
    missing_share: float = bounded(0.0, _SHARE)
    false_share: float = bounded(0.0, _SHARE)
    seed: int = bounded(0, Bounds(0, 99, 1), (0, 2**32 - 1), is_whole=True)

    def __post_init__(self) -> None:
        check_bounds(self)

    @classmethod
    def bounds(cls, name: str) -> Bounds:
        """Return the range that a slider offers for a field; more is allowed.

        Raises
        ------
        ParameterError
            Where there is no field of that name.
        """
        return slider_of(cls, name, "flaw of a drawing")

    @property
    def are_none(self) -> bool:
        """Whether the drawing is left as it is, whatever the seed."""
        return replace(self, seed=0) == DrawingFlaws()

"""Where a drawing lies on a map: one scale, a turn and a shift."""

import cmath
from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from occsim._bounds import Bounds, bounded, check_bounds
from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError, bool_array, expect, real_array
from occsim.flaws.moving import moved_walls
from occsim.geometry import wrap_angle
from occsim.grid import Grid

SCALES = (0.01, 100.0)
"""Least and largest scale: px of the map that a px of the drawing may be long."""

MAX_SHIFT_PX = 1e7
"""Far more than a drawing's side at the largest scale."""

_SHIFT = Bounds(-MAX_SHIFT_PX, MAX_SHIFT_PX, 1.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Registration:
    """Where a drawing lies on a map, both with y down.

    A point p of the drawing, px, lies at ``scale * R(rotation_rad) p + shift`` of the
    map, px.

    Parameters
    ----------
    scale : float, default 1
        Px of the map that a px of the drawing is long, 0.01 to 100.
    rotation_rad : float, default 0
        From +x towards +y, clockwise on the screen, about the drawing's upper left
        corner; kept in [-pi, pi).
    shift_x_px, shift_y_px : float, default 0
        Where that corner lies on the map, px.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim import Registration
    >>> lies = Registration(scale=2.0, rotation_rad=np.pi / 2, shift_x_px=10.0)
    >>> lies.points([[3.0, 0.0]]).round(9)
    array([[10.,  6.]])
    """

    scale: float = bounded(1.0, Bounds(*SCALES, 0.01))
    rotation_rad: float = bounded(0.0, Bounds(-np.pi, np.pi, 0.01), (-1e6, 1e6))
    shift_x_px: float = bounded(0.0, _SHIFT)
    shift_y_px: float = bounded(0.0, _SHIFT)

    def __post_init__(self) -> None:
        check_bounds(self)
        if not -np.pi <= self.rotation_rad < np.pi:
            object.__setattr__(
                self, "rotation_rad", float(wrap_angle(self.rotation_rad))
            )

    @classmethod
    def from_complex(cls, factor: complex, shift: complex) -> Self:
        """Return the registration that takes x + iy to ``factor * (x + iy) + shift``.

        Raises
        ------
        ParameterError
            Where the factor's size is no scale, or the shift is too large.
        """
        return cls(
            scale=abs(factor),
            rotation_rad=cmath.phase(factor),
            shift_x_px=shift.real,
            shift_y_px=shift.imag,
        )

    @property
    def factor(self) -> complex:
        """Scale and turn as one factor of x + iy."""
        return cmath.rect(self.scale, self.rotation_rad)

    @property
    def shift(self) -> complex:
        """Shift as x + iy, px."""
        return complex(self.shift_x_px, self.shift_y_px)

    def points(self, drawing_points: npt.ArrayLike) -> FloatArray:
        """Return where points of the drawing lie on the map.

        Parameters
        ----------
        drawing_points : array_like of shape (K, 2)
            x, y, px.

        Returns
        -------
        ndarray of float64, shape (K, 2)
            They may lie outside the map.

        Raises
        ------
        TypeError, ParameterError
            Where they are not pairs of finite numbers.
        """
        placed = self.factor * _complex("drawing_points", drawing_points) + self.shift
        return np.stack([placed.real, placed.imag], axis=1)

    def drawing_points(self, log_points: npt.ArrayLike) -> FloatArray:
        """Return where points of the map lie on the drawing; undoes `points`."""
        on = (_complex("log_points", log_points) - self.shift) / self.factor
        return np.stack([on.real, on.imag], axis=1)


def register_by_points(
    drawing_points: npt.ArrayLike, log_points: npt.ArrayLike
) -> Registration:
    """Return the registration that takes points of a drawing to points of a map.

    Parameters
    ----------
    drawing_points : array_like of shape (K, 2)
        x, y on the drawing, px; K at least 2, not all at one place.
    log_points : array_like of shape (K, 2)
        The same places on the map, px.

    Returns
    -------
    Registration
        Exact for two pairs; for more, the sum of squared distances on the map is least.

    Raises
    ------
    TypeError
        Where the points are no numbers.
    ParameterError
        Where there are fewer than two pairs, a point is not finite, all points lie at
        one place, or the scale would lie beyond 0.01 to 100.

    References
    ----------
    .. [1] S. Umeyama, "Least-squares estimation of transformation parameters between
       two point patterns", IEEE PAMI 13(4), 1991; in the plane, without mirroring.

    Examples
    --------
    >>> from occsim import register_by_points
    >>> lies = register_by_points([[0, 0], [10, 0]], [[5, 5], [5, 25]])
    >>> lies.scale, round(lies.rotation_rad, 6), lies.shift_x_px, lies.shift_y_px
    (2.0, 1.570796, 5.0, 5.0)
    """
    p = _complex("drawing_points", drawing_points)
    q = _complex("log_points", log_points)
    if p.size != q.size or p.size < 2:
        raise ParameterError(
            "drawing_points and log_points must be two or more pairs; got "
            f"{p.size} and {q.size} points"
        )
    from_p, from_q = p - p.mean(), q - q.mean()
    for name, apart in (("drawing_points", from_p), ("log_points", from_q)):
        if not abs(apart).max() > 0.0:
            raise ParameterError(f"{name} must lie apart; all are at one place")
    factor = np.vdot(from_p, from_q) / np.vdot(from_p, from_p).real
    return Registration.from_complex(
        complex(factor), complex(q.mean() - factor * p.mean())
    )


def registered_walls(
    walls: BoolArray, registration: Registration, grid: Grid
) -> BoolArray:
    """Return a drawing's walls on the map on which it is registered.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        Wall mask of the drawing.
    registration : Registration
        Where the drawing lies.
    grid : Grid
        The map's cells.

    Returns
    -------
    ndarray of bool, shape (height_px, width_px)
        Wall mask in px of the map, for `build_prior` and everything else: a pixel is
        wall if the centre of a wall pixel falls into it, or its own centre into a wall
        pixel. No line is lost, however thin.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where the mask is empty or not of two dimensions.

    Examples
    --------
    >>> from occsim import Grid, Registration, registered_walls
    >>> line = np.zeros((8, 8), bool)
    >>> line[4] = True  # one pixel of the drawing, half a pixel of the map
    >>> grid = Grid(height_px=4, width_px=4, cell_px=1)
    >>> registered_walls(line, Registration(scale=0.5), grid)[:, 0]
    array([False, False,  True, False])
    """
    walls = drawing_walls(walls)
    expect("registration", registration, Registration)
    expect("grid", grid, Grid)
    height, width = walls.shape
    centre = registration.factor * complex(width, height) / 2.0 + registration.shift
    shift = centre - complex(grid.width_px, grid.height_px) / 2.0
    return moved_walls(
        walls,
        registration.scale,
        registration.rotation_rad,
        (shift.real, shift.imag),
        (grid.height_px, grid.width_px),
    )


def drawing_walls(walls: BoolArray) -> BoolArray:
    """Check a wall mask and return it as an array of two dimensions."""
    walls = bool_array("walls", walls)
    if walls.ndim != 2 or not walls.size:
        raise ParameterError(
            f"walls must be a mask of shape (H, W); got shape {walls.shape}"
        )
    return walls


def _complex(name: str, points: npt.ArrayLike) -> npt.NDArray[np.complex128]:
    array = real_array(name, points)
    if array.ndim != 2 or array.shape[1] != 2 or not np.isfinite(array).all():
        raise ParameterError(
            f"{name} must be finite, of shape (K, 2); got shape {array.shape}"
        )
    if array.size and np.abs(array).max() > MAX_SHIFT_PX:
        raise ParameterError(f"{name} must lie within {MAX_SHIFT_PX:g} px")
    return array[:, 0] + 1j * array[:, 1]

"""The simulated range sensor: its parameters and its inverse model."""

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray
from occsim.errors import ParameterError, choice, real_number
from occsim.grid import Grid
from occsim.logodds import logit, logit_inside

P_FREE_MAX = 0.9
P_FREE_MIN = 0.1
"""Ends of the inverse sensor model, Eq. 4.22: entirely empty, entirely object."""

LOG_ODDS_MAX = float(logit(P_FREE_MAX))
LOG_ODDS_MIN = float(logit(P_FREE_MIN))

EDGE_EPS = 1e-9
"""Tolerance of every edge of the field of view, px on distances and rad on bearings.

A pixel centre exactly at reach r, on the side of the cone, or in line with a wall's
corner must not depend on the last bit of a cosine: the field of view reaches this much
further, and walls are this much wider (a ray that grazes a corner is stopped). Far
above rounding (1e-13 at 1,000 px), far below what can be seen.
"""

OWN_PIXEL_EPS_PX = 5e-7
"""A pixel centre this near the robot coincides with it: it has no bearing."""

SURFACE_DEPTH_PX = 1.5
"""With BehindHit.UNSEEN: how far beyond the hit a wall pixel's centre may lie."""


class BehindHit(Enum):
    """What the sensor says of pixels in view behind the wall that it meets.

    Examples
    --------
    >>> from occsim import BehindHit, Sensor
    >>> Sensor(behind_hit="unseen").behind_hit is BehindHit.UNSEEN
    True
    """

    OCCUPIED = "occupied"
    """At the hit or beyond: object, as Eq. 4.22 is printed."""
    UNSEEN = "unseen"
    """Only the wall surface that is seen is object; beyond it nothing is said."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Sensor:
    """A cone-shaped, noiseless range sensor.

    Parameters
    ----------
    range_px : float, default 20
        Reach r, px, above 0. The source sets it to the length of a door.
    fov_rad : float, default pi / 6
        Full opening angle of the field of view, rad, in (0, 2 pi].
    behind_hit : BehindHit, default BehindHit.OCCUPIED
        What is said of pixels behind a wall.
    clear_no_hit : bool, default True
        Whether a ray that meets nothing within reach clears its pixels.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim import Sensor
    >>> sensor = Sensor(range_px=40, behind_hit="unseen")
    >>> sensor.behind_hit
    <BehindHit.UNSEEN: 'unseen'>
    """

    range_px: float = 20.0
    fov_rad: float = np.pi / 6
    behind_hit: BehindHit = BehindHit.OCCUPIED
    clear_no_hit: bool = True

    def __post_init__(self) -> None:
        for name in ("range_px", "fov_rad"):
            value = real_number(name, getattr(self, name))
            object.__setattr__(self, name, value)
        if not 0.0 < self.range_px < np.inf:
            raise ParameterError(
                f"range_px must be above 0 and finite; got {self.range_px!r}"
            )
        # Converted from degrees, a full circle may exceed 2 pi by rounding.
        if not 0.0 < self.fov_rad <= 2.0 * np.pi + EDGE_EPS:
            raise ParameterError(f"fov_rad must lie in (0, 2 pi]; got {self.fov_rad!r}")
        behind_hit = choice("behind_hit", self.behind_hit, BehindHit)
        object.__setattr__(self, "behind_hit", behind_hit)
        if not isinstance(self.clear_no_hit, (bool, np.bool_)):
            raise ParameterError(
                f"clear_no_hit must be True or False; got {self.clear_no_hit!r}"
            )
        object.__setattr__(self, "clear_no_hit", bool(self.clear_no_hit))


def most_cells_in_view(sensor: Sensor, grid: Grid) -> int:
    """Return an upper bound of the cells that one reading can update.

    Parameters
    ----------
    sensor : Sensor
        Range and field of view.
    grid : Grid
        The cells.

    Returns
    -------
    int
        The cells that meet a sector of area A and perimeter P lie within a cell's
        diagonal d of it, in an area of at most ``A + P d + pi d^2`` (Steiner).
    """
    # A range beyond the grid sees no more of it, and its square may be no number.
    range_px = min(sensor.range_px, float(grid.cell_px) * (grid.n_cells + 1))
    area = 0.5 * sensor.fov_rad * range_px**2
    perimeter = (2.0 + sensor.fov_rad) * range_px
    diagonal = np.sqrt(2.0) * grid.cell_px
    around = area + perimeter * diagonal + np.pi * diagonal**2
    return min(grid.n_cells, int(around / grid.cell_px**2))


def inverse_sensor_model(n_empty: npt.ArrayLike, n_object: npt.ArrayLike) -> FloatArray:
    """Return what one reading says of a cell, Eq. 4.22, as log-odds.

    Parameters
    ----------
    n_empty, n_object : array_like of int, of shapes that can be broadcast
        Pixels of the cell in view nearer than the hit, and at it or beyond; at least
        one of the two is positive.

    Returns
    -------
    ndarray of float64
        ``logit(p_free(reading))``, nats, in [-ln 9, ln 9], on the lattice of
        `occsim.logodds`.

    Examples
    --------
    >>> from occsim.sensor import inverse_sensor_model
    >>> inverse_sensor_model([9, 2, 0], [0, 1, 9]).round(3)  # 0.9, 2/3, 0.1
    array([ 2.197,  0.693, -2.197])
    """
    n_empty, n_object = np.asarray(n_empty), np.asarray(n_object)
    if n_empty.shape != n_object.shape:
        n_empty, n_object = np.broadcast_arrays(n_empty, n_object)
    # Eq. 4.22, first and second case: most cells are all empty or all object.
    any_empty = n_empty > 0
    log_odds = np.where(any_empty, LOG_ODDS_MAX, LOG_ODDS_MIN)
    mixed = any_empty & (n_object > 0)
    # Third case: the empty share. Clipping is our interpretation: unclipped, a cell 99
    # % empty would count for more than an empty one.
    empty, objects = n_empty[mixed], n_object[mixed]
    q = np.minimum(np.maximum(empty / (empty + objects), P_FREE_MIN), P_FREE_MAX)
    log_odds[mixed] = logit_inside(q)
    return log_odds

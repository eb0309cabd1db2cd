"""One reading at pixel level: what it says of each pixel and of each cell."""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import expect, real_array
from occsim.evidence import pixel_counts
from occsim.grid import Grid, require_cover
from occsim.sensor import BehindHit, Sensor, inverse_sensor_model
from occsim.trajectory import Trajectory
from occsim.world import World


@dataclass(frozen=True, eq=False, repr=False)
class Reading(ShortRepr):
    """What one reading says.

    Parameters
    ----------
    grid : Grid
        The cells.
    in_view : ndarray of bool, shape (H, W)
        Pixels in the field of view and within range, whatever stands before them.
    empty, object : ndarray of bool, shape (H, W)
        Pixels in view that lie before the wall that their ray meets, and at it or
        beyond. With `BehindHit.UNSEEN`, or rays without a hit that are ignored, a pixel
        in view may be neither.
    n_empty, n_object : ndarray of int64, shape (R, C)
        Such pixels of each cell.
    log_odds : ndarray of float64, shape (R, C)
        What Eq. 4.22 says of each cell, nats of free against occupied; 0 where the
        cell has neither, and is not updated.

    Examples
    --------
    >>> from occsim import Grid, Sensor, lens_world, one_reading
    >>> world = lens_world()
    >>> grid = world.grid(5)
    >>> reading = one_reading(world, (20.5, 20.5, 0.0), Sensor(), grid)
    >>> int(reading.n_empty.sum()) == int(reading.empty.sum())
    True
    """

    grid: Grid
    in_view: BoolArray
    empty: BoolArray
    object: BoolArray
    n_empty: IntArray
    n_object: IntArray
    log_odds: FloatArray

    @property
    def is_updated(self) -> BoolArray:
        """Cells that the reading updates, ndarray of bool of shape (R, C)."""
        return (self.n_empty + self.n_object) > 0


def one_reading(
    world: World, pose: npt.ArrayLike, sensor: Sensor, grid: Grid
) -> Reading:
    """Return what one reading says of every pixel and every cell.

    Parameters
    ----------
    world : World
        What the sensor sees.
    pose : array_like of float, shape (3,)
        x_px, y_px, theta_rad.
    sensor : Sensor
        Field of view, reach, and what is said of pixels behind a hit.
    grid : Grid
        Cells over the world's image.

    Returns
    -------
    Reading
        The same counts and log-odds as in `collect_evidence`.

    Raises
    ------
    TypeError, ParameterError, TrajectoryError
        As in `collect_evidence`; also where the pose is not three finite numbers.

    References
    ----------
    .. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
       quality", Eq. 4.22.

    Examples
    --------
    A robot before a wall of three pixels, in cells of 2 px: of the first cell it sees
    that both pixels are empty, of the second that one is.

    >>> from occsim import Grid, Sensor, World, one_reading
    >>> world = World(occupied=[[False, False, False, True, True, True]])
    >>> grid = Grid(height_px=1, width_px=6, cell_px=2)
    >>> seen = one_reading(world, (0.5, 0.5, 0.0), Sensor(range_px=4.0), grid)
    >>> seen.n_empty, seen.n_object
    (array([[2, 1, 0]]), array([[0, 1, 1]]))
    """
    expect("world", world, World)
    expect("sensor", sensor, Sensor)
    expect("grid", grid, Grid)
    require_cover(grid, world.shape)
    poses = Trajectory(poses=real_array("pose", pose)[None]).poses
    everything = replace(sensor, behind_hit=BehindHit.OCCUPIED, clear_no_hit=True)
    empty, beyond = _pixels(world, poses, sensor)
    seen_empty, seen_beyond = _pixels(world, poses, everything)
    n_empty, n_object = grid.count(empty), grid.count(beyond)
    updated = (n_empty + n_object) > 0
    log_odds = np.zeros(grid.shape)
    log_odds[updated] = inverse_sensor_model(n_empty[updated], n_object[updated])
    in_view = seen_empty | seen_beyond
    return Reading(grid, in_view, empty, beyond, n_empty, n_object, log_odds)


def _pixels(
    world: World, poses: FloatArray, sensor: Sensor
) -> tuple[BoolArray, BoolArray]:
    """Return the empty and the object pixels: cells of 1 px are pixels."""
    grid = world.grid(1)
    empty, beyond = (np.zeros(grid.shape, dtype=np.bool_) for _ in range(2))
    for counts in pixel_counts(world, poses, sensor, grid):
        # The window has a column beyond the image, which counts nothing.
        seen = np.flatnonzero(counts.n_empty | counts.n_object)
        cell = counts.windows.cells()[seen]
        empty.ravel()[cell] = counts.n_empty[seen] > 0
        beyond.ravel()[cell] = counts.n_object[seen] > 0
    return empty, beyond

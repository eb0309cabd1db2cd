"""The world that the sensor sees, and its wall cells."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ShortRepr
from occsim.errors import ParameterError, bool_array, expect, real_number
from occsim.grid import Grid
from occsim.imaging import Drawing


@dataclass(frozen=True, eq=False, repr=False)
class World(ShortRepr):
    """Ground truth: which pixels are structure.

    Parameters
    ----------
    occupied : ndarray of bool, shape (H, W)
        True where a wall stands. A private copy is kept, never written to.

    Raises
    ------
    TypeError
        Where the array is not bool.
    ParameterError
        Where it is not two-dimensional, or empty.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import World
    >>> World(np.zeros((60, 80), dtype=bool))
    World(occupied=bool[60, 80])
    """

    occupied: BoolArray

    def __post_init__(self) -> None:
        occupied = np.array(bool_array("occupied", self.occupied), order="C")
        if occupied.ndim != 2 or occupied.size == 0:
            raise ParameterError(
                "occupied must have shape (H, W) with at least one pixel; "
                f"got {occupied.shape}"
            )
        occupied.setflags(write=False)
        object.__setattr__(self, "occupied", occupied)

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, px."""
        height, width = self.occupied.shape
        return height, width

    def grid(self, cell_px: int) -> Grid:
        """Return the grid of this cell size over the world."""
        height, width = self.shape
        return Grid(height_px=height, width_px=width, cell_px=cell_px)


DARK_BELOW = 128
"""Brightness under which a pixel of a ground truth image is wall."""


def world_from_image(image: Drawing) -> World:
    """Return the world of a ground truth image: black is wall, white is free.

    Parameters
    ----------
    image : Drawing
        A picture of the structure alone.

    Returns
    -------
    World
        Wall where the brightness lies below one half of white.
    """
    return World(occupied=image.gray < DARK_BELOW)


def wall_cells(mask: BoolArray, grid: Grid, wall_share: float = 0.0) -> BoolArray:
    """Return the cells whose share of wall pixels exceeds a threshold.

    Parameters
    ----------
    mask : array_like of bool, shape (H, W)
        Wall pixels: a detected wall mask or a ground truth.
    grid : Grid
        Cells over the same image.
    wall_share : float, default 0
        Threshold in [0, 1); at 0 any wall pixel makes a wall cell.

    Returns
    -------
    ndarray of bool, shape (R, C)
        True for wall cells.

    Raises
    ------
    TypeError
        Where the mask is not bool (a grey image is none), or the grid no `Grid`.
    ParameterError
        Where the threshold lies outside [0, 1) or the sizes differ.
    """
    expect("grid", grid, Grid)
    wall_share = real_number("wall_share", wall_share)
    if not 0.0 <= wall_share < 1.0:
        raise ParameterError(f"wall_share must lie in [0, 1); got {wall_share!r}")
    return grid.share(mask) > wall_share


def truth_cells(world: World, grid: Grid, wall_share: float = 0.0) -> BoolArray:
    """Return the ground truth's wall cells, by the rule of `wall_cells`.

    Parameters
    ----------
    world : World
        Ground truth.
    grid : Grid
        Cells over it.
    wall_share : float, default 0
        Threshold in [0, 1).

    Returns
    -------
    ndarray of bool, shape (R, C)
        True for cells that are wall in truth.

    Raises
    ------
    TypeError, ParameterError
        As in `wall_cells`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import World, truth_cells
    >>> world = World(np.array([[True, False, False, False]]))
    >>> truth_cells(world, world.grid(2))
    array([[ True, False]])
    """
    expect("world", world, World)
    return wall_cells(world.occupied, grid, wall_share)

"""What a sensor would see from many poses, and the poses that together show most."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.evidence import pixel_counts
from occsim.grid import Grid
from occsim.rays.ragged import ragged_ranges
from occsim.sensor import Sensor
from occsim.world import World

# Walls are what a map is read for, and few cells hold them: one is worth so many of
# floor.
_WALL_WORTH = 2.0
# Of the worth that any view shows: the rest takes many readings for little.
_ENOUGH = 0.95
# A view within so much of the best is as good: taking the first of them in an order of
# no place spreads few readings over the building.
_AS_GOOD = 0.9
# Of a cell's pixels: half of them would leave gaps between views side by side.
_SEEN_SHARE = 0.75


@dataclass(frozen=True, eq=False)
class Views:
    """The cells that each of V views shows.

    Parameters
    ----------
    first : ndarray of int64, shape (V + 1,)
        View v owns the entries ``first[v]:first[v + 1]``.
    cell : ndarray of int64, shape (E,)
        Flat row-major cell of each entry; one entry per cell and view.
    """

    first: IntArray
    cell: IntArray


def views_from(world: World, poses: FloatArray, sensor: Sensor, grid: Grid) -> Views:
    """Return which cells the sensor would show as they are from each of many poses.

    Parameters
    ----------
    world : World
        Ground truth.
    poses : ndarray of float64, shape (V, 3)
        x_px, y_px, theta_rad.
    sensor : Sensor
        Range, field of view, and what it says of cells behind a wall.
    grid : Grid
        Cells over the world.

    Returns
    -------
    Views
        Shown are cells with wall in which more pixels are object than empty, and
        other cells in which at least three quarters of the pixels are empty, as
        `pixel_counts` has it.
    """
    is_wall = (grid.share(world.occupied) > 0.0).ravel()
    sizes, cells = [], []
    for counts in pixel_counts(world, poses, sensor, grid):
        windows = counts.windows
        # The spare column of the last window would lie beyond the last cell.
        cell = np.minimum(windows.cells(), grid.n_cells - 1)
        is_empty = counts.n_empty >= _SEEN_SHARE * grid.cell_px**2
        shown = np.where(is_wall[cell], counts.n_object > counts.n_empty, is_empty)
        sizes.append(shown.reshape(windows.first_row.size, -1).sum(axis=1))
        cells.append(cell[shown].astype(np.int64))
    first = np.concatenate([[0], np.cumsum(np.concatenate(sizes))])
    return Views(first, np.concatenate(cells))


def cell_worth(world: World, inside: BoolArray, grid: Grid) -> FloatArray:
    """Return what it is worth to see each cell for the first time.

    Parameters
    ----------
    world : World
        Ground truth.
    inside : ndarray of bool, shape (H, W)
        Floor of the building.
    grid : Grid
        Cells over both.

    Returns
    -------
    ndarray of float64, shape (n_cells,)
        1 for a cell with floor of the building; more for one with wall; else 0.
    """
    floor = grid.share(inside) > 0.0
    walls = grid.share(world.occupied) > 0.0
    return np.asarray(np.where(walls, _WALL_WORTH, floor.astype(np.float64))).ravel()


def best_views(views: Views, worth: FloatArray, most: int) -> IntArray:
    """Return the views that together show most, the most rewarding first.

    Parameters
    ----------
    views : Views
        V views, V at least 1.
    worth : ndarray of float64, shape (n_cells,)
        Of each cell.
    most : int
        Views to choose, at least 1.

    Returns
    -------
    ndarray of int64
        Each is the first that shows nearly the most of what those before it have not,
        by worth. Fewer than `most` where nearly all that any view shows is seen; at
        least one.
    """
    from scipy.sparse import csr_array  # here, because it takes long to import

    n_views = views.first.size - 1
    entries = np.ones(views.cell.size), views.cell, views.first
    shows = csr_array(entries, shape=(n_views, worth.size))
    gain = shows @ worth
    # The other way round, the views that show each cell, in order: counting, which
    # takes a fraction of the time of sorting.
    by_cell = shows.tocsc()
    first, shown_by = by_cell.indptr, by_cell.indices
    left = np.where(first[1:] > first[:-1], worth, 0.0)
    chosen = [int(np.argmax(gain >= _AS_GOOD * gain.max()))]
    rest = _ENOUGH * left.sum()
    while True:
        cell = views.cell[views.first[chosen[-1]] : views.first[chosen[-1] + 1]]
        cell = cell[left[cell] > 0.0]
        which, entry = ragged_ranges(first[cell], first[cell + 1])
        gain -= np.bincount(shown_by[entry], left[cell][which], minlength=n_views)
        rest -= left[cell].sum()
        left[cell] = 0.0
        if len(chosen) == most or rest <= 0.0:
            return np.array(chosen, dtype=np.int64)
        chosen.append(int(np.argmax(gain >= _AS_GOOD * gain.max())))

"""Where a robot may stand: free space with clearance, and the inside of a building."""

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError
from occsim.world import World

# Inside and outside need no more detail than this, cells along the longer side.
_CELLS = 400
# Of a run's cells, those that must have walls on a side: a room has some, however wide
# its windows and however far the run leads out through them; fewer may be specks.
_WALLED_SHARE = 0.04
# Of the drawing: less than this is a pocket between scraps of wall, no building.
_LEAST_OF_SHEET = 0.003


def clearance_map(world: World) -> FloatArray:
    """Return how far each pixel is from the nearest wall, or the drawing's edge.

    Parameters
    ----------
    world : World
        Ground truth.

    Returns
    -------
    ndarray of float64, shape (H, W)
        From the pixel's centre to the near side of the nearest wall pixel, px; 0 in
        walls. Exact along rows and columns, elsewhere up to 0.21 px too much.
    """
    # The drawing's edge is as good as a wall: nothing is known beyond it.
    floor = np.pad((~world.occupied).astype(np.uint8), 1)
    centres = cv2.distanceTransform(floor, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    # The last bit differs from call to call (opencv/opencv#24082); squares are whole.
    squares = np.rint(centres[1:-1, 1:-1].astype(np.float64) ** 2)
    return np.asarray(np.maximum(np.sqrt(squares) - 0.5, 0.0))


def free_space(world: World, clearance_px: float = 0.0) -> BoolArray:
    """Return the pixels where a robot of some radius may stand.

    Parameters
    ----------
    world : World
        Ground truth.
    clearance_px : float, default 0
        Least distance from walls and from the drawing's edge, px, 0 or more.

    Returns
    -------
    ndarray of bool, shape (H, W)
        True where the pixel's centre keeps that distance.

    Raises
    ------
    ParameterError
        Where the clearance is negative or not finite.
    """
    if not 0.0 <= clearance_px < np.inf:
        raise ParameterError(
            f"clearance_px must be 0 or more and finite; got {clearance_px!r}"
        )
    return np.asarray((clearance_map(world) >= clearance_px) & ~world.occupied)


def inside_building(world: World) -> BoolArray:
    """Return the free pixels that are inside a building rather than around it.

    Along a row or a column, free pixels lie in runs between walls. A run is inside
    where some of its pixels have walls to the left, some to the right, some above and
    some below. A room has them beside its windows and doors; a yard is open on
    one whole side, and an alley between two buildings on two. A side of the drawing
    that cuts through walls counts as wall between them: the plan goes on beyond it.

    Parameters
    ----------
    world : World
        Ground truth.

    Returns
    -------
    ndarray of bool, shape (H, W)
        A heuristic, at the detail of a 400th of the longer side. All free pixels
        where the walls enclose nothing.
    """
    cell_px = -(-max(world.shape) // _CELLS)
    walls = world.grid(cell_px).share(world.occupied) > 0.0
    inside = _enclosed(walls)
    if np.count_nonzero(inside) <= _LEAST_OF_SHEET * inside.size:
        return ~world.occupied
    height, width = world.shape
    inside = inside.repeat(cell_px, axis=0).repeat(cell_px, axis=1)
    return np.asarray(inside[:height, :width] & ~world.occupied)


def _enclosed(walls: BoolArray) -> BoolArray:
    """Return the free cells whose runs, across and along, have walls on all sides."""
    framed = np.pad(walls, 1)
    for frame, side in ((framed[0], walls[0]), (framed[-1], walls[-1])):
        _close_cut(frame, side)
    for frame, side in ((framed[:, 0], walls[:, 0]), (framed[:, -1], walls[:, -1])):
        _close_cut(frame, side)
    left_right = _walls_before(framed)
    above_below = _walls_before(framed.T)
    stop = framed
    for _ in range(2):
        # Runs that lead out through windows may cross in a yard: the second time, they
        # are cut where they are found to be outside.
        across = _is_walled(stop, *(blocked.T for blocked in above_below))
        along = _is_walled(stop.T, *(blocked.T for blocked in left_right)).T
        stop = framed | ~(across & along)
    return np.asarray(~stop[1:-1, 1:-1])


def _close_cut(frame: BoolArray, side: BoolArray) -> None:
    """Set the frame between the first and the last of several walls on a side."""
    walls = np.flatnonzero(side)
    if (np.diff(walls) > 1).any():
        frame[walls[0] + 1 : walls[-1] + 2] = True


def _walls_before(walls: BoolArray) -> tuple[BoolArray, BoolArray]:
    """Return where there is a wall to the left, and where to the right."""
    left = np.logical_or.accumulate(walls, axis=1)
    right = np.logical_or.accumulate(walls[:, ::-1], axis=1)[:, ::-1]
    return left, right


def _is_walled(stop: BoolArray, one: BoolArray, other: BoolArray) -> BoolArray:
    """Return the cells whose run along the row has walls on the one side and the other.

    A run goes from stop to stop; `one` and `other` mark the cells with a wall there.
    """
    n_rows, n_cols = stop.shape
    run = np.cumsum(stop, axis=1) + np.arange(n_rows)[:, None] * (n_cols + 1)

    def count(marked: BoolArray) -> IntArray:
        return np.bincount(run[marked & ~stop], minlength=n_rows * (n_cols + 1))

    fewest = np.minimum(count(one), count(other))
    walled = fewest > _WALLED_SHARE * count(~stop)
    return np.asarray(walled[run] & ~stop)

"""Where a robot may stand: free space with clearance, and the inside of a building."""

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError
from occsim.world import World

# Inside and outside need no more detail than this, cells along the longer side.
_CELLS = 400
# Of a run of free pixels, the share that must have walls on each of the four sides:
# a room has some, however wide its windows; a yard or an alley has none.
_WALLED_SHARE = 0.1
_PASSES = 3
# Of the sheet, and of the largest building: smaller enclosures are no buildings.
_LEAST_OF_SHEET = 0.003
_LEAST_OF_LARGEST = 0.03


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
    return np.maximum(centres[1:-1, 1:-1].astype(np.float64) - 0.5, 0.0)


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
    inside = _buildings(_majority(_enclosed(walls), walls))
    if not inside.any():
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
    left, right = _walls_before(framed)
    above, below = (blocked.T for blocked in _walls_before(framed.T))
    stop = framed.copy()
    for _ in range(_PASSES):
        # A run that leads out through a window is cut where it is found to be outside.
        across = np.minimum(_run_share(stop, above), _run_share(stop, below))
        along = np.minimum(_run_share(stop.T, left.T), _run_share(stop.T, right.T)).T
        stop = framed | (np.minimum(across, along) < _WALLED_SHARE)
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


def _run_share(stop: BoolArray, marked: BoolArray) -> FloatArray:
    """Return, for each pixel, the share of its run along the row that is marked."""
    n_rows, n_cols = stop.shape
    run = np.cumsum(stop, axis=1) + np.arange(n_rows)[:, None] * (n_cols + 1)
    run, free = run.ravel(), ~stop.ravel()
    length = np.bincount(run[free], minlength=n_rows * (n_cols + 1))
    count = np.bincount(run[free & marked.ravel()], minlength=length.size)
    share = np.where(free, count[run] / np.maximum(length[run], 1), 0.0)
    return share.reshape(stop.shape)


def _majority(inside: BoolArray, walls: BoolArray) -> BoolArray:
    """Return what most of the free cells around say, so that single rows do not."""
    if not inside.any():
        return inside
    free = (~walls).astype(np.uint8)
    depth = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    # The width of a door or so: a tenth of the cells lie deeper than this in a room.
    size = int(np.quantile(depth[inside], 0.9)) | 1
    votes, voters = (
        cv2.boxFilter(layer.astype(np.float32), -1, (size, size), normalize=False)
        for layer in (inside, free)
    )
    return np.asarray((2.0 * votes > voters) & ~walls)


def _buildings(inside: BoolArray) -> BoolArray:
    """Return the parts of the inside that are large enough to be a building's."""
    _, part = cv2.connectedComponents(inside.astype(np.uint8), connectivity=4)
    size = np.bincount(part.ravel())
    size[0] = 0
    least = max(_LEAST_OF_SHEET * inside.size, _LEAST_OF_LARGEST * size.max())
    return np.asarray((size >= least)[part])

"""Where a robot may stand: free space with clearance, and the inside of a building."""

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.errors import ParameterError
from occsim.world import World

# The vote on inside and outside needs no more detail than this, cells a side.
_VOTE_CELLS = 256
# Of eight directions. The inner corner of an L-shaped building is blocked in five; a
# corridor open at both ends in six.
_VOTES_INSIDE = 6


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
    """Return the pixels that are inside the building rather than around it.

    A pixel is inside where a wall blocks the view in at least six of eight directions.
    This needs no closed outer wall, so doors may stand open. A side of the
    drawing that cuts through walls blocks the view too: the plan goes on beyond it.

    Parameters
    ----------
    world : World
        Ground truth.

    Returns
    -------
    ndarray of bool, shape (H, W)
        A heuristic, at the detail of a 256th of the longer side. Walls are inside
        where they satisfy the rule.
    """
    cell_px = -(-max(world.shape) // _VOTE_CELLS)
    walls = world.grid(cell_px).share(world.occupied) > 0.0
    framed = np.pad(walls, 1)
    framed[0], framed[-1] = _cuts(walls[0]), _cuts(walls[-1])
    framed[:, 0], framed[:, -1] = _cuts(walls[:, 0]), _cuts(walls[:, -1])
    votes = _blocked_views(framed)[1:-1, 1:-1]
    inside = np.kron(votes >= _VOTES_INSIDE, np.ones((cell_px, cell_px), bool))
    height, width = world.shape
    return np.asarray(inside[:height, :width])


def _cuts(side: BoolArray) -> bool:
    """Whether several walls run into this side: the drawing is a cut-out."""
    starts = np.diff(side.astype(np.int8), prepend=0) == 1
    return int(starts.sum()) >= 2


def _blocked_views(walls: BoolArray) -> np.ndarray:
    """Count, cell by cell, in how many of eight directions there is a wall."""
    left = np.logical_or.accumulate(walls, axis=1)
    right = np.logical_or.accumulate(walls[:, ::-1], axis=1)[:, ::-1]
    votes = left.astype(np.int8) + right
    for drift in (-1, 0, 1):
        votes += _blocked_above(walls, drift)
        votes += _blocked_above(walls[::-1], drift)[::-1]
    return votes


def _blocked_above(walls: BoolArray, drift: int) -> BoolArray:
    """Where there is a wall upwards, `drift` columns aside for each row."""
    blocked = walls.copy()
    width = walls.shape[1]
    here = slice(max(drift, 0), width + min(drift, 0))
    there = slice(max(-drift, 0), width + min(-drift, 0))
    for row in range(1, len(walls)):
        blocked[row, here] |= blocked[row - 1, there]
    return blocked

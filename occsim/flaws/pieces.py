"""Walls that a drawing leaves out, and false ones that it shows."""

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, IntArray

PIECE_IN_WALLS = 5
"""Length of a piece of wall that is left out or added, in mean wall thicknesses: about
a door's length, 0.9 m where walls are 0.18 m thick. A mask holds no door to measure."""

_TRIES = 16  # places tried for a false piece of wall before it is halved


class _Pieces:
    """The pieces of wall of a mask: squares about the pixels of its centre lines.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        The mask, with a wall.
    """

    def __init__(self, walls: BoolArray) -> None:
        self._depth, self.centre = _centre_lines(walls)
        points = np.divmod(np.flatnonzero(self.centre), walls.shape[1])
        self.points = np.stack(points, axis=1)
        self.length = len(self.points)
        thickness = np.count_nonzero(walls) / self.length
        self.half = max(1, round(PIECE_IN_WALLS * thickness / 2))

    def reach(self, point: IntArray, left: BoolArray, most: int, half: int) -> int:
        """Return half the side of the square about a point, 0 for none.

        Parameters
        ----------
        point : ndarray of int64, shape (2,)
            Row and column on a centre line.
        left : ndarray of bool, shape (H, W)
            Centre lines that count.
        most : int
            Length that the piece shall not exceed by more than the wall is thick.
        half : int
            Half the usual side, px.
        """
        # Never less than the wall is thick: a cut goes through, a copy is a wall.
        least = int(self._depth[tuple(point)])
        half = max(half, least)
        own = left[self.window(point, half)]
        if np.count_nonzero(own) <= most:
            return half
        if most <= least:
            return 0
        rows, cols = np.nonzero(own)
        row, col = np.minimum(point, half)
        steps = np.sort(np.maximum(np.abs(rows - row), np.abs(cols - col)))
        return max(least, int(steps[most - 1]))

    def window(self, point: IntArray, half: int) -> tuple[slice, slice]:
        """Return the square about a point, cut off at the sheet's edge."""
        row, col = point.tolist()
        return (
            slice(max(row - half, 0), row + half + 1),
            slice(max(col - half, 0), col + half + 1),
        )


def _centre_lines(walls: BoolArray) -> tuple[ByteArray, BoolArray]:
    """Return each pixel's depth in its wall, px, and the pixels that are deepest.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        The mask.

    Returns
    -------
    depth : ndarray of uint8, shape (H, W)
        Steps to the nearest free pixel, 255 at most; beyond the sheet is free.
    centre : ndarray of bool, shape (H, W)
        Deepest pixels along their row or column. Of two that are equally deep one
        counts, so that a straight wall has a line of one px.
    """
    sheet = np.pad(walls.view(np.uint8), 1)
    framed: ByteArray = np.asarray(
        cv2.distanceTransform(sheet, cv2.DIST_L1, 3, dstType=cv2.CV_8U), dtype=np.uint8
    )
    depth = framed[1:-1, 1:-1]
    across = (depth >= framed[:-2, 1:-1]) & (depth > framed[2:, 1:-1])
    along = (depth >= framed[1:-1, :-2]) & (depth > framed[1:-1, 2:])
    return depth, across | along


def redrawn_walls(
    walls: BoolArray, missing_share: float, false_share: float, seed: int
) -> BoolArray:
    """Return the mask without the missing walls and with the false ones.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        The mask, with a wall.
    missing_share, false_share : float
        Shares of the walls' length, in [0, 1].
    seed : int
        Of the places.

    Returns
    -------
    ndarray of bool, shape (H, W)
    """
    pieces = _Pieces(walls)
    # One stream each: more of one flaw leaves the other where it is.
    here, there = (np.random.default_rng([seed, which]) for which in (0, 1))
    missing = _missing(walls, pieces, missing_share, here)
    return (walls & ~missing) | _false(walls, pieces, false_share, there)


def _missing(
    walls: BoolArray, pieces: _Pieces, share: float, rng: np.random.Generator
) -> BoolArray:
    if share == 1.0:
        return walls
    missing = np.zeros_like(walls)
    wanted = round(share * pieces.length)
    left = pieces.centre.copy()
    for point in rng.permutation(pieces.points) if wanted else ():
        if wanted <= 0:
            break
        if left[tuple(point)]:
            half = pieces.reach(point, left, wanted, pieces.half)
            if half == 0:
                break
            own = pieces.window(point, half)
            wanted -= int(np.count_nonzero(left[own]))
            missing[own], left[own] = True, False
    return missing


def _false(
    walls: BoolArray, pieces: _Pieces, share: float, rng: np.random.Generator
) -> BoolArray:
    false, taken = np.zeros_like(walls), walls.copy()
    wanted, fails = round(share * pieces.length), 0
    while wanted > 0 and (half := pieces.half >> fails // _TRIES):
        which, down, right = rng.random(3).tolist()
        point = pieces.points[int(which * pieces.length)]
        reach = pieces.reach(point, pieces.centre, wanted, half)
        if reach == 0:
            break
        own = pieces.window(point, reach)
        piece = walls[own]
        n_rows, n_cols = piece.shape
        row = int(down * (walls.shape[0] - n_rows + 1))
        col = int(right * (walls.shape[1] - n_cols + 1))
        place = slice(row, row + n_rows), slice(col, col + n_cols)
        if (taken[place] & piece).any():
            fails += 1
        else:
            false[place] |= piece
            taken[place] |= piece
            fails = 0
            wanted -= int(np.count_nonzero(pieces.centre[own]))
    return false

"""Counting the pixels inside outlines, cell by cell, without touching each pixel.

Along one line of pixel centres, an outline is entered and left at a few crossings. Each
crossing says that all pixels to its right change sides; cells are counted from those
changes alone, by summing along each row of cells.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.grid import Grid
from occsim.rays.outline import NO_FACE, Outline, points_on_faces, run_ends
from occsim.rays.ragged import ragged_ranges, whole_within
from occsim.rays.reach import SeenFaces, View

CountArray = npt.NDArray[np.int32]

_HALVES = np.array([[1.0], [0.5], [0.0], [-0.5], [-1.0]])

_RIGHT, _LEFT = np.int32(1), np.int32(-1)

OWN_RADIUS_PX = 1e-6
"""Outlines keep this far from the robot: a pixel centre there has no bearing and is
counted by itself. Less than the distance of any other centre, far above rounding."""


class Windows(NamedTuple):
    """The cells that each reading of a batch may reach: windows of one size.

    Parameters
    ----------
    grid : Grid
        All cells.
    first_row, first_col : ndarray of int64, shape (N,)
        The cell at the top left of each reading's window.
    n_rows, n_cols : int
        Size of every window in cells. One more column is kept on the right, for
        crossings at the right edge of the image.
    """

    grid: Grid
    first_row: IntArray
    first_col: IntArray
    n_rows: int
    n_cols: int

    @property
    def size(self) -> int:
        """Number of counters of all windows."""
        return self.first_row.size * self.n_rows * self.n_cols

    def base(self, n_outlines: int) -> IntArray:
        """Return where each window begins, less its first cell, (n_outlines,).

        Where there are more outlines than windows, all windows follow one another
        again.
        """
        starts = np.arange(n_outlines) * (self.n_rows * self.n_cols)
        corner = self.first_row * self.n_cols + self.first_col
        return (starts.reshape(-1, corner.size) - corner).ravel()

    def pixel_counters(
        self, reading: IntArray, row: IntArray, col: IntArray
    ) -> IntArray:
        """Return the counter of the cell of each pixel, (Q,)."""
        cell_px = self.grid.cell_px
        return (
            self.base(self.first_row.size)[reading]
            + row // cell_px * self.n_cols
            + col // cell_px
        )

    def sums(self, counter: IntArray, weights: CountArray) -> CountArray:
        """Return the sum of the weights, (T,), that fall to each counter, (size,)."""
        total = np.zeros(self.size, dtype=np.int32)
        np.add.at(total, counter, weights)
        return total

    def cells(self) -> CountArray:
        """Return the flat cell of the grid of every counter, (size,)."""
        corner = self.first_row * self.grid.n_cols + self.first_col
        row = np.arange(self.n_rows, dtype=np.int32) * np.int32(self.grid.n_cols)
        col = np.arange(self.n_cols, dtype=np.int32)
        inside = row[:, None] + col
        return (corner.astype(np.int32)[:, None, None] + inside).reshape(-1)


def windows_of(
    reading: IntArray, points: FloatArray, view: View, grid: Grid
) -> Windows:
    """Return windows of cells that hold what the pieces of each reading enclose.

    Parameters
    ----------
    reading : ndarray of int64, shape (P,)
        Reading of each piece of bearing, ascending; none is without.
    points : ndarray of float64, shape (2, 2, P)
        x and y from the robot, px, of the start and the end of each piece of boundary.
        Of an arc within a quadrant, these lie farthest along either axis.
    view : View
        N readings.
    grid : Grid
        All cells.

    Returns
    -------
    Windows
    """
    first, _ = run_ends(reading[1:] != reading[:-1])
    low, high = (
        view.places
        + beyond(
            beyond.reduceat(beyond(points[:, 0], points[:, 1]), first, axis=1), 0.0
        )
        for beyond in (np.minimum, np.maximum)
    )
    return windows_between(low, high, grid)


def windows_between(low: FloatArray, high: FloatArray, grid: Grid) -> Windows:
    """Return windows of cells that hold rectangles.

    Parameters
    ----------
    low, high : ndarray of float64, shape (2, N)
        Corners (x, y) of the rectangles, px.
    grid : Grid
        All cells.

    Returns
    -------
    Windows
    """
    n_cells = np.array([[grid.n_cols], [grid.n_rows]])
    # Far outside the image, cells would overflow whole numbers.
    cells = np.floor(np.array([low - 1.0, high + 1.0]) / grid.cell_px)
    first, last = np.minimum(np.maximum(cells, 0.0), n_cells - 1)
    length = np.maximum.reduce(last - first, axis=1, keepdims=True) + 1
    first_col, first_row = np.minimum(first, n_cells - length).astype(np.int64)
    n_cols, n_rows = length.ravel().astype(int).tolist()
    return Windows(grid, first_row, first_col, n_rows, n_cols + 1)


class Polygons(NamedTuple):
    """Closed outlines: first one of each reading, then perhaps a second one of each.

    Parameters
    ----------
    size : int
        Number M of outlines: N, or 2 N.
    owner : ndarray of int64, shape (V,)
        Outline of each corner, 0 to M - 1.
    corners : ndarray of float64, shape (2, V)
        x and y from the robot, px.
    following : ndarray of int64, shape (V,)
        The corner to which the edge from each corner leads, with bearings ascending.
    is_arc : ndarray of bool, shape (V,)
        Whether that edge runs round the robot, else it is straight. No arc crosses a
        cardinal bearing.
    radius : float or ndarray of float64, shape (P,)
        Of those that do, px: one for all of them, or that of the edge from each of the
        first corners.
    """

    size: int
    owner: IntArray
    corners: FloatArray
    following: IntArray
    is_arc: BoolArray
    radius: FloatArray | float


def seen_polygons(
    outline: Outline, faces: SeenFaces, view: View, *, clear_no_hit: bool, whole: bool
) -> Polygons:
    """Return what lies before the first wall, and all of which something is said.

    Parameters
    ----------
    outline : Outline
        Pieces of bearing and their nearest faces.
    faces : SeenFaces
        Those faces.
    view : View
        N readings.
    clear_no_hit : bool
        Whether bearings without a hit are empty as far as the reach. Else nothing is
        said at them.
    whole : bool
        Whether the second outlines are wanted.

    Returns
    -------
    Polygons
    """
    is_open = outline.face == NO_FACE
    kinds = [is_open & clear_no_hit, ~is_open | clear_no_hit][: 1 + whole]
    is_arc = np.array(kinds)
    radius = np.where(is_arc, max(view.reach, OWN_RADIUS_PX), OWN_RADIUS_PX)
    ends = outline.ends[:, :, None] * radius
    at_face = (~is_open).nonzero()[0]
    at_face = at_face[faces.depth[outline.face[at_face]] > 0.0]
    ends[:, :, 0, at_face] = points_on_faces(outline, faces, at_face)
    owner = np.concatenate([outline.reading, outline.reading + view.size][: 1 + whole])
    ends = ends.reshape(2, 2, -1)
    return closed_polygons(owner, ends, is_arc.ravel(), view.reach, view)


def closed_polygons(
    owner: IntArray,
    ends: FloatArray,
    is_arc: BoolArray,
    radius: FloatArray | float,
    view: View,
) -> Polygons:
    """Return pieces of boundary joined by straight edges, and round the robot.

    Parameters
    ----------
    owner : ndarray of int64, shape (P,)
        Outline of each piece, ascending: of N readings once, or twice. Within one,
        bearings ascend without a gap.
    ends : ndarray of float64, shape (2, 2, P)
        x and y from the robot, px, of its start and its end, at least OWN_RADIUS_PX
        away.
    is_arc : ndarray of bool, shape (P,)
        Whether the piece runs round the robot; none across a cardinal bearing.
    radius : float or ndarray of float64, shape (P,)
        Of those that do, px.
    view : View
        N readings.

    Returns
    -------
    Polygons
    """
    first, last = run_ends(owner[1:] != owner[:-1])
    past = _past_robot(view, first.size // view.size)
    corners = np.concatenate([ends.reshape(2, -1), past.reshape(2, -1)], axis=1)
    n_pieces, size = owner.size, corners.shape[1]
    # From the start of a piece to its end, from there to the start of the next, from
    # the last end of an outline past the robot to its first start.
    following = np.arange(n_pieces, size + n_pieces)
    following[n_pieces : 2 * n_pieces] = np.arange(1, n_pieces + 1)
    following[n_pieces + last] = np.arange(2 * n_pieces, 2 * n_pieces + first.size)
    following[2 * n_pieces :] += first.size - n_pieces
    following[size - first.size :] = first
    arcs = np.zeros(size, dtype=np.bool_)
    arcs[:n_pieces] = is_arc
    owners = [owner, owner, *[owner[first]] * past.shape[1]]
    return Polygons(
        first.size, np.concatenate(owners), corners, following, arcs, radius
    )


def _past_robot(view: View, times: int) -> FloatArray:
    """Return points (2, 5, M) past the robot at a tiny distance.

    They go back from the clockwise to the anticlockwise side.
    """
    turns = view.half * _HALVES
    absolute = np.where(turns >= np.pi, -np.pi, turns) + view.theta
    turned = OWN_RADIUS_PX * np.array([np.cos(absolute), np.sin(absolute)])
    return np.concatenate([turned] * times, axis=2)


def count_pixels(polygons: Polygons, windows: Windows, view: View) -> CountArray:
    """Return how many pixel centres of each cell lie inside polygons.

    Parameters
    ----------
    polygons : Polygons
        One of each reading, or two.
    windows : Windows
        Cells to count in.
    view : View
        N readings.

    Returns
    -------
    ndarray of int32, shape (M / N, windows.size)
        Zero in the spare column of each window.
    """
    owner, row, x, sign = _crossings(polygons, windows.grid, view)
    grid = windows.grid
    # The first pixel whose centre lies at the crossing or right of it.
    col = whole_within(np.ceil(x), grid.width_px)
    cell, within = _cells_of_pixels(max(grid.height_px, grid.width_px), grid.cell_px)
    base = windows.base(polygons.size)
    counter = base[owner] + cell[row] * windows.n_cols + cell[col]
    # Each change counts for its whole cell and all right of it, but in its own cell not
    # for the pixels left of it. One counter more: nothing is left of the spare column.
    n_counters = polygons.size * windows.n_rows * windows.n_cols
    changes = np.zeros(n_counters + 1, dtype=np.int32)
    left = sign * within[col]
    np.add.at(changes, counter, sign * np.int32(grid.cell_px) - left)
    if grid.cell_px > 1:
        np.add.at(changes, counter + 1, left)
    by_row = changes[:-1].reshape(-1, windows.n_cols)
    np.add.accumulate(by_row, axis=1, out=by_row)
    return by_row.reshape(-1, windows.size)


@lru_cache(maxsize=8)
def _cells_of_pixels(length_px: int, cell_px: int) -> tuple[IntArray, CountArray]:
    # Which cell a row or column of pixels falls to, and how far into it: divisions
    # take longer than looking them up.
    cell, within = np.divmod(np.arange(length_px + 1), cell_px)
    return cell, within.astype(np.int32)


def _crossings(
    polygons: Polygons, grid: Grid, view: View
) -> tuple[IntArray, IntArray, FloatArray, CountArray]:
    """Return where edges cross lines of pixel centres.

    Returns
    -------
    owner, row : ndarray of int64, shape (T,)
        Outline and row of pixels.
    x : ndarray of float64, shape (T,)
        Column, such that a whole number is that pixel's centre.
    sign : ndarray of int32, shape (T,)
        +1 where the inside lies to the right, -1 where to the left.
    """
    robots = np.concatenate([view.places - 0.5] * (polygons.size // view.size), axis=1)
    shift = robots[1][polygons.owner]
    rows = whole_within(np.ceil(polygons.corners[1] + shift), grid.height_px)
    # Between narrow beams most edges cross no line.
    start = (rows != rows[polygons.following]).nonzero()[0]
    is_arc = polygons.is_arc[start]
    start = np.concatenate([start[~is_arc], start[is_arc]])
    end, n_lines = polygons.following[start], start.size - np.count_nonzero(is_arc)
    first, last, shift = rows[start], rows[end], shift[start]
    edge, row = ragged_ranges(np.minimum(first, last), np.maximum(first, last))
    # Bearings ascend clockwise: falling edges (y grows) have the inside on their left,
    # and of the arcs those are the ones on the right.
    falls = last > first
    sign = np.where(falls, _LEFT, _RIGHT)[edge]
    n_on_lines = edge.searchsorted(n_lines)
    line, arc = edge[:n_on_lines], edge[n_on_lines:]
    x = np.empty(edge.size)
    # From the upper end whichever way an edge is walked: the two sides of the seam of
    # a full turn then cancel to the last bit.
    begins, ends = (
        polygons.corners.take(corner[:n_lines], axis=1) for corner in (start, end)
    )
    top = np.where(falls[:n_lines], begins, ends)
    width, height = ends - begins
    slope = width / np.where(height == 0.0, 1.0, height)
    above = shift[:n_lines] + top[1]
    x[:n_on_lines] = top[0][line] + (row[:n_on_lines] - above[line]) * slope[line]
    y = row[n_on_lines:] - shift[arc]
    radius = polygons.radius
    if isinstance(radius, np.ndarray):
        radius = radius[start[n_lines:]][arc - n_lines]
    x[n_on_lines:] = -sign[n_on_lines:] * np.sqrt(np.maximum(radius**2 - y * y, 0.0))
    owner = polygons.owner[start][edge]
    return owner, row, x + robots[0][owner], sign

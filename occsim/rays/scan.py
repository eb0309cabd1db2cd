"""Counting the pixels inside outlines, cell by cell, without touching each pixel.

Along one line of pixel centres, an outline is entered and left at a few crossings. Each
crossing says that all pixels to its right change sides; cells are counted from those
changes alone, by summing along each row of cells.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.grid import Grid
from occsim.rays.outline import NO_FACE, Outline, points_on_faces, run_ends
from occsim.rays.ragged import ragged_ranges
from occsim.rays.reach import SeenFaces, View

CountArray = npt.NDArray[np.int32]

_HALVES = np.array([[1.0], [0.5], [0.0], [-0.5], [-1.0]])

OWN_RADIUS_PX = 1e-6
"""Outlines keep this far from the robot: a pixel centre there has no bearing and is
counted by itself. Less than the distance of any other centre, far above rounding."""


@dataclass(frozen=True, eq=False)
class Windows:
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

    def base(self) -> IntArray:
        """Return where each window begins, less its first cell, (N,)."""
        starts = np.arange(self.first_row.size) * (self.n_rows * self.n_cols)
        return starts - self.first_row * self.n_cols - self.first_col

    def pixel_counters(
        self, reading: IntArray, row: IntArray, col: IntArray
    ) -> IntArray:
        """Return the counter of the cell of each pixel, (Q,)."""
        cell_px = self.grid.cell_px
        return self.base()[reading] + row // cell_px * self.n_cols + col // cell_px

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


def windows_around(view: View, grid: Grid) -> Windows:
    """Return windows of cells that hold the field of view of each reading.

    Parameters
    ----------
    view : View
        N readings.
    grid : Grid
        All cells.

    Returns
    -------
    Windows
    """
    # Along x, then along y.
    centre, axis = np.array([view.x, view.y]), np.array([[0.0], [0.5 * np.pi]])
    off = np.abs(wrap_angle(view.theta - axis))
    farthest = np.cos(np.maximum(off - view.half, 0.0))
    nearest = np.cos(np.minimum(off + view.half, np.pi))
    low = centre + view.reach * np.minimum(nearest, 0.0)
    high = centre + view.reach * np.maximum(farthest, 0.0)
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
    first, last = (
        np.minimum(np.maximum(np.floor(end / grid.cell_px), 0), n_cells - 1)
        for end in (low - 1.0, high + 1.0)
    )
    length = (last - first).max(axis=1, keepdims=True) + 1
    first_col, first_row = np.minimum(first, n_cells - length).astype(np.int64)
    n_cols, n_rows = length.ravel().astype(int).tolist()
    return Windows(grid, first_row, first_col, n_rows, n_cols + 1)


@dataclass(frozen=True, eq=False)
class Edges:
    """Edges of closed outlines, walked with bearings ascending.

    Parameters
    ----------
    reading : ndarray of int64, shape (E,)
        Reading of the batch.
    start, end : ndarray of float64, shape (2, E)
        Points (x, y) from the robot, px.
    radius : float or ndarray of float64, shape (E,)
        Of arcs, px: one for all of them, or each its own.
    """

    reading: IntArray
    start: FloatArray
    end: FloatArray
    radius: FloatArray | float = 0.0


@dataclass(frozen=True, eq=False)
class Polygons:
    """Closed outlines, one of each reading.

    Parameters
    ----------
    straight : Edges
        Edges that are straight.
    arcs : Edges
        Edges that run round the robot, none across a cardinal bearing.
    """

    straight: Edges
    arcs: Edges


def empty_polygons(
    outline: Outline, faces: SeenFaces, view: View, *, clear_no_hit: bool
) -> Polygons:
    """Return what lies before the first wall, within reach.

    Parameters
    ----------
    outline : Outline
        Pieces of bearing and their nearest faces.
    faces : SeenFaces
        Those faces.
    view : View
        N readings.
    clear_no_hit : bool
        Whether bearings without a hit are empty as far as the reach.

    Returns
    -------
    Polygons
    """
    is_open = outline.face == NO_FACE
    is_arc = is_open & clear_no_hit
    radius = np.where(is_arc, max(view.reach, OWN_RADIUS_PX), OWN_RADIUS_PX)
    start, end = outline.start * radius, outline.end * radius
    at_face = (~is_open).nonzero()[0]
    at_face = at_face[faces.depth[outline.face[at_face]] > 0.0]
    face = outline.face[at_face]
    ends = np.concatenate([outline.start[:, at_face], outline.end[:, at_face]], axis=1)
    points = points_on_faces(faces, np.concatenate([face, face]), ends)
    start[:, at_face], end[:, at_face] = points[:, : face.size], points[:, face.size :]
    return closed_polygons(outline.reading, start, end, is_arc, view.reach, view)


def view_polygons(outline: Outline, view: View, *, clear_no_hit: bool) -> Polygons:
    """Return what lies within reach, at bearings of which the reading says something.

    Parameters
    ----------
    outline : Outline
        Pieces of bearing and their nearest faces.
    view : View
        N readings.
    clear_no_hit : bool
        Whether that includes bearings without a hit.

    Returns
    -------
    Polygons
    """
    is_arc = (outline.face != NO_FACE) | clear_no_hit
    radius = np.where(is_arc, max(view.reach, OWN_RADIUS_PX), OWN_RADIUS_PX)
    start, end = outline.start * radius, outline.end * radius
    return closed_polygons(outline.reading, start, end, is_arc, view.reach, view)


def closed_polygons(
    reading: IntArray,
    start: FloatArray,
    end: FloatArray,
    is_arc: BoolArray,
    radius: FloatArray | float,
    view: View,
) -> Polygons:
    """Return pieces of boundary joined by straight edges, and round the robot.

    Parameters
    ----------
    reading : ndarray of int64, shape (P,)
        Reading of each piece, ascending; within one, bearings ascend without a gap.
    start, end : ndarray of float64, shape (2, P)
        Its ends (x, y) from the robot, px, at least OWN_RADIUS_PX away.
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
    first, last = run_ends(reading[1:] != reading[:-1])
    # Back past the robot at a tiny distance, clockwise to anticlockwise side.
    turns = view.half * _HALVES
    absolute = np.where(turns >= np.pi, -np.pi, turns) + view.theta
    turned = OWN_RADIUS_PX * np.array([np.cos(absolute), np.sin(absolute)])
    past = [*turned.transpose(1, 0, 2), start[:, first]]
    # From each piece to the next, from the last of a reading past the robot.
    following = np.empty_like(start)
    following[:, :-1] = start[:, 1:]
    following[:, last] = past[0]
    flat = (~is_arc).nonzero()[0]
    straight = Edges(
        np.concatenate([reading, reading[flat], *[reading[first]] * (len(past) - 1)]),
        np.concatenate([end, start[:, flat], *past[:-1]], axis=1),
        np.concatenate([following, end[:, flat], *past[1:]], axis=1),
    )
    if flat.size == 0:
        return Polygons(straight, Edges(reading, start, end, radius))
    arc = is_arc.nonzero()[0]
    if isinstance(radius, np.ndarray):
        radius = radius[arc]
    return Polygons(straight, Edges(reading[arc], start[:, arc], end[:, arc], radius))


def count_pixels(polygons: Polygons, windows: Windows, view: View) -> CountArray:
    """Return how many pixel centres of each cell lie inside the outlines.

    Parameters
    ----------
    polygons : Polygons
        Closed outlines of N readings.
    windows : Windows
        Cells to count in.
    view : View
        The readings.

    Returns
    -------
    ndarray of int32, shape (windows.size,)
        Zero in the spare column of each window.
    """
    base = windows.base()
    parts = [
        _crossings(edges, is_arc, windows.grid, view)
        for edges, is_arc in ((polygons.straight, False), (polygons.arcs, True))
    ]
    reading, row, x, sign = (np.concatenate(part) for part in zip(*parts, strict=True))
    grid = windows.grid
    # The first pixel whose centre lies at the crossing or right of it.
    col = _whole_within(np.ceil(x), grid.width_px)
    cell, within = _cells_of_pixels(max(grid.height_px, grid.width_px), grid.cell_px)
    counter = base[reading] + cell[row] * windows.n_cols + cell[col]
    # Each change counts for its whole cell and all right of it, but in its own cell not
    # for the pixels left of it. One counter more: nothing is left of the spare column.
    changes = np.zeros(windows.size + 1, dtype=np.int32)
    left = sign * within[col]
    np.add.at(changes, counter, sign * np.int32(grid.cell_px) - left)
    if grid.cell_px > 1:
        np.add.at(changes, counter + 1, left)
    changes = changes[:-1]
    by_row = changes.reshape(-1, windows.n_cols)
    np.cumsum(by_row, axis=1, out=by_row)
    return changes


@lru_cache(maxsize=8)
def _cells_of_pixels(length_px: int, cell_px: int) -> tuple[IntArray, CountArray]:
    # Which cell a row or column of pixels falls to, and how far into it: divisions
    # take longer than looking them up.
    cell, within = np.divmod(np.arange(length_px + 1), cell_px)
    return cell, within.astype(np.int32)


def _whole_within(values: FloatArray, most: int) -> IntArray:
    return np.minimum(np.maximum(values, 0), most).astype(np.int64)


def _crossings(
    edges: Edges, is_arc: bool, grid: Grid, view: View
) -> tuple[IntArray, IntArray, FloatArray, CountArray]:
    """Return where edges cross lines of pixel centres.

    Returns
    -------
    reading, row : ndarray of int64, shape (T,)
        Reading of the batch and row of pixels.
    x : ndarray of float64, shape (T,)
        Column, such that a whole number is that pixel's centre.
    sign : ndarray of int32, shape (T,)
        +1 where the inside lies to the right, -1 where to the left.
    """
    shift = view.y[edges.reading] - 0.5
    rows = np.array(
        [
            _whole_within(np.ceil(end[1] + shift), grid.height_px)
            for end in (edges.start, edges.end)
        ]
    )
    # Between narrow beams most edges cross no line.
    crosses = (rows[0] != rows[1]).nonzero()[0]
    rows, shift = rows[:, crosses], shift[crosses]
    edge, row = ragged_ranges(np.minimum(*rows), np.maximum(*rows))
    # Bearings ascend clockwise: falling edges (y grows) have the inside on their left,
    # and of the arcs those are the ones on the right.
    falls = rows[1] > rows[0]
    sign = np.where(falls, np.int32(-1), np.int32(1))[edge]
    if is_arc:
        y = row - shift[edge]
        radius = edges.radius
        if isinstance(radius, np.ndarray):
            radius = radius[crosses][edge]
        x = -sign * np.sqrt(np.maximum(radius**2 - y * y, 0.0))
    else:
        # From the upper end whichever way it is walked: the two sides of the seam of
        # a full turn then cancel to the last bit.
        start, end = edges.start[:, crosses], edges.end[:, crosses]
        top = np.where(falls, start, end)
        width, height = end - start
        slope = width / np.where(height == 0.0, 1.0, height)
        x = top[0][edge] + (row - (shift + top[1])[edge]) * slope[edge]
    reading = edges.reading[crosses][edge]
    return reading, row, x + (view.x[reading] - 0.5), sign

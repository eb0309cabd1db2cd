"""The grid: pixels of a drawing grouped into square cells."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, bool_array, expect, whole_number

MAX_SIZE_PX = 2**31 - 1
"""Largest side of an image or a cell, px: the largest int32."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Grid:
    """Square cells over an image; the last row and column may be partial.

    Parameters
    ----------
    height_px, width_px : int
        Size of the image, px, at least 1.
    cell_px : int
        Side of a cell, px, at least 1.

    Raises
    ------
    ParameterError
        Where a size is not a whole number from 1 to `MAX_SIZE_PX`.

    Examples
    --------
    >>> from occsim import Grid
    >>> Grid(height_px=7, width_px=10, cell_px=3).shape
    (3, 4)
    """

    height_px: int
    width_px: int
    cell_px: int

    def __post_init__(self) -> None:
        for name in ("height_px", "width_px", "cell_px"):
            value = whole_number(name, getattr(self, name), 1, MAX_SIZE_PX)
            object.__setattr__(self, name, value)

    @property
    def n_rows(self) -> int:
        """Number of rows of cells."""
        return -(-self.height_px // self.cell_px)

    @property
    def n_cols(self) -> int:
        """Number of columns of cells."""
        return -(-self.width_px // self.cell_px)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of cells, (R, C)."""
        return self.n_rows, self.n_cols

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return self.n_rows * self.n_cols

    def pixels_per_cell(self) -> IntArray:
        """Return how many pixels of the image each cell contains.

        Returns
        -------
        ndarray of int64, shape (R, C)
            ``cell_px ** 2`` inside, fewer at the right and bottom edge.
        """
        heights = np.full(self.n_rows, self.cell_px, dtype=np.int64)
        widths = np.full(self.n_cols, self.cell_px, dtype=np.int64)
        heights[-1] = self.height_px - (self.n_rows - 1) * self.cell_px
        widths[-1] = self.width_px - (self.n_cols - 1) * self.cell_px
        return heights[:, None] * widths[None, :]

    def share(self, mask: npt.ArrayLike) -> FloatArray:
        """Return the share of true pixels in each cell.

        Parameters
        ----------
        mask : array_like of bool, shape (H, W)
            One flag a pixel.

        Returns
        -------
        ndarray of float64, shape (R, C)
            In [0, 1]; for a partial cell, the share of the pixels that it contains.

        Raises
        ------
        TypeError
            Where the mask is not bool.
        ParameterError
            Where it does not have the size of the image.
        """
        counts = self.count(mask)
        return np.asarray(counts / self.pixels_per_cell(), dtype=np.float64)

    def count(self, mask: npt.ArrayLike) -> IntArray:
        """Return the number of true pixels in each cell.

        Parameters
        ----------
        mask : array_like of bool, shape (H, W)
            One flag a pixel.

        Returns
        -------
        ndarray of int64, shape (R, C)

        Raises
        ------
        TypeError, ParameterError
            As in `share`.
        """
        flags = bool_array("mask", mask, (self.height_px, self.width_px))
        row_starts = np.arange(0, self.height_px, self.cell_px)
        col_starts = np.arange(0, self.width_px, self.cell_px)
        # Rows first: int32 sums over contiguous memory, then the few columns.
        rows = np.add.reduceat(flags, row_starts, axis=0, dtype=np.int32)
        return np.add.reduceat(rows, col_starts, axis=1, dtype=np.int64)

    def cell_index(self, x_px: npt.ArrayLike, y_px: npt.ArrayLike) -> IntArray:
        """Return the flat row-major index of the cell that holds each point.

        Parameters
        ----------
        x_px, y_px : array_like
            Points in the image frame, px.

        Returns
        -------
        ndarray of int64
            Index in [0, R * C), or -1 outside the image.
        """
        x = np.asarray(x_px, dtype=np.float64)
        y = np.asarray(y_px, dtype=np.float64)
        inside = (x >= 0) & (y >= 0) & (x < self.width_px) & (y < self.height_px)
        col = np.floor(np.where(inside, x, 0.0) / self.cell_px).astype(np.int64)
        row = np.floor(np.where(inside, y, 0.0) / self.cell_px).astype(np.int64)
        return np.asarray(np.where(inside, row * self.n_cols + col, -1), dtype=np.int64)


def cells_of(name: str, cells: npt.ArrayLike, grid: Grid) -> BoolArray:
    """Check truth values, one for each cell, and return them as an array.

    Parameters
    ----------
    name : str
        What to call the values in a message.
    cells : array_like of bool, shape (R, C)
        The values.
    grid : Grid
        The cells.

    Returns
    -------
    ndarray of bool, shape (R, C)

    Raises
    ------
    TypeError, ParameterError
        Where the type or the shape is another.
    """
    expect("grid", grid, Grid)
    return bool_array(name, cells, grid.shape)


def same_grid(**grids: Grid) -> Grid:
    """Return the grid that several objects share.

    Parameters
    ----------
    **grids : Grid
        The grid of each object, by its name.

    Returns
    -------
    Grid

    Raises
    ------
    ParameterError
        Where they differ.
    """
    first, *others = grids.values()
    if any(grid != first for grid in others):
        names = " and ".join(grids).replace("_", " ")
        got = " and ".join(map(str, grids.values()))
        raise ParameterError(f"{names} must lie on the same grid; got {got}")
    return first


def require_cover(grid: Grid, shape: tuple[int, ...]) -> None:
    """Check that a grid lies over a whole world.

    Parameters
    ----------
    grid : Grid
        The cells.
    shape : tuple of int
        Height and width of the world, px.

    Raises
    ------
    ParameterError
        Where it does not.
    """
    if (grid.height_px, grid.width_px) != shape:
        raise ParameterError(
            f"grid must cover the world of {shape} px; got "
            f"({grid.height_px}, {grid.width_px}) px"
        )

"""A ROS map: percentages of occupation, and where they lie."""

from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, ShortRepr
from occsim.errors import ParameterError, expect, real_number
from occsim.grid import Grid, cells_of, require_cover
from occsim.io.metric import MetricFrame
from occsim.mapping import OccupancyMap
from occsim.prior import PriorMap
from occsim.world import World, wall_cells

UNKNOWN, FREE, OCCUPIED = -1, 0, 100
"""Values of ``nav_msgs/OccupancyGrid``."""

Values = npt.NDArray[np.int8]


@dataclass(frozen=True, eq=False, repr=False)
class RosMap(ShortRepr):
    """A map as ROS knows it.

    Parameters
    ----------
    values : array_like of int, shape (H, W)
        Percentage of occupation, 0 to 100, or -1 for unknown; the top row first, as in
        the image. A private copy is kept, never written to.
    resolution_m : float
        Side of a pixel, m, above 0.
    origin : tuple of float, default (0, 0, 0)
        x, y, m, of the lower left corner, and the map's turn to the left about it, rad.

    Raises
    ------
    TypeError, ParameterError
        Where values are no whole numbers from -1 to 100, or the frame makes no sense.

    Examples
    --------
    >>> from occsim.io.ros_map import RosMap
    >>> RosMap([[100, 0], [0, -1]], 0.05).occupancy_grid()  # from the bottom up
    array([  0,  -1, 100,   0], dtype=int8)
    """

    values: Values
    resolution_m: float
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        values = _checked_values(self.values)
        values.setflags(write=False)
        object.__setattr__(self, "values", values)
        resolution = real_number("resolution_m", self.resolution_m)
        object.__setattr__(self, "resolution_m", resolution)
        x, y, yaw = (real_number("origin", part) for part in self.origin)
        object.__setattr__(self, "origin", (x, y, yaw))
        _ = self.frame  # checks resolution and origin

    @classmethod
    def from_occupancy_grid(
        cls,
        data: npt.ArrayLike,
        *,
        width: int,
        resolution_m: float,
        origin: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> Self:
        """Return the map of a ``nav_msgs/OccupancyGrid`` message.

        Parameters
        ----------
        data : array_like of int, shape (H * W,)
            Its ``data``: row by row from the bottom up.
        width : int
            Its ``info.width``.
        resolution_m, origin
            Its ``info.resolution``, and ``info.origin`` as x, y, yaw.

        Returns
        -------
        RosMap

        Raises
        ------
        TypeError, ParameterError
            As `RosMap`, or where the data has no whole rows.
        """
        flat = np.asarray(data)
        if flat.ndim != 1 or width < 1 or flat.size % width:
            raise ParameterError(
                f"data must hold whole rows of width {width}; got shape {flat.shape}"
            )
        return cls(flat.reshape(-1, width)[::-1], resolution_m, origin)

    @classmethod
    def of_map(cls, occupancy_map: OccupancyMap, frame: MetricFrame) -> Self:
        """Return a map of ours, one pixel a cell.

        Parameters
        ----------
        occupancy_map : OccupancyMap
            Cells that no reading updated and whose p_free is exactly one half are
            unknown.
        frame : MetricFrame
            Where the drawing lies.

        Returns
        -------
        RosMap
            p_free is rounded to whole per cent: that is all that ROS keeps.
        """
        expect("occupancy_map", occupancy_map, OccupancyMap)
        unknown = (occupancy_map.n_updates == 0) & (occupancy_map.log_odds == 0.0)
        return cls._of_cells(occupancy_map.p_free, unknown, occupancy_map.grid, frame)

    @classmethod
    def of_prior(
        cls,
        prior_map: PriorMap,
        frame: MetricFrame,
        is_unknown: BoolArray | None = None,
    ) -> Self:
        """Return a prior of ours, one pixel a cell; one half is 50, not unknown.

        Parameters
        ----------
        prior_map : PriorMap
            The prior.
        frame : MetricFrame
            Where the drawing lies.
        is_unknown : ndarray of bool, shape (R, C), optional
            Cells of which the drawing says nothing: unknown in the map too. None by
            default.

        Returns
        -------
        RosMap
        """
        expect("prior_map", prior_map, PriorMap)
        grid = prior_map.grid
        unknown = np.zeros(grid.shape, dtype=np.bool_)
        if is_unknown is not None:
            unknown = cells_of("is_unknown", is_unknown, grid)
        return cls._of_cells(prior_map.p_free, unknown, grid, frame)

    @classmethod
    def _of_cells(
        cls, p_free: FloatArray, unknown: BoolArray, grid: Grid, frame: MetricFrame
    ) -> Self:
        expect("frame", frame, MetricFrame)
        if frame.height_px != grid.height_px:
            raise ParameterError(
                f"frame must be that of a drawing {grid.height_px} px high; got "
                f"{frame.height_px}"
            )
        values = np.rint(100.0 * (1.0 - p_free)).astype(np.int8)
        # The last row of cells may reach below the drawing: so does the map.
        below = grid.n_rows * grid.cell_px - grid.height_px
        below_m, yaw = below * frame.metres_per_px, frame.origin_yaw_rad
        origin = (
            frame.origin_x_m + below_m * float(np.sin(yaw)),
            frame.origin_y_m - below_m * float(np.cos(yaw)),
            yaw,
        )
        values = np.where(unknown, np.int8(UNKNOWN), values)
        return cls(values, grid.cell_px * frame.metres_per_px, origin)

    @property
    def frame(self) -> MetricFrame:
        """Where the map lies, for poses in metres."""
        x, y, yaw = self.origin
        return MetricFrame(
            height_px=self.values.shape[0],
            metres_per_px=self.resolution_m,
            origin_x_m=x,
            origin_y_m=y,
            origin_yaw_rad=yaw,
        )

    @property
    def is_unknown(self) -> BoolArray:
        """Which pixels are unknown, ndarray of bool of shape (H, W)."""
        return np.asarray(self.values == UNKNOWN)

    @property
    def is_occupied(self) -> BoolArray:
        """Which pixels are rather occupied than free: a wall mask, (H, W)."""
        return np.asarray(self.values > 50)

    @property
    def p_free(self) -> FloatArray:
        """Probability of free, ndarray of float64 of shape (H, W); unknown is NaN."""
        return np.where(self.is_unknown, np.nan, 1.0 - self.values / 100.0)

    def world(self) -> World:
        """Return the map as ground truth: what is occupied is wall, the rest free."""
        return World(self.is_occupied)

    def prior_map(self, grid: Grid, certainty: float = 0.9) -> PriorMap:
        """Return the map as a prior.

        Parameters
        ----------
        grid : Grid
            Cells over the map's pixels.
        certainty : float, default 0.9
            p_free of what the map calls free, in (0.5, 1); one less this where it is
            occupied, in proportion between. Infinite log-odds would end all learning.

        Returns
        -------
        PriorMap
            The mean over each cell's pixels; an unknown pixel counts as one half. Wall
            cells are those with any occupied pixel.

        Raises
        ------
        TypeError, ParameterError
            Where the grid has another size, or the certainty lies outside its domain.
        """
        expect("grid", grid, Grid)
        require_cover(grid, self.values.shape)
        certainty = real_number("certainty", certainty)
        if not 0.5 < certainty < 1.0:
            raise ParameterError(f"certainty must lie in (0.5, 1); got {certainty}")
        known = np.where(self.is_unknown, 0.0, 1.0 - self.values / 50.0)
        pixels = 0.5 + (certainty - 0.5) * known
        starts = (np.arange(0, n, grid.cell_px) for n in self.values.shape)
        sums = pixels
        for axis, start in enumerate(starts):
            sums = np.add.reduceat(sums, start, axis=axis)
        return PriorMap(
            grid, wall_cells(self.is_occupied, grid), sums / grid.pixels_per_cell()
        )

    def occupancy_grid(self) -> Values:
        """Return the ``data`` of a ``nav_msgs/OccupancyGrid``, int8 of shape (H * W,).

        Row by row from the bottom up.
        """
        return self.values[::-1].ravel()


def _checked_values(values: npt.ArrayLike) -> Values:
    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        raise TypeError(f"values must hold whole numbers; got {array.dtype}")
    if array.ndim != 2 or not array.size or array.min() < -1 or array.max() > 100:
        raise ParameterError(
            f"values must have shape (H, W) and lie in -1 to 100; got {array.shape}"
        )
    return np.array(array, dtype=np.int8, order="C")

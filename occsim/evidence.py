"""The evidence log: what the readings say, before any prior."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, Progress
from occsim.errors import ParameterError
from occsim.grid import Grid
from occsim.rays.cull import without_hidden
from occsim.rays.faces import SideFaces, wall_faces
from occsim.rays.outline import trace_outline
from occsim.rays.reach import View, seen_faces
from occsim.rays.scan import (
    CountArray,
    Windows,
    count_pixels,
    empty_polygons,
    view_polygons,
    windows_around,
)
from occsim.rays.surface import count_surface, own_pixels
from occsim.sensor import BehindHit, Sensor, inverse_sensor_model
from occsim.trajectory import Trajectory
from occsim.world import World

COUNTERS_AT_ONCE = 1 << 19
FACES_AT_ONCE = 1 << 18
READINGS_AT_ONCE = 1 << 9
"""Readings are taken in batches of so many cells, faces and readings: work that stays
in the processor's cache is faster, and memory does not grow with the trajectory."""

MANY_FACES = 100
"""Faces in view of a reading from which on it pays to look for hidden ones first."""


@dataclass(frozen=True, eq=False)
class EvidenceLog:
    """Per reading, the cells that it updated and their log-odds.

    Parameters
    ----------
    grid : Grid
        The cells.
    indptr : ndarray of int64, shape (S + 1,)
        Reading s owns the entries ``indptr[s]:indptr[s + 1]``.
    cell : ndarray of int32, shape (N,)
        Flat row-major cell of each entry; one entry per cell and reading.
    log_odds : ndarray of float64, shape (N,)
        ``logit(p_free(reading))`` of Eq. 4.22, nats.
    """

    grid: Grid
    indptr: IntArray
    cell: npt.NDArray[np.int32]
    log_odds: FloatArray

    @property
    def n_readings(self) -> int:
        """Number S of readings."""
        return self.indptr.size - 1

    @cached_property
    def reading(self) -> npt.NDArray[np.int32]:
        """Reading of each entry, ndarray of int32 of shape (N,)."""
        return np.repeat(
            np.arange(self.n_readings, dtype=np.int32), np.diff(self.indptr)
        )

    def totals(self, n_readings: int | None = None) -> tuple[FloatArray, IntArray]:
        """Return the sum and the number of each cell's readings.

        Parameters
        ----------
        n_readings : int, optional
            Only the first ones, 0 to S; all by default.

        Returns
        -------
        sums : ndarray of float64, shape (R, C)
            Summed log-odds S of the readings, nats.
        counts : ndarray of int64, shape (R, C)
            Number k of readings.

        Raises
        ------
        ParameterError
            Where there are not that many readings.
        """
        if n_readings is None or n_readings == self.n_readings:
            return self._all_totals
        whole = isinstance(n_readings, (int, np.integer))
        if not whole or not 0 <= n_readings <= self.n_readings:
            raise ParameterError(
                f"n_readings must be a whole number, 0 to {self.n_readings}; "
                f"got {n_readings!r}"
            )
        return self._sum_entries(int(self.indptr[n_readings]))

    @cached_property
    def _all_totals(self) -> tuple[FloatArray, IntArray]:
        # Every prior that is tried on this log needs the same two arrays.
        return self._sum_entries(self.cell.size)

    def _sum_entries(self, n_entries: int) -> tuple[FloatArray, IntArray]:
        cell, size = self.cell[:n_entries], self.grid.n_cells
        weights = self.log_odds[:n_entries]
        sums: FloatArray = np.bincount(cell, weights=weights, minlength=size).astype(
            np.float64, copy=False
        )
        counts = np.bincount(cell, minlength=size).astype(np.int64)
        for array in (sums, counts):
            array.setflags(write=False)
        return sums.reshape(self.grid.shape), counts.reshape(self.grid.shape)


def collect_evidence(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    grid: Grid,
    on_progress: Progress | None = None,
) -> EvidenceLog:
    """Return what every reading along a trajectory says of every cell (Eq. 4.22).

    Parameters
    ----------
    world : World
        What the sensor sees.
    trajectory : Trajectory
        S poses, one reading each.
    sensor : Sensor
        Field of view, reach, and what is said of pixels behind a hit.
    grid : Grid
        Cells over the world's image.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` from time to time.

    Returns
    -------
    EvidenceLog

    Raises
    ------
    ParameterError
        Where the grid does not have the size of the world.

    Notes
    -----
    Exact for every pixel: a pixel counts as if its own ray, from the robot through its
    centre, had been walked.

    - A ray is stopped by the first wall pixel whose square it touches, be it only at a
      corner: a diagonal line of pixels is closed.
    - The sides of the cone and its reach belong to the field of view.
    - A robot in a wall pixel meets the wall at distance 0 on all bearings; one that
      stands on a wall's edge or corner, on those that lead into the wall. One outside
      the image sees the walls in it.
    - The pixel whose centre is the robot is always in view. It is object if it is wall,
      else empty, even where rays without a hit are ignored.

    References
    ----------
    .. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
       quality", sec. 4.5; C. Georgiou, S. Anderson and T. Dodd, IJRR 2017,
       doi 10.1177/0278364916687027.
    """
    if (grid.height_px, grid.width_px) != world.shape:
        raise ParameterError(
            f"grid must cover the world of {world.shape} px; got "
            f"({grid.height_px}, {grid.width_px}) px"
        )
    parts = []
    for counts in pixel_counts(world, trajectory.poses, sensor, grid):
        parts.append(_entries(counts))
        if on_progress is not None:
            on_progress(counts.done, len(trajectory))
    sizes, cells, log_odds = (np.concatenate(part) for part in zip(*parts, strict=True))
    indptr = np.concatenate([[0], np.cumsum(sizes)])
    for array in (indptr, cells, log_odds):
        # The log remembers its totals: entries must not change under them.
        array.setflags(write=False)
    return EvidenceLog(grid=grid, indptr=indptr, cell=cells, log_odds=log_odds)


@dataclass(frozen=True, eq=False)
class PixelCounts:
    """What a batch of N readings sees of the cells around, counted in pixels.

    Parameters
    ----------
    done : int
        Readings up to the end of this batch.
    windows : Windows
        The cells, `windows.size` counters in all.
    n_empty, n_object : ndarray of int32, shape (windows.size,)
        Pixels in view nearer than the hit, and at it or beyond.
    """

    done: int
    windows: Windows
    n_empty: CountArray
    n_object: CountArray


def pixel_counts(
    world: World, poses: FloatArray, sensor: Sensor, grid: Grid
) -> Iterator[PixelCounts]:
    """Yield what readings see, one batch after another.

    Parameters
    ----------
    world : World
        Ground truth.
    poses : ndarray of float64, shape (S, 3)
        x_px, y_px, theta_rad of each reading.
    sensor : Sensor
        Range, field of view, what is said behind a hit.
    grid : Grid
        Cells over the world.

    Yields
    ------
    PixelCounts
    """
    faces = wall_faces(world.occupied)
    for batch in _batches(len(poses), sensor, grid, faces):
        view = View.of(poses[batch], sensor)
        windows = windows_around(view, grid)
        n_empty, n_object = _count(world, faces, view, sensor, windows)
        yield PixelCounts(batch.stop, windows, n_empty, n_object)


def _batches(
    n_readings: int, sensor: Sensor, grid: Grid, faces: tuple[SideFaces, ...]
) -> list[slice]:
    """Return slices of readings that together stay within bounds of memory."""
    reach_px = 2.0 * sensor.range_px
    across = int(min(reach_px / grid.cell_px, max(grid.shape))) + 4
    window = min(across, grid.n_rows) * min(across, grid.n_cols)
    # On average a reading has its share of the faces in reach, by area.
    share = min(reach_px / grid.height_px, 1.0) * min(reach_px / grid.width_px, 1.0)
    n_faces = int(share * sum(side.position.size for side in faces)) + 1
    size = min(COUNTERS_AT_ONCE // window, FACES_AT_ONCE // n_faces, READINGS_AT_ONCE)
    size = max(size, 1)
    starts = range(0, n_readings, size)
    return [slice(start, min(start + size, n_readings)) for start in starts]


def _count(
    world: World,
    faces: tuple[SideFaces, ...],
    view: View,
    sensor: Sensor,
    windows: Windows,
) -> tuple[CountArray, CountArray]:
    """Return the empty and the object pixels of each cell of one batch."""
    seen = seen_faces(faces, world.occupied, view)
    if seen.reading.size > MANY_FACES * view.size:
        seen = without_hidden(seen, view)
    outline = trace_outline(seen, view)
    clear = sensor.clear_no_hit
    n_empty = count_pixels(
        empty_polygons(outline, seen, view, clear_no_hit=clear), windows, view
    )
    if sensor.behind_hit is BehindHit.UNSEEN:
        n_object = count_surface(outline, seen, world.occupied, windows, view)
    else:
        in_view = view_polygons(outline, view, clear_no_hit=clear)
        n_object = count_pixels(in_view, windows, view) - n_empty
    counter, is_wall = own_pixels(world.occupied, windows, view)
    n_empty[counter] += ~is_wall
    n_object[counter] += is_wall
    return n_empty, n_object


def _entries(
    counts: PixelCounts,
) -> tuple[IntArray, npt.NDArray[np.int32], FloatArray]:
    """Return the cells in view and what Eq. 4.22 says of them."""
    windows, n_empty, n_object = counts.windows, counts.n_empty, counts.n_object
    in_view = (n_empty | n_object) != 0
    sizes = np.count_nonzero(in_view.reshape(windows.first_row.size, -1), axis=1)
    counter = np.flatnonzero(in_view)
    log_odds = inverse_sensor_model(n_empty[counter], n_object[counter])
    return sizes, windows.cells()[counter], log_odds

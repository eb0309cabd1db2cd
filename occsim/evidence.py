"""The evidence log: what the readings say, before any prior."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, Progress
from occsim.errors import ParameterError
from occsim.geometry import wrap_angle
from occsim.grid import Grid
from occsim.rays.faces import SideFaces, wall_faces
from occsim.sensor import (
    EDGE_EPS,
    OWN_PIXEL_EPS_PX,
    SURFACE_DEPTH_PX,
    BehindHit,
    Sensor,
    inverse_sensor_model,
)
from occsim.trajectory import Trajectory
from occsim.world import World


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
        if not 0 <= n_readings <= self.n_readings:
            raise ParameterError(
                f"n_readings must lie in 0 to {self.n_readings}; got {n_readings!r}"
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
    """
    if (grid.height_px, grid.width_px) != world.shape:
        raise ParameterError(
            f"grid must cover the world of {world.shape} px; got "
            f"({grid.height_px}, {grid.width_px}) px"
        )
    faces = wall_faces(world.occupied)
    entries = []
    for done, pose in enumerate(trajectory.poses):
        entries.append(_reading(world, faces, pose, sensor, grid))
        if on_progress is not None:
            on_progress(done + 1, len(trajectory))
    sizes = [cells.size for cells, _ in entries]
    return EvidenceLog(
        grid=grid,
        indptr=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        cell=np.concatenate([cells for cells, _ in entries]).astype(np.int32),
        log_odds=np.concatenate([values for _, values in entries]),
    )


def _reading(
    world: World,
    faces: tuple[SideFaces, ...],
    pose: FloatArray,
    sensor: Sensor,
    grid: Grid,
) -> tuple[IntArray, FloatArray]:
    """Return the cells of one reading and their log-odds, pixel by pixel and face."""
    x, y, theta = pose
    reach = sensor.range_px + EDGE_EPS
    height, width = world.shape
    rows = np.arange(max(0, int(y - reach) - 1), min(height, int(y + reach) + 2))
    cols = np.arange(max(0, int(x - reach) - 1), min(width, int(x + reach) + 2))
    rows, cols = (a.ravel() for a in np.meshgrid(rows, cols, indexing="ij"))
    dx, dy = cols + 0.5 - x, rows + 0.5 - y
    distance, bearing = np.hypot(dx, dy), np.arctan2(dy, dx)
    own = distance <= OWN_PIXEL_EPS_PX
    off = np.abs(wrap_angle(bearing - theta))
    kept = own | ((distance <= reach) & (off <= sensor.fov_rad / 2 + EDGE_EPS))
    rows, cols, own, dx, dy = (a[kept] for a in (rows, cols, own, dx, dy))
    distance, bearing = distance[kept], bearing[kept]

    z = np.full(rows.size, np.inf)
    for side, found in enumerate(faces):
        c, s = round(np.cos(side * np.pi / 2)), round(np.sin(side * np.pi / 2))
        origin, across = (x, y) if side % 2 == 0 else (y, x)
        d = (found.position - origin) * (c + s)
        flip = 1 if side in (0, 3) else -1
        ends = np.sort([(found.start - across) * flip, (found.stop - across) * flip], 0)
        near = (d > EDGE_EPS) & (d <= reach)
        d, ends = d[near], ends[:, near]
        relative = wrap_angle(bearing - side * np.pi / 2)[:, None]
        low, high = np.arctan2(ends, d)
        hit = (relative >= low - EDGE_EPS) & (relative <= high + EDGE_EPS)
        forward = (dx * c + dy * s)[:, None] / distance[:, None].clip(1e-9)
        at = np.where(hit, d / np.where(forward > 0, forward, 1.0), np.inf)
        z = np.minimum(z, at.min(axis=1, initial=np.inf))
    first_col = np.where(dx > 0, np.floor(x), np.ceil(x) - 1).astype(np.int64)
    first_row = np.where(dy > 0, np.floor(y), np.ceil(y) - 1).astype(np.int64)
    inside = (first_col >= 0) & (first_row >= 0)
    inside &= (first_col < width) & (first_row < height)
    started = world.occupied[
        first_row.clip(0, height - 1), first_col.clip(0, width - 1)
    ]
    z[inside & started] = 0.0
    z[own] = np.where(world.occupied[rows[own], cols[own]], 0.0, np.inf)

    hit = z <= reach
    empty = np.where(hit, distance < z, sensor.clear_no_hit) | (own & ~hit)
    objects = hit & ~empty
    if sensor.behind_hit is BehindHit.UNSEEN:
        objects &= world.occupied[rows, cols]
        objects &= distance - z <= SURFACE_DEPTH_PX + EDGE_EPS
    cell = rows // grid.cell_px * grid.n_cols + cols // grid.cell_px
    n_empty = np.bincount(cell[empty], minlength=grid.n_cells)
    n_object = np.bincount(cell[objects], minlength=grid.n_cells)
    seen = np.flatnonzero(n_empty + n_object)
    return seen, inverse_sensor_model(n_empty[seen], n_object[seen])

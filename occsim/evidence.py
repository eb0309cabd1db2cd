"""The evidence log: what the readings say, before any prior."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray, IntArray, Progress
from occsim.errors import expect
from occsim.evidence_log import EvidenceLog, EvidenceTotals
from occsim.grid import Grid, require_cover
from occsim.rays.cull import without_hidden
from occsim.rays.faces import WallFaces, wall_faces
from occsim.rays.outline import trace_outline
from occsim.rays.reach import View, seen_faces
from occsim.rays.scan import (
    CountArray,
    Windows,
    count_pixels,
    seen_polygons,
    windows_of,
)
from occsim.rays.surface import count_surface, robots_on_centres
from occsim.sensor import BehindHit, Sensor, inverse_sensor_model
from occsim.trajectory import Trajectory
from occsim.world import World

COUNTERS_AT_ONCE = 1 << 19
FACES_AT_ONCE = 1 << 18
READINGS_AT_ONCE = 1 << 9
"""Limits of a batch, in cells, faces and readings: work that stays in the processor's
cache is faster, and memory does not grow with the trajectory."""

MANY_FACES = 100
"""From this many faces in view of a reading, removing hidden ones first saves time."""


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
    TypeError
        Where an argument is of another type.
    ParameterError
        Where the grid does not have the size of the world.

    See Also
    --------
    collect_totals : only sums and counts, in memory that does not grow.
    stream_evidence : the same log in parts.

    Notes
    -----
    Exact for every pixel: a pixel counts as if its own ray, from the robot through its
    centre, had been walked.

    - A ray is stopped by the first wall pixel whose square it touches, even at a single
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

    Examples
    --------
    >>> from occsim import collect_evidence, load_sample
    >>> sample = load_sample("d")
    >>> grid = sample.world.grid(5)
    >>> log = collect_evidence(sample.world, sample.trajectory, sample.sensor, grid)
    >>> log.n_readings == len(sample.trajectory)
    True
    """
    return joined(stream_evidence(world, trajectory, sensor, grid, on_progress))


def joined(parts: Iterable[EvidenceLog]) -> EvidenceLog:
    """Return parts of a log, on one grid, laid end to end."""
    parts = list(parts)
    grid = parts[0].grid
    if len(parts) == 1:
        return parts[0]
    sizes, cell, log_odds = (
        np.concatenate(arrays)
        for arrays in zip(
            *((np.diff(part.indptr), part.cell, part.log_odds) for part in parts),
            strict=True,
        )
    )
    return EvidenceLog.known_sound(grid, _ends(sizes), cell, log_odds)


def collect_totals(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    grid: Grid,
    on_progress: Progress | None = None,
) -> EvidenceTotals:
    """Return the sum and the number of each cell's readings along a trajectory.

    What `collect_evidence` gives, without the single readings: memory does not grow
    with the trajectory. `fuse`, sweeps and fronts take it in place of a log.

    Parameters
    ----------
    world, trajectory, sensor, grid, on_progress
        As in `collect_evidence`.

    Returns
    -------
    EvidenceTotals

    Raises
    ------
    TypeError, ParameterError
        As in `collect_evidence`.

    Examples
    --------
    >>> from occsim import Prior, build_prior, collect_totals, fuse, load_sample
    >>> sample = load_sample("d")
    >>> grid = sample.world.grid(5)
    >>> seen = collect_totals(sample.world, sample.trajectory, sample.sensor, grid)
    >>> fuse(seen, build_prior(sample.world.occupied, grid, Prior())).n_updates.shape
    (48, 60)
    """
    parts = stream_evidence(world, trajectory, sensor, grid, on_progress)
    sums, counts = np.zeros(grid.shape), np.zeros(grid.shape, dtype=np.int64)
    for part in parts:
        part_sums, part_counts = part.totals()
        sums += part_sums
        counts += part_counts
    return EvidenceTotals(grid, sums, counts)


def stream_evidence(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    grid: Grid,
    on_progress: Progress | None = None,
) -> Iterator[EvidenceLog]:
    """Yield the log of a trajectory in parts, each of a few consecutive readings.

    Parameters
    ----------
    world, trajectory, sensor, grid, on_progress
        As in `collect_evidence`.

    Yields
    ------
    EvidenceLog
        Laid end to end, the parts are the log of `collect_evidence`.

    Raises
    ------
    TypeError, ParameterError
        As in `collect_evidence`, at once.

    Examples
    --------
    >>> from occsim import load_sample, stream_evidence
    >>> sample = load_sample("d")
    >>> grid = sample.world.grid(5)
    >>> parts = stream_evidence(sample.world, sample.trajectory, sample.sensor, grid)
    >>> sum(part.n_readings for part in parts) == len(sample.trajectory)
    True
    """
    expect("world", world, World)
    expect("trajectory", trajectory, Trajectory)
    expect("sensor", sensor, Sensor)
    expect("grid", grid, Grid)
    require_cover(grid, world.shape)
    batches = pixel_counts(world, trajectory.poses, sensor, grid)
    return logged(batches, len(trajectory), on_progress)


def logged(
    batches: Iterable["PixelCounts"], n_readings: int, on_progress: Progress | None
) -> Iterator[EvidenceLog]:
    """Yield what Eq. 4.22 says of the pixels counted, as one log for each batch.

    Parameters
    ----------
    batches : iterable of PixelCounts
        What the readings see, one batch after another.
    n_readings : int
        How many there are in all.
    on_progress : callable, optional
        Called after each batch.

    Yields
    ------
    EvidenceLog
    """
    for counts in batches:
        yield EvidenceLog.known_sound(counts.windows.grid, *_entries(counts))
        if on_progress is not None:
            on_progress(counts.done, n_readings)


def _ends(sizes: IntArray) -> IntArray:
    indptr = np.zeros(sizes.size + 1, dtype=np.int64)
    np.cumsum(sizes, out=indptr[1:])
    return indptr


_faces: WeakKeyDictionary[World, WallFaces] = WeakKeyDictionary()


def faces_of(world: World) -> WallFaces:
    """Return the surface of a world's walls."""
    # Worlds never change, so the faces are cached for calls with one pose each.
    faces = _faces.get(world)
    if faces is None:
        faces = _faces[world] = wall_faces(world.occupied)
    return faces


class PixelCounts(NamedTuple):
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
    faces = faces_of(world)
    n_counters = most_counters(sensor.range_px, grid)
    for batch in batches_of(len(poses), n_counters, sensor, faces, world):
        view = View.of(poses[batch], sensor)
        yield _count(world, faces, view, sensor, grid, batch.stop)


def most_counters(range_px: float, grid: Grid) -> int:
    """Return an upper bound of the cells of a reading's window."""
    across = int(min(2.0 * range_px / grid.cell_px, max(grid.shape))) + 4
    return min(across, grid.n_rows) * min(across, grid.n_cols)


def batches_of(
    n_readings: int, n_counters: int, sensor: Sensor, faces: WallFaces, world: World
) -> list[slice]:
    """Return slices of readings that together stay within bounds of memory.

    `n_counters` is the number of cells, or beams, of each reading.
    """
    # On average a reading has its share of the faces in reach, by area.
    height, width = world.shape
    across = 2.0 * sensor.range_px
    share = min(across / height, 1.0) * min(across / width, 1.0)
    n_faces = int(share * faces.position.size) + 1
    size = min(
        COUNTERS_AT_ONCE // n_counters, FACES_AT_ONCE // n_faces, READINGS_AT_ONCE
    )
    size = max(size, 1)
    starts = range(0, n_readings, size)
    return [slice(start, min(start + size, n_readings)) for start in starts]


def _count(
    world: World, faces: WallFaces, view: View, sensor: Sensor, grid: Grid, done: int
) -> PixelCounts:
    """Return what one batch of readings, up to number `done`, sees."""
    seen = seen_faces(faces, world.occupied, view)
    if seen.size > MANY_FACES * view.size:
        seen = without_hidden(seen, view)
    outline = trace_outline(seen, view)
    windows = windows_of(outline.reading, view.reach * outline.ends, view, grid)
    whole = sensor.behind_hit is BehindHit.OCCUPIED
    polygons = seen_polygons(
        outline, seen, view, clear_no_hit=sensor.clear_no_hit, whole=whole
    )
    counts = count_pixels(polygons, windows, view)
    n_empty = counts[0]
    if whole:
        n_object = counts[1] - n_empty
    else:
        n_object = count_surface(outline, seen, world.occupied, windows, view)
    # A pixel whose centre is the robot is in view whatever the heading. It has no
    # bearing: it is object if it is wall, and empty otherwise.
    reading, row, col = robots_on_centres(grid, view)
    if reading.size:
        counter = windows.pixel_counters(reading, row, col)
        is_wall = world.occupied[row, col]
        n_empty[counter] += ~is_wall
        n_object[counter] += is_wall
    return PixelCounts(done, windows, n_empty, n_object)


def _entries(
    counts: PixelCounts,
) -> tuple[IntArray, npt.NDArray[np.int32], FloatArray]:
    """Return where readings end, the cells in view and what Eq. 4.22 says of them."""
    windows, n_empty, n_object = counts.windows, counts.n_empty, counts.n_object
    counter = (n_empty | n_object).nonzero()[0]
    n_readings = windows.first_row.size
    bounds = np.arange(n_readings + 1) * (windows.size // n_readings)
    log_odds = inverse_sensor_model(n_empty[counter], n_object[counter])
    return counter.searchsorted(bounds), windows.cells()[counter], log_odds

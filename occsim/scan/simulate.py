"""Simulated scans: the exact range along each beam."""

from collections.abc import Iterator

import numpy as np

from occsim._types import FloatArray
from occsim.errors import expect, whole_number
from occsim.evidence import batches_of, faces_of
from occsim.geometry import wrap_angle
from occsim.rays.outline import NO_FACE, trace_outline
from occsim.rays.reach import SIDE_COS, SIDE_SIN, View, seen_faces
from occsim.scan.log import ScanLog
from occsim.scan.noise import (
    ScanNoise,
    estimated_poses,
    noisy_ranges,
    without_glass,
)
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory
from occsim.world import World

MAX_BEAMS = 100_000
"""Most beams of a simulated scan."""

MAX_RANGES = 50_000_000
"""Most ranges of all scans together: 400 MB."""


def simulate_scans(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    n_beams: int,
    noise: ScanNoise | None = None,
    rng: np.random.Generator | None = None,
) -> ScanLog:
    """Return the scans that a range finder would take along a trajectory.

    Parameters
    ----------
    world : World
        What it sees.
    trajectory : Trajectory
        S poses, one scan each.
    sensor : Sensor
        Its reach and field of view.
    n_beams : int
        Beams of each scan, 1 to `MAX_BEAMS`, and `MAX_RANGES` in all. They point at the
        middles of equal sectors of the field of view.
    noise : ScanNoise, optional
        Errors of ranges and poses; none by default.
    rng : numpy.random.Generator, optional
        Draws the errors; needed with `noise`.

    Returns
    -------
    ScanLog
        Ranges are taken at the true poses, and entered at the estimated ones. Infinite
        where a beam meets nothing within reach.

    Raises
    ------
    TypeError
        Where an argument is of another type, or there is noise without a generator.
    ParameterError
        Where the number of beams lies outside its domain.

    Notes
    -----
    A beam is a ray of no width, stopped by the first wall pixel whose square it
    touches, as in `collect_evidence`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Sensor, Trajectory, World, simulate_scans
    >>> world = World(np.arange(60).reshape(1, 60) == 30)  # one wall pixel, at 30
    >>> robot = Trajectory([[10.5, 0.5, 0.0]])
    >>> simulate_scans(world, robot, Sensor(range_px=40), n_beams=3).ranges_px
    array([[ inf, 19.5,  inf]])
    """
    expect("world", world, World)
    expect("trajectory", trajectory, Trajectory)
    expect("sensor", sensor, Sensor)
    most_beams = max(min(MAX_BEAMS, MAX_RANGES // len(trajectory)), 1)
    n_beams = whole_number("n_beams", n_beams, 1, most_beams)
    bearings = ((np.arange(n_beams) + 0.5) / n_beams - 0.5) * sensor.fov_rad
    poses, most = trajectory.poses, sensor.range_px
    if noise is None:
        return ScanLog(poses, bearings, _exact(world, poses, sensor, bearings), most)
    expect("noise", noise, ScanNoise)
    expect("rng", rng, np.random.Generator)
    assert rng is not None  # for the type checker
    # One generator for each kind of error: none shifts what the others draw.
    for_glass, for_ranges, for_poses = rng.spawn(3)
    seen = without_glass(world, noise, rng=for_glass)
    ranges = _exact(seen, poses, sensor, bearings)
    ranges = noisy_ranges(ranges, most, noise, rng=for_ranges)
    poses = estimated_poses(poses, noise, rng=for_poses)
    return ScanLog(poses, bearings, ranges, most)


def _exact(
    world: World, poses: FloatArray, sensor: Sensor, bearings_rad: FloatArray
) -> FloatArray:
    return np.concatenate([*_exact_ranges(world, poses, sensor, bearings_rad)])


def _exact_ranges(
    world: World, poses: FloatArray, sensor: Sensor, bearings_rad: FloatArray
) -> Iterator[FloatArray]:
    """Yield the ranges of batches of scans, (N, B)."""
    faces, n_beams = faces_of(world), bearings_rad.size
    for batch in batches_of(len(poses), n_beams, sensor, faces, world):
        view = View.of(poses[batch], sensor)
        seen = seen_faces(faces, world.occupied, view)
        outline = trace_outline(seen, view)
        bearing = wrap_angle(poses[batch, 2])[:, None] + bearings_rad
        relative = wrap_angle(bearing - view.theta[:, None])
        relative = np.minimum(np.maximum(relative, -view.half), view.half)
        # Bearings lie within pi of 0, so 8 keeps the readings apart.
        at = 8.0 * np.arange(view.size)[:, None] + relative
        starts = 8.0 * outline.reading + outline.begin
        face = outline.face[starts.searchsorted(at, "right") - 1]
        hit = np.flatnonzero(face != NO_FACE)
        met = seen.take(face.ravel()[hit])
        along = bearing.ravel()[hit]
        ahead = np.cos(along) * SIDE_COS[met.side] + np.sin(along) * SIDE_SIN[met.side]
        z = met.depth / np.maximum(ahead, met.ahead_min())
        ranges = np.full(face.shape, np.inf)
        ranges.ravel()[hit] = np.where(z <= view.reach, z, np.inf)
        # What is met within the tolerance of the reach is met at it.
        yield np.where(ranges < np.inf, np.minimum(ranges, sensor.range_px), np.inf)

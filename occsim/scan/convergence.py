"""How near a number of beams comes to the exact reading."""

from collections.abc import Sequence

import numpy as np

from occsim._types import FloatArray
from occsim.errors import ParameterError, expect
from occsim.evidence import collect_totals
from occsim.evidence_log import EvidenceTotals
from occsim.grid import Grid
from occsim.scan.evidence import evidence_from_scans
from occsim.scan.simulate import simulate_scans
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory
from occsim.world import World


def beam_distances(
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    grid: Grid,
    n_beams: Sequence[int],
) -> FloatArray:
    """Return how far scans of some numbers of beams are from exact readings.

    Parameters
    ----------
    world, trajectory, sensor, grid
        As in `collect_evidence`.
    n_beams : sequence of int
        Numbers of beams, K of them, as in `simulate_scans`; without noise.

    Returns
    -------
    ndarray of float64, shape (K,)
        Sum over the cells of the distance between the sums of log-odds of scans and of
        exact readings, for each update of a cell by an exact reading, nats. NaN where
        these update no cell.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where a number of beams lies outside its domain, or there is none.

    Notes
    -----
    A pixel is read wrongly where a sector's beam meets another wall than the pixel's
    own ray. Sectors at the rim are ``range_px * fov_rad / n_beams`` wide, so the
    distance falls to nothing as beams grow.

    Examples
    --------
    >>> from occsim import Sensor, Trajectory, beam_distances, load_sample
    >>> sample = load_sample("d")
    >>> few = Trajectory(sample.trajectory.poses[::40])
    >>> all_round, grid = Sensor(range_px=100, fov_rad=6), sample.world.grid(3)
    >>> far = beam_distances(sample.world, few, all_round, grid, [10, 30, 90])
    >>> bool(far[0] > far[1] > far[2])
    True
    """
    expect("n_beams", n_beams, Sequence)
    if not len(n_beams):
        raise ParameterError("n_beams must hold one number or more; got none")
    exact = collect_totals(world, trajectory, sensor, grid)
    return np.array(
        [_distance(exact, world, trajectory, sensor, one) for one in n_beams]
    )


def _distance(
    exact: EvidenceTotals,
    world: World,
    trajectory: Trajectory,
    sensor: Sensor,
    n_beams: int,
) -> float:
    scans = simulate_scans(world, trajectory, sensor, n_beams)
    sums, _ = evidence_from_scans(scans, sensor, exact.grid).totals()
    n_updates = exact.counts.sum()
    return float(np.abs(sums - exact.sums).sum() / n_updates) if n_updates else np.nan

"""Trajectories in a building: drawn at random, or along a sketch."""

from collections.abc import Sequence

import numpy as np

from occsim.tour import random_poses
from occsim.trajectory import HeadingMode, Trajectory, resample
from occsim.world import World


def random_trajectory(world: World, n: int, seed: int) -> Trajectory:
    """Return random poses in free space, the same ones for the same seed.

    Parameters
    ----------
    world : World
        What the robot stands in.
    n : int
        Poses, 1 or more.
    seed : int
        Seed of the random choice, 0 or more.

    Returns
    -------
    Trajectory
        With the four cardinal headings.

    Raises
    ------
    TrajectoryError
        Where there is no free space.
    """
    return random_poses(world, n, rng=np.random.default_rng(seed))


def sketched_trajectory(
    sketch: Sequence[tuple[float, float, bool]],
    step_px: float,
    heading_mode: HeadingMode = HeadingMode.ALONG,
    turn: bool = False,
) -> Trajectory:
    """Return the readings along a sketch.

    Parameters
    ----------
    sketch : sequence of (float, float, bool)
        As in `Building`; at least one corner.
    step_px : float
        Between readings, px.
    heading_mode : HeadingMode, default HeadingMode.ALONG
        Where the robot looks.
    turn : bool, default False
        Whether it turns on the spot at waypoints set by hand.

    Returns
    -------
    Trajectory

    Raises
    ------
    TrajectoryError, ParameterError
        As `occsim.resample` does.
    """
    return resample(
        [(x, y) for x, y, _ in sketch],
        step_px,
        heading_mode=heading_mode,
        turn_at_waypoints=[turn and is_waypoint for *_, is_waypoint in sketch],
    )

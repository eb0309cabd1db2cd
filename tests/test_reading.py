"""One reading at pixel level."""

import math

import numpy as np
import pytest

from occsim import (
    BehindHit,
    Grid,
    ParameterError,
    Sensor,
    Trajectory,
    TrajectoryError,
    collect_evidence,
    lens_world,
    load_sample,
    one_reading,
)
from tests.oracles import classify, in_view

LENS_PX = (32, 48)


@pytest.mark.parametrize("behind_hit", BehindHit)
@pytest.mark.parametrize("clear_no_hit", [True, False])
@pytest.mark.parametrize("seed", range(5))
def test_every_pixel_is_what_its_own_ray_says(behind_hit, clear_no_hit, seed):
    rng = np.random.default_rng(seed)
    world = lens_world()
    pose = *(rng.uniform(0, 1, 2) * LENS_PX[::-1]), rng.uniform(-4, 4)
    sensor = Sensor(
        range_px=rng.uniform(5, 40),
        fov_rad=rng.uniform(0.2, 2 * math.pi),
        behind_hit=behind_hit,
        clear_no_hit=clear_no_hit,
    )
    seen = one_reading(world, pose, sensor, world.grid(4))
    occupied = world.occupied.tolist()
    for row, col in np.ndindex(LENS_PX):
        said = classify(occupied, pose, row, col, sensor)
        assert bool(seen.empty[row, col]) == (said == "empty")
        assert bool(seen.object[row, col]) == (said == "object")
        centre = col + 0.5 - pose[0], row + 0.5 - pose[1]
        assert bool(seen.in_view[row, col]) == in_view(*centre, pose[2], sensor)


@pytest.mark.parametrize("name", ["b", "d"])
def test_it_is_the_reading_of_the_evidence_log(name):
    sample = load_sample(name)
    world, sensor, grid = sample.world, sample.sensor, sample.world.grid(3)
    for pose in sample.trajectory.poses[::60]:
        log = collect_evidence(world, Trajectory(poses=pose[None]), sensor, grid)
        seen = one_reading(world, pose, sensor, grid)
        np.testing.assert_array_equal(np.flatnonzero(seen.is_updated), log.cell)
        np.testing.assert_array_equal(seen.log_odds.ravel()[log.cell], log.log_odds)


def test_a_cell_with_as_many_empty_as_object_pixels_says_nothing():
    """Exercise 1 of the lessons: robot (8.5, 28.5), 0 degrees, row 6, column 9."""
    world = lens_world()
    sensor = Sensor(range_px=36.0, fov_rad=math.radians(30))
    seen = one_reading(world, (8.5, 28.5, 0.0), sensor, world.grid(4))
    assert (seen.n_empty[6, 9], seen.n_object[6, 9]) == (8, 8)
    assert seen.is_updated[6, 9]
    assert seen.log_odds[6, 9] == 0.0


def test_what_hides_behind_the_pillar_is_object_only_as_printed():
    """Exercise 2: robot (14.5, 6.5), 0 degrees; 234 pixels, 189 of them floor; 7."""
    world = lens_world()
    sensor = Sensor(range_px=36.0, fov_rad=math.radians(30))
    seen = one_reading(world, (14.5, 6.5, 0.0), sensor, world.grid(4))
    assert seen.object.sum() == 234
    assert (seen.object & ~world.occupied).sum() == 189
    unseen = Sensor(range_px=36.0, fov_rad=math.radians(30), behind_hit="unseen")
    seen = one_reading(world, (14.5, 6.5, 0.0), unseen, world.grid(4))
    assert seen.object.sum() == 7
    assert not (seen.object & ~world.occupied).any()


def test_a_grid_of_another_size_is_refused():
    with pytest.raises(ParameterError, match="grid must cover the world"):
        one_reading(
            lens_world(), (1, 1, 0), Sensor(), Grid(height_px=5, width_px=5, cell_px=1)
        )


@pytest.mark.parametrize("pose", [(1.0, 2.0), (1.0, 2.0, math.nan), (1.0, 2.0, 0.0, 1)])
def test_a_pose_is_three_finite_numbers(pose):
    world = lens_world()
    with pytest.raises((ParameterError, TrajectoryError)):
        one_reading(world, pose, Sensor(), world.grid(4))

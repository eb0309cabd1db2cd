import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    ParameterError,
    Sensor,
    Trajectory,
    World,
    collect_evidence,
)
from occsim.sensor import inverse_sensor_model, most_cells_in_view


@pytest.mark.parametrize(
    ("n_empty", "n_object", "odds"),
    [
        (9, 0, 9),  # entirely empty: 0.9
        (0, 9, 1 / 9),  # entirely object: 0.1
        (1, 1, 1),  # half: 0.5
        (3, 1, 3),  # the empty share: 0.75
        (1, 3, 1 / 3),
        (99, 1, 9),  # clipped to 0.9: must not count for more than entirely empty
        (1, 99, 1 / 9),
        (1, 0, 9),  # one pixel in view decides its cell
    ],
)
def test_log_odds_of_a_cell_by_its_pixels(n_empty, n_object, odds):
    np.testing.assert_allclose(
        inverse_sensor_model(n_empty, n_object), np.log(odds), atol=1e-11
    )


def test_one_count_of_object_pixels_serves_many_of_empty_ones():
    many = inverse_sensor_model([0, 3, 6], 3)
    assert many.tolist() == inverse_sensor_model([0, 3, 6], [3, 3, 3]).tolist()
    assert float(inverse_sensor_model(3, 0)) == inverse_sensor_model([3], [0])[0]


def test_arrays_keep_their_shape_and_are_not_written_to():
    n_empty = np.array([[4, 0, 2]], dtype=np.int32)
    n_object = np.array([[0, 4, 2]], dtype=np.int32)
    before = n_empty.copy(), n_object.copy()
    result = inverse_sensor_model(n_empty, n_object)
    np.testing.assert_allclose(result, [[np.log(9), -np.log(9), 0]], atol=1e-11)
    np.testing.assert_array_equal(n_empty, before[0])
    np.testing.assert_array_equal(n_object, before[1])


@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
def test_the_range_is_positive_and_finite(value):
    with pytest.raises(ParameterError, match="range_px must be above 0 and finite"):
        Sensor(range_px=value)


@pytest.mark.parametrize("value", [0.0, -0.1, 6.3, np.nan])
def test_the_field_of_view_is_at_most_a_full_turn(value):
    with pytest.raises(ParameterError, match=r"fov_rad must lie in \(0, 2 pi\]; got"):
        Sensor(fov_rad=value)


@pytest.mark.parametrize(("beyond_px", "seen"), [(5e-10, True), (2e-8, False)])
def test_the_reach_ends_within_its_tolerance(beyond_px, seen):
    """A pixel centre 10 px ahead of the robot, at the reach but for a little."""
    world = World(occupied=np.zeros((3, 20), dtype=bool))
    pose = Trajectory(poses=np.array([[0.5, 1.5, 0.0]]))
    sensor = Sensor(range_px=10.0 - beyond_px, fov_rad=0.1)
    log = collect_evidence(world, pose, sensor, world.grid(1))
    assert (1 * 20 + 10 in log.cell) == seen


@pytest.mark.parametrize(("beyond_rad", "seen"), [(5e-10, True), (2e-8, False)])
def test_the_sides_of_the_cone_end_within_their_tolerance(beyond_rad, seen):
    """A pixel centre at 45 degrees, on the side of the cone but for a little."""
    world = World(occupied=np.zeros((9, 9), dtype=bool))
    pose = Trajectory(poses=np.array([[0.5, 0.5, 0.0]]))
    sensor = Sensor(range_px=20.0, fov_rad=np.pi / 2 - 2 * beyond_rad)
    log = collect_evidence(world, pose, sensor, world.grid(1))
    assert (5 * 9 + 5 in log.cell) == seen


def test_a_full_turn_given_in_degrees_is_accepted():
    assert Sensor(fov_rad=np.radians(360.0)).fov_rad == pytest.approx(2 * np.pi)


def test_what_one_reading_says_lies_on_the_lattice_and_is_symmetric():
    n_empty, n_object = np.meshgrid(np.arange(1, 101), np.arange(1, 101))
    steps = inverse_sensor_model(n_empty, n_object) * 2**36
    np.testing.assert_array_equal(steps, np.rint(steps))
    np.testing.assert_array_equal(steps, -steps.T)


def test_what_lies_behind_a_hit_may_be_named_by_its_value():
    assert Sensor(behind_hit="unseen") == Sensor(behind_hit=BehindHit.UNSEEN)
    with pytest.raises(ParameterError, match="behind_hit must be one of BehindHit"):
        Sensor(behind_hit="UNSEEN")


@given(
    range_px=st.floats(0.5, 40.0),
    fov_rad=st.floats(0.05, 2.0 * np.pi),
    cell_px=st.integers(1, 12),
    pose=st.tuples(st.floats(0, 60), st.floats(0, 60), st.floats(-4, 4)),
)
def test_no_reading_updates_more_cells_than_the_bound(range_px, fov_rad, cell_px, pose):
    world = World(occupied=np.zeros((60, 60), dtype=bool))
    sensor = Sensor(range_px=range_px, fov_rad=fov_rad)
    grid = world.grid(cell_px)
    log = collect_evidence(world, Trajectory(poses=[pose]), sensor, grid)
    assert log.cell.size <= most_cells_in_view(sensor, grid)

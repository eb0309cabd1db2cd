import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    Grid,
    ParameterError,
    Sensor,
    Trajectory,
    World,
    collect_evidence,
)
from tests.oracles import naive_evidence


def readings(evidence):
    """Per reading a list of (cell, log-odds), as the oracle gives them."""
    bounds = zip(evidence.indptr[:-1], evidence.indptr[1:], strict=True)
    return [
        list(zip(evidence.cell[a:b].tolist(), evidence.log_odds[a:b], strict=True))
        for a, b in bounds
    ]


def assert_same_readings(evidence, expected):
    found = readings(evidence)
    assert len(found) == len(expected)
    for ours, theirs in zip(found, expected, strict=True):
        assert [cell for cell, _ in ours] == [cell for cell, _ in theirs]
        np.testing.assert_allclose(
            [value for _, value in ours], [value for _, value in theirs], atol=1e-12
        )


SIDES = st.integers(1, 14)
# Halves and wholes put the robot on pixel centres, edges and corners.
PLACES = st.one_of(
    st.integers(-4, 36).map(lambda k: k / 2),
    st.integers(-200, 1800).map(lambda k: k / 100),
)
HEADINGS = st.one_of(
    st.sampled_from([0.0, np.pi / 2, np.pi, 3 * np.pi / 2, np.pi / 4]),
    st.floats(-7, 7).map(lambda a: round(a, 3)),
)
FIELDS = st.one_of(
    st.sampled_from([np.pi / 6, np.pi / 2, np.pi, 1.5 * np.pi, 2 * np.pi]),
    st.floats(0.02, 6.28).map(lambda a: round(a, 3)),
)
SENSORS = st.builds(
    Sensor,
    range_px=st.one_of(
        st.integers(1, 40).map(lambda k: k / 2),
        st.floats(0.1, 20).map(lambda r: round(r, 2)),
    ),
    fov_rad=FIELDS,
    behind_hit=st.sampled_from(BehindHit),
    clear_no_hit=st.booleans(),
)


@st.composite
def worlds(draw):
    """Speckle of any density, or a few bars, which leave long views."""
    shape = draw(SIDES), draw(SIDES)
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    occupied = rng.random(shape) < draw(st.sampled_from([0.0, 0.03, 0.1, 0.3, 0.7, 1]))
    for _ in range(draw(st.integers(0, 2))):
        row, col = rng.integers(0, shape)
        occupied[row, col : col + rng.integers(1, 9)] = True
        occupied[row : row + rng.integers(1, 9), col] = True
    return World(occupied=occupied)


@settings(max_examples=300, deadline=None)
@given(
    world=worlds(),
    poses=st.lists(st.tuples(PLACES, PLACES, HEADINGS), min_size=1, max_size=4),
    sensor=SENSORS,
    cell_px=st.integers(1, 6),
)
@example(
    # Standing on the corner of four pixels, three of them wall.
    world=World(occupied=np.array([[True, True], [True, False]])),
    poses=[(1.0, 1.0, 0.0)],
    sensor=Sensor(range_px=3.0, fov_rad=2 * np.pi),
    cell_px=1,
)
@example(
    # A diagonal line one pixel wide is closed: the ray through its joints is stopped.
    world=World(occupied=np.eye(6, dtype=bool)[::-1]),
    poses=[(0.5, 0.5, np.pi / 4)],
    sensor=Sensor(range_px=9.0),
    cell_px=1,
)
def test_every_reading_is_that_of_the_naive_loop(world, poses, sensor, cell_px):
    trajectory = Trajectory(poses=np.array(poses))
    evidence = collect_evidence(world, trajectory, sensor, world.grid(cell_px))
    assert_same_readings(evidence, naive_evidence(world, trajectory, sensor, cell_px))


def test_a_grid_of_another_size_is_refused():
    world = World(occupied=np.zeros((4, 5), dtype=bool))
    trajectory = Trajectory(poses=np.zeros((1, 3)))
    grid = Grid(height_px=5, width_px=4, cell_px=2)
    with pytest.raises(ParameterError, match=r"world of \(4, 5\) px; got \(5, 4\) px"):
        collect_evidence(world, trajectory, Sensor(), grid)

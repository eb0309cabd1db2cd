"""Free space, tours that cover it, random poses: where the robot stands and looks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim.errors import ParameterError, TrajectoryError
from occsim.geometry import CARDINAL_HEADINGS_RAD
from occsim.sensor import Sensor
from occsim.tour import (
    clearance_map,
    coverage_tour,
    default_tour,
    free_space,
    inside_building,
    random_poses,
)
from occsim.tour.lattice import build_lattice
from occsim.tour.walk import straight_is_free
from occsim.world import World


def house(height=140, width=200, margin=20, door_px=20, wall_px=4) -> World:
    """Two rooms side by side with a door between, and a front door, in a field."""
    occupied = np.zeros((height, width), bool)
    top, left = margin, margin
    bottom, right = height - margin, width - margin
    occupied[top:bottom, left:right] = True
    occupied[top + wall_px : bottom - wall_px, left + wall_px : right - wall_px] = False
    middle, level = width // 2, height // 2
    occupied[top:bottom, middle : middle + wall_px] = True
    occupied[level : level + door_px, middle : middle + wall_px] = False
    occupied[bottom - wall_px : bottom, left + 20 : left + 20 + door_px] = False
    return World(occupied=occupied)


@st.composite
def plans(draw) -> World:
    """Random rooms: walls with doors across a rectangle, recursively."""
    occupied = np.ones((draw(st.integers(30, 90)), draw(st.integers(30, 110))), bool)
    occupied[2:-2, 2:-2] = False
    for _ in range(draw(st.integers(0, 4))):
        upright = draw(st.booleans())
        view = occupied if upright else occupied.T
        at = draw(st.integers(8, view.shape[1] - 10))
        door = draw(st.integers(3, view.shape[0] - 16))
        view[2:-2, at : at + 2] = True
        view[door : door + 12, at : at + 2] = False
    return World(occupied=occupied)


def steps(trajectory):
    """The positions of a walk, each once in a row, in pairs."""
    points = trajectory.poses[:, :2]
    moved = np.concatenate([[True], (np.diff(points, axis=0) != 0).any(axis=1)])
    return list(zip(points[moved][:-1], points[moved][1:], strict=True))


def test_clearance_is_measured_to_the_walls_near_side():
    """One row: W . . . with the wall at column 0; 2 rows of edge far away.

    Centres at 0.5, 1.5, 2.5, 3.5; the wall's near side at 1. The right edge, at 4,
    is as good as a wall.
    """
    occupied = np.zeros((9, 4), bool)
    occupied[:, 0] = True
    clearance = clearance_map(World(occupied=occupied))
    np.testing.assert_allclose(clearance[4], [0.0, 0.5, 1.5, 0.5])
    free = free_space(World(occupied=occupied), 1.5)
    assert free[4].tolist() == [False, False, True, False]
    assert free_space(World(occupied=occupied)).tolist() == (~occupied).tolist()


@given(world=plans(), clearance=st.floats(0, 6))
@settings(max_examples=20, deadline=None)
def test_free_space_keeps_its_distance_from_every_wall(world, clearance):
    """Against the distance to the nearest wall pixel, one by one.

    To a pixel's corner the clearance may be sqrt(1/2) - 1/2 = 0.208 px too much.
    """
    free = free_space(world, clearance)
    if not free.any():
        return
    rows, cols = np.argwhere(free)[:: 1 + free.sum() // 200].T
    wall_rows, wall_cols = np.nonzero(world.occupied)
    down = np.maximum(np.abs(rows[:, None] - wall_rows) - 0.5, 0)
    aside = np.maximum(np.abs(cols[:, None] - wall_cols) - 0.5, 0)
    assert (np.hypot(down, aside).min(axis=1) >= clearance - 0.208).all()


def test_inside_is_told_from_the_field_around_through_an_open_door():
    inside = inside_building(house())
    assert inside[30:110, 30:96].all()
    assert inside[30:110, 106:170].all()
    assert not inside[:15].any()
    assert not inside[:, :15].any()
    assert not inside[128:].any()


def test_cut_out_of_a_plan_is_inside_up_to_its_edge():
    """Three rooms between walls that run into the drawing's left edge."""
    occupied = np.zeros((90, 60), bool)
    occupied[[0, 1, 29, 30, 59, 60, 88, 89]] = True
    occupied[:, 58:] = True
    assert inside_building(World(occupied=occupied)).all()
    assert not inside_building(World(occupied=np.zeros((50, 50), bool))).any()


def test_lattice_links_exactly_the_free_straight_steps():
    """Oracle: every pixel of each of the four steps, one by one."""
    rng = np.random.default_rng(5)
    for step in (1, 2, 3, 5):
        free = rng.random((23, 31)) < 0.85
        lattice = build_lattice(free, step)
        expected = set()
        places = list(zip(lattice.rows.tolist(), lattice.cols.tolist(), strict=True))
        number = {place: k for k, place in enumerate(places)}
        for (row, col), k in number.items():
            for dr in (-1, 0, 1):
                for dc in (-1, 0, 1):
                    other = number.get((row + dr * step, col + dc * step))
                    line = [(row + dr * t, col + dc * t) for t in range(step + 1)]
                    if other not in (None, k) and all(free[p] for p in line):
                        expected.add((k, other))
        links = lattice.graph.tocoo()
        found = set(zip(links.row.tolist(), links.col.tolist(), strict=True))
        assert found == expected
        assert set(places) == {
            (r, c)
            for r in range(step // 2, 23, step)
            for c in range(step // 2, 31, step)
            if free[r, c]
        }


@given(world=plans(), spacing=st.floats(5, 40), clearance=st.sampled_from([0.0, 2.0]))
@settings(max_examples=40, deadline=None)
def test_coverage_tour_walks_through_free_space_and_leaves_nothing_out(
    world, spacing, clearance
):
    tour = coverage_tour(world, spacing, clearance_px=clearance)
    free = free_space(world, clearance)
    cols, rows = np.floor(tour.poses[:, :2]).astype(int).T
    assert free[rows, cols].all()
    for start, end in steps(tour):
        assert straight_is_free(free, start, end)
    # Nothing wanted is farther than the spacing, counted in steps to any of the eight
    # neighbours, unless it belongs to another part, where nobody walks.
    near = grow(rows, cols, free, max(1, round(spacing)))
    part = grow(rows, cols, free, free.size)
    wanted = free & (inside_building(world) | ~inside_building(world).any())
    assert not (wanted & part & ~near).any()


def grow(rows, cols, free, steps):
    """What is within some steps of places, through free pixels; the naive way."""
    reached = np.zeros_like(free)
    reached[rows, cols] = True
    for _ in range(steps):
        before = reached
        up_down = np.pad(reached, ((1, 1), (0, 0)))
        reached = up_down[:-2] | up_down[1:-1] | up_down[2:]
        aside = np.pad(reached, ((0, 0), (1, 1)))
        reached = (aside[:, :-2] | aside[:, 1:-1] | aside[:, 2:]) & free
        if (before == reached).all():
            break
    return reached


def test_coverage_tour_has_all_headings_at_each_position():
    tour = coverage_tour(house(), 30, headings_rad=(0.0, np.pi / 3))
    looks = {}
    for x, y, theta in tour.poses:
        looks.setdefault((x, y), set()).add(theta)
    complete = [place for place, seen in looks.items() if {0.0, np.pi / 3} <= seen]
    assert len(complete) >= 8  # 2 rooms of 76 x 92 px, 3 x 2 or more positions each
    assert {x > 102 for x, _ in complete} == {True, False}  # both rooms


def test_region_confines_the_positions():
    world = house()
    region = np.zeros(world.shape, bool)
    region[30:110, 110:170] = True
    tour = coverage_tour(world, 15, region=region)
    assert (tour.poses[:, 0] >= 110).all()


@given(
    world=plans(),
    range_px=st.floats(3, 200),
    most=st.integers(4, 120),
    fov=st.sampled_from([np.pi / 6, 2 * np.pi]),
)
@settings(max_examples=40, deadline=None)
def test_default_tour_stays_free_and_within_its_readings(world, range_px, most, fov):
    sensor = Sensor(range_px=range_px, fov_rad=fov)
    tour = default_tour(world, sensor, max_readings=most)
    assert len(tour) <= most
    cols, rows = np.floor(tour.poses[:, :2]).astype(int).T
    assert not world.occupied[rows, cols].any()
    again = default_tour(world, sensor, max_readings=most)
    assert np.array_equal(tour.poses, again.poses)


def test_default_tour_goes_through_the_doors_and_stays_indoors():
    world = house()
    tour = default_tour(world, Sensor(range_px=20))
    assert 100 < len(tour) <= 400
    for start, end in steps(tour):
        assert straight_is_free(free_space(world), start, end)
    x, y = tour.poses[:, :2].T
    assert ((x > 20) & (x < 180) & (y > 20) & (y < 122)).all()
    assert (x < 98).any()
    assert (x > 106).any()


def test_closed_rooms_are_visited_one_after_another():
    world = house(door_px=0)
    tour = default_tour(world, Sensor(range_px=20), max_readings=200)
    left = tour.poses[:, 0] < 100
    assert 60 < left.sum() < 140
    assert np.count_nonzero(np.diff(left)) == 1  # changes rooms once


def test_field_without_walls_is_toured_everywhere():
    tour = default_tour(World(occupied=np.zeros((120, 160), bool)), Sensor())
    x, y = tour.poses[:, :2].T
    assert np.ptp(x) > 100
    assert np.ptp(y) > 70


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (2, 2), (8, 8), (3, 300)])
def test_tiny_worlds_are_toured(shape):
    tour = default_tour(World(occupied=np.zeros(shape, bool)), Sensor())
    assert 1 <= len(tour) <= 400
    assert (tour.poses[:, :2] < shape[::-1]).all()


def test_world_of_wall_has_no_tour():
    wall = World(occupied=np.ones((30, 40), bool))
    with pytest.raises(TrajectoryError, match="no free space"):
        default_tour(wall, Sensor())
    with pytest.raises(TrajectoryError, match="no free space 4 px or more"):
        coverage_tour(wall, 10)
    with pytest.raises(TrajectoryError, match="no free space"):
        random_poses(wall, 5, rng=np.random.default_rng(1))


def test_parameters_are_checked():
    world = house()
    with pytest.raises(ParameterError, match="max_readings must be 4 or more; got 3"):
        default_tour(world, Sensor(), max_readings=3)
    with pytest.raises(ParameterError, match="spacing_px must be above 0"):
        coverage_tour(world, 0)
    with pytest.raises(ParameterError, match="headings_rad"):
        coverage_tour(world, 10, headings_rad=())
    with pytest.raises(ParameterError, match="clearance_px must be 0 or more"):
        free_space(world, -1)
    with pytest.raises(ParameterError, match="n must be 1 or more"):
        random_poses(world, 0, rng=np.random.default_rng(1))


@settings(deadline=None)
@given(world=plans(), seed=st.integers(0, 99), n=st.integers(1, 50))
def test_random_poses_are_free_and_repeatable(world, seed, n):
    poses = random_poses(
        world, n, rng=np.random.default_rng(seed), clearance_px=1
    ).poses
    again = random_poses(
        world, n, rng=np.random.default_rng(seed), clearance_px=1
    ).poses
    assert np.array_equal(poses, again)
    assert len(poses) == n
    cols, rows = np.floor(poses[:, :2]).astype(int).T
    assert free_space(world, 1)[rows, cols].all()
    assert set(poses[:, 2]) <= set(CARDINAL_HEADINGS_RAD)


def test_random_poses_of_any_heading_fill_the_free_space():
    world = house()
    rng = np.random.default_rng(3)
    poses = random_poses(world, 4000, rng=rng, headings_rad=None).poses
    assert len(np.unique(poses[:, 2])) == 4000
    # A tenth of the free pixels should hold a tenth of the poses, within 4 sigma.
    free = np.argwhere(free_space(world))
    tenth = free[len(free) // 10]
    share = np.mean(poses[:, 1] <= tenth[0])
    assert abs(share - 0.1) < 0.03

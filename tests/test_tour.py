"""Free space, tours of a building, random poses: where a robot stands and looks."""

import itertools

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    Grid,
    Prior,
    Region,
    Sensor,
    Trajectory,
    World,
    build_prior,
    collect_evidence,
    fuse,
    load_sample,
    score,
    truth_cells,
)
from occsim.errors import ParameterError, TrajectoryError
from occsim.geometry import CARDINAL_HEADINGS_RAD, wrap_angle
from occsim.tour import (
    clearance_map,
    default_tour,
    free_space,
    inside_building,
    random_poses,
)
from occsim.tour.lattice import build_lattice
from occsim.tour.views import Views, best_views, cell_worth, views_from
from occsim.tour.walk import corners, shortest_walk, straight_is_free


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


def boxes(height, width, rooms, gaps=(), wall_px=4) -> World:
    """Rooms (top, left, bottom, right) with walls around, then gaps cut out."""
    occupied = np.zeros((height, width), bool)
    for top, left, bottom, right in rooms:
        occupied[top:bottom, left:right] = True
    for top, left, bottom, right in rooms:
        inner = np.s_[
            top + wall_px : bottom - wall_px, left + wall_px : right - wall_px
        ]
        occupied[inner] = False
    for top, left, bottom, right in gaps:
        occupied[top:bottom, left:right] = False
    return World(occupied=occupied)


def pixels(tour):
    return tuple(np.floor(tour.poses[:, 1::-1]).astype(int).T)


def touched(tour, left_out=()):
    """Pixels (row, col) of straight steps, looked at every eighth of a pixel.

    Steps with a true value in `left_out` are not looked at.
    """
    points = [tour.poses[:, :2]]
    pairs = itertools.pairwise(tour.poses[:, :2])
    for (start, end), out in itertools.zip_longest(pairs, left_out, fillvalue=False):
        if not out:
            n = 8 * int(np.hypot(*(end - start))) + 2
            points.append(np.linspace(start, end, n))
    return tuple(np.floor(np.concatenate(points)[:, ::-1]).astype(int).T)


def parts(world):
    """Number of the part of the inside, closed off from the others, of each pixel."""
    clear = free_space(world, 1.0) & inside_building(world)
    return cv2.connectedComponents(clear.astype(np.uint8), connectivity=4)[1]


def carried(world, tour):
    """Which steps lead from one part of the building to another."""
    return np.diff(parts(world)[pixels(tour)]) != 0


def seen_share(world, tour, sensor, region):
    """Share of a region's pixels that some reading finds empty, pixel by pixel."""
    height, width = world.shape
    sensor = Sensor(
        range_px=sensor.range_px, fov_rad=sensor.fov_rad, behind_hit=BehindHit.UNSEEN
    )
    grid = Grid(height_px=height, width_px=width, cell_px=1)
    log = collect_evidence(world, tour, sensor, grid)
    seen = np.zeros(height * width, bool)
    seen[log.cell[log.log_odds > 0]] = True
    return np.mean(seen.reshape(height, width)[region])


# --- Where the robot may stand --------------------------------------------------------


def test_clearance_is_measured_to_the_walls_near_side():
    """One row: W . . . with the wall at column 0; 2 rows of edge far away.

    Centres at 0.5, 1.5, 2.5, 3.5; the wall's near side at 1. The right edge, at 4,
    is as good as a wall.
    """
    occupied = np.zeros((9, 4), bool)
    occupied[:, 0] = True
    clearance = clearance_map(World(occupied=occupied))
    np.testing.assert_array_equal(clearance[4], [0.0, 0.5, 1.5, 0.5])
    free = free_space(World(occupied=occupied), 1.5)
    assert free[4].tolist() == [False, False, True, False]
    assert free_space(World(occupied=occupied)).tolist() == (~occupied).tolist()


def test_clearance_is_the_root_of_a_whole_number_less_half_a_pixel():
    """To the last bit, so that one and the same plan gives one and the same tour."""
    clearance = clearance_map(house())
    squares = np.rint((clearance + 0.5) ** 2)
    assert np.array_equal(clearance, np.where(house().occupied, 0, squares**0.5 - 0.5))


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


def test_inside_is_told_from_the_field_around_through_open_doors():
    inside = inside_building(house())
    assert inside[30:110, 30:96].all()
    assert inside[30:110, 106:170].all()
    assert not inside[:15].any()
    assert not inside[:, :15].any()
    assert not inside[128:].any()


def test_room_with_windows_as_wide_as_four_fifths_of_it_is_inside():
    gaps = [(20, 50, 24, 130), (116, 50, 120, 130)]
    inside = inside_building(boxes(140, 200, [(20, 40, 120, 140)], gaps))
    assert inside[36:104, 46:134].all()
    assert not inside[:20].any()
    assert not inside[120:].any()


def test_alley_and_open_yard_are_outside_and_closed_court_is_inside():
    """Two houses 20 px apart; then four wings around a court, then one taken away."""
    alley = inside_building(boxes(140, 240, [(20, 20, 120, 110), (20, 130, 120, 220)]))
    assert alley[30:110, 30:100].all()
    assert not alley[:, 112:128].any()
    rooms = [(20, 20, 60, 220), (60, 20, 180, 60), (60, 180, 180, 220)]
    yard = inside_building(boxes(220, 240, rooms))
    assert yard[30:50, 30:210].all()
    assert not yard[70:, 66:174].any()
    court = inside_building(boxes(220, 240, [*rooms, (140, 60, 180, 180)]))
    assert court[70:130, 66:174].all()


def test_specks_and_lines_beside_a_building_make_no_building():
    """A dimension line and rows of specks, as bad detection leaves them."""
    occupied = np.array(house(240, 300, margin=80).occupied)
    occupied[60:62, 80:220] = True
    occupied[20:40:8, 30:250:13] = True
    occupied[200:230:9, 20:280:17] = True
    inside = inside_building(World(occupied=occupied))
    assert inside[90:150, 90:146].all()
    assert not inside[:78].any()
    assert not inside[164:].any()


def test_yard_in_view_of_two_windows_is_outside():
    """An L of two rooms; rows and columns through the windows cross in the yard."""
    rooms = [(100, 20, 200, 120), (20, 116, 200, 220)]
    windows = [(100, 40, 104, 80), (40, 116, 80, 120)]
    inside = inside_building(boxes(220, 240, rooms, windows))
    assert inside[110:190, 30:110].all()
    assert inside[30:190, 126:210].all()
    assert not inside[:98, :114].any()


def test_rooms_with_windows_on_either_side_are_inside_on_a_wide_sheet():
    """Rows through the windows of two small houses lead 900 px through the open."""
    rooms = [(20, 20, 80, 60), (20, 900, 80, 940)]
    windows = [(40, x, 52, x + 4) for x in (20, 56, 900, 936)]
    inside = inside_building(boxes(100, 960, rooms, windows))
    assert inside[27:73, 27:53].all()
    assert inside[27:73, 907:933].all()
    assert not inside[:, 64:896].any()


@pytest.mark.parametrize("turns", range(4))
def test_cut_out_of_a_plan_is_inside_up_to_its_edge(turns):
    """Three rooms between walls that run into one edge, and a field beside them."""
    occupied = np.zeros((120, 60), bool)
    occupied[[0, 1, 29, 30, 59, 60, 88, 89]] = True
    occupied[:90, 58:] = True
    turned = np.rot90(occupied, turns)
    inside = np.rot90(inside_building(World(occupied=turned)), -turns)
    assert (inside == ~occupied & (np.arange(120) < 89)[:, None]).all()


def test_everywhere_is_inside_where_walls_enclose_nothing():
    assert inside_building(World(occupied=np.zeros((50, 50), bool))).all()
    scraps = boxes(200, 200, [(10, 10, 22, 22)], wall_px=2)
    occupied = scraps.occupied.copy()
    occupied[150, 20:180] = True
    assert (inside_building(World(occupied=occupied)) == ~occupied).all()


# --- Ways -----------------------------------------------------------------------------


def test_lattice_links_exactly_the_free_straight_steps():
    """Oracle: every pixel of each step; a diagonal one also needs those beside it.

    Its cost is its length times the mean of the costs at its ends.
    """
    rng = np.random.default_rng(5)
    for step in (1, 2, 3, 5):
        free = rng.random((23, 31)) < 0.9
        cost = rng.uniform(1.0, 3.0, free.shape)
        lattice = build_lattice(free, step, cost)
        places = [
            (r, c)
            for r in range(step // 2, 23, step)
            for c in range(step // 2, 31, step)
            if free[r, c]
        ]
        assert list(zip(lattice.row, lattice.col, strict=True)) == places
        number = {place: k for k, place in enumerate(places)}
        expected = {}
        for (row, col), k in number.items():
            for dr, dc in itertools.product((-1, 0, 1), repeat=2):
                there = row + dr * step, col + dc * step
                other = number.get(there)
                line = {(row + dr * t, col + dc * t) for t in range(step + 1)}
                if dr and dc:
                    line |= {(row + dr * t, col + dc * (t + 1)) for t in range(step)}
                    line |= {(row + dr * (t + 1), col + dc * t) for t in range(step)}
                if other not in (None, k) and all(free[p] for p in line):
                    mean = 0.5 * (cost[row, col] + cost[there])
                    expected[k, other] = mean * step * np.hypot(dr, dc)
        links = lattice.graph.tocoo()
        found = dict(
            zip(zip(links.row, links.col, strict=True), links.data, strict=True)
        )
        assert found == pytest.approx(expected)


def open_floor(n, seed):
    """The lattice of an empty hall and some of its nodes."""
    free = np.ones((120, 160), bool)
    lattice = build_lattice(free, 4, np.ones(free.shape))
    rng = np.random.default_rng(seed)
    return lattice, np.sort(rng.choice(len(lattice), n, replace=False))


def lengths(lattice, nodes):
    from scipy.sparse.csgraph import dijkstra

    return dijkstra(lattice.graph, indices=nodes)[:, nodes]


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_walk_visits_all_and_no_reversal_makes_it_shorter(seed):
    """Oracle: all K (K - 1) / 2 reversals of a stretch.

    Lengths between far positions are those by way of neighbours, hence the tolerance.
    """
    lattice, positions = open_floor(40, seed)
    legs = shortest_walk(lattice, positions)
    order = [which for which, _ in legs]
    assert sorted(order) == list(range(40))
    for which, nodes in legs:
        assert nodes[-1] == positions[which]
    distance = lengths(lattice, positions)

    def length(walk):
        return sum(distance[a, b] for a, b in itertools.pairwise(walk))

    best = min(
        length([*order[:i], *order[i:j][::-1], *order[j:]])
        for i, j in itertools.combinations(range(41), 2)
    )
    assert length(order) <= 1.02 * best


def test_walk_is_a_free_way_from_node_to_linked_node(monkeypatch):
    """Also where only the ways between near positions are known beforehand."""
    lattice, positions = open_floor(90, 4)
    known = shortest_walk(lattice, positions)
    monkeypatch.setattr("occsim.tour.walk._ALL_PAIRS", 10)
    monkeypatch.setattr("occsim.tour.walk._NEAR_STEPS", 2.0)
    found = shortest_walk(lattice, positions)
    for legs in (known, found):
        way = np.concatenate([nodes for _, nodes in legs])
        step = lattice.graph[way[:-1], way[1:]]
        assert (np.asarray(step) > 0).all()
        assert {which for which, _ in legs} == set(range(90))

    def length(legs):
        way = np.concatenate([nodes for _, nodes in legs])
        return np.asarray(lattice.graph[way[:-1], way[1:]]).sum()

    assert length(found) < 1.2 * length(known)


def test_corners_keep_to_roomy_floor_where_there_is_some():
    """A way round a wall's end, and then along a slot with no room to spare.

    Roomy is all but a block of 10 x 10 px that two legs of the way go around and the
    last ten columns, where only row 0 is free.
    """
    roomy = np.ones((20, 40), bool)
    roomy[:10, 5:15] = False
    roomy[:, 30:] = False
    free = np.ones((20, 40), bool)
    free[1:, 30:] = False
    down = [(2, row) for row in range(2, 13)]
    along = [(col, 12) for col in range(3, 19)]
    up = [(18 + k, 12 - k) for k in range(1, 12)]
    slot = [(30 + k, 0) for k in range(10)]
    points = np.array([*down, *along, *up, *slot]) + 0.5
    kept = points[corners(roomy, free, points)]
    assert kept[0].tolist() == [2.5, 2.5]
    assert kept[-1].tolist() == [39.5, 0.5]
    assert len(kept) <= 7
    assert ((kept[:, 0] < 29) | (kept[:, 0] > 38)).sum() >= len(kept) - 2
    for start, end in itertools.pairwise(kept):
        assert straight_is_free(free, start, end)
        line = np.linspace(start, end, 400)
        cols, rows = np.floor(line[line[:, 0] < 30]).astype(int).T
        assert roomy[rows, cols].all()


# --- Views ----------------------------------------------------------------------------


@pytest.mark.parametrize("rule", BehindHit)
def test_views_show_what_the_evidence_says_pixel_by_pixel(rule):
    """Oracle: the evidence of each view on cells of 1 px, counted in cells of 4 px."""
    world = house(60, 80, margin=10, door_px=12)
    sensor = Sensor(range_px=18, fov_rad=0.9, behind_hit=rule)
    rng = np.random.default_rng(2)
    poses = np.column_stack(
        [rng.uniform(15, 65, 30), rng.uniform(15, 45, 30), rng.uniform(-3, 3, 30)]
    )
    views = views_from(world, poses, sensor, world.grid(4))
    fine = collect_evidence(world, Trajectory(poses=poses), sensor, world.grid(1))
    wall = world.grid(4).share(world.occupied) > 0
    for k in range(30):
        counts = {}
        for entry in range(fine.indptr[k], fine.indptr[k + 1]):
            row, col = divmod(int(fine.cell[entry]), 80)
            empty, full = counts.get((row // 4, col // 4), (0, 0))
            is_empty = fine.log_odds[entry] > 0
            counts[row // 4, col // 4] = (empty + is_empty, full + (not is_empty))
        expected = {
            row * 20 + col
            for (row, col), (empty, full) in counts.items()
            if (full > empty if wall[row, col] else empty >= 12)
        }
        found = views.cell[views.first[k] : views.first[k + 1]].tolist()
        assert sorted(found) == sorted(expected)


def test_walls_and_floor_of_the_building_are_worth_a_look():
    """Cells of 10 px of `house`: (0, 0) in the field, (2, 3) wall, (5, 5) a room."""
    world = house()
    worth = cell_worth(world, inside_building(world), world.grid(10)).reshape(14, 20)
    assert worth[0, 0] == 0.0
    assert worth[5, 5] == 1.0
    assert worth[2, 3] == 2.0


@given(data=st.data())
@settings(max_examples=60, deadline=None)
def test_chosen_view_shows_the_most_that_is_new(data):
    """Oracle: sets; each choice gains nearly the maximum of what is still unseen."""
    cells = st.sets(st.integers(0, 19), max_size=8)
    shown = data.draw(st.lists(cells, min_size=1, max_size=12))
    worth = np.array(data.draw(st.lists(st.integers(0, 3), min_size=20, max_size=20)))
    most = data.draw(st.integers(1, 6))
    first = np.cumsum([0, *map(len, shown)])
    flat = np.array([cell for view in shown for cell in sorted(view)], dtype=np.int64)
    chosen = best_views(Views(first, flat), worth.astype(float), most)
    seen = set()
    visible = sum(worth[c] for c in set().union(*shown))
    for k in chosen:
        gains = [sum(worth[c] for c in view - seen) for view in shown]
        assert k == next(v for v, g in enumerate(gains) if g >= 0.9 * max(gains))
        seen |= shown[k]
    assert 1 <= len(chosen) <= most
    if len(chosen) < most:
        assert sum(worth[c] for c in seen) >= 0.949 * visible
    if len(chosen) > 1:
        before = set().union(*(shown[k] for k in chosen[:-1]))
        assert sum(worth[c] for c in before) <= 0.951 * visible


# --- Tours ----------------------------------------------------------------------------


@given(
    world=plans(),
    range_px=st.floats(3, 200),
    most=st.integers(1, 120),
    fov=st.sampled_from([np.pi / 6, 2 * np.pi]),
)
@settings(max_examples=40, deadline=None)
def test_tour_keeps_inside_off_walls_and_within_its_readings(
    world, range_px, most, fov
):
    sensor = Sensor(range_px=range_px, fov_rad=fov)
    tour = default_tour(world, sensor, max_readings=most)
    assert 1 <= len(tour) <= most
    between = carried(world, tour)
    assert not world.occupied[touched(tour, between)].any()
    assert np.count_nonzero(between) < parts(world).max()
    assert inside_building(world)[pixels(tour)].all()
    assert set(tour.poses[:, 2]) <= set(CARDINAL_HEADINGS_RAD)
    again = default_tour(world, sensor, max_readings=most)
    assert np.array_equal(tour.poses, again.poses)


def test_tour_goes_through_the_doors_stays_indoors_and_sees_all():
    world, sensor = house(), Sensor(range_px=20)
    tour = default_tour(world, sensor)
    assert not world.occupied[touched(tour)].any()
    inside = inside_building(world)
    assert inside[pixels(tour)].all()
    assert seen_share(world, tour, sensor, inside) > 0.95
    # 160 x 100 px at 105 px2 a reading are 150 readings that do not overlap.
    assert 150 < len(tour) < 400


def test_tour_keeps_clear_of_walls_where_there_is_room():
    """A fifth of the range is 4 px, all the way; a slot of 5 px leaves 2 px."""
    tour = default_tour(house(), Sensor(range_px=20))
    assert (clearance_map(house())[touched(tour)] >= 4).all()
    slot = (60, 100, 65, 104)
    world = boxes(140, 200, [(20, 20, 120, 104), (20, 100, 120, 180)], [slot])
    tour = default_tour(world, Sensor(range_px=20))
    clearance = clearance_map(world)[pixels(tour)]
    assert np.mean(clearance >= 4) > 0.95
    assert {x > 104 for x in tour.poses[:, 0]} == {True, False}
    assert not world.occupied[touched(tour)].any()


def test_looks_from_one_place_follow_each_other():
    tour = default_tour(house(), Sensor(range_px=20))
    moved = (np.diff(tour.poses[:, :2], axis=0) != 0).any(axis=1)
    stops = tour.poses[np.concatenate([[True], moved]), :2]
    looks = np.unique(tour.poses, axis=0)
    assert len(looks) >= 0.95 * len(tour)  # but for corners passed twice
    assert len(np.unique(stops, axis=0)) >= 0.95 * len(stops)


def test_robot_turns_on_from_the_heading_it_arrives_with():
    """Of the looks at a place, the first is the nearest to the direction of arrival."""
    tour = default_tour(house(), Sensor(range_px=20))
    arrival, turned = None, 0
    for (x, y), group in itertools.groupby(
        tour.poses, key=lambda pose: tuple(pose[:2])
    ):
        looks = np.array([pose[2] for pose in group])
        if arrival is not None and len(looks) > 1:
            way = np.round(np.arctan2(y - arrival[1], x - arrival[0]) / (np.pi / 2), 6)
            # Half-way between two headings, the next one clockwise counts.
            off = np.abs(wrap_angle(looks - np.floor(way + 0.5) * np.pi / 2))
            assert off[0] == pytest.approx(off.min())
            turned += 1
        arrival = x, y
    assert turned >= 5


def test_small_house_on_a_large_sheet_is_toured_and_not_the_sheet():
    """100 x 130 px, 8 % of the sheet, with a gap of 20 px in its outer wall."""
    house_of = np.array(house(140, 170).occupied)
    occupied = np.zeros((400, 400), bool)
    occupied[200:340, 30:200] = house_of
    world = World(occupied=occupied)
    sensor = Sensor(range_px=20)
    tour = default_tour(world, sensor)
    inside = inside_building(world)
    assert np.count_nonzero(inside) < 0.08 * occupied.size
    assert inside[pixels(tour)].all()
    assert seen_share(world, tour, sensor, inside) > 0.95


def test_windows_are_no_way_out_where_a_door_leads_on():
    """Three rooms in a row, doors at the far end, windows side by side at the near."""
    rooms = [(20, 20 + 60 * k, 200, 84 + 60 * k) for k in range(3)]
    doors = [(170, 80, 190, 84), (170, 140, 190, 144)]
    windows = [(20, 30 + 60 * k, 24, 74 + 60 * k) for k in range(3)]
    world = boxes(220, 240, rooms, [*doors, *windows])
    tour = default_tour(world, Sensor(range_px=20))
    inside = inside_building(world)
    assert inside[pixels(tour)].all()
    columns = [(x - 20) // 62 for x in tour.poses[:, 0]]
    assert set(columns) == {0, 1, 2}


def test_two_storeys_are_walked_one_after_the_other():
    """Carried once, with no pose outside; and a shed of a hundredth is left out."""
    rooms = [(20, 20, 120, 110), (20, 150, 120, 240), (150, 20, 166, 36)]
    doors = [(116, 60, 120, 80), (116, 190, 120, 210), (162, 24, 166, 32)]
    world = boxes(190, 260, rooms, doors)
    sensor = Sensor(range_px=20)
    tour = default_tour(world, sensor)
    inside = inside_building(world)
    assert inside[pixels(tour)].all()
    between = carried(world, tour)
    assert np.count_nonzero(between) == 1
    assert not world.occupied[touched(tour, between)].any()
    assert np.count_nonzero(np.diff(tour.poses[:, 0] > 130)) == 1
    assert seen_share(world, tour, sensor, inside) > 0.95
    assert (tour.poses[:, 1] < 140).all()


def test_storey_without_a_way_out_is_toured_too():
    """Two houses that no door leads out of; the larger one first."""
    rooms = [(20, 20, 80, 80), (100, 20, 180, 140)]
    world = boxes(200, 160, rooms)
    sensor = Sensor(range_px=20)
    tour = default_tour(world, sensor)
    assert tour.poses[0, 1] > 100
    between = carried(world, tour)
    assert np.count_nonzero(between) == 1
    assert not world.occupied[touched(tour, between)].any()
    assert seen_share(world, tour, sensor, inside_building(world)) > 0.95


def test_closed_room_is_toured_and_closed_shaft_left_out():
    """A door is often drawn shut. The shaft of 6 x 12 px is a hundredth of it all."""
    rooms = [(20, 20, 120, 110), (20, 106, 120, 150), (40, 146, 60, 160)]
    world = boxes(140, 180, rooms, [(116, 60, 120, 80)])
    tour = default_tour(world, Sensor(range_px=20))
    between = carried(world, tour)
    assert np.count_nonzero(between) == 1
    assert not world.occupied[touched(tour, between)].any()
    assert (tour.poses[:, 0] > 110).any()
    assert (tour.poses[:, 0] < 146).all()


def test_few_readings_are_spread_over_the_building():
    """Six equal rooms on a corridor; 60 readings are a fifth of what they need."""
    rooms = [(20, 20 + 60 * k, 84, 84 + 60 * k) for k in range(6)]
    doors = [(80, 40 + 60 * k, 84, 60 + 60 * k) for k in range(6)]
    world = boxes(130, 410, [*rooms, (80, 20, 110, 384)], doors)
    sensor = Sensor(range_px=20)
    full = default_tour(world, sensor)
    few = default_tour(world, sensor, max_readings=60)
    assert len(full) > 240
    assert 50 <= len(few) <= 60
    inside = inside_building(world)
    for k in range(6):
        room = np.zeros(world.shape, bool)
        room[24:80, 24 + 60 * k : 80 + 60 * k] = True
        assert seen_share(world, few, sensor, room & inside) > 0.05
    # What each shows is new: no tenth of the sector's area is seen twice.
    sector = 0.5 * np.pi / 6 * 20**2
    shown = seen_share(world, few, sensor, ~world.occupied)
    assert shown * np.count_nonzero(~world.occupied) > 0.6 * sector * len(few)


def test_readings_that_show_as_much_lie_far_apart():
    """40 in a hall that takes 800: some in each quarter of it."""
    world = boxes(260, 260, [(10, 10, 250, 250)])
    tour = default_tour(world, Sensor(range_px=20), max_readings=40)
    quarter = 2 * (tour.poses[:, 0] > 130) + (tour.poses[:, 1] > 130)
    assert (np.bincount(quarter, minlength=4) >= 2).all()


@pytest.mark.parametrize("most", [1, 2, 3, 5, 9])
def test_tiny_number_of_readings_is_kept(most):
    tour = default_tour(house(), Sensor(range_px=20), max_readings=most)
    assert 1 <= len(tour) <= most
    assert inside_building(house())[pixels(tour)].all()


def test_sensor_that_sees_all_around_looks_once_at_each_place():
    world = house()
    sensor = Sensor(range_px=40, fov_rad=2 * np.pi)
    tour = default_tour(world, sensor)
    assert len(tour) < 40
    assert (np.diff(tour.poses[:, :2], axis=0) != 0).any(axis=1).all()
    assert seen_share(world, tour, sensor, inside_building(world)) > 0.95


def test_field_without_walls_is_toured_everywhere():
    world, sensor = World(occupied=np.zeros((120, 160), bool)), Sensor()
    tour = default_tour(world, sensor)
    # Nobody stands near the edges and looks at the strip along them: less is seen.
    assert seen_share(world, tour, sensor, ~world.occupied) > 0.9


@pytest.mark.parametrize("shape", [(1, 1), (1, 5), (2, 2), (8, 8), (3, 300)])
def test_tiny_worlds_are_toured(shape):
    tour = default_tour(World(occupied=np.zeros(shape, bool)), Sensor())
    assert 1 <= len(tour) <= 400
    assert (tour.poses[:, :2] < shape[::-1]).all()


def test_passages_of_one_pixel_are_walked_step_by_step():
    """An angled corridor 1 px wide: no straight step may cut its corner."""
    occupied = np.ones((20, 30), bool)
    occupied[10, 3:20] = False
    occupied[3:11, 19] = False
    world = World(occupied=occupied)
    tour = default_tour(world, Sensor(range_px=5))
    assert not occupied[touched(tour)].any()
    assert {3.5, 19.5} <= set(np.round(tour.poses[:, 0], 1)) or len(tour) > 4


def test_world_of_wall_has_no_tour():
    wall = World(occupied=np.ones((30, 40), bool))
    with pytest.raises(TrajectoryError, match="no free space"):
        default_tour(wall, Sensor())
    with pytest.raises(TrajectoryError, match="no free space"):
        random_poses(wall, 5, rng=np.random.default_rng(1))


@pytest.mark.parametrize(
    ("name", "least"), [("a", 0.79), ("b", 0.68), ("c", 0.65), ("d", 0.71), ("e", 0.61)]
)
def test_tour_of_a_sample_maps_it_without_a_drawing(name, least):
    """F1 over all cells of 3 px, 340 readings: a prototype's figures are the least.

    With as many as the planner wants, 95 % of the inside are seen.
    """
    sample = load_sample(name)
    tour = default_tour(sample.world, sample.sensor, max_readings=340)
    grid = sample.world.grid(3)
    log = collect_evidence(sample.world, tour, sample.sensor, grid)
    blank = build_prior(sample.world.occupied, grid, Prior.uninformative())
    scores = score(fuse(log, blank), truth_cells(sample.world, grid), Region.ALL)
    assert scores.f1 > least
    tour = default_tour(sample.world, sample.sensor)
    inside = inside_building(sample.world)
    assert seen_share(sample.world, tour, sample.sensor, inside) > 0.95


def test_parameters_are_checked():
    world = house()
    with pytest.raises(ParameterError, match="max_readings must be 1 or more; got 0"):
        default_tour(world, Sensor(), max_readings=0)
    with pytest.raises(ParameterError, match="clearance_px must be 0 or more"):
        free_space(world, -1)
    with pytest.raises(ParameterError, match="headings_rad"):
        random_poses(world, 3, rng=np.random.default_rng(1), headings_rad=())
    with pytest.raises(ParameterError, match="n must be 1 or more"):
        random_poses(world, 0, rng=np.random.default_rng(1))


# --- Random poses ---------------------------------------------------------------------


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

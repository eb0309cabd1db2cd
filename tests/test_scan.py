"""Scans: their evidence beam by beam, and the ranges that a simulated one measures."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import occsim.scan.evidence
from occsim import (
    BehindHit,
    Grid,
    ParameterError,
    Prior,
    Scan,
    ScanLog,
    Sensor,
    Trajectory,
    TrajectoryError,
    World,
    beam_distances,
    build_prior,
    collect_evidence,
    evidence_from_scans,
    fuse,
    load_sample,
    logit,
    simulate_scans,
)
from tests.oracles import first_hit, naive_scan_evidence
from tests.test_evidence import (
    HEADINGS,
    PLACES,
    SENSORS,
    assert_same_readings,
    readings,
    worlds,
)

INF, NAN = math.inf, math.nan
FREE, WALL = float(logit(0.9)), float(logit(0.1))


@st.composite
def bearings(draw):
    """Even beams over a part or all of a turn, or any ones in any order."""
    n = draw(st.integers(1, 9))
    if draw(st.booleans()):
        span = draw(st.sampled_from([0.5, np.pi / 2, np.pi, 5.0, 2 * np.pi]))
        return ((np.arange(n) + draw(st.sampled_from([0.0, 0.5]))) / n - 0.5) * span
    values = st.floats(-3.1, 3.1).map(lambda b: round(b, 2))
    return np.array(draw(st.lists(values, min_size=n, max_size=n, unique=True)))


@st.composite
def scan_logs(draw):
    pose = st.tuples(PLACES, PLACES, HEADINGS)
    poses = np.array(draw(st.lists(pose, min_size=1, max_size=4)))
    beams = draw(bearings())
    most = draw(st.sampled_from([3.0, 7.5, 12.0]))
    # Whole and half ranges put the end of a beam on pixel centres.
    value = st.one_of(
        st.integers(0, int(2 * most)).map(lambda k: k / 2),
        st.floats(0, most).map(lambda r: round(r, 2)),
        st.sampled_from([INF, NAN]),
    )
    n = poses.shape[0] * beams.size
    ranges = np.array(draw(st.lists(value, min_size=n, max_size=n)))
    return ScanLog(poses, beams, ranges.reshape(poses.shape[0], beams.size), most)


GRIDS = st.builds(
    Grid,
    height_px=st.integers(1, 15),
    width_px=st.integers(1, 15),
    cell_px=st.integers(1, 6),
)


@settings(max_examples=400, deadline=None)
@given(scan_logs(), SENSORS, GRIDS)
@example(  # one beam stands for the field of view, here all of it
    ScanLog([[4.5, 4.5, 0.3]], [0.0], [[3.0]], 9.0),
    Sensor(range_px=9, fov_rad=2 * np.pi),
    Grid(height_px=9, width_px=9, cell_px=2),
)
@example(  # first and last beam on the same bearing, as some drivers send them
    ScanLog([[4.5, 4.5, 0.0]], np.linspace(-np.pi, np.pi, 5), [[1, 2, 3, 4, 2.5]], 9.0),
    Sensor(range_px=9),
    Grid(height_px=9, width_px=9, cell_px=1),
)
def test_evidence_of_scans_is_that_of_the_naive_loop(scan_log, sensor, grid):
    evidence = evidence_from_scans(scan_log, sensor, grid)
    assert_same_readings(evidence, naive_scan_evidence(scan_log, sensor, grid))


@settings(max_examples=200, deadline=None)
@given(worlds(), st.tuples(PLACES, PLACES, HEADINGS), SENSORS, st.integers(1, 12))
def test_a_simulated_range_is_where_the_beam_first_meets_a_wall(
    world, pose, sensor, n_beams
):
    # Off the edges of pixels: what a ray that runs along one meets, rounding decides.
    x, y, theta = pose[0] + 0.00137, pose[1] + 0.00071, pose[2] + 0.00031
    log = simulate_scans(world, Trajectory([(x, y, theta)]), sensor, n_beams)
    assert log.max_range_px == sensor.range_px
    for bearing, z in zip(log.bearings_rad, log.ranges_px[0], strict=True):
        direction = math.cos(theta + bearing), math.sin(theta + bearing)
        expected = first_hit(world.occupied.tolist(), x, y, *direction)
        within = expected <= sensor.range_px + 1e-9
        assert z == pytest.approx(expected if within else INF, abs=1e-6)


def test_beams_stand_for_equal_parts_of_the_field_of_view():
    world = World(np.zeros((9, 9), dtype=bool))
    robot = Trajectory([[4.5, 4.5, 0.0]])
    log = simulate_scans(world, robot, Sensor(fov_rad=np.pi), 4)
    np.testing.assert_allclose(np.degrees(log.bearings_rad), [-67.5, -22.5, 22.5, 67.5])
    around = simulate_scans(world, robot, Sensor(fov_rad=2 * np.pi), 4)
    np.testing.assert_allclose(
        np.degrees(around.bearings_rad), [-135.0, -45.0, 45.0, 135.0]
    )


# A 5 x 5 grid of pixels, the robot on the centre of the middle one, looking right.
MIDDLE = Grid(height_px=5, width_px=5, cell_px=1)
FOUR = np.radians([-90.0, 0.0, 90.0, 180.0])


def picture(scan_log, sensor=None, grid=MIDDLE):
    """Of the first scan: "." empty, "#" object, " " nothing said."""
    sensor = sensor or Sensor(range_px=9)
    text = np.full(grid.n_cells, " ")
    for cell, value in readings(evidence_from_scans(scan_log, sensor, grid))[0]:
        text[cell] = {FREE: ".", WALL: "#"}[value]
    return ["".join(row) for row in text.reshape(grid.shape)]


def test_each_beam_stands_for_the_sector_half_way_to_its_neighbours():
    """By hand: up 1 px, right no return, down 2 px, left invalid.

    Sectors meet on the diagonals, which belong to the clockwise beam: the upper right
    diagonal to the right one, the lower right to the lower one, the lower left to the
    left one, the upper left to the upper one. A pixel at the range itself is object.
    """
    log = ScanLog([[2.5, 2.5, 0.0]], FOUR, [[1.0, INF, 2.0, NAN]], 9.0)
    assert picture(log) == [
        "####.",
        " ##..",
        "  ...",
        "  ...",
        " ####",
    ]


def test_only_the_surface_behind_a_hit_is_object_where_the_rest_is_unseen():
    """At most 1.5 px beyond the range: one pixel behind that at the range itself."""
    log = ScanLog([[0.5, 0.5, 0.0]], [0.0], [[2.0]], 9.0)
    row = Grid(height_px=1, width_px=7, cell_px=1)
    assert picture(log, Sensor(range_px=9, behind_hit="unseen"), row) == ["..##   "]
    assert picture(log, Sensor(range_px=9, behind_hit="occupied"), row) == ["..#####"]


@pytest.mark.parametrize("clear_no_hit", [True, False])
def test_a_hit_beyond_the_usable_range_clears_as_far_as_it(clear_no_hit):
    """The way to it is free, whatever a beam without return says."""
    log = ScanLog([[0.5, 0.5, 0.0]], [0.0], [[4.0]], 9.0)
    row = Grid(height_px=1, width_px=7, cell_px=1)
    sensor = Sensor(range_px=3, clear_no_hit=clear_no_hit)
    assert picture(log, sensor, row) == ["....   "]


def test_a_beam_without_return_clears_or_says_nothing():
    log = ScanLog([[0.5, 0.5, 0.0]], [0.0], [[INF]], 9.0)
    row = Grid(height_px=1, width_px=7, cell_px=1)
    assert picture(log, Sensor(range_px=3), row) == ["....   "]
    assert picture(log, Sensor(range_px=3, clear_no_hit=False), row) == [".      "]


def test_nothing_is_said_beyond_the_range_finders_own_reach():
    log = ScanLog([[0.5, 0.5, 0.0]], [0.0], [[INF]], 3.0)
    row = Grid(height_px=1, width_px=7, cell_px=1)
    assert picture(log, Sensor(range_px=20), row) == ["....   "]


def test_the_robots_own_pixel_is_empty_unless_all_beams_measure_nothing():
    for ranges, expected in (
        ([0.0, 0.0], "#"),
        ([0.0, NAN], "#"),
        ([0.0, 1.0], "."),
        ([NAN, INF], "."),
        ([NAN, NAN], " "),
    ):
        log = ScanLog([[2.5, 2.5, 0.0]], [-0.1, 0.1], [ranges], 9.0)
        assert picture(log, Sensor(clear_no_hit=False))[2][2] == expected


def test_a_scan_of_invalid_beams_is_a_reading_that_updates_nothing():
    log = ScanLog([[2.5, 2.5, 0.0]] * 2, FOUR, [[NAN] * 4, [1.0] * 4], 9.0)
    evidence = evidence_from_scans(log, Sensor(range_px=9), MIDDLE)
    assert np.diff(evidence.indptr).tolist() == [0, 25]


def test_the_order_of_beams_does_not_count():
    rng = np.random.default_rng(3)
    beams, ranges = np.linspace(-2, 2, 40), rng.uniform(1, 20, (3, 40))
    poses = [[10.2, 9.1, 0.4], [15.0, 7.5, 3.0], [3.3, 3.3, -2.0]]
    grid = Grid(height_px=20, width_px=20, cell_px=3)
    shuffled = rng.permutation(40)
    one = ScanLog(poses, beams, ranges, 20.0)
    other = ScanLog(poses, beams[shuffled], ranges[:, shuffled], 20.0)
    assert readings(evidence_from_scans(one, Sensor(), grid)) == readings(
        evidence_from_scans(other, Sensor(), grid)
    )


def test_batches_leave_no_trace(monkeypatch):
    sample = load_sample("a")
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 31)
    grid, seen = sample.world.grid(3), []
    whole = evidence_from_scans(log, sample.sensor, grid)
    monkeypatch.setattr(occsim.scan.evidence, "CROSSINGS_AT_ONCE", 1000)
    parts = evidence_from_scans(
        log, sample.sensor, grid, lambda done, total: seen.append((done, total))
    )
    for name in ("indptr", "cell", "log_odds"):
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name))
    assert len(seen) > 10
    assert seen[-1] == (log.n_scans, log.n_scans)
    assert seen == sorted(seen)


BEAMS = (30, 90, 361, 1441)


def distances_to_exact(name, behind_hit):
    """Views of 360 degrees and 100 px along the sample's trajectory, 3 px cells.

    With 30 beams a sector is 21 px wide at the rim, with 1441 not half a pixel.
    """
    sample = load_sample(name)
    sensor = Sensor(range_px=100, fov_rad=2 * np.pi, behind_hit=behind_hit)
    poses = Trajectory(sample.trajectory.poses[::6])
    return beam_distances(sample.world, poses, sensor, sample.world.grid(3), BEAMS)


def test_the_distance_to_exact_readings_is_that_of_all_cells_for_an_update():
    """By hand: one beam ahead, at the wall pixel 3 px away, stands for the whole view.

    The world is 7 x 7 px, one wall pixel at row 3, column 6; the robot at column 3.
    Cells of one pixel say 0.9 or 0.1: ln 9 or -ln 9. What the beam calls occupied and
    the exact reading free, or the reverse, is 2 ln 9 apart.
    """
    occupied = np.zeros((7, 7), dtype=bool)
    occupied[3, 6] = True
    world, grid = World(occupied), World(occupied).grid(1)
    sensor, poses = Sensor(range_px=6, fov_rad=np.pi / 2), Trajectory([[3.5, 3.5, 0.0]])
    exact = {
        cell: p for cell, p in readings(collect_evidence(world, poses, sensor, grid))[0]
    }
    log = simulate_scans(world, poses, sensor, 1)
    (one,) = readings(evidence_from_scans(log, sensor, grid))
    wrong = [cell for cell, p in one if p != exact[cell]]
    assert wrong
    expected = 2 * np.log(9) * len(wrong) / len(exact)
    found = beam_distances(world, poses, sensor, grid, [1, 1000])
    assert found == pytest.approx([expected, 0.0])


def test_a_robot_that_sees_no_cell_has_no_distance():
    world = World(np.zeros((5, 5), dtype=bool))
    far = Trajectory([[-50.0, 2.0, 0.0]])
    found = beam_distances(world, far, Sensor(range_px=3), world.grid(1), [1, 2])
    assert np.isnan(found).all()
    with pytest.raises(ParameterError, match="n_beams must hold one number or more"):
        beam_distances(world, far, Sensor(range_px=3), world.grid(1), [])


@pytest.mark.parametrize("behind_hit", BehindHit)
@pytest.mark.parametrize("name", list("abcde"))
def test_more_beams_come_ever_nearer_to_the_exact_reading(name, behind_hit):
    """Nats for each cell and reading; measured at BEAMS."""
    far = distances_to_exact(name, behind_hit)
    assert all(fewer > more for fewer, more in zip(far, far[1:], strict=False)), far
    assert far[-1] < far[0] / 12, far


def test_a_field_without_walls_is_exact_for_any_number_of_beams():
    world = World(np.zeros((40, 50), dtype=bool))
    poses = Trajectory([[20.3, 18.2, 0.7], [48.0, 2.0, -2.0]])
    grid = world.grid(4)
    for fov_rad in (0.5, np.pi, 2 * np.pi):
        sensor = Sensor(range_px=15, fov_rad=fov_rad)
        exact = readings(collect_evidence(world, poses, sensor, grid))
        for n_beams in (1, 2, 7, 361):
            log = simulate_scans(world, poses, sensor, n_beams)
            assert readings(evidence_from_scans(log, sensor, grid)) == exact


def test_the_number_of_beams_is_bounded():
    world = World(np.zeros((5, 5), dtype=bool))
    poses = Trajectory(np.zeros((50_000, 3)))
    for wrong in (0, 1.5, 1001, True):
        with pytest.raises(
            ParameterError, match="n_beams must be a whole number, 1 to"
        ):
            simulate_scans(world, poses, Sensor(), wrong)


def test_a_robot_in_a_wall_measures_nothing():
    world = World(np.ones((5, 5), dtype=bool))
    log = simulate_scans(world, Trajectory([[2.5, 2.5, 0.0]]), Sensor(), 3)
    assert log.ranges_px.tolist() == [[0.0, 0.0, 0.0]]
    evidence = evidence_from_scans(log, Sensor(), MIDDLE)
    exact = collect_evidence(world, log.trajectory, Sensor(), MIDDLE)
    assert readings(evidence) == readings(exact)


def test_maps_of_scans_and_of_exact_readings_agree_on_the_class_of_nearly_all_cells():
    sample = load_sample("d")
    grid = sample.world.grid(3)
    blank = build_prior(np.zeros(sample.world.shape, bool), grid, Prior.uninformative())
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 90)
    ours = fuse(evidence_from_scans(log, sample.sensor, grid), blank)
    exact = fuse(
        collect_evidence(sample.world, sample.trajectory, sample.sensor, grid), blank
    )
    seen = exact.n_updates > 0
    differ = (ours.log_odds < 0) != (exact.log_odds < 0)
    assert np.mean(differ[seen]) < 0.002


def test_a_log_keeps_its_own_copies_and_names_its_parts():
    ranges = np.array([[1.0, INF]])
    log = ScanLog([[1.0, 2.0, 0.0]], [0.0, 1.0], ranges, 5)
    ranges[:] = 3.0
    assert log.ranges_px.tolist() == [[1.0, INF]]
    assert not log.ranges_px.flags.writeable
    assert log.is_hit.tolist() == [[True, False]]
    assert len(log.trajectory) == 1
    assert repr(log).startswith("ScanLog(poses=float64[1, 3]")
    scan = log.scan(0)
    assert isinstance(scan, Scan)
    assert len(scan) == 2
    with pytest.raises(ParameterError, match="index must be a whole number, 0 to 0"):
        log.scan(1)


def test_hit_points_lie_where_the_beams_end():
    log = ScanLog([[1.0, 2.0, np.pi / 2]], FOUR, [[1.0, 2.0, INF, NAN]], 9.0)
    np.testing.assert_allclose(log.hit_points_px(), [[2.0, 2.0], [1.0, 4.0]])


POSE = [[0.0, 0.0, 0.0]]


@pytest.mark.parametrize(
    ("parts", "error", "sentence"),
    [
        (([], [0.0], [[1.0]], 5), TrajectoryError, "poses must have shape"),
        ((POSE, [], [[]], 5), ParameterError, "bearings_rad must be finite, of shape"),
        ((POSE, [NAN], [[1.0]], 5), ParameterError, "bearings_rad must be finite"),
        ((POSE, [[0.0]], [[1.0]], 5), ParameterError, "bearings_rad must be finite"),
        ((POSE, [0, 0], [[1, 1]], 5), ParameterError, "two are alike"),
        ((POSE, [0, 6.5], [[1, 1]], 5), ParameterError, "they span 6.5 rad"),
        ((POSE, [0.0], [[1.0, 1.0]], 5), ParameterError, r"must have shape \(1, 1\)"),
        ((POSE, [0.0], [1.0], 5), ParameterError, r"must have shape \(1, 1\)"),
        ((POSE, [0.0], [[-1.0]], 5), ParameterError, "lie in 0 to max_range_px 5"),
        ((POSE, [0.0], [[-INF]], 5), ParameterError, "got -inf"),
        ((POSE, [0.0], [[5.1]], 5), ParameterError, "got 5.1"),
        ((POSE, [0.0], [[1.0]], 0), ParameterError, "max_range_px must be above 0"),
        ((POSE, [0.0], [[1.0]], INF), ParameterError, "max_range_px must be above 0"),
        ((POSE, ["a"], [[1.0]], 5), TypeError, "bearings_rad must hold real numbers"),
        ((POSE, [0.0], [[None]], 5), TypeError, "ranges_px must hold real numbers"),
    ],
)
def test_a_log_that_fits_nothing_is_refused_in_a_sentence(parts, error, sentence):
    with pytest.raises(error, match=sentence):
        ScanLog(*parts)

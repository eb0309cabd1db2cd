"""CARMEN logs: what their lines say, and where it lies on a map."""

import math

import numpy as np
import pytest

from occsim import (
    Mapper,
    ParameterError,
    Prior,
    RobotFileError,
    Sensor,
    Trajectory,
    World,
    build_prior,
    evidence_from_scans,
    fuse,
    load_sample,
    simulate_scans,
)
from occsim.io import carmen
from occsim.io.carmen import PoseSource
from occsim.io.metric import MetricFrame, poses_to_metric


def flaser(ranges, pose=(1, 2, 0), odometry=(1, 2, 0), tail="7.5 host 7.5"):
    numbers = [len(ranges), *ranges, *pose, *odometry]
    return f"FLASER {' '.join(map(str, numbers))} {tail}\n"


def robotlaser(
    ranges, pose=(1, 2, 0), robot=(0.8, 2, 0), most=81.9, remissions=(), kind=99
):
    n = len(ranges)
    head = [kind, -math.pi / 2, math.pi, math.pi / (n - 1), most, 0.01, 0]
    parts = [*head, n, *ranges, len(remissions), *remissions]
    parts += [*pose, *robot, 0, 0, 0.5, 0.4, 1e6, 12.25]
    return f"ROBOTLASER1 {' '.join(map(str, parts))} host 0.5\n"


def loaded(*lines, **options):
    return carmen.load("".join(lines).encode(), **options)


def hits_m(log):
    """Hits in the log's own frame: x right, y up, m."""
    points = log.scan_log.hit_points_px()
    poses = np.column_stack([points, np.zeros(len(points))])
    return poses_to_metric(Trajectory(poses), log.frame)[:, :2]


def test_a_line_is_a_scan_from_right_to_left():
    """By hand: at (1, 2) facing +x, 3 beams: right 3 m, ahead 4 m, left 5 m."""
    log = loaded("# a comment\n", flaser([3, 4, 5]))
    np.testing.assert_allclose(
        sorted(hits_m(log).tolist()), [[1, -1], [1, 7], [5, 2]], atol=1e-9
    )
    assert log.times_s.tolist() == [7.5]
    assert log.odometry_m.shape == (0, 3)


def test_headings_turn_to_the_left():
    log = loaded(flaser([np.inf, 4, np.inf], pose=(1, 2, math.pi / 2)))
    np.testing.assert_allclose(hits_m(log), [[1, 6]], atol=1e-9)


def test_a_robotlaser_line_says_how_its_beams_point_and_reach():
    log = loaded(
        robotlaser([3, 4, 5, 81.9, 6], remissions=[1, 2, 3]), robotlaser([1] * 5)
    )
    first = log.scan_log.ranges_px[0, ::-1] * 0.05
    np.testing.assert_allclose(first, [3, 4, 5, np.inf, 6])
    assert log.scan_log.max_range_px == pytest.approx(81.9 / 0.05)
    bearings = np.degrees(log.scan_log.bearings_rad)
    np.testing.assert_allclose(bearings, [-90, -45, 0, 45, 90])
    assert log.times_s.tolist() == [12.25, 12.25]


@pytest.mark.parametrize(
    ("n", "first", "step"),
    [
        (180, -90, 1),
        (181, -90, 1),
        (360, -90, 0.5),
        (361, -90, 0.5),
        (400, -50, 0.25),
        (401, -50, 0.25),
        (541, -135, 0.5),
        (683, -341 * 360 / 1024, 360 / 1024),
        (769, -135, 360 / 1024),
        (1081, -135, 0.25),
        (3, -90, 90),
        (4, -90, 45),
        (1, 0, 0),
    ],
)
def test_beams_of_a_flaser_line_point_as_those_of_its_range_finder(n, first, step):
    """Steps as CARMEN (readlog.c) and gmapping (carmenconfiguration.cpp) take them."""
    log = loaded(flaser([1] * n))
    bearings = -np.degrees(log.scan_log.bearings_rad[::-1])  # to the left
    np.testing.assert_allclose(bearings, first + step * np.arange(n), atol=1e-9)


def test_what_a_sick_gives_where_nothing_returns_is_no_return():
    """An LMS writes 81.83 to 81.91 m as error codes, below the reach that it states."""
    ranges = [3, 79.9, 81.83, 81.91, 4]
    sick = loaded(robotlaser(ranges, most=81.92, kind=0))
    np.testing.assert_allclose(
        sick.scan_log.ranges_px[0, ::-1] * 0.05, [3, 79.9, np.inf, np.inf, 4]
    )
    # One that reaches less is believed, and so are others that reach as far.
    assert loaded(robotlaser([1, 2], most=8, kind=0)).scan_log.max_range_px == 160
    assert loaded(robotlaser(ranges, most=90)).scan_log.is_hit.all()


FORMS = {
    "a byte order mark": "\ufeff" + flaser([3, 4, 5]) * 2,
    "tabs": flaser([3, 4, 5]).replace(" ", "\t") * 2,
    "leading gaps": "".join(" " + flaser([3, 4, 5]) for _ in range(2)),
    "line ends of Windows": (flaser([3, 4, 5]) * 2).replace("\n", "\r\n"),
    "no end of the last line": (flaser([3, 4, 5]) * 2).rstrip(),
}


@pytest.mark.parametrize("text", FORMS.values(), ids=FORMS)
def test_lines_are_read_in_every_form_that_editors_leave(text):
    log = loaded(text)
    np.testing.assert_allclose(log.scan_log.ranges_px * 0.05, [[5, 4, 3]] * 2)
    assert log.times_s.tolist() == [7.5, 7.5]


def test_readings_at_the_greatest_range_are_no_return_and_zeros_are_invalid():
    ranges = [0, 79.9, 80, 81.83, "inf", "nan"]
    np.testing.assert_allclose(
        loaded(flaser(ranges)).scan_log.ranges_px[0, ::-1] * 0.05,
        [np.nan, 79.9, np.inf, np.inf, np.inf, np.nan],
    )
    short = loaded(flaser([0, 7.9, 8, 9, 1, 1]), max_range_m=8)
    np.testing.assert_allclose(
        short.scan_log.ranges_px[0, ::-1] * 0.05, [np.nan, 7.9, np.inf, np.inf, 1, 1]
    )
    assert short.scan_log.max_range_px == 160


def test_hits_beyond_the_usable_range_do_not_enlarge_the_map_but_clear():
    wide = loaded(flaser([1, 40, 1]))
    narrow = loaded(flaser([1, 40, 1]), usable_range_m=5)
    assert wide.width_px == pytest.approx(41 / 0.05, abs=2)
    assert narrow.width_px == pytest.approx(6 / 0.05, abs=2)
    assert narrow.sensor() == Sensor(
        range_px=100, behind_hit="unseen", clear_no_hit=False
    )
    sums, _ = evidence_from_scans(
        narrow.scan_log, narrow.sensor(), narrow.grid()
    ).totals()
    x, y, _ = narrow.scan_log.poses[0]
    ahead = sums[int(y), int(x) + 1 : int(x) + 99]
    assert (ahead > 0).all()


def test_the_scan_stands_where_the_laser_was_or_where_odometry_believes():
    lines = flaser([1, 1], pose=(1, 2, 0.5), odometry=(1.5, 2, 0.25))
    own, counted = (loaded(lines, poses=source) for source in PoseSource)
    np.testing.assert_allclose(
        poses_to_metric(own.scan_log.trajectory, own.frame), [[1, 2, 0.5]]
    )
    np.testing.assert_allclose(
        poses_to_metric(counted.scan_log.trajectory, counted.frame), [[1.5, 2, 0.25]]
    )
    robot = loaded(robotlaser([1, 1, 1]), poses="odometry")
    np.testing.assert_allclose(
        poses_to_metric(robot.scan_log.trajectory, robot.frame), [[0.8, 2, 0]]
    )


def test_odometry_is_kept_and_other_lines_are_passed_over():
    log = loaded(
        "PARAM robot_width 0.4\n",
        "ODOM 1 2 0.5 0 0 0 3.5 host 3.5\n",
        "NEFF 15\n\n",
        "FLASERS 3 nothing\n",
        "ODOM 2 3 0.25 0 0 0 4.5 host 4.5\r\n",
        flaser([1, 1]),
        robotlaser([1] * 5),
        "RLASER 1 1 0 0 0 0 0 0 0 host 0",
    )
    assert log.odometry_m.tolist() == [[1, 2, 0.5], [2, 3, 0.25]]
    assert log.scan_log.n_beams == 2


def test_the_map_lies_on_whole_pixels_around_poses_and_hits():
    log = loaded(flaser([3, 4, 5]), metres_per_px=0.1)
    assert (log.frame.origin_x_m, log.frame.origin_y_m) == pytest.approx((0.5, -1.5))
    assert (log.width_px, log.frame.height_px) == (50, 90)
    assert log.grid(4).cell_px == 4
    assert log.grid().shape == (90, 50)


def as_log(scan_log, frame):
    """A log of simulated scans, in metres with y up, beams from right to left."""
    poses = poses_to_metric(scan_log.trajectory, frame)
    ranges = np.where(scan_log.is_hit, scan_log.ranges_px * frame.metres_per_px, 81.83)
    return "".join(
        flaser(row[::-1].tolist(), pose.tolist(), pose.tolist())
        for row, pose in zip(ranges, poses, strict=True)
    )


def test_a_simulated_drive_read_from_its_log_gives_the_map_of_the_drive():
    """180 beams as a SICK's: sectors of one degree from -90 to 89."""
    sample = load_sample("d")
    world = World(sample.world.occupied)
    sensor = Sensor(range_px=60, fov_rad=np.pi)
    frame = MetricFrame(
        height_px=world.shape[0], metres_per_px=0.05, origin_x_m=-3, origin_y_m=5
    )
    poses = Trajectory(sample.trajectory.poses[::10])
    drive = simulate_scans(world, poses, sensor, 180)
    log = loaded(as_log(drive, frame))
    grid = log.grid()
    blank = build_prior(np.zeros(grid.shape, bool), grid, Prior.uninformative())
    found = fuse(evidence_from_scans(log.scan_log, log.sensor(), grid), blank)
    # The map's corner in the sample's px.
    corner = [[0.0, 0.0, 0.0]]
    x, y = poses_to_metric(Trajectory(corner), log.frame)[0, :2]
    col = round((x - frame.origin_x_m) / 0.05)
    row = round(frame.height_px - (y - frame.origin_y_m) / 0.05)
    rows, cols = np.nonzero((found.log_odds < -2) & (found.n_updates > 2))
    rows, cols = rows + row, cols + col
    inside = (rows >= 0) & (cols >= 0)
    inside &= (rows < world.shape[0]) & (cols < world.shape[1])
    walls = world.occupied[rows[inside], cols[inside]]
    # Half a degree off at 60 px is half a pixel.
    assert inside.mean() > 0.99
    assert walls.mean() > 0.9
    mapper = Mapper(grid, blank, sensor=log.sensor())
    for index, pose in enumerate(log.scan_log.poses):
        mapper.update(pose, log.scan_log.scan(index))
    np.testing.assert_array_equal(mapper.map.log_odds, found.log_odds)


GOOD = flaser([1.0] * 5)
DAMAGED = {
    "cut in the ranges": (GOOD[:20] + "\n", "line 2 is cut short: 5 numbers of ranges"),
    "cut in the pose": (
        " ".join(GOOD.split()[:8]),
        "line 2 is cut short: 3 numbers of",
    ),
    "cut in the odometry": (" ".join(GOOD.split()[:11]), "3 numbers of odometry"),
    "a word": (GOOD.replace("1.0", "one", 1), "numbers of ranges include a word"),
    "a word for the count": ("FLASER five 1 2\n", "numbers of beams include a word"),
    "no count": ("FLASER \n", "line 2 is cut short: 1 numbers of beams"),
    "no beams": ("FLASER 0 1 2 0 1 2 0\n", "must be whole, 1 to 5,000; got 0"),
    "half a beam": ("FLASER 2.5 1 1\n", "must be whole"),
    "very many beams": ("FLASER 1000000000 1\n", "must be whole, 1 to 5,000"),
    "infinitely many": ("FLASER inf 1\n", "must be finite"),
    "negative": (
        GOOD.replace("1.0", "-1.0", 1),
        "line 2: a range must not be negative",
    ),
    "a pose of nothing": (flaser([1] * 5, pose=("nan", 0, 0)), "must be finite"),
    "another range finder": (flaser([1] * 6), "the first has 5 beams, this one 6"),
    "odometry of words": ("ODOM a b c\n", "line 2 is damaged"),
    "odometry cut": ("ODOM 1 2\n", "line 2 is cut short: 3 numbers of the pose"),
    "a long line": ("FLASER 5 " + "1 " * 200_000, "line 2: a line may have 200,000 by"),
}


@pytest.mark.parametrize(("line", "sentence"), DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_line_is_named(line, sentence):
    with pytest.raises(RobotFileError, match=sentence) as refused:
        loaded(GOOD, line)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250
    assert "line 2" in str(refused.value)


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        (robotlaser([1] * 5).replace(" 5 ", " 9 ", 1), "must be whole, 0 to"),
        (robotlaser([1] * 5, most=0), "line 1: beams must lie within one turn"),
        (robotlaser([1] * 5, most="inf"), "line 1: the numbers of the range finder"),
        ("ROBOTLASER1 0 -1.57 3 9 80 0 0 5 1 1 1 1 1 0" + " 0" * 12, "within one turn"),
    ],
)
def test_a_damaged_robotlaser_line_is_named(line, sentence):
    with pytest.raises(RobotFileError, match=sentence):
        loaded(line)


def test_a_log_without_scans_is_refused():
    for content in (b"ODOM 1 2 3 0 0 0 0 host 0\n", b"\x00" * 99, b"P5 3 3 255"):
        with pytest.raises(RobotFileError, match="no line FLASER or ROBOTLASER1"):
            carmen.load(content)
    with pytest.raises(RobotFileError, match="empty"):
        carmen.load(b"")


def test_a_log_of_scans_without_poses_says_which_lines_it_has():
    raw = "RAWLASER1 0 -1.57 3.14 0.017 81.9 0.01 0 3 1 2 3 0 12.25 host 12.25\n"
    for lines in ((raw,), ("SYNC a\n", "ODOM 1 2 3 0 0 0 0 host 0\n", raw)):
        with pytest.raises(RobotFileError, match="from where; its lines .*RAWLASER1"):
            loaded("# comment\n", *lines)


def test_poses_far_apart_are_refused_before_a_map_is_made():
    far = flaser([1, 1], pose=(1e6, 1e300, 0))
    with pytest.raises(
        RobotFileError, match=r"would span .* 16,000,000 px are allowed"
    ):
        loaded(flaser([1, 1]), far)
    with pytest.raises(RobotFileError, match="at 1e-06 m a px"):
        loaded(flaser([1, 1]), metres_per_px=1e-6)


@pytest.mark.parametrize(
    ("option", "sentence"),
    [
        ({"metres_per_px": 0}, "metres_per_px must be above 0"),
        ({"max_range_m": math.nan}, "max_range_m must be above 0"),
        ({"usable_range_m": -1}, "usable_range_m must be above 0"),
        ({"poses": "gps"}, "poses must be one of PoseSource.LASER"),
    ],
)
def test_an_option_outside_its_domain_is_refused(option, sentence):
    with pytest.raises(ParameterError, match=sentence):
        loaded(GOOD, **option)

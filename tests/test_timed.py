"""Scans placed by their times on a TUM trajectory."""

import io
import math

import numpy as np
import pytest

from occsim import ParameterError, RobotFileError
from occsim.io import timed
from occsim.io.metric import poses_to_metric
from occsim.io.rigid import in_plane, poses_at
from tests.test_carmen import hits_m

HALF = math.sqrt(0.5)
TUM = b"# timestamp tx ty tz qx qy qz qw\n10 0 0 1 0 0 0 1\n12 2 0 1 0 0 1 1\n"
CSV = b"time_s,-1.5707963267948966,0,1.5707963267948966\n11,3,4,5\n"


def saved(**changed):
    arrays = {
        "times_s": np.array([11.0]),
        "bearings_rad": np.array([-np.pi / 2, 0, np.pi / 2]),
        "ranges_m": np.array([[3.0, 4.0, 5.0]]),
        "max_range_m": np.array(30.0),
    } | changed
    file = io.BytesIO()
    np.savez(file, **{name: a for name, a in arrays.items() if a is not None})
    return file.getvalue()


@pytest.mark.parametrize("scans", [CSV, saved()], ids=["csv", "npz"])
def test_a_scan_lies_half_way_between_two_poses(scans):
    """By hand: from (0, 0) facing +x to (2, 0) facing +y (a quaternion of length root
    2), so at (1, 0) facing 45 degrees up; right 3 m, ahead 4 m, left 5 m."""
    found = timed.load(TUM, scans)
    poses = poses_to_metric(found.scan_log.trajectory, found.frame)
    np.testing.assert_allclose(poses, [[1, 0, math.pi / 4]], atol=1e-9)
    np.testing.assert_allclose(
        sorted(hits_m(found).tolist()),
        [
            [1 - 5 * HALF, 5 * HALF],
            [1 + 3 * HALF, -3 * HALF],
            [1 + 4 * HALF, 4 * HALF],
        ],
        atol=1e-9,
    )
    assert (found.times_s.tolist(), found.n_left_out) == ([11.0], 0)


def test_turns_go_the_short_way_round():
    """From 170 to 190 degrees is through 180, whatever the quaternions' signs."""
    ends = [math.radians(170), math.radians(190)]
    for sign in (1, -1):
        rows = [
            [t, 0, 0, 0, 0, 0, s * math.sin(yaw / 2), s * math.cos(yaw / 2)]
            for t, yaw, s in zip((0, 1), ends, (1, sign), strict=True)
        ]
        ((_, _, heading),) = in_plane(poses_at(np.array([0.5]), rows))[0]
        assert abs(heading) == pytest.approx(math.pi)


def test_poses_may_come_in_any_order_and_twice():
    rows = np.array([[2, 4, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 0, 1.0]])
    again = np.vstack([rows, rows])
    for samples in (rows, rows[::-1], again):
        flat, _ = in_plane(poses_at(np.array([0.5, 2.0]), samples))
        np.testing.assert_allclose(flat[:, 0], [1, 4])


def test_scans_before_the_first_pose_and_after_the_last_are_left_out():
    scans = CSV + b"9,1,1,1\n13,1,1,1\n12,1,inf,nan\n"
    found = timed.load(TUM, scans)
    assert (found.times_s.tolist(), found.n_left_out) == ([11.0, 12.0], 2)
    np.testing.assert_array_equal(
        found.scan_log.ranges_px[1] * 0.05, [np.nan, np.inf, 1.0]
    )
    with pytest.raises(RobotFileError, match="must cover the scans' times; poses 10"):
        timed.load(TUM, CSV.replace(b"\n11,", b"\n99,"))


def test_a_reading_at_the_greatest_range_is_no_return():
    for scans in (CSV, saved()):
        ranges = timed.load(TUM, scans, max_range_m=4.0).scan_log.ranges_px
        np.testing.assert_allclose(ranges * 0.05, [[np.inf, np.inf, 3.0]])
    assert timed.load(TUM, saved()).scan_log.max_range_px == pytest.approx(600)
    assert timed.load(TUM, saved(), usable_range_m=2).sensor().range_px == 40


BAD_POSES = {
    "nothing": b"",
    "comments": b"# t x y\n",
    "seven columns": b"10 0 0 1 0 0 0\n",
    "a word": TUM.replace(b"12", b"noon"),
    "uneven": TUM + b"13 1\n",
    "no turn": b"10 0 0 1 0 0 0 0\n",
    "NaN": TUM.replace(b"10 0", b"10 nan"),
    "not text": b"\xff\xfe\x00",
}
BAD_SCANS = {
    "nothing": b"",
    "another header": CSV.replace(b"time_s", b"stamp"),
    "no beams": b"time_s\n11\n",
    "a word": CSV.replace(b",4", b",four"),
    "uneven": CSV + b"11.5,1,2\n",
    "more than the header": CSV.replace(b",4", b",4,4"),
    "no lines": CSV.partition(b"\n")[0],
    "no range": b"time_s,0\n11,inf\n",
    "negative": CSV.replace(b",3", b",-3"),
    "bearings alike": CSV.replace(b",0,", b",1.5707963267948966,"),
    "a bearing of nothing": CSV.replace(b",0,", b",nan,"),
    "no time": CSV.replace(b"\n11,", b"\nnan,"),
    "an array missing": saved(times_s=None),
    "two reaches": saved(max_range_m=np.ones(2)),
    "another number of times": saved(times_s=np.zeros(2)),
    "cut": saved()[:-20],
}


@pytest.mark.parametrize("content", BAD_POSES.values(), ids=BAD_POSES)
def test_a_hostile_trajectory_is_refused_in_a_sentence(content):
    with pytest.raises(RobotFileError) as refused:
        timed.load(content, CSV)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


@pytest.mark.parametrize("content", BAD_SCANS.values(), ids=BAD_SCANS)
def test_hostile_scans_are_refused_in_a_sentence(content):
    with pytest.raises(RobotFileError) as refused:
        timed.load(TUM, content)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


FORMS = {
    "byte order marks": (b"\xef\xbb\xbf" + TUM, b"\xef\xbb\xbf" + CSV),
    "line ends of Windows": (TUM.replace(b"\n", b"\r\n"), CSV.replace(b"\n", b"\r\n")),
    "comments in any language": (b"# Gr\xc3\xb6\xc3\x9fe\n" + TUM, CSV),
    "quoted titles": (TUM, CSV.replace(b"time_s", b'"time_s"')),
    "numbers of single precision": (TUM, saved(ranges_m=np.float32([[3, 4, 5]]))),
}


@pytest.mark.parametrize(("poses", "scans"), FORMS.values(), ids=FORMS)
def test_files_are_read_in_every_form_that_programs_leave(poses, scans):
    assert timed.is_timed_scans(scans)
    found = timed.load(poses, scans)
    np.testing.assert_allclose(found.scan_log.ranges_px * 0.05, [[5, 4, 3]])


@pytest.mark.parametrize(
    ("poses", "scans", "sentence"),
    [
        (TUM.replace(b"12 2", b"noon 2"), CSV, 'got "noon" in line 3 of the traj'),
        (TUM + b"\n13 1\n", CSV, "8 numbers a line are needed; got 2 in line 5"),
        (TUM, CSV + b"12,1,,2\n", 'got "" in line 3 of the scans'),
        (TUM, CSV + b"\n12,1,2\n", "4 numbers a line are needed; got 3 in line 4"),
        (TUM, CSV.replace(b",", b";"), "first line of the scans must be time_s"),
    ],
)
def test_a_damaged_line_is_named(poses, scans, sentence):
    with pytest.raises(RobotFileError, match=sentence):
        timed.load(poses, scans)


def test_too_many_lines_are_refused_before_they_are_read(monkeypatch):
    monkeypatch.setattr(timed, "MAX_POSES", 2)
    timed.load(TUM, CSV)
    with pytest.raises(RobotFileError, match="may have 2 lines"):
        timed.load(TUM + b"13 1 0 0 0 0 0 1\n", CSV)
    with pytest.raises(RobotFileError, match="may have 2 lines; got"):
        timed.load(TUM + b"\n" * 2000, CSV)


@pytest.mark.parametrize("name", ["metres_per_px", "max_range_m", "usable_range_m"])
def test_an_option_outside_its_domain_is_refused(name):
    with pytest.raises(ParameterError, match=f"{name} must be above 0"):
        timed.load(TUM, CSV, **{name: 0.0})

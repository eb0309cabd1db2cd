"""A robot's log opened and mapped: formats, bounds, and what is left out."""

import zlib

import numpy as np
import pytest

from occsim import (
    BehindHit,
    OccsimError,
    ParameterError,
    RobotFileError,
    ScanLog,
    Sensor,
    evidence_from_scans,
    load_sample,
)
from occsim.io import log_run, scans
from occsim.io.log_run import hits_drawing, map_log, open_log, tour_log
from occsim.io.replay_beams import NOTHING, REACH, pack_beams
from occsim.io.scans import metric_scans
from occsim.scan import RANGE_FINDERS

LINE = b"FLASER 3 1.0 2.0 81.83 4 5 0 4 5 0 7.5 host 7.5\n"


def many(n=40, usable_range_m=None):
    """Scans in a row, 0.1 m apart, each of three beams that end 1, 2 and 1 m ahead."""
    poses = np.zeros((n, 3))
    poses[:, 0] = 0.1 * np.arange(n)
    ranges = np.tile([1.0, 2.0, 1.0], (n, 1))
    return metric_scans(
        poses, [-0.5, 0.0, 0.5], ranges, 30.0, usable_range_m=usable_range_m
    )


def test_a_carmen_log_and_an_npz_file_open_alike():
    log = open_log(LINE)
    again = open_log(scans.dump(log.scan_log, log.frame))
    np.testing.assert_allclose(again.scan_log.ranges_px, log.scan_log.ranges_px)
    assert again.frame == log.frame


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"\x89PNG\r\n\x1a\nxx", "the log is an image"),
        (b"x,y,theta\n1,2,3\n", "no line FLASER"),
        (LINE + b"FLASER 3 1 2 what 4 5 0 4 5 0 1\n", "line 2 is damaged"),
        (b"PK\x03\x04 not an archive", "undamaged"),
        (b"#ROSBAG V2.0\n", "the bag is damaged|a ROS bag needs rosbags"),
    ],
)
def test_what_is_no_log_is_refused_in_a_sentence(data, says):
    with pytest.raises(RobotFileError, match=says):
        open_log(data)


def test_the_maximum_range_of_an_npz_file_can_be_lowered():
    data = scans.dump(*(lambda log: (log.scan_log, log.frame))(many()))
    log = open_log(data, max_range_m=1.5)
    # The middle beam, of 2 m, is no return now.
    assert np.isinf(log.scan_log.ranges_px[:, 1]).all()
    assert np.isfinite(log.scan_log.ranges_px[:, [0, 2]]).all()
    assert log.scan_log.max_range_px * log.frame.metres_per_px == pytest.approx(1.5)


def test_a_small_log_is_mapped_as_the_library_maps_it():
    log = many()
    run = map_log(log)
    assert (run.every, run.n_scans) == (1, 40)
    expected = evidence_from_scans(log.scan_log, log.sensor(), log.grid())
    np.testing.assert_array_equal(run.evidence.cell, expected.cell)
    np.testing.assert_array_equal(run.evidence.log_odds, expected.log_odds)


def test_of_a_log_with_too_many_updates_every_nth_scan_is_mapped():
    log = many()
    whole = map_log(log).evidence.cell.size
    run = map_log(log, max_entries=whole // 3)
    assert run.every in (3, 4)
    assert run.n_scans == 40
    assert run.scans.scan_log.n_scans == -(-40 // run.every)
    assert run.evidence.n_readings == run.scans.scan_log.n_scans
    assert run.evidence.cell.size <= whole // 3 * 1.1
    # The scans that are left stay where they were.
    np.testing.assert_array_equal(
        run.scans.scan_log.poses, log.scan_log.poses[:: run.every]
    )


def test_bounds_of_scans_and_of_time_leave_scans_out_too(monkeypatch):
    monkeypatch.setattr(log_run, "MAX_SCANS", 10)
    assert map_log(many()).every == 4
    monkeypatch.setattr(log_run, "MAX_SCANS", 1000)
    log = many(usable_range_m=1.0)
    # A window is the sides of 41 px, cut to the map's height.
    height, width = log.grid().shape
    window = min(41, height) * min(41, width)
    monkeypatch.setattr(log_run, "MAX_PIXELS_READ", 20 * window)
    assert map_log(log).every == 2


def test_a_map_of_too_many_cells_is_refused_before_it_is_made(monkeypatch):
    monkeypatch.setattr(log_run, "MAX_CELLS", 100)
    with pytest.raises(ParameterError, match="choose larger cells"):
        map_log(many())


def test_the_picture_of_hits_has_a_dot_at_each_believed_hit():
    log = many(n=1, usable_range_m=1.5)
    grey = hits_drawing(log).gray
    assert grey.shape == log.grid().shape
    rows, cols = np.nonzero(grey < 255)
    # Two beams of 1 m; that of 2 m lies beyond the usable range.
    x, y, _ = log.scan_log.poses[0]
    ends = [(y + 20 * np.sin(a), x + 20 * np.cos(a)) for a in (-0.5, 0.5)]
    assert sorted(zip(rows, cols, strict=True)) == sorted(
        (int(row), int(col)) for row, col in ends
    )


@pytest.mark.parametrize("name", "abcde")
def test_calling_all_behind_a_hit_occupied_declares_more_wall(name):
    """The sentence of the page, on the logs that it opens with."""
    log = open_log(tour_log(load_sample(name), RANGE_FINDERS["urg-04lx"], 1))

    def n_walls(behind_hit):
        sums, _ = map_log(log, behind_hit=behind_hit).evidence.totals()
        return (sums < -1e-9).sum()

    assert n_walls(BehindHit.OCCUPIED) > n_walls(BehindHit.UNSEEN)


def test_a_simulated_log_is_the_same_each_time_and_lies_on_the_buildings_metres():
    sample = load_sample("c")
    data = tour_log(sample, RANGE_FINDERS["urg-04lx"], 1)
    assert tour_log(sample, RANGE_FINDERS["urg-04lx"], 1) == data
    log = open_log(data, metres_per_px=sample.metres_per_px)
    moved = log.scan_log.poses[:, :2] - sample.trajectory.poses[:, :2]
    np.testing.assert_allclose(moved, moved[:1].repeat(len(moved), axis=0), atol=1e-6)


def beams_of(packed):
    content = zlib.decompress(packed)
    n, b = np.frombuffer(content, "<u4", 2, 4)
    reach = np.frombuffer(content, "<f8", 1, 16)[0]
    bearings = np.frombuffer(content, "<f4", b, 24)
    return reach, bearings, np.frombuffer(content, "<u2", n * b, 24 + 4 * b)


def test_beams_are_packed_as_shares_of_the_reach():
    log = ScanLog(
        [[5, 5, 0.0]],
        [-0.2, -0.1, 0.0, 0.1, 0.2],
        [[0.0, 5.0, 10.0, np.inf, np.nan]],
        80.0,
    )
    sensor = Sensor(range_px=10.0, clear_no_hit=False)
    reach, bearings, levels = beams_of(pack_beams(log, sensor))
    assert reach == 10.0
    np.testing.assert_allclose(bearings, log.bearings_rad, atol=1e-7)
    # 5 of 10 px is half of 65534; at the reach it passes; the rest says nothing.
    assert levels.tolist() == [0, 32767, REACH, NOTHING, NOTHING]
    clears = beams_of(pack_beams(log, Sensor(range_px=10.0)))[2]
    assert clears.tolist() == [0, 32767, REACH, REACH, NOTHING]


def test_a_log_must_be_a_log():
    with pytest.raises(TypeError):
        map_log("log")
    with pytest.raises(OccsimError):
        map_log(many(), cell_px=0)

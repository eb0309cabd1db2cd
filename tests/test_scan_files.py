"""Scans in metres with y up, from arrays and from NPZ files."""

import io

import numpy as np
import pytest

from occsim import (
    ParameterError,
    RobotFileError,
    ScanLog,
    Sensor,
    TrajectoryError,
    evidence_from_scans,
    load_sample,
    simulate_scans,
)
from occsim.io.metric import MetricFrame, poses_to_metric
from occsim.io.scans import dump, load, metric_scans

INF, NAN = np.inf, np.nan


def test_bearings_and_headings_turn_to_the_left():
    """By hand: at (1, 2) facing up; a beam to the left ends at (-2, 2)."""
    found = metric_scans([[1, 2, np.pi / 2]], [0.0, np.pi / 2], [[INF, 3.0]], 9.0)
    hits = np.column_stack([found.scan_log.hit_points_px(), [0.0]])
    np.testing.assert_allclose(
        poses_to_metric(ScanLog(hits, [0.0], [[1.0]], 2.0).trajectory, found.frame)[
            :, :2
        ],
        [[-2, 2]],
        atol=1e-9,
    )
    # Half a metre around pose and hit.
    assert (found.frame.origin_x_m, found.frame.origin_y_m) == (-2.5, 1.5)
    # One pixel more where rounding puts an end just beyond a pixel's edge.
    assert found.frame.height_px in (20, 21)
    assert found.width_px in (80, 81)


def test_scans_come_back_from_a_file_on_a_map_of_their_own():
    """The same readings, on a map that begins elsewhere on whole pixels."""
    sample = load_sample("d")
    height = sample.world.shape[0]
    frame = MetricFrame(height_px=height, metres_per_px=0.05, origin_y_m=2.0)
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 31)
    found = load(dump(log, frame))
    np.testing.assert_allclose(found.scan_log.ranges_px, log.ranges_px, rtol=1e-12)
    np.testing.assert_allclose(found.scan_log.bearings_rad, log.bearings_rad)
    np.testing.assert_allclose(
        poses_to_metric(found.scan_log.trajectory, found.frame),
        poses_to_metric(log.trajectory, frame),
        atol=1e-9,
    )
    counts = [
        evidence_from_scans(scans, Sensor(range_px=20), grid).totals()[1].sum()
        for scans, grid in (
            (log, sample.world.grid(1)),
            (found.scan_log, found.grid()),
        )
    ]
    assert counts[1] == pytest.approx(counts[0], rel=0.2)  # beyond the sample's edge


def test_a_file_may_lie_in_a_folder(tmp_path):
    frame = MetricFrame(height_px=9, metres_per_px=0.05)
    log = ScanLog([[4.0, 5.0, 0.1]], [0.0, 0.2], [[3.0, NAN]], 20.0)
    path = tmp_path / "scans.npz"
    path.write_bytes(dump(log, frame))
    found = load(path, metres_per_px=0.1, usable_range_m=0.5)
    np.testing.assert_allclose(found.scan_log.ranges_px, [[1.5, NAN]])
    assert found.sensor().range_px == 5.0


def saved(**changed):
    arrays = {
        "poses_m": np.zeros((2, 3)),
        "bearings_rad": np.array([0.0, 0.5]),
        "ranges_m": np.ones((2, 2)),
        "max_range_m": np.array(5.0),
    } | changed
    file = io.BytesIO()
    np.savez(file, **{name: a for name, a in arrays.items() if a is not None})
    return file.getvalue()


HOSTILE = {
    "nothing": b"",
    "no archive": b"PK",
    "cut": saved()[:-30],
    "an array missing": saved(ranges_m=None),
    "another array": saved(more=np.zeros(2)),
    "complex numbers": saved(ranges_m=np.ones((2, 2), complex)),
    "truth values": saved(ranges_m=np.ones((2, 2), bool)),
    "text": saved(ranges_m=np.full((2, 2), "1")),
    "objects": saved(ranges_m=np.full((2, 2), None)),
    "another number of scans": saved(poses_m=np.zeros((3, 3))),
    "another number of beams": saved(bearings_rad=np.zeros(3)),
    "poses of nothing": saved(poses_m=np.full((2, 3), NAN)),
    "poses far apart": saved(poses_m=np.array([[0, 0, 0], [1e300, 1e300, 0]])),
    "negative": saved(ranges_m=-np.ones((2, 2))),
    "beyond the reach": saved(ranges_m=np.full((2, 2), 6.0)),
    "two reaches": saved(max_range_m=np.ones(2)),
    "no reach": saved(max_range_m=np.array(0.0)),
}


@pytest.mark.parametrize("kind", [np.float32, ">f8", np.int64, np.uint8, np.float16])
def test_real_numbers_of_any_type_and_order_are_taken(kind):
    """As programs write them that know nothing of this one."""
    ranges = np.array([[1, 2], [3, 4]])
    found = load(saved(ranges_m=np.asfortranarray(ranges, kind)), metres_per_px=0.5)
    np.testing.assert_array_equal(found.scan_log.ranges_px, [[4, 2], [8, 6]])


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (saved(ranges_m=None), "ranges_m.npy is missing"),
        (saved(more=np.zeros(2)), "got 'more.npy'"),
        (saved(ranges_m=np.full((2, 2), None)), "ranges_m.npy must be of type float64"),
        (saved(ranges_m=1000 * np.ones((2, 2))), "ranges_m must lie in 0 to max_range"),
        (saved(poses_m=np.zeros((2, 2))), "x_m, y_m, theta_rad"),
    ],
)
def test_a_refusal_says_what_is_wrong_with_which_array(content, sentence):
    with pytest.raises(RobotFileError, match=sentence):
        load(content)


def test_the_small_file_is_good():
    assert load(saved()).scan_log.n_scans == 2


@pytest.mark.parametrize("content", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_file_is_refused_in_a_sentence(content):
    with pytest.raises(RobotFileError) as refused:
        load(content)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


def test_arrays_and_options_outside_their_domain_are_refused():
    with pytest.raises(TrajectoryError, match="poses must have shape"):
        metric_scans([[1, 2]], [0.0], [[1.0]], 5)
    with pytest.raises(ParameterError, match="the map would span"):
        metric_scans([[0, 0, 0], [1e6, 1e6, 0]], [0.0], [[1.0], [1.0]], 5)
    for name in ("metres_per_px", "usable_range_m"):
        with pytest.raises(ParameterError, match=f"{name} must be above 0"):
            load(saved(), **{name: 0.0})
    with pytest.raises(TypeError, match="frame must be of type MetricFrame"):
        dump(ScanLog([[0, 0, 0]], [0.0], [[1.0]], 5), 0.05)

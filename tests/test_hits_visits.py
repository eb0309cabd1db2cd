"""gmapping's cell model, and the range finders of real robots."""

import math

import numpy as np
import pytest
from hypothesis import given, settings

import occsim.scan.cell_model
from occsim import (
    RANGE_FINDERS,
    BehindHit,
    Grid,
    ParameterError,
    ScanLog,
    Sensor,
    evidence_from_scans,
    hits_visits,
    load_sample,
    score,
    simulate_scans,
    truth_cells,
)
from occsim.io.replay import unpack_log
from occsim.io.replay_beams import HIT, pack_counts
from occsim.scan import beam_counts
from tests.test_evidence import SENSORS
from tests.test_scan import GRIDS, scan_logs


def naive_counts(log, sensor, grid):
    """registerScan of gmapping, beam by beam: Bresenham in Python's whole numbers."""
    hits, visits = np.zeros(grid.shape, int), np.zeros(grid.shape, int)
    usable = min(sensor.range_px, log.max_range_px)

    def count(counts, row, col):
        if 0 <= row < grid.n_rows and 0 <= col < grid.n_cols:
            counts[row, col] += 1

    for (x, y, theta), ranges in zip(log.poses, log.ranges_px, strict=True):
        for bearing, z in zip(log.bearings_rad, ranges, strict=True):
            if math.isnan(z) or z == 0 or (z == math.inf and not sensor.clear_no_hit):
                continue
            d = min(z + 1e-9, usable)  # on a cell's edge: in the one behind it
            row, col = math.floor(y / grid.cell_px), math.floor(x / grid.cell_px)
            down = math.floor((y + d * np.sin(theta + bearing)) / grid.cell_px) - row
            right = math.floor((x + d * np.cos(theta + bearing)) / grid.cell_px) - col
            n = max(abs(down), abs(right))
            for k in range(n):
                off = [
                    (2 * k * abs(way) + n) // (2 * n) * (1 if way > 0 else -1)
                    for way in (down, right)
                ]
                count(visits, row + off[0], col + off[1])
            if z < usable:
                count(hits, row + down, col + right)
                count(visits, row + down, col + right)
    return hits, visits


@settings(max_examples=150, deadline=None)
@given(scan_logs(), SENSORS, GRIDS)
def test_hits_and_visits_are_those_of_the_naive_loop(log, sensor, grid):
    found = hits_visits(log, sensor, grid)
    hits, visits = naive_counts(log, sensor, grid)
    np.testing.assert_array_equal(found.hits, hits)
    np.testing.assert_array_equal(found.visits, visits)


ROW = Grid(height_px=1, width_px=6, cell_px=1)


def along_a_row(ranges, **sensor):
    log = ScanLog([[0.5, 0.5, 0.0]] * len(ranges), [0.0], [[z] for z in ranges], 20.0)
    return hits_visits(log, Sensor(**sensor), ROW)


def test_a_beam_passes_cells_and_ends_in_one():
    found = along_a_row([3.0])
    assert found.hits.tolist() == [[0, 0, 0, 1, 0, 0]]
    assert found.visits.tolist() == [[1, 1, 1, 1, 0, 0]]
    share = found.occupied_share[0]
    assert share[:4].tolist() == [0, 0, 0, 1]
    assert np.isnan(share[4:]).all()


def test_a_hit_beyond_the_usable_range_ends_nowhere():
    found = along_a_row([9.0, 2.0], range_px=2.0)
    assert not found.hits.any()
    assert found.visits.tolist() == [[2, 2, 0, 0, 0, 0]]


def test_beams_without_return_are_skipped_or_pass():
    assert not along_a_row([np.inf], clear_no_hit=False).visits.any()
    assert along_a_row([np.inf], range_px=3.0).visits.tolist() == [[1, 1, 1, 0, 0, 0]]
    assert not along_a_row([np.nan, 0.0]).visits.any()


def test_a_cell_is_occupied_above_a_quarter_of_hits():
    """Ranges 2 once, 4 three times: cell 2 has 1 of 4, not above; cell 4 3 of 3."""
    found = along_a_row([2.0, 4.0, 4.0, 4.0])
    assert found.is_occupied().tolist() == [[False, False, False, False, True, False]]
    assert found.is_occupied(0.2)[0, 2]
    declared = found.declared()
    assert declared.p_free.round(2).tolist() == [[0.9, 0.9, 0.9, 0.9, 0.1, 0.5]]
    assert declared.n_updates.tolist() == [[4, 4, 4, 3, 3, 0]]
    for bad in (-0.1, 1.0, "much"):
        with pytest.raises(ParameterError, match="threshold must"):
            found.is_occupied(bad)


def test_batches_leave_no_trace(monkeypatch):
    sample = load_sample("a")
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 31)
    grid = sample.world.grid(3)
    whole = hits_visits(log, sample.sensor, grid)
    monkeypatch.setattr(occsim.scan.cell_model, "CELLS_AT_ONCE", 500)
    parts = hits_visits(log, sample.sensor, grid)
    np.testing.assert_array_equal(parts.hits, whole.hits)
    np.testing.assert_array_equal(parts.visits, whole.visits)


def test_far_ends_stay_whole_numbers():
    log = ScanLog([[1e300, -1e300, 0.0]], [0.0], [[1e300]], 1e301)
    assert not hits_visits(log, Sensor(range_px=1e301), ROW).visits.any()


def test_the_model_finds_most_walls_that_beams_meet():
    sample = load_sample("d")
    grid = sample.world.grid(3)
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 61)
    found = hits_visits(log, sample.sensor, grid).declared()
    scores = score(found, truth_cells(sample.world, grid))
    assert scores.precision > 0.9
    assert scores.recall > 0.9


@pytest.mark.parametrize("name", RANGE_FINDERS)
def test_a_range_finder_simulates_and_maps(name):
    finder = RANGE_FINDERS[name]
    sample = load_sample("d")
    sensor, noise = finder.sensor(0.05), finder.noise(0.05)
    assert sensor.range_px == finder.max_range_m / 0.05
    assert sensor.behind_hit is BehindHit.UNSEEN
    assert finder.sensor(0.1, "occupied").behind_hit is BehindHit.OCCUPIED
    log = simulate_scans(
        sample.world,
        sample.trajectory,
        sensor,
        finder.n_beams,
        noise,
        np.random.default_rng(0),
    )
    grid = sample.world.grid(3)
    _, counts = evidence_from_scans(log, sensor, grid).totals()
    assert counts.any()
    assert 0 <= finder.min_range_m < finder.max_range_m
    assert len(finder.source) > 40
    values = {name: getattr(finder, name) for name in finder.not_stated}
    assert values.get("min_range_m", 0.0) == 0.0
    with pytest.raises(ParameterError, match="metres_per_px must be above 0"):
        finder.sensor(0)


@pytest.mark.parametrize(
    ("name", "step_deg", "at_m", "sigma_m"),
    [
        ("kinect", 57 / 640, 4.0, 0.0258),  # Nguyen et al.
        ("urg-04lx", 0.352, 4.095, 0.041),  # 1 % of 4.095 m
        ("utm-30lx", 0.25, 10.0, 0.010),
        ("utm-30lx", 0.25, 30.0, 0.030),
        ("lms200", 0.5, 8.0, 0.005),
        ("rplidar-a1", 1.0, 12.0, 0.12),  # 1 % of 12 m
        ("hc-sr04", 15.0, 4.0, 0.003),
    ],
)
def test_a_range_finder_has_the_figures_of_its_sheet(name, step_deg, at_m, sigma_m):
    finder = RANGE_FINDERS[name]
    step = math.degrees(finder.fov_rad) / finder.n_beams
    assert step == pytest.approx(step_deg, rel=0.01)
    noise = finder.noise(metres_per_px=1.0)
    assert noise.sigma_px(at_m) == pytest.approx(sigma_m, rel=0.02)


def test_three_range_finders_come_with_a_standard_deviation():
    """Nguyen et al. measured the Kinect's, SICK states one, a dealer quotes Hokuyo's
    bounds for the UTM-30LX; the rest is accuracy."""
    stated = {
        k for k, one in RANGE_FINDERS.items() if "sigma_0_m" not in one.not_stated
    }
    assert stated == {"kinect", "lms200", "utm-30lx"}


def test_counts_of_scans_add_up_to_those_of_the_log():
    sample = load_sample("c")
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 30)
    grid = sample.world.grid(3)
    counts = beam_counts(log, sample.sensor, grid)
    whole = hits_visits(log, sample.sensor, grid)
    for name in ("hits", "visits"):
        added = np.zeros(grid.n_cells, dtype=np.int64)
        np.add.at(added, counts.cell, getattr(counts, name))
        np.testing.assert_array_equal(added.reshape(grid.shape), getattr(whole, name))
    # And each scan's are those of a log of it alone.
    for s in (0, 17, log.n_scans - 1):
        one = ScanLog(
            log.poses[s : s + 1],
            log.bearings_rad,
            log.ranges_px[s : s + 1],
            log.max_range_px,
        )
        alone = hits_visits(one, sample.sensor, grid)
        part = slice(*counts.indptr[s : s + 2])
        cells = counts.cell[part]
        assert (np.diff(cells) > 0).all()
        np.testing.assert_array_equal(cells, np.flatnonzero(alone.visits))
        np.testing.assert_array_equal(counts.hits[part], alone.hits.ravel()[cells])


def test_counts_reach_the_player_as_exact_numbers():
    sample = load_sample("d")
    log = simulate_scans(sample.world, sample.trajectory, sample.sensor, 30)
    grid = sample.world.grid(3)
    counts = beam_counts(log, sample.sensor, grid)
    truth = np.zeros(grid.shape, dtype=bool)
    packed = pack_counts(counts, truth=truth, trajectory=sample.trajectory)
    read, _ = unpack_log(packed)
    visits, hits = np.floor(read.log_odds), read.log_odds % 1.0 / HIT
    np.testing.assert_array_equal(visits, counts.visits)
    np.testing.assert_array_equal(hits, counts.hits)
    np.testing.assert_array_equal(read.cell, counts.cell)
    # What the player adds up declares the cells that the library declares.
    differences = 0.25 * visits - hits
    sums = np.bincount(read.cell, differences, minlength=grid.n_cells)
    whole = hits_visits(log, sample.sensor, grid)
    np.testing.assert_array_equal(sums.reshape(grid.shape) < 0, whole.is_occupied())


def test_a_scan_that_sees_nothing_has_no_counts():
    log = ScanLog([[0.5, 0.5, 0.0]], [0.0], [[np.nan]], 20.0)
    counts = beam_counts(log, Sensor(), Grid(height_px=1, width_px=5, cell_px=1))
    assert counts.indptr.tolist() == [0, 0]
    assert counts.cell.size == 0

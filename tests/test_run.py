"""A mapping run whose prior is made from other walls than the building's."""

from dataclasses import replace

import numpy as np
import pytest

from occsim import (
    DrawingFlaws,
    MappingRun,
    MapSettings,
    ParameterError,
    Prior,
    ScanNoise,
    ScanSettings,
    evidence_from_scans,
    flawed_mask,
    load_sample,
    prior_drawing,
    simulate_scans,
)

C = load_sample("c")


def run_of(building):
    return MappingRun(building, MapSettings(sensor=building.sensor))


def test_other_walls_change_the_prior_and_share_readings_and_truth():
    run = run_of(C)
    thin = flawed_mask(C.wall_mask, DrawingFlaws(thickness_px=-2))
    other = run.with_prior_mask(thin)
    assert other.evidence is run.evidence
    assert other.truth_cells is run.truth_cells
    assert (other.wall_cells <= run.wall_cells).all()
    assert other.wall_cells.sum() < run.wall_cells.sum()
    blank = Prior.uninformative()
    assert other.scores(blank) == run.scores(blank)
    assert other.scores(Prior()) != run.scores(Prior())
    again = other.with_prior_mask(None)
    np.testing.assert_array_equal(again.wall_cells, run.wall_cells)


def test_a_run_with_its_own_walls_stays_itself_with_all_that_was_computed():
    run = run_of(C)
    assert run.with_prior_mask(None) is run


def test_surfaces_and_fronts_are_those_of_the_other_walls():
    run = run_of(C)
    run.surface(), run.front()
    other = run.with_prior_mask(prior_drawing(C, "d"))
    fresh = MappingRun(C, run.settings, prior_mask=prior_drawing(C, "d"))
    np.testing.assert_array_equal(other.sweep().tp, fresh.sweep().tp)
    assert (other.sweep().tp != run.sweep().tp).any()
    np.testing.assert_array_equal(other.front().recall, fresh.front().recall)


def test_a_mask_of_another_size_or_type_is_refused():
    with pytest.raises(ParameterError, match="prior_mask must be bool of shape"):
        MappingRun(C, prior_mask=load_sample("a").wall_mask)
    with pytest.raises(TypeError, match="prior_mask must be an array of bool"):
        run_of(C).with_prior_mask(np.zeros(C.drawing.shape))


# ---- readings beam by beam -----------------------------------------------------


def scan_run(name="c", **scan):
    sample = load_sample(name)
    settings = MapSettings(sensor=sample.sensor, scan=ScanSettings(**scan))
    return MappingRun(sample, settings)


def test_by_default_the_readings_are_exact():
    sample = load_sample("c")
    run = MappingRun(sample, MapSettings(sensor=sample.sensor))
    assert run.scan_log is None


def test_with_beams_the_readings_are_those_of_scans():
    run = scan_run(n_beams=9)
    building, sensor = run.building, run.settings.sensor
    scan_log = simulate_scans(building.world, building.trajectory, sensor, 9)
    expected = evidence_from_scans(scan_log, sensor, run.grid)
    np.testing.assert_array_equal(run.evidence.cell, expected.cell)
    np.testing.assert_array_equal(run.evidence.log_odds, expected.log_odds)


def test_errors_are_those_of_the_seed_in_the_scale_of_the_building():
    # The scale of the settings' own noise is another on purpose.
    noise = ScanNoise(metres_per_px=1.0, sigma_0_m=0.1, position_sigma_m=0.05)
    run = scan_run(n_beams=9, noise=noise, seed=7)
    building = run.building
    own = replace(noise, metres_per_px=building.metres_per_px)
    expected = simulate_scans(
        building.world,
        building.trajectory,
        run.settings.sensor,
        9,
        own,
        np.random.default_rng(7),
    )
    np.testing.assert_array_equal(run.scan_log.ranges_px, expected.ranges_px)
    np.testing.assert_array_equal(run.scan_log.poses, expected.poses)
    other = scan_run(n_beams=9, noise=noise, seed=8).scan_log
    assert not np.array_equal(other.ranges_px, expected.ranges_px)


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ({"n_beams": 0}, ParameterError),
        ({"n_beams": 5, "seed": -1}, ParameterError),
        ({"n_beams": 5, "noise": 0.1}, TypeError),
    ],
)
def test_scan_settings_outside_their_domain_are_refused(values, error):
    with pytest.raises(error):
        ScanSettings(**values)
    with pytest.raises(TypeError):
        MapSettings(scan=9)

"""A mapping run whose prior is made from other walls than the building's."""

import numpy as np
import pytest

from occsim import (
    DrawingFlaws,
    MappingRun,
    MapSettings,
    ParameterError,
    Prior,
    flawed_mask,
    load_sample,
    prior_drawing,
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

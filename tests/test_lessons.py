"""The statements of the pages hold for the drawings that they show."""

import pytest

from occsim import MappingRun, MapSettings, Prior, UpdateRule, load_sample, sample_names

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR


@pytest.fixture(scope="module", params=sample_names())
def run(request):
    """A reference drawing, mapped as the page "Build a map" opens it."""
    sample = load_sample(request.param)
    return MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))


def test_build_a_map_says_that_recall_falls_where_the_drawing_is_counted_once(run):
    """ "Set p_wall to 1 ... It falls"."""
    assert run.scores(Prior(p_wall=1.0), ONCE).recall < run.scores(Prior(), ONCE).recall


def test_build_a_map_says_that_recall_rises_where_the_prior_is_taken_off(run):
    """ "Now choose Take it off at every reading: recall rises"."""
    free = Prior(p_wall=1.0)
    assert run.scores(free, SUBTRACT).recall > run.scores(Prior(), SUBTRACT).recall
    assert run.scores(free, SUBTRACT).recall > run.scores(free, ONCE).recall


def test_build_a_map_says_that_free_space_ends_as_occupied_then(run):
    """ "... and so does a part of the free space"."""
    free = Prior(p_wall=1.0)
    assert run.scores(free, SUBTRACT).fp > run.scores(free, ONCE).fp


def test_the_drawing_helps_where_it_is_counted_once_and_harms_where_it_is_taken_off(
    run,
):
    """The README and the decisions: why PRIOR_ONCE is the default."""
    blank = run.scores(Prior.uninformative()).f2
    assert run.scores(Prior(), ONCE).f2 > blank > run.scores(Prior(), SUBTRACT).f2

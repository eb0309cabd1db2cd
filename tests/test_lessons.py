"""The statements of the pages hold for the drawings that they show."""

import numpy as np
import pytest

from occsim import (
    MappingRun,
    MapSettings,
    Prior,
    Region,
    UpdateRule,
    load_sample,
    sample_names,
)
from occsim.logodds import is_occupied

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR


@pytest.fixture(scope="module", params=sample_names())
def run(request):
    """A reference drawing, mapped as the page "Build a map" opens it."""
    sample = load_sample(request.param)
    return MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))


BLANK = Prior.uninformative()


def test_build_a_map_says_that_without_a_drawing_fewer_walls_are_found(run):
    """ "Fewer, on all five reference drawings"."""
    assert run.scores(BLANK).recall < run.scores(Prior(), ONCE).recall


def test_build_a_map_says_that_the_missed_walls_lie_across_an_edge(run):
    """ "The wall cells that it misses lie across an edge"."""
    final = run.map(BLANK)
    missed = run.truth_cells & ~is_occupied(final.log_odds) & (final.n_updates > 0)
    share = run.grid.share(run.building.world.occupied)
    assert missed.any()
    assert ((share[missed] > 0.0) & (share[missed] < 1.0)).all()


def test_build_a_map_says_that_nothing_is_found_where_nobody_looked(run):
    """ "Where the robot has not looked, a map without a drawing finds no wall"."""
    unseen = run.scores(BLANK, region=Region.UNEXPLORED)
    assert unseen.tp == 0
    assert unseen.fn > 0


def test_the_drawing_helps_where_it_is_counted_once_and_harms_where_it_is_taken_off(
    run,
):
    """The README and the decisions: why PRIOR_ONCE is the default."""
    blank = run.scores(BLANK).f2
    assert run.scores(Prior(), ONCE).f2 > blank > run.scores(Prior(), SUBTRACT).f2


def test_two_maps_says_that_more_walls_are_found_with_the_drawing_than_without(run):
    """ "With the right drawing counted once, the robot finds more of the walls"."""
    assert run.scores(Prior(), ONCE).tp > run.scores(BLANK).tp


def test_two_maps_says_that_fewer_are_found_where_the_drawing_is_taken_off(run):
    """ "It finds fewer walls than a robot without a drawing, on all five"."""
    assert run.scores(Prior(), SUBTRACT).tp < run.scores(BLANK).tp


def test_two_maps_says_that_counting_once_is_right_nine_times_in_ten(run):
    """ "Where the two rules judge a looked-at cell differently"."""
    once, subtract = (run.map(Prior(), rule) for rule in (ONCE, SUBTRACT))
    walls = [is_occupied(final.log_odds) for final in (once, subtract)]
    differ = (walls[0] != walls[1]) & (once.n_updates > 0)
    assert (walls[0] == run.truth_cells)[differ].mean() >= 0.9
    assert differ.sum() > 100


def test_two_maps_says_what_the_first_two_looks_leave_of_the_drawing(run):
    """ "Taken off at the first look, the drawing is gone; at the second, its opposite
    is there": l = S, then S - l_0, beside S and S + l_0 of the drawing counted once."""
    subtract, blank = run.map(Prior(), SUBTRACT), run.map(BLANK)
    prior = run.prior_map(Prior()).log_odds
    for k, times in ((1, 0), (2, -1)):
        at = subtract.n_updates == k
        assert at.any()
        change = subtract.log_odds[at] - blank.log_odds[at]
        np.testing.assert_allclose(change, times * prior[at], atol=1e-9)

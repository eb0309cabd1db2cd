"""The statements of the pages hold for the drawings that they show."""

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

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
    prior_drawing,
    sample_names,
)
from occsim.logodds import is_occupied
from pages._ui import compute, home, outcomes, state
from pages._ui.columns import HOME_COLUMNS, HOME_SAMPLE

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR


@pytest.fixture(scope="module", params=sample_names())
def run(request):
    """A reference drawing, mapped as the page "Build a map" opens it."""
    sample = load_sample(request.param)
    return MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))


BLANK = Prior.uninformative()


def test_without_a_drawing_fewer_walls_are_found(run):
    """Lesson 4: what the drawing adds, on all five reference drawings."""
    assert run.scores(BLANK).recall < run.scores(Prior(), ONCE).recall


def test_lesson_3_says_that_the_missed_walls_lie_across_an_edge(run):
    """ "The walls that the robot looks at and misses lie across an edge"."""
    final = run.map(BLANK)
    missed = run.truth_cells & ~is_occupied(final.log_odds) & (final.n_updates > 0)
    share = run.grid.share(run.building.world.occupied)
    assert missed.any()
    assert ((share[missed] > 0.0) & (share[missed] < 1.0)).all()


def test_lesson_4_says_that_only_the_drawing_speaks_where_nobody_looked(run):
    """ "Where nobody has looked, only the drawing says anything"."""
    unseen = run.scores(BLANK, region=Region.UNEXPLORED)
    assert unseen.tp == 0
    assert unseen.fn > 0


def test_the_drawing_helps_where_it_is_counted_once_and_harms_where_it_is_taken_off(
    run,
):
    """The README and the decisions: why PRIOR_ONCE is the default."""
    blank = run.scores(BLANK).f2
    assert run.scores(Prior(), ONCE).f2 > blank > run.scores(Prior(), SUBTRACT).f2


def test_more_walls_are_found_with_the_drawing_than_without(run):
    """Lesson 4, counted once."""
    assert run.scores(Prior(), ONCE).tp > run.scores(BLANK).tp


def test_fewer_are_found_where_the_drawing_is_taken_off(run):
    """Lesson 5: fewer walls than a robot without a drawing finds."""
    assert run.scores(Prior(), SUBTRACT).tp < run.scores(BLANK).tp


def test_where_the_rules_differ_counting_once_is_right_nine_times_in_ten(run):
    """Lesson 5: where the two rules judge a looked-at cell differently."""
    once, subtract = (run.map(Prior(), rule) for rule in (ONCE, SUBTRACT))
    walls = [is_occupied(final.log_odds) for final in (once, subtract)]
    differ = (walls[0] != walls[1]) & (once.n_updates > 0)
    assert (walls[0] == run.truth_cells)[differ].mean() >= 0.9
    assert differ.sum() > 100


def test_lesson_5_says_what_the_first_two_looks_leave_of_the_drawing(run):
    """The guide: "removes the drawing at the first look and adds its opposite at the
    second": l = S, then S - l_0, beside S and S + l_0 of the drawing counted once."""
    subtract, blank = run.map(Prior(), SUBTRACT), run.map(BLANK)
    prior = run.prior_map(Prior()).log_odds
    for k, times in ((1, 0), (2, -1)):
        at = subtract.n_updates == k
        assert at.any()
        change = subtract.log_odds[at] - blank.log_odds[at]
        np.testing.assert_allclose(change, times * prior[at], atol=1e-9)


# --- Home -----------------------------------------------------------------------------


def with_other_drawings(run):
    """The run with the mirrored drawing, and those of other buildings of its size."""
    for drawing in compute.prior_drawings(run.building):
        if drawing.value not in ("own", "empty"):
            yield run.with_prior_mask(prior_drawing(run.building, drawing.value))


def test_home_says_that_the_robot_finds_out_where_it_looks(run):
    """ "Where the robot looks, it finds out": of the looked-at cells in which another
    building's drawing errs, most are right in the end."""
    for wrong in with_other_drawings(run):
        final = wrong.map(Prior())
        erred = (wrong.wall_cells != run.truth_cells) & (final.n_updates > 0)
        now_right = is_occupied(final.log_odds) == run.truth_cells
        assert now_right[erred].mean() > 0.7


def test_home_says_that_the_drawing_is_believed_where_nobody_looked(run):
    """ "Where it does not look, it believes the drawing"."""
    for wrong in with_other_drawings(run):
        final = wrong.map(Prior())
        unseen = final.n_updates == 0
        declared = is_occupied(final.log_odds)
        np.testing.assert_array_equal(declared[unseen], wrong.wall_cells[unseen])


def test_home_says_that_the_wrong_drawing_beats_the_right_one_if_counted_again(run):
    """ "The wrong drawing now beats the right one": on every reference drawing, with
    every other drawing of its size; counted once it never does."""
    for wrong in with_other_drawings(run):
        assert run.scores(Prior(), ONCE).f2 > wrong.scores(Prior(), ONCE).f2
        assert run.scores(Prior(), SUBTRACT).f2 < wrong.scores(Prior(), SUBTRACT).f2


HOME_COUNTS = {
    "none": (572, 817, 1, 0, 442, 0),
    "own": (768, 817, 1, 439, 442, 6),
    "other": (544, 817, 2, 143, 442, 594),
}
"""Looked at: found, of, false; not looked at: the same. None and another's are those of
the lesson's design, computed with release 0.1; its own had 769, 8 and 442, 19 then: the
detection of walls took stairs for walls. Its own follow the detection of today."""
HOME_F2 = {"none": (74.5, 74.5), "own": (95.1, 63.6), "other": (71.3, 87.6)}
"""Per cent, once and taken off at every reading; from the same design, its own as
above."""


@pytest.fixture(scope="module", params=zip(HOME_COUNTS, HOME_COLUMNS, strict=True))
def home_map(request):
    """The name of one of the home page's maps, its run by occsim, its prior."""
    name, column = request.param
    sample = load_sample(HOME_SAMPLE)
    made = MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))
    if name == "other":
        made = made.with_prior_mask(prior_drawing(sample, "d"))
    return name, made, BLANK if name == "none" else Prior(), column


def test_home_counts_what_the_lesson_says(home_map):
    name, made, prior, _ = home_map
    counts = [
        made.scores(prior, ONCE, at) for at in (Region.EXPLORED, Region.UNEXPLORED)
    ]
    shown = [n for at in counts for n in (at.tp, at.tp + at.fn, at.fp)]
    assert tuple(shown) == HOME_COUNTS[name]


def test_home_has_the_f2_of_the_lesson_before_and_after_the_switch(home_map):
    name, made, prior, _ = home_map
    f2 = [100 * made.scores(prior, rule).f2 for rule in (ONCE, SUBTRACT)]
    assert f2 == pytest.approx(HOME_F2[name], abs=0.05)


def test_home_works_out_the_f2_that_its_sentence_rests_on(home_map):
    _, made, prior, column = home_map
    building, settings = compute.sample(HOME_SAMPLE), state.defaults(HOME_SAMPLE)
    found = outcomes.final_f2(building, settings, column)
    assert found == pytest.approx(made.scores(prior, ONCE).f2, abs=1e-12)


def test_home_says_its_sentence_only_where_it_is_so(monkeypatch):
    building, settings = compute.sample(HOME_SAMPLE), state.defaults(HOME_SAMPLE)
    assert home.wrong_beats_right(building, settings)
    monkeypatch.setattr(home, "WRONG", home.OWN)
    assert not home.wrong_beats_right(building, settings)

"""The sentences on fronts and marks hold for the five reference drawings."""

import re

import numpy as np
import pytest

from occsim import Prior, UpdateRule, sample_names
from pages._ui import compute
from pages._ui.priors import front_words, fronts, marks, scores, surfaces
from pages._ui.settings import Settings

AXIS = surfaces.axis(0.02)
THINNED = {"thickness_px": -2}


@pytest.fixture(scope="module", params=sample_names())
def name(request):
    return request.param


@pytest.fixture(params=[{}, THINNED], ids=["as found", "thinned"])
def flaws(request):
    return request.param


@pytest.fixture(params=UpdateRule, ids=lambda rule: rule.value)
def run(name, flaws, request):
    """A reference drawing in cells of 3 px, as found and thinned, under each rule."""
    settings = Settings(cell_px=3, rule=request.param, **flaws)
    return compute.reference_run(name, settings)


def test_one_point_attains_the_highest_precision_and_recall_of_all_pairs(run):
    """ "One point: (…) attains …, so nothing has to be given up"."""
    said = front_words.front_text(run)
    assert said.startswith("One point") == (len(run.front) == 1)
    sweep = run.sweep(AXIS)
    best = np.nanmax(sweep.precision), np.nanmax(sweep.recall)
    has_both = bool(((sweep.precision == best[0]) & (sweep.recall == best[1])).any())
    # The sweep's pairs are some of the front's: where one of them has both maxima of
    # a longer front, the front's own maxima are higher.
    if len(run.front) == 1:
        assert run.front.precision[0] >= best[0]
        assert run.front.recall[0] >= best[1]
        assert "nothing has to be given up" in said
    elif has_both:
        assert run.front.precision[0] > best[0] or run.front.recall[-1] > best[1]


def test_along_a_longer_front_precision_falls_as_recall_rises(run):
    """ "to raise recall from … to …, precision falls from … to …"."""
    if len(run.front) == 1:
        return
    found = re.findall(r"([\d.]+) %", front_words.front_text(run))
    shown = [float(value) / 100 for value in found]
    ends = run.front.recall[[0, -1]].tolist() + run.front.precision[[0, -1]].tolist()
    assert shown == pytest.approx(ends, abs=0.0005)
    assert ends[0] < ends[1]
    assert ends[2] > ends[3]


def test_the_drawings_negative_is_named_where_and_only_where_it_is_on_the_front(run):
    said = front_words.front_text(run)
    n = int(np.count_nonzero(run.front.p_wall > run.front.p_space))
    n_constant = int(np.count_nonzero(run.front.p_wall == run.front.p_space))
    assert ("negative" in said) == (n > 0)
    assert ("nothing of the drawing" in said) == (n_constant > 0)
    assert ("with the drawing: p_wall is below p_space" in said) == (
        n + n_constant == 0
    )
    if 1 < n < len(run.front):
        assert f"{n} of them have p_wall above p_space" in said


def test_a_front_of_one_constant_prior_is_not_said_to_agree_with_the_drawing():
    """Cells of 20 px, taken off at every reading: (1, 1), 0.9 in every cell."""
    settings = Settings(cell_px=20, rule=UpdateRule.SUBTRACT_PRIOR)
    run = compute.reference_run("b", settings)
    assert fronts.pairs_of(run.front) == [(1.0, 1.0)]
    said = front_words.front_text(run)
    assert said.endswith("knows nothing of the drawing: p_wall equals p_space.")


def test_the_sources_pair_is_compared_with_the_blank_map(run):
    said = front_words.source_text(run)
    source, blank = run.scores(Prior()), run.scores(scores.BLANK)
    worse = source.precision < blank.precision and source.recall < blank.recall
    if "worse in both scores" in said:
        assert worse
    if "better in both scores" in said:
        assert source.precision > blank.precision
        assert source.recall > blank.recall


def test_taken_off_at_every_reading_the_sources_pair_is_below_the_blank_map(name):
    """The mark of the source lies below and left of the blank square, as found."""
    settings = Settings(cell_px=3, rule=UpdateRule.SUBTRACT_PRIOR)
    run = compute.reference_run(name, settings)
    assert "is worse in both scores" in front_words.source_text(run)


def test_thinned_by_two_pixels_every_front_of_the_source_opens(name):
    """ "Thin walls by 2 px": under the source's rule the front then has 4 points or
    more at each of its cell sizes, and at most 2 fewer than before."""
    for cell_px in (3, 5, 10):
        settings = Settings(cell_px=cell_px, rule=UpdateRule.SUBTRACT_PRIOR)
        found = compute.reference_run(name, settings)
        thinned = compute.reference_run(
            name, Settings(cell_px=cell_px, rule=UpdateRule.SUBTRACT_PRIOR, **THINNED)
        )
        assert len(thinned.front) >= max(4, len(found.front) - 2)


def test_the_recommended_pair_has_the_best_f2_of_set_c(run):
    said = front_words.recommended_text(run, 0.4)
    inside = np.flatnonzero(run.front.recall > 0.4)
    best = inside[np.argmax(run.front.f2[inside])]
    pair = fronts.pairs_of(run.front)[best]
    assert said.startswith(f"{inside.size} in set C")
    assert f"({pair[0]:.4g}, {pair[1]:.4g})" in said


def test_the_chosen_pair_is_on_or_off_the_front(run):
    for p_wall, p_space in fronts.pairs_of(run.front):
        prior = Prior(p_wall=p_wall, p_space=p_space)
        said = front_words.distance_text(run, prior)
        assert said == "The chosen pair is on the front."


def test_the_best_pair_in_bits_loses_least_of_all_pairs(run):
    """The triangle lies at the minimum of the surface of bits."""
    best = next(m for m in marks.marked(run) if m.name == marks.IN_BITS)
    view = surfaces.bits_view(run, run.settings)
    rule, region = run.settings.rule, run.settings.region
    assert run.mapped.bits(best.prior, rule, region) <= view.table.min() + 1e-9


def test_a_mark_beyond_the_axes_stands_at_their_end_with_its_own_values(run):
    for mark in marks.marked(run):
        assert all(marks.LOW <= value <= marks.HIGH for value in mark.pair)
        assert mark.text.endswith(f" {marks.shown(mark.prior.p_free_space)}")


@pytest.mark.parametrize(
    ("p_free", "text"),
    [(1e-6, "below 0.001"), (0.18, "0.18"), (0.9, "0.9"), (0.9996, "above 0.999")],
)
def test_no_probability_is_shown_as_certain(p_free, text):
    assert marks.shown(p_free) == text


def test_the_line_borders_the_pairs_that_beat_the_blank_map(run):
    """ "better: … % of the pairs", counted pair by pair on the source's 10 x 10."""
    blank = run.scores(scores.BLANK).recall
    settings = Settings(
        surface=surfaces.Surface.EXACT, fineness=surfaces.Fineness.TENTH
    )
    view = surfaces.views(run, settings)[1]
    better = sum(
        run.scores(Prior(p_wall=p_wall, p_space=p_space)).recall > blank
        for p_wall in surfaces.TENTHS
        for p_space in surfaces.TENTHS
    )
    assert view.share_above_blank == better / 100


def test_points_beyond_the_front_are_those_that_no_pair_attains(run):
    points = fronts.scores_at(run.front)
    assert fronts.n_beyond(run.front, points) == 0
    raised = [(min(p + 0.01, 1.0), r + 0.01) for p, r in points]
    assert fronts.n_beyond(run.front, raised) == len(points)

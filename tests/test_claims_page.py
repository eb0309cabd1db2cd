"""The section "Claims" of the page "Study", and what it says of all samples."""

import re

import pytest

from occsim import UpdateRule, sample_names
from occsim.study.claims import (
    CLAIMS,
    CONDITIONS,
    SOURCE_CONDITION,
    Condition,
    Walls,
    behind,
    judged,
    tally,
)
from occsim.study.published import SOURCE_CELLS_PX
from pages._ui import compute
from pages._ui.priors import claiming, solving
from tests.test_priors_pages import STUDY, open_with, press, texts

ONCE = Condition(rule=UpdateRule.PRIOR_ONCE)
THINNED = Condition(walls=Walls.THINNED_2)


@pytest.fixture(scope="module")
def results():
    """All samples at the source's cell sizes; the page finds them in the store."""
    return list(
        judged(
            solving.claims_case(compute.sample(name), cell_px, lambda done, total: None)
            for name in sample_names()
            for cell_px in SOURCE_CELLS_PX
        )
    )


@pytest.fixture(scope="module")
def counts(results):
    return tally(results)


def holds(counts, claim, condition):
    return counts[claim].over([condition])[0]


def test_the_verdict_says_that_the_pattern_needs_walls_found_thinner(counts):
    """ "recall peaks only with p_space = 1 in ... as the walls are found, and in ... if
    they are thinned by 2 px": more cases, and most of them."""
    assert holds(counts, "C2", THINNED) > holds(counts, "C2", SOURCE_CONDITION)
    assert holds(counts, "C2", THINNED) > 15 / 2


def test_the_verdict_says_that_the_pair_helps_where_the_pattern_is_not(counts):
    """ "Counted once, the pattern appears in ..., and the pair raises F2 in ...": there
    the pattern is rarer, and the pair helps more often, than where it is taken off."""
    assert holds(counts, "C2", ONCE) < holds(counts, "C2", THINNED)
    assert holds(counts, "C11a", ONCE) > holds(counts, "C11a", THINNED)
    assert holds(counts, "C11a", ONCE) == 15


def test_the_verdict_has_the_numbers_of_the_counts(counts):
    numbers = re.findall(r"in (\d+) of (\d+)", claiming.verdict(counts))
    asked = [
        ("C2", SOURCE_CONDITION),
        ("C2", THINNED),
        ("C11a", THINNED),
        ("C2", ONCE),
        ("C11a", ONCE),
    ]
    assert numbers == [(str(holds(counts, *one)), "15") for one in asked]


def test_thinner_walls_bring_out_the_published_pattern(counts):
    """C2, C3, C4 and C6 hold in no fewer cases the more the walls are thinned."""
    steps = (Walls.FOUND, Walls.THINNED_1, Walls.THINNED_2, Walls.THINNED_3)
    for claim in ("C2", "C3", "C4", "C6"):
        found = [holds(counts, claim, Condition(walls=walls)) for walls in steps]
        assert found == sorted(found)
        assert found[-1] > found[0]


def test_the_cost_of_a_step_does_not_depend_on_the_prior(results):
    """Timed, so a few may be off on a busy machine; the middle of them is not."""
    ratios = sorted(one.value for one in behind(results, "C9", CONDITIONS))
    assert ratios[len(ratios) // 2] == pytest.approx(1.0, abs=0.1)


def test_the_page_counts_when_asked_and_filters_by_condition(results, counts):
    app = open_with(STUDY)
    assert "A pattern reproduced" not in texts(app)
    press(app, "Judge the claims")
    assert not app.exception
    assert "A pattern reproduced is not a method confirmed" in texts(app)
    (table,) = (frame.value for frame in app.dataframe)
    assert table["claim"].tolist() == list(CLAIMS)
    assert table["holds in"].tolist() == [
        holds(counts, claim, SOURCE_CONDITION) for claim in CLAIMS
    ]
    rule = next(box for box in app.selectbox if box.key == "view_claims_rule")
    rule.select("Counted once")
    app.run()
    (table,) = (frame.value for frame in app.dataframe)
    assert table["holds in"].tolist() == [holds(counts, c, ONCE) for c in CLAIMS]


def test_a_row_shows_the_cases_behind_its_count(results):
    app = open_with(STUDY)
    press(app, "Judge the claims")
    row = list(CLAIMS).index("C6")
    app.session_state["claims_table"] = {"selection": {"rows": [row], "columns": []}}
    app.run()
    assert not app.exception
    _, cases = (frame.value for frame in app.dataframe)
    expected = behind(results, "C6", [SOURCE_CONDITION])
    assert cases["case"].tolist() == [one.label for one in expected]
    answers = {True: "yes", False: "no", None: "–"}
    assert cases["holds"].tolist() == [answers[one.holds] for one in expected]

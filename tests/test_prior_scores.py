"""The scores that the pages on priors share: two regions, the blank map beside each."""

import re

import pytest

from occsim import Prior, Region, UpdateRule, log_loss, sample_names, score
from pages._ui import compute, words
from pages._ui.priors import scores
from pages._ui.settings import Settings


@pytest.fixture(scope="module", params=sample_names())
def run(request):
    """A reference drawing in cells of 10 px."""
    return compute.reference_run(request.param, Settings(cell_px=10))


@pytest.mark.parametrize("rule", UpdateRule)
def test_the_values_are_those_of_the_library(run, rule):
    prior = Prior(p_wall=0.3, p_space=0.8)
    final, truth = run.mapped.map(prior, rule), run.mapped.truth_cells
    found = scores.values(run, prior, rule)
    for region, values in zip(scores.COLUMNS, found, strict=True):
        counts = score(final, truth, region)
        assert (values.precision, values.recall, values.f2) == pytest.approx(
            (counts.precision, counts.recall, counts.f2), nan_ok=True
        )
        assert values.bits == pytest.approx(log_loss(final, truth, region), nan_ok=True)


def test_the_runs_own_rule_is_the_default(run):
    subtract = run.under(UpdateRule.SUBTRACT_PRIOR)
    own = scores.rows(run, Prior(), UpdateRule.SUBTRACT_PRIOR)
    assert scores.rows(subtract, Prior()) == own


def test_the_blank_map_knows_nothing_where_nobody_looked(run):
    """It calls no cell wall and gives the truth one half: one bit a cell."""
    by_name = {row.name: row for row in scores.rows(run, Prior())}
    column = list(scores.COLUMNS).index(Region.UNEXPLORED)
    assert by_name["Precision"].blank[column] == words.DASH
    assert by_name["Bits per cell"].blank[column] == "1.000"


def plain(text):
    """A text without its HTML."""
    return re.sub("<[^>]+>", "", text)


def test_the_table_has_both_columns_and_the_blank_map_beside_each(run):
    head, _, *rows = scores.table(run, Prior()).splitlines()
    assert plain(head) == "| Score | looked at | blank | not looked at | blank |"
    assert [plain(row).split(" | ")[0] for row in rows] == [
        "| Precision",
        "| Recall",
        "| F2",
        "| Bits per cell",
    ]
    assert all(row.count("|") == head.count("|") for row in rows)


def test_both_rules_begin_with_the_one_that_counts_the_drawing_once(run):
    rules = [one.settings.rule for one in scores.both_rules(run)]
    assert rules == [UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR]

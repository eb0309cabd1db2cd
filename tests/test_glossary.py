"""The glossary: each term that a page explains has one sentence."""

import ast
import re
from pathlib import Path

import pytest

from pages._ui import glossary, words
from pages._ui.components.player import texts
from pages._ui.priors.scores import COLUMNS, Values

ROOT = Path(__file__).resolve().parents[1]


def terms_used():
    """The terms written in a call of `term` anywhere in the app."""
    found = set()
    for path in [ROOT / "app.py", *(ROOT / "pages").rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if name in ("term", "meaning"):
                found |= {a.value for a in node.args[:1] if isinstance(a, ast.Constant)}
    return found


SCORE_NAMES = {
    *Values(0.5, 0.5, 0.5, 0.5).shown(),
    *COLUMNS.values(),
    *(label for _, label, *_ in (*texts.SCORES, *texts.CURVES)),
}


def test_every_term_that_a_page_explains_is_in_the_glossary():
    assert len(terms_used()) > 5
    for name in terms_used():
        assert glossary.meaning(name)


@pytest.mark.parametrize("name", sorted(SCORE_NAMES))
def test_every_score_and_region_of_a_table_is_in_the_glossary(name):
    assert glossary.meaning(name)


@pytest.mark.parametrize("name", glossary.TERMS)
def test_a_meaning_is_one_sentence(name):
    assert re.fullmatch(r"[A-Z][^.!?]+\.", glossary.TERMS[name])


def test_a_term_is_found_with_a_capital_and_not_where_it_is_unknown():
    assert glossary.meaning("Recall") == glossary.TERMS["recall"]
    assert glossary.meaning("F2") == glossary.TERMS["F2"]
    with pytest.raises(KeyError):
        glossary.meaning("Sharpe ratio")


def test_a_term_shows_its_meaning_and_takes_the_focus():
    html = words.term("recall", "Recall")
    meaning = glossary.TERMS["recall"]
    assert html == f'<abbr title="{meaning}" tabindex="0">Recall</abbr>'

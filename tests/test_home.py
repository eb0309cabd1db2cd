"""The home page: its maps, the answer it keeps, the path of lessons and the plans."""

import json
import re
from dataclasses import replace

import pytest

from occsim import UpdateRule, load_sample
from pages._ui import compute, home, state, teaching
from pages._ui.choices import PriorDrawing
from pages._ui.columns import HOME_COLUMNS, HOME_SAMPLE, Column
from pages._ui.components.player import PlayerDocument, encode_document
from pages._ui.course import COURSE
from tests.test_pages import BUILD, launch
from tests.test_session import opened

HOME = "app.py"
LAST = len(load_sample(HOME_SAMPLE).trajectory)


def played(app):
    return app.session_state["played"][state.HOME_KEY]


def commit(app, **changes):
    """What the browser sends: the current document with changes."""
    document = encode_document(played(app))
    app.session_state[state.HOME_KEY] = {"committed": document | changes}
    app.run()
    assert not app.exception
    return app


def under(rule):
    """The maps of the home page under a rule, as the browser sends them."""
    columns = tuple(replace(column, rule=rule) for column in HOME_COLUMNS)
    return encode_document(PlayerDocument(columns=columns))["columns"]


def link(app):
    """The query of the link that the foot of a page offers."""
    address = next(
        one.proto
        for one in app.get("bidi_component")
        if one.proto.component_name == "address"
    )
    return json.loads(json.loads(address.json))["query"]


def labels(app):
    return [link.proto.label for link in app.get("page_link")]


def reopened(app):
    """The home page after another one, as a student comes back to it."""
    app.switch_page(BUILD).run()
    app.switch_page(HOME).run()
    assert not app.exception
    return app


# --- The maps -------------------------------------------------------------------------


def test_it_opens_before_the_first_reading_with_three_maps_that_play():
    document = played(launch(HOME))
    assert (document.step, document.predicted, document.compact) == (0, None, True)
    none, own, other = document.columns
    assert none == Column(uninformative=True)
    assert own == Column()
    assert other == Column(prior_drawing=PriorDrawing.D)


def test_the_answer_is_kept_while_other_pages_are_visited():
    app = commit(launch(HOME), predicted=2, step=LAST)
    app = reopened(app)
    assert (played(app).predicted, played(app).step) == (2, LAST)


def test_another_building_on_another_page_leaves_the_answer():
    app = commit(launch(HOME), predicted=2, step=LAST)
    app.switch_page(BUILD).run()
    next(one for one in app.selectbox if one.label == "Drawing").set_value("a").run()
    app.switch_page(HOME).run()
    assert played(app).predicted == 2
    assert played(app).columns == HOME_COLUMNS


def test_reset_all_starts_it_anew():
    columns = under(UpdateRule.SUBTRACT_PRIOR)
    app = commit(launch(HOME), predicted=1, step=LAST, columns=columns)
    rev = played(app).rev
    next(one for one in app.button if one.label == "Reset all").click().run()
    assert played(app) == PlayerDocument(
        rev=rev + 1, columns=HOME_COLUMNS, compact=True
    )


def test_only_the_rule_of_its_maps_can_be_changed():
    """A commit is not trusted; and no setting of the other pages follows it."""
    app = launch(HOME)
    before = app.session_state["settings"]
    odd = replace(Column(), p_wall=0.7, cell_px=1, rule=UpdateRule.SUBTRACT_PRIOR)
    columns = encode_document(PlayerDocument(columns=(odd, odd)))["columns"]
    commit(app, columns=columns)
    assert played(app).columns == tuple(
        replace(column, rule=UpdateRule.SUBTRACT_PRIOR) for column in HOME_COLUMNS
    )
    assert app.session_state["settings"] == before


def test_a_link_brings_back_its_step_and_its_rule():
    app = opened(HOME, step="17", home_rule="subtract_prior")
    assert played(app).step == 17
    assert encode_document(played(app))["columns"] == under(UpdateRule.SUBTRACT_PRIOR)
    # The map of another page opens where it does.
    assert app.session_state["played"][state.PLAYER_KEY].step > 17


@pytest.mark.parametrize("rule", ["", "x", "prior_once"])
def test_a_link_with_no_rule_of_ours_opens_with_the_drawing_counted_once(rule):
    assert played(opened(HOME, home_rule=rule)).columns == HOME_COLUMNS


def test_its_link_says_where_it_is_and_opens_the_same():
    app = commit(launch(HOME), step=LAST, columns=under(UpdateRule.SUBTRACT_PRIOR))
    again = opened(HOME, **link(app))
    assert played(again).step == LAST
    assert played(again).columns == played(app).columns


@pytest.mark.parametrize(
    ("rule", "step", "is_said"),
    [
        (UpdateRule.SUBTRACT_PRIOR, LAST, True),
        (UpdateRule.SUBTRACT_PRIOR, LAST - 1, False),
        (UpdateRule.PRIOR_ONCE, LAST, False),
    ],
)
def test_what_the_switch_did_is_said_at_the_end_only(rule, step, is_said):
    app = commit(launch(HOME), step=step, columns=under(rule))
    assert (f"**{home.FINDING}**" in labels(app)) == is_said


# --- The path and the plans -----------------------------------------------------------


def path_of(app):
    """The links of the path, one a lesson."""
    return [text for text in labels(app) if re.match(r"\d\. \*\*", text)]


def test_the_path_has_every_lesson_in_order_with_its_question():
    path = path_of(launch(HOME))
    for number, (text, lesson) in enumerate(zip(path, COURSE, strict=True)):
        assert text.startswith(f"{number}. **{lesson.title}")
        assert f"** {lesson.question}" in text
        assert lesson.question.endswith("?")


def test_what_was_done_of_a_lesson_stands_beside_it():
    app = launch(HOME)
    marked = [text for text in path_of(app) if "visited" in text]
    assert len(marked) == 1
    assert "(visited)" in marked[0]
    app = commit(app, predicted=2, step=LAST)
    assert "(visited, predicted)" in path_of(app)[0]


def test_the_first_vote_stays_when_another_follows():
    app = commit(launch(HOME), predicted=2, step=LAST)
    app = commit(app, predicted=0, step=LAST)
    assert app.session_state["lessons"] == {0: "other"}


@pytest.mark.parametrize("minutes", teaching.PLANS)
def test_a_plan_lasts_as_long_as_it_says_and_names_exercises_of_its_lessons(minutes):
    steps = teaching.steps(minutes)
    assert sum(step.minutes for step in steps) == minutes
    of_lesson = {one.number: one.lesson for one in compute.exercises()}
    for step in steps:
        assert all(of_lesson[number] == step.lesson for number in step.exercises)
        assert all(str(number) in step.what for number in step.exercises)

"""The page of exercises, and their panel on the other pages."""

import json
from dataclasses import replace

import pytest
from streamlit.testing.v1 import AppTest

from occsim import UpdateRule
from pages._ui import compute, judging
from pages._ui.exercise_pages import FOLDER_PAGES
from pages._ui.progress import FORMAT, Attempt
from pages._ui.state import exercise as kept
from pages._ui.state import held
from tests.test_pages import ROOT, said

LIST = "pages/9_Exercises.py"


def exercise(name):
    return next(one for one in compute.exercises() if one.id == name)


def opened(name):
    """An exercise opened from the list; its page is drawn."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.switch_page(LIST).run()
    app.button(key=f"open_{name}").click().run()
    app.switch_page(FOLDER_PAGES[exercise(name).page]).run()
    assert not app.exception
    return app


def press(app, label):
    next(one for one in app.button if one.label == label).click()
    app.run()
    assert not app.exception


def predict(app, option=0):
    radio = next(one for one in app.radio if one.label.startswith("**Predict.**"))
    radio.set_value(radio.options[option]).run()


def words(app):
    kinds = (app.title, app.markdown, app.caption, app.info, app.success)
    return "\n".join(text for kind in kinds for text in said(kind))


def test_the_list_has_all_of_them():
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.switch_page(LIST).run()
    assert not app.exception
    assert sum(one.label.startswith("Exercise ") for one in app.button) == 23


def test_an_open_exercise_asks_alone():
    """Without what the lesson of its page has to see, or another prediction."""
    app = opened("one_clear_look")
    assert not [text for text in said(app.markdown) if text.startswith("**See.**")]
    assert not [one for one in app.button if one.label.startswith("Open lesson")]


def test_every_exercise_opens_on_a_page_that_exists():
    for one in compute.exercises():
        assert (ROOT / FOLDER_PAGES[one.page]).is_file()


def test_an_exercise_sets_its_page_up_and_asks_for_the_prediction_first():
    app = opened("upside_down")
    chosen = app.session_state["settings"]
    assert (chosen.rule.value, chosen.p_wall, chosen.p_space) == (
        "subtract_prior",
        0.2,
        0.9,
    )
    assert app.session_state["choice"] == "a"
    assert next(one for one in app.button if one.label == "Check").disabled
    predict(app)
    assert not next(one for one in app.button if one.label == "Check").disabled


def test_it_is_judged_by_what_the_student_has_set():
    app = opened("one_clear_look")
    predict(app)
    press(app, "Check")
    assert "Not yet." in words(app)
    assert "wanted 99 % and 94.4 %" in words(app)
    settings = app.session_state["settings"]
    app.session_state["settings"] = compute.with_changes(settings, {"p_wall": 0.12})
    app.session_state["imposed"] = {}
    next(one for one in app.number_input if "cancel" in one.label).set_value(0.111)
    app.run()
    press(app, "Check")
    assert "Solved." in words(app)
    assert "You predicted: yes." in words(app)


def test_more_than_the_pages_simulate_is_not_simulated_for_a_check():
    app = opened("seen_and_missed")
    predict(app)
    wide = {"range_px": 300, "fov_deg": 360, "cell_px": 1}
    settings = app.session_state["settings"]
    app.session_state["settings"] = compute.with_changes(settings, wide)
    press(app, "Check")
    assert "are simulated here" in "\n".join(said(app.error))
    assert app.session_state["attempts"]["seen_and_missed"].n_checks == 0


def test_hints_come_one_by_one():
    app = opened("one_clear_look")
    assert "Hint." not in words(app)
    press(app, "Hint")
    assert words(app).count("Hint.") == 1
    press(app, "Hint")
    assert words(app).count("Hint.") == 2


def test_an_exercise_of_two_maps_judges_map_a():
    app = opened("mirror_image")
    first, second = app.session_state["settings"].columns
    assert (first.rule.value, second.rule.value) == ("subtract_prior", "prior_once")


def test_an_exercise_of_the_lens_is_judged_by_the_lens():
    app = opened("says_nothing")
    predict(app)
    press(app, "Check")
    assert "Not yet." in words(app)
    chosen = app.session_state["lens_chosen"]
    moved = replace(chosen, y_px=28.5, row=6, col=9)
    app.session_state["lens_chosen"], app.session_state["lens_imposed"] = moved, None
    app.run()
    press(app, "Check")
    assert "Solved." in words(app)


def test_the_link_names_the_exercise():
    app = opened("upside_down")
    again = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    again.query_params["exercise"] = app.session_state["exercise"]
    again.switch_page("pages/1_Build_a_map.py").run()
    assert "Exercise 18" in words(again)


def test_a_link_with_an_unknown_exercise_opens_none():
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.query_params["exercise"] = "<b>nonsense</b>"
    app.switch_page("pages/1_Build_a_map.py").run()
    assert not app.exception
    assert app.session_state["exercise"] is None


def test_leaving_keeps_what_was_set():
    app = opened("upside_down")
    press(app, "Leave the exercise")
    assert app.session_state["exercise"] is None
    assert app.session_state["settings"].rule.value == "subtract_prior"


def test_leaving_does_not_tell_what_was_hidden_to_be_found_out():
    app = opened("which_rule")
    state = app.session_state
    hidden = UpdateRule.SUBTRACT_PRIOR
    state["settings"] = replace(state["settings"], rule=hidden, p_wall=0.4)
    press(app, "Leave the exercise")
    assert state["settings"].rule is UpdateRule.PRIOR_ONCE
    assert state["settings"].p_wall == 0.4


def which_rule(app, answer):
    """Find out by the steps that exercise 15 asks for, answer, and check."""
    settings = app.session_state["settings"]
    played = dict(app.session_state["played"])
    pinned = replace(played["map_player"], pin_px=(268.5, 97.5))  # cell 32, 89
    app.session_state["played"] = played | {"map_player": pinned}
    app.session_state["imposed"] = {}
    app.run()
    for p_wall in (0.2, 0.7):
        app.session_state["settings"] = replace(settings, p_wall=p_wall)
        app.session_state["imposed"] = {}
        app.run()
    boxes = {one.label: one for one in app.selectbox}
    boxes["Which rule is running?"].set_value(answer)
    boxes["Because"].set_value(boxes["Because"].options[0]).run()
    press(app, "Check")


def rules_drawn(seed):
    found = exercise("which_rule")
    return [held.drawn(found, seed, times).setup.rule.value for times in range(8)]


# Seeds that draw each rule first, and the other one when it is drawn again.
SEEDS = {
    rules[0]: seed
    for seed in map(str, range(20))
    for rules in [rules_drawn(seed)]
    if rules[0] != rules[1]
}


@pytest.mark.parametrize("rule", ["prior_once", "subtract_prior"])
def test_the_rule_to_find_out_is_drawn_and_drawn_again_for_the_third_attempt(rule):
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.session_state["seed"] = SEEDS[rule]
    app.query_params["exercise"] = "which_rule"
    app.switch_page("pages/1_Build_a_map.py").run()
    predict(app)
    other = next(one for one in SEEDS if one != rule)

    def running():
        return app.session_state["settings"].rule.value

    for _ in range(2):
        assert running() == rule
        assert "drawn anew" not in words(app)
        which_rule(app, other)
        assert "Not yet." in words(app)
    assert "drawn anew" in words(app)
    assert running() == other
    which_rule(app, other)
    assert "Solved." in words(app)
    assert running() == other
    # What is handed in is judged by the rule that was drawn.
    attempt = app.session_state["attempts"]["which_rule"]
    assert judging.judged(exercise("which_rule"), attempt).is_solved


def test_sessions_draw_each_rule_about_as_often():
    drawn = [rules_drawn(str(seed))[0] for seed in range(200)]
    assert 70 < drawn.count("prior_once") < 130


def test_an_exercise_is_proven_when_it_is_opened_and_not_when_it_is_listed(
    monkeypatch,
):
    asked = []
    monkeypatch.setattr(compute, "refusal", lambda number: asked.append(number) or "")
    for page in ("app.py", LIST):
        app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
        app.switch_page(page).run()
        assert not app.exception
    assert asked == []
    app.button(key="open_upside_down").click().run()
    assert set(asked) == {18}


def test_an_exercise_that_is_refused_does_not_open_and_says_why(monkeypatch):
    monkeypatch.setattr(compute, "refusal", lambda _: "18_x.toml: it holds already")
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.switch_page(LIST).run()
    app.button(key="open_upside_down").click().run()
    assert "it holds already" in "\n".join(said(app.error))
    assert app.session_state["exercise"] is None
    linked = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    linked.query_params["exercise"] = "upside_down"
    linked.switch_page("pages/1_Build_a_map.py").run()
    assert "Exercise 18" not in words(linked)


def test_a_link_with_nothing_but_an_exercise_opens_it_as_it_begins():
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    app.query_params["exercise"] = "drive_it_again"
    app.switch_page("pages/3_Two_maps.py").run()
    own, blank = app.session_state["settings"].columns
    assert (own.uninformative, blank.uninformative) == (False, True)
    assert app.session_state["choice"] == "c"


def test_what_the_browser_keeps_can_be_cleared():
    app = opened("upside_down")
    predict(app)
    press(app, "Check")
    app.switch_page("app.py").run()
    app.switch_page(LIST).run()
    assert app.session_state["attempts"]
    press(app, "Clear it all")
    assert not app.session_state["attempts"]
    assert not app.session_state["lessons"]
    assert app.session_state["cleared"]
    assert [one.proto.text for one in app.get("progress")] == ["0 of 22 solved"]


def test_progress_is_a_file():
    app = opened("upside_down")
    predict(app)
    press(app, "Check")
    assert app.session_state["attempts"]["upside_down"].n_checks == 1


@pytest.mark.parametrize("name", ["says_nothing", "count_a_thousand", "yours"])
def test_each_kind_of_page_shows_its_exercise(name):
    assert f"Exercise {exercise(name).number}" in words(opened(name))


def test_what_the_browser_kept_is_read_again():
    given = Attempt(first="yes", answers={"p": 0.1}, n_checks=2, is_solved=True)
    rows = {
        "x": {
            "solved": True,
            "predicted": "yes",
            "answers": {"p": 0.1},
            "checks": 2,
            "hints": 0,
        }
    }
    text = json.dumps({"format": FORMAT, "exercises": rows})
    assert kept.kept_progress(text).attempts == {"x": given}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        '{"format": "occsim progress", "exercises": {"x": 1}}',
        "[" * 9999,
    ],
)
def test_a_damaged_progress_is_none(text):
    assert kept.kept_progress(text).attempts == {}

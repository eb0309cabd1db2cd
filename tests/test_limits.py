"""What is hidden and locked keeps its value, whatever tries to move it."""

import json
from dataclasses import fields, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from streamlit.testing.v1 import AppTest

from occsim import UpdateRule
from occsim.exercises import CONTROLS
from pages._ui import compute, limits
from pages._ui.choices import Overlay
from pages._ui.classroom.prepared import Prepared, packed
from pages._ui.columns import Column
from pages._ui.components.player import encode_document, player_data
from pages._ui.exercise_pages import FOLDER_PAGES
from pages._ui.limits import NAMES, OF_LENS, OF_ONE_MAP, OF_SEVERAL, Limits
from pages._ui.settings import TABLE, Settings
from pages._ui.state import held
from tests.test_pages import ROOT, control, said
from tests.test_player_document import ONE, REPLAY
from tests.test_settings import ANY_COLUMN, ANY_SETTINGS

BUILD = "pages/1_Build_a_map.py"
TWO_MAPS = "pages/3_Two_maps.py"


def exercise(name):
    return next(one for one in compute.exercises() if one.id == name)


def at(page, **query):
    """A page that was opened by a link."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    for name, value in query.items():
        app.query_params[name] = value
    app.switch_page(page).run()
    assert not app.exception
    return app


# --- The table ------------------------------------------------------------------------


def test_every_setting_and_every_control_of_an_exercise_is_in_the_table():
    assert set(TABLE) <= set(NAMES)
    ours = {limits.OF_EXERCISES.get(name, name) for name in CONTROLS}
    assert ours <= set(NAMES)
    assert {*OF_LENS, *OF_ONE_MAP, *OF_SEVERAL} <= set(NAMES)


names = st.frozensets(st.sampled_from(sorted(NAMES)))


@given(hidden=names, locked=names, own=ANY_SETTINGS, wanted=ANY_SETTINGS)
def test_what_is_held_has_its_value_and_all_else_is_as_wanted(
    hidden, locked, own, wanted
):
    kept = Limits(hidden=hidden, locked=locked, settings=own).kept(wanted)
    held = hidden | locked
    for one in fields(Settings):
        if one.name != "columns":
            source = own if one.name in held else wanted
            assert getattr(kept, one.name) == getattr(source, one.name)


@given(column=ANY_COLUMN)
def test_each_of_several_maps_keeps_what_is_held(column):
    own = Settings(columns=(Column(p_wall=0.3), Column(p_wall=0.4)))
    held = Limits(locked=frozenset({"p_wall", "rule"}), settings=own)
    first, second, third = held.kept(Settings(columns=(column,) * 3)).columns
    assert [one.p_wall for one in (first, second, third)] == [0.3, 0.4, 0.4]
    assert not first.calibrated
    assert first == replace(column, p_wall=0.3, calibrated=False, rule=Column().rule)


@given(wanted=ANY_SETTINGS)
def test_what_moves_together_has_the_value_of_the_first(wanted):
    kept = Limits(together=("p_wall", "p_space")).kept(wanted)
    assert replace(kept, p_space=wanted.p_space, columns=wanted.columns) == wanted
    assert kept.p_space == kept.p_wall
    assert all(one.p_space == one.p_wall for one in kept.columns)


def test_the_number_of_maps_can_be_held():
    held = Limits(hidden=frozenset({"columns"}))
    assert held.kept(Settings(columns=(Column(),) * 3)) == Settings()


def test_a_preset_goes_with_the_rule_that_it_would_tell():
    assert Limits(hidden=frozenset({"rule"})).hides("presets")
    assert not Limits(locked=frozenset({"rule"})).hides("presets")


def test_an_exercise_hides_all_that_it_does_not_show():
    found = limits.of_exercise(exercise("first_wall"), Settings())
    assert found.hidden.isdisjoint({"transport", "scores", "ladder"})
    assert found.hidden >= {"p_wall", "rule", "cell_px", "drawing", "missing_share"}
    assert found.hidden >= {"overlay", "laps", "model"}
    assert found.drawing == "d"


def test_an_exercise_without_a_list_holds_nothing():
    assert limits.of_exercise(exercise("says_nothing"), Settings()) == limits.NONE


EVERYTHING = Limits(hidden=frozenset(NAMES), by="your teacher")


@pytest.mark.parametrize("one", compute.exercises(), ids=lambda one: one.id)
def test_a_class_that_holds_everything_leaves_an_exercise_what_it_needs(one):
    own = limits.of_exercise(one, Settings())
    both = limits.of_exercise(one, Settings(), EVERYTHING)
    needed = {limits.OF_EXERCISES.get(name, name) for name in one.needs}
    assert needed & both.hidden == needed & own.hidden
    assert needed & both.locked == needed & own.locked
    assert both.hidden >= set(NAMES) - needed
    assert both.by == f"exercise {one.number} and your teacher"


def test_a_class_locks_in_an_exercise_what_the_exercise_does_not_need():
    """Exercise 22 names the laps and the rule; 10 locks the rule, and shows p_wall."""
    of_class = Limits(locked=frozenset({"rule", "p_wall"}), by="your teacher")
    laps = limits.of_exercise(exercise("drive_it_again"), Settings(), of_class)
    assert (laps.locked, laps.hidden) == ({"p_wall"}, frozenset())
    # Nothing is hidden by the class: the count of hidden controls is not its doing.
    assert laps.by == "exercise 22"
    control = limits.of_exercise(exercise("run_the_control"), Settings(), of_class)
    assert control.locked == {"rule", "uninformative"}


# --- The player -----------------------------------------------------------------------


def test_the_player_is_told_what_is_hidden_and_locked():
    held = Limits(hidden=frozenset({"rule"}), locked=frozenset({"p_wall"}))
    data = player_data(REPLAY, ONE, "key", limits=held)
    size = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + size])
    assert (header["hidden"], header["locked"]) == (["rule"], ["p_wall"])


# --- On the pages ---------------------------------------------------------------------


def test_an_edited_link_does_not_move_what_an_exercise_holds():
    app = at(
        BUILD,
        exercise="which_rule",
        rule="subtract_prior",
        cell_px="9",
        p_wall="0.6",
        drawing="a",
    )
    settings = app.session_state["settings"]
    drawn = held.drawn(exercise("which_rule"), app.session_state["seed"], 0)
    assert settings.rule is drawn.setup.rule
    assert settings.cell_px == 3
    assert settings.p_wall == 0.6  # shown, so free to be moved
    assert app.session_state["choice"] == "d"


def test_what_a_class_holds_opens_in_an_exercise_as_the_exercise_does():
    """The class has p_wall at 0.6; exercise 22 opens with 0.2 and does not need it."""
    held = Prepared(
        page=TWO_MAPS, texts={"p_wall": "0.6"}, hide=("p_space",), lock=("p_wall",)
    )
    link = {"p_wall": "0.4", "p_space": "0.4", "rule": "subtract_prior"}
    app = at(TWO_MAPS, plan=packed(held), exercise="drive_it_again", **link)
    settings = app.session_state["settings"]
    assert (settings.p_wall, settings.p_space) == (0.2, 0.9)
    assert settings.rule is UpdateRule.SUBTRACT_PRIOR
    [words] = [text for text in said(app.caption) if "hidden by" in text]
    assert words == "1 control is hidden by exercise 22 and your teacher."
    leave = next(one for one in app.button if one.label == "Leave the exercise")
    leave.click().run()
    assert app.session_state["settings"].p_wall == 0.6


def test_an_event_of_the_player_does_not_move_what_is_locked():
    app = at(BUILD, exercise="one_clear_look")
    imposed = app.session_state["imposed"]["map_player"]
    [column] = imposed.columns
    forged = replace(
        imposed, columns=(replace(column, p_wall=0.4, p_space=0.3, uninformative=True),)
    )
    app.session_state["map_player"] = {"committed": encode_document(forged)}
    app.run()
    settings = app.session_state["settings"]
    assert (settings.p_wall, settings.p_space) == (0.4, 1.0)
    assert not settings.uninformative


def test_a_control_that_moves_with_another_cannot_be_moved_apart_from_it():
    """Exercise 10: by a link, and by an event that claims another value."""
    app = at(BUILD, exercise="run_the_control", p_wall="0.3", p_space="0.9")
    settings = app.session_state["settings"]
    assert (settings.p_wall, settings.p_space) == (0.3, 0.3)
    imposed = app.session_state["imposed"]["map_player"]
    [column] = imposed.columns
    forged = replace(imposed, columns=(replace(column, p_wall=0.12, p_space=0.9),))
    app.session_state["map_player"] = {"committed": encode_document(forged)}
    app.run()
    settings = app.session_state["settings"]
    assert (settings.p_wall, settings.p_space) == (0.12, 0.12)


ROBOT = "pages/4_Robot_data.py"


def robot(**limits):
    """The page of a robot's log, as a class finds it."""
    return at(ROBOT, plan=packed(Prepared(page=ROBOT, **limits)))


def test_what_a_class_holds_of_a_log_s_map_holds_against_an_event_of_the_player():
    app = robot(lock=("transport", "overlay", "rule"))
    imposed = app.session_state["imposed"]["robot_player"]
    [column] = imposed.columns
    moved = replace(column, rule=UpdateRule.SUBTRACT_PRIOR)
    forged = replace(imposed, step=1, overlay=Overlay.WALL_MASK, columns=(moved,))
    app.session_state["robot_player"] = {"committed": encode_document(forged)}
    app.run()
    played = app.session_state["played"]["robot_player"]
    assert (played.step, played.overlay) == (imposed.step, Overlay.NONE)
    assert played.columns == imposed.columns


def test_a_class_hides_and_locks_the_controls_of_a_log():
    app = robot(hide=("usable_range_m", "log_maps"), lock=("log_cell_m", "drawing"))
    assert app.slider(key=control(app, "log_cell_m")).disabled
    drawn = {one.key for one in app.slider}
    assert control(app, "usable_range_m") not in drawn
    assert not [one for one in app.segmented_control if one.label == "Maps"]
    # A log of one's own would take the drawing's place.
    assert not app.get("file_uploader")
    assert "2 controls are hidden by your teacher." in said(app.caption)


def test_hidden_controls_are_off_the_page_and_counted():
    app = at(BUILD, exercise="first_wall")
    drawn = {one.key for kind in (app.slider, app.selectbox) for one in kind}
    assert not drawn & {control(app, name) for name in ("cell_px", "choice")}
    [words] = [text for text in said(app.caption) if "hidden by exercise 5" in text]
    n_hidden = int(words.split()[0])
    # The drawing, three sliders, seven errors and whose drawing, five settings behind a
    # button, and five of the player: both values, no drawing, the rule, what is shown.
    assert n_hidden == 1 + 3 + 8 + 5 + 5


def test_a_locked_control_is_seen_and_disabled():
    app = at(BUILD, exercise="better_sensor")
    slider = app.slider(key=control(app, "range_px"))
    assert slider.disabled
    assert slider.value == 40


def test_leaving_an_exercise_gives_the_controls_back():
    app = at(BUILD, exercise="first_wall")
    next(one for one in app.button if one.label == "Leave the exercise").click()
    app.run()
    assert not app.slider(key=control(app, "cell_px")).disabled
    assert not [text for text in said(app.caption) if "hidden by" in text]


def test_a_session_s_own_change_does_not_move_what_is_locked():
    """What any widget or button calls."""

    def page():
        from pages._ui import shell, state

        with shell.page("pages/1_Build_a_map.py"):
            state.change(range_px=20, fov_deg=60)

    app = AppTest.from_function(page, default_timeout=60)
    app.query_params["exercise"] = "better_sensor"
    app.run()
    settings = app.session_state["settings"]
    assert (settings.range_px, settings.fov_deg) == (40, 60)


@pytest.mark.parametrize(
    "name", ["better_sensor", "see_more", "run_the_control", "one_clear_look"]
)
def test_these_exercises_lock_a_setting_that_is_seen(name):
    found = limits.of_exercise(exercise(name), Settings())
    assert found.locked
    assert not found.locked & found.hidden


def test_every_exercise_opens_under_its_limits():
    for one in compute.exercises():
        app = at(FOLDER_PAGES[one.page], exercise=one.id)
        assert not app.error, one.id

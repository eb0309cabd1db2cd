"""The page for a class: what is prepared holds, votes are counted, files are judged."""

import contextlib
import json
from dataclasses import replace
from urllib.parse import parse_qsl, urlsplit

import pytest
from hypothesis import given
from hypothesis import strategies as st
from streamlit.testing.v1 import AppTest

from pages._ui import compute, limits, navigation, progress
from pages._ui.classroom import handed_in as module
from pages._ui.classroom.kept import CLASSES
from pages._ui.classroom.prepared import Prepared, packed
from pages._ui.classroom.questions import questions
from pages._ui.classroom.rooms import ROOMS
from pages._ui.course import COURSE
from pages._ui.judging import judged
from pages._ui.limits import NAMES, OF_PAGES
from pages._ui.progress import Attempt, Tried
from tests.test_exercises_page import press
from tests.test_limits import at
from tests.test_pages import ROOT, control, said
from tests.test_player_document import json_values

CLASS = "pages/10_Class.py"
BUILD = "pages/1_Build_a_map.py"
EXERCISES = sorted((ROOT / "assets" / "exercises").glob("*.toml"))


def teacher(section="Prepare"):
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=120)
    app.switch_page(CLASS).run()
    assert not app.exception
    if section != "Prepare":
        app.segmented_control(key="view_class_section").set_value(section).run()
    assert not app.exception
    return app


def row(app, name, wanted):
    app.segmented_control(key=f"class_row_{name}").set_value(wanted).run()
    assert not app.exception


def links(app):
    """The link with the code, and the long one."""
    return [one.value for one in app.code]


def follow(link):
    """A student who opens a link."""
    parts = urlsplit(link)
    name = parts.path.rpartition("/")[2]
    page = next(
        one.path for one in navigation.PAGES if one.path.endswith(f"_{name}.py")
    )
    return at(page, **dict(parse_qsl(parts.query)))


# --- Prepare --------------------------------------------------------------------------


def prepared():
    """A class with sample d, whose rule is hidden and whose cells are locked."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=120)
    app.query_params["drawing"] = "d"
    app.query_params["rule"] = "subtract_prior"
    app.query_params["p_wall"] = "0.3"
    app.switch_page(BUILD).run()
    app.switch_page(CLASS).run()
    row(app, "rule", "hide")
    row(app, "cell_px", "lock")
    press(app, "Make the link")
    return app


def test_a_class_opens_as_it_was_prepared_by_the_code_and_by_the_long_link():
    for link in links(prepared()):
        app = follow(link)
        settings = app.session_state["settings"]
        assert app.session_state["choice"] == "d"
        assert (settings.rule.value, settings.p_wall) == ("subtract_prior", 0.3)
        assert app.slider(key=control(app, "cell_px")).disabled
        # The rule, and the conditions that would tell it.
        assert "2 controls are hidden by your teacher." in said(app.caption)


def test_what_is_held_holds_against_an_edited_link():
    for link in links(prepared()):
        app = follow(f"{link}&rule=prior_once&cell_px=9&p_wall=0.7")
        settings = app.session_state["settings"]
        assert (settings.rule.value, settings.cell_px) == ("subtract_prior", 3)
        assert settings.p_wall == 0.7


def test_reset_returns_to_what_the_teacher_prepared():
    app = follow(f"{links(prepared())[0]}&p_wall=0.7")
    press(app, "Reset all")
    assert app.session_state["settings"].p_wall == 0.3


def test_a_code_is_typed_on_the_home_page():
    code = links(prepared())[0].partition("class=")[2]
    app = at("app.py")
    typed = next(one for one in app.text_input if "class code" in one.label)
    typed.set_value(f"{code[:4]} {code[4:]}".upper())
    press(app, "Go")
    assert app.session_state["settings"].p_wall == 0.3
    assert app.session_state["class_link"] == {"class": code}


def test_a_code_that_nobody_has_is_said_to_be_so():
    app = at("app.py")
    typed = next(one for one in app.text_input if "class code" in one.label)
    typed.set_value("abcdefghjkmn")
    press(app, "Go")
    assert "Ask your teacher" in said(app.warning)[0]


@pytest.mark.parametrize("query", [{"class": "abcdefghjkmn"}, {"plan": "x" * 300}])
def test_a_link_to_no_class_opens_the_page_and_says_so(query):
    app = at(BUILD, **query)
    assert "class" in said(app.warning)[0]


def test_a_class_without_a_page_of_ours_does_no_harm():
    text = packed(Prepared(page="../../etc/passwd", texts={"drawing": "a"}))
    app = at(BUILD, plan=text)
    assert app.session_state["choice"] == "a"
    app.switch_page("app.py").run()
    assert not app.exception


@pytest.mark.parametrize("page", OF_PAGES)
def test_each_page_has_the_controls_that_the_table_says(page):
    """With all hidden, what a page leaves out is in its row of the table."""
    text = packed(Prepared(page=page, texts={"drawing": "d"}, hide=tuple(NAMES)))
    app = at(page, plan=text)
    found = [words for words in said(app.caption) if "hidden by your teacher" in words]
    n_hidden = int(found[0].split()[0])
    row = limits.each(OF_PAGES[page])
    if page == BUILD:  # its sensor's errors are inside another group
        row = set(OF_PAGES[page]) - {"sensor_errors"}
    if page in ("pages/0_What_the_sensor_says.py", BUILD, "pages/3_Two_maps.py"):
        assert n_hidden == len(row)
    else:  # controls of other views are not drawn in this one
        assert 0 < n_hidden <= len(row)
    assert not app.exception


def test_hiding_every_control_hides_no_map():
    for page in (BUILD, "pages/3_Two_maps.py"):
        app = at(page, plan=packed(Prepared(page=page, hide=tuple(limits.OTHERS))))
        names = [one.proto.component_name for one in app.get("bidi_component")]
        assert "map_player" in names


def address(app):
    """The query of the address line of a page."""
    boxes = app.get("bidi_component")
    [data] = [one.proto.json for one in boxes if one.proto.component_name == "address"]
    return json.loads(json.loads(data))["query"]


def code_of(app):
    return links(app)[0].partition("class=")[2]


def test_a_reload_keeps_what_a_student_of_a_class_put_back_to_its_default():
    """The class has p_wall 0.3; 0.2 is the default of every drawing."""
    app = at(BUILD, **{"class": code_of(prepared())})
    app.selectbox(key=control(app, "choice")).set_value("a").run()
    state = app.session_state
    state["settings"] = replace(state["settings"], p_wall=0.2)
    state["imposed"] = {}
    app.run()
    again = at(BUILD, **address(app)).session_state
    assert (again["choice"], again["settings"]) == ("a", state["settings"])


def with_exercise(name="first_wall"):
    app = teacher()
    app.selectbox(key="view_class_exercise").set_value(name).run()
    press(app, "Make the link")
    return app


def test_a_reload_does_not_open_again_the_exercise_of_a_class_that_was_left():
    app = follow(links(with_exercise())[0])
    press(app, "Leave the exercise")
    again = at(BUILD, **address(app))
    assert again.session_state["exercise"] is None
    assert again.session_state["class_link"]


@pytest.mark.parametrize("more", [{}, {"drawing": "d"}])
def test_another_exercise_in_the_link_does_not_show_what_a_class_hides(more):
    """Exercise 3 does not hold the rule, which the class hides."""
    name = "two_readings_disagree"
    link = {"class": code_of(prepared()), "exercise": name, **more}
    app = at(BUILD, **link).session_state
    assert app["exercise"] == name
    assert app["settings"].rule.value == "prior_once"


def test_another_exercise_does_not_show_what_a_class_hides_in_the_lens():
    lens = "pages/0_What_the_sensor_says.py"
    texts = {"lens_rule": "subtract_prior"}
    text = packed(Prepared(page=lens, texts=texts, hide=("rule",)))
    app = at(lens, plan=text)
    assert app.session_state["lens_chosen"].rule.value == "subtract_prior"
    app.switch_page("pages/9_Exercises.py").run()
    app.button(key="open_two_readings_disagree").click().run()
    app.switch_page(lens).run()
    assert app.session_state["lens_chosen"].rule.value == "prior_once"
    app.switch_page(BUILD).run()
    press(app, "Leave the exercise")
    app.switch_page(lens).run()
    assert app.session_state["lens_chosen"].rule.value == "subtract_prior"


def test_a_locked_transport_stays_at_the_step_of_the_class():
    texts = {"drawing": "d", "step": "100"}
    text = packed(Prepared(page=BUILD, texts=texts, lock=("transport",)))
    for more in ({}, {"step": "7"}, {"drawing": "d"}, {"drawing": "d", "step": "7"}):
        app = at(BUILD, plan=text, **more)
        assert app.session_state["played"]["map_player"].step == 100


# --- Own exercises --------------------------------------------------------------------


def give(app, *files):
    uploader = app.get("file_uploader")[0]
    uploader.set_value([(name, data, "text/plain") for name, data in files])
    app.run()
    assert not app.exception


OWN = (
    EXERCISES[4]
    .read_text()
    .replace('id = "first_wall"', 'id = "mine"')
    .replace("The first wall", "My <b>wall</b>")
)


def test_an_exercise_of_ones_own_is_proven_at_once_and_travels_with_the_class():
    app = teacher()
    give(app, ("mine.toml", OWN.encode()))
    assert "Proven" in "\n".join(said(app.markdown))
    app.selectbox(key="view_class_exercise").set_value("mine").run()
    press(app, "Make the link")
    for link in links(app):
        student = follow(link)
        assert student.session_state["exercise"] == "mine"
        assert student.session_state["played"]["map_player"].step == 0
        assert student.title[0].value == "Exercise 1: My \\<b\\>wall\\</b\\>"
        student.switch_page("pages/9_Exercises.py").run()
        assert sum(one.label.startswith("Exercise ") for one in student.button) == 24


def test_an_exercise_that_is_refused_is_said_in_one_sentence():
    app = teacher()
    bad = OWN.replace("step = 2", "step = 3")
    give(app, ("mine.toml", bad.encode()), ("x.toml", b"\xff"))
    errors = said(app.error)
    assert len(errors) == 2
    assert errors[0].startswith("mine.toml: the check does not hold at the witness")
    press(app, "Make the link")
    assert not follow(links(app)[0]).session_state["prepared"].exercises


def test_an_exercise_of_ones_own_takes_the_place_of_ours_with_its_id():
    app = teacher()
    mine = EXERCISES[4].read_text().replace("The first wall", "Mine")
    give(app, ("mine.toml", mine.encode()))
    press(app, "Make the link")
    student = follow(links(app)[0])
    student.switch_page("pages/9_Exercises.py").run()
    assert not student.error
    assert sum(one.label.startswith("Exercise ") for one in student.button) == 23
    assert "Mine" in "\n".join(said(student.markdown))


@pytest.mark.parametrize(
    ("setting", "sentence"),
    [
        ("fov_deg = 1.0", "the set-up cannot be shown: fov_deg must lie in 5 to 360"),
        ("range_px = 1e300", "mine.toml: the check does not hold at the witness"),
    ],
)
def test_a_set_up_that_no_page_can_show_is_refused(setting, sentence):
    app = teacher()
    bad = OWN.replace("[setup]\n", f"[setup]\n{setting}\n")
    if "fov" in setting:  # wide enough for the proof: its check is of the step
        bad = bad.replace("set.step == first_wall_step", "set.step == 2")
    give(app, ("mine.toml", bad.encode()))
    [error] = said(app.error)
    assert sentence in error


def test_two_files_with_one_id_are_said_to_be_so():
    app = teacher()
    give(app, ("a.toml", OWN.encode()), ("b.toml", OWN.encode()))
    assert said(app.error) == ["b.toml: another file has the id 'mine' as well"]
    # Numbered as the students see it.
    assert "Proven: 1. My <b>wall</b>" in said(app.markdown)


def test_a_class_is_passed_on_with_its_exercises():
    app = teacher()
    give(app, ("mine.toml", OWN.encode()))
    press(app, "Make the link")
    other = follow(links(app)[0])
    other.switch_page(CLASS).run()
    other.selectbox(key="view_class_exercise").set_value("mine").run()
    press(other, "Make the link")
    assert follow(links(other)[0]).session_state["exercise"] == "mine"


# --- Vote -----------------------------------------------------------------------------


def test_students_answer_in_a_room_and_see_the_bars_when_they_are_shown():
    app = teacher("Vote")
    press(app, "Open a room")
    code, key = app.session_state["room"]
    students = [at(CLASS, room=code) for _ in range(3)]
    for i, student in enumerate(students):
        student.button(key=f"vote_{min(i, 1)}").click().run()
        assert "Your answer" in "\n".join(said(student.markdown))
    students[0].button(key="vote_2").click().run()  # changes it
    assert ROOMS.seen(code).n_answers == 3
    assert not [one for one in students[0].get("progress")]
    app.run()
    press(app, "Show the answers")
    assert ROOMS.seen(code).counts == (0, 2, 1)
    students[0].run()
    assert not [one for one in students[0].button if one.key == "vote_0"]


def test_a_room_that_the_teacher_closes_is_closed_for_all():
    app = teacher("Vote")
    press(app, "Open a room")
    code, _ = app.session_state["room"]
    student = at(CLASS, room=code)
    press(app, "Close this room and ask another")
    assert ROOMS.seen(code) is None
    student.run()
    assert "closed" in said(student.warning)[0]


def test_a_session_votes_by_the_word_that_its_browser_kept():
    code, _ = ROOMS.open("Will it?", ("yes", "no"))
    word = "0123456789abcdef"
    for option in (0, 1):  # a reload: the session is new
        student = at(CLASS, room=code)
        student.session_state["address"] = {"kept": {"progress": "", "voter": word}}
        student.run()
        student.button(key=f"vote_{option}").click().run()
    assert ROOMS.seen(code, word).n_answers == 1
    assert ROOMS.seen(code, word).mine == 1


@pytest.mark.parametrize("kept", ["", 7, {}, {"voter": "<b>"}, {"voter": ["x"]}])
def test_a_browser_that_keeps_nonsense_votes_all_the_same(kept):
    code, _ = ROOMS.open("Will it?", ("yes", "no"))
    student = at(CLASS, room=code)
    student.session_state["address"] = {"kept": kept}
    student.run()
    student.button(key="vote_0").click().run()
    assert ROOMS.seen(code).n_answers == 1


def test_a_link_to_a_room_without_its_key_shows_no_tally():
    code, key = ROOMS.open("Will it?", ("yes", "no"))
    student = at(CLASS, room=code)
    assert not [one for one in student.button if one.label == "Show the answers"]
    assert not [one for one in student.segmented_control]
    forged = at(CLASS, room=code, key="0" * len(key))
    assert not [one for one in forged.button if one.label == "Show the answers"]
    again = at(CLASS, room=code, key=key)  # the teacher, after a reload
    assert [one for one in again.button if one.label == "Show the answers"]


def test_a_room_that_is_gone_is_said_to_be_so():
    assert "closed" in said(at(CLASS, room="abcdef").warning)[0]


def test_home_every_lesson_and_every_exercise_that_predicts_can_be_voted_on():
    ready = questions(compute.exercises())
    predicting = [one for one in compute.exercises() if one.prediction is not None]
    assert [one.lesson for one in ready[:10]] == list(range(10))
    assert [one.exercise for one in ready[10:]] == [one.id for one in predicting]
    app = teacher("Vote")
    offered = app.selectbox(key="view_vote_question").options
    assert offered == [*(one.title for one in ready), "A question of my own"]
    for one in ready:
        code, _ = ROOMS.open(one.text, tuple(one.options.values()))
        assert ROOMS.seen(code).options == tuple(one.options.values())


def test_a_lesson_is_voted_on_in_its_own_words():
    app = teacher("Vote")
    app.selectbox(key="view_vote_question").set_value("Lesson 6: What is a good map?")
    app.run()
    press(app, "Open a room")
    code, _ = app.session_state["room"]
    assert ROOMS.seen(code).options == tuple(COURSE[6].options.values())
    assert "{" not in ROOMS.seen(code).question


def test_a_question_of_ones_own_is_text_and_no_markup():
    app = teacher("Vote")
    app.selectbox(key="view_vote_question").set_value("A question of my own").run()
    app.text_input(key="view_vote_text").set_value("Is ![x](http://a.b/c) **it**?")
    app.text_input(key="view_vote_option_0").set_value("<b>yes</b>")
    app.text_input(key="view_vote_option_1").set_value("no").run()
    press(app, "Open a room")
    [question] = [one.value for one in app.header]
    assert "![x]" not in question
    code, _ = app.session_state["room"]
    assert ROOMS.seen(code).options == ("<b>yes</b>", "no")


ROW = ("predicted", "answers", "checks", "hints", "stage", "tried", "solved")

# --- Collect --------------------------------------------------------------------------


def solved_progress():
    """What a student hands in who solved exercise 10 at first check of each part."""
    app = at(
        BUILD, exercise="run_the_control", p_wall="0.12", p_space="0.12", step="460"
    )
    next(one for one in app.radio if "Predict" in one.label).set_value("yes").run()
    press(app, "Check")
    box = next(one for one in app.selectbox if "suspicion" in one.label)
    box.set_value("F2, all cells").run()
    press(app, "Check")
    assert app.session_state["attempts"]["run_the_control"].is_solved
    return app


@pytest.fixture(scope="module")
def handed_in():
    app = solved_progress()
    return progress.to_text(
        app.session_state["attempts"], {}, "Ada", "2026-01-01T00:00:00+00:00"
    )


def test_what_is_handed_in_holds_all_that_the_teacher_asks_for(handed_in):
    given = json.loads(handed_in)
    assert given["version"]
    assert given["time"]
    row = given["exercises"]["run_the_control"]
    assert row["predicted"] == "yes"
    assert (row["checks"], row["solved"]) == (2, True)
    last = row["tried"]["1"]
    assert "drawing=d" in last["link"]
    # Of sample d with 0.12 for both: 98.8, as the design of the exercises says.
    assert last["numbers"]["f2"] == pytest.approx(0.988, abs=5e-4)


def table(app):
    return app.dataframe[0].value


def collect(*files):
    app = teacher("Collect")
    give(app, *files)
    return app


def test_predictions_of_lessons_are_counted_with_those_of_exercises(handed_in):
    files = []
    for i, said_in_4 in enumerate(["never", "never", "half", "no such answer", None]):
        given = json.loads(handed_in)
        given["lessons"] = {"4": {"predicted": said_in_4}}
        files.append((f"{i}.json", json.dumps(given).encode()))
    app = collect(*files)
    box = next(one for one in app.selectbox if one.label == "Question")
    assert box.options == [
        "Lesson 4: A head start",
        "Exercise 10: Is it the drawing that helps? Run the control",
    ]
    shown = [one.proto.text for one in app.get("progress")]
    assert shown == [
        "a quarter of them: 0",
        "half of them: 1",
        "all of them: 0",
        "never on this tour: 2",
    ]


def edited(text, **changes):
    given = json.loads(text)
    given["exercises"]["run_the_control"] |= changes
    return json.dumps(given).encode()


def test_thirty_files_are_judged_anew_and_an_edited_one_shows(handed_in):
    files = [(f"progress ({i}).json", handed_in.encode()) for i in range(29)]
    tried = json.loads(handed_in)["exercises"]["run_the_control"]["tried"]
    forged = {**tried, "1": tried["1"] | {"link": tried["1"]["link"] + "&fov_deg=90"}}
    app = collect(*files, ("last.json", edited(handed_in, tried=forged)))
    column = next(name for name in table(app).columns if name.startswith("10."))
    values = list(table(app)[column])
    assert values == ["solved"] * 29 + ["differs from its states"]
    assert list(table(app)["student"]) == ["Ada"] * 30
    assert "1 result differs" in said(app.warning)[0]
    bars = [one.proto.text for one in app.get("progress")]
    assert bars == ["yes: 30", "no: 0"]


def renamed(text, name):
    given = json.loads(text)
    given["exercises"] = {name: given["exercises"].pop("run_the_control")}
    return json.dumps(given).encode()


TEN = EXERCISES[9].read_text().replace('id = "run_the_control"', 'id = "mine"')


def test_exercises_of_ones_own_are_judged_as_soon_as_their_files_are_given(handed_in):
    app = teacher()
    give(app, ("mine.toml", TEN.encode()))
    app.segmented_control(key="view_class_section").set_value("Collect").run()
    give(app, ("a.json", renamed(handed_in, "mine")), ("b.json", handed_in.encode()))
    assert not app.warning
    found = table(app)
    assert [name for name in found if name.startswith("1. ")]
    assert (found == "solved").to_numpy().sum() == 2


def test_exercises_that_are_not_known_here_are_said_to_be_there(handed_in):
    app = collect(("a.json", renamed(handed_in, "mine")))
    assert "1 exercise that this page does not know" in said(app.warning)[0]


def test_two_exercises_of_one_title_have_columns_of_their_own():
    one = next(one for one in compute.exercises() if one.number == 1)
    other = replace(one, id="mine")
    assert module.column_names([one, other]) == {
        one.id: f"{module.title(one)} ({one.id})",
        "mine": f"{module.title(one)} (mine)",
    }


def test_exercises_of_one_id_are_not_judged_for_one_another(handed_in):
    """Two teachers use one id; only the reference that the check speaks of differs."""
    attempt = progress.from_text(handed_in).attempts["run_the_control"]
    mine = next(one for one in compute.exercises() if one.id == "run_the_control")
    assert judged(mine, attempt).is_solved
    harder = replace(mine, setup=replace(mine.setup, cell_px=9), page="two_maps")
    assert judged(harder, attempt).numbers != judged(mine, attempt).numbers


@pytest.mark.parametrize(
    "changes",
    [
        {"tried": {}},
        {"checks": 1, "tried": {"0": {"link": "drawing=zzz", "numbers": {}}}},
        {"solved": False},
    ],
)
def test_a_claim_without_the_states_that_make_it_true_shows(handed_in, changes):
    app = collect(("a.json", edited(handed_in, **changes)))
    assert "differs from its states" in table(app).to_string()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\xff\xfe",
        b"[]",
        b"[" * 100_000,
        b'{"format": "occsim progress", "exercises": []}',
        b'{"format": "occsim progress", "exercises": {"<b>": {}}}',
        b'{"format": "occsim progress", "exercises": {"x": {"checks": 1e99}}}',
        b" " * 900_000,
    ],
)
def test_a_hostile_file_is_refused_in_one_sentence(handed_in, data):
    app = collect(("![x](http://a.b).json", data), ("good.json", handed_in.encode()))
    [error] = app.error
    assert "![x](http" not in error.value  # its name is text
    assert len(table(app)) == 1


values = st.dictionaries(
    st.text(max_size=9), st.floats(-1e9, 1e9) | st.text(max_size=9), max_size=3
)
attempts = st.builds(
    Attempt,
    first=st.text(max_size=9),
    answers=values,
    stage=st.integers(0, 3),
    n_hints=st.integers(0, 9),
    n_checks=st.integers(0, 9),
    is_solved=st.booleans(),
    tried=st.dictionaries(
        st.integers(0, 3),
        st.builds(
            Tried,
            link=st.text(max_size=9),
            answers=values,
            numbers=st.dictionaries(st.text(max_size=9), st.floats(0, 1), max_size=3),
        ),
        max_size=3,
    ),
)


@given(made=st.dictionaries(st.from_regex(r"[a-z0-9_]{1,9}", fullmatch=True), attempts))
def test_a_progress_comes_back_as_it_was(made):
    assert progress.from_text(progress.to_text(made)).attempts == made


@given(row=st.dictionaries(st.sampled_from(ROW), json_values) | json_values)
def test_any_json_is_a_progress_or_is_refused(row):
    text = json.dumps({"format": progress.FORMAT, "exercises": {"x": row}})
    with contextlib.suppress(progress.ProgressError):
        assert progress.from_text(text).attempts["x"]


def test_numbers_that_are_none_are_refused():
    row = {"checks": 1, "hints": 0, "answers": {"a": float("nan")}}
    with pytest.raises(progress.ProgressError, match="numbers"):
        progress.from_text(
            json.dumps({"format": "occsim progress", "exercises": {"x": row}})
        )


def test_a_name_is_no_formula_in_the_table_which_has_its_own_button(handed_in):
    given = json.loads(handed_in) | {"name": "=HYPERLINK(1)"}
    app = collect(("a.json", json.dumps(given).encode()))
    assert list(table(app)["student"]) == ["'=HYPERLINK(1)"]


def test_a_name_is_no_formula_in_the_file_for_sheets(handed_in):
    found = replace(progress.from_text(handed_in), name="=HYPERLINK(1)")
    exercises = compute.exercises()
    student = module.student_of(found, "a.json", exercises)
    text = module.as_csv([student], exercises)
    assert "'=HYPERLINK(1)" in text
    assert text.startswith("student,exercise,status,predicted,checks,hints,numbers")
    assert len(text.splitlines()) == 2


def test_classes_are_kept_apart_from_sessions():
    code = links(prepared())[0].partition("class=")[2]
    assert CLASSES.find(code).page == BUILD

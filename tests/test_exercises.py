"""Exercises: the grammar, the facts, the proofs, and the judging."""

import math
import re
from pathlib import Path

import pytest

from occsim import ParameterError, Prior, Region, UpdateRule
from occsim.cli import main
from occsim.exercises import (
    Context,
    ExerciseState,
    Facts,
    changed,
    judge,
    load_exercise,
    load_exercises,
    with_draw,
)
from occsim.exercises.grammar import MAX_CHARACTERS, holds, parse, parse_sum, value

OURS = Path(__file__).resolve().parents[1] / "assets" / "exercises"


def look_up(**facts):
    return lambda name: facts.get(name, name)


# --- The grammar ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a >= 1", True),
        ("a > 1", False),
        ("a == 1 and b == 2", True),
        ("a == 1 and b == 1", False),
        ("not t", False),
        ("t and not f", True),
        ("abs(a - b) <= 1", True),
        ("a + b * 2 == 5", True),
        ("(a + b) * 2 == 6", True),
        ("b - a - 1 == 0", True),
        ("a / b <= 0.5", True),
        ("-a < 0", True),
        ("word == unseen", True),
        ("word != unseen", False),
        ('word == "unseen"', True),
        ("nan >= 0", False),
        ("nan != 0", False),
        ("not nan", False),
        ("a / 0 >= 0", False),
    ],
)
def test_a_check_holds_as_its_grammar_says(text, expected):
    facts = look_up(a=1.0, b=2.0, t=True, f=False, word="unseen", nan=math.nan)
    assert holds(parse(text), facts) is expected


@pytest.mark.parametrize(
    "text",
    [
        "",
        "a >=",
        "a >= 1 or b",
        "a >= 1 b",
        "(a",
        "abs a",
        "__import__('os')",
        "a[0] == 1",
        "a; b",
        "lambda: 1",
        "and",
        "a = 1",
        "(" * 200 + "a" + ")" * 200,
        "a" * (MAX_CHARACTERS + 1),
    ],
)
def test_what_is_not_of_the_grammar_is_refused(text):
    with pytest.raises(ParameterError):
        parse(text)


def test_a_quantity_is_computed():
    assert value(parse_sum("blank + 0.05"), look_up(blank=0.9)) == pytest.approx(0.95)


def test_words_are_not_compared_by_size():
    with pytest.raises(ParameterError, match="a number is needed"):
        holds(parse("word >= 1"), look_up(word="unseen"))


# --- The facts ------------------------------------------------------------------------


def test_scores_are_those_of_the_students_map():
    state = ExerciseState(drawing="d", rule="subtract_prior", region="all", step=200)
    facts = Facts(state)
    rule, region = UpdateRule.SUBTRACT_PRIOR, Region.ALL
    assert facts.value("f2") == facts.run.scores(Prior(), rule, region, 200).f2
    blank = facts.run.scores(Prior.uninformative(), rule, region, 200)
    assert facts.value("blank.recall") == blank.recall
    looked = facts.run.scores(Prior(), rule, Region.EXPLORED, 200)
    assert facts.value("looked.precision") == looked.precision


def test_the_prior_of_another_drawing_can_be_scored():
    own = Facts(ExerciseState(drawing="d"), Context(other="e"))
    wrong = Facts(ExerciseState(drawing="d", prior_drawing="e"))
    assert own.value("other.f2") == wrong.value("f2") < own.value("f2")


def test_a_cell_that_is_not_pinned_makes_every_check_false():
    facts = Facts(ExerciseState(drawing="d"))
    for text in ("cell.k >= 0", "cell.declared", "not cell.declared"):
        assert not holds(parse(text), facts.value)


def test_two_readings_cancel_in_the_cell_of_the_lesson():
    """Exercise 3: d, cell (32, 89), readings 239 and 291 say 0.9 and 0.1."""
    state = ExerciseState(drawing="d", cell=(32, 89), step=291)
    facts = Facts(state)
    assert facts.value("cell.k") == 2
    assert facts.value("cell.S") == pytest.approx(0.0, abs=1e-9)
    assert facts.value("cell.p_free") == pytest.approx(0.18)
    subtract = Facts(changed(state, {"rule": "subtract_prior"}))
    assert subtract.value("cell.p_free") == pytest.approx(0.82)


def test_a_thousand_cells_are_counted_from_the_prior_shown():
    facts = Facts(ExerciseState(p_wall=0.2))
    assert facts.value("count.free_empty") == 162
    assert facts.value("count.wall_empty") == 82
    assert facts.value("count.share") == pytest.approx(162 / 244)


def test_a_word_is_its_own_value():
    assert Facts(ExerciseState()).value("unseen") == "unseen"
    assert Facts(ExerciseState()).value("set.rule") == "prior_once"


@pytest.mark.parametrize(
    "changes",
    [
        {"nonsense": 1},
        {"drawing": "z"},
        {"p_wall": 2.0},
        {"rule": "sometimes"},
        {"step": -1},
        {"cell": [1]},
        {"cell": ["a", "b"]},
        {"thickness_px": 1e9},
        {"fov_deg": "wide"},
    ],
)
def test_a_state_out_of_bounds_is_refused(changes):
    with pytest.raises(ParameterError):
        changed(ExerciseState(), changes)


# --- Ours -----------------------------------------------------------------------------


def test_all_23_exercises_are_proven():
    found = load_exercises(OURS)
    assert [one.number for one in found] == list(range(1, 24))
    assert [one.id for one in found if one.is_open] == ["yours"]


def test_no_exercise_gives_its_answer_away_in_its_distance():
    for exercise in load_exercises(OURS):
        for check in exercise.checks:
            fields = re.findall(r"\{([^}]*)\}", check.distance)
            assert not any("lineup" in one or "study" in one for one in fields)


def test_judging_tells_the_distance_and_names_a_near_miss():
    exercise = next(one for one in load_exercises(OURS) if one.id == "upside_down")
    respects = changed(exercise.setup, {"p_wall": 0.3, "p_space": 0.7})
    verdict = judge(exercise, respects)
    assert not verdict.is_solved
    assert "wanted 96.9 %" in verdict.distance  # blank map 91.9 and 5 points
    assert "respects the drawing" in verdict.near_miss


# --- What is refused ------------------------------------------------------------------

GOOD = """
id = "x"
title = "X"
lesson = 1
minutes = 1
page = "build_a_map"
goal = "Reach it."

[setup]
drawing = "d"
p_wall = 0.2

[controls]
show = ["p_wall"]

[[check]]
that = "set.p_wall >= 0.5"
distance = "p_wall {set.p_wall}"

[[hint]]
say = "one"

[[hint]]
say = "two"

[after]
say = "Why."

[proof]
witness = { p_wall = 0.6 }
wrong = { p_wall = 0.4 }
"""


ONE_OPTION = '[predict]\nquestion = "?"\noptions = ["a"]\n[[check]]'
LONG_OPTION = ONE_OPTION.replace('"a"', f'"a", "{500 * "b"}"')
SAME_NAMES = 2 * '[[question]]\nname = "n"\nquestion = "?"\n' + "[[check]]"


def test_the_good_one_loads():
    exercise = load_exercise(GOOD.encode())
    assert judge(exercise, changed(exercise.setup, {"p_wall": 0.7})).is_solved
    verdict = judge(exercise, exercise.setup)
    assert (verdict.is_solved, verdict.distance) == (False, "p_wall 0.2")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('drawing = "d"', 'drawing = "z"', "drawing must be one of a, b, c, d, e"),
        ('drawing = "d"', "colour = 1", "there is no setting called 'colour'"),
        ("set.p_wall >= 0.5", "set.p_wall >= 0.1", "holds already at the set-up"),
        ("set.p_wall >= 0.5", "set.p_wall >= 0.9", "does not hold at the witness"),
        ("p_wall = 0.4 }", "p_wall = 0.9 }", "holds at the wrong answer"),
        ('[[hint]]\nsay = "two"\n', "", "needs 2 hints or more; got 1"),
        ('show = ["p_wall"]', 'show = ["rule"]', "moves p_wall, which is hidden"),
        ('show = ["p_wall"]', 'lock = ["p_wall"]', "moves p_wall, which is locked"),
        ("set.p_wall >= 0.5", "set.nonsense >= 0.5", "no fact called 'set.nonsense'"),
        ("set.p_wall >= 0.5", "answer.n >= 0.5", "no question asks for answer.n"),
        ("set.p_wall >= 0.5", "set.p_wall >>= 0.5", "cannot be read"),
        ('page = "build_a_map"', 'page = "moon"', "page must be one of"),
        ("minutes = 1", "minutes = 1.5", "minutes must be a whole number; got 1.5"),
        ("minutes = 1", "hours = 1", "no key called 'hours'"),
        ('id = "x"', "id = 3", "id must be a text; got 3"),
        ("wrong = { p_wall = 0.4 }", "", "needs a wrong answer"),
        ('title = "X"', "title =", "not a TOML file"),
        # No link and no progress could hold these.
        ('id = "x"', 'id = "My wall!"', "id must be 1 to 40 of a to z, 0 to 9 and _"),
        ("lesson = 1", "lesson = 99", "lesson must be 0 to 9; got 99"),
        ("[[check]]", ONE_OPTION, "the options of predict must be two or more"),
        ("[[check]]", LONG_OPTION, "must have 1 to 200 characters; got 500"),
        ("[[check]]", '[predict]\nquestion = "?"\n[[check]]', "predict needs options"),
        ("[[check]]", SAME_NAMES, "two questions have the same name"),
        # These would be passed over, and seen by a student first.
        ('show = ["p_wall"]', 'shows = ["p_wall"]', "show, lock, hide"),
        ("{set.p_wall}", "{tpp}", "there is no fact called 'tpp'"),
        (
            "p_wall = 0.2",
            'uninformative = true\np_wall = "x"',
            "p_wall must be a number",
        ),
    ],
)
def test_a_bad_exercise_is_refused_in_one_sentence(old, new, sentence):
    assert old in GOOD
    text = GOOD.replace(old, new)
    with pytest.raises(ParameterError, match=re.escape(sentence)):
        load_exercise(text.encode())


DRAWS = GOOD.replace(
    "[[check]]", '[draw]\nrule = ["prior_once", "subtract_prior"]\n[[check]]'
)
DRAWS = DRAWS.replace("set.p_wall >= 0.5", "answer.rule == set.rule").replace(
    "[[hint]]",
    """[[question]]
name = "rule"
question = "Which?"
options = ["prior_once", "subtract_prior"]
[[hint]]""",
    1,
)
PROOF = (
    'witness = {{ answer = {{ rule = "{}" }} }}\n'
    'wrong = {{ answer = {{ rule = "{}" }} }}\n'
)
ONCE = PROOF.format("prior_once", "subtract_prior")
SUBTRACT = PROOF.format("subtract_prior", "prior_once")
HEAD = DRAWS[: DRAWS.index("[proof]")]
DRAWS = f"{HEAD}[proof.prior_once]\n{ONCE}[proof.subtract_prior]\n{SUBTRACT}"


def test_what_is_drawn_is_judged_as_it_was_drawn():
    exercise = load_exercise(DRAWS.encode())
    for rule in UpdateRule:
        opened = with_draw(exercise, rule.value)
        assert opened.setup.rule is rule
        assert opened.settings["rule"] == rule.value
        for answer in UpdateRule:
            given = changed(opened.setup, {"answer": {"rule": answer.value}})
            assert judge(opened, given).is_solved is (answer is rule)


def test_an_exercise_that_draws_is_proven_for_each_value():
    half = f"{HEAD}[proof.prior_once]\n{ONCE}"
    with pytest.raises(ParameterError, match="a table for 'subtract_prior', if drawn"):
        load_exercise(half.encode())
    wrong = f"{half}[proof.subtract_prior]\n{ONCE}"
    with pytest.raises(ParameterError, match="does not hold at the witness"):
        load_exercise(wrong.encode())


@pytest.mark.parametrize(
    ("draw", "sentence"),
    [
        ('rule = ["prior_once"]', "draws from 2 values or more"),
        ('rule = "prior_once"', "draws from 2 values or more"),
        ('rule = ["prior_once", "twice"]', "rule must be one of"),
        ("p_wall = [0.2, 7.0]", "p_wall must"),
        ("colour = [1, 2]", "draw must name one setting"),
        ("p_wall = [0.1, 0.2]\np_space = [0.1, 0.2]", "draw must name one setting"),
    ],
)
def test_what_cannot_be_drawn_is_refused(draw, sentence):
    old = 'rule = ["prior_once", "subtract_prior"]\n[[check]]'
    assert old in DRAWS
    with pytest.raises(ParameterError, match=sentence):
        load_exercise(DRAWS.replace(old, f"{draw}\n[[check]]").encode())


@pytest.mark.parametrize("value", ["twice", 3.0, None])
def test_only_what_an_exercise_draws_from_is_drawn(value):
    with pytest.raises(ParameterError, match="value must be one"):
        with_draw(load_exercise(DRAWS.encode()), value)
    with pytest.raises(ParameterError, match="value must be one"):
        with_draw(load_exercise(GOOD.encode()), "prior_once")
    with pytest.raises(TypeError):
        with_draw("x", "prior_once")


TOGETHER = (
    GOOD.replace("p_wall = 0.2\n", "p_wall = 0.2\np_space = 0.2\n")
    .replace('show = ["p_wall"]', 'together = ["p_wall", "p_space"]')
    .replace("{ p_wall = 0.6 }", "{ p_wall = 0.6, p_space = 0.6 }")
)


def test_controls_that_move_together_open_and_are_proven_at_one_value():
    assert load_exercise(TOGETHER.encode()).together == ("p_wall", "p_space")
    for old, new, sentence in (
        ("p_space = 0.2\n", "p_space = 0.3\n", "move together and open apart"),
        ("p_space = 0.2\n", "", "move together and open apart"),
        (", p_space = 0.6", "", "the witness moves p_wall and p_space apart"),
        ('"p_space"]', '"rule"]', "together are some of p_wall, p_space; got rule"),
    ):
        assert old in TOGETHER
        with pytest.raises(ParameterError, match=sentence):
            load_exercise(TOGETHER.replace(old, new).encode())


def test_an_exercise_needs_what_its_file_names_and_what_its_witness_moves():
    plain = GOOD.replace('show = ["p_wall"]', 'needs = ["laps"]')
    # It shows p_wall, or moves it; what it sets up and never moves it does not need.
    for text, needs in ((GOOD, ("p_wall",)), (plain, ("laps", "p_wall"))):
        assert load_exercise(text.encode()).needs == needs
    drawn = load_exercise(DRAWS.encode(), prove=False)
    assert set(drawn.needs) >= {*drawn.show, *drawn.lock, *drawn.hide}
    with pytest.raises(ParameterError, match="no control called 'lap'"):
        load_exercise(plain.replace("laps", "lap").encode())


def test_an_exercise_can_be_read_without_its_proof():
    """To list many at once: what is refused by its proof alone is read."""
    bad = GOOD.replace("p_wall = 0.6 }", "p_wall = 0.3 }").encode()
    with pytest.raises(ParameterError, match="does not hold at the witness"):
        load_exercise(bad)
    assert load_exercise(bad, prove=False).id == "x"
    with pytest.raises(ParameterError):
        load_exercise(GOOD.replace("minutes = 1", "").encode(), prove=False)
    assert load_exercises(OURS, prove=False) == load_exercises(OURS)


@pytest.mark.parametrize(
    "content", [b"\xff\xfe", b"a = " + b"[" * 5000, b"#" * 200_000]
)
def test_a_hostile_file_is_refused(content):
    with pytest.raises(ParameterError):
        load_exercise(content)


def test_the_command_proves_a_folder(tmp_path, capsys):
    (tmp_path / "01_x.toml").write_text(GOOD)
    assert main(["exercises", str(tmp_path)]) == 0
    assert "1 exercises, each proven" in capsys.readouterr().out
    bad = GOOD.replace("set.p_wall >= 0.5", "set.p_wall >= 0.1")
    (tmp_path / "02_y.toml").write_text(bad)
    assert main(["exercises", str(tmp_path)]) == 1
    assert "02_y.toml: the check holds already" in capsys.readouterr().err


def test_an_empty_folder_is_refused(tmp_path):
    assert main(["exercises", str(tmp_path)]) == 2

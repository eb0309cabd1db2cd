"""The lessons: their words, and what comes out of each prediction."""

import re
from types import SimpleNamespace

import pytest

from occsim import (
    MappingRun,
    ParameterError,
    Region,
    Trajectory,
    UpdateRule,
    sample_names,
)
from occsim.run.laps import lap_scores
from pages._ui import (
    compute,
    course,
    exercising,
    lessons,
    navigation,
    outcomes,
    teaching,
)
from pages._ui.components.lens.document import LensDocument
from pages._ui.course import COURSE, lessons_of
from pages._ui.priors import answers, triptych
from pages._ui.settings import Settings


def test_the_lessons_are_numbered_and_stand_on_pages_of_the_navigation():
    assert [one.number for one in COURSE] == list(range(10))
    assert {one.path for one in COURSE} <= {page.path for page in navigation.PAGES}
    further = {path for one in COURSE for path in one.further}
    assert further <= {page.path for page in navigation.PAGES}


@pytest.mark.parametrize("lesson", COURSE[1:], ids=lambda one: one.title)
def test_a_lesson_has_three_sentences_at_most_and_two_to_four_answers(lesson):
    sentences = re.findall(
        r"[.?!](?:\s|$)", f"{lesson.see} {lesson.why}".replace("Eq. ", "")
    )
    assert 1 <= len(sentences) <= 3
    assert 2 <= len(lesson.options) <= 4
    assert lesson.predict.count("?") == 1
    assert lesson.number in outcomes.OUTCOMES


def test_every_lesson_has_exercises_and_every_exercise_a_lesson():
    assert {one.lesson for one in compute.exercises()} == set(range(1, 10))


def test_a_link_names_a_lesson_of_its_page_only():
    two_maps = COURSE[4].path
    assert course.lesson_in("4", two_maps) is COURSE[4]
    for text in ("0", "44", "", "3", "four"):
        assert course.lesson_in(text, two_maps) is None


def test_every_page_of_exercises_is_a_page():
    assert set(exercising.FOLDER_PAGES.values()) <= {p.path for p in navigation.PAGES}


# --- What was predicted ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"4": {"predicted": "never"}}, {4: "never"}),
        ({"4": {"predicted": None}, "5": {}}, {4: "", 5: ""}),
        ({"4": {"predicted": "no such answer"}}, {4: ""}),
        ({"44": {"predicted": "never"}, "x": 1}, {}),
        ({"4": ["never"]}, {4: ""}),
        ([], {}),
        (None, {}),
    ],
)
def test_lessons_of_a_progress_are_checked(given, expected):
    assert lessons_of(given) == expected


# --- What comes out, on every reference drawing ---------------------------------------


@pytest.fixture(scope="module", params=sample_names())
def name(request):
    return request.param


@pytest.fixture
def student(monkeypatch, name):
    """A student who chose a drawing and set nothing; settings can be changed."""
    building = compute.sample(name)
    opening = Settings(range_px=round(building.sensor.range_px))
    now = SimpleNamespace(settings=opening, lens=LensDocument(), said=None, tried=True)
    known = SimpleNamespace(
        building=lambda: building,
        choice=lambda: name,
        defaults=lambda _: opening,
        settings=lambda: now.settings,
        take_from_lens=lambda: now.lens,
        prediction=lambda _: now.said,
        was_tried=lambda _: now.tried,
    )
    for module in (outcomes, answers):
        monkeypatch.setattr(module, "state", known)
    return now


@pytest.mark.parametrize(
    ("number", "answer"),
    [(3, "cone"), (4, "never"), (5, "other"), (7, "negative"), (9, "looked")],
)
def test_what_comes_out_is_the_same_on_all_five(student, number, answer):
    """The guides for teachers name these answers."""
    assert outcomes.OUTCOMES[number]().answer == answer


def test_the_first_walls_were_met_by_the_cone_of_their_reading(student, name):
    said = outcomes.first_wall().text
    n = int(re.search(r"reading (\d+) of", said).group(1))
    run = compute.mapped(compute.sample(name), student.settings.mapping)
    before, after = (run.scores(outcomes.BLANK, n_readings=k).tp for k in (n - 1, n))
    assert before == 0
    assert f"{after} wall cell" in said


def test_the_vote_of_the_home_page_is_shown_again_in_lesson_5(student):
    assert "voted" not in outcomes.whose_drawing().text
    student.said = "none"
    assert outcomes.whose_drawing().text.endswith("you voted for no drawing.")


def test_the_triptych_has_a_negative_and_one_that_agrees(student, name):
    """Lesson 7: negative where it is taken off, the drawing where it is counted."""
    run = compute.run(compute.sample(name), student.settings)
    first, _, third = (
        triptych.kind(answers.best_f2(run, rule, region))
        for rule, region in triptych.QUESTIONS
    )
    assert first == "The drawing's negative:"
    assert third != first


def test_recall_peaks_at_the_lowest_p_wall_in_all_cases_where_it_is_counted_once():
    """As in exercise 21: subtract 0 and once 15 of 15."""
    facts = SimpleNamespace(settings=Settings)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(outcomes, "state", facts)
        found = outcomes.peak_of_recall()
    assert found.answer == "low"
    assert "in 15 of 15 cases" in found.text


# --- Lessons 1, 2 and 6: what the student does ----------------------------------------


def lens_outcomes(monkeypatch, document):
    monkeypatch.setattr(
        outcomes, "state", SimpleNamespace(take_from_lens=lambda: document)
    )
    return outcomes.silent(), outcomes.second()


def test_a_silent_cell_has_to_be_looked_for_from_where_lesson_1_opens(monkeypatch):
    """Poses of exercise 1."""
    opened = LensDocument(**COURSE[1].lens)
    assert lens_outcomes(monkeypatch, opened)[0].answer == ""
    moved = LensDocument(y_px=28.5)
    found = lens_outcomes(monkeypatch, moved)[0]
    assert found.answer == "yes"
    assert "It has 8 empty and 8 object pixels." in found.text


@pytest.mark.parametrize(
    ("prior", "answer", "said"),
    [
        # From 0.18 to 0.664 to 0.947; from 0.1 over 0.5 to 0.9, both steps 0.4.
        (0.18, "l", "l by +2.20 each, but p by +0.484 and then by +0.283."),
        (0.1, "both", "p by +0.400 each"),
    ],
)
def test_a_second_equal_reading_is_worth_as_much_in_l(monkeypatch, prior, answer, said):
    found = lens_outcomes(monkeypatch, LensDocument(p_free=prior))[1]
    assert found.answer == answer
    assert said in found.text


def test_lesson_5_gives_no_score_of_the_line_up_before_that_was_attempted(
    student, name
):
    """Exercise 16 asks for six scores of c; lesson 5 would tell four of them."""
    after = outcomes.whose_drawing()
    assert after.text.count("%") == 5
    student.tried = False
    before = outcomes.whose_drawing()
    assert before.answer == after.answer
    assert ("%" in before.text) is (name != "c")
    assert ("exercise 16" in before.text.lower()) is (name == "c")


def test_lesson_3_opens_with_the_belief_and_no_errors():
    """With *Errors* every wall is blue from the start: it asks which comes first."""
    assert "overlay" not in COURSE[3].settings


def test_where_the_drawing_is_taken_off_equal_readings_add_as_much_as_each_other(
    monkeypatch,
):
    """0.18: ln 9 + ln (0.82 / 0.18) = 2.20 + 1.52."""
    document = LensDocument(rule=UpdateRule.SUBTRACT_PRIOR)
    assert "l by +3.71 each" in lens_outcomes(monkeypatch, document)[1].text


def with_view(settings, **changes):
    return outcomes.replace(settings, uninformative=True, **changes)


@pytest.mark.parametrize(
    ("changes", "answer"),
    [({}, ""), ({"fov_deg": 90}, "little"), ({"range_px": 40}, "much")],
)
def test_looking_at_more_of_d_costs_little_or_much(student, name, changes, answer):
    """Exercises 6 and 8: d, blank, 90 degrees 70.4 and 97.8 %; range 40 px 32.2 %."""
    if name != "d":
        return  # the lesson opens with d
    student.settings = with_view(student.settings, **changes)
    assert outcomes.target() == pytest.approx(0.7)
    found = outcomes.seen_more()
    assert found.answer == answer
    if changes:
        assert "went from 99.9 %" in found.text


# --- What a teacher gets --------------------------------------------------------------


@pytest.mark.parametrize("minutes", teaching.PLANS)
def test_the_worksheet_has_every_step_of_its_plan(minutes):
    text = teaching.worksheet(minutes)
    assert text.count("<section>") == len(teaching.steps(minutes))
    assert "{" not in text.split("</style>")[1]


def test_exercises_of_a_lesson_are_listed_in_order(monkeypatch):
    monkeypatch.setattr(lessons, "state", SimpleNamespace(exercises=compute.exercises))
    assert [one.number for one in lessons.exercises_of(COURSE[4])] == [9, 10, 11, 12]


def test_the_control_knows_no_drawing(student, name):
    run = compute.run(compute.sample(name), student.settings).mapped
    best = outcomes.best_control(run.sweep)
    assert best.p_wall == best.p_space
    values = [0.05, 0.12, 0.13, 0.2, 0.5, 1.0]
    others = (outcomes.Prior(p_wall=p, p_space=p) for p in values)
    f2 = [run.scores(one, region=Region.EXPLORED).f2 for one in others]
    assert run.scores(best).f2 >= max(f2)


@pytest.mark.parametrize("minutes", teaching.PLANS)
def test_the_worksheet_in_the_repository_is_the_one_that_is_offered(minutes):
    """Written by ``python -m pages._ui.teaching``."""
    kept = teaching.FOLDER / f"worksheet_{minutes}.html"
    assert kept.read_text(encoding="utf-8") == teaching.worksheet(minutes)


def test_laps_of_one_tour_wear_the_drawing_off():
    """Exercise 22, sample c: 64.4 % without a drawing after any number of laps; with
    it less than one point more after the third."""
    run = compute.mapped(compute.sample("c"), Settings(range_px=20).mapping)
    blank = [lap_scores(run, outcomes.BLANK, n).recall for n in (1, 2, 3)]
    own = [lap_scores(run, outcomes.SOURCE, n).recall for n in (1, 2, 3)]
    assert blank == pytest.approx([0.644] * 3, abs=0.0005)
    assert own[0] - blank[0] > 0.2
    assert own[1] - blank[1] > 0.01
    assert own[2] - blank[2] < 0.01


def test_laps_add_the_same_readings_again():
    run = compute.mapped(compute.sample("d"), Settings(range_px=20, cell_px=5).mapping)
    tour = run.building.trajectory.poses
    twice = outcomes.replace(run.building, trajectory=Trajectory(poses=[*tour, *tour]))
    driven = MappingRun(twice, run.settings)
    for rule in UpdateRule:
        for region in Region:
            expected = driven.scores(outcomes.SOURCE, rule, region)
            assert lap_scores(run, outcomes.SOURCE, 2, rule, region) == expected


def test_laps_are_checked():
    run = compute.mapped(compute.sample("d"), Settings(range_px=20, cell_px=5).mapping)
    with pytest.raises(ParameterError, match="laps"):
        lap_scores(run, outcomes.SOURCE, 0)
    with pytest.raises(TypeError, match="run"):
        lap_scores(None, outcomes.SOURCE, 1)

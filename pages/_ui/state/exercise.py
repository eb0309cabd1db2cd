"""The exercise that a student works on: what was predicted, answered and solved."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import streamlit as st

from occsim import MappingRun, MapSettings, Prior
from occsim.exercises import (
    Exercise,
    ExerciseState,
    Question,
    Verdict,
    changed,
    judge,
)
from occsim.prior import PRIOR_SCALE
from occsim.samples import sample_names
from pages._ui import compute
from pages._ui.columns import FLAWS
from pages._ui.settings import Settings
from pages._ui.state import opening
from pages._ui.state.chosen import (
    building,
    choice,
    choose,
    renew_widgets,
)
from pages._ui.state.held import keep_settings, limits
from pages._ui.state.lens import LensDocument, set_lens, take_from_lens
from pages._ui.state.lesson import lessons_row, rows, take_lessons
from pages._ui.state.replay import (
    PLAYER_KEY,
    TWO_MAPS_KEY,
    forget_player,
    put_player,
    take_from_player,
)

PLAYER_PAGES = "build_a_map", "two_maps"
LENS_PAGE = "what_the_sensor_says"
OF_LENS = ("behind_hit", "clear_no_hit", "rule", "range_px", "fov_deg")
OF_ALL = ("range_px", "fov_deg", "clear_no_hit", "wall_share", "truth_share", "region")
"""Settings that all maps of a page share."""
OF_MAP = ("p_wall", "p_space", "uninformative", "rule", "behind_hit", "cell_px")
"""Settings that each of several maps has for itself."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """How far a student has come with one exercise.

    ``first`` is what was predicted, None before. ``moved`` holds how far each prior was
    moved while the pinned cell stayed; ``seen`` the pin and the pair last seen.
    """

    first: str | None = None
    answers: Mapping[str, float | str] = field(default_factory=dict)
    stage: int = 0
    n_hints: int = 0
    n_checks: int = 0
    is_solved: bool = False
    verdict: Verdict | None = None
    moved: Mapping[str, float] = field(default_factory=dict)
    seen: tuple[Any, ...] = ()


def attempts() -> dict[str, Attempt]:
    """Every attempt, by the exercise's id."""
    return st.session_state.get("attempts", {})


def attempt_of(exercise: Exercise) -> Attempt:
    """The attempt at an exercise; a new one at first."""
    return attempts().get(exercise.id, Attempt())


def keep_attempt(exercise: Exercise, **changes: Any) -> None:
    """Replace parts of the attempt at an exercise."""
    made = replace(attempt_of(exercise), **changes)
    st.session_state.attempts = attempts() | {exercise.id: made}


def exercise_id() -> str | None:
    """The id of the exercise that is open."""
    return st.session_state.get("exercise")


def leave_exercise() -> None:
    """Close the exercise; what was set stays, but for what the class holds."""
    st.session_state.exercise = None
    if limits().drawing:
        choose(limits().drawing)
    keep_settings(st.session_state.settings)
    forget_player()


def open_exercise(exercise: Exercise) -> None:
    """Set everything as an exercise opens; settings it does not name are defaults."""
    state = st.session_state
    state.exercise = exercise.id
    choose(exercise.setup.drawing)
    keep_settings(opening.of_exercise(exercise))
    if exercise.page == LENS_PAGE:
        set_lens(opening.lens_of_exercise(exercise))
    key = _player_of(exercise)
    last = exercise.setup.step
    n_readings = len(building().trajectory)
    step = n_readings if last == "end" else int(last)
    pin = exercise.setup.cell
    put_player(key, step, None if pin is None else _middle(pin, state.settings.cell_px))
    keep_attempt(exercise, moved={}, seen=())
    renew_widgets()
    forget_player()


def _player_of(exercise: Exercise) -> str:
    return TWO_MAPS_KEY if exercise.page == "two_maps" else PLAYER_KEY


def _middle(cell: tuple[int, int], cell_px: int) -> tuple[float, float]:
    row, col = cell
    return (col + 0.5) * cell_px, (row + 0.5) * cell_px


def _from_lens(document: LensDocument) -> dict[str, Any]:
    """What the student has set in the lens, by the names of an exercise."""
    return {
        **{name: getattr(document, name) for name in OF_LENS},
        "p_wall": min(1.0, document.p_free / PRIOR_SCALE),
        "lens_pose": [document.x_px, document.y_px, document.heading_deg],
        "lens_cell": [document.row, document.col],
        "lens_cell_px": document.cell_px,
    }


# --- Judging --------------------------------------------------------------------------


def widget_of(exercise: Exercise, question: Question) -> str:
    """The key of the widget in which a question is answered."""
    return f"answer_{exercise.id}_{question.name}"


def answer_before(exercise: Exercise, question: Question) -> float | str | None:
    """What was answered at the last check; None where it does not fit the question."""
    given = attempt_of(exercise).answers.get(question.name)
    if question.options:
        return given if given in question.options else None
    return None if isinstance(given, str) else given


def answers(exercise: Exercise) -> dict[str, float | str]:
    """What is answered now, on the page or before."""
    asked = [*exercise.questions, *filter(None, [exercise.reason])]
    given = {
        one.name: st.session_state.get(
            widget_of(exercise, one), answer_before(exercise, one)
        )
        for one in asked
    }
    return {name: value for name, value in given.items() if value is not None}


def student(exercise: Exercise) -> ExerciseState | None:
    """What the student has set, pinned and answered; None on an own building."""
    if choice() not in sample_names():
        return None
    key = _player_of(exercise)
    if exercise.page in PLAYER_PAGES:
        # A commit that came with this click is not in the settings yet.
        take_from_player(key)
    state = st.session_state
    settings: Settings = state.settings
    played = state.played[key]
    values = _values(settings, exercise)
    cell_px = values["cell_px"]
    pin = played.pin_px
    values |= {name: getattr(settings, name) for name in OF_ALL}
    values |= {
        "drawing": choice(),
        "step": min(played.step, len(building().trajectory)),
        "cell": pin and [int(at // cell_px) for at in reversed(pin)],
        "moved": attempt_of(exercise).moved,
        "answer": answers(exercise),
    }
    if exercise.page == LENS_PAGE:
        values |= _from_lens(take_from_lens())
    return changed(ExerciseState(), values)


def _values(settings: Settings, exercise: Exercise) -> dict[str, Any]:
    """The settings of the student's own map: of map A where there are several."""
    if exercise.page == "two_maps":
        own: Any = settings.columns[0]
        flaws = FLAWS[own.flaw]
    else:
        own, flaws = settings, settings.flaws
    found = {name: getattr(own, name) for name in OF_MAP}
    found["prior_drawing"] = own.prior_drawing.value
    return found | asdict(flaws)


def watch(exercise: Exercise) -> None:
    """Note how far the prior was moved while the pinned cell stayed."""
    state = student(exercise)
    if state is None:
        return
    attempt = attempt_of(exercise)
    seen = state.cell, state.prior
    before = attempt.seen
    if not before or before[0] != state.cell:
        keep_attempt(exercise, moved={}, seen=seen)
        return
    moved = _moved(before[1], state.prior, attempt.moved)
    if moved != attempt.moved:
        keep_attempt(exercise, moved=moved)


def _moved(
    first: Prior, now: Prior, so_far: Mapping[str, float]
) -> Mapping[str, float]:
    gaps = {
        "p_wall": abs(now.p_wall - first.p_wall),
        "p_space": abs(now.p_space - first.p_space),
    }
    gaps["any"] = gaps["own_prior"] = max(gaps.values())
    return {name: max(gap, so_far.get(name, 0.0)) for name, gap in gaps.items()}


def _readings(drawing: str, settings: MapSettings) -> MappingRun:
    """The runs that the pages show, with their bound of what is simulated."""
    return compute.mapped(compute.sample(drawing), settings)


def check(exercise: Exercise) -> None:
    """Judge the student's state; a check that holds leads to the next one."""
    state = student(exercise)
    if state is None:
        return
    attempt = attempt_of(exercise)
    verdict = judge(exercise, state, attempt.stage, _readings)
    last = len(exercise.checks) - 1
    stage = min(attempt.stage + 1, last) if verdict.is_solved else attempt.stage
    keep_attempt(
        exercise,
        verdict=verdict,
        answers=answers(exercise),
        stage=stage,
        n_checks=attempt.n_checks + 1,
        is_solved=attempt.is_solved or (verdict.is_solved and attempt.stage == last),
    )


# --- Progress -------------------------------------------------------------------------

FORMAT = "occsim progress"
MAX_PROGRESS = 100_000
"""Most characters of a progress that is read."""


def progress() -> str:
    """The progress as a text; empty where nothing was done."""
    return progress_text() if attempts() or rows() else ""


def take_kept() -> None:
    """Take the progress that the browser kept, once it has sent it."""
    state = st.session_state
    text = (state.get("address") or {}).get("kept")
    if not isinstance(text, str) or text == state.get("kept"):
        return
    state.kept = text
    state.attempts = attempts_in(text) | attempts()
    take_lessons(_part(text, "lessons"))


def progress_text() -> str:
    """Return what was visited, predicted, answered and solved, as JSON."""
    exercises = {
        name: {
            "solved": one.is_solved,
            "predicted": one.first,
            "answers": dict(one.answers),
            "checks": one.n_checks,
            "hints": one.n_hints,
        }
        for name, one in attempts().items()
        if one.first is not None or one.n_checks or one.n_hints
    }
    return json.dumps(
        {"format": FORMAT, "exercises": exercises, "lessons": lessons_row()}
    )


def attempts_in(text: str) -> dict[str, Attempt]:
    """Return the attempts of a progress; what cannot be read is left out."""
    try:
        given = _part(text, "exercises")
        return {name: _attempt(row) for name, row in given.items()}
    except (ValueError, TypeError, KeyError, AttributeError):
        return {}


def _part(text: str, name: str) -> Any:
    """One part of a progress as JSON; None where it cannot be read."""
    try:
        given = json.loads(text[:MAX_PROGRESS])
        return given[name] if given["format"] == FORMAT else None
    except (ValueError, TypeError, KeyError, RecursionError):
        return None


def _attempt(row: Mapping[str, Any]) -> Attempt:
    first = row["predicted"]
    return Attempt(
        first=first if isinstance(first, str) else None,
        answers={
            name: value if isinstance(value, str) else float(value)
            for name, value in row["answers"].items()
        },
        n_hints=int(row["hints"]),
        n_checks=int(row["checks"]),
        is_solved=row["solved"] is True,
    )

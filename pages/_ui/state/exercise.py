"""The exercise that a student works on: what was predicted, answered and solved."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any
from urllib.parse import urlencode

import streamlit as st

from occsim import OccsimError, Prior
from occsim.exercises import (
    Exercise,
    ExerciseState,
    Question,
    judge,
)
from occsim.samples import sample_names
from pages._ui import compute, openings
from pages._ui.components.lens.document import OPENING as LENS_OPENING
from pages._ui.exercise_pages import FOLDER_PAGES
from pages._ui.judging import (
    LENS_PAGE,
    PLAYER_PAGES,
    numbers_of,
    state_of,
)
from pages._ui.progress import (
    MAX_TEXT,
    Attempt,
    Progress,
    Tried,
    from_text,
    to_text,
)
from pages._ui.state.chosen import (
    building,
    choice,
    choose,
    renew_widgets,
    state_texts,
)
from pages._ui.state.classes import take_voter
from pages._ui.state.held import (
    class_now,
    close_exercise,
    draw_again,
    keep_settings,
    limits,
    opened,
)
from pages._ui.state.lens import set_lens, take_from_lens
from pages._ui.state.lesson import lessons_row, rows, take_lessons
from pages._ui.state.replay import (
    PLAYER_KEY,
    TWO_MAPS_KEY,
    forget_player,
    put_player,
    restart_home,
    take_from_player,
)
from pages._ui.state.widgets import set_view

TRIES = 2
"""Attempts at what was drawn once: with more, trying every answer would find it."""


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


def was_tried(exercise: Exercise) -> bool:
    """Whether an exercise was attempted."""
    return attempt_of(exercise).n_checks > 0


def exercise_id() -> str | None:
    """The id of the exercise that is open."""
    return st.session_state.get("exercise")


def leave_exercise() -> None:
    """Close the exercise; the drawing and the place are as the class holds them."""
    close_exercise()
    if limits().drawing:
        choose(limits().drawing)
    forget_player()


def open_exercise(exercise: Exercise) -> None:
    """Set everything as an exercise opens; settings it does not name are defaults."""
    state, exercise = st.session_state, opened(exercise)
    state.exercise = exercise.id
    choose(exercise.setup.drawing)
    keep_settings(openings.of_exercise(exercise))
    if exercise.page == LENS_PAGE:
        set_lens(openings.lens_of_exercise(exercise))
    elif class_now() is not None:
        set_lens(LENS_OPENING)  # what the class hides in it is not held meanwhile
    key = _player_of(exercise)
    last = exercise.setup.step
    n_readings = len(building().trajectory)
    step = n_readings if last == "end" else int(last)
    pin = exercise.setup.cell
    cell_px = state.settings.cell_px
    put_player(key, step, None if pin is None else openings.middle(pin, cell_px))
    keep_attempt(exercise, moved={}, seen=())
    renew_widgets()
    forget_player()


def _player_of(exercise: Exercise) -> str:
    return TWO_MAPS_KEY if exercise.page == "two_maps" else PLAYER_KEY


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
    is_lens = exercise.page == LENS_PAGE
    lens = take_from_lens() if is_lens else state.lens_chosen
    more = {"moved": attempt_of(exercise).moved, "answer": answers(exercise)}
    return state_of(exercise, choice(), state.settings, state.played[key], lens, more)


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


def check(exercise: Exercise) -> None:
    """Judge the student's state; a check that holds leads to the next one."""
    state = student(exercise)
    if state is None:
        return
    attempt = attempt_of(exercise)
    verdict = judge(exercise, state, attempt.stage, compute.of_sample)
    last = len(exercise.checks) - 1
    stage = min(attempt.stage + 1, last) if verdict.is_solved else attempt.stage
    tried = attempt.tried
    if verdict.is_solved or not attempt.is_solved:
        tried = {**tried, attempt.stage: _tried(exercise, state)}
    keep_attempt(
        exercise,
        verdict=verdict,
        answers=answers(exercise),
        stage=stage,
        tried=tried,
        n_checks=attempt.n_checks + 1,
        is_solved=attempt.is_solved or (verdict.is_solved and attempt.stage == last),
    )
    if is_redrawn(exercise):
        draw_again(exercise)
        keep_attempt(exercise, moved={}, seen=())
        keep_settings(st.session_state.settings)  # under the limits that hold now
        forget_player()


def is_redrawn(exercise: Exercise) -> bool:
    """Whether what the exercise draws is drawn anew for the attempt that comes."""
    attempt = attempt_of(exercise)
    counts = exercise.draw is not None and not attempt.is_solved
    return counts and attempt.n_checks > 0 and attempt.n_checks % TRIES == 0


def _tried(exercise: Exercise, state: ExerciseState) -> Tried:
    """The state that was judged, as a progress holds it."""
    step = st.session_state.played[_player_of(exercise)].step
    texts = state_texts(FOLDER_PAGES[exercise.page])
    return Tried(
        link=urlencode({**texts, "step": str(step)}),
        answers=answers(exercise),
        moved=attempt_of(exercise).moved,
        numbers=numbers_of(exercise, state),
        time=_now(),
    )


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


# --- Progress -------------------------------------------------------------------------


def progress() -> str:
    """The progress as a text; empty where nothing was done."""
    return progress_text() if attempts() or rows() else ""


def is_cleared() -> bool:
    """Whether the browser is to forget what it keeps."""
    return st.session_state.get("cleared", False)


def clear_progress() -> None:
    """Forget what was predicted and tried, here and in the browser."""
    state = st.session_state
    state.attempts, state.lessons, state.draws = {}, {}, {}
    state.cleared = True
    set_view("hand_in_name", "")
    restart_home()  # its question is answered in it


def take_kept() -> None:
    """Take what the browser kept, once it has sent it."""
    state = st.session_state
    given = (state.get("address") or {}).get("kept")
    if not isinstance(given, Mapping) or given == state.get("kept"):
        return
    state.kept = given
    take_voter(given.get("voter"))
    text = given.get("progress")
    found = kept_progress(text if isinstance(text, str) else "")
    state.attempts = furthest(attempts(), found.attempts)
    take_lessons(found.lessons)


def furthest(
    mine: Mapping[str, Attempt], others: Mapping[str, Attempt]
) -> dict[str, Attempt]:
    """Return every attempt; of two at one exercise that which came further.

    What a browser sends may be older than the session, or another window's.
    """
    none = Attempt()
    return {
        name: max(mine.get(name, none), others.get(name, none), key=_how_far)
        for name in {**others, **mine}
    }


def _how_far(one: Attempt) -> tuple[int, ...]:
    return one.is_solved, one.n_checks, one.n_hints, one.first is not None


def progress_text() -> str:
    """Return what was done, as the browser keeps it."""
    return to_text(attempts(), lessons_row())


def progress_file(name: str) -> str:
    """Return what was done, as it is handed in: with a name and the time."""
    return to_text(attempts(), lessons_row(), name[:MAX_TEXT], _now())


def kept_progress(text: str) -> Progress:
    """Return what the browser kept; nothing where it cannot be read."""
    try:
        return from_text(text)
    except OccsimError:
        return Progress({})

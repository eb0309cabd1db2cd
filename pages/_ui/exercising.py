"""The panel of an exercise on its page, and the list of all of them."""

from functools import partial

import streamlit as st

from occsim.exercises import Exercise, Question
from pages._ui import state, words
from pages._ui.state import exercise as kept

FOLDER_PAGES = {
    "what_the_sensor_says": "pages/0_What_the_sensor_says.py",
    "build_a_map": "pages/1_Build_a_map.py",
    "your_building": "pages/2_Your_building.py",
    "two_maps": "pages/3_Two_maps.py",
    "sweep_the_priors": "pages/5_Sweep_the_priors.py",
    "pareto_explorer": "pages/6_Pareto_explorer.py",
    "best_prior": "pages/7_Best_prior.py",
    "study": "pages/8_Study.py",
}
RULE_WORDS = {
    "prior_once": "count the drawing once",
    "subtract_prior": "take it off at every reading",
    "unseen": "where nobody looked, the pair is wrong",
    "noise": "the sensor is noisy",
    "cells": "the cells are too large",
}
"""Options that are words of a check, as they are shown."""


def is_here() -> bool:
    """Whether an exercise is open on this page."""
    exercise = state.active()
    return exercise is not None and FOLDER_PAGES[exercise.page] == state.path()


def panel() -> None:
    """Draw the exercise that is open, on its page."""
    exercise = state.active()
    if exercise is None or not is_here():
        return
    kept.watch(exercise)
    with st.container(border=True, key="exercise"):
        task, answer = st.columns([3, 2], gap="large")
        with task:
            st.markdown(
                f"**Exercise {exercise.number}: {exercise.title}{_stop(exercise)}** "
                f"{words.maths(exercise.goal)}"
            )
            _hints(exercise)
        with answer:
            if _has_predicted(exercise):
                _questions(exercise)
                _verdict(exercise)
        _buttons(exercise)


def _shown(option: str) -> str:
    return RULE_WORDS.get(option, option)


def _stop(exercise: Exercise) -> str:
    return "" if exercise.title.endswith("?") else "."


def _has_predicted(exercise: Exercise) -> bool:
    """Ask for the prediction first; it is stored and not judged."""
    question, attempt = exercise.prediction, kept.attempt_of(exercise)
    if question is None or attempt.first is not None:
        return True
    first = st.radio(
        f"Predict. {words.maths(question.text)}",
        question.options,
        index=None,
        format_func=_shown,
        **state.bind_view(f"predict_{exercise.id}", None),
    )
    if first is None:
        return False
    kept.keep_attempt(exercise, first=first)
    return True


def _questions(exercise: Exercise) -> None:
    for question in exercise.questions:
        _ask(exercise, question)
    if exercise.reason is not None:
        _ask(exercise, exercise.reason)


def _ask(exercise: Exercise, question: Question) -> None:
    # Never set by the program while it is on the page: that would take back what is
    # being typed during a run.
    key = kept.widget_of(exercise, question)
    before = kept.answer_before(exercise, question)
    label = words.maths(question.text)
    if question.options:
        st.selectbox(
            label,
            question.options,
            index=question.options.index(before) if before else None,
            format_func=_shown,
            key=key,
        )
    else:
        st.number_input(label, value=before, step=0.001, format="%g", key=key)


def _hints(exercise: Exercise) -> None:
    for hint in exercise.hints[: kept.attempt_of(exercise).n_hints]:
        st.caption(f"Hint. {words.maths(hint)}")


def _verdict(exercise: Exercise) -> None:
    attempt = kept.attempt_of(exercise)
    if attempt.is_solved:
        first = f" You predicted: {_shown(attempt.first)}." if attempt.first else ""
        st.success(f"Solved.{first} {words.maths(exercise.after)}")
        return
    verdict = attempt.verdict
    if verdict is None:
        return
    if verdict.is_solved:
        st.info("That part is solved. Go on with the next.")
        return
    st.info(" ".join(filter(None, ("Not yet.", verdict.near_miss, verdict.distance))))


def _buttons(exercise: Exercise) -> None:
    attempt = kept.attempt_of(exercise)
    waits = exercise.prediction is not None and attempt.first is None
    with st.container(horizontal=True):
        if not exercise.is_open:
            st.button(
                "Check",
                type="primary",
                on_click=partial(state.attempt, partial(kept.check, exercise)),
                disabled=waits,
            )
        if attempt.n_hints < len(exercise.hints):
            st.button(
                "Hint",
                on_click=partial(
                    kept.keep_attempt, exercise, n_hints=attempt.n_hints + 1
                ),
            )
        st.button("Start again", on_click=partial(kept.open_exercise, exercise))
        st.button("Leave the exercise", on_click=kept.leave_exercise)


# --- The list -------------------------------------------------------------------------


def all_exercises() -> None:
    """The exercises, what was solved of them, and the progress as a file."""
    found = state.exercises()
    solved = sum(kept.attempt_of(one).is_solved for one in found)
    judged = sum(not one.is_open for one in found)
    st.progress(solved / judged, text=f"{solved} of {judged} solved")
    for exercise in found:
        _row(exercise)
    st.download_button(
        "Progress as a file",
        kept.progress_text(),
        file_name="progress.json",
        mime="application/json",
        on_click="ignore",
    )


def _row(exercise: Exercise) -> None:
    attempt = kept.attempt_of(exercise)
    status = "solved" if attempt.is_solved else "begun" if attempt.n_checks else ""
    with st.container(horizontal=True, vertical_alignment="center"):
        open_button(exercise, "Open", "open")
        st.markdown(
            f"**{exercise.number}. {exercise.title}** (lesson {exercise.lesson}, "
            f"{exercise.minutes} min) {status}"
        )


def open_button(exercise: Exercise, label: str, where: str) -> None:
    """Draw a button that opens an exercise on its page."""
    about = f"{exercise.title}, {exercise.minutes} minutes"
    if st.button(label, key=f"{where}_{exercise.id}", help=about):
        kept.open_exercise(exercise)
        st.switch_page(FOLDER_PAGES[exercise.page])

"""The lesson that is open, the lessons that were visited, and what was predicted."""

from dataclasses import replace

import streamlit as st

from pages._ui.components.lens.document import OPENING
from pages._ui.course import Lesson, lesson_in, lessons_of
from pages._ui.settings import with_changes
from pages._ui.state.chosen import choice, choose, renew_widgets, settings
from pages._ui.state.held import close_exercise, keep_settings
from pages._ui.state.lens import LENS_PATH, set_lens
from pages._ui.state.opening import defaults
from pages._ui.state.replay import (
    PLAYER_KEY,
    TWO_MAPS_KEY,
    TWO_MAPS_PATH,
    forget_player,
    put_player,
)

PLAYER_PATHS = ("pages/1_Build_a_map.py", TWO_MAPS_PATH)
"""Pages whose maps start before the first reading in a lesson."""
ALONE = {"lesson", "teacher", "class", "plan", "projector"}
"""What a link to a lesson may say and still open it from its beginning."""


def lesson() -> Lesson | None:
    """The lesson that is open on this page; None if there is none."""
    return lesson_in(st.session_state.get("lesson", ""), st.session_state.path)


def follow_link(path: str) -> None:
    """Open the lesson that the address names, where it has just come to name it.

    Streamlit gives the query with which the page was entered until it is left, whatever
    lesson was opened or left on it since.
    """
    state = st.session_state
    asked = st.query_params.get("lesson", "")
    before, state.lesson_asked = state.get("lesson_asked"), asked
    found = lesson_in(asked, path)
    if found is None or asked == before:
        return
    # A link that opens the session and says more was made in the middle of the lesson.
    if before is None and not set(st.query_params) <= ALONE:
        state.lesson = asked
        visit(found)
    else:
        open_lesson(found)


def open_lesson(one: Lesson) -> None:
    """Open a lesson, with everything set as it begins."""
    st.session_state.lesson = str(one.number)
    visit(one)
    set_up(one)


def visit(one: Lesson) -> None:
    """Note that a lesson was opened."""
    kept = rows()
    if one.number not in kept:
        st.session_state.lessons = kept | {one.number: ""}


def set_up(one: Lesson) -> None:
    """Set everything as a lesson opens."""
    close_exercise()
    if one.drawing:
        choose(one.drawing)
    base = defaults(choice()) if one.drawing else settings()
    keep_settings(with_changes(base, one.settings))
    if one.path == LENS_PATH:
        set_lens(replace(OPENING, **one.lens))
    if one.path in PLAYER_PATHS:
        put_player(TWO_MAPS_KEY if one.path == TWO_MAPS_PATH else PLAYER_KEY, step=0)
    renew_widgets()
    forget_player()


def is_teacher() -> bool:
    """Whether the teacher's guides are shown: a link or the class page says so."""
    if st.query_params.get("teacher") == "1":
        st.session_state.teacher = True
    return st.session_state.get("teacher", False)


def toggle_teacher() -> None:
    """Show the teacher's guides, or hide them again."""
    st.session_state.teacher = not st.session_state.get("teacher", False)


def leave_lesson() -> None:
    """Close the lesson; what was set stays."""
    st.session_state.lesson = ""


# --- What was done --------------------------------------------------------------------


def rows() -> dict[int, str]:
    """What was predicted in each lesson that was visited; empty before the answer."""
    return st.session_state.get("lessons", {})


def prediction(number: int) -> str | None:
    """What was predicted in a lesson; None before."""
    return rows().get(number) or None


def keep_prediction(number: int, answer: str) -> None:
    """Store what is predicted; the first answer stays."""
    if prediction(number) is None:
        st.session_state.lessons = rows() | {number: answer}


def lessons_row() -> dict[str, dict[str, str | None]]:
    """The lessons visited and what was predicted, for a progress file."""
    return {
        str(number): {"predicted": answer or None}
        for number, answer in sorted(rows().items())
    }


def take_lessons(given: object) -> None:
    """Add the lessons of a progress; what this session did already stays."""
    mine = {number: answer for number, answer in rows().items() if answer}
    st.session_state.lessons = rows() | lessons_of(given) | mine

"""A lesson on its page, and the path of all of them with what was done."""

import contextlib
from collections.abc import Mapping

import streamlit as st
from streamlit.errors import StreamlitPageNotFoundError

from occsim.exercises import Exercise
from pages._ui import exercising, predicting, state, teaching, words
from pages._ui.course import COURSE, Lesson, lessons_on
from pages._ui.state import exercise as kept

PASSED = 2
"""Exercises of a lesson that pass it, or all that it has if these are fewer."""


def query(lesson: Lesson) -> dict[str, str]:
    """What a link to a lesson says."""
    return {"lesson": str(lesson.number)} if lesson.number else {}


def link(
    path: str,
    label: str,
    asked: Mapping[str, str] | None = None,
    icon: str | None = None,
) -> None:
    """Draw a link to a page; none where the page is run by itself, as a test may do."""
    with contextlib.suppress(StreamlitPageNotFoundError):
        st.page_link(path, label=label, query_params=asked, icon=icon)


def name(lesson: Lesson) -> str:
    """Its number, title and question."""
    point = "" if lesson.title.endswith("?") else "."
    said = f"{lesson.number}. **{lesson.title}{point}** {lesson.question}"
    return words.maths(said)


# --- On its page ----------------------------------------------------------------------


def here() -> Lesson | None:
    """The lesson that is open on this page, unless an exercise is."""
    return None if exercising.is_here() else state.lesson()


def waits() -> bool:
    """Whether the open lesson still waits for its prediction."""
    lesson = here()
    return lesson is not None and state.prediction(lesson.number) is None


def heading() -> bool:
    """Draw the open lesson in place of the page's heading; False if none is open."""
    lesson = here()
    if lesson is None:
        return False
    st.title(words.maths(lesson.full_title), anchor=False)
    with st.container(border=True, key="lesson"):
        question, text = st.columns(2, gap="large")
        with question:
            predicting.ask(lesson)
        with text:
            st.markdown(_words("See", lesson.see))
            _why(lesson)
        _ways(lesson)
    return True


def _open_button(lesson: Lesson, label: str) -> None:
    if st.button(label, key=f"open_lesson_{lesson.number}"):
        state.open_lesson(lesson)
        if lesson.path == state.path():
            st.rerun()
        st.switch_page(lesson.path)


def _why(lesson: Lesson) -> None:
    """The reason, once it was predicted what comes out."""
    if state.prediction(lesson.number):
        st.markdown(_words("Why", lesson.why))


def _words(head: str, text: str) -> str:
    return f"**{head}.** {words.maths(text)}"


def _ways(lesson: Lesson) -> None:
    """Where to go from a lesson: its exercises, further pages, the next lesson."""
    with st.container(horizontal=True, vertical_alignment="center", key="lesson_ways"):
        for exercise in exercises_of(lesson):
            exercising.open_button(exercise, f"Exercise {exercise.number}", "lesson")
        for path in lesson.further:
            link(path, _label(path), icon=":material/arrow_forward:")
        if lesson.number + 1 < len(COURSE):
            following = COURSE[lesson.number + 1]
            _open_button(following, f"Next: {following.number}. {following.title}")
        if state.is_teacher():
            _guide(lesson)
        st.button("Leave the lesson", on_click=state.leave_lesson, type="tertiary")


def _label(path: str) -> str:
    return path.rpartition("/")[2][2:].removesuffix(".py").replace("_", " ")


def _guide(lesson: Lesson) -> None:
    with st.popover("For the teacher"):
        # Its first line is the title, which stands above.
        st.markdown(words.maths(teaching.guide(lesson).partition("\n")[2]))


def beside(path: str, number: int | None = None) -> None:
    """Draw what to see, what to predict and why, where nothing else asks."""
    if here() is not None or exercising.is_here():
        return
    on_page = lessons_on(path)
    shown = [one for one in on_page if number in (None, one.number)]
    for lesson in shown:
        # The third column comes with the reason.
        n_columns = 3 if state.prediction(lesson.number) else 2
        see, predict, *why = st.columns(n_columns, gap="large")
        with see:
            st.markdown(_words("See", lesson.see))
        with predict:
            predicting.ask(lesson)
        for column in why:
            with column:
                _why(lesson)
    with st.container(horizontal=True):
        for lesson in on_page:
            _open_button(lesson, f"Open lesson {name(lesson)}")


# --- The path -------------------------------------------------------------------------


def exercises_of(lesson: Lesson) -> list[Exercise]:
    """The exercises of a lesson, in order."""
    return [one for one in state.exercises() if one.lesson == lesson.number]


def done(lesson: Lesson) -> str:
    """What was done of a lesson, in words; empty where nothing was."""
    if lesson.number not in state.lessons_visited():
        return ""
    said = ["visited"]
    if state.prediction(lesson.number):
        said.append("predicted")
    judged = [one for one in exercises_of(lesson) if not one.is_open]
    solved = sum(kept.attempt_of(one).is_solved for one in judged)
    if judged:
        said.append(f"{solved} of {len(judged)} exercises solved")
    return ", ".join(said)


def is_passed(lesson: Lesson) -> bool:
    """Whether enough of its exercises are solved; without any, it was predicted."""
    judged = [one for one in exercises_of(lesson) if not one.is_open]
    if not judged:
        return state.prediction(lesson.number) is not None
    solved = sum(kept.attempt_of(one).is_solved for one in judged)
    return solved >= min(PASSED, len(judged))


def path() -> None:
    """The ten lessons in order, each with what was done; nothing is locked."""
    for lesson in COURSE:
        what, passed = done(lesson), is_passed(lesson)
        icon = "radio_button_unchecked"
        if what:
            icon = "check_circle" if passed else "radio_button_partial"
        said = name(lesson) + (f" :small[({what})]" if what else "")
        link(lesson.path, said, query(lesson), f":material/{icon}:")
    st.caption(
        "A lesson is passed with any two of its exercises, or with the one that it has."
    )

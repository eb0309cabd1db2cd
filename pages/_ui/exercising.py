"""The panel of an exercise on its page, and the list of all of them."""

from functools import partial

import streamlit as st

from occsim.exercises import Exercise, Question
from pages._ui import state, words
from pages._ui.exercise_pages import FOLDER_PAGES, shown_option
from pages._ui.state import exercise as kept

REDRAWN = "What is hidden has been drawn anew for your next attempt."


def is_here() -> bool:
    """Whether an exercise is open on this page."""
    exercise = state.active()
    return exercise is not None and FOLDER_PAGES[exercise.page] == state.path()


def panel() -> None:
    """Draw the exercise that is open, on its page, in place of the page's heading."""
    exercise = state.active()
    if exercise is None or not is_here():
        return
    kept.watch(exercise)
    title = f"Exercise {exercise.number}: {words.prose(exercise.title)}"
    st.title(title, anchor=False)
    with st.container(border=True, key="exercise"):
        task, answer = st.columns([3, 2], gap="large")
        with task:
            st.markdown(words.prose(exercise.goal))
            _hints(exercise)
        with answer:
            if _has_predicted(exercise):
                _questions(exercise)
                _verdict(exercise)
        _buttons(exercise)


def _has_predicted(exercise: Exercise) -> bool:
    """Ask for the prediction first; it is stored and not judged."""
    question, attempt = exercise.prediction, kept.attempt_of(exercise)
    if question is None or attempt.first is not None:
        return True
    first = st.radio(
        f"**Predict.** {words.prose(question.text)}",
        question.options,
        index=None,
        format_func=lambda option: words.prose(shown_option(option)),
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
    label = words.prose(question.text)
    if question.options:
        st.selectbox(
            label,
            question.options,
            index=question.options.index(before) if before else None,
            format_func=shown_option,
            key=key,
        )
    else:
        st.number_input(label, value=before, step=0.001, format="%g", key=key)


def _hints(exercise: Exercise) -> None:
    for hint in exercise.hints[: kept.attempt_of(exercise).n_hints]:
        st.caption(f"Hint. {words.prose(hint)}")


def _verdict(exercise: Exercise) -> None:
    attempt = kept.attempt_of(exercise)
    if attempt.is_solved:
        first = (
            f" You predicted: {words.prose(shown_option(attempt.first))}."
            if attempt.first
            else ""
        )
        st.success(f"Solved.{first} {words.prose(exercise.after)}")
        return
    verdict = attempt.verdict
    if verdict is None:
        return
    if verdict.is_solved:
        st.info("That part is solved. Go on with the next.")
        return
    said = (verdict.near_miss, verdict.distance)
    again = REDRAWN if kept.is_redrawn(exercise) else ""
    found = [words.prose(text) for text in (*said, again) if text]
    st.info(" ".join(["Not yet.", *found]))


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
    with st.container(key="exercises"):
        for exercise in found:
            _row(exercise)
    _hand_in()
    _clear()


def _hand_in() -> None:
    """What the teacher collects: a file with all that was predicted and tried."""
    st.header("Hand in", anchor=False)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        name = st.text_input(
            "Your name in the file (optional)",
            max_chars=60,
            help="It stands in the file only: this server keeps no names.",
            width=320,
            **state.bind_view("hand_in_name", ""),
        )
        st.download_button(
            "Progress as a file",
            # Made when it is asked for: it has the time in it.
            lambda: kept.progress_file(name),
            file_name="progress.json",
            mime="application/json",
            on_click="ignore",
        )


def _clear() -> None:
    """For a computer that others use: what the browser keeps can be cleared."""
    st.caption(
        "This browser keeps what you predicted and solved, for when you come back. "
        "Clear it on a computer that others use."
    )
    with st.popover("Clear what this browser keeps"):
        st.markdown(
            "Every prediction, attempt and solved exercise is forgotten. Download your "
            "progress first if you want to hand it in. The random word by which this "
            "browser votes once stays."
        )
        st.button("Clear it all", type="primary", on_click=state.clear_progress)


def _row(exercise: Exercise) -> None:
    attempt = kept.attempt_of(exercise)
    status = "solved" if attempt.is_solved else "begun" if attempt.n_checks else ""
    with st.container(horizontal=True, vertical_alignment="center"):
        open_button(exercise, f"Exercise {exercise.number}", "open")
        st.markdown(
            f"**{words.prose(exercise.title)}** (lesson\u00a0{exercise.lesson}, "
            f"{exercise.minutes}\u00a0min) {status}"
        )


def open_button(exercise: Exercise, label: str, where: str) -> None:
    """Draw a button that opens an exercise on its page."""
    about = f"{exercise.title}, {exercise.minutes} minutes"
    if st.button(label, key=f"{where}_{exercise.id}", help=about):
        why_not = state.refusal(exercise)
        if why_not:
            st.error(words.plain(why_not))
            return
        kept.open_exercise(exercise)
        st.switch_page(FOLDER_PAGES[exercise.page])

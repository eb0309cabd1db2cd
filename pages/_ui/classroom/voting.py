"""Vote: a question in a room, anonymous answers, bars once the teacher shows them."""

import streamlit as st

from occsim import OccsimError
from pages._ui import shell, state, words
from pages._ui.classroom import own_files
from pages._ui.classroom.kept import typed
from pages._ui.classroom.preparing import link_to
from pages._ui.classroom.questions import questions
from pages._ui.classroom.rooms import (
    MAX_OPTION,
    MAX_OPTIONS,
    MAX_QUESTION,
    ROOM_CHARS,
    ROOMS,
    Seen,
)
from pages._ui.qr import qr_html

EVERY = "2s"
"""How often those who wait ask for news."""
OWN_QUESTION = "A question of my own"
GONE = (
    "This room is closed: by your teacher, after three hours, or by a restart of the "
    "server."
)


def section() -> None:
    """Draw the teacher's section: open a room, or the one that is open."""
    code, key = state.room()
    if key and ROOMS.is_key(code, key):
        _of_teacher(code, key)
        return
    st.markdown(
        "Ask before you show: everyone answers once, without a name, and sees the "
        "answers when you show them. A room is gone after three hours."
    )
    _open()


def student(code: str) -> None:
    """Draw a room as a student finds it."""
    seen = ROOMS.seen(code, state.voter())
    if seen is None:
        st.warning(GONE)
        st.button("Leave this room", on_click=state.enter_room, args=("",))
        return
    st.header(words.plain(seen.question), anchor=False)
    _of_student(code)
    st.button("Leave this room", on_click=state.enter_room, args=("",))


# --- The teacher ----------------------------------------------------------------------


def _open() -> None:
    ready = {one.title: one for one in questions(own_files.known())}
    title = st.selectbox(
        "Question",
        [*ready, OWN_QUESTION],
        width=480,
        **state.bind_view("vote_question", next(iter(ready))),
    )
    if title in ready:
        question, options = ready[title].text, tuple(ready[title].options.values())
        st.markdown(f"**{words.prose(question)}**")
        st.markdown("\n".join(f"- {words.prose(option)}" for option in options))
    else:
        question, options = _own_question()
    if st.button("Open a room", type="primary"):
        try:
            code, key = ROOMS.open(" ".join(question.split()), options)
        except OccsimError as error:
            shell.say_error(str(error))
            return
        state.enter_room(code, key)
        st.rerun()


def _own_question() -> tuple[str, tuple[str, ...]]:
    question = st.text_input(
        "Your question", max_chars=MAX_QUESTION, **state.bind_view("vote_text", "")
    )
    columns = st.columns(MAX_OPTIONS)
    options = []
    for i, column in enumerate(columns):
        with column:
            options.append(
                st.text_input(
                    f"Option {i + 1}",
                    max_chars=MAX_OPTION,
                    **state.bind_view(f"vote_option_{i}", ""),
                )
            )
    return question, tuple(options)


def _of_teacher(code: str, key: str) -> None:
    link = link_to(state.CLASS_PATH, {"room": code})
    left, right = st.columns([3, 2], gap="large")
    with left:
        st.header(words.plain(ROOMS.seen(code).question), anchor=False)
        _tally(code, key)
        if st.button("Close this room and ask another"):
            ROOMS.close(code, key)
            state.enter_room("")
            st.rerun()
    with right:
        st.markdown(f"## Room: {code}")
        st.html(qr_html(link, "QR code of the link to this room"))
        st.code(link, language=None, wrap_lines=True)


@st.fragment(run_every=EVERY)
def _tally(code: str, key: str) -> None:
    seen = ROOMS.seen(code)
    if seen is None:
        st.warning(GONE)
        return
    n = seen.n_answers
    st.markdown(f"## {n} {'answer' if n == 1 else 'answers'}")
    is_shown = seen.counts is not None
    st.button(
        "Hide the answers" if is_shown else "Show the answers",
        type="secondary" if is_shown else "primary",
        on_click=_show,
        args=(code, key, not is_shown),
    )
    bars(seen)


def _show(code: str, key: str, shown: bool) -> None:
    state.attempt(lambda: ROOMS.show(code, key, shown))


# --- The student ----------------------------------------------------------------------


@st.fragment(run_every=EVERY)
def _of_student(code: str) -> None:
    seen = ROOMS.seen(code, state.voter())
    if seen is None:
        st.warning(GONE)
        return
    if state.message():
        shell.say_error(state.message())
    if seen.counts is not None:
        bars(seen)
        return
    for i, option in enumerate(seen.options):
        st.button(
            words.plain(option),
            key=f"vote_{i}",
            type="primary" if i == seen.mine else "secondary",
            width="stretch",
            on_click=_answer,
            args=(code, i),
        )
    if seen.mine is not None:
        st.markdown(
            f"Your answer: **{words.plain(seen.options[seen.mine])}**. You may change "
            "it until your teacher shows the answers."
        )


def _answer(code: str, option: int) -> None:
    state.attempt(lambda: ROOMS.answer(code, state.voter(), option))


def bars(seen: Seen) -> None:
    """The answers as bars, with their numbers."""
    for option, count in zip(seen.options, seen.counts or (), strict=False):
        mine = " (yours)" if option == _mine(seen) else ""
        st.progress(
            count / max(1, seen.n_answers), text=f"{words.plain(option)}{mine}: {count}"
        )


def _mine(seen: Seen) -> str | None:
    return None if seen.mine is None else seen.options[seen.mine]


# --- The code on the home page --------------------------------------------------------


def is_room(code: str) -> bool:
    """Whether a code that was typed is that of a room, by its length."""
    return len(typed(code)) == ROOM_CHARS

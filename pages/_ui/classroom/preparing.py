"""Prepare: what the students of a class find, made from what the teacher has set."""

from typing import Any
from urllib.parse import urlencode, urljoin

import streamlit as st

from occsim.exercises import Exercise
from pages._ui import navigation, openings, shell, state, words
from pages._ui.choices import CHOICES
from pages._ui.classroom import handed_in, own_files
from pages._ui.classroom.kept import CLASSES
from pages._ui.classroom.prepared import ClassError, Prepared, packed
from pages._ui.exercise_pages import FOLDER_PAGES
from pages._ui.limits import NAMES, OF_PAGES, OUTPUTS
from pages._ui.qr import qr_html
from pages._ui.settings import TABLE

SHOW, LOCK, HIDE = "show", "lock", "hide"
MADE = "class_made"
TITLES = {page.path: page.label for page in navigation.PAGES}


def section() -> None:
    """Draw the section: the page, its controls, the link."""
    st.markdown(
        "Set a page up as your students should find it, come back here, and make a "
        "link. What you lock stays as it is, whatever a student changes in the link; "
        "what you hide stays as it is as well. An exercise keeps the controls that it "
        "needs. Maps and scores stay on the page unless you hide them."
    )
    own_files.section()
    with st.container(horizontal=True):
        exercise = _exercise()
        page = FOLDER_PAGES[exercise.page] if exercise else _page()
    hide, lock = ((), ()) if exercise else _rows(page)
    if st.button("Make the link", type="primary"):
        _make(_prepared(page, exercise, hide, lock))
    _show_made()


def _page() -> str:
    before = state.came_from()
    return st.selectbox(
        "Page that the link opens",
        list(OF_PAGES),
        format_func=TITLES.__getitem__,
        width=320,
        **state.bind_view("class_page", before if before in OF_PAGES else _first()),
    )


def _first() -> str:
    return "pages/1_Build_a_map.py"


def _rows(page: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """A row for each control; return those that are hidden, and those locked."""
    names = OF_PAGES[page]
    chosen: dict[str, str] = {}
    with st.container(key="class_controls"):
        columns = st.columns(3, gap="medium")
        for i, name in enumerate(names):
            with columns[i * len(columns) // len(names)]:
                chosen[name] = _row(name)
    return tuple(
        tuple(name for name in names if chosen[name] == wanted)
        for wanted in (HIDE, LOCK)
    )


def _row(name: str) -> str:
    options = [SHOW, HIDE] if name in OUTPUTS else [SHOW, LOCK, HIDE]
    label = f"{words.maths(NAMES[name])}{_value(name)}"
    # Never set by the program while it is on the page: rows are clicked faster than
    # the page runs, and a click during a run would be taken back.
    chosen = st.segmented_control(
        label,
        options,
        default=state.view(f"class_{name}", SHOW),
        required=True,
        width="stretch",
        key=f"class_row_{name}",
    )
    state.set_view(f"class_{name}", chosen)
    return chosen


def _value(name: str) -> str:
    """What a control stands at, where that is short."""
    value: Any = getattr(state.settings(), name, None)
    if name == "drawing":
        return f": {words.plain(state.choice())}"
    if value is None or isinstance(value, tuple):
        return ""
    if isinstance(value, bool):
        return ": on" if value else ": off"
    if isinstance(value, (int, float)):
        return f": {words.number(value, 'g')} {TABLE[name].unit}".rstrip()
    return f": {words.maths(CHOICES[value])}"


# --- Exercises ------------------------------------------------------------------------


def _exercise() -> Exercise | None:
    """The exercise that the link opens; None for a page as it is set."""
    offered = {one.id: one for one in own_files.known()}
    chosen = st.selectbox(
        "Exercise that the link opens",
        ["", *offered],
        format_func=lambda name: handed_in.title(offered[name]) if name else "none",
        width=480,
        **state.bind_view("class_exercise", ""),
    )
    return offered.get(chosen)


# --- The link -------------------------------------------------------------------------


def _prepared(
    page: str,
    exercise: Exercise | None,
    hide: tuple[str, ...],
    lock: tuple[str, ...],
) -> Prepared:
    texts = (
        openings.texts_of_exercise(exercise) if exercise else state.state_texts(page)
    )
    own = own_files.texts()
    return Prepared(page=page, texts=texts, hide=hide, lock=lock, exercises=own)


def _make(prepared: Prepared) -> None:
    try:
        state.set_view(MADE, (CLASSES.keep(prepared), prepared))
    except ClassError as error:
        shell.say_error(str(error))


def _show_made() -> None:
    made = state.view(MADE, None)
    if made is None:
        return
    code, prepared = made
    short = link_to(prepared.page, {"class": code})
    with st.container(border=True, key="class_made"):
        left, right = st.columns([3, 2], gap="large")
        with left:
            st.markdown(f"## Code: {spaced(code)}")
            st.markdown("To type on the home page, or as a link:")
            st.code(short, language=None, wrap_lines=True)
            _long_link(prepared)
        with right:
            st.html(qr_html(short, "QR code of the link to this class"))


def _long_link(prepared: Prepared) -> None:
    with st.expander("Long link, which outlives a restart of the server"):
        whole = packed(prepared)
        if whole is None:
            st.markdown("The exercises are too long for a link. Use the code.")
            return
        st.code(link_to(prepared.page, {"plan": whole}), language=None, wrap_lines=True)
    if "work" in prepared.texts:
        st.caption(
            "Your own building opens from this server only, for a day after its last "
            "change."
        )


def spaced(code: str) -> str:
    """A code in groups of four, as it is read aloud."""
    return " ".join(code[i : i + 4] for i in range(0, len(code), 4))


def link_to(page: str, query: dict[str, str]) -> str:
    """The address of a page in the browser of who is on the page of the class."""
    name = page.rpartition("/")[2].removesuffix(".py").partition("_")[2]
    return f"{urljoin(st.context.url or '', name)}?{urlencode(query)}"

"""Edits of the building of a student's own, which can be taken back; messages."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import streamlit as st

from occsim import OccsimError
from occsim.building import Building
from pages._ui.settings import decode
from pages._ui.state.chosen import OWN, building, choose

MAX_PAST = 20
"""Edits of the building that can be taken back; they share what they leave alone."""


def set_own(own: Building) -> None:
    """Keep a building of the student's own and choose it."""
    st.session_state.own = own
    choose(OWN)


def edit_building(**changes: Any) -> None:
    """Replace parts of the building; a sample becomes a building of one's own."""
    set_own(replace(building(), **changes))


def open_project(own: Building, texts: Mapping[str, str]) -> None:
    """Take over the building and the settings of a project file."""
    st.session_state.settings = decode(texts)
    set_own(own)


def attempt(action: Callable[[], None]) -> None:
    """Run an action on what the student gave; keep what they had if it fails."""
    st.session_state.message = ""
    try:
        action()
    except OccsimError as error:
        st.session_state.message = str(error)


def message() -> str:
    """What went wrong last, in one sentence; empty if nothing did."""
    return st.session_state.message


def edit(action: Callable[[], None], tag: str = "") -> None:
    """Attempt an edit of the building that can be taken back.

    Edits in a row with the same `tag`, such as the strokes on one board, are one.
    """
    state = st.session_state
    before = state.choice, state.own
    attempt(action)
    if (state.choice, state.own) == before:
        return
    past = state.get("past", ())
    if not (tag and past and past[-1][2] == tag):
        state.past = (*past, (*before, tag))[-MAX_PAST:]
    state.future = ()


def can_undo() -> bool:
    """Whether an edit of the building can be taken back."""
    return bool(st.session_state.get("past"))


def can_redo() -> bool:
    """Whether an edit that was taken back can be done again."""
    return bool(st.session_state.get("future"))


def undo() -> None:
    """Take the last edit of the building back."""
    _step("past", "future")


def redo() -> None:
    """Do the edit again that was taken back last."""
    _step("future", "past")


def _step(source: str, target: str) -> None:
    state = st.session_state
    *state[source], (name, own, tag) = state[source]
    state[target] = (*state.get(target, ()), (state.choice, state.own, tag))
    state.own = own
    choose(name)

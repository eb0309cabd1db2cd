"""The document last sent to the lens, and the student's choices in it."""

from collections.abc import Mapping
from dataclasses import replace

import streamlit as st

from pages._ui.components.lens.document import (
    OPENING,
    LensDocument,
    decode_commit,
    link_texts,
    with_texts,
)

LENS_KEY = "lens"
LENS_PATH = "pages/0_What_the_sensor_says.py"
PREFIX = "lens_"
"""Of the lens's names in a link."""


def lens_document() -> LensDocument:
    """The document that the lens starts from; the same object until it must change."""
    state = st.session_state
    if state.lens_imposed is None:
        state.lens_chosen = replace(state.lens_chosen, rev=state.lens_chosen.rev + 1)
        state.lens_imposed = state.lens_chosen
    return state.lens_imposed


def set_lens(document: LensDocument) -> None:
    """Show other choices in the lens."""
    st.session_state.lens_chosen = replace(
        document, rev=st.session_state.lens_chosen.rev
    )
    forget_lens()


def forget_lens() -> None:
    """Impose a new document at the next run."""
    st.session_state.lens_imposed = None


def take_from_lens() -> LensDocument:
    """Store the student's choices in the lens, without sending them back.

    Callbacks that judge them call it as well: they come before the page's own part, in
    the run in which the last commit arrives.
    """
    state = st.session_state
    commit = (state.get(LENS_KEY) or {}).get("committed")
    state.lens_chosen = decode_commit(commit, lens_document())
    return state.lens_chosen


def open_lens(query: Mapping[str, str]) -> list[str]:
    """Open the lens as a link says; return the names to which it gives wrong values."""
    texts = {name.removeprefix(PREFIX): text for name, text in _ours(query)}
    st.session_state.lens_chosen, wrong = with_texts(OPENING, texts)
    forget_lens()
    return [PREFIX + name for name in wrong]


def reset_lens() -> None:
    """Return to the opening; the revision goes on, so that late commits are ignored."""
    st.session_state.lens_chosen = replace(
        OPENING, rev=st.session_state.lens_chosen.rev
    )
    forget_lens()


def lens_in_link() -> dict[str, str]:
    """What a link to the lens says of it; nothing where it is as it opens."""
    if st.session_state.get("path") != LENS_PATH:
        return {}
    texts = link_texts(st.session_state.lens_chosen)
    return {PREFIX + name: text for name, text in texts.items()}


def _ours(query: Mapping[str, str]) -> list[tuple[str, str]]:
    return [(name, text) for name, text in query.items() if name.startswith(PREFIX)]

"""The document last sent to the lens, and the student's choices in it."""

from collections.abc import Mapping
from dataclasses import replace

import streamlit as st

from pages._ui.components.lens.document import (
    OPENING,
    LensDocument,
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


def take_from_lens(document: LensDocument) -> None:
    """Store the student's choices in the lens, without sending them back."""
    st.session_state.lens_chosen = document


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
    """What a link says of the lens; nothing where it is as it opens."""
    return {
        PREFIX + n: text for n, text in link_texts(st.session_state.lens_chosen).items()
    }


def _ours(query: Mapping[str, str]) -> list[tuple[str, str]]:
    return [(name, text) for name, text in query.items() if name.startswith(PREFIX)]

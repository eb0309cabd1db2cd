"""The document last sent to the lens, and the student's choices in it."""

from collections.abc import Mapping
from dataclasses import replace

import streamlit as st

from pages._ui import openings
from pages._ui.components.lens.document import (
    OPENING,
    LensDocument,
    decode_commit,
    link_texts,
    with_texts,
)
from pages._ui.state.held import active, class_now, limits

LENS_KEY = "lens"
LENS_PATH = "pages/0_What_the_sensor_says.py"
HELD_BY = {
    "range_px": "range_px",
    "fov_deg": "fov_deg",
    "behind_hit": "behind_hit",
    "clear_no_hit": "clear_no_hit",
    "rule": "rule",
    "cell_px": "lens_cell_px",
    "p_free": "p_wall",
}
"""The control that holds a field of the lens."""


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
    state.lens_chosen = _kept(decode_commit(commit, lens_document()))
    return state.lens_chosen


def open_lens(query: Mapping[str, str]) -> list[str]:
    """Open the lens as a link says; return the names to which it gives wrong values."""
    found, wrong = with_texts(OPENING, openings.lens_texts(query))
    st.session_state.lens_chosen = _kept(found)
    forget_lens()
    return [openings.LENS_PREFIX + name for name in wrong]


def _kept(document: LensDocument) -> LensDocument:
    """Put back what the exercise or the class holds."""
    held = limits().held
    exercise, prepared = active(), class_now()
    if not held.intersection(HELD_BY.values()):
        return document
    if exercise is not None:
        own = openings.lens_of_exercise(exercise)
    else:
        own = openings.lens_of_class(prepared) if prepared else OPENING
    values = {
        field: getattr(own, field) for field, name in HELD_BY.items() if name in held
    }
    return replace(document, **values)


def reset_lens() -> None:
    """Return to the opening; the revision goes on, so that late commits are ignored."""
    st.session_state.lens_chosen = replace(
        _kept(OPENING), rev=st.session_state.lens_chosen.rev
    )
    forget_lens()


def lens_in_link(path: str) -> dict[str, str]:
    """What a link to the lens says of it; nothing where it is as it opens."""
    if path != LENS_PATH:
        return {}
    texts = link_texts(st.session_state.lens_chosen)
    return {openings.LENS_PREFIX + name: text for name, text in texts.items()}

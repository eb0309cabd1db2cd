"""Your building: from a drawing of one's own to everything that a map needs."""

import streamlit as st

from pages._ui import controls, shell, state, uploads
from pages._ui.choices import SECTIONS
from pages._ui.your_building import drawing, keep, masks, scale, trajectory, walls

SHOW = (
    drawing.show,
    scale.show,
    walls.show,
    masks.correct,
    masks.truth,
    trajectory.show,
    keep.show,
)

with shell.page(state.YOUR_BUILDING) as here:
    shell.heading(here)
    shown = state.choice(), state.can_undo(), state.can_redo()

    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        with st.container(horizontal=True, width="content"):
            st.button("Undo", on_click=state.undo, disabled=not state.can_undo())
            st.button("Redo", on_click=state.redo, disabled=not state.can_redo())
        section = st.segmented_control(
            "Section",
            SECTIONS,
            required=True,
            label_visibility="collapsed",
            **state.bind_view("section", SECTIONS[0]),
        )

    notices = st.container()
    SHOW[SECTIONS.index(section)]()
    with notices:
        # At the end, so that they speak of what the section has just changed.
        if state.message():
            shell.say_error(state.message())
        uploads.pose_notice()
    if (state.choice(), state.can_undo(), state.can_redo()) != shown:
        # The first stroke on a sample made it the student's own, and can be undone: the
        # row above has to say so.
        st.rerun()

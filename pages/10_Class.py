"""A class: prepare a page for students, vote, collect what they hand in."""

import streamlit as st

from pages._ui import shell, state
from pages._ui.classroom import collecting, preparing, voting

SECTIONS = {
    "Prepare": preparing.section,
    "Vote": voting.section,
    "Collect": collecting.section,
}

with shell.page(state.CLASS_PATH) as lesson:
    code, key = state.room()
    if code and not key:
        voting.student(code)
    else:
        shell.heading(lesson)
        chosen = st.segmented_control(
            "Section",
            list(SECTIONS),
            required=True,
            label_visibility="collapsed",
            **state.bind_view("class_section", "Vote" if key else "Prepare"),
        )
        SECTIONS[chosen]()
        st.toggle(
            "Show the teacher's guide to each lesson",
            value=state.is_teacher(),
            key="teacher_guides",
            on_change=state.toggle_teacher,
        )

"""Robot data: a robot's own log of scans, mapped; and maps of ROS in and out."""

import streamlit as st

from pages._ui import shell, state
from pages._ui.robot_data import SECTIONS, registering, ros, scans

SHOW = dict(zip(SECTIONS, (scans.show, registering.show, ros.show), strict=True))

with shell.page(state.ROBOT_PATH) as here:
    shell.heading(here)
    section = st.segmented_control(
        "Section",
        SECTIONS,
        required=True,
        label_visibility="collapsed",
        **state.bind_view("robot_section", SECTIONS[0]),
    )
    SHOW[section]()

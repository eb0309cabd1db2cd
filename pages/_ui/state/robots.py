"""What the session holds of the page Robot data, beside the building."""

from dataclasses import replace
from typing import Any

import streamlit as st

from pages._ui.robot_data.work import EMPTY, RobotWork


def robot() -> RobotWork:
    """The student's log, registration and traced walls."""
    found: RobotWork = st.session_state.get("robot", EMPTY)
    return found


def edit_robot(**changes: Any) -> None:
    """Replace parts of it; called within an edit, it can be undone."""
    st.session_state.robot = replace(robot(), **changes)

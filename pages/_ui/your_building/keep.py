"""Section 7: the project file, to keep everything and to open it again."""

from functools import partial
from typing import Any

import streamlit as st

from occsim.io.project import MAX_LOG_BYTES, Project, dump_project, load_project
from pages._ui import state
from pages._ui.robot_data.work import of_project, to_project
from pages._ui.settings import encode
from pages._ui.uploads import MAX_UPLOAD_MB

KEY = "workshop_project"


def show() -> None:
    """Download and open project files."""
    left, right = st.columns(2, gap="large")
    with left:
        st.markdown(
            "**Keep.** One file with the drawing, the masks and their corrections, the "
            "ground truth, the trajectory, the scale and all settings; also a robot's "
            f"log, up to {MAX_LOG_BYTES / 1e6:.0f} MB, and the drawing's place on its "
            "map. What is here lasts for a day on this server, if it is not restarted; "
            "the file lasts longer."
        )
        building, settings = state.building(), state.settings()
        robot = to_project(state.robot(), building, settings)
        project = Project(building=building, settings=encode(settings), robot=robot)
        if state.robot().is_log_too_large:
            st.caption(
                "The robot's log is too large for the file: keep it beside, and upload "
                "it again."
            )
        st.download_button(
            "Download the project",
            partial(dump_project, project),
            file_name="building.occsim.zip",
            mime="application/zip",
            on_click="ignore",
            type="primary",
        )
    with right:
        st.markdown(
            "**Open.** A project replaces the building that is here; Undo brings it "
            "back. A damaged file is refused and changes nothing."
        )
        st.file_uploader(
            "Project file",
            ["zip"],
            key=KEY,
            on_change=_open,
            max_upload_size=MAX_UPLOAD_MB,
        )


def _open() -> None:
    file = state.value(KEY)
    if file is not None:
        state.edit(partial(_take, file))


def _take(file: Any) -> None:
    project = load_project(file.getvalue(), name=file.name)
    made = of_project(project.robot, project.building)
    state.open_project(project.building, project.settings, made)

"""Trajectory files of a student; one in metres is placed where the student says."""

import math
from dataclasses import dataclass, replace
from typing import Any

import streamlit as st

from occsim import Trajectory
from occsim.io.metric import MetricFrame
from occsim.io.trajectories import TrajectoryTable, read_trajectory_table
from pages._ui import state

UNITS = {"As the file says": None, "Degrees": True, "Radians": False}
POSES, UNIT = "pose_file", "angle_unit"
SCALE, TURN = "frame_metres_per_px", "frame_turn_deg"
CORNER = {"x": "frame_x_m", "y": "frame_y_m"}
USUAL_SCALE = 0.05
"""Metres per pixel of most maps of robots."""
FARTHEST_M = 1e6
FIELD_PX = 140
"""Width of a number, px: two stand side by side in a narrow column."""


@dataclass(frozen=True, eq=False)
class PoseFile:
    """The trajectory file that was given last, and the trajectory that it belongs to.

    That is what was read from it, or what was there when it was refused, or when it was
    not yet known where its metres lie.
    """

    name: str
    data: bytes
    trajectory: Trajectory
    in_metres: bool = False
    is_placed: bool = False

    def table(self) -> TrajectoryTable:
        """What the file says."""
        return read_trajectory_table(self.data, name=self.name)


def take(file: Any) -> None:
    """Use an uploaded file; one in metres waits until the student says where it is."""
    before = state.building().trajectory
    state.set_view(POSES, PoseFile(file.name, file.getvalue(), before))
    _read()


def ask() -> None:
    """Draw the questions that the last file leaves open."""
    st.radio(
        "Angles in the file",
        list(UNITS),
        horizontal=True,
        **state.bind_view(UNIT, "As the file says", _read),
    )
    file = _current()
    if file is not None and file.in_metres:
        _ask_frame(file.is_placed)


def _current() -> PoseFile | None:
    """The last file, unless the trajectory was changed since."""
    file = state.view(POSES, None)
    is_here = file is not None and file.trajectory is state.building().trajectory
    return file if is_here else None


def _read() -> None:
    """Read the last trajectory file, its angles in the chosen unit."""
    file = _current()
    if file is None:
        return
    table = file.table()
    if table.metres and not file.is_placed:
        state.set_view(POSES, replace(file, in_metres=True))
    else:
        _use(file, table)


def _use(file: PoseFile, table: TrajectoryTable) -> None:
    frame = _frame() if table.metres else None
    trajectory = table.to_trajectory(UNITS[state.view(UNIT, "As the file says")], frame)
    scale = {"metres_per_px": frame.metres_per_px} if frame else {}
    state.edit_building(trajectory=trajectory, **scale)
    placed = replace(
        file, trajectory=trajectory, in_metres=table.metres, is_placed=table.metres
    )
    state.set_view(POSES, placed)


def _ask_frame(is_placed: bool) -> None:
    """Ask where the drawing lies in the frame of a file in metres."""
    if is_placed:
        st.info(
            "The poses of this file in metres are placed. To place them elsewhere, "
            "change the numbers and place them again."
        )
    else:
        st.info(
            "The positions of this file are in metres, y up, and it does not say where "
            "the drawing lies. Enter its place; until then the trajectory is not "
            "changed. For a robot's map, the map file has these numbers (resolution "
            "and origin)."
        )
    _ask_scale()
    with st.container(horizontal=True):
        for axis, name in CORNER.items():
            st.number_input(
                f"Corner {axis} (m)",
                -FARTHEST_M,
                FARTHEST_M,
                step=0.5,
                width=FIELD_PX,
                help="Of the drawing's lower left corner in the frame of the file.",
                **state.bind_view(name, 0.0),
            )
        st.number_input(
            "Turned (degrees)",
            -180.0,
            180.0,
            width=FIELD_PX,
            help="By how much the drawing is turned to the left about that corner.",
            **state.bind_view(TURN, 0.0),
        )
    st.button("Place the poses", on_click=state.edit, args=(_place,))


def _ask_scale() -> None:
    """Ask for the scale of a drawing that has none; else say it."""
    known = state.building().metres_per_px
    if known is not None:
        st.caption(
            f"Scale of the drawing: {known:.4g} m per pixel (Your building, 2 Scale)."
        )
        return
    st.number_input(
        "Metres per pixel",
        0.0001,
        10.0,
        step=0.01,
        format="%.4f",
        help="It becomes the scale of the drawing.",
        **state.bind_view(SCALE, USUAL_SCALE),
    )


def _place() -> None:
    file = _current()
    if file is not None and file.in_metres:
        _use(file, file.table())


def _frame() -> MetricFrame:
    """Where the drawing lies, as the student said."""
    building = state.building()
    x_m, y_m = (float(state.view(name, 0.0)) for name in CORNER.values())
    return MetricFrame(
        height_px=building.drawing.shape[0],
        metres_per_px=building.metres_per_px or float(state.view(SCALE, USUAL_SCALE)),
        origin_x_m=x_m,
        origin_y_m=y_m,
        origin_yaw_rad=math.radians(state.view(TURN, 0.0)),
    )

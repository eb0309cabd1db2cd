"""Section 2: two clicks across a door give the sensor's range and the scale."""

import math
from dataclasses import replace

import streamlit as st

from occsim.building import DOOR_WIDTH_M
from pages._ui import state
from pages._ui.components.board import BoardMode, BoardPoint
from pages._ui.settings import TABLE
from pages._ui.your_building import drawn, lengths

KEY = "board_door"
WIDTH = "door_width_m"


def show() -> None:
    """Measure a door."""
    left, right = st.columns([4, 1])
    with left:
        drawn.points_board(KEY, BoardMode.MEASURE, _take)
    with right:
        st.markdown(
            "Click on both ends of a door's opening. The source sets the sensor's "
            "range to the length of a door; its width in metres gives the scale."
        )
        st.number_input(
            "Width of the door (m)",
            0.3,
            5.0,
            step=0.05,
            help="0.9 m is a usual door between rooms.",
            **state.bind_view(WIDTH, DOOR_WIDTH_M, _rescale),
        )
        _facts()


def _take(ends: tuple[BoardPoint, ...]) -> None:
    """Set range and scale by the door between two points."""
    door_px = math.dist(*((end.x_px, end.y_px) for end in ends)) if ends else 0.0
    if not door_px:
        return
    state.edit_building(
        door_px=door_px,
        metres_per_px=_width_m() / door_px,
        sensor=replace(state.building().sensor, range_px=door_px),
    )
    state.set_range_to_door()


def _width_m() -> float:
    return float(state.view(WIDTH, DOOR_WIDTH_M))


def _rescale() -> None:
    door_px = state.building().door_px
    if door_px is not None:
        state.edit_building(metres_per_px=_width_m() / door_px)


def _forget() -> None:
    state.edit_building(door_px=None, metres_per_px=None)


def _facts() -> None:
    building = state.building()
    if building.door_px is None or building.metres_per_px is None:
        st.info(
            "No door measured yet: lengths are in pixels only. The range, "
            f"{building.sensor.range_px:.0f} px, is the length of a door as proposed "
            "from the drawing's doors or the thickness of its walls."
        )
        return
    st.markdown(
        f"Door **{lengths.length(building.door_px)}**  \n"
        f"One pixel **{1000 * building.metres_per_px:.1f} mm**  \n"
        f"Drawing **{lengths.size()}**  \n"
        f"Range **{lengths.length(state.settings().range_px)}**  \n"
        f"Cell **{lengths.length(state.settings().cell_px)}**"
    )
    bounds = TABLE["range_px"]
    if not bounds.low <= building.door_px <= bounds.high:
        st.warning(
            f"The range goes from {bounds.low} to {bounds.high} px, so it is not the "
            "door's length."
        )
    st.button("Forget the scale", on_click=state.edit, args=(_forget,), width="stretch")

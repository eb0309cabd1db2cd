"""Section 1: the drawing, brought into shape."""

import math
from functools import partial

import streamlit as st

from occsim.imaging.transform import Transform
from pages._ui import state, uploads, words
from pages._ui.components.board import BoardMode, BoardPoint
from pages._ui.robot_data import ros
from pages._ui.your_building import detecting, drawn, lengths

KEY = "board_crop"
LEAST_TILT_RAD = math.radians(0.15)
"""Smaller tilts move the end of a long wall by less than its thickness."""


def show() -> None:
    """Take a drawing, turn it, crop it."""
    left, right = st.columns([4, 1])
    with left:
        corners = drawn.points_board(KEY, BoardMode.CROP)
    with right:
        uploads.drawing("workshop_drawing")
        with st.popover("A robot's map (ROS)", width="stretch"):
            ros.panel()
        st.select_slider(
            "Working size (px)",
            [500, 750, 1000, 1250, 1500, 2000, 2500, 3000],
            help="Longer side to which larger drawings are scaled down when they "
            "are uploaded. More pixels show thinner walls and take longer.",
            **state.bind_view(uploads.WORKING, uploads.WORKING_PX),
        )
        st.caption(f"{lengths.size()}. {words.plain(state.building().about)}")
        with st.container(horizontal=True):
            st.button("Turn left", on_click=state.edit, args=(partial(_turn, -1),))
            st.button("Turn right", on_click=state.edit, args=(partial(_turn, 1),))
        _tilt()
        st.button(
            "Crop to the rectangle",
            on_click=state.edit,
            args=(partial(_crop, corners),),
            disabled=len(corners) < 2,
            width="stretch",
        )


def _tilt() -> None:
    tilt_rad = detecting.tilt(state.building().drawing)
    is_tilted = tilt_rad is not None and abs(tilt_rad) >= LEAST_TILT_RAD
    label = "No tilt found"
    if tilt_rad is not None and is_tilted:
        label = f"Straighten by {math.degrees(-tilt_rad):.1f}°"
    st.button(
        label,
        on_click=state.edit,
        args=(partial(_straighten, tilt_rad),),
        disabled=not is_tilted,
        width="stretch",
    )


def _reshape(transform: Transform) -> None:
    state.set_own(detecting.reshaped(state.building(), transform))


def _turn(quarters: int) -> None:
    _reshape(Transform.quarter_turns(_shape(), quarters))


def _straighten(tilt_rad: float) -> None:
    _reshape(Transform.straighten(_shape(), tilt_rad))


def _crop(corners: tuple[BoardPoint, ...]) -> None:
    (x0, x1), (y0, y1) = (
        sorted(round(value) for value in values)
        for values in (
            (corner.x_px for corner in corners),
            (corner.y_px for corner in corners),
        )
    )
    _reshape(Transform.crop(_shape(), x0, y0, x1 - x0, y1 - y0))


def _shape() -> tuple[int, int]:
    return state.building().drawing.shape

"""What a student brings: a drawing, a ground truth, a trajectory.

Every upload is checked before anything is kept; what is refused changes nothing.
"""

from typing import Any

import streamlit as st

from occsim import Trajectory, load_drawing, load_trajectory
from occsim.building import CorrectedMask
from occsim.tour import default_tour
from occsim.world import world_from_image
from pages._ui import compute, state

IMAGE_TYPES = ["png", "jpg", "jpeg", "pgm", "bmp", "tif", "tiff", "webp"]
TRAJECTORY_TYPES = ["csv", "txt"]
MAX_UPLOAD_MB = 40
UNITS = {"As the file says": None, "Degrees": True, "Radians": False}


def panel() -> None:
    """Draw the three uploads and what they need to be told."""
    _uploader("Drawing", "own_drawing", IMAGE_TYPES, _take_drawing)
    st.caption(
        "PNG or JPEG, up to 40 megapixels. Walls are detected and a tour of the free "
        "space is planned, so that the drawing can be mapped at once."
    )
    _uploader("Ground truth", "own_truth", IMAGE_TYPES, _take_truth)
    st.caption(
        "An image of the same size: black is wall, white is free. Without one the "
        "detected walls serve as the world."
    )
    _uploader("Trajectory", "own_trajectory", TRAJECTORY_TYPES, _take_trajectory)
    st.radio(
        "Angles in the file",
        list(UNITS),
        key="own_unit",
        horizontal=True,
        on_change=_take_trajectory,
    )
    st.caption("CSV or plain text with x, y, theta in each row; x and y in pixels.")


def _uploader(label: str, key: str, types: list[str], take: Any) -> None:
    st.file_uploader(
        label, types, key=key, on_change=take, max_upload_size=MAX_UPLOAD_MB
    )


def _take_drawing() -> None:
    file = state.value("own_drawing")
    if file is not None:
        state.attempt(lambda: _map_drawing(file))


def _map_drawing(file: Any) -> None:
    drawing = load_drawing(file.getvalue(), name=file.name)
    state.set_own(compute.own_building(drawing, state.settings().sensor))


def _take_truth() -> None:
    file = state.value("own_truth")
    if file is not None:
        state.attempt(lambda: _use_truth(file))


def _use_truth(file: Any) -> None:
    drawing = load_drawing(file.getvalue(), name=file.name)
    world = world_from_image(drawing)
    state.edit_building(truth=CorrectedMask(world.occupied))


def _take_trajectory() -> None:
    file = state.value("own_trajectory")
    if file is not None:
        state.attempt(lambda: _use_trajectory(file))


def _use_trajectory(file: Any) -> None:
    unit = UNITS[state.value("own_unit")]
    state.edit_building(
        trajectory=load_trajectory(file.getvalue(), name=file.name, degrees=unit)
    )


def pose_notice() -> None:
    """Say how many poses cannot be real, and offer to drop them."""
    building = state.building()
    n_bad = building.n_outside + building.n_inside_walls
    if not n_bad:
        return
    with st.container(horizontal=True, vertical_alignment="center"):
        st.warning(
            f"{building.n_outside} of {len(building.trajectory)} poses lie outside the "
            f"drawing and {building.n_inside_walls} stand in walls."
        )
        st.button("Drop them", on_click=state.attempt, args=(_drop_poses,))


def _drop_poses() -> None:
    state.edit_building(trajectory=state.building().valid_trajectory())


def plan_tour() -> Trajectory:
    """A tour of the free space of the building that is mapped."""
    return default_tour(state.building().world, state.settings().sensor)

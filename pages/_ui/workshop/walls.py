"""Section 3: wall detection, stage by stage."""

from dataclasses import replace
from functools import partial

import streamlit as st

import occsim.walls
from occsim.building import CorrectedMask
from occsim.walls import Slider, WallParams
from pages._ui import compute, state
from pages._ui.workshop import masks

COLUMNS = 4
STAGE_NOTES = getattr(occsim.walls, "STAGE_NOTES", {})


def show() -> None:
    """Show every stage with its sentence and its sliders."""
    building = state.building()
    stages = compute.stage_pictures(building.drawing, building.wall_params)
    pictures = [(title, image, True) for title, image in stages]
    if building.truth is not None:
        pictures.append(("Against the ground truth", masks.error_picture(), False))
    for start in range(0, len(pictures), COLUMNS):
        row = pictures[start : start + COLUMNS]
        columns = st.columns(COLUMNS, gap="medium")
        for column, (title, image, is_stage) in zip(columns, row, strict=False):
            with column:
                st.image(image, width="stretch")
                st.markdown(f"**{title}**")
                if is_stage:
                    _stage(title)
                else:
                    _errors()
    st.button(
        "Automatic settings",
        on_click=state.edit,
        args=(partial(_detect, WallParams()),),
        disabled=building.wall_params == WallParams(),
    )


def _stage(title: str) -> None:
    if title not in STAGE_NOTES:
        return
    note = STAGE_NOTES[title]
    st.caption(note.sentence)
    for slider in note.sliders:
        _slider(slider)


def _slider(slider: Slider) -> None:
    """Draw the slider of a parameter; 0 leaves its value to the program."""
    value = getattr(state.building().wall_params, slider.field)
    if isinstance(value, bool):
        st.toggle(slider.label, **state.bind_wall(slider.field, _change))
        return
    is_automatic = getattr(WallParams(), slider.field) == 0 == slider.low
    st.slider(
        slider.label + (" (0: automatic)" if is_automatic else ""),
        float(slider.low),
        float(slider.high),
        step=float(slider.step),
        **state.bind_wall(slider.field, _change),
    )


def _errors() -> None:
    st.caption(
        "Black: found. Orange: false wall. Blue: missed wall. Both within 2 px of "
        "tolerance."
    )
    masks.agreement()


def _detect(params: WallParams) -> None:
    building = state.building()
    found = compute.detection(building.drawing, params)
    state.edit_building(
        walls=CorrectedMask(found.mask, building.walls.strokes), wall_params=params
    )


def _change(field: str, value: float | bool) -> None:
    """Find the walls again with one parameter changed; corrections stay."""
    _detect(replace(state.building().wall_params, **{field: value}))

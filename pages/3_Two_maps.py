"""Two maps: the same readings, another drawing, prior or rule in each."""

import streamlit as st

from occsim import OccsimError
from pages._ui import (
    beams_lesson,
    controls,
    lessons,
    limits,
    noise_lesson,
    replays,
    sensing,
    shell,
    state,
    uploads,
)
from pages._ui.components.player import Replay, map_player
from pages._ui.examples import examples
from pages._ui.settings import Settings

PATH = "pages/3_Two_maps.py"


def _controls() -> None:
    with st.container(horizontal=True, vertical_alignment="bottom", key="map_controls"):
        controls.drawing_choice()
        for name in ("range_px", "fov_deg"):
            controls.slider(name, width=controls.NARROW_PX)
        sensing.sensor_errors(st.popover)


def _replay() -> Replay:
    """What the maps need; the opening's where they ask for too much."""
    building, settings = state.building(), state.settings()
    try:
        return replays.replay_of(building, settings, settings.columns)
    except OccsimError as error:
        shell.say_error(str(error))
        state.change(columns=Settings().columns)
        return replays.replay_of(building, settings, Settings().columns)


with shell.page(PATH) as here:
    shell.heading(here)
    _controls()
    if state.message():
        shell.say_error(state.message())
    uploads.pose_notice()
    shell.truth_notice()
    key = state.TWO_MAPS_KEY
    state.take_from_player(key)
    state.fit_columns()
    replay, lesson = _replay(), lessons.here()
    map_player(
        replay,
        state.player_document(key),
        key=key,
        held=state.parts_held(key),
        examples=examples(replay.drawings, lesson and lesson.number),
        asks=lesson is None,
        limits=state.limits_of(limits.OF_SEVERAL),
    )
    with st.container(key="map_words"):
        lessons.beside(PATH, number=5)
        noise_lesson.section()
        beams_lesson.section()

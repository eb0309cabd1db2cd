"""Two maps, one clock: the same readings, another drawing, prior or rule in each."""

import streamlit as st

from occsim import OccsimError
from pages._ui import controls, limits, replays, sensing, shell, state, uploads
from pages._ui.components.player import Replay, map_player
from pages._ui.examples import examples
from pages._ui.settings import Settings


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


def _words() -> None:
    with st.container(key="map_words"):
        see, predict, why = st.columns(3, gap="large")
    with see:
        st.markdown(
            "**See.** All maps take the same readings at the same time, and unseen "
            "cells are hatched. Where two maps judge a cell differently, the last "
            "picture shows which of them is right; click a count to look at the next "
            "such cell, reading by reading."
        )
    with predict:
        st.markdown(
            "**Predict.** With the right drawing counted once, in cells of 3 px, the "
            "robot finds more of the walls that it looks at than without one. What if "
            "the same drawing is taken off at every reading?"
        )
        with st.expander("And then?"):
            st.markdown(
                "It finds fewer walls than a robot without a drawing, on all five "
                "reference drawings as they open. Where the two rules judge a "
                "looked-at cell differently, counting once is right at least nine "
                "times in ten."
            )
    with why:
        st.markdown(
            "**Why.** The readings were set for a cell about which nothing is known, "
            "so nothing of the drawing is in them to take off. Taken off at the first "
            "look, the drawing is gone; at the second, its opposite is there. Pin a "
            "cell with two readings and follow its two ladders."
        )


with shell.page("pages/3_Two_maps.py") as lesson:
    shell.heading(lesson)
    _controls()
    if state.message():
        shell.say_error(state.message())
    uploads.pose_notice()
    shell.truth_notice()
    key = state.TWO_MAPS_KEY
    state.take_from_player(key)
    state.fit_columns()
    replay = _replay()
    map_player(
        replay,
        state.player_document(key),
        key=key,
        held=state.parts_held(key),
        examples=examples(replay.drawings),
        limits=state.limits_of(limits.OF_SEVERAL),
    )
    _words()

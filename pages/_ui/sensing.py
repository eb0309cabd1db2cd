"""The group in which the sensor gets beams and errors."""

from collections.abc import Callable
from typing import Any

import streamlit as st

from occsim.scan import RANGE_FINDERS
from pages._ui import controls, finders, state
from pages._ui.settings import Settings

SEED = "noise_seed"


def sensor_errors(box: Callable[[str], Any]) -> None:
    """Draw the group in a box whose label says whether readings are exact."""
    if not [name for name in (*finders.OF_ERRORS, SEED) if controls.shown(name)]:
        return
    settings = state.settings()
    is_on = settings.scan is not None
    with box(f"Sensor's beams and errors{': on' if is_on else ''}"):
        st.caption(
            "By default every pixel in view is read, without error. Here the sensor "
            "measures along beams, as a robot's does, and has errors. The path shows "
            "the true poses; readings enter the map at the believed poses."
        )
        left, right = st.columns(2, gap="medium")
        with left:
            _finder(settings)
            for name in finders.OF_READINGS:
                controls.slider(name)
        with right:
            for name in finders.OF_POSES:
                controls.slider(name)
            if settings.noise is not None:
                controls.number(SEED)
            st.button(
                "Exact readings",
                on_click=state.change,
                kwargs={name: getattr(Settings(), name) for name in finders.OF_ERRORS},
                disabled=not is_on,
            )
            if settings.noise is not None and not settings.beams:
                st.caption(
                    f"With errors the sensor takes {settings.dense_beams} beams: "
                    "neighbours are at most a pixel apart at full range."
                )


def _finder(settings: Settings) -> None:
    """Draw the choice of a range finder, which sets range, view, beams and noise."""
    held = state.limits().held
    st.selectbox(
        "Range finder",
        finders.NAMES,
        index=None,
        format_func=finders.title,
        placeholder="As set below",
        help="Sets range, field of view, beams and range noise to the figures of a "
        "maker's sheet, and says nothing of what lies behind a hit.",
        disabled=bool(held.intersection((*finders.OF_SENSOR, *finders.OF_ERRORS))),
        **state.bind_finder(),
    )
    scale = state.building().likely_metres_per_px
    name = finders.current(settings, state.defaults(state.choice()), scale)
    if name in RANGE_FINDERS:
        note = finders.reach_note(name, scale)
        st.caption(f"{RANGE_FINDERS[name].source}. {note}")

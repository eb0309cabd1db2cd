"""Build a map: a drawing, a robot, and the map that grows as it drives."""

from functools import partial

import streamlit as st

from pages._ui import (
    controls,
    lessons,
    limits,
    replays,
    sensing,
    shell,
    state,
    uploads,
    words,
)
from pages._ui.components.player import map_player

PATH = "pages/1_Build_a_map.py"
EQUATIONS = r"""
A reading says of a cell (Eq. 4.22), with $q$ the share of its pixels in view that lie
before the wall: $p_\text{free}(z_k) = 0.9$ if $q = 1$, $0.1$ if $q = 0$, else $q$, kept
within $[0.1, 0.9]$. In log-odds, $l = \ln \frac{p_\text{free}}{1 - p_\text{free}}$,
readings add up. They start from the prior, $l_0$, with
$p_\text{free} = 0.9\,p_\text{wall}$ on wall cells and $0.9\,p_\text{space}$ elsewhere:

$$l_k = l_{k-1} + \operatorname{logit} p_\text{free}(z_k)$$

This counts the drawing once. It is Bayes' rule for these readings: 0.9 and 0.1 were set
for a cell about which nothing is known, so they contain nothing of the drawing to
subtract. *Probabilistic Robotics*, Table 9.1, subtracts $l_0$ at each reading, because
its readings contain the prior; the source, as we reconstruct it, did so with the
drawing's $l_0$. A cell is declared occupied where $p_\text{free} < 0.5$.
"""
LIMITS = """
The world is flat: stairs are floor and glass is wall. Unless *More settings*, *Sensor's
beams and errors* says otherwise, poses are known exactly and the sensor has no noise.
The prior comes from image processing of the drawing, and contains its errors.
"""


def _controls() -> None:
    with st.container(horizontal=True, vertical_alignment="bottom", key="map_controls"):
        controls.drawing_choice()
        for name in ("cell_px", "range_px", "fov_deg"):
            controls.slider(name, width=controls.NARROW_PX)
        controls.drawing_errors()
        controls.more(
            *("presets", "behind_hit", "clear_no_hit", "wall_share", "truth_share"),
            also=partial(sensing.sensor_errors, st.expander),
        )
        if not state.limits().drawing:
            with st.popover("Upload"):
                uploads.panel()


def _notices() -> None:
    if state.message():
        shell.say_error(state.message())
    uploads.pose_notice()
    building = state.building()
    if not building.world.occupied.any():
        st.info(
            "There is no wall to map: the ground truth has none, or none was given "
            "and none was found in the drawing. Precision and recall are undefined."
        )
    shell.truth_notice()


def _words() -> None:
    with st.container(key="map_words"):
        lessons.beside(PATH)
        equations, limits = st.columns(2, gap="large")
        with equations, st.expander("The equations"):
            st.markdown(EQUATIONS)
            st.caption(words.SOURCE)
        with limits, st.expander("What this model leaves out"):
            st.markdown(LIMITS)


with shell.page(PATH) as here:
    shell.heading(here)
    _controls()
    _notices()
    key = state.PLAYER_KEY
    state.take_from_player(key)
    settings = state.settings()
    map_player(
        replays.replay(state.building(), settings),
        state.player_document(key),
        key=key,
        held=state.parts_held(key),
        fixed=settings.page_choices
        | {"drawing_errors": controls.errors_words(settings)},
        limits=state.limits_of(limits.OF_ONE_MAP),
    )
    _words()

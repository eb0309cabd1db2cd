"""Build a map: a drawing, a robot, and the map that grows as it drives."""

import streamlit as st

from pages._ui import compute, controls, shell, state, uploads
from pages._ui.components.player import map_player

EQUATIONS = r"""
A reading says of a cell (Eq. 4.22), with $q$ the share of its pixels in view that lie
before the wall: $p_{free}(z_k) = 0.9$ if $q = 1$, $0.1$ if $q = 0$, else $q$, kept
within $[0.1, 0.9]$. In log-odds, $l = \ln \frac{p_{free}}{1 - p_{free}}$, it adds up
(*Probabilistic Robotics*, Table 9.1):

$$l_k = l_{k-1} + \operatorname{logit} p_{free}(z_k) - l_0$$

with $l_0$ the log-odds of the prior, $p_{free} = 0.9\,p_{wall}$ on wall cells and
$0.9\,p_{space}$ elsewhere. *Prior once* leaves out the last term. A cell is declared
occupied where $p_{free} < 0.5$.
"""
LIMITS = """
Poses are known exactly, the sensor has no noise and sees a flat world: stairs are floor
and glass is wall. The prior is what image processing finds in the drawing, so it errs
as such a program does.
"""

lesson = shell.begin("pages/1_Build_a_map.py")
shell.heading(lesson)

with st.container(horizontal=True, vertical_alignment="bottom"):
    controls.drawing_choice()
    for name in ("cell_px", "range_px", "fov_deg"):
        controls.slider(name, width=controls.NARROW_PX)
    with st.popover("More settings"):
        controls.radio("behind_hit")
        controls.toggle("clear_no_hit")
        controls.slider("wall_share")
        controls.slider("truth_share")
    with st.popover("Your own drawing"):
        uploads.panel()

if state.message():
    st.error(state.message())
uploads.pose_notice()

building, settings = state.building(), state.settings()
if not building.world.occupied.any():
    st.info(
        "There is no wall to map: the ground truth has none, or none was given and "
        "none was found in the drawing. Precision and recall are undefined."
    )
elif building.truth is None:
    st.info(
        "No ground truth was given: the walls detected in the drawing serve as the "
        "world, so the prior is right everywhere."
    )
with shell.explained():
    replay = compute.replay(building, settings.mapping)
    state.take_from_player(
        map_player(replay, state.player_document(), key=state.PLAYER_KEY)
    )

see, tell, why = st.columns(3, gap="large")
with see:
    st.markdown(
        "**See.** The map starts as the drawing says and each reading overwrites a "
        "cone of it. Where a shelf, a step or a railing was taken for a wall, the "
        "prior is wrong; show the *Errors* and watch what the readings make of it."
    )
with tell:
    st.markdown(
        "**Tell before you try.** Set p_wall to 1, as if the drawing's walls were free "
        "space: will recall rise or fall?"
    )
    with st.expander("And then?"):
        st.markdown(
            "It rises. With *subtract prior* each reading takes the prior off again, "
            "so from the second on it pushes a cell *away* from its prior: a wall that "
            "was called free with confidence ends as occupied. Switch to *prior once*, "
            "and recall falls."
        )
with why:
    with st.expander("Why: the equations"):
        st.markdown(EQUATIONS)
    with st.expander("What this model leaves out"):
        st.markdown(LIMITS)
controls.ending()

"""Best prior: drawing, walls, evidence, front, recommended pair, prior map."""

import streamlit as st

from pages._ui import compute, controls, shell, state
from pages._ui.priors import guiding

with shell.page("pages/7_Best_prior.py") as lesson:
    shell.heading(lesson)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        controls.slider("cell_px", width=controls.NARROW_PX)
        controls.slider("min_recall", width=controls.NARROW_PX)
        controls.segments("handover")
        controls.select("rule", width=190)

    run = compute.run(state.building(), state.settings())
    if run.notice:
        st.warning(run.notice)
    prior = guiding.handed_over(run)

    first, second, third = st.columns(3, gap="medium")
    with first:
        guiding.drawing(run)
    with second:
        guiding.walls(run)
    with third:
        guiding.evidence(run)
    fourth, fifth, sixth = st.columns(3, gap="medium")
    with fourth:
        guiding.front(run)
    with fifth:
        guiding.best_map(run, prior)
    with sixth:
        guiding.prior_map(run, prior)
    guiding.cost(run, prior)

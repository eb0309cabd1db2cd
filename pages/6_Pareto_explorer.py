"""Pareto explorer: the best compromises of precision and recall, and their maps."""

import streamlit as st

from pages._ui import compute, controls, lessons, shell, state
from pages._ui.choices import Exploring
from pages._ui.priors import comparing, exploring, marks, searching

PATH = "pages/6_Pareto_explorer.py"

with shell.page(PATH) as here:
    shell.heading(here)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        controls.slider("cell_px", width=controls.NARROW_PX)
        controls.segments("exploring")
        controls.drawing_errors()
        controls.more(
            *("presets", "behind_hit", "region"),
            *("range_px", "fov_deg", "wall_share", "truth_share"),
        )

    is_one = state.settings().exploring is Exploring.ONE
    level = "center" if is_one else "bottom"  # a choice has its label above it
    with st.container(horizontal=True, vertical_alignment=level):
        controls.thinning()
        if not is_one:
            controls.select("rule", width=320)
        if state.settings().exploring is not Exploring.SEARCH:
            marks.legend()

    run = compute.run(state.building(), state.settings())
    if run.notice:
        st.warning(run.notice)
    shell.truth_notice()
    views = {
        Exploring.ONE: exploring.one_drawing,
        Exploring.SEARCH: searching.search,
        Exploring.ALL: comparing.all_drawings,
    }
    views[state.settings().exploring](run)
    if is_one:
        lessons.beside(PATH)

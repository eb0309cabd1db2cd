"""Sweep the priors: precision and recall of every pair of prior values."""

import streamlit as st

from pages._ui import compute, controls, shell, state
from pages._ui.choices import Drawings, Surface
from pages._ui.priors import marks, sweeping

with shell.page("pages/5_Sweep_the_priors.py") as here:
    shell.heading(here)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        controls.slider("cell_px", width=controls.NARROW_PX)
        controls.segments("surface")
        controls.segments("drawings")
        controls.drawing_errors()
        is_fine = state.settings().surface is not Surface.SOURCE
        controls.more(
            *("presets", *(("fineness",) if is_fine else ()), "region", "behind_hit"),
            *("range_px", "fov_deg", "wall_share", "truth_share"),
        )

    is_all = state.settings().drawings is Drawings.ALL
    level = "bottom" if is_all else "center"  # a choice has its label above it
    with st.container(horizontal=True, vertical_alignment=level):
        controls.thinning()
        if is_all:
            controls.select("rule", width=320)
            marks.legend()
        else:
            marks.legend(sweeping.EXTRA.get(state.settings().surface))

    run = compute.run(state.building(), state.settings())
    if run.notice:
        st.warning(run.notice)
    shell.truth_notice()
    if is_all:
        sweeping.all_drawings()
    else:
        sweeping.one_drawing(run)
        sweeping.sizes(run)

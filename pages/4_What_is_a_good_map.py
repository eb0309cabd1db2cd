"""What is a good map: four counts of cells, and the two shares made of them."""

import streamlit as st

from pages._ui import compute, controls, counting, lessons, shell, state

PATH = "pages/4_What_is_a_good_map.py"

with shell.page(PATH) as here:
    shell.heading(here)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        for name in ("cell_px", "range_px", "fov_deg"):
            controls.slider(name, width=controls.NARROW_PX)
        controls.toggle("uninformative")
        with st.popover("More settings"):
            for name in ("p_wall", "p_space"):
                controls.slider(name)
            for name in ("rule", "behind_hit"):
                controls.radio(name)
            for name in ("wall_share", "truth_share"):
                controls.slider(name)

    shell.truth_notice()
    building, settings = state.building(), state.settings()
    counting.counts(compute.with_errors(building, settings), settings)
    lessons.beside(PATH)

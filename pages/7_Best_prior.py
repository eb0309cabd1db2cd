"""Best prior: what the drawing and the readings say, and four answers side by side."""

import streamlit as st

from pages._ui import compute, controls, shell, state
from pages._ui.priors import answers, guiding, triptych

with shell.page("pages/7_Best_prior.py") as here:
    shell.heading(here)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.drawing_choice()
        controls.slider("cell_px", width=controls.NARROW_PX)
        controls.slider("min_recall", width=controls.NARROW_PX)
        controls.drawing_errors()
        controls.more(
            *("presets", "rule", "behind_hit"),
            *("range_px", "fov_deg", "wall_share", "truth_share"),
        )

    run = compute.run(state.building(), state.settings())
    if run.notice:
        st.warning(run.notice)
    given = answers.all_answers(run)

    steps = (guiding.drawing, guiding.walls, guiding.evidence)
    columns = st.columns(4, gap="medium")
    for step, column in zip(steps, columns, strict=False):
        with column:
            step(run)
    with columns[-1]:
        guiding.front(run, given)

    guiding.head(5, "Which prior is best? It depends on the question")
    for one, column in zip(given, st.columns(len(given), gap="medium"), strict=True):
        with column:
            guiding.answer(run, one)
    st.markdown(guiding.scores_table(run, given), unsafe_allow_html=True)
    triptych.triptych(run)
    guiding.head(6, "Hand over the prior map")
    controls.segments("handover")
    guiding.hand_over(run, answers.handed_over(given))
    guiding.head(7, "Does it hold elsewhere?")
    guiding.transfer(run, given)

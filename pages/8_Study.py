"""Study: all drawings at all cell sizes, beside the published tables."""

import streamlit as st

from pages._ui import controls, lessons, shell
from pages._ui.priors import claiming, studying

PATH = "pages/8_Study.py"

with shell.page(PATH) as here:
    shell.heading(here)
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.select("study_rule", width=480)
        controls.select("region", width=190)
        controls.select("behind_hit", width=270)
        controls.more("wall_share", "truth_share", "min_recall")

    shell.truth_notice()
    cases = studying.run_all()
    studying.findings(cases)
    studying.tables(cases)
    studying.all_fronts(cases)
    studying.downloads(cases)
    claiming.section(studying.drawings())
    lessons.beside(PATH)

"""The parts of the page "Study"."""

import json
from dataclasses import replace

import streamlit as st

from occsim import Building, Objective, OccsimError, sample_names
from occsim.study import (
    StudyCase,
    StudySettings,
    case_settings,
    fronts_csv,
    maxima_csv,
    maxima_table,
    pattern_text,
    sweeps_csv,
)
from occsim.study.published import SOURCE_CELLS_PX
from pages._ui import compute, shell, state, words
from pages._ui.controls import chart
from pages._ui.priors import front_figures, solving

TITLES = {
    Objective.PRECISION: "Table 4.1: highest precision",
    Objective.RECALL: "Table 4.2: highest recall",
}
COLUMNS = {
    "cells": "cells, px",
    "drawing": "drawing",
    "ours": "ours, %",
    "ours_at": words.maths("at (p_wall, p_space)"),
    "published": "published, %",
    "published_at": "published at",
}
PRINTED = (
    "In the source's tables recall peaks with p_space = 1 in 12 of 15 cases, precision "
    "with p_space from 0.3 to 0.6, and no pair has both."
)
OWN_NAME = "yours"


def settings() -> StudySettings:
    """The settings of the app that concern all cases."""
    chosen = state.settings()
    return StudySettings(
        rule=chosen.study_rule,
        region=chosen.region,
        behind_hit=chosen.behind_hit,
        wall_share=chosen.wall_share,
        truth_share=chosen.truth_share,
    )


def drawings() -> list[Building]:
    """The reference drawings with their own sensors, and the student's own if any."""
    all_of_them = [compute.sample(name) for name in sample_names()]
    if state.choice() == state.OWN:
        own = replace(state.building(), name=OWN_NAME, sensor=state.settings().sensor)
        all_of_them.append(own)
    return all_of_them


def run_all() -> list[StudyCase]:
    """Every drawing at every cell size, and why a drawing is left out."""
    bar = st.progress(0.0, "Studying the drawings")
    pairs = [(drawing, px) for drawing in drawings() for px in SOURCE_CELLS_PX]
    cases, refused = [], {}
    for done, (drawing, cell_px) in enumerate(pairs, start=1):
        try:
            cases.append(solving.study_case(drawing, cell_px, settings()))
        except OccsimError as error:
            refused[drawing.name] = str(error)
        bar.progress(done / len(pairs), f"{done} of {len(pairs)} cases")
    bar.empty()
    for name, reason in refused.items():
        shell.say_error(f"Drawing {name} is left out: {reason}")
    return cases


def findings(cases: list[StudyCase]) -> None:
    """Sentences on how far the source's pattern appears."""
    see, why = st.columns(2, gap="large")
    with see:
        st.markdown("**Does the published pattern appear?**")
        for line in pattern_text(cases).splitlines():
            st.markdown(f"- {words.maths(line)}")
    with why:
        st.markdown(
            "**How to read this.** The source's five drawings may not be used here. "
            "Ours are of the same kinds, so only the pattern can be compared. "
            f"{words.maths(PRINTED)}"
        )


def tables(cases: list[StudyCase]) -> None:
    """Tables 4.1 and 4.2, ours beside the published ones."""
    for column, objective in zip(st.columns(2, gap="large"), Objective, strict=True):
        rows = maxima_table(cases, objective)
        columns = zip(*(row[1:] for row in rows), strict=True)
        data = {
            title: [_shown(value) for value in values]
            for title, values in zip(COLUMNS.values(), columns, strict=True)
        }
        with column:
            st.markdown(f"**{TITLES[objective]}**")
            st.table(data, hide_index=True)


def _shown(value: object) -> str:
    if isinstance(value, float):
        return words.number(value, ".2f")
    return words.ranges(str(value)) or words.DASH


def all_fronts(cases: list[StudyCase]) -> None:
    """The exact fronts, one chart for each cell size (Fig. 4.7)."""
    chosen = state.settings()
    columns = st.columns(len(SOURCE_CELLS_PX), gap="medium")
    for column, cell_px in zip(columns, SOURCE_CELLS_PX, strict=True):
        fronts = {c.name: c.front for c in cases if c.cell_px == cell_px}
        with column:
            figure = front_figures.study_figure(
                fronts, cell_px, chosen.axes, chosen.min_recall
            )
            st.plotly_chart(figure, config=chart("study"), key=f"study_{cell_px}")


def downloads(cases: list[StudyCase]) -> None:
    """The results as files."""
    studied = {case.name for case in cases}
    described = [
        case_settings(drawing, cell_px, settings())
        for drawing in drawings()
        if drawing.name in studied
        for cell_px in SOURCE_CELLS_PX
    ]
    min_recall = state.settings().min_recall
    files = {
        "maxima.csv": ("Tables (CSV)", maxima_csv(cases)),
        "fronts.csv": ("Fronts (CSV)", fronts_csv(cases, min_recall)),
        "sweeps.csv": ("All 10 × 10 sweeps (CSV)", sweeps_csv(cases)),
        "settings.json": ("Settings and versions (JSON)", json.dumps(described)),
    }
    with st.container(horizontal=True):
        for name, (label, data) in files.items():
            st.download_button(
                label, data, file_name=f"study_{name}", on_click="ignore"
            )
    st.caption("The same on a command line, with figures:")
    st.code("python -m occsim study --cells 3 5 10 --out results", language="bash")

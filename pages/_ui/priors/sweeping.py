"""The parts of the page "Sweep the priors"."""

import streamlit as st

from occsim import Objective, maxima, sample_names
from pages._ui import compute, controls, shell, state, words
from pages._ui.choices import CHOICES, Drawings, Surface
from pages._ui.priors import (
    front_words,
    fronts,
    maps,
    marks,
    scores,
    surface_figures,
    surfaces,
)
from pages._ui.priors.marks import MarkedPrior
from pages._ui.priors.surfaces import SurfaceView
from pages._ui.runs import Run
from pages._ui.settings import with_changes

CELLS = (3, 5, 10)
EXTRA = {
    Surface.SOURCE: {"best of the 10 × 10 pairs": "circle"},
    Surface.EXACT: {"exact front": "circle"},
}
"""Marks of single views: name and symbol."""


@shell.fragment
def one_drawing(run: Run) -> None:
    """A row of surfaces for each rule, with the map of the chosen pair."""
    settings = state.settings()
    both = scores.both_rules(run)
    rows = [surfaces.views(one, settings) for one in both]
    ends = _ends(rows)
    for one, views in zip(both, rows, strict=True):
        marked = marks.marked(one)
        values = words.maths(front_words.marks_text(marked))
        st.markdown(f"**{CHOICES[one.settings.rule]}.** :small[{values}]")
        *charts, side = st.columns(4, gap="small")
        # The map first: after a click the user waits for it.
        with side:
            maps.chosen_map(one)
            if one is both[0]:
                _pair_sliders()
        for column, view, scale in zip(charts, views, ends, strict=True):
            with column:
                _surface_chart(one, view, scale, marked)
    if any(view.has_gaps for views in rows for view in views):
        st.caption(f"Hatched: {surfaces.UNDEFINED}.")
    for one, column in zip(both, st.columns(2, gap="large"), strict=True):
        with column:
            st.markdown(f"**The chosen pair: {CHOICES[one.settings.rule].lower()}**")
            st.markdown(scores.table(one, state.prior()), unsafe_allow_html=True)


def _pair_sliders() -> None:
    for name, column in zip(("p_wall", "p_space"), st.columns(2), strict=True):
        with column:
            controls.slider(name)


def _ends(rows: list[list[SurfaceView]]) -> list[tuple[float, float]]:
    """One colour scale for each score, shared by all rows."""
    return [surface_figures.colour_range(list(c)) for c in zip(*rows, strict=True)]


def _surface_chart(
    run: Run,
    view: SurfaceView,
    ends: tuple[float, float],
    marked: list[MarkedPrior],
) -> None:
    """One surface; a click on it chooses a pair."""
    objective = next((one for one in Objective if one.value == view.name), None)
    kind = state.settings().surface if objective else None
    dots = []
    if kind is Surface.SOURCE:
        dots = fronts.pairs_of(maxima(surfaces.source_sweep(run), objective))
    elif kind is Surface.EXACT:
        dots = fronts.pairs_of(run.front)
    figure = surface_figures.surface_figure(
        view, ends=ends, chosen=state.pair(), marked=marked, dots=dots
    )
    key = f"surface_{view.name}_{run.settings.rule.value}"
    st.plotly_chart(
        figure, config=controls.chart(key), **state.bind_chart(key, of_pairs=True)
    )


def all_drawings() -> None:
    """The surfaces of the five reference drawings in rows, as in Fig. 4.5."""
    settings = state.settings()
    runs = {name: compute.reference_run(name, settings) for name in sample_names()}
    rows = [surfaces.views(run, settings) for run in runs.values()]
    picture, text = st.columns([3, 1], gap="large")
    with picture:
        figure = surface_figures.rows_figure(
            rows,
            list(runs),
            _ends(rows),
            [marks.marked(run) for run in runs.values()],
            state.pair(),
        )
        st.plotly_chart(figure, config=controls.chart("surfaces"), key="surface_rows")
        st.caption("Each sensor reaches as far as a door of its own drawing is wide.")
    with text:
        explain(next(iter(runs.values())))
    show_maxima(runs, f"cells of {settings.cell_px} px", "Drawing")


def sizes(run: Run) -> None:
    """The maxima of one drawing for the source's three cell sizes, explained."""
    settings, building = state.settings(), run.building
    runs = {
        f"{cell_px} px": compute.run(
            building, with_changes(settings, {"cell_px": cell_px})
        )
        for cell_px in CELLS
    }
    table, text = st.columns([3, 2], gap="large")
    with table:
        show_maxima(runs, words.plain(building.title), "Cells")
    with text:
        explain(run)


def show_maxima(runs: dict[str, Run], title: str, heading: str) -> None:
    """Where the source's 10 x 10 pairs are best, with all ties, as a table."""
    lines = [
        f"| {heading} | Score | Counted once | at | Taken off | at | Blank map |",
        "|---|---|---:|---|---:|---|---:|",
    ]
    for name, run in runs.items():
        for which in Objective:
            sweeps = map(surfaces.source_sweep, scores.both_rules(run))
            found = [maxima(sweep, which) for sweep in sweeps]
            cells = [
                text
                for best in found
                for text in (words.percent(best.value), words.ranges(best.text))
            ]
            blank = words.percent(getattr(run.scores(scores.BLANK), which.value))
            row = [name, which.value, *cells, blank]
            on_one_line = [text.replace(" ", "\u00a0") for text in row]
            lines.append(f"| {' | '.join(on_one_line)} |")
    st.markdown(f"**Maxima of the 10 × 10 pairs: {title}**")
    st.markdown("\n".join(lines))
    where = words.maths("at which (p_wall, p_space)")
    st.caption(
        f"Each maximum, and {where} it lies, under both rules. "
        "The source prints such tables without the blank map's value."
    )


def _see() -> str:
    """What the colours of this view mean, and how to use it."""
    settings = state.settings()
    if settings.surface is Surface.DIFFERENCE:
        said = (
            "Orange: the interpolated table promises less than the pair's own map has; "
            "blue: it promises more. Of bits the values themselves are shown."
        )
    else:
        said = (
            "Yellow is better, blue is worse; the surfaces of a score share its scale. "
            "Within the line lie the pairs that are better than no drawing."
        )
    if settings.drawings is Drawings.ALL:
        return said
    return f"{said} Point at a pair for its value, click it for its map."


def explain(run: Run) -> None:
    """What to see, to try and why, of the view that is shown."""
    st.markdown(f"**See.** {_see()}")
    st.markdown(
        f"**Try.** Press {controls.thin_walls(run.has_errors)} and compare the areas "
        "within the lines of both rules."
    )
    if state.settings().surface is Surface.EXACT:
        st.markdown(
            "**Why steps?** A cell turns from free to occupied at one value of its "
            "prior, and between two such values nothing changes. Bits see every "
            "change of a probability, so their surface is smooth."
        )
    else:
        st.markdown(
            "**Why interpolated?** The source scored 100 pairs and drew straight lines "
            "between them. *Exact* shows the true surface, *Difference* how far off "
            "the lines are. Bits are always exact."
        )
    st.markdown(
        "**Why so fast?** What a reading says does not depend on the prior, so the "
        f"{run.evidence.n_readings} readings are simulated once. Wall cells then "
        f"depend on {words.maths('p_wall alone and all others on p_space alone')}."
    )

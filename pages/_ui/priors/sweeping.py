"""The parts of the page "Sweep the priors"."""

import streamlit as st

from occsim import Objective, maxima, sample_names
from occsim.priors import Maxima, ParetoFront
from pages._ui import compute, controls, shell, state, words
from pages._ui.choices import Drawings, Surface
from pages._ui.priors import maps, surface_figures, surfaces
from pages._ui.runs import Run
from pages._ui.settings import with_changes

CELLS = (3, 5, 10)


def pairs(of: Maxima | ParetoFront) -> list[tuple[float, float]]:
    """The prior pairs of maxima or of a front."""
    return list(zip(of.p_wall.tolist(), of.p_space.tolist(), strict=True))


@shell.fragment
def one_drawing(run: Run) -> None:
    """Both surfaces of one drawing, and the map of the chosen pair."""
    *charts, side = st.columns([4, 4, 4], gap="medium")
    # The map first: after a click the user waits for it.
    with side:
        maps.chosen_map(run)
        with st.container(horizontal=True):
            controls.slider("p_wall", width=controls.NARROW_PX)
            controls.slider("p_space", width=controls.NARROW_PX)
    for column, objective in zip(charts, Objective, strict=True):
        with column:
            surface_chart(run, objective)


def surface_chart(run: Run, objective: Objective) -> None:
    """One surface; a click on it chooses a pair."""
    settings = state.settings()
    view = surfaces.surface_view(run, settings, objective)
    figure = surface_figures.surface_figure(
        view,
        ends=surface_figures.colour_range([view]),
        chosen=state.pair(),
        best=pairs(maxima(surfaces.source_sweep(run), objective)),
        front=pairs(run.front) if settings.surface is Surface.EXACT else None,
    )
    key = f"surface_{objective.value}"
    st.plotly_chart(
        figure, config=controls.CHART_CONFIG, **state.bind_chart(key, of_pairs=True)
    )
    if view.has_gaps:
        st.caption(f"Hatched: {surfaces.UNDEFINED}.")


def all_drawings() -> None:
    """The surfaces of the five reference drawings in rows, as in Fig. 4.5."""
    settings = state.settings()
    runs = {name: compute.reference_run(name, settings) for name in sample_names()}
    rows = [
        [surfaces.surface_view(run, settings, objective) for objective in Objective]
        for run in runs.values()
    ]
    ends = [
        surface_figures.colour_range(list(column)) for column in zip(*rows, strict=True)
    ]
    picture, text = st.columns([3, 2], gap="large")
    with picture:
        figure = surface_figures.rows_figure(rows, list(runs), ends, state.pair())
        st.plotly_chart(figure, config=controls.CHART_CONFIG, key="surface_rows")
        st.caption("Each sensor reaches as far as a door of its own drawing is wide.")
    with text:
        show_maxima(runs, f"cells of {settings.cell_px} px", "Drawing")
        explain(next(iter(runs.values())))


def sizes(run: Run) -> None:
    """The maxima of one drawing for the source's three cell sizes, explained."""
    settings, building = state.settings(), run.building
    runs = {
        f"{cell_px} px": compute.run(
            building, with_changes(settings, {"cell_px": cell_px})
        )
        for cell_px in CELLS
    }
    table, text = st.columns(2, gap="large")
    with table:
        show_maxima(runs, words.plain(building.title), "Cells")
    with text:
        explain(run)


def show_maxima(runs: dict[str, Run], title: str, heading: str) -> None:
    """Where the source's 10 x 10 pairs are best, with all ties, as a table."""
    lines = [words.maths(f"| {heading} | Score | Maximum | at (p_wall, p_space) |")]
    lines.append("|---|---|---|---|")
    for name, run in runs.items():
        for which in Objective:
            best = maxima(surfaces.source_sweep(run), which)
            value = words.percent(best.value)
            lines.append(
                f"| {name} | {which.value} | {value} | {words.ranges(best.text)} |"
            )
    st.markdown(f"**Maxima of the 10 × 10 pairs: {title}**")
    st.markdown("\n".join(lines))


def _see() -> str:
    """What the colours of this view mean, and how to use it."""
    settings = state.settings()
    if settings.surface is Surface.DIFFERENCE:
        colours = (
            "Orange: the interpolated table promises less than the pair's own map has; "
            "blue: it promises more."
        )
    else:
        colours = "Yellow is high, blue is low, each score on its own scale."
    star = "The star is the source's choice, (0.2, 0.9)."
    if settings.drawings is Drawings.ALL:
        return f"{colours} {star}"
    return f"{colours} Point at a pair for its value, click it for its map. {star}"


def explain(run: Run) -> None:
    """What to see, to predict and why, of the view that is shown."""
    st.markdown(f"**See.** {_see()}")
    st.markdown(
        "**Predict**, then switch to *Exact*. Is the true surface as smooth as the "
        "interpolated one?"
    )
    with st.expander("And then?"):
        st.markdown(
            "It has steps: a cell turns from free to occupied at one value of its "
            "prior, and between two such values nothing changes. The source scored "
            "100 pairs and drew straight lines between them; *Difference* shows how "
            "far off these are."
        )
    st.markdown(
        "**Why so fast?** What a reading says does not depend on the prior, so the "
        f"{run.evidence.n_readings} readings are simulated once. Wall cells then "
        f"depend on {words.maths('p_wall alone and all others on p_space alone')}."
    )

"""The Pareto explorer for all drawings: their fronts, and pairs good for all."""

from dataclasses import replace

import streamlit as st

from occsim import Prior, PriorSweep, sample_names
from occsim._types import IntArray
from occsim.priors import ParetoFront, near_front
from pages._ui import compute, controls, glossary, shell, state, words
from pages._ui.controls import chart
from pages._ui.priors import (
    front_figures,
    fronts,
    maps,
    marks,
    scores,
    solving,
    surfaces,
)
from pages._ui.priors.front_figures import Mark
from pages._ui.priors.scores import BLANK
from pages._ui.runs import Run

STEP = 0.02
TOLERANCE_STEP, MAX_TOLERANCE = 0.005, 0.5


def all_drawings(run: Run) -> None:
    """Fronts overlaid as in Fig. 4.7, and the region of pairs good for all of them."""
    settings = state.settings()
    runs = {name: compute.reference_run(name, settings) for name in sample_names()}
    if state.choice() == state.OWN:
        runs["yours"] = run
    _fronts_and_region(runs)


@shell.fragment
def _fronts_and_region(runs: dict[str, Run]) -> None:
    settings = state.settings()
    values = surfaces.axis(STEP)
    sweeps = [solving.sweep(run, values) for run in runs.values()]
    all_fronts = [run.front for run in runs.values()]
    overlay, region = st.columns([5, 4], gap="medium")
    with overlay:
        _overlay(runs)
        controls.segments("axes")
    with region:
        count = near_counts(sweeps, all_fronts, settings.tolerance)
        # The marks that are the same on every drawing.
        marked = marks.marked(next(iter(runs.values())))[:2]
        figure = front_figures.region_figure(
            count, values, len(runs), marked, state.pair()
        )
        st.plotly_chart(
            figure,
            config=chart("near_front"),
            **state.bind_chart("region", of_pairs=True),
        )
        controls.slider("tolerance")
    st.markdown(verdict(count.tolist(), runs, settings.tolerance))
    _smallest(sweeps, all_fronts, values)
    pair = maps.pair_text(*state.pair())
    st.markdown(f"**{words.maths('(p_wall, p_space)')} = {pair} on every drawing**")
    st.markdown(table(runs, state.prior()))
    st.caption(f"Bits per cell. {glossary.meaning('bits per cell')}")


def near_counts(
    sweeps: list[PriorSweep], all_fronts: list[ParetoFront], tolerance: float
) -> IntArray:
    """For how many drawings each pair is within a tolerance of the front."""
    near = [
        near_front(sweep, front, tolerance).astype("int64")
        for sweep, front in zip(sweeps, all_fronts, strict=True)
    ]
    return sum(near[1:], start=near[0])


def _overlay(runs: dict[str, Run]) -> None:
    settings = state.settings()
    drawn = front_figures.series({name: run.front for name, run in runs.items()})
    drawn = [
        replace(one, marks=_marks(one.name, run, one.color))
        for one, run in zip(drawn, runs.values(), strict=True)
    ]
    figure = front_figures.fronts_figure(
        drawn,
        settings.axes,
        settings.min_recall,
        "Fronts of all drawings (Fig. 4.7)",
        "overlay",
    )
    st.plotly_chart(
        figure,
        config=chart("pareto_fronts"),
        **state.bind_chart(f"fronts_{settings.axes.value}"),
    )


def _marks(name: str, run: Run, color: str) -> tuple[Mark, ...]:
    """The marked priors and the chosen one on one drawing, in its colour."""
    priors = {one.name: one.prior for one in marks.marked(run)}
    priors["chosen"] = state.prior()
    found = []
    for title, prior in priors.items():
        at, symbol = run.scores(prior), marks.SYMBOLS[title]
        pair = None if prior == BLANK else state.nearest_pair(prior)
        found.append(
            Mark(
                f"{name}: {title}",
                at.precision,
                at.recall,
                symbol,
                color,
                pair,
                title not in (marks.CALIBRATED, marks.IN_BITS),
            )
        )
    return tuple(found)


def verdict(count: list[list[int]], runs: dict[str, Run], tolerance: float) -> str:
    """How many pairs are good for every drawing, and whether the source's is."""
    flat = [n for row in count for n in row]
    share = sum(n == len(runs) for n in flat) / len(flat)
    gap = worst_gap(runs, Prior())
    inside = "is one of them" if gap <= tolerance else "is not one of them"
    return (
        f"**{words.percent(share)}** of all pairs are within {100 * tolerance:.0f} "
        f"points of every drawing's front. The source's (0.2, 0.9) {inside}: it needs "
        f"a tolerance of {maps.tolerance(gap)}; the chosen pair needs "
        f"{maps.tolerance(worst_gap(runs, state.prior()))}."
    )


def worst_gap(runs: dict[str, Run], prior: Prior) -> float:
    """The smallest tolerance at which a prior is near every front; NaN if none is."""
    gaps = [fronts.distance(run.front, run.scores(prior)) for run in runs.values()]
    return float("nan") if any(gap != gap for gap in gaps) else max(gaps)


def _smallest(
    sweeps: list[PriorSweep], all_fronts: list[ParetoFront], values: list[float]
) -> None:
    """The pair that serves all drawings at the smallest tolerance, to be chosen."""
    n_steps = round(MAX_TOLERANCE / TOLERANCE_STEP)
    for step in range(n_steps + 1):
        tolerance = step * TOLERANCE_STEP
        rows = near_counts(sweeps, all_fronts, tolerance).tolist()
        pairs = [
            (p_wall, p_space)
            for p_wall, row in zip(values, rows, strict=True)
            for p_space, n in zip(values, row, strict=True)
            if n == len(sweeps)
        ]
        if pairs:
            break
    else:
        st.info("No pair comes near the fronts of all drawings, at any tolerance.")
        return
    middle = pairs[len(pairs) // 2]
    st.button(
        f"Choose {maps.pair_text(*middle)}: near every front from a tolerance of "
        f"{maps.tolerance(tolerance)} on",
        on_click=state.choose_pair,
        args=middle,
    )


def table(runs: dict[str, Run], prior: Prior) -> str:
    """The scores of one prior on every drawing, the blank map's beside each."""
    heads = [
        f"{score}, {title} | blank"
        for title in scores.COLUMNS.values()
        for score in ("F2", "bits")
    ]
    lines = [
        f"| Drawing | {' | '.join(heads)} | Short of its front by |",
        "|---|" + "---:|" * (2 * len(heads) + 1),
    ]
    for name, run in runs.items():
        own, blank = scores.values(run, prior), scores.values(run, BLANK)
        cells = [
            f"**{words.percent(a.f2)}** | {words.percent(b.f2)} | "
            f"**{scores.bits(a.bits)}** | {scores.bits(b.bits)}"
            for a, b in zip(own, blank, strict=True)
        ]
        gap = maps.tolerance(fronts.distance(run.front, run.scores(prior)))
        title = f"{name}: {words.plain(run.building.title)}"
        lines.append(f"| {title} | {' | '.join(cells)} | {gap} |")
    return "\n".join(lines)

"""The Pareto explorer's third view: the source's search for the front, NSGA-II."""

import contextlib

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from pages._ui import controls, state, words
from pages._ui.choices import Objectives
from pages._ui.controls import chart
from pages._ui.priors import fronts, search_figures, solving
from pages._ui.priors.solving import SearchStep
from pages._ui.runs import Run
from pages._ui.settings import Settings

LIVE_FRAMES = 20
"""Charts drawn while a search runs: each takes longer than a generation."""


def search(run: Run) -> None:
    """Settings of a search, the search itself, and its generations to replay."""
    side, stage = st.columns([2, 5], gap="medium")
    with side:
        started = _controls()
    settings = state.settings()
    key = solving.search_key(run, settings)
    with stage:
        if not len(run.front):
            return
        place = st.empty()
        if started:
            _watch(run, settings, key, place)
        kept = state.kept_search(key)
        if kept:
            figure = search_figures.replay_figure(kept, run.front, settings.axes)
            place.plotly_chart(figure, config=chart("search"), key="search")
            st.caption(_summary(run, kept, settings))
        else:
            figure = search_figures.still_figure([], run.front, settings.axes)
            place.plotly_chart(figure, config=chart("exact_front"), key="bare")
            st.caption(
                "No search has been run yet. After a run, the hypervolume by "
                "generation is shown below the front."
            )
    _words(has_run=bool(kept))


def _controls() -> bool:
    controls.select("objectives")
    controls.select("elitism")
    controls.slider("pop_size")
    controls.slider("n_gen")
    controls.number("seed")
    controls.segments("axes")
    with st.container(horizontal=True):
        started = st.button("Run the search", type="primary")
        # Any click ends the run of the script, and the search with it.
        st.button("Stop", help="Keeps the generations so far.")
    return started


def _watch(run: Run, settings: Settings, key: object, place: DeltaGenerator) -> None:
    steps: list[SearchStep] = []
    every = max(1, settings.n_gen // LIVE_FRAMES)
    bar = st.progress(0.0)
    with contextlib.closing(solving.search(run, settings)) as generations:
        for step in generations:
            steps.append(step)
            state.keep_search(key, steps)
            share = words.percent(step.share)
            bar.progress(
                step.number / settings.n_gen,
                f"Generation {step.number} of {settings.n_gen}: hypervolume {share} of "
                "the exact front's",
            )
            if step.number % every == 0:
                figure = search_figures.still_figure(steps, run.front, settings.axes)
                place.plotly_chart(
                    figure, config=chart("search"), key=f"live {step.number}"
                )
    bar.empty()


def _summary(run: Run, steps: list[SearchStep], settings: Settings) -> str:
    last = steps[-1]
    text = (
        f"{last.number} generations of {settings.pop_size} pairs, seed "
        f"{settings.seed}: their maps attain {words.percent(last.share)} of the exact "
        "front's hypervolume."
    )
    if last.number < settings.n_gen:
        text = f"Stopped. {text}"
    if settings.objectives is Objectives.INTERPOLATED:
        text += (
            " Hollow triangles: scores in the interpolated table. Full: scores of "
            f"the maps of these pairs. {beyond_text(run, last)}"
        )
    return text


def beyond_text(run: Run, step: SearchStep) -> str:
    """How many pairs are promised scores that no pair attains."""
    n = 0 if step.seen is None else fronts.n_beyond(run.front, step.seen.tolist())
    if n == 0:
        return "No hollow one lies beyond the exact front."
    return f"{n} hollow ones lie beyond the exact front: no map attains these scores."


def _words(*, has_run: bool) -> None:
    see, tell, why = st.columns(3, gap="large")
    with see:
        st.markdown(
            "**See.** Triangles are the population, circles the exact front. Play the "
            "generations, or run the search with another seed."
            if has_run
            else "**See.** Circles are the exact front. *Run the search* to see how a "
            "population of pairs approaches it."
        )
    with tell:
        st.markdown(
            "**Predict**, then run. Can the search, on the source's table, promise "
            "more than the exact front allows?"
        )
        with st.expander("And then?"):
            st.markdown(
                "Between the 10 × 10 pairs the table is an interpolation, so hollow "
                "triangles may lie beyond the front; the line below the chart counts "
                "them. No full triangle ever does."
            )
    with why:
        st.markdown(
            "**Why a search?** Two values and two scores need none: the exact front "
            "takes milliseconds. The source had no evidence log and paid for each pair "
            "with a simulation, so it sampled 100 pairs and searched between them."
        )

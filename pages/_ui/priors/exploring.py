"""The Pareto explorer for one drawing: its front and the maps on it."""

import streamlit as st

from occsim import Prior
from occsim.prior import SOURCE_PAIR
from occsim.priors import recommend, rectangles_at, set_c
from pages._ui import controls, palette, shell, state, words
from pages._ui.controls import CHART_CONFIG
from pages._ui.priors import front_figures, fronts, maps
from pages._ui.priors.front_figures import Mark
from pages._ui.runs import Run


@shell.fragment
def one_front(run: Run) -> None:
    """A front, its pairs, and the map of the chosen pair; then others to compare."""
    front = run.front
    chart, space, side = st.columns([5, 4, 4], gap="medium")
    # The map first: after a click the user waits for it.
    with side:
        maps.chosen_map(run)
        maps.against_uninformative(run, state.prior())
    with chart:
        _front_chart(run)
        if len(front) > 1:
            _point_slider(run)
    with space:
        _prior_space(run)
        with st.container(horizontal=True):
            controls.slider("p_wall", width=controls.NARROW_PX)
            controls.slider("p_space", width=controls.NARROW_PX)
    _choices(run)
    _others(run)
    explain()


def _front_chart(run: Run) -> None:
    settings = state.settings()
    figure = front_figures.front_figure(
        run.front, settings.axes, _marks(run), settings.min_recall
    )
    st.plotly_chart(
        figure, config=CHART_CONFIG, **state.bind_chart(f"front_{settings.axes.value}")
    )


def _marks(run: Run) -> list[Mark]:
    source = Prior()
    wanted = (
        ("uninformative", Prior.uninformative(), "square", palette.UNSEEN, None),
        ("source's", source, "star", "white", SOURCE_PAIR),
        ("chosen", state.prior(), "circle-open", palette.MARK, None),
    )
    marks = []
    for name, prior, *look in wanted:
        scores = run.scores(prior)
        marks.append(Mark(name, scores.precision, scores.recall, *look))
    return marks


def _point_slider(run: Run) -> None:
    front = run.front
    labels = [
        f"{words.percent(precision)}, {words.percent(recall)}"
        for precision, recall in fronts.scores_at(front)
    ]

    def choose(index: int) -> None:
        state.choose_pair(float(front.p_wall[index]), float(front.p_space[index]))

    st.select_slider(
        "Point of the front nearest to the chosen pair (precision, recall)",
        range(len(front)),
        format_func=labels.__getitem__,
        help="Points that lie too close to be clicked can be reached here.",
        **state.bind_index(
            "front_point", fronts.nearest(front, run.scores(state.prior())), choose
        ),
    )


def _prior_space(run: Run) -> None:
    rectangles = rectangles_at(run.surface, *state.pair(), *_bounds()).tolist()
    figure = front_figures.prior_space_figure(
        run.front, rectangles, state.pair(), state.settings().min_recall
    )
    st.plotly_chart(
        figure, config=CHART_CONFIG, **state.bind_chart("prior_space", of_pairs=True)
    )


def _bounds() -> tuple[float, float]:
    # A pair set by hand may lie below the box of the front.
    return min(0.1, *state.pair()), 1.0


def _choices(run: Run) -> None:
    front, min_recall = run.front, state.settings().min_recall
    best = recommend(front, min_recall)
    ends = {"Best precision": 0, "Best recall": len(front) - 1} if len(front) else {}
    picks = {"Recommended": best, **ends}
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.slider("min_recall", width=controls.NARROW_PX)
        for name, index in picks.items():
            pair = SOURCE_PAIR
            if index is not None:
                pair = float(front.p_wall[index]), float(front.p_space[index])
            st.button(
                name,
                on_click=state.choose_pair,
                args=pair,
                disabled=index is None,
            )
        st.button("Source's (0.2, 0.9)", on_click=state.choose_pair, args=SOURCE_PAIR)
        controls.segments("axes")
        controls.segments("picture")
    st.caption(_where(run))


def _where(run: Run) -> str:
    """Which pair is recommended, and how far the chosen one is from the front."""
    front, min_recall = run.front, state.settings().min_recall
    best = recommend(front, min_recall)
    if best is None:
        said = ["Set C is empty: no point of the front has a recall above its bound."]
    else:
        n_inside = len(set_c(front, min_recall))
        pair = maps.pair_text(float(front.p_wall[best]), float(front.p_space[best]))
        said = [
            f"{n_inside} of {len(front)} points lie in set C (full circles); {pair} "
            "has the highest F2 of them and is recommended."
        ]
    if len(front) == 1:
        said.append(
            "One pair attains the highest precision and the highest recall, so nothing "
            "has to be given up here. Other drawings and larger cells have longer "
            "fronts."
        )
    gap = fronts.distance(front, run.scores(state.prior()))
    if gap == 0.0:
        said.append("The chosen pair is on the front.")
    elif gap > 0.0:
        said.append(
            "The chosen pair is off the front: the nearest point is better by up to "
            f"{100 * gap:.1f} points."
        )
    said.append("The pink rectangles hold all pairs that score as it does.")
    return " ".join(said)


def _others(run: Run) -> None:
    front, kind = run.front, state.settings().picture
    priors = {"Uninformative: p_free = 0.5": Prior.uninformative()}
    if len(front):
        for name, index in (("Best precision", 0), ("Best recall", -1)):
            pair = float(front.p_wall[index]), float(front.p_space[index])
            text = maps.pair_text(*pair)
            priors[f"{name}: {text}"] = Prior(p_wall=pair[0], p_space=pair[1])
    for column, (title, prior) in zip(st.columns(3), priors.items(), strict=False):
        with column:
            maps.map_of(run, prior, title, kind)
            maps.against_uninformative(run, prior)
    st.caption(maps.LEGENDS[kind])


def explain() -> None:
    """What to see, to predict and why."""
    see, tell, why = st.columns(3, gap="large")
    with see:
        st.markdown(
            "**See.** Each circle is a prior that no other beats in both scores. Click "
            "one, or move the slider along the front, and watch what the map gains and "
            "loses."
        )
    with tell:
        st.markdown(
            "**Predict**, then click. Which end of the front has the thicker walls?"
        )
        with st.expander("And then?"):
            st.markdown(
                "The end of high recall: more cells are called wall there, right ones "
                "and wrong ones. At the end of high precision only the surest walls "
                "are left."
            )
    with why:
        st.markdown(
            "**Why exact?** Every cell flips at one value of its prior, so all "
            "combinations that can occur are counted, not sampled. The source searched "
            "for this front with a genetic algorithm: see *Search by NSGA-II*."
        )

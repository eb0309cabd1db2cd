"""The Pareto explorer for one drawing: the front of each rule and the maps on them."""

import streamlit as st

from occsim import Prior, UpdateRule
from occsim.prior import SOURCE_PAIR
from occsim.priors import recommend, rectangles_at
from pages._ui import compute, controls, lessons, palette, shell, state, words
from pages._ui.choices import CHOICES
from pages._ui.controls import chart
from pages._ui.priors import front_figures, front_words, fronts, maps, marks, scores
from pages._ui.priors.front_figures import Drawn, Mark, PairsOfRule
from pages._ui.runs import Run
from pages._ui.settings import with_changes

LOOKS = {
    UpdateRule.PRIOR_ONCE: (palette.ONCE, "solid", "circle"),
    UpdateRule.SUBTRACT_PRIOR: (palette.SUBTRACT, "dash", "cross"),
}
"""Colour, line and symbol of each rule."""
SHORT = {
    UpdateRule.PRIOR_ONCE: "counted once",
    UpdateRule.SUBTRACT_PRIOR: "taken off at every reading",
}


@shell.fragment
def one_drawing(run: Run) -> None:
    """Both fronts, their pairs, the chosen pair's maps; then the ends of each front."""
    both = _shown_rules(run)
    chart, space, side = st.columns([6, 5, 3], gap="medium")
    # The maps first: after a click the user waits for them.
    with side:
        _chosen_maps(both)
    drawn = [_drawn(one) for one in both]
    found = _as_found(run)[: len(both)]
    with chart:
        pale = " (pale: drawing as it is)" if found else ""
        title = f"Pareto front under {'each' if len(both) > 1 else 'this'} rule{pale}"
        _front_chart([*map(_ghost, found), *drawn], title)
    with space:
        _prior_space(both, drawn)
    _choices()
    columns = st.columns(len(both), gap="large")
    for i, (one, column) in enumerate(zip(both, columns, strict=True)):
        with column:
            _of_rule(one, found[i] if found else None)
    _ends(both)
    explain(run.has_errors)


def _shown_rules(run: Run) -> list[Run]:
    """Both rules; before the prediction of the lesson only the one that it shows."""
    return scores.both_rules(run)[: 1 if lessons.waits() else None]


def _chosen_maps(both: list[Run]) -> None:
    title = f"(p_wall, p_space) = {maps.pair_text(*state.pair())}"
    st.markdown(f"**{words.maths(title)}**")
    for one in both:
        st.image(
            one.picture(state.prior(), state.settings().picture),
            width="stretch",
            caption=f"Drawing {SHORT[one.settings.rule]}",
            alt=f"Map of {one.building.title}, drawing {SHORT[one.settings.rule]}",
        )


def _as_found(run: Run) -> list[Run]:
    """The drawing without its errors, under each rule; nothing if it has none."""
    if not run.has_errors:
        return []
    settings = with_changes(run.settings, controls.NO_ERRORS)
    return scores.both_rules(compute.run(run.building, settings))


def _ghost(found: Run) -> Drawn:
    color, dash, symbol = LOOKS[found.settings.rule]
    name = f"{SHORT[found.settings.rule]}, drawing as it is"
    return Drawn(name, found.front, color, dash, symbol, size=0)


def _drawn(run: Run) -> Drawn:
    color, dash, symbol = LOOKS[run.settings.rule]
    name = SHORT[run.settings.rule]
    found = [_mark(run, one.prior, one.name, one.symbol) for one in marks.marked(run)]
    found.append(_mark(run, state.prior(), "chosen", marks.SYMBOLS["chosen"]))
    return Drawn(name, run.front, color, dash, symbol, marks=tuple(found))


def _mark(run: Run, prior: Prior, name: str, symbol: str) -> Mark:
    """A map of one rule; the blank one is the same under both."""
    at, is_blank = run.scores(prior), prior == scores.BLANK
    color = palette.UNSEEN if is_blank else LOOKS[run.settings.rule][0]
    full = name if is_blank else f"{name}, {SHORT[run.settings.rule]}"
    pair = None if is_blank else state.nearest_pair(prior)
    fixed = name in (marks.CALIBRATED, marks.IN_BITS)
    return Mark(full, at.precision, at.recall, symbol, color, pair, not fixed)


def _front_chart(drawn: list[Drawn], title: str) -> None:
    settings = state.settings()
    figure = front_figures.fronts_figure(
        drawn,
        settings.axes,
        settings.min_recall,
        title,
        "front",
    )
    st.plotly_chart(
        figure,
        config=chart("pareto_front"),
        **state.bind_chart(f"front_{settings.axes.value}"),
    )


def _prior_space(both: list[Run], drawn: list[Drawn]) -> None:
    # A pair set by hand may lie below the box of the front.
    low = min(0.1, *state.pair())
    rules = [
        PairsOfRule(look, rectangles_at(one.surface, *state.pair(), low, 1.0).tolist())
        for one, look in zip(both, drawn, strict=True)
    ]
    figure = front_figures.prior_space_figure(
        rules, marks.marked(both[0]), state.pair(), state.settings().min_recall
    )
    st.plotly_chart(
        figure,
        config=chart("prior_pairs"),
        **state.bind_chart("prior_space", of_pairs=True),
    )
    st.caption(
        "Shaded: the pairs that score as the chosen one, in the rule's colour. "
        f"{words.maths(marks.BEYOND)}"
    )


def _choices() -> None:
    with st.container(horizontal=True, vertical_alignment="bottom"):
        controls.slider("p_wall", width=controls.NARROW_PX)
        controls.slider("p_space", width=controls.NARROW_PX)
        controls.slider("min_recall", width=controls.NARROW_PX)
        st.button("Source's (0.2, 0.9)", on_click=state.choose_pair, args=SOURCE_PAIR)
        controls.segments("axes")
        controls.segments("picture")


def _of_rule(run: Run, found: Run | None) -> None:
    """One rule: what its front says, its points to choose, the chosen pair's scores."""
    rule, min_recall = run.settings.rule, state.settings().min_recall
    st.markdown(f"**{CHOICES[rule]}**")
    said = [front_words.front_text(run)]
    if found:
        said.append(front_words.found_text(found))
    if len(run.front):
        said.append(front_words.recommended_text(run, min_recall))
    said += [
        front_words.source_text(run),
        front_words.distance_text(run, state.prior()),
    ]
    st.markdown(words.maths(" ".join(filter(None, said))))
    st.caption(words.maths(front_words.marks_text(marks.marked(run))))
    if len(run.front):
        _buttons(run, min_recall)
    if len(run.front) > 1:
        _point_slider(run)
    st.markdown(scores.table(run, state.prior()), unsafe_allow_html=True)


def _buttons(run: Run, min_recall: float) -> None:
    pairs = fronts.pairs_of(run.front)
    best = recommend(run.front, min_recall)
    picks = {"Best F2": best, "Best precision": 0, "Best recall": len(pairs) - 1}
    with st.container(horizontal=True):
        for name, index in picks.items():
            st.button(
                name,
                on_click=state.choose_pair,
                args=SOURCE_PAIR if index is None else pairs[index],
                disabled=index is None,
                key=f"{name} {run.settings.rule.value}",
            )


def _point_slider(run: Run) -> None:
    """Steps along the front; a first place for a chosen pair that is not on it."""
    pairs = fronts.pairs_of(run.front)
    labels = ["not on it"] + [
        f"{words.percent(precision)}, {words.percent(recall)}"
        for precision, recall in fronts.scores_at(run.front)
    ]
    here = run.scores(state.prior())
    on_front = fronts.distance(run.front, here) == 0.0
    place = 1 + fronts.nearest(run.front, here) if on_front else 0

    def choose(index: int) -> None:
        if index:
            state.choose_pair(*pairs[index - 1])

    st.select_slider(
        "Along the front (precision, recall)",
        range(len(labels)),
        format_func=labels.__getitem__,
        help="Points that lie too close to be clicked can be reached here.",
        **state.bind_index(f"front_point_{run.settings.rule.value}", place, choose),
    )


def _ends(both: list[Run]) -> None:
    """The map of no drawing, and those at the ends of each front."""
    kind = state.settings().picture
    shown = [("No drawing (blank map)", both[0], scores.BLANK)]
    for one in both:
        pairs = fronts.pairs_of(one.front)
        ends = dict.fromkeys([*pairs[:1], *pairs[-1:]])
        names = (
            ["Best in both"] if len(ends) == 1 else ["Best precision", "Best recall"]
        )
        for name, pair in zip(names, ends, strict=False):
            title = f"{name}, {SHORT[one.settings.rule]}: {maps.pair_text(*pair)}"
            shown.append((title, one, Prior(p_wall=pair[0], p_space=pair[1])))
    # Without a front there is one map, which would be as wide as the page.
    columns = st.columns(max(len(shown), 3))
    for column, (title, one, prior) in zip(columns, shown, strict=False):
        with column:
            maps.map_of(one, prior, title, kind)
    st.caption(maps.LEGENDS[kind])


def explain(has_errors: bool) -> None:
    """What to try, and why the fronts are exact."""
    tell, why = st.columns(2, gap="large")
    with tell:
        st.markdown(
            f"**Try.** Press {controls.thin_walls(has_errors)} and compare how many "
            "points each front gets. Along a front, more recall means more cells "
            "called wall, right ones and wrong ones."
        )
    with why:
        st.markdown(
            "**Why exact?** Every cell flips at one value of its prior, so all "
            "combinations that can occur are counted, not sampled. The source searched "
            "for this front with a genetic algorithm: see *Search by NSGA-II*."
        )

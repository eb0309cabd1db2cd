"""The parts of the page "What is a good map?": counts to click, and their cells."""

import streamlit as st

from occsim import MappingRun, Region, Scores, coverage
from occsim.io.images import png
from occsim.io.map_pictures import Outcome, outcome_cells, outcome_picture
from pages._ui import state, words
from pages._ui.choices import Picture
from pages._ui.priors import maps
from pages._ui.priors.scores import COLUMNS
from pages._ui.runs import OUTCOME_COLOURS, ZOOM
from pages._ui.settings import Settings

LIT = "lit"
NAME_PX, COUNT_PX = 140, 96
"""Widths of the table: a row fits a telephone of 390 px."""
ROWS = {
    Outcome.HIT: ("Walls found", "black"),
    Outcome.FALSE_WALL: ("False walls", "orange"),
    Outcome.MISSED_WALL: ("Walls missed", "blue"),
    Outcome.FREE: ("Left free", "white"),
}
"""What each count is called, and the colour of its cells."""


def counts(run: MappingRun, settings: Settings) -> None:
    """The map with its outcomes, and the counts beside it."""
    final = run.map(settings.prior, settings.rule)
    scored = {
        region: run.scores(settings.prior, settings.rule, region) for region in COLUMNS
    }
    picture, table = st.columns(2, gap="large")
    lit = state.view(LIT, None)
    # Where nobody looked is hatched, unless one of its counts is lit.
    is_unseen = lit is not None and lit[1] is Region.UNEXPLORED
    region = Region.ALL if is_unseen else Region.EXPLORED
    with table:
        _table(scored)
        st.markdown(shares(scored), unsafe_allow_html=True)
        st.caption(
            f"The robot has looked at {words.percent(coverage(final))} of the cells. "
            f"A cell is declared wall where {words.maths('p_free')} is below 1/2."
        )
    with picture:
        cells = outcome_cells(final, run.truth_cells, *lit) if lit else None
        st.image(
            png(
                outcome_picture(
                    final, run.truth_cells, OUTCOME_COLOURS, region, ZOOM, cells
                )
            ),
            width="stretch",
            alt=f"The map of {run.building.title}: {_lit_words(lit, scored)}",
        )
        st.caption(_lit_words(lit, scored))


def _lit_words(lit: tuple[Outcome, Region] | None, scored: dict[Region, Scores]) -> str:
    """What is lit on the map, in words."""
    if lit is None:
        return maps.LEGENDS[Picture.ERRORS]
    outcome, region = lit
    name, colour = ROWS[outcome]
    n = count(scored[region], outcome)
    return f"Lit, {colour}: {name.lower()}, {COLUMNS[region]}: {words.number(n)} cells."


def count(scores: Scores, outcome: Outcome) -> int:
    """One of the four counts."""
    by_outcome = {
        Outcome.HIT: scores.tp,
        Outcome.FALSE_WALL: scores.fp,
        Outcome.MISSED_WALL: scores.fn,
        Outcome.FREE: scores.tn,
    }
    return by_outcome[outcome]


def _table(scored: dict[Region, Scores]) -> None:
    with st.container(horizontal=True):
        st.markdown("**Cells**", width=NAME_PX)
        for title in COLUMNS.values():
            st.markdown(
                f"<small>{words.term(title)}</small>",
                unsafe_allow_html=True,
                width=COUNT_PX,
            )
    for outcome, (name, colour) in ROWS.items():
        with st.container(horizontal=True, vertical_alignment="center"):
            st.markdown(f"{name} :small[({colour})]", width=NAME_PX)
            for region in COLUMNS:
                _count_button(outcome, region, count(scored[region], outcome))


def _count_button(outcome: Outcome, region: Region, n: int) -> None:
    is_lit = state.view(LIT, None) == (outcome, region)
    st.button(
        words.number(n),
        key=f"count {outcome.name} {region.value}",
        help=f"{ROWS[outcome][0]}, {COLUMNS[region]}: show these cells",
        type="primary" if is_lit else "secondary",
        width=COUNT_PX,
        on_click=state.set_view,
        args=(LIT, None if is_lit else (outcome, region)),
    )


def shares(scored: dict[Region, Scores]) -> str:
    """Precision and recall as shares of counts, as a table."""
    heads = " | ".join(words.term(title) for title in COLUMNS.values())
    lines = [f"| Score | {heads} |", "|---|---:|---:|"]
    for name, other in (("precision", "fp"), ("recall", "fn")):
        cells = " | ".join(_share(one, name, other) for one in scored.values())
        lines.append(f"| {words.term(name, name.capitalize())} | {cells} |")
    return "\n".join(lines)


def _share(scores: Scores, name: str, other: str) -> str:
    value = words.percent(getattr(scores, name))
    found, rest = words.number(scores.tp), words.number(getattr(scores, other))
    return f"{found} / ({found} + {rest}) = **{value}**"

"""Small maps of prior pairs, and their scores in words."""

import streamlit as st

from occsim import Prior, Scores
from pages._ui import state, words
from pages._ui.choices import Picture
from pages._ui.runs import Run
from pages._ui.words import DASH, percent

LEGENDS = {
    Picture.BELIEF: "White is free, black is occupied; greys are less certain.",
    Picture.ERRORS: "Black: wall found. Orange: false wall. Blue: missed wall. "
    "Hatched: not scored.",
    Picture.CHANGE: "Orange: more occupied than without the drawing. Blue: more free.",
}


def tolerance(value: float) -> str:
    """A tolerance of scores in percentage points; a dash where it is undefined."""
    return DASH if value != value else f"{100 * value:.1f} points"


def score_line(scores: Scores) -> str:
    """Precision, recall and F2 of a map."""
    return (
        f"Precision **{percent(scores.precision)}**, recall "
        f"**{percent(scores.recall)}**, F2 **{percent(scores.f2)}**"
    )


def pair_text(p_wall: float, p_space: float) -> str:
    """A pair as the source writes it, to four digits."""
    return f"({p_wall:.4g}, {p_space:.4g})"


def chosen_map(run: Run) -> None:
    """The map of the chosen pair."""
    title = f"(p_wall, p_space) = {pair_text(*state.pair())}"
    map_of(run, state.prior(), title, state.settings().picture)


def map_of(run: Run, prior: Prior, title: str, kind: Picture) -> None:
    """One map with its title and its scores."""
    st.markdown(f"**{words.maths(title)}**")
    st.image(
        run.picture(prior, kind),
        width="stretch",
        alt=f"Map of {run.building.title}; {title}",
    )
    st.markdown(score_line(run.scores(prior)))

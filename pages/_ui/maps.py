"""Small maps of prior pairs, and their scores in words."""

import streamlit as st

from occsim import Prior, Scores
from pages._ui import state
from pages._ui.choices import Picture
from pages._ui.runs import Run

DASH = "–"
LEGENDS = {
    Picture.BELIEF: "White is free, black is occupied, grey is unknown.",
    Picture.ERRORS: "Black: wall found. Orange: false wall. Blue: missed wall. "
    "Hatched: not scored.",
    Picture.CHANGE: "Orange: more occupied than without the drawing. Blue: more free.",
}


def percent(value: float) -> str:
    """A share in percent; a dash where it is undefined."""
    return DASH if value != value else f"{100 * value:.1f} %"


def points(value: float) -> str:
    """A difference of shares in percentage points; a dash where it is undefined."""
    return DASH if value != value else f"{100 * value:+.1f}"


def score_line(scores: Scores) -> str:
    """Precision, recall and F2 of a map."""
    return (
        f"Precision **{percent(scores.precision)}**, recall "
        f"**{percent(scores.recall)}**, F2 **{percent(scores.f2)}**"
    )


def difference_line(scores: Scores, reference: Scores) -> str:
    """How far the scores lie from those of another map."""
    return ", ".join(
        f"{name} {points(getattr(scores, name) - getattr(reference, name))}"
        for name in ("precision", "recall", "f2")
    ).replace("f2", "F2")


def pair_text(p_wall: float, p_space: float) -> str:
    """A pair as the source writes it, to four digits."""
    return f"(p_wall, p_space) = ({p_wall:.4g}, {p_space:.4g})"


def chosen_map(run: Run) -> None:
    """The map of the chosen pair, at once."""
    kind = state.settings().picture
    prior = Prior(p_wall=state.pair()[0], p_space=state.pair()[1])
    map_of(run, prior, pair_text(*state.pair()), kind)


def map_of(run: Run, prior: Prior, title: str, kind: Picture) -> None:
    """One map with its title and its scores."""
    st.markdown(f"**{title}**")
    st.image(
        run.picture(prior, kind),
        width="stretch",
        alt=f"Map of {run.building.title} with {title}",
    )
    st.markdown(score_line(run.scores(prior)))

"""Three priors with the highest F2 for one building, each for another question."""

import streamlit as st

from occsim import Prior, Region, UpdateRule
from occsim.io.prior_map import prior_png
from pages._ui import words
from pages._ui.priors import guiding
from pages._ui.priors.answers import best_f2
from pages._ui.runs import Run

QUESTIONS = {
    (UpdateRule.SUBTRACT_PRIOR, Region.EXPLORED): "Taken off, cells looked at",
    (UpdateRule.SUBTRACT_PRIOR, Region.ALL): "Taken off, all cells",
    (UpdateRule.PRIOR_ONCE, Region.EXPLORED): "Counted once, cells looked at",
}
FAINT = 0.15
"""Probabilities of free that differ by less can hardly be told apart on a picture."""


def triptych(run: Run) -> None:
    """Show the three prior maps side by side, and what each of them says."""
    st.markdown("**Three best priors for one house**")
    shown = zip(QUESTIONS.items(), st.columns(len(QUESTIONS)), strict=True)
    for ((rule, region), question), column in shown:
        with column:
            st.caption(f"Highest F2: {question[0].lower()}{question[1:]}")
            prior = best_f2(run, rule, region)
            if prior is None:
                st.caption("Set C is empty, so no pair can be recommended.")
                continue
            st.image(
                prior_png(run.prior_map(prior)),
                width="stretch",
                alt=f"The prior map with the highest F2: {question}",
            )
            text = f"{kind(prior)} {guiding.prior_text(prior)}"
            st.markdown(words.maths(text))


def kind(prior: Prior) -> str:
    """What a prior map looks like beside its drawing."""
    if guiding.is_negative(prior):
        return "The drawing's negative:"
    is_faint = prior.p_free_space - prior.p_free_wall < FAINT
    return "Hardly to be seen:" if is_faint else "The drawing:"

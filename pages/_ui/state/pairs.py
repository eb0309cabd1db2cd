"""The chosen prior pair, and the search for the front that was run last."""

import streamlit as st

from occsim import Prior
from occsim.prior import PRIOR_SCALE
from pages._ui.priors import solving
from pages._ui.settings import TABLE
from pages._ui.state.chosen import change, settings


def pair() -> tuple[float, float]:
    """The chosen prior pair: p_wall, p_space."""
    return settings().p_wall, settings().p_space


def choose_pair(p_wall: float, p_space: float) -> None:
    """Choose a prior pair; every page shows its map."""
    change(p_wall=p_wall, p_space=p_space, uninformative=False)


def nearest_pair(to: Prior) -> tuple[float, float]:
    """The pair of the sliders whose prior is nearest to one of any scale."""
    pair = to.p_free_wall / PRIOR_SCALE, to.p_free_space / PRIOR_SCALE
    bounds = TABLE["p_wall"], TABLE["p_space"]
    return tuple(
        round(min(max(value, of.low), of.high), 4)
        for value, of in zip(pair, bounds, strict=True)
    )


def prior() -> Prior:
    """The prior of the chosen pair, even if the player shows the uninformative one."""
    return Prior(p_wall=settings().p_wall, p_space=settings().p_space)


def keep_search(key: object, steps: list[solving.SearchStep]) -> None:
    """Keep the generations of a search so far."""
    st.session_state.search = key, steps


def kept_search(key: object) -> list[solving.SearchStep]:
    """The generations kept of this search; none of another."""
    kept, steps = st.session_state.get("search", (None, []))
    return steps if kept == key else []

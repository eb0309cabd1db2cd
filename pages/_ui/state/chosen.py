"""What a student has chosen: the settings, the drawing, and the link that says so."""

from typing import Any
from urllib.parse import urlencode, urlsplit, urlunsplit

import streamlit as st

from occsim import load_sample, sample_names
from occsim.building import Building
from pages._ui import compute
from pages._ui.components.player import SHARED, PlayerDocument
from pages._ui.settings import Settings, decode, encode, unread, with_changes
from pages._ui.state.replay import forget_player, open_half_way

OWN = "own"
OPENING = "b"
"""The drawing that the app opens with: a shelf and a balcony are taken for walls, so
that the prior errs visibly and the Pareto front has several points."""


def prepare(path: str) -> None:
    """Fill a new session; note when another page was entered."""
    state = st.session_state
    if "settings" not in state:
        asked = st.query_params.get("drawing", "")
        first = asked if asked in sample_names() else OPENING
        state.choice = first
        state.own = None
        state.message = ""
        state.played = PlayerDocument()
        state.settings = _for_sample(decode(st.query_params.to_dict()), first)
        state.link_notice = path, _damage(asked)
        open_half_way(building())
    # A component that leaves the screen forgets what it knew.
    if state.get("path") != path:
        state.path = path
        forget_player()


def _damage(asked: str) -> str:
    """What of the link could not be followed, in a sentence; empty if all was."""
    wrong = unread(st.query_params.to_dict())
    if asked and asked not in sample_names():
        wrong.insert(0, "drawing")
    if not wrong:
        return ""
    return (
        f"The link gives no usable value for {', '.join(wrong)}; there the defaults "
        "are used."
    )


def link_notice(path: str) -> str:
    """What was wrong with the link that opened this page; empty on other pages."""
    opened, words = st.session_state.link_notice
    return words if path == opened else ""


def settings() -> Settings:
    """The student's settings."""
    return st.session_state.settings


def change(**changes: Any) -> None:
    """Replace some settings; what the player shows follows if it is concerned."""
    st.session_state.settings = with_changes(settings(), changes)
    if any(name in SHARED for name in changes):
        forget_player()


def reset_all() -> None:
    """Return to the preset of the chosen drawing; a building of one's own is kept."""
    st.session_state.settings = Settings()
    choose(choice())


def link() -> str:
    """Return the address of this page with this drawing and these settings."""
    drawing = {} if choice() == OWN else {"drawing": choice()}
    page = urlsplit(st.context.url or "")
    query = urlencode(drawing | encode(settings()))
    return urlunsplit(page._replace(query=query, fragment=""))


def _for_sample(current: Settings, name: str) -> Settings:
    """The settings with the range that the source gives to a drawing: a door's."""
    if "range_px" in st.query_params:
        return current
    return with_changes(current, {"range_px": round(load_sample(name).sensor.range_px)})


def choice() -> str:
    """The chosen drawing: the name of a sample, or `OWN`."""
    return st.session_state.choice


def choices() -> list[str]:
    """Every drawing that can be chosen."""
    return [*sample_names(), *([OWN] if st.session_state.own else [])]


def choose(name: str) -> None:
    """Choose a drawing; the sensor's range follows the length of its doors."""
    st.session_state.choice = name
    if name != OWN:
        st.session_state.settings = _for_sample(settings(), name)
    open_half_way(building())


def building() -> Building:
    """The building that is mapped."""
    if choice() == OWN:
        return st.session_state.own
    return compute.sample(choice())


def drawing_title(name: str) -> str:
    """What a drawing is called on screen."""
    if name == OWN:
        return f"Yours: {st.session_state.own.title}"
    return f"{name}: {load_sample(name).title}"

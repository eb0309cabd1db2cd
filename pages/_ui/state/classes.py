"""The class that a session is in, and the room in which it votes."""

import secrets
from collections.abc import Mapping

import streamlit as st

from pages._ui.classroom.kept import CLASSES, typed
from pages._ui.classroom.prepared import ClassError, unpacked
from pages._ui.state.held import class_now

CLASS_PATH = "pages/10_Class.py"
NO_CLASS = (
    "The class of this link is not on this server: the code is mistyped, the server "
    "was restarted, or the class has expired. Ask your teacher for the long link."
)


def enter_class(query: Mapping[str, str]) -> list[str]:
    """Take over the class that a link names; return what was wrong with it."""
    state = st.session_state
    state.prepared, state.class_link = None, {}
    code, text = typed(query.get("class", "")), query.get("plan")
    try:
        found = unpacked(text) if text else CLASSES.find(code)
    except ClassError as error:
        return [f"{str(error).capitalize()}."]
    if found is None:
        return [NO_CLASS] if "class" in query else []
    state.prepared = found
    state.class_link = {"plan": text} if text else {"class": code}
    return []


def class_texts() -> Mapping[str, str]:
    """What the class says of the state, as in a link."""
    prepared = class_now()
    return {} if prepared is None else prepared.texts


def class_in_link() -> dict[str, str]:
    """What a link says of the class."""
    return st.session_state.get("class_link", {})


def came_from() -> str:
    """The page before this one; empty if this is the first."""
    return st.session_state.get("came_from", "")


# --- Voting ---------------------------------------------------------------------------


def voter() -> str:
    """Who votes in this session: a word drawn by lot, no name."""
    return st.session_state.setdefault("voter", secrets.token_hex(8))


def room() -> tuple[str, str]:
    """The code of the room that this session is in, and its key if it opened it."""
    return st.session_state.get("room", ("", ""))


def enter_room(code: str, key: str = "") -> None:
    """Go into a room; with its key as its teacher."""
    st.session_state.room = typed(code), key


def room_in_link() -> dict[str, str]:
    """What a link to the page of the class says of the room."""
    if st.session_state.get("path") != CLASS_PATH:
        return {}
    texts = dict(zip(("room", "key"), room(), strict=True))
    return {name: text for name, text in texts.items() if text}

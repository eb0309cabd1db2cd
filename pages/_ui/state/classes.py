"""The class that a session is in, and the room in which it votes."""

import re
import secrets
from collections.abc import Mapping

import streamlit as st

from pages._ui.classroom.kept import CLASSES, typed
from pages._ui.classroom.prepared import ClassError, unpacked
from pages._ui.state.held import class_now

WORD = re.compile(r"[0-9a-f]{16}")
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


def with_class(query: Mapping[str, str]) -> Mapping[str, str]:
    """What a link says, after what its class says where it only opens the class.

    The address of a student in the class names a drawing and says all that differs; a
    link to another exercise opens that one, with nothing of the class in it.
    """
    prepared = class_now()
    if prepared is None or query.keys() & {"drawing", "work"}:
        return query
    is_other = query.get("exercise", "") not in ("", prepared.texts.get("exercise"))
    return query if is_other else {**prepared.texts, **query}


def class_in_link() -> dict[str, str]:
    """What a link says of the class."""
    return st.session_state.get("class_link", {})


def came_from() -> str:
    """The page before this one; empty if this is the first."""
    return st.session_state.get("came_from", "")


# --- Voting ---------------------------------------------------------------------------


def drawn_word() -> str:
    """A word that this session drew by lot."""
    return st.session_state.setdefault("drawn_word", secrets.token_hex(8))


def take_voter(given: object) -> None:
    """Vote as this browser did before, by the word that its first session drew."""
    if isinstance(given, str) and WORD.fullmatch(given):
        st.session_state.voter = given


def voter() -> str:
    """Who votes: a word drawn by lot, no name; it stays in the student's browser."""
    return st.session_state.get("voter", drawn_word())


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

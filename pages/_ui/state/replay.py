"""The document last sent to the map player, and the student's choices in it."""

import contextlib
from collections.abc import Mapping
from dataclasses import replace

import streamlit as st

from occsim.building import Building
from pages._ui.components.player import (
    SHARED,
    PlayerDocument,
    decode_commit,
    encode_document,
)
from pages._ui.settings import with_changes

PLAYER_KEY = "map_player"


def player_document() -> PlayerDocument:
    """The document that the player starts from; the same object until it must change.

    The player owns its priors and its step while it is on the screen. A document with a
    new ``rev`` replaces it: after a reset, another drawing, or another page.
    """
    state = st.session_state
    if state.imposed is None:
        shared = {name: getattr(st.session_state.settings, name) for name in SHARED}
        state.imposed = state.played = replace(
            state.played, rev=state.played.rev + 1, **shared
        )
    return state.imposed


def forget_player() -> None:
    """Impose a new document at the next run."""
    st.session_state.imposed = None


def take_from_player(document: PlayerDocument | None) -> None:
    """Store the student's choices in the player, without sending them back."""
    if document is None:
        return
    shared = {name: getattr(document, name) for name in SHARED}
    st.session_state.settings = with_changes(st.session_state.settings, shared)
    st.session_state.played = document


def half_way(building: Building) -> int:
    """The step at which the player opens: the middle of the replay."""
    return len(building.trajectory) // 2


def open_half_way(building: Building) -> None:
    """Let the player open in the middle of the replay."""
    st.session_state.played = replace(
        st.session_state.played, step=half_way(building), pin_px=None
    )
    forget_player()


def place_in_replay(building: Building) -> dict[str, str]:
    """The position in the replay, as texts for a link; defaults are left out."""
    played: PlayerDocument = st.session_state.played
    texts = {} if played.step == half_way(building) else {"step": str(played.step)}
    if played.pin_px is not None:
        texts["pin"] = ",".join(f"{at:g}" for at in played.pin_px)
    if played.speed is not None:
        texts["speed"] = str(played.speed)
    return texts


def go_to_place(texts: Mapping[str, str]) -> None:
    """Open the replay at the position in a link, if it is valid."""
    played: PlayerDocument = st.session_state.played
    commit = encode_document(played)
    for name in ("step", "speed"):
        with contextlib.suppress(ValueError):
            commit |= {name: int(texts[name])} if name in texts else {}
    with contextlib.suppress(ValueError):
        if "pin" in texts:
            commit["pin_px"] = [float(at) for at in texts["pin"].split(",")]
    st.session_state.played = decode_commit(commit, played)

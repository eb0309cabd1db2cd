"""What the map player was last sent, and what the student chose in it."""

from dataclasses import replace

import streamlit as st

from occsim.building import Building
from pages._ui.components.player import SHARED, PlayerDocument
from pages._ui.settings import with_changes

PLAYER_KEY = "map_player"


def player_document() -> PlayerDocument:
    """What the player starts from; the same object until it must change from outside.

    The player owns its priors and its step while it is on the screen. A document with a
    new ``rev`` overrules it: after a reset, another drawing, or another page.
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
    """Take over what the student chose in the player, without sending it back."""
    if document is None:
        return
    shared = {name: getattr(document, name) for name in SHARED}
    st.session_state.settings = with_changes(st.session_state.settings, shared)
    st.session_state.played = document


def open_half_way(building: Building) -> None:
    """Let the player open in the middle of the story of the building."""
    st.session_state.played = replace(
        st.session_state.played, step=len(building.trajectory) // 2, pin_px=None
    )
    forget_player()

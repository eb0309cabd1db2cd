"""The documents last sent to the map players, and the student's choices in them."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import streamlit as st

from occsim.building import Building
from pages._ui.columns import HOME_COLUMNS, LOG_COLUMNS, Column
from pages._ui.components.player import (
    PlayerDocument,
    decode_commit,
    encode_document,
    held_parts,
)
from pages._ui.components.player.document import with_place
from pages._ui.settings import Settings, with_changes
from pages._ui.state.held import held_place, keep_settings, limits

PLAYER_KEY = "map_player"
TWO_MAPS_KEY = "two_maps"
HOME_KEY = "home_player"
ROBOT_KEY = "robot_player"
BY_THEMSELVES = (HOME_KEY, ROBOT_KEY)
"""Players whose building and maps are not those of the settings."""
TWO_MAPS_PATH = "pages/3_Two_maps.py"
HOME_PATH = "app.py"
ROBOT_PATH = "pages/4_Robot_data.py"
OF_COLUMN = ("p_wall", "p_space", "uninformative", "rule")
"""Settings of the app that the single map's player holds."""
SHARED = (*OF_COLUMN, "overlay", "columns")
"""Settings of the app that some player holds as well."""

NEW_PLAYED = {
    PLAYER_KEY: PlayerDocument(),
    TWO_MAPS_KEY: PlayerDocument(),
    HOME_KEY: PlayerDocument(columns=HOME_COLUMNS, compact=True),
    ROBOT_KEY: PlayerDocument(columns=LOG_COLUMNS),
}
"""What has been played in a new session: nothing."""


def player_at(path: str) -> str:
    """The key of the player that a link to a page speaks of."""
    players = {
        TWO_MAPS_PATH: TWO_MAPS_KEY,
        HOME_PATH: HOME_KEY,
        ROBOT_PATH: ROBOT_KEY,
    }
    return players.get(path, PLAYER_KEY)


def player_document(key: str) -> PlayerDocument:
    """The document that a player starts from; the same object until it must change.

    The player owns its choices and its step while it is on the screen. A document with
    a new ``rev`` replaces it: after a reset, another drawing, or another page.
    """
    state = st.session_state
    if key not in state.imposed:
        played = state.played[key]
        made = replace(
            played, rev=played.rev + 1, **_from_settings(key, state.settings)
        )
        state.imposed = state.imposed | {key: made}
        state.played = state.played | {key: made}
    return state.imposed[key]


def _from_settings(key: str, settings: Settings) -> dict[str, Any]:
    if key in BY_THEMSELVES:
        return {}  # they show no setting
    if key == TWO_MAPS_KEY:
        return {"columns": settings.columns, "overlay": settings.overlay}
    return {"columns": (settings.column,), "overlay": settings.overlay}


def take_from_player(key: str) -> PlayerDocument:
    """Store the student's choices in a player, without sending them back.

    Called before the player is drawn, so that what it needs next is sent in this run.
    """
    document = decode_commit(_commit(key), player_document(key))
    state = st.session_state
    if key == HOME_KEY:
        document = replace(document, columns=_home_columns(document))
    else:
        document = _with_held(document, player_document(key))
    if key not in BY_THEMSELVES:
        keep_settings(with_changes(state.settings, _to_settings(key, document)))
    state.played = state.played | {key: document}
    return document


def _with_held(document: PlayerDocument, imposed: PlayerDocument) -> PlayerDocument:
    """What was chosen in a player, but for what is held: that is as it was imposed."""
    found = limits()
    names = {"transport": "step", "overlay": "overlay"}
    changes = {
        field: getattr(imposed, field)
        for control, field in names.items()
        if control in found.held
    }
    columns = found.columns_kept(document.columns, imposed.columns)
    return replace(document, **changes, columns=columns)


def _home_columns(document: PlayerDocument) -> tuple[Column, ...]:
    """The home page's maps: of all that they say, only the rule can be chosen."""
    rule = document.columns[0].rule
    return tuple(replace(column, rule=rule) for column in HOME_COLUMNS)


def _to_settings(key: str, document: PlayerDocument) -> dict[str, Any]:
    if key == TWO_MAPS_KEY:
        return {"columns": document.columns, "overlay": document.overlay}
    [column] = document.columns
    of_column = {name: getattr(column, name) for name in OF_COLUMN}
    return {"overlay": document.overlay} | of_column


def parts_held(key: str) -> frozenset[str]:
    """The parts of a replay that the browser has."""
    return held_parts(_commit(key))


def _commit(key: str) -> object:
    return (st.session_state.get(key) or {}).get("committed")


def forget_player() -> None:
    """Impose new documents at the next run."""
    st.session_state.imposed = {}


def opening_step(key: str, building: Building) -> int:
    """The step at which a player opens: one map half-way, several at 0."""
    return len(building.trajectory) // 2 if key == PLAYER_KEY else 0


def open_players(building: Building) -> None:
    """Let the players open where they do on a building that was just chosen."""
    st.session_state.played = {
        key: played
        if key in BY_THEMSELVES
        else replace(
            played, step=opening_step(key, building), pin_px=None, predicted=None
        )
        for key, played in st.session_state.played.items()
    }
    forget_player()


def open_log_player(identity: str, step: int, columns: tuple[Column, ...]) -> None:
    """Show another log from a step on, or other maps of the same log."""
    state = st.session_state
    played, shown = state.played[ROBOT_KEY], state.get("log_shown")
    changes: dict[str, Any] = {}
    if shown is None or shown[0] != identity:
        is_linked = shown is None and played.step > 0
        changes = {"step": played.step if is_linked else step, "pin_px": None}
    if shown is None or shown[1] != columns:
        changes["columns"] = columns
    state.log_shown = identity, columns
    if changes:
        state.played = state.played | {ROBOT_KEY: replace(played, **changes)}
        state.imposed = {k: v for k, v in state.imposed.items() if k != ROBOT_KEY}


def put_player(key: str, step: int, pin_px: tuple[float, float] | None = None) -> None:
    """Let a player open at a step, nothing predicted."""
    played = st.session_state.played
    reset = replace(played[key], step=step, pin_px=pin_px, predicted=None)
    st.session_state.played = played | {key: reset}


def restart_home() -> None:
    """Let the home page's maps play from the start, the question not yet answered."""
    played = st.session_state.played
    reset = replace(NEW_PLAYED[HOME_KEY], rev=played[HOME_KEY].rev)
    st.session_state.played = played | {HOME_KEY: reset}
    forget_player()


def place_in_replay(building: Building, path: str) -> dict[str, str]:
    """The position in a page's replay, as texts for a link; defaults are left out."""
    key = player_at(path)
    played: PlayerDocument = st.session_state.played[key]
    opening = opening_step(key, building)
    texts = {} if played.step == opening else {"step": str(played.step)}
    if played.pin_px is not None:
        texts["pin"] = ",".join(f"{at:g}" for at in played.pin_px)
    if played.speed is not None:
        texts["speed"] = str(played.speed)
    if key == HOME_KEY and played.columns != HOME_COLUMNS:
        texts["home_rule"] = played.columns[0].rule.value
    return texts


def go_to_place(texts: Mapping[str, str]) -> None:
    """Open the replay at the position in a link, if it is valid."""
    key = player_at(st.session_state.path)
    if "transport" in limits().held:
        others = {name: text for name, text in texts.items() if name != "step"}
        texts = {**others, **held_place()}
    played = with_place(st.session_state.played[key], texts)
    if key == HOME_KEY and "home_rule" in texts:
        commit = encode_document(played)
        for column in commit["columns"]:
            column["rule"] = texts["home_rule"]
        played = decode_commit(commit, played)
    st.session_state.played = st.session_state.played | {key: played}

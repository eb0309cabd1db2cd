"""State of the boards and the table of the page "Your building" between runs."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import streamlit as st

from occsim import Trajectory
from pages._ui.components.board import BoardDocument, BoardMode, decode_commit
from pages._ui.state.chosen import building
from pages._ui.state.edits import edit, edit_building
from pages._ui.state.widgets import renewed

Columns = dict[str, list[float | None]]
Source = tuple[object, ...]
"""Parts of a building that a board shows."""


def bind_wall(field: str, change: Callable[[str, Any], None]) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` that tie a widget to a wall parameter."""
    key = renewed(f"wall_{field}")
    st.session_state[key] = getattr(building().wall_params, field)
    return {"key": key, "on_change": _take_wall, "args": (field, key, change)}


def _take_wall(field: str, key: str, change: Callable[[str, Any], None]) -> None:
    if key == renewed(f"wall_{field}") and key in st.session_state:
        edit(lambda: change(field, st.session_state[key]), tag=f"wall_{field}")


@dataclass(frozen=True, slots=True)
class Table:
    """The table of poses: the values given to its editor, their trajectory, and its
    last values.

    An editor keeps its edits only while it is on the screen and is given the same
    values again; `rev` is new whenever it is given others.
    """

    rev: int
    source: Trajectory
    given: Columns
    last: Columns

    @property
    def key(self) -> str:
        """Key of the editor."""
        return f"pose_table_{self.rev}"


def table(columns: Callable[[Trajectory], Columns]) -> Table:
    """The values that the table of poses starts from.

    They are taken from the current trajectory where the table was left and entered
    again, or where the trajectory was changed elsewhere.
    """
    state = st.session_state
    held: Table | None = state.get("table")
    now = building().trajectory
    if held is None or held.source is not now or held.key not in state:
        given = columns(now)
        held = Table(held.rev + 1 if held else 1, now, given, given)
        state.table = held
    return held


def table_is_new(edited: Columns) -> bool:
    """Whether the table holds other values than it did in the last run."""
    return bool(st.session_state.table.last != edited)


def take_table(trajectory: Trajectory) -> None:
    """Use the trajectory of an edited table; the table stays as it is."""
    edit_building(trajectory=trajectory)
    st.session_state.table = replace(st.session_state.table, source=trajectory)


def note_table(edited: Columns) -> None:
    """Note what the table holds, so that it is used, or refused, only once."""
    st.session_state.table = replace(st.session_state.table, last=edited)


@dataclass(frozen=True, slots=True)
class Held:
    """A drawing board: its imposed and current documents, and the parts it shows."""

    imposed: BoardDocument
    current: BoardDocument
    source: Source


def board_document(
    key: str, source: Source, make: Callable[[], BoardDocument]
) -> BoardDocument:
    """What a board starts from; the same object until it must change from outside.

    It must change where the parts of the building that it shows were replaced by
    anything but the board's own edits, and where the board returns to the screen
    (Streamlit drops the state of elements that were not drawn in the last run).
    """
    boards = st.session_state.setdefault("boards", {})
    held = boards.get(key)
    rev = held.imposed.rev + 1 if held else 1
    if held is None or not _are_same(held.source, source):
        document = replace(make(), rev=rev)
    elif key not in st.session_state:
        document = replace(held.current, rev=rev)
    else:
        return held.imposed
    boards[key] = Held(document, document, source)
    return document


def _are_same(a: Source, b: Source) -> bool:
    return len(a) == len(b) and all(x is y for x, y in zip(a, b, strict=True))


def committed(key: str, mode: BoardMode) -> BoardDocument | None:
    """The last commit of a board, for use in its callback."""
    says = st.session_state.get(key, {}).get("committed")
    return decode_commit(says, st.session_state.boards[key].imposed, mode)


def keep_taker(key: str, take: Callable[[], None]) -> None:
    """Keep what takes the commits of a board."""
    st.session_state.setdefault("takers", {})[key] = take


def take_commits() -> None:
    """Take the commits whose callback a newer run cut short, first thing in that run.

    The page may have been left meanwhile: then no board is shown that would return
    them.
    """
    for key, take in list(st.session_state.get("takers", {}).items()):
        if st.session_state.get(key):
            take()


def on_board(key: str) -> BoardDocument:
    """The current document of a board."""
    return st.session_state.boards[key].current


def note(key: str, drawn: BoardDocument, source: Source) -> None:
    """Note the current document of a board, and the parts of the building that it
    equals.

    Part of the edit that copies it to the building: an interrupted edit is repeated as
    a whole.
    """
    boards = st.session_state.boards
    boards[key] = replace(boards[key], current=drawn, source=source)

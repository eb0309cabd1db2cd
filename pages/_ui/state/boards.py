"""What the page "Your building" keeps of its boards and its table between runs."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import streamlit as st

from occsim import Trajectory
from pages._ui.components.board import BoardDocument, BoardMode, decode_commit
from pages._ui.state.chosen import building
from pages._ui.state.edits import edit, edit_building

Columns = dict[str, list[float | None]]
Source = tuple[object, ...]
"""Parts of a building that a board shows."""


def bind_wall(field: str, change: Callable[[str, Any], None]) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` that tie a widget to a wall parameter."""
    key = f"wall_{field}"
    st.session_state[key] = getattr(building().wall_params, field)
    return {
        "key": key,
        "on_change": lambda: edit(
            lambda: change(field, st.session_state[key]), tag=key
        ),
    }


def table(columns: Callable[[Trajectory], Columns]) -> tuple[int, Columns]:
    """What the table of poses starts from, and a number that is new when it is new.

    An editor keeps its edits only while it is given the same values again, so they stay
    what they were until the trajectory is changed elsewhere.
    """
    state = st.session_state
    rev, source, given, _ = state.get("table", (0, None, {}, {}))
    if source is not building().trajectory:
        rev, source, given = rev + 1, building().trajectory, None
    if given is None:
        given = columns(source)
        state.table = rev, source, given, given
    return rev, given


def table_is_new(edited: Columns) -> bool:
    """Whether the table holds other values than it did in the last run."""
    return bool(st.session_state.table[3] != edited)


def take_table(trajectory: Trajectory) -> None:
    """Take over the trajectory of an edited table, which stays as it is."""
    state = st.session_state
    rev, _, given, last = state.table
    edit_building(trajectory=trajectory)
    state.table = rev, trajectory, given, last


def note_table(edited: Columns) -> None:
    """Note what the table holds, so that it is taken, or complained of, once."""
    state = st.session_state
    rev, source, given, _ = state.table
    state.table = rev, source, given, edited


@dataclass(frozen=True, slots=True)
class Held:
    """A drawing board: the document imposed on it, what it holds now, and of what.

    The next stroke may stop a script at any look at the session's state, even between
    two changes that belong together. So that none is lost, `before` says of which parts
    of the building an edit was begun that may not have reached it.
    """

    imposed: BoardDocument
    current: BoardDocument
    source: Source
    before: Source | None = None


def board_document(
    key: str, source: Source, make: Callable[[], BoardDocument]
) -> BoardDocument:
    """What a board starts from; the same object until it must change from outside.

    It must where the parts of the building that it shows are other objects than the
    board's own edits left, and where it comes back to the screen (Streamlit forgets the
    state of what was not drawn in the last run).
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
    """What the last commit of a board says, for use in its callback."""
    says = st.session_state.get(key, {}).get("committed")
    return decode_commit(says, st.session_state.boards[key].imposed, mode)


def on_board(key: str) -> BoardDocument:
    """What a board holds now."""
    return st.session_state.boards[key].current


@contextmanager
def taking(
    key: str, drawn: BoardDocument, before: Source, after: Source
) -> Iterator[None]:
    """Note what was drawn on a board, around the edit that brings it to the building.

    `before` and `after` are the parts of the building that the board shows.
    """
    boards = st.session_state.boards
    held = replace(boards[key], current=drawn, source=after)
    boards[key] = replace(held, before=before)
    yield
    boards[key] = held


def unfinished(key: str, source: Source) -> BoardDocument | None:
    """What was drawn on a board and did not reach the building, if anything."""
    held = st.session_state.get("boards", {}).get(key)
    if held is None or held.before is None or not _are_same(held.before, source):
        return None
    return held.current

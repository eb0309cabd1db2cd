"""Edits of a student's own building and log, with undo and redo; messages."""

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import streamlit as st

from occsim import Corrections, OccsimError
from occsim.building import Building
from pages._ui.robot_data.work import EMPTY, RobotWork
from pages._ui.settings import Settings, decode
from pages._ui.shared import size_of
from pages._ui.state.chosen import (
    OWN,
    building,
    change,
    choose,
    defaults,
    renew_widgets,
    settings,
)
from pages._ui.state.held import keep_settings, limits
from pages._ui.state.packed import Packed
from pages._ui.state.replay import forget_player
from pages._ui.state.robots import robot

LOG = logging.getLogger(__name__)
MAX_PAST = 50
"""Most edits that can be undone; edits share the parts that they do not change."""
MAX_PAST_BYTES = 60_000_000
"""Limit of their size together, bytes; the oldest are dropped first."""
UNEXPECTED = (
    "That could not be done: an error in this program, which has been logged. What you "
    "had is unchanged."
)


@dataclass(frozen=True, eq=False, slots=True)
class Snapshot:
    """The parts that an edit can change."""

    choice: str
    own: Building | Packed | None
    settings: Settings
    robot: RobotWork

    def packed(self) -> "Snapshot":
        """The same with the building in compressed form."""
        own = self.own
        return replace(self, own=Packed.of(own)) if isinstance(own, Building) else self

    def is_as(self, other: "Snapshot") -> bool:
        """Whether nothing differs; parts are compared by identity."""
        return (
            self.choice == other.choice
            and self.settings == other.settings
            and self.robot is other.robot
            and _are_same(self.own, other.own)
        )


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """One edit: the state before, the state after, and the kind of edit."""

    before: Snapshot
    after: Snapshot
    tag: str


def _are_same(a: Building | Packed | None, b: Building | Packed | None) -> bool:
    if not isinstance(a, Building) or not isinstance(b, Building):
        return a is b
    return all(
        _is_same_part(getattr(a, one.name), getattr(b, one.name))
        for one in fields(Building)
    )


def _is_same_part(a: object, b: object) -> bool:
    return a is b or (isinstance(a, Corrections) and a == b)


def _snapshot() -> Snapshot:
    state = st.session_state
    # A copy holds the parts without cached results.
    own = None if state.own is None else replace(state.own)
    return Snapshot(state.choice, own, settings(), robot())


def set_own(own: Building) -> None:
    """Keep a student's own building and show it; the settings stay."""
    _require_free_drawing()
    st.session_state.own = own
    st.session_state.choice = OWN
    forget_player()


def open_own(own: Building) -> None:
    """Use a new building, with its own sensor range."""
    _require_free_drawing()
    st.session_state.own = own
    choose(OWN)


def _require_free_drawing() -> None:
    held = limits()
    if held.drawing not in ("", OWN):
        raise OccsimError(f"The drawing was chosen by {held.by} and stays.")


def edit_building(**changes: Any) -> None:
    """Replace parts of the building; a sample becomes the student's own building."""
    set_own(replace(building(), **changes))


def set_range_to_door() -> None:
    """Set the sensor's range to the length of the building's door."""
    change(range_px=defaults(OWN).range_px)


def open_project(
    own: Building, texts: Mapping[str, str], made: RobotWork = EMPTY
) -> None:
    """Take over the building, the settings and the robot's data of a project file."""
    open_own(own)
    st.session_state.robot = made
    found, _ = decode(texts)
    keep_settings(found)
    renew_widgets()


def attempt(action: Callable[[], None]) -> None:
    """Run an action on a student's input; if it fails, nothing changes."""
    state = st.session_state
    state.message = ""
    before = state.choice, state.own, state.settings, robot()
    try:
        action()
    except OccsimError as error:
        state.choice, state.own, state.settings, state.robot = before
        state.message = str(error)
    except Exception:
        LOG.exception("an action failed")
        state.choice, state.own, state.settings, state.robot = before
        state.message = UNEXPECTED


def message() -> str:
    """The last failure, in one sentence; empty if there was none."""
    return st.session_state.message


def edit(action: Callable[[], None], tag: str = "") -> None:
    """Attempt an edit of the building, or of a robot's data, that can be undone.

    Consecutive edits with the same `tag`, such as the strokes on one board, count as
    one if the second began where the first ended and nothing was undone in between.

    The next click may stop a script at any access to the session's state, also in a
    callback. So the edit is noted first, and `finish` repeats it in the next run.
    """
    state = st.session_state
    state.unfinished = _snapshot(), action, tag
    _edit(action, tag)
    state.unfinished = None


def finish() -> None:
    """Repeat the edit in which the last run was stopped, if there is one."""
    state = st.session_state
    if state.get("unfinished") is None:
        return
    before, action, tag = state.unfinished
    state.choice, state.own, state.robot = before.choice, before.own, before.robot
    edit(action, tag)


def _edit(action: Callable[[], None], tag: str) -> None:
    state = st.session_state
    before = _snapshot()
    attempt(action)
    after = _snapshot()
    if after.is_as(before):
        return
    past = state.past
    if tag and past and not state.future and past[-1].tag == tag:
        last = past[-1]
        if last.after.is_as(before):
            before, past = last.before, past[:-1]
    if after.is_as(before):
        state.past = past  # what was drawn was taken back on the board itself
        return
    steps = (*past[1 - MAX_PAST :], Step(before, after, tag))
    state.past = _bounded(tuple(_light(step, after.own) for step in steps))
    state.future = ()


def _light(step: Step, now: Building | Packed | None) -> Step:
    """Pack the buildings of a step whose drawing is no longer on the page."""
    sides = [
        side.packed()
        if isinstance(side.own, Building)
        and isinstance(now, Building)
        and side.own.drawing is not now.drawing
        else side
        for side in (step.before, step.after)
    ]
    return Step(*sides, step.tag)


def _bounded(past: tuple[Step, ...]) -> tuple[Step, ...]:
    """Return the newest steps that stay within the bounds; the last one always."""
    while len(past) > 1 and size_of(past) > MAX_PAST_BYTES:
        past = past[1:]
    return past


def can_undo() -> bool:
    """Whether an edit of the building can be undone."""
    return bool(st.session_state.past)


def can_redo() -> bool:
    """Whether an undone edit can be redone."""
    return bool(st.session_state.future)


def undo() -> None:
    """Undo the last edit of the building, if there is one."""
    state = st.session_state
    if not state.past:
        return  # a click during the undo of the last step
    *past, step = state.past
    _restore(step.after, step.before)
    state.past, state.future = tuple(past), (*state.future, step)


def redo() -> None:
    """Redo the edit that was undone last, if there is one."""
    state = st.session_state
    if not state.future:
        return
    *future, step = state.future
    _restore(step.before, step.after)
    state.past, state.future = (*state.past, step), tuple(future)


def _restore(left: Snapshot, entered: Snapshot) -> None:
    """Go from one side of an edit to the other; parts that it left alone stay."""
    state = st.session_state
    own = entered.own
    state.choice = limits().drawing or entered.choice
    state.own = own.opened() if isinstance(own, Packed) else own
    state.robot = entered.robot
    names = [one.name for one in fields(Settings)]
    changes = {
        name: getattr(entered.settings, name)
        for name in names
        if getattr(entered.settings, name) != getattr(left.settings, name)
    }
    change(**changes)
    state.message = ""
    renew_widgets()
    forget_player()

"""Widgets tied to the session's state."""

import contextlib
from collections.abc import Callable, Sequence
from typing import Any

import streamlit as st

from pages._ui import finders, presets
from pages._ui.state.chosen import (
    building,
    change,
    choice,
    choose,
    defaults,
    settings,
)
from pages._ui.state.edits import attempt, edit
from pages._ui.state.held import limits
from pages._ui.state.pairs import choose_pair


def bind(name: str, options: Sequence[Any] = ()) -> dict[str, Any]:
    """Return the options that tie a widget to a setting, disabled where it is locked.

    The widget's own value is set from the setting before each run, so that leaving the
    page, a reset and a share link all show in it. Where the setting is none of the
    `options`, the first of them shows.
    """
    key = renewed(f"control_{name}")
    held = getattr(settings(), name)
    st.session_state[key] = options[0] if options and held not in options else held
    return _bound(key, _take, name, key) | _locked(name)


def _bound(key: str, take: Callable[..., None], *args: Any) -> dict[str, Any]:
    return {"key": key, "on_change": take, "args": args}


def _locked(name: str) -> dict[str, bool]:
    return {"disabled": name in limits().held}


def renewed(name: str) -> str:
    """A widget's key of this generation; see `renew_widgets`."""
    return f"{name}:{st.session_state.generation}"


def _take(name: str, key: str) -> None:
    if key == renewed(f"control_{name}") and key in st.session_state:
        attempt(lambda: change(**{name: st.session_state[key]}))


def bind_choice() -> dict[str, Any]:
    """Return the options that tie a select box to the chosen drawing."""
    key = renewed("control_choice")
    st.session_state[key] = choice()
    return _bound(key, _take_choice, key) | _locked("drawing")


def _take_choice(key: str) -> None:
    if key == renewed("control_choice"):
        attempt(lambda: choose(st.session_state.get(key, "")))


def bind_preset() -> dict[str, Any]:
    """Return the options that tie a widget to the preset in force."""
    key = renewed("control_preset")
    st.session_state[key] = presets.current(settings())
    return _bound(key, _take_preset, key) | _locked("presets")


def _take_preset(key: str) -> None:
    preset = st.session_state.get(key)
    if key == renewed("control_preset") and preset is not None:
        attempt(lambda: change(**presets.PRESETS[preset]))


def bind_finder() -> dict[str, Any]:
    """Return ``key`` and ``on_change`` that tie a widget to the range finder in use."""
    key = renewed("control_finder")
    scale = building().likely_metres_per_px
    st.session_state[key] = finders.current(settings(), defaults(choice()), scale)
    return {"key": key, "on_change": _take_finder, "args": (key,)}


def _take_finder(key: str) -> None:
    name = st.session_state.get(key)
    if key == renewed("control_finder") and name is not None:
        scale = building().likely_metres_per_px
        wanted = finders.changes(name, defaults(choice()), scale)
        attempt(lambda: change(**wanted))


def value(key: str) -> Any:
    """The value of a widget, for use in its callback."""
    return st.session_state.get(key)


def bind_index(key: str, index: int, choose: Callable[[int], None]) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` of a widget that steps through a list."""
    st.session_state[key] = index
    return {"key": key, "on_change": _take_index, "args": (key, choose)}


def _take_index(key: str, choose: Callable[[int], None]) -> None:
    # If the list was replaced meanwhile, the index may lie beyond its end.
    with contextlib.suppress(IndexError, KeyError):
        choose(st.session_state[key])


def bind_chart(key: str, *, of_pairs: bool = False) -> dict[str, Any]:
    """Return what makes a click in a chart choose the prior pair of a point.

    The pair is the point's customdata or, in a chart `of_pairs`, its place: p_wall
    over p_space.
    """
    return {
        "key": key,
        "on_select": lambda: _take_click(key, of_pairs),
        "selection_mode": "points",
    }


def _take_click(key: str, of_pairs: bool) -> None:
    clicked = st.session_state.setdefault("clicked", {})
    for point in (value(key) or {}).get("selection", {}).get("points", ()):
        place = (point["y"], point["x"]) if of_pairs else None
        clicked[key] = place or point.get("customdata")
    # A second click on a point clears the selection; the pair stays chosen.
    if clicked.get(key):
        attempt(lambda: choose_pair(*clicked[key]))


def view(name: str, default: Any) -> Any:
    """Where the student is on a page: the last value of a widget of `bind_view`."""
    return st.session_state.get("views", {}).get(name, default)


def set_view(name: str, value: Any) -> None:
    """Show the student another place of a page."""
    st.session_state.setdefault("views", {})[name] = value


def bind_view(
    name: str, default: Any, then: Callable[[], None] | None = None
) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` of a widget whose value outlives its page.

    For tools and places on a page, which are no settings of the map. `then` is
    attempted as an edit of the building.
    """
    key = f"view_{name}"
    st.session_state[key] = view(name, default)
    return {"key": key, "on_change": _take_view, "args": (name, key, then)}


def _take_view(name: str, key: str, then: Callable[[], None] | None) -> None:
    if key not in st.session_state:
        return
    set_view(name, st.session_state[key])
    if then is not None:
        edit(then, tag=key)

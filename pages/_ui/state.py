"""The only place that touches ``st.session_state``, with ``workshop/state.py``.

One student's state is small: the `Settings`, which drawing is chosen, the building of
their own if they brought one, a message about the last thing that went wrong, and what
the map player was last sent. Everything else is computed from these.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any
from urllib.parse import urlencode, urlsplit, urlunsplit

import streamlit as st

from occsim import OccsimError, Prior, load_sample, sample_names
from occsim.building import Building
from pages._ui import compute
from pages._ui.player import SHARED, PlayerDocument
from pages._ui.settings import Settings, decode, encode, unread, with_changes

OWN = "own"
OPENING = "b"
"""The drawing that the app opens with: a shelf and a balcony are taken for walls, so
that the prior errs visibly and the Pareto front has several points."""
PLAYER_KEY = "map_player"


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
        _half_built()
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


# --- The building -----------------------------------------------------------------


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
    _half_built()


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


def set_own(own: Building) -> None:
    """Keep a building of the student's own and choose it."""
    st.session_state.own = own
    choose(OWN)


def edit_building(**changes: Any) -> None:
    """Replace parts of the building; a sample becomes a building of one's own."""
    set_own(replace(building(), **changes))


# --- Messages -----------------------------------------------------------------------


def attempt(action: Callable[[], None]) -> None:
    """Run an action on what the student gave; keep what they had if it fails."""
    st.session_state.message = ""
    try:
        action()
    except OccsimError as error:
        st.session_state.message = str(error)


def message() -> str:
    """What went wrong last, in one sentence; empty if nothing did."""
    return st.session_state.message


# --- Widgets --------------------------------------------------------------------------


def bind(name: str) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` that tie a widget to a setting.

    The widget's own value is set from the setting before each run, so that leaving the
    page, a reset and a share link all show in it.
    """
    key = f"control_{name}"
    st.session_state[key] = getattr(settings(), name)
    return {"key": key, "on_change": _take, "args": (name, key)}


def _take(name: str, key: str) -> None:
    change(**{name: st.session_state[key]})


def bind_choice() -> dict[str, Any]:
    """Return ``key`` and ``on_change`` that tie a select box to the chosen drawing."""
    key = "control_choice"
    st.session_state[key] = choice()
    return {
        "key": key,
        "on_change": lambda: choose(st.session_state[key]),
    }


def value(key: str) -> Any:
    """The value of a widget, for use in its callback."""
    return st.session_state.get(key)


# --- Prior pairs ----------------------------------------------------------------------


def pair() -> tuple[float, float]:
    """The chosen prior pair: p_wall, p_space."""
    return settings().p_wall, settings().p_space


def choose_pair(p_wall: float, p_space: float) -> None:
    """Choose a prior pair; every page shows its map."""
    change(p_wall=p_wall, p_space=p_space, uninformative=False)


def prior() -> Prior:
    """The prior of the chosen pair, whether or not the player leaves it out."""
    return Prior(p_wall=settings().p_wall, p_space=settings().p_space)


def bind_index(key: str, index: int, choose: Callable[[int], None]) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` of a widget that steps through a list."""
    st.session_state[key] = index
    return {"key": key, "on_change": lambda: choose(st.session_state[key])}


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


def keep_search(key: object, steps: list[compute.SearchStep]) -> None:
    """Keep the generations of a search so far."""
    st.session_state.search = key, steps


def kept_search(key: object) -> list[compute.SearchStep]:
    """The generations kept of this search; none of another."""
    kept, steps = st.session_state.get("search", (None, []))
    return steps if kept == key else []


def _take_click(key: str, of_pairs: bool) -> None:
    clicked = st.session_state.setdefault("clicked", {})
    for point in value(key)["selection"]["points"]:
        place = (point["y"], point["x"]) if of_pairs else None
        clicked[key] = point.get("customdata") or place
    # A second click on a point takes its selection away: it is still the one meant.
    if clicked.get(key):
        p_wall, p_space = clicked[key]
        choose_pair(p_wall, p_space)


# --- The map player -------------------------------------------------------------------


def player_document() -> PlayerDocument:
    """What the player starts from; the same object until it must change from outside.

    The player owns its priors and its step while it is on the screen. A document with a
    new ``rev`` overrules it: after a reset, another drawing, or another page.
    """
    state = st.session_state
    if state.imposed is None:
        shared = {name: getattr(settings(), name) for name in SHARED}
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
    st.session_state.settings = with_changes(settings(), shared)
    st.session_state.played = document


def _half_built() -> None:
    """Let the player open in the middle of the story of the building."""
    st.session_state.played = replace(
        st.session_state.played, step=len(building().trajectory) // 2, pin_px=None
    )
    forget_player()


# --- Your building: undo, where the student is ----------------------------------------

MAX_PAST = 20
"""Edits of the building that can be taken back; they share what they leave alone."""


def edit(action: Callable[[], None], tag: str = "") -> None:
    """Attempt an edit of the building that can be taken back.

    Edits in a row with the same `tag`, such as the strokes on one board, are one.
    """
    state = st.session_state
    before = state.choice, state.own
    attempt(action)
    if (state.choice, state.own) == before:
        return
    past = state.get("past", ())
    if not (tag and past and past[-1][2] == tag):
        state.past = (*past, (*before, tag))[-MAX_PAST:]
    state.future = ()


def can_undo() -> bool:
    """Whether an edit of the building can be taken back."""
    return bool(st.session_state.get("past"))


def can_redo() -> bool:
    """Whether an edit that was taken back can be done again."""
    return bool(st.session_state.get("future"))


def undo() -> None:
    """Take the last edit of the building back."""
    _step("past", "future")


def redo() -> None:
    """Do the edit again that was taken back last."""
    _step("future", "past")


def _step(source: str, target: str) -> None:
    state = st.session_state
    *state[source], (name, own, tag) = state[source]
    state[target] = (*state.get(target, ()), (state.choice, state.own, tag))
    state.own = own
    choose(name)


def open_project(own: Building, texts: Mapping[str, str]) -> None:
    """Take over the building and the settings of a project file."""
    st.session_state.settings = decode(texts)
    set_own(own)


def view(name: str, default: Any) -> Any:
    """Where the student is on a page: the last value of a widget of `bind_view`."""
    return st.session_state.get("views", {}).get(name, default)


def set_view(name: str, value: Any) -> None:
    """Bring the student to another place of a page."""
    st.session_state.setdefault("views", {})[name] = value


def bind_view(
    name: str, default: Any, then: Callable[[], None] | None = None
) -> dict[str, Any]:
    """Return ``key`` and ``on_change`` of a widget whose value outlives its page.

    For tools and places on a page, which are no settings of the map. What comes `then`
    is attempted as an edit of the building.
    """
    key = f"view_{name}"
    st.session_state[key] = view(name, default)
    return {"key": key, "on_change": _take_view, "args": (name, key, then)}


def _take_view(name: str, key: str, then: Callable[[], None] | None) -> None:
    set_view(name, st.session_state[key])
    if then is not None:
        edit(then, tag=key)

"""A student's choices: the settings, the drawing, and the link that holds them."""

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import streamlit as st

from occsim import load_sample, sample_names
from occsim.building import Building
from pages._ui import compute, openings
from pages._ui.choices import SECTIONS, PriorDrawing
from pages._ui.classroom.kept import CLASSES, typed
from pages._ui.classroom.prepared import Prepared
from pages._ui.course import lesson_in
from pages._ui.robot_data.work import EMPTY
from pages._ui.settings import Settings, decode, encode, with_changes
from pages._ui.state.classes import (
    class_in_link,
    enter_class,
    enter_room,
    room_in_link,
    with_class,
)
from pages._ui.state.held import active, base, keep_settings, limits
from pages._ui.state.lens import forget_lens, lens_in_link, open_lens, reset_lens
from pages._ui.state.opening import OWN, defaults
from pages._ui.state.replay import (
    NEW_PLAYED,
    SHARED,
    TWO_MAPS_PATH,
    forget_player,
    go_to_place,
    open_players,
    place_in_replay,
    restart_home,
)
from pages._ui.state.robots import robot
from pages._ui.state.works import WORKS, Work

YOUR_BUILDING = "pages/2_Your_building.py"
SECTION_NUMBERS = [str(number) for number in range(1, len(SECTIONS) + 1)]
OPENING = "b"
"""The drawing that the app opens with: parts of furniture are taken for walls, so
that the prior errs visibly and the Pareto front has several points."""
OPENING_OF = {TWO_MAPS_PATH: "c"}
"""Pages that open with another drawing, if none was chosen."""
EXERCISE_ID = re.compile(r"[a-z0-9_]{1,40}")
BARE = {"exercise", "projector"}
"""What a link to an exercise may say and still open it from its beginning."""
GONE = (
    "The building or log of this link is no longer on this server: the server was "
    "restarted, or it has expired. Open your project file on the page "
    "Your building to continue; the settings of the link are used."
)


def prepare(path: str) -> None:
    """Fill a new session from its link; note when another page was entered."""
    state = st.session_state
    if "settings" not in state:
        _open_link(path, st.query_params.to_dict())
    # A component that leaves the screen loses its state.
    if state.get("path") != path:
        state.came_from, state.path = state.get("path", ""), path
        _open_page_drawing(path)
        forget_player()
        forget_lens()


def _open_page_drawing(path: str) -> None:
    """Show the drawing that a page opens with, unless the student chose something."""
    state = st.session_state
    has_work = state.own is not None or state.past or state.future
    is_new = not state.chosen and not has_work and settings() == defaults(choice())
    if is_new:
        _show(OPENING_OF.get(path, OPENING))


def _open_link(path: str, query: Mapping[str, str]) -> None:
    """Start a session from a link; it is read once."""
    state = st.session_state
    notices = enter_class(query)
    enter_room(query.get("room", ""), query.get("key", ""))
    given = with_class(query)
    asked = given.get("exercise", "")
    state.exercise = asked if EXERCISE_ID.fullmatch(asked) else None
    query = {**_exercise_texts(query), **given}
    state.projector = query.get("projector") == "1"
    state.own, state.work, state.robot = None, None, EMPTY
    state.path = path
    state.message, state.generation = "", 0
    state.past = state.future = ()
    if "work" in query:
        found = WORKS.find(query["work"])
        notices += [] if found else [GONE]
        kept = found or Work()
        state.own, state.robot, state.work = (
            kept.building,
            kept.robot,
            (query["work"], kept),
        )
    wrong = []
    first = OPENING_OF.get(path, OPENING)
    asked = query.get("drawing", first)
    if asked not in sample_names():
        wrong.append("drawing")
        asked = first
    state.choice = OWN if state.own and "drawing" not in query else asked
    held = limits().drawing
    state.choice = held or state.choice
    state.chosen = state.choice == OWN or "drawing" in query or bool(held)
    found, more = decode(query, base())
    keep_settings(found)
    wrong += more
    state.played = dict(NEW_PLAYED)
    open_players(building())
    go_to_place(query)
    if query.get("section", "") in SECTION_NUMBERS:
        state.views = {"section": SECTIONS[int(query["section"]) - 1]}
    wrong += open_lens(query)
    if lesson_in(query.get("lesson", ""), path) is None and "lesson" in query:
        wrong.append("lesson")
    if wrong:
        notices.append(
            f"The link gives no usable value for {', '.join(wrong)}; the defaults "
            "are used instead."
        )
    state.link_notice = path, " ".join(notices)


def _exercise_texts(query: Mapping[str, str]) -> dict[str, str]:
    """What a link opens that names an exercise and says nothing of the state."""
    exercise = active()
    is_bare = set(query) <= BARE
    return openings.texts_of_exercise(exercise) if exercise and is_bare else {}


def path() -> str:
    """The page that is open."""
    return st.session_state.path


def link_notice(path: str) -> str:
    """What was wrong with the link that opened this page; empty on other pages."""
    opened, words = st.session_state.link_notice
    return words if path == opened else ""


def settings() -> Settings:
    """The student's settings."""
    return st.session_state.settings


def change(**changes: Any) -> None:
    """Replace some settings; the player follows if it shows one of them."""
    keep_settings(with_changes(settings(), changes))
    if any(name in SHARED for name in changes):
        forget_player()


def reset_all() -> None:
    """Return to the chosen drawing's opening settings; an own building is kept."""
    keep_settings(base())
    state = st.session_state
    state.link_notice = state.link_notice[0], ""
    renew_widgets()
    open_players(building())
    reset_lens()
    restart_home()


def renew_widgets() -> None:
    """Give the widgets of settings new keys; late events of old ones are then ignored.

    A slider moved before the browser has received a reset sends its old value and those
    of all others.
    """
    st.session_state.generation += 1


def query() -> dict[str, str]:
    """Return all that a link to this state says."""
    name, path = choice(), st.session_state.path
    where = {} if name == OWN else {"drawing": name}
    key = work_key()
    if key is not None:
        where["work"] = key
    place = place_in_replay(building(), path) | _section() | lens_in_link(path)
    exercise = st.session_state.get("exercise")
    open_one = {} if exercise is None else {"exercise": exercise}
    said = encode(settings(), limits().kept(base()))
    more = class_in_link() | room_in_link() | _projector_in_link()
    return where | _lesson() | said | place | open_one | more


def state_texts(path: str) -> dict[str, str]:
    """Return what a link to a page says of drawing, settings and place, held or not."""
    name = choice()
    key = work_key()
    where = {"drawing": name} if name != OWN else {"work": key} if key else {}
    place = place_in_replay(building(), path) | lens_in_link(path)
    return where | encode(settings(), defaults(name)) | place


def _lesson() -> dict[str, str]:
    """The lesson that is open on this page."""
    number = st.session_state.get("lesson", "")
    is_here = lesson_in(number, st.session_state.path) is not None
    return {"lesson": number} if is_here else {}


def projector() -> bool:
    """Whether the pages are shown on a projector."""
    return bool(st.session_state.get("projector"))


def set_projector(on: bool) -> None:
    """Show the pages as on a projector, or no longer; sizes are measured again."""
    st.session_state.projector = on
    forget_player()
    forget_lens()


def _projector_in_link() -> dict[str, str]:
    return {"projector": "1"} if projector() else {}


def _section() -> dict[str, str]:
    """The section that is shown, on the page that has some; the first is left out."""
    shown = st.session_state.get("views", {}).get("section", SECTIONS[0])
    is_there = st.session_state.get("path") == YOUR_BUILDING and shown != SECTIONS[0]
    return {"section": str(SECTIONS.index(shown) + 1)} if is_there else {}


def work_key() -> str | None:
    """Return the key under which one's own building and log are kept; None if not.

    A session that opened another's link goes on under a key of its own once it changes
    them.
    """
    state = st.session_state
    work = Work(state.own, robot())
    if work.is_empty:
        return None
    key, kept = state.work or (None, Work())
    if not work.is_as(kept):
        mine = key if key == state.get("my_key") else None
        state.my_key = WORKS.keep(work, mine)
        state.work = state.my_key, work
    return state.work[0]


# --- The class ------------------------------------------------------------------------


def open_class(code: str) -> Prepared | None:
    """Enter the class of a code that was typed; None if there is none."""
    prepared = CLASSES.find(typed(code))
    if prepared is not None:
        _open_link(prepared.page, {"class": code})
        renew_widgets()
    return prepared


# --- The building -----------------------------------------------------------------


def choice() -> str:
    """The chosen drawing: the name of a sample, or `OWN`."""
    return st.session_state.choice


def choices() -> list[str]:
    """Every drawing that can be chosen."""
    return [*sample_names(), *([OWN] if st.session_state.own else [])]


def choose(name: str) -> None:
    """Choose a drawing; the sensor's range follows the length of its doors."""
    if name not in choices():
        return  # a choice made before an undo that removed the drawing
    if limits().drawing not in ("", name):
        return
    st.session_state.chosen = True
    _show(name)


def _show(name: str) -> None:
    st.session_state.choice = name
    range_px = defaults(name).range_px
    keep_settings(replace(settings(), range_px=range_px))
    open_players(building())


def building() -> Building:
    """The building that is mapped."""
    if choice() == OWN:
        return st.session_state.own
    return compute.sample(choice())


def fit_columns() -> None:
    """Give maps whose drawing does not fit this building the building's own."""
    offered = compute.prior_drawings(building())
    fitted = tuple(
        one
        if one.prior_drawing in offered
        else replace(one, prior_drawing=PriorDrawing.OWN)
        for one in settings().columns
    )
    if fitted != settings().columns:
        change(columns=fitted)


def drawing_title(name: str) -> str:
    """The name of a drawing on screen."""
    if name == OWN:
        return f"Yours: {st.session_state.own.title}"
    return f"{name}: {load_sample(name).title}"

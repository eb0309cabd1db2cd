"""What the open exercise or the class of a session holds, and the settings under it.

The settings are stored here alone, so that a value that is held is put back whatever
set it: a widget, a component, a link, or an undo.
"""

import random
import secrets
from collections.abc import Iterable, Mapping

import streamlit as st

from occsim import sample_names
from occsim.exercises import Exercise, with_draw
from pages._ui import compute, openings
from pages._ui import limits as rules
from pages._ui.classroom.prepared import Prepared
from pages._ui.limits import NONE, Limits
from pages._ui.settings import Settings
from pages._ui.state import opening

TEACHER = "your teacher"


def exercises() -> tuple[Exercise, ...]:
    """The exercises that this session can open: those of its class come first."""
    prepared = class_now()
    return compute.exercises_with(prepared.exercises if prepared else ())


def active() -> Exercise | None:
    """The exercise that is open; None if there is none."""
    wanted = st.session_state.get("exercise")
    if wanted is None:
        return None
    found = next((one for one in exercises() if one.id == wanted), None)
    if found is None or refusal(found):
        return None
    return opened(found)


def refusal(exercise: Exercise) -> str:
    """Why an exercise cannot be opened; empty where it is proven."""
    # Those of a class were proven when they were read.
    is_ours = exercise in compute.exercises()
    return compute.refusal(exercise.number) if is_ours else ""


# --- What an exercise draws by lot ----------------------------------------------------


def opened(exercise: Exercise) -> Exercise:
    """The exercise with what this session has drawn for it."""
    state = st.session_state
    seed = state.setdefault("seed", secrets.token_hex(8))
    return drawn(exercise, seed, state.get("draws", {}).get(exercise.id, 0))


def drawn(exercise: Exercise, seed: str, times: int) -> Exercise:
    """The exercise with what a seed draws for it, having drawn some times before."""
    if exercise.draw is None:
        return exercise
    lot = random.Random(f"{seed} {exercise.id} {times}")
    return with_draw(exercise, lot.choice(exercise.draw.values))


def draw_again(exercise: Exercise) -> None:
    """Draw anew what an exercise draws; it may come out the same."""
    draws = st.session_state.get("draws", {})
    times = draws.get(exercise.id, 0) + 1
    st.session_state.draws = draws | {exercise.id: times}


def class_now() -> Prepared | None:
    """The class of this session; None if it is in none."""
    return st.session_state.get("prepared")


def limits() -> Limits:
    """The limits of the class, and of the exercise that is open in it."""
    exercise, of_class = active(), _limits_of_class()
    if exercise is None:
        return of_class
    return rules.of_exercise(exercise, openings.of_exercise(exercise), of_class)


def _limits_of_class() -> Limits:
    prepared = class_now()
    if prepared is None or not (prepared.hide or prepared.lock):
        return NONE
    hidden, locked = rules.each(prepared.hide), rules.each(prepared.lock)
    drawing = class_drawing(prepared)
    return Limits(
        hidden=hidden,
        locked=locked,
        settings=opening.of_class(prepared, drawing),
        drawing=drawing if "drawing" in hidden | locked else "",
        by=TEACHER,
    )


def base() -> Settings:
    """The settings that this session's drawing opens with, those of its class first.

    An exercise that is none of the class has nothing of the class in it.
    """
    prepared, name = class_now(), st.session_state.choice
    if prepared is None or class_drawing(prepared) != name:
        return opening.defaults(name)
    exercise = active()
    if exercise is not None and exercise.id != prepared.texts.get("exercise"):
        return opening.defaults(name)
    return opening.of_class(prepared, name)


def held_place() -> Mapping[str, str]:
    """The step at which the exercise or the class opens, as in a link."""
    exercise, prepared = active(), class_now()
    if exercise is not None:
        texts: Mapping[str, str] = openings.texts_of_exercise(exercise)
    else:
        texts = prepared.texts if prepared is not None else {}
    return {name: text for name, text in texts.items() if name == "step"}


def class_drawing(prepared: Prepared) -> str:
    """The drawing of a class; the one that is shown where it names none."""
    named = prepared.texts.get("drawing")
    return named if named in sample_names() else st.session_state.choice


def keep_settings(settings: Settings) -> None:
    """Store the settings, with all that is held at its value."""
    st.session_state.settings = limits().kept(settings)


def close_exercise() -> None:
    """Close the exercise; what was set stays, but for what it hid to ask for it."""
    exercise = active()
    st.session_state.exercise = None
    hid = rules.told_by(exercise) if exercise else frozenset()
    opened = Limits(hidden=hid, settings=base())
    keep_settings(opened.kept(st.session_state.settings))


def limits_of(names: Iterable[str]) -> Limits:
    """The limits for a component that has some controls; those hidden are noted."""
    found = limits()
    for name in found.hidden.intersection(names):
        note_hidden(name)
    return found


def note_hidden(name: str) -> None:
    """Note that a control of this page is not drawn."""
    state = st.session_state
    state.not_drawn = state.get("not_drawn", frozenset()) | {name}


def not_drawn() -> frozenset[str]:
    """The controls of this page that are hidden; forgotten once they are told."""
    found = st.session_state.get("not_drawn", frozenset())
    st.session_state.not_drawn = frozenset()
    return found

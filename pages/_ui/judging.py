"""The state that an exercise judges, from what a student has set; and judged again.

One function makes it from a session and from a link, so that what was handed in is
judged as it was on the page.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any
from urllib.parse import parse_qsl

from occsim import OccsimError, load_sample, sample_names
from occsim.exercises import Exercise, ExerciseState, Facts, changed, judge
from occsim.prior import PRIOR_SCALE
from pages._ui import compute, openings
from pages._ui.columns import FLAWS
from pages._ui.components.lens.document import OPENING, LensDocument, with_texts
from pages._ui.components.player import PlayerDocument
from pages._ui.components.player.document import with_place
from pages._ui.progress import Attempt, Tried, Values
from pages._ui.settings import Settings, decode
from pages._ui.shared import shared

PLAYER_PAGES = "build_a_map", "two_maps"
LENS_PAGE = "what_the_sensor_says"
OF_LENS = ("behind_hit", "clear_no_hit", "rule", "range_px", "fov_deg")
OF_ALL = ("range_px", "fov_deg", "clear_no_hit", "wall_share", "truth_share", "region")
"""Settings that all maps of a page share."""
OF_MAP = ("p_wall", "p_space", "uninformative", "rule", "behind_hit", "cell_px")
"""Settings that each of several maps has for itself."""
NUMBERS = ("precision", "recall", "f2", "coverage")
LENS_NUMBERS = ("lens.n_empty", "lens.n_object", "lens.l")
"""What a progress says of a state, on the map pages and on that of the lens."""
SAME = 1e-6
"""Numbers this near are equal: they were written as text and read again."""


def state_of(
    exercise: Exercise,
    drawing: str,
    settings: Settings,
    played: PlayerDocument,
    lens: LensDocument,
    more: Mapping[str, Any],
) -> ExerciseState:
    """Return what a student has set, pinned and, in `more`, answered and moved."""
    values = _values(settings, exercise)
    cell_px, pin = values["cell_px"], played.pin_px
    values |= {name: getattr(settings, name) for name in OF_ALL}
    values |= {
        "drawing": drawing,
        "step": min(played.step, len(load_sample(drawing).trajectory)),
        "cell": pin and [int(at // cell_px) for at in reversed(pin)],
        **more,
    }
    if exercise.page == LENS_PAGE:
        values |= _from_lens(lens)
    return changed(ExerciseState(), values)


def _values(settings: Settings, exercise: Exercise) -> dict[str, Any]:
    """The settings of the student's own map: of map A where there are several."""
    if exercise.page == "two_maps":
        own: Any = settings.columns[0]
        flaws = FLAWS[own.flaw]
    else:
        own, flaws = settings, settings.flaws
    found = {name: getattr(own, name) for name in OF_MAP}
    found["prior_drawing"] = own.prior_drawing.value
    return found | asdict(flaws)


def _from_lens(document: LensDocument) -> dict[str, Any]:
    """What the student has set in the lens, by the names of an exercise."""
    return {
        **{name: getattr(document, name) for name in OF_LENS},
        "p_wall": min(1.0, document.p_free / PRIOR_SCALE),
        "lens_pose": [document.x_px, document.y_px, document.heading_deg],
        "lens_cell": [document.row, document.col],
        "lens_cell_px": document.cell_px,
    }


def numbers_of(exercise: Exercise, state: ExerciseState) -> dict[str, float]:
    """The numbers that a progress says of a state."""
    facts = Facts(state, exercise.context, compute.of_sample)
    names = LENS_NUMBERS if exercise.page == LENS_PAGE else NUMBERS
    return {name: float(facts.value(name)) for name in names}


# --- Judged again ---------------------------------------------------------------------


def state_of_link(exercise: Exercise, tried: Tried) -> ExerciseState:
    """Return the state that a progress holds; what it gives wrong is as it opens.

    Raises
    ------
    OccsimError
        Where its drawing is none of ours, or a value lies outside its domain.
    """
    texts = dict(parse_qsl(tried.link, keep_blank_values=True, max_num_fields=200))
    drawing = texts.get("drawing", "")
    if drawing not in sample_names():
        raise OccsimError("the state has no reference drawing")
    settings, _ = decode(texts, openings.of_sample(drawing))
    more: dict[str, Values] = {"answer": tried.answers, "moved": tried.moved}
    played = with_place(PlayerDocument(), texts)
    lens, _ = with_texts(OPENING, openings.lens_texts(texts))
    return state_of(exercise, drawing, settings, played, lens, more)


@dataclass(frozen=True, slots=True)
class Judged:
    """An attempt, judged again from its states.

    Parameters
    ----------
    is_solved : bool
        Whether every check holds at the state that was tried for it.
    is_as_claimed : bool
        Whether that and the numbers are what the file says.
    numbers : mapping
        The scores of the last state.
    """

    is_solved: bool
    is_as_claimed: bool
    numbers: Mapping[str, float]


def judged(exercise: Exercise, attempt: Attempt) -> Judged:
    """Judge an attempt again; shared by all who ask for the same one."""
    # All of the exercise: a teacher's own may differ in its reference alone.
    asked = exercise, attempt.is_solved, sorted(attempt.tried.items())
    return _judged(repr(asked), exercise, attempt)


@shared()
def _judged(key: str, _exercise: Exercise, _attempt: Attempt) -> Judged:
    if _exercise.is_open:
        return Judged(False, not _attempt.is_solved, {})
    held, claimed, found = [], [], {}
    for stage in range(len(_exercise.checks)):
        tried = _attempt.tried.get(stage)
        if tried is None:
            held.append(False)
            continue
        try:
            state = state_of_link(_exercise, tried)
            held.append(judge(_exercise, state, stage, compute.of_sample).is_solved)
            found = numbers_of(_exercise, state)
        except (OccsimError, ValueError):
            held.append(False)
            found = {}
        claimed.append(_are_same(tried.numbers, found))
    is_solved = all(held)
    return Judged(is_solved, all(claimed) and is_solved == _attempt.is_solved, found)


def _are_same(claimed: Mapping[str, float], found: Mapping[str, float]) -> bool:
    return claimed.keys() == found.keys() and all(
        abs(claimed[name] - value) <= SAME
        or (math.isnan(value) and math.isnan(claimed[name]))
        for name, value in found.items()
    )

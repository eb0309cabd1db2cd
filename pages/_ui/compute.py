"""Runs and what they need: simulated once, kept by digest, on a limited share of cores.

Arguments with a leading underscore are not part of a key; their digest is.
"""

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from occsim import (
    DrawingFlaws,
    MappingRun,
    MapSettings,
    OccsimError,
    ParameterError,
    flawed_mask,
    load_sample,
    prior_drawing,
)
from occsim._types import BoolArray
from occsim.building import Building
from occsim.exercises import Exercise, load_exercise, load_exercises
from occsim.imaging import Drawing
from occsim.io.images import class_png
from occsim.io.replay import MAX_ENTRIES
from occsim.io.ros_map import RosMap, building_from_map
from occsim.samples import OTHER_DRAWINGS, drawings_of_size, prior_unknown
from occsim.sensor import most_cells_in_view
from pages._ui import openings, palette
from pages._ui.choices import PriorDrawing
from pages._ui.runs import Run
from pages._ui.settings import Settings, with_changes
from pages._ui.shared import shared
from pages._ui.worker import WORKERS

# Thirty students may share two cores: without this limit all simulations would run at
# once, and each would take as long as all together.
_CORES = threading.BoundedSemaphore(os.cpu_count() or 1)
EXERCISES = Path(__file__).resolve().parents[2] / "assets" / "exercises"
PriorKey = tuple[PriorDrawing, DrawingFlaws]
"""Which drawing a prior is made from, and what that gets wrong."""


@contextmanager
def core() -> Iterator[None]:
    """Hold one of the machine's cores while computing."""
    with _CORES:
        yield


@shared()
def sample(name: str) -> Building:
    """A reference drawing as a building, its walls detected."""
    with core():
        return with_walls(load_sample(name))


def with_walls(building: Building) -> Building:
    """The same building with its walls detected, so that every edit keeps them."""
    return replace(building, found=building.walls_found)


def expect_drawings() -> None:
    """Get ready for uploads, where a page offers them."""
    WORKERS.start_early()


def own_building(drawing: Drawing, working_px: int) -> Building:
    """A building from an uploaded drawing; kept in the session, not cached."""
    return WORKERS.open_drawing(drawing, working_px)


def building_of_map(ros_map: RosMap, name: str, working_px: int) -> Building:
    """A building from a robot's map; kept in the session, not cached."""
    return WORKERS.call(building_from_map, ros_map, name, working_px=working_px)


def anonymous(building: Building) -> Building:
    """The same building without texts by the student who uploaded it.

    Cached values are shared by all sessions, so they must not contain a user's text.
    """
    drawing = replace(building.drawing, name="drawing")
    return replace(building, drawing=drawing, name="", title="", about="")


def mapped(building: Building, settings: MapSettings) -> MappingRun:
    """A building mapped under some settings; shared by all sessions with the same ones.

    Raises
    ------
    ParameterError
        Where the settings ask for more than a replay can hold. Raised before the
        simulation, which could take a minute.
    """
    n_readings = len(building.trajectory)
    grid = building.world.grid(settings.cell_px)
    most = n_readings * most_cells_in_view(settings.sensor, grid)
    if most > MAX_ENTRIES:
        raise ParameterError(
            f"{n_readings} readings with this range and field of view can make up to "
            f"{most:,} updates of cells of {settings.cell_px} px; at most "
            f"{MAX_ENTRIES:,} are simulated here: choose larger cells, a shorter "
            "range, a narrower field of view or fewer poses"
        )
    return _mapped(building.digest, settings, anonymous(building))


@shared("Simulating the readings")
def _mapped(digest: str, settings: MapSettings, _building: Building) -> MappingRun:
    run = MappingRun(_building, settings)
    with core():
        # Computed now, while a core is held, so that all who share the run find it
        # done.
        _ = run.evidence
    return run


@shared()
def exercises() -> tuple[Exercise, ...]:
    """The exercises of this app, to list: one is proven when it is opened.

    Proving all of them takes seconds on a busy machine, and the home page lists them.
    """
    return load_exercises(EXERCISES, prove=False)


@shared()
def refusal(number: int) -> str:
    """Why an exercise of this app cannot be opened; empty where it is proven."""
    (file,) = EXERCISES.glob(f"{number:02}_*.toml")
    try:
        load_exercise(file, readings=of_sample)
    except OccsimError as error:
        return str(error)
    return ""


@shared("Proving the exercises of the class")
def own_exercises(texts: tuple[str, ...]) -> tuple[Exercise, ...]:
    """Exercises of a teacher, numbered in their order; without those refused."""
    found: dict[str, Exercise] = {}
    for number, text in enumerate(texts, start=1):
        with suppress(OccsimError):
            one = proven(text, f"{number:02}_own")
            found.setdefault(one.id, one)
    return tuple(found.values())


def exercises_with(texts: tuple[str, ...]) -> tuple[Exercise, ...]:
    """A teacher's exercises, then ours: one of theirs takes the place of its id."""
    own = own_exercises(texts)
    taken = {one.id for one in own}
    return *own, *(one for one in exercises() if one.id not in taken)


def proven(text: str, name: str) -> Exercise:
    """The exercise of a file, proven.

    Raises
    ------
    ParameterError
        With the name of the file and one sentence, where it is refused.
    """
    # No core is held here: a proof waits for one whenever it simulates.
    found = load_exercise(text.encode(), name=name, readings=of_sample)
    try:
        openings.texts_of_exercise(found)
    except (ValueError, TypeError) as error:
        # A value that its page has no place for on the control.
        raise ParameterError(f"{name}: the set-up cannot be shown: {error}") from error
    return found


def of_sample(name: str, settings: MapSettings) -> MappingRun:
    """A reference drawing mapped under some settings, as `mapped` does."""
    return mapped(sample(name), settings)


def run(building: Building, settings: Settings) -> Run:
    """A building mapped under some settings, its surface and front computed."""
    made = Run(building, settings, with_errors(building, settings))
    with core():
        _ = made.front
    return made


def reference_run(name: str, settings: Settings) -> Run:
    """A reference drawing under some settings, the range its own door's length."""
    range_px = round(load_sample(name).sensor.range_px)
    return run(sample(name), with_changes(settings, {"range_px": range_px}))


def prior_drawings(building: Building) -> list[PriorDrawing]:
    """The drawings that a building's prior can be made from: those of its size."""
    names = {*OTHER_DRAWINGS, *drawings_of_size(building.drawing.shape)}
    return [one for one in PriorDrawing if one.value in names - {building.name}]


def prior_key(building: Building, settings: Settings) -> PriorKey:
    """Which drawing the prior is made from, and what that gets wrong."""
    return fitting(building, settings.prior_drawing, settings.flaws)


def fitting(building: Building, source: PriorDrawing, flaws: DrawingFlaws) -> PriorKey:
    if source not in prior_drawings(building):
        source = PriorDrawing.OWN  # chosen for a building of another size
    return source, flaws


def prior_mask(building: Building, settings: Settings) -> BoolArray | None:
    """The walls of the drawing with its errors; None where it has none."""
    return drawn_mask(building, prior_key(building, settings))


def drawn_mask(building: Building, drawn: PriorKey) -> BoolArray | None:
    """The same, of a drawing with errors."""
    if drawn == (PriorDrawing.OWN, DrawingFlaws()):
        return None
    return _prior_mask(building.digest, drawn, building)


@shared()
def _prior_mask(digest: str, drawn: PriorKey, _building: Building) -> BoolArray:
    source, flaws = drawn
    with core():
        return flawed_mask(prior_drawing(_building, source.value), flaws)


def with_errors(building: Building, settings: Settings) -> MappingRun:
    """A building mapped, the prior made from the drawing with its errors."""
    drawn = prior_key(building, settings)
    return drawn_run(building, settings.mapping, drawn)


def drawn_run(building: Building, mapping: MapSettings, drawn: PriorKey) -> MappingRun:
    """A building mapped, the prior made from a drawing with errors."""
    mask = drawn_mask(building, drawn)
    source, _ = drawn
    unknown = None if mask is None else prior_unknown(building, source.value)
    return mapped(building, mapping).with_prior_mask(mask, unknown)


def errors_picture(building: Building, settings: Settings) -> bytes:
    """A PNG of the walls of the prior over those of the building's drawing."""
    return _errors_picture(building.digest, prior_key(building, settings), building)


@shared()
def _errors_picture(digest: str, drawn: PriorKey, _building: Building) -> bytes:
    own, mask = _building.wall_mask, drawn_mask(_building, drawn)
    given = own if mask is None else mask
    colours = palette.FREE, palette.MISSED_WALL, palette.FALSE_WALL, palette.HIT
    return class_png(own.astype("uint8") + 2 * given, colours)

"""The only cached functions: simulate once, keep results by digest, share the cores.

Arguments with a leading underscore are not part of a key; their digest is.
"""

import os
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from occsim import (
    DrawingFlaws,
    MappingRun,
    MapSettings,
    OccsimError,
    ParameterError,
    Prior,
    Region,
    Sensor,
    Trajectory,
    UpdateRule,
    default_tour,
    estimated_prior,
    flawed_mask,
    load_sample,
    prior_drawing,
    sample_names,
)
from occsim._types import BoolArray, FloatArray
from occsim.building import Building, random_trajectory
from occsim.corrections import pack_mask
from occsim.exercises import Exercise, load_exercise, load_exercises
from occsim.imaging import Drawing
from occsim.imaging.tilt import estimate_tilt
from occsim.imaging.transform import Transform
from occsim.io.images import class_png, drawing_png, png
from occsim.io.replay import MAX_ENTRIES
from occsim.io.ros_map import RosMap, building_from_map
from occsim.priors import (
    SOURCE_AXIS,
    PriorSweep,
    hypervolume,
    interpolated_objective,
    nsga2_generations,
    reference_point,
    surface_objective,
)
from occsim.samples import OTHER_DRAWINGS, drawings_of_size
from occsim.sensor import most_cells_in_view
from occsim.study import StudyCase, StudySettings, run_case
from occsim.study.claims import ClaimsCase, judge_case
from occsim.study.cost import StepCost
from occsim.study.cost import step_costs as timed_steps
from occsim.walls import (
    MaskComparison,
    WallDetection,
    WallParams,
    compare_masks,
    detect_walls,
)
from pages._ui import palette
from pages._ui.choices import Objectives, PriorDrawing
from pages._ui.runs import Run
from pages._ui.settings import Settings, with_changes
from pages._ui.shared import shared
from pages._ui.worker import WORKER

# Thirty students may share two cores: without this limit all simulations would run at
# once, and each would take as long as all together.
_CORES = threading.BoundedSemaphore(os.cpu_count() or 1)


EXERCISES = Path(__file__).resolve().parents[2] / "assets" / "exercises"
PriorKey = tuple[PriorDrawing, DrawingFlaws]
"""Which drawing a prior is made from, and what that gets wrong."""
MANY_ENTRIES = 1_000_000
"""Cell updates of a run above which its timing is repeated less often."""


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
    WORKER.start_early()


def own_building(drawing: Drawing, working_px: int) -> Building:
    """A building from an uploaded drawing; kept in the session, not cached."""
    return WORKER.open_drawing(drawing, working_px)


def building_of_map(ros_map: RosMap, name: str, working_px: int) -> Building:
    """A building from a robot's map; kept in the session, not cached."""
    return WORKER.call(building_from_map, ros_map, name, working_px=working_px)


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


@shared("Proving the exercises")
def exercises() -> tuple[Exercise, ...]:
    """The exercises of this app, each proven."""
    with core():
        return load_exercises(EXERCISES)


@shared("Proving the exercises of the class")
def own_exercises(texts: tuple[str, ...]) -> tuple[Exercise, ...]:
    """Exercises of a teacher, numbered in their order; without those refused."""
    found: dict[str, Exercise] = {}
    for number, text in enumerate(texts, start=1):
        with suppress(OccsimError):
            one = proven(text, f"{number:02}_own")
            found.setdefault(one.id, one)
    return tuple(found.values())


def proven(text: str, name: str) -> Exercise:
    """The exercise of a file, proven.

    Raises
    ------
    ParameterError
        With the name of the file and one sentence, where it is refused.
    """
    # No core is held here: a proof waits for one whenever it simulates.
    return load_exercise(text.encode(), name=name, readings=of_sample)


def of_sample(name: str, settings: MapSettings) -> MappingRun:
    """A reference drawing mapped under some settings, as `mapped` does."""
    return mapped(sample(name), settings)


# --- Priors: sweeps and fronts --------------------------------------------------------


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
    mask = prior_mask(building, settings)
    return mapped(building, settings.mapping).with_prior_mask(mask)


def errors_picture(building: Building, settings: Settings) -> bytes:
    """A PNG of the walls of the prior over those of the building's drawing."""
    return _errors_picture(building.digest, prior_key(building, settings), building)


@shared()
def _errors_picture(digest: str, drawn: PriorKey, _building: Building) -> bytes:
    own, mask = _building.wall_mask, drawn_mask(_building, drawn)
    given = own if mask is None else mask
    colours = palette.FREE, palette.MISSED_WALL, palette.FALSE_WALL, palette.HIT
    return class_png(own.astype("uint8") + 2 * given, colours)


def calibrated(of: Run) -> Prior:
    """The calibrated prior; estimated from other drawings where there is no truth."""
    if of.building.truth is None:
        return estimated(of)
    return _stated(*of.mapped.calibrated)


def estimated(of: Run) -> Prior:
    """The calibrated prior as the reference drawings give it, this one left out."""
    others = [run.mapped for run in other_drawings(of)]
    counted = [(other.wall_cells, other.truth_cells) for other in others]
    return _stated(*estimated_prior(counted))


def best_in_bits(of: Run, rule: UpdateRule, region: Region = Region.ALL) -> Prior:
    """The prior whose final map has the least log loss over a region."""
    p_free_wall, p_free_space, _ = of.mapped.best_in_bits(rule, region)
    return _stated(p_free_wall, p_free_space)


def _stated(p_free_wall: float, p_free_space: float) -> Prior:
    """The prior of two probabilities that are not scaled."""
    return Prior(p_wall=p_free_wall, p_space=p_free_space, scale=1.0)


def transfer_runs(of: Run) -> dict[str, list[Run]]:
    """This run, the other reference drawings, and other tours of this building."""
    tours = _other_tours(of.building.digest, of.settings.sensor, of.building)
    return {
        "this drawing, this tour": [of],
        "other drawings": other_drawings(of),
        "other tours": [
            run(replace(of.building, trajectory=tour), of.settings) for tour in tours
        ],
    }


def other_drawings(of: Run) -> list[Run]:
    """The reference drawings but a run's own, each with its own walls.

    The errors of the run's drawing are in them too. Another building's drawing is not:
    it would fit some of them, and be the right one of one.
    """
    settings, names = of.settings, set(sample_names())
    if settings.prior_drawing.value in names:
        settings = with_changes(settings, {"prior_drawing": PriorDrawing.OWN})
    return [
        reference_run(name, settings)
        for name in sample_names()
        if name != of.building.name
    ]


@shared("Planning other tours")
def _other_tours(digest: str, sensor: Sensor, _building: Building) -> list[Trajectory]:
    """A shorter automatic tour, and as many random poses as the building's tour has."""
    world, n = _building.world, len(_building.trajectory)
    with core():
        short = default_tour(world, sensor, max_readings=max(1, n // 2))
        return [short, random_trajectory(world, n, seed=0)]


def sweep(of: Run, values: Sequence[float]) -> PriorSweep:
    """The exact scores of every pair of some values."""
    with core():
        return of.sweep(values)


@dataclass(frozen=True, eq=False, slots=True)
class SearchStep:
    """One generation of a search.

    ``real`` holds precision and recall of each pair's own map; ``seen`` the values that
    the search used instead, None where they are the same. ``share`` is the hypervolume
    of the real scores as a share of the exact front's.
    """

    number: int
    seen: FloatArray | None
    real: FloatArray
    share: float


def search_key(of: Run, settings: Settings) -> tuple[object, ...]:
    """All inputs of a search: equal keys give equal searches."""
    names = ("objectives", "elitism", "pop_size", "n_gen", "seed")
    own = tuple(getattr(settings, name) for name in names)
    return of.building.digest, of.settings.mapping, settings.rule, settings.region, own


def search(of: Run, settings: Settings) -> Iterator[SearchStep]:
    """The generations of a search for the front, each as soon as it is computed."""
    exact, ref = surface_objective(of.surface), reference_point(of.front)
    interpolated = settings.objectives is Objectives.INTERPOLATED
    table = interpolated_objective(sweep(of, SOURCE_AXIS))
    generations = nsga2_generations(
        table if interpolated else exact,
        pop_size=settings.pop_size,
        n_gen=settings.n_gen,
        seed=settings.seed,
        elitism=settings.elitism,
    )
    whole = of.front.hypervolume(ref)
    while True:
        # One generation at a time, so that other sessions can compute in between.
        with core():
            generation = next(generations, None)
            if generation is None:
                return
            real = exact(generation.population)
            share = hypervolume(real[:, 0], real[:, 1], ref) / whole
        seen = generation.objectives if interpolated else None
        yield SearchStep(generation.number, seen, real, share)


def step_costs(of: Run, priors: list[Prior]) -> list[StepCost]:
    """What one mapping step costs with each prior, measured now."""
    maps = [of.prior_map(prior) for prior in priors]
    few = of.evidence.cell.size > MANY_ENTRIES
    with core():
        return timed_steps(of.evidence, maps, of.settings.rule, 3 if few else 15)


def study_case(drawing: Building, cell_px: int, of: StudySettings) -> StudyCase:
    """One drawing at one cell size, swept and searched for its exact front."""
    key = drawing.name, drawing.digest, drawing.sensor
    return _study_case(key, cell_px, of, drawing)


@shared()
def _study_case(
    key: tuple[object, ...], cell_px: int, of: StudySettings, _drawing: Building
) -> StudyCase:
    with core():
        return run_case(_drawing, cell_px, of)


def claims_case(
    drawing: Building, cell_px: int, on_progress: Callable[[int, int], None]
) -> ClaimsCase:
    """Every claim of the source on one drawing at one cell size; about a second."""
    key = drawing.name, drawing.digest, drawing.sensor
    return _claims_case(key, cell_px, drawing, on_progress)


@shared()
def _claims_case(
    key: tuple[object, ...],
    cell_px: int,
    _drawing: Building,
    _on_progress: Callable[[int, int], None],
) -> ClaimsCase:
    with core():
        return judge_case(_drawing, cell_px, _on_progress)


# --- Your building: walls and pictures ------------------------------------------------


def detection(drawing: Drawing, params: WallParams) -> WallDetection:
    """The walls found in a drawing, with the picture of each stage."""
    return _detection(drawing.digest, params, drawing)


@shared("Looking for walls")
def _detection(digest: str, params: WallParams, _drawing: Drawing) -> WallDetection:
    with core():
        return detect_walls(_drawing, params)


def doubtful(building: Building) -> bytes:
    """The doubtful pieces of a building's walls, packed; none if they were not found
    in its drawing."""
    found = detection(building.drawing, building.wall_params)
    if found.certainty.doubtful and (found.mask == building.walls_found).all():
        return pack_mask(found.doubtful)
    return b""


def stage_pictures(drawing: Drawing, params: WallParams) -> list[tuple[str, bytes]]:
    """The stages of wall detection: title and PNG."""
    return _stage_pictures(drawing.digest, params, drawing)


@shared()
def _stage_pictures(
    digest: str, params: WallParams, _drawing: Drawing
) -> list[tuple[str, bytes]]:
    stages = detection(_drawing, params).stages
    with core():
        return [(title, png(image)) for title, image in stages]


def backdrop(drawing: Drawing) -> bytes:
    """A drawing as PNG, to draw on."""
    return _backdrop(drawing.digest, drawing)


@shared()
def _backdrop(digest: str, _drawing: Drawing) -> bytes:
    with core():
        return drawing_png(_drawing)


def reshaped(building: Building, transform: Transform) -> Building:
    """A building with its drawing cropped or turned; kept in the session."""
    with core():
        return with_walls(building.transformed(transform))


def tilt(drawing: Drawing) -> float | None:
    """Tilt of a drawing, rad; None where it is not clear."""
    return _tilt(drawing.digest, drawing)


@shared()
def _tilt(digest: str, _drawing: Drawing) -> float | None:
    with core():
        return estimate_tilt(_drawing)


def comparison(building: Building) -> MaskComparison:
    """Scores of the wall mask against the world, pixel by pixel."""
    return _comparison(building.digest, building)


@shared()
def _comparison(digest: str, _building: Building) -> MaskComparison:
    with core():
        return compare_masks(_building.wall_mask, _building.world.occupied)

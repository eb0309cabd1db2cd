"""Costly results on priors: the calibrated and the best, searches, studies, claims."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from occsim import (
    Prior,
    Region,
    Sensor,
    Trajectory,
    UpdateRule,
    default_tour,
    estimated_prior,
    sample_names,
)
from occsim._types import FloatArray
from occsim.building import Building, random_trajectory
from occsim.priors import (
    SOURCE_AXIS,
    PriorSweep,
    hypervolume,
    interpolated_objective,
    nsga2_generations,
    reference_point,
    surface_objective,
)
from occsim.study import StudyCase, StudySettings, run_case
from occsim.study.claims import ClaimsCase, judge_case
from occsim.study.cost import StepCost
from occsim.study.cost import step_costs as timed_steps
from pages._ui.choices import Objectives, PriorDrawing
from pages._ui.compute import core, reference_run, run
from pages._ui.runs import Run
from pages._ui.settings import Settings, with_changes
from pages._ui.shared import shared

MANY_ENTRIES = 1_000_000
"""Cell updates of a run above which its timing is repeated less often."""


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

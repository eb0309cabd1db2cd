"""The facts that a check may use, each computed when it is first asked for."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TypeAlias

import numpy as np

from occsim.exercises.grammar import Value
from occsim.exercises.state import (
    END,
    FLAWS,
    SETTINGS,
    ExerciseState,
    changed,
    setting_text,
)
from occsim.flaws import flawed_mask
from occsim.logodds import is_occupied
from occsim.mapping import OccupancyMap, UpdateRule
from occsim.metrics import Region, coverage, log_loss, score
from occsim.prior import Prior
from occsim.reading import Reading, one_reading
from occsim.run import MappingRun, MapSettings
from occsim.run.laps import lap_scores
from occsim.samples import load_sample, prior_drawing, sample_names
from occsim.samples.lens import lens_world

SHARES = ("precision", "recall", "f1", "f2", "iou", "accuracy", "coverage")
COUNTS = ("tp", "fp", "fn", "tn")
SCORES = (*SHARES, *COUNTS, "bits")
GROUPS = {
    "blank": SCORES,
    "looked": SCORES,
    "unseen": SCORES,
    "all": SCORES,
    "other": SCORES,
    "front": ("gap",),
    "cell": (
        *("row", "col", "k", "S", "l", "p_free"),
        *("drawn_wall", "true_wall", "declared", "wall_share"),
    ),
    "lens": ("n_empty", "n_object", "q", "l", "n_false_object", "object_pixels"),
    "twice": ("max_gap",),
    "count": ("free_empty", "wall_empty", "share"),
    "lineup": ("best_once", "best_subtract"),
    "laps": ("enough",),
    "study": tuple(
        f"{rule}_{peak}"
        for rule in ("once", "subtract")
        for peak in ("recall_at_low_wall", "precision_at_low_space")
    ),
    "set": (*SETTINGS, *FLAWS),
    "moved": None,
    "answer": None,
}
"""The facts of each group; None where the state says which there are."""
LENS_RANGE_PX = 36.0
MAX_LAPS = 20
STUDY_CELLS_PX = (3, 5, 10)


@dataclass(frozen=True, kw_only=True, slots=True)
class Context:
    """What an exercise names beside the student's state.

    Parameters
    ----------
    other : str
        The drawing of `other.*`.
    lineup : tuple of str
        The drawings of `lineup.*`.
    reference : mapping
        Settings of the map of `twice.*`.
    """

    other: str = "own"
    lineup: tuple[str, ...] = ()
    reference: Mapping[str, object] = field(default_factory=dict)


def is_fact(name: str) -> bool:
    """Return whether a name is that of a fact, not a word."""
    group, _, rest = name.partition(".")
    if not rest:
        return name in SCORES or name == "first_wall_step"
    names = GROUPS.get(group, ())
    return names is None or rest in names


Readings: TypeAlias = Callable[[str, MapSettings], MappingRun]
"""Gives a sample, mapped under some settings."""


@lru_cache(maxsize=16)
def simulated(drawing: str, settings: MapSettings) -> MappingRun:
    """Return a sample mapped under some settings; the last few are kept.

    Parameters
    ----------
    drawing : str
        Name of a sample.
    settings : MapSettings
        Cells and sensor.

    Returns
    -------
    MappingRun
    """
    run = MappingRun(load_sample(drawing), settings)
    _ = run.evidence
    return run


class Facts:
    """The facts of one state.

    Parameters
    ----------
    state : ExerciseState
        What the student set, pinned and answered.
    context : Context, optional
        What the exercise names.
    readings : callable, optional
        Gives a sample mapped under some settings; `simulated` by default. An
        application that keeps runs, or bounds them, gives its own.

    Examples
    --------
    >>> from occsim.exercises import ExerciseState
    >>> facts = Facts(ExerciseState(drawing="d", uninformative=True))
    >>> round(facts.value("coverage"), 3)
    0.656
    """

    def __init__(
        self,
        state: ExerciseState,
        context: Context | None = None,
        readings: Readings = simulated,
    ) -> None:
        self.state, self.context = state, context or Context()
        self._readings = readings

    def value(self, name: str) -> Value:
        """Return a fact; NaN where it is undefined, a word where it is none.

        Parameters
        ----------
        name : str
            As in a check.

        Returns
        -------
        float, bool or str
        """
        if not is_fact(name):
            return name
        group, _, rest = name.partition(".")
        if name == "first_wall_step":
            return self.first_wall_step
        if not rest:
            return self._score(self.map, self.state.region, name)
        if group in ("moved", "answer"):
            given = self.state.moved if group == "moved" else self.state.answers
            return given.get(rest, math.nan)
        if group == "set":
            return setting_text(self.state, rest)
        return getattr(self, f"_{group}")(rest)  # type: ignore[no-any-return]

    # --- Maps and their scores --------------------------------------------------------

    @cached_property
    def run(self) -> MappingRun:
        """The student's building, mapped."""
        sample = load_sample(self.state.drawing)
        settings = MapSettings(
            cell_px=self.state.cell_px,
            sensor=self.state.sensor(sample.sensor.range_px),
            wall_share=self.state.wall_share,
            truth_share=self.state.truth_share,
        )
        return self._with_drawing(
            self._readings(self.state.drawing, settings), self.state.prior_drawing
        )

    def _with_drawing(self, run: MappingRun, which: str) -> MappingRun:
        mask = prior_drawing(run.building, which)
        return run.with_prior_mask(flawed_mask(mask, self.state.flaws))

    @property
    def n_readings(self) -> int:
        """Readings in the map."""
        last = self.run.evidence.n_readings
        return last if self.state.step == END else min(int(self.state.step), last)

    @cached_property
    def map(self) -> OccupancyMap:
        """The student's map."""
        return self._map(self.run, self.state.prior)

    @cached_property
    def _blank_map(self) -> OccupancyMap:
        return self._map(self.run, Prior.uninformative())

    def _map(self, run: MappingRun, prior: Prior) -> OccupancyMap:
        return run.map(prior, self.state.rule, self.n_readings)

    def _score(self, final: OccupancyMap, region: Region, name: str) -> float:
        truth = self.run.truth_cells
        if name == "coverage":
            return coverage(final)
        if name == "bits":
            return log_loss(final, truth, region)
        return float(getattr(score(final, truth, region), name))

    def _blank(self, name: str) -> float:
        return self._score(self._blank_map, self.state.region, name)

    def _looked(self, name: str) -> float:
        return self._score(self.map, Region.EXPLORED, name)

    def _unseen(self, name: str) -> float:
        return self._score(self.map, Region.UNEXPLORED, name)

    def _all(self, name: str) -> float:
        return self._score(self.map, Region.ALL, name)

    def _other(self, name: str) -> float:
        run = self._with_drawing(self.run, self.context.other)
        return self._score(self._map(run, self.state.prior), self.state.region, name)

    def _front(self, _: str) -> float:
        """Chebyshev distance of the map's scores from the exact front."""
        front = self.run.front(self.state.rule, self.state.region)
        found = score(self.map, self.run.truth_cells, self.state.region)
        gaps = np.maximum(
            np.abs(front.precision - found.precision),
            np.abs(front.recall - found.recall),
        )
        return float(gaps.min()) if gaps.size else math.nan

    @cached_property
    def first_wall_step(self) -> float:
        """The first reading after which a true wall is declared; NaN if none is."""
        curves = self.run.curves(self.state.prior, self.state.rule, self.state.region)
        found = np.flatnonzero(curves.tp >= 1)
        return float(found[0]) if found.size else math.nan

    # --- Cells ------------------------------------------------------------------------

    def _cell(self, name: str) -> float | bool:
        grid, cell = self.run.grid, self.state.cell
        if cell is None or cell[0] >= grid.n_rows or cell[1] >= grid.n_cols:
            return math.nan
        if name in ("row", "col"):
            return float(cell[name == "col"])
        if name in ("drawn_wall", "true_wall", "declared"):
            masks = {
                "drawn_wall": self.run.wall_cells,
                "true_wall": self.run.truth_cells,
                "declared": is_occupied(self.map.log_odds),
            }
            return bool(masks[name][cell])
        values = {
            "k": self.map.n_updates,
            "S": self._blank_map.log_odds,
            "l": self.map.log_odds,
            "p_free": self.map.p_free,
            "wall_share": grid.share(self.run.building.world.occupied),
        }
        return float(values[name][cell])

    def _twice(self, _: str) -> float:
        """Greatest difference of log-odds from the reference, in cells read twice."""
        reference = changed(self.state, self.context.reference)
        other = Facts(reference, self.context, self._readings)
        twice = self.map.n_updates == 2
        gaps = np.abs(self.map.log_odds - other.map.log_odds)[twice]
        return float(gaps.max()) if gaps.size else math.nan

    # --- The lens, and a thousand cells -----------------------------------------------

    @cached_property
    def _reading(self) -> Reading:
        x, y, degrees = self.state.lens_pose
        world = lens_world()
        return one_reading(
            world,
            (x, y, math.radians(degrees)),
            self.state.sensor(LENS_RANGE_PX),
            world.grid(self.state.lens_cell_px),
        )

    def _lens(self, name: str) -> float:
        seen, cell = self._reading, self.state.lens_cell
        if name == "object_pixels":
            return float(seen.object.sum())
        if name == "n_false_object":
            return float((seen.object & ~lens_world().occupied).sum())
        if cell is None or cell[0] >= seen.grid.n_rows or cell[1] >= seen.grid.n_cols:
            return math.nan
        n_empty, n_object = float(seen.n_empty[cell]), float(seen.n_object[cell])
        if name == "q":
            total = n_empty + n_object
            return n_empty / total if total else math.nan
        values = {"n_empty": n_empty, "n_object": n_object}
        return values.get(name, float(seen.log_odds[cell]))

    def _count(self, name: str) -> float:
        """Count a thousand cells that are drawn as wall, each read once, 0.9 right."""
        free = round(1000.0 * self.state.prior.p_free_wall)
        counted = {
            "free_empty": float(round(0.9 * free)),
            "wall_empty": float(round(0.1 * (1000 - free))),
        }
        read_empty = counted["free_empty"] + counted["wall_empty"]
        counted["share"] = counted["free_empty"] / read_empty
        return counted[name]

    # --- Several runs -----------------------------------------------------------------

    def _lineup(self, name: str) -> str:
        """Return the drawing whose prior gives the best F2 under a rule."""
        once = name == "best_once"
        rule = UpdateRule.PRIOR_ONCE if once else UpdateRule.SUBTRACT_PRIOR
        found = {
            which: self._with_drawing(self.run, which).scores(self.state.prior, rule).f2
            for which in self.context.lineup
        }
        return max(found, key=found.__getitem__, default="")

    def _laps(self, _: str) -> float:
        """Fewest laps of the tour after which a drawing adds less than 0.01 recall."""
        for laps in range(1, MAX_LAPS + 1):
            own, blank = (
                lap_scores(
                    self.run, prior, laps, self.state.rule, self.state.region
                ).recall
                for prior in (self.state.prior, Prior.uninformative())
            )
            if own - blank < 0.01:
                return float(laps)
        return math.nan

    def _study(self, name: str) -> float:
        """Of the 15 cases of the study, those whose peaks lie at low priors."""
        rule_name, _, peak = name.partition("_")
        once = rule_name == "once"
        rule = UpdateRule.PRIOR_ONCE if once else UpdateRule.SUBTRACT_PRIOR
        return float(
            sum(
                self._peaks_low(drawing, cell_px, rule)[peak]
                for drawing in sample_names()
                for cell_px in STUDY_CELLS_PX
            )
        )

    def _peaks_low(
        self, drawing: str, cell_px: int, rule: UpdateRule
    ) -> dict[str, bool]:
        """Return whether maxima of the source's 10 x 10 pairs, or ties, lie low."""
        settings = MapSettings(cell_px=cell_px, sensor=load_sample(drawing).sensor)
        sweep = self._readings(drawing, settings).sweep(rule=rule)
        recall = sweep.recall == np.nanmax(sweep.recall)
        precision = sweep.precision == np.nanmax(sweep.precision)
        low_space = sweep.p_space <= 0.5 + 1e-9
        return {
            "recall_at_low_wall": bool(recall[0].any()),
            "precision_at_low_space": bool(precision[:, low_space].any()),
        }

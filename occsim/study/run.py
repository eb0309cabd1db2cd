"""A study: drawings times cell sizes, each swept and searched for its exact front."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from occsim.building import Building
from occsim.errors import ParameterError, choice
from occsim.mapping import UpdateRule
from occsim.metrics import Region, Scores
from occsim.prior import Prior
from occsim.priors import (
    MIN_RECALL,
    SOURCE_AXIS,
    Maxima,
    Objective,
    ParetoFront,
    PriorSweep,
    maxima,
    recommend,
)
from occsim.run import MappingRun, MapSettings
from occsim.samples import load_sample, sample_names
from occsim.sensor import BehindHit


@dataclass(frozen=True, kw_only=True, slots=True)
class StudySettings:
    """Settings shared by all cases of a study.

    Parameters
    ----------
    rule : UpdateRule, default UpdateRule.SUBTRACT_PRIOR
        How a reading enters the map: as in the source, as we reconstruct it.
    region : Region, default Region.EXPLORED
        Which cells are scored.
    behind_hit : BehindHit, default BehindHit.OCCUPIED
        What the sensor says of pixels behind a wall.
    low, high : float, default 0.1 and 1
        Box of the exact front.
    wall_share, truth_share : float, default 0
        Share of wall pixels that a cell of the drawing, and of the ground truth, must
        exceed to be a wall cell.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim.study import StudySettings
    >>> StudySettings(rule="prior_once").rule
    <UpdateRule.PRIOR_ONCE: 'prior_once'>
    """

    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR
    region: Region = Region.EXPLORED
    behind_hit: BehindHit = BehindHit.OCCUPIED
    low: float = SOURCE_AXIS[0]
    high: float = SOURCE_AXIS[-1]
    wall_share: float = 0.0
    truth_share: float = 0.0

    def __post_init__(self) -> None:
        kinds = {"rule": UpdateRule, "region": Region, "behind_hit": BehindHit}
        for name, kind in kinds.items():
            object.__setattr__(self, name, choice(name, getattr(self, name), kind))
        if not 0.0 < self.low <= self.high <= 1.0:
            raise ParameterError(
                "low and high must satisfy 0 < low <= high <= 1; got "
                f"{self.low!r} and {self.high!r}"
            )
        MapSettings(wall_share=self.wall_share, truth_share=self.truth_share)


@dataclass(frozen=True, eq=False)
class StudyCase:
    """One drawing at one cell size.

    Parameters
    ----------
    name : str
        The drawing's.
    cell_px : int
        Cell size, px.
    sweep : PriorSweep
        Scores at the source's 10 x 10 pairs.
    front : ParetoFront
        The exact one.
    blank : Scores
        Of the map without a drawing: a prior of one half.
    is_reference : bool
        Whether the drawing is a sample, for which there are published figures.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.study import run_case
    >>> run_case(load_sample("d"), 10).sweep.precision.shape
    (10, 10)
    """

    name: str
    cell_px: int
    sweep: PriorSweep
    front: ParetoFront
    blank: Scores
    is_reference: bool = False

    @cached_property
    def precision(self) -> Maxima:
        """Largest precision of the sweep and all of its pairs (Table 4.1)."""
        return maxima(self.sweep, Objective.PRECISION)

    @cached_property
    def recall(self) -> Maxima:
        """Largest recall of the sweep and all of its pairs (Table 4.2)."""
        return maxima(self.sweep, Objective.RECALL)

    def maxima(self, objective: Objective) -> Maxima:
        """Return the maxima of one objective."""
        chosen = choice("objective", objective, Objective)
        return self.precision if chosen is Objective.PRECISION else self.recall

    @property
    def conflict(self) -> bool:
        """Whether no pair of the sweep attains both maxima."""
        if np.isnan(self.precision.value) or np.isnan(self.recall.value):
            return False
        both = (self.sweep.precision == self.precision.value) & (
            self.sweep.recall == self.recall.value
        )
        return not both.any()

    def recommended(self, min_recall: float = MIN_RECALL) -> int | None:
        """Return the index of the front's best F2 within set C, or None."""
        return recommend(self.front, min_recall)


@dataclass(frozen=True)
class Pattern:
    """In how many cases the pattern of the source's tables appears.

    Parameters
    ----------
    n_cases : int
        Cases whose precision and recall are both defined somewhere.
    recall_at_full_space : int
        Recall peaks with p_space = 1 (among its ties).
    precision_at_low_space : int
        Precision peaks with p_space at most 0.5 (among its ties).
    conflicts : int
        No pair attains both maxima.
    recall_only_at_full_space, precision_only_at_low_space : int
        The same two, counting only cases with all ties there.
    """

    n_cases: int
    recall_at_full_space: int
    precision_at_low_space: int
    conflicts: int
    recall_only_at_full_space: int
    precision_only_at_low_space: int


LOW_SPACE = 0.5
"""Largest p_space that counts as low in `Pattern`."""


def is_reference(building: Building) -> bool:
    """Return whether this is an unchanged sample, not only a building of that name.

    Parameters
    ----------
    building : Building
        Any.

    Returns
    -------
    bool
    """
    if building.name not in sample_names():
        return False
    return building.digest == load_sample(building.name).digest


def run_case(
    drawing: Building, cell_px: int, settings: StudySettings | None = None
) -> StudyCase:
    """Return the sweep and the exact front of one drawing at one cell size.

    Parameters
    ----------
    drawing : Building
        What is mapped, with the building's own sensor but the settings' `behind_hit`;
        poses outside the drawing or in walls are left out.
    cell_px : int
        Cell size, px.
    settings : StudySettings, optional
        The source's by default.

    Returns
    -------
    StudyCase

    Raises
    ------
    ParameterError
        Where the cell size lies outside its domain.
    TrajectoryError
        Where no pose stands in free space.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.study import StudySettings, run_case
    >>> case = run_case(load_sample("d"), 10, StudySettings(rule="prior_once"))
    >>> case.name, case.cell_px
    ('d', 10)
    """
    settings = settings or StudySettings()
    sensor = replace(drawing.sensor, behind_hit=settings.behind_hit)
    run = MappingRun(
        replace(
            drawing,
            found=drawing.walls_found,
            trajectory=drawing.valid_trajectory(),
        ),
        MapSettings(
            cell_px=cell_px,
            sensor=sensor,
            wall_share=settings.wall_share,
            truth_share=settings.truth_share,
        ),
    )
    rule, region = settings.rule, settings.region
    return StudyCase(
        name=drawing.name,
        cell_px=cell_px,
        sweep=run.sweep(rule=rule, region=region),
        front=run.front(rule, region, settings.low, settings.high),
        blank=run.scores(Prior.uninformative(), rule, region),
        is_reference=is_reference(drawing),
    )


def pattern(cases: Iterable[StudyCase]) -> Pattern:
    """Return in how many cases the source's pattern appears.

    Parameters
    ----------
    cases : iterable of StudyCase
        Those without any defined precision or recall are left out.

    Returns
    -------
    Pattern
    """
    found = np.zeros(6, dtype=np.int64)
    for case in cases:
        if np.isnan(case.precision.value + case.recall.value):
            continue
        full = case.recall.p_space == 1.0
        low = case.precision.p_space <= LOW_SPACE
        ties = full.any(), low.any(), case.conflict, full.all(), low.all()
        found += np.array((True, *ties))
    return Pattern(*found.tolist())

"""What the claims are judged by: the surfaces and maps of one case, one condition."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray
from occsim.building import Building
from occsim.evidence import collect_evidence
from occsim.evidence_log import EvidenceLog, EvidenceTotals
from occsim.flaws import DrawingFlaws, flawed_mask
from occsim.logodds import is_occupied
from occsim.mapping import UpdateRule, prior_weight
from occsim.metrics import f_beta_of, precision_of, recall_of
from occsim.prior import (
    PRIOR_SCALE,
    SOURCE_PAIR,
    Prior,
    prior_from_cells,
    unknown_cells,
)
from occsim.priors import (
    SOURCE_AXIS,
    Maxima,
    Objective,
    ParetoFront,
    PriorSurface,
    PriorSweep,
    maxima,
    near_front,
    prior_surface,
    surface_front,
    sweep_surface,
)
from occsim.sensor import BehindHit
from occsim.study.claims.conditions import CONDITIONS, Condition, Reach, Readings, Walls
from occsim.study.cost import step_costs
from occsim.world import truth_cells, wall_cells

LAPS = 3
NEAR = 0.03
"""A pair counts as on the front within this of precision and of recall."""
TIMED_RUNS = 5


@dataclass(frozen=True, eq=False)
class Openings:
    """Where the structure of a world can be closed or thickened.

    Parameters
    ----------
    doorways : ndarray of bool, shape (R, C)
        Free cells between walls that stand no further apart than a door is long, in
        one row or column.
    beside : ndarray of bool, shape (R, C)
        Other free cells that touch a wall cell.
    """

    doorways: BoolArray
    beside: BoolArray


@dataclass(frozen=True, eq=False)
class Facts:
    """One case under one condition.

    Parameters
    ----------
    condition : Condition
        The condition.
    totals : EvidenceTotals
        What its readings said.
    is_wall : ndarray of bool, shape (R, C)
        Wall cells of the prior.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    openings : Openings
        Of the truth.
    cost_ratio : float
        Time of a step with an informative prior, over that with a blank one.
    is_unknown : ndarray of bool, shape (R, C), optional
        Cells of which the prior says nothing; none by default.
    """

    condition: Condition
    totals: EvidenceTotals
    is_wall: BoolArray
    truth: BoolArray
    openings: Openings
    cost_ratio: float
    is_unknown: BoolArray | None = None

    @cached_property
    def surface(self) -> PriorSurface:
        """True and false positives of every prior pair."""
        rule, region = self.condition.rule, self.condition.region
        cells = self.is_wall, self.truth
        unknown = self.is_unknown
        return prior_surface(
            self.totals, *cells, rule, region, PRIOR_SCALE, is_unknown=unknown
        )

    @cached_property
    def sweep(self) -> PriorSweep:
        """Scores at the source's 10 x 10 pairs."""
        return sweep_surface(self.surface, SOURCE_AXIS, SOURCE_AXIS)

    @cached_property
    def front(self) -> ParetoFront:
        """The exact front of the pairs that the source searched."""
        return surface_front(self.surface, SOURCE_AXIS[0], SOURCE_AXIS[-1])

    @cached_property
    def precision(self) -> Maxima:
        """Largest precision of the sweep, and its pairs."""
        return maxima(self.sweep, Objective.PRECISION)

    @cached_property
    def recall(self) -> Maxima:
        """Largest recall of the sweep, and its pairs."""
        return maxima(self.sweep, Objective.RECALL)

    def peak(self, objective: Objective) -> BoolArray:
        """Return which pairs of the sweep attain the maximum, (10, 10)."""
        best = self.precision if objective is Objective.PRECISION else self.recall
        return np.asarray(self.sweep.values(objective) == best.value)

    @cached_property
    def near(self) -> BoolArray:
        """Which pairs of the sweep lie on the front, within `NEAR`, (10, 10)."""
        return near_front(self.sweep, self.front, NEAR)

    @cached_property
    def scored(self) -> BoolArray:
        """Cells that are scored, (R, C)."""
        return self.condition.region.scored(self.totals.counts)

    def source_scores(self) -> tuple[float, float, float]:
        """Return precision, recall and F2 of the source's pair."""
        tp, fp = self.surface.counts(*SOURCE_PAIR)
        return self._scores(int(tp), int(fp))

    def blank_scores(self) -> tuple[float, float, float]:
        """Return precision, recall and F2 of the map without a drawing."""
        level, surface = np.zeros(()), self.surface
        tp = surface.wall_tp(level) + surface.space_tp(level)
        fp = surface.wall_fp(level) + surface.space_fp(level)
        return self._scores(int(tp), int(fp))

    def _scores(self, tp: int, fp: int) -> tuple[float, float, float]:
        fn = self.surface.n_wall - tp
        scores = precision_of(tp, fp), recall_of(tp, fn), f_beta_of(tp, fp, fn, 2.0)
        return float(scores[0]), float(scores[1]), float(scores[2])

    def declared(self, p_wall: float, p_space: float) -> BoolArray:
        """Return the cells that the map of a pair declares wall, (R, C)."""
        prior = prior_from_cells(
            self.is_wall,
            self.totals.grid,
            Prior(p_wall=p_wall, p_space=p_space),
            self.is_unknown,
        ).log_odds
        weight = prior_weight(self.totals.counts, self.condition.rule)
        return is_occupied(self.totals.sums + weight * prior)


def facts_of(building: Building, cell_px: int) -> Iterator[Facts]:
    """Yield a case under every condition, in their order.

    The readings depend on neither prior nor rule nor region, nor on the walls of the
    prior, so they are simulated once a range and rule behind a hit.

    Parameters
    ----------
    building : Building
        Poses in walls or outside are left out.
    cell_px : int
        Cell size, px.

    Yields
    ------
    Facts

    Raises
    ------
    TrajectoryError
        Where no pose stands in free space.
    """
    case = _Case(building, cell_px)
    for condition in CONDITIONS:
        yield case.facts(condition)


class _Case:
    """A building at one cell size; what conditions share is computed once."""

    def __init__(self, building: Building, cell_px: int) -> None:
        self.building = building
        self.trajectory = building.valid_trajectory()
        self.grid = building.world.grid(cell_px)
        self.truth = truth_cells(building.world, self.grid)
        door_px = building.door_px or building.sensor.range_px
        self.openings = find_openings(self.truth, door_px / cell_px)
        self.log = lru_cache(self._log)
        self.totals = lru_cache(self._totals)
        self.walls = lru_cache(self._walls)
        self.unknown = lru_cache(self._unknown)
        self.cost_ratio = lru_cache(self._cost_ratio)

    def facts(self, condition: Condition) -> Facts:
        """Return the case under one condition."""
        seen = condition.behind_hit, condition.reach
        return Facts(
            condition=condition,
            totals=self.totals(*seen, condition.readings),
            is_wall=self.walls(condition.walls),
            is_unknown=self.unknown(condition.walls),
            truth=self.truth,
            openings=self.openings,
            cost_ratio=self.cost_ratio(*seen, condition.rule),
        )

    def _log(self, behind_hit: BehindHit, reach: Reach) -> EvidenceLog:
        own = self.building.sensor
        sensor = replace(
            own, behind_hit=behind_hit, range_px=reach.factor * own.range_px
        )
        return collect_evidence(self.building.world, self.trajectory, sensor, self.grid)

    def _totals(
        self, behind_hit: BehindHit, reach: Reach, readings: Readings
    ) -> EvidenceTotals:
        log = self.log(behind_hit, reach)
        if readings is Readings.LAPS:
            # Poses are known and the sensor has no noise: each lap says the same.
            sums, counts = log.totals()
            return EvidenceTotals(self.grid, LAPS * sums, LAPS * counts)
        step = {Readings.SECOND: 2, Readings.FOURTH: 4}.get(readings, 1)
        return every(log, step)

    def _walls(self, walls: Walls) -> BoolArray:
        if walls is Walls.TRUE:
            return self.truth
        flaws = DrawingFlaws(thickness_px=-walls.thinned_px)
        return wall_cells(flawed_mask(self.building.wall_mask, flaws), self.grid)

    def _unknown(self, walls: Walls) -> BoolArray | None:
        if walls is Walls.TRUE:
            return None
        return unknown_cells(self.building.unknown, self.walls(walls), self.grid)

    def _cost_ratio(
        self, behind_hit: BehindHit, reach: Reach, rule: UpdateRule
    ) -> float:
        log, walls = self.log(behind_hit, reach), self.walls(Walls.FOUND)
        priors = Prior(), Prior.uninformative()
        maps = [prior_from_cells(walls, self.grid, prior) for prior in priors]
        # The fastest of some runs: other load on the machine only makes them slower.
        drawn, blank = (c.range_us[0] for c in step_costs(log, maps, rule, TIMED_RUNS))
        return drawn / blank


def every(log: EvidenceLog, step: int) -> EvidenceTotals:
    """Return the totals of every so many readings, the first among them.

    Parameters
    ----------
    log : EvidenceLog
        All readings.
    step : int
        1 takes all of them.

    Returns
    -------
    EvidenceTotals
    """
    taken = log.reading % step == 0
    cell, n_cells = log.cell[taken], log.grid.n_cells
    # Exact: log-odds are whole multiples of one step.
    sums = np.bincount(cell, log.log_odds[taken], n_cells).astype(np.float64)
    counts = np.bincount(cell, minlength=n_cells).reshape(log.grid.shape)
    return EvidenceTotals(log.grid, sums.reshape(log.grid.shape), counts)


def find_openings(truth: BoolArray, door_cells: float) -> Openings:
    """Return where a map can close doorways and thicken walls.

    Parameters
    ----------
    truth : ndarray of bool, shape (R, C)
        Wall cells.
    door_cells : float
        Length of a door, in cells.

    Returns
    -------
    Openings

    Examples
    --------
    >>> import numpy as np
    >>> truth = np.array([[True, False, False, True, False, False, False, True]])
    >>> find_openings(truth, 2.0).doorways.nonzero()[1]
    array([1, 2])
    """
    walls = truth.astype(np.uint8)
    closed = np.zeros(truth.shape, dtype=np.bool_)
    # A line of n cells fits into no gap of fewer: closing fills these.
    length = int(np.floor(door_cells + 1e-9)) + 1
    for shape in ((1, length), (length, 1)):
        closed |= _closed(walls, shape)
    doorways = closed & ~truth
    touched = cv2.dilate(walls, np.ones((3, 3), np.uint8)).astype(np.bool_)
    return Openings(doorways=doorways, beside=touched & ~truth & ~doorways)


def _closed(walls: ByteArray, shape: tuple[int, int]) -> BoolArray:
    # Framed with free space: a wall and the border make no doorway.
    frame = max(shape)
    framed, line = np.pad(walls, frame), np.ones(shape, np.uint8)
    # The anchor of the erosion mirrors that of the dilation: even lines do not shift.
    first = (shape[1] - 1) // 2, (shape[0] - 1) // 2
    last = shape[1] - 1 - first[0], shape[0] - 1 - first[1]
    grown = cv2.dilate(framed, line, anchor=first)
    closed = cv2.erode(grown, line, anchor=last)[frame:-frame, frame:-frame]
    return closed.astype(np.bool_)

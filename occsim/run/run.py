"""A mapping run: a building under some settings, and all results.

The readings, the cells' classes and the surface of scores are computed when they are
first asked for, and kept. Nothing of a run depends on a prior or on an update rule:
those are arguments.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy.typing as npt

from occsim._types import BoolArray
from occsim.building import Building
from occsim.errors import bool_array, choice
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.mapping import OccupancyMap, UpdateRule, fuse
from occsim.metrics import (
    Measure,
    Region,
    ScoreCurves,
    Scores,
    log_loss,
    score,
    scores_by_reading,
    worth_in_readings,
)
from occsim.prior import Prior, PriorMap, calibrated_prior, prior_from_cells
from occsim.prior import unknown_cells as cells_unknown
from occsim.priors import (
    SOURCE_AXIS,
    LossSurface,
    ParetoFront,
    PriorSurface,
    PriorSweep,
    loss_surface,
    prior_surface,
    surface_front,
    sweep_surface,
)
from occsim.run.readings import simulated_readings, simulated_scans
from occsim.run.settings import MapSettings
from occsim.scan import ScanLog
from occsim.world import truth_cells, wall_cells

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class MappingRun:
    """One building mapped under one `MapSettings`, ready for any prior.

    Parameters
    ----------
    building : Building
        Drawing, walls, world and trajectory.
    settings : MapSettings
        Cells and sensor.
    log : EvidenceLog, optional
        The readings, if already known, of the same world, trajectory, sensor and cells.
        By default they are simulated.
    prior_mask : ndarray of bool, shape (H, W), optional
        Walls that the prior is made from; the building's by default. The world stays
        what it is.
    prior_unknown : ndarray of bool, shape (H, W), optional
        Pixels of which the prior says nothing; the building's by default.

    Raises
    ------
    TypeError, ParameterError
        Where a mask is not bool, or not of the drawing's size.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, Prior, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=5, sensor=sample.sensor))
    >>> run.scores(Prior()).recall > run.scores(Prior.uninformative()).recall
    True
    """

    building: Building
    settings: MapSettings = MapSettings()
    log: EvidenceLog | None = None
    prior_mask: BoolArray | None = None
    prior_unknown: BoolArray | None = None

    def __post_init__(self) -> None:
        for name in ("prior_mask", "prior_unknown"):
            if (mask := getattr(self, name)) is not None:
                bool_array(name, mask, self.building.drawing.shape)

    def with_prior_mask(
        self, mask: BoolArray | None, unknown: BoolArray | None = None
    ) -> "MappingRun":
        """Return the run with a prior made from other walls.

        Parameters
        ----------
        mask : ndarray of bool, shape (H, W), or None
            The walls; None for the building's own.
        unknown : ndarray of bool, shape (H, W), optional
            Pixels of which that drawing says nothing; by default the building's own.

        Returns
        -------
        MappingRun
            It shares the readings and the truth.
        """
        if mask is self.prior_mask is unknown is self.prior_unknown is None:
            return self  # and with it all that was computed
        log = self.evidence
        other = replace(self, log=log, prior_mask=mask, prior_unknown=unknown)
        vars(other).update(truth_cells=self.truth_cells, scan_log=self.scan_log)
        return other

    @cached_property
    def grid(self) -> Grid:
        """The cells over the building."""
        return self.building.world.grid(self.settings.cell_px)

    @cached_property
    def scan_log(self) -> ScanLog | None:
        """The scans behind the readings; None where these are exact."""
        return simulated_scans(self.building, self.settings)

    @cached_property
    def evidence(self) -> EvidenceLog:
        """The readings, independent of any prior."""
        if self.log is not None:
            return self.log
        given = self.building, self.settings, self.scan_log, self.grid
        return simulated_readings(*given)

    @cached_property
    def wall_cells(self) -> BoolArray:
        """Cells in which the prior has a wall, ndarray of bool of shape (R, C)."""
        own = self.prior_mask
        mask = self.building.wall_mask if own is None else own
        return wall_cells(mask, self.grid, self.settings.wall_share)

    @cached_property
    def unknown_cells(self) -> BoolArray | None:
        """Cells of which the prior says nothing, (R, C); see `unknown_cells`."""
        own, drawn = self.prior_unknown, self.building.unknown
        return cells_unknown(drawn if own is None else own, self.wall_cells, self.grid)

    @cached_property
    def truth_cells(self) -> BoolArray:
        """Cells that are wall in truth, ndarray of bool of shape (R, C)."""
        return truth_cells(self.building.world, self.grid, self.settings.truth_share)

    @cached_property
    def calibrated(self) -> tuple[float, float]:
        """p_free of wall cells and of others; see `occsim.calibrated_prior`."""
        known = slice(None) if self.unknown_cells is None else ~self.unknown_cells
        return calibrated_prior(self.wall_cells[known], self.truth_cells[known])

    @cached_property
    def _kept(self) -> dict[tuple[object, ...], Any]:
        return {}

    def _surface(self, make: Callable[..., T], rule: UpdateRule, region: Region) -> T:
        """Return a function of the prior pair; the same object each time."""
        key, cells = (make, rule, region), (self.wall_cells, self.truth_cells)
        if key not in self._kept:
            rest = {"is_unknown": self.unknown_cells}
            self._kept[key] = make(self.evidence, *cells, rule, region, **rest)
        return self._kept[key]  # type: ignore[no-any-return]

    def prior_map(self, prior: Prior) -> PriorMap:
        """Return the prior map, from which the map of a `Prior` starts."""
        unknown = self.unknown_cells
        return prior_from_cells(self.wall_cells, self.grid, prior, unknown)

    def map(
        self,
        prior: Prior,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        n_readings: int | None = None,
    ) -> OccupancyMap:
        """Return the map of a prior; see `occsim.fuse`.

        Parameters
        ----------
        prior : Prior
            The prior.
        rule : UpdateRule, default UpdateRule.PRIOR_ONCE
            How a reading enters the map.
        n_readings : int, optional
            Only the first ones; all by default.

        Returns
        -------
        OccupancyMap
        """
        return fuse(self.evidence, self.prior_map(prior), rule, n_readings)

    def scores(
        self,
        prior: Prior,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.EXPLORED,
        n_readings: int | None = None,
    ) -> Scores:
        """Return how good the map of a prior is; see `occsim.score`.

        Parameters
        ----------
        prior, rule, n_readings
            As in `map`.
        region : Region, default Region.EXPLORED
            Which cells count.

        Returns
        -------
        Scores
        """
        return score(self.map(prior, rule, n_readings), self.truth_cells, region)

    def bits(
        self,
        prior: Prior,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.ALL,
        n_readings: int | None = None,
    ) -> float:
        """Return the log loss of the map of a prior; see `occsim.log_loss`.

        Parameters
        ----------
        prior, rule, region, n_readings
            As in `scores`.

        Returns
        -------
        float
            Bits per cell.
        """
        return log_loss(self.map(prior, rule, n_readings), self.truth_cells, region)

    def curves(
        self,
        prior: Prior,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.EXPLORED,
        *,
        bits: bool = False,
    ) -> ScoreCurves:
        """Return the scores after every reading; see `occsim.scores_by_reading`.

        Parameters
        ----------
        prior, rule, region
            As in `scores`.
        bits : bool, default False
            Whether the log loss is wanted too.

        Returns
        -------
        ScoreCurves
        """
        start, truth = self.prior_map(prior), self.truth_cells
        return scores_by_reading(self.evidence, start, truth, rule, region, bits=bits)

    def worth_in_readings(
        self,
        prior: Prior,
        n_readings: int = 0,
        measure: Measure = Measure.BITS,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    ) -> int | None:
        """Return how many readings a blank map needs to be as good as that of a prior.

        Parameters
        ----------
        prior, rule
            As in `map`.
        n_readings : int, default 0
            Readings that the map with the prior has.
        measure : Measure, default Measure.BITS
            Bits per cell over all cells, or F2 over the explored ones.

        Returns
        -------
        int or None
            See `occsim.worth_in_readings`.
        """
        measure = choice("measure", measure, Measure)
        region = Region.EXPLORED if measure is Measure.F2 else Region.ALL
        ours = self.curves(prior, rule, region, bits=True)
        blank = self.curves(Prior.uninformative(), rule, region, bits=True)
        return worth_in_readings(ours, blank, n_readings, measure)

    def surface(
        self,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.EXPLORED,
    ) -> PriorSurface:
        """Return true and false positives as exact functions of the prior pair.

        Parameters
        ----------
        rule, region
            As in `scores`.

        Returns
        -------
        PriorSurface
            The same object each time.
        """
        return self._surface(prior_surface, rule, region)

    def sweep(
        self,
        p_wall: npt.ArrayLike = SOURCE_AXIS,
        p_space: npt.ArrayLike = SOURCE_AXIS,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.EXPLORED,
    ) -> PriorSweep:
        """Return the scores of every pair of two axes; see `occsim.sweep_priors`.

        Parameters
        ----------
        p_wall, p_space : array_like of shape (A,) and (B,)
            Values in (0, 1]; the source's 0.1, 0.2, ..., 1 by default.
        rule, region
            As in `scores`.

        Returns
        -------
        PriorSweep
        """
        return sweep_surface(self.surface(rule, region), p_wall, p_space)

    def front(
        self,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.EXPLORED,
        low: float = SOURCE_AXIS[0],
        high: float = SOURCE_AXIS[-1],
    ) -> ParetoFront:
        """Return the exact Pareto front; see `occsim.exact_front`.

        Parameters
        ----------
        rule, region
            As in `scores`.
        low, high : float, default 0.1 and 1
            Bounds of p_wall and p_space, in (0, 1].

        Returns
        -------
        ParetoFront
            The same object each time.
        """
        key = surface_front, rule, region, low, high
        if key not in self._kept:
            self._kept[key] = surface_front(self.surface(rule, region), low, high)
        return self._kept[key]  # type: ignore[no-any-return]

    def loss_surface(
        self,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.ALL,
    ) -> LossSurface:
        """Return the log loss as a function of the pair; see `occsim.loss_surface`.

        Parameters
        ----------
        rule, region
            As in `bits`.

        Returns
        -------
        LossSurface
            The same object each time.
        """
        return self._surface(loss_surface, rule, region)

    def best_in_bits(
        self,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        region: Region = Region.ALL,
    ) -> tuple[float, float, float]:
        """Return the pair of least log loss; see `occsim.best_log_loss_pair`.

        Parameters
        ----------
        rule, region
            As in `bits`.

        Returns
        -------
        p_free_wall, p_free_space, bits : float
        """
        return self.loss_surface(rule, region).best()

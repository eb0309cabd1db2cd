"""A run: one building, mapped once, for any prior pair."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from occsim import (
    EvidenceLog,
    MappingRun,
    OccupancyMap,
    Prior,
    PriorMap,
    PriorSurface,
    PriorSweep,
    Scores,
    UpdateRule,
)
from occsim.building import Building
from occsim.io.images import png
from occsim.io.map_pictures import (
    OutcomeColours,
    belief_picture,
    change_picture,
    outcome_picture,
)
from occsim.priors import ParetoFront
from pages._ui import palette
from pages._ui.choices import Picture
from pages._ui.settings import Settings

ZOOM = 2
OUTCOME_COLOURS = OutcomeColours(
    hit=palette.HIT,
    false_wall=palette.FALSE_WALL,
    missed_wall=palette.MISSED_WALL,
    free=palette.FREE,
    unseen=palette.UNSEEN,
    hatch=palette.UNSEEN_HATCH,
)
CHANGE_COLOURS = (palette.EVIDENCE_WALL, palette.EVIDENCE_ZERO, palette.EVIDENCE_FREE)


@dataclass(frozen=True, eq=False)
class Run:
    """A student's building with its rule and region, over readings shared by all
    sessions.

    ``settings`` may hold a prior; it is not used: every prior is an argument here.
    """

    building: Building
    settings: Settings
    mapped: MappingRun

    def under(self, rule: UpdateRule) -> "Run":
        """The same run under a rule."""
        return replace(self, settings=replace(self.settings, rule=rule))

    @property
    def has_errors(self) -> bool:
        """Whether the prior is made from other walls than those of the drawing."""
        return self.mapped.prior_mask is not None

    @property
    def evidence(self) -> EvidenceLog:
        """The readings, independent of any prior."""
        return self.mapped.evidence

    @property
    def surface(self) -> PriorSurface:
        """True and false positives of every prior pair."""
        return self.mapped.surface(self.settings.rule, self.settings.region)

    @property
    def front(self) -> ParetoFront:
        """The exact Pareto front."""
        return self.mapped.front(self.settings.rule, self.settings.region)

    def sweep(self, values: Sequence[float]) -> PriorSweep:
        """The scores of every pair of some values."""
        settings = self.settings
        return self.mapped.sweep(values, values, settings.rule, settings.region)

    def prior_map(self, prior: Prior) -> PriorMap:
        """The prior map, from which the map starts."""
        return self.mapped.prior_map(prior)

    def map(self, prior: Prior) -> OccupancyMap:
        """The final map of a prior."""
        return self.mapped.map(prior, self.settings.rule)

    def scores(self, prior: Prior) -> Scores:
        """The scores of that map."""
        return self.mapped.scores(prior, self.settings.rule, self.settings.region)

    def picture(self, prior: Prior, kind: Picture) -> bytes:
        """A PNG of that map."""
        final, grid = self.map(prior), self.mapped.grid
        if kind is Picture.ERRORS:
            region = self.settings.region
            return png(
                outcome_picture(
                    final, self.mapped.truth_cells, OUTCOME_COLOURS, region, ZOOM
                )
            )
        if kind is Picture.CHANGE:
            change = final.p_free - self.map(Prior.uninformative()).p_free
            return png(change_picture(change, grid, CHANGE_COLOURS, zoom=ZOOM))
        return png(belief_picture(final.p_free, grid, ZOOM))

    @property
    def notice(self) -> str:
        """Why this run cannot be scored or swept, in a sentence; empty if it can."""
        if not self.evidence.cell.size:
            return (
                "No reading saw any cell, so the map is the prior and nothing else: "
                "check the trajectory and the range of the sensor."
            )
        if self.building.truth is None and not self.building.world.occupied.any():
            return (
                "No wall was found in the drawing and no ground truth was given: there "
                "is no wall to map, and precision and recall are undefined."
            )
        if not self.surface.n_wall:
            return (
                "The ground truth has no wall among the scored cells: recall is "
                "undefined, and no pair of priors is better than another."
            )
        if not self.mapped.wall_cells.any():
            why = "With its errors the drawing has no wall"
            if not self.has_errors:
                why = "No wall was found in the drawing"
            return f"{why}: every cell starts from p_space and p_wall has no effect."
        if not len(self.front):
            return "No pair of priors finds a wall: precision and recall have no front."
        return ""

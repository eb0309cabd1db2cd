"""Every setting of the app, declared once: name, default, bounds, label, unit.

Controls, the share link and the checks on what comes from outside all read this one
table. Nothing here knows Streamlit.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import Any

from occsim import BehindHit, Prior, Region, Sensor, UpdateRule
from occsim.priors import Elitism
from pages._ui.choices import (
    Drawings,
    Exploring,
    Fineness,
    FrontAxes,
    Handover,
    Objectives,
    Picture,
    Surface,
)


class Overlay(Enum):
    """What the player draws over the map."""

    NONE = "none"
    WALL_MASK = "wall_mask"
    TRUTH = "truth"
    ERRORS = "errors"


@dataclass(frozen=True, kw_only=True, slots=True)
class Setting:
    """What may be set: its bounds (or choices) and the words that stand beside it."""

    label: str
    help: str
    low: float = 0.0
    high: float = 1.0
    step: float = 1.0
    unit: str = ""


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """All choices of one student; the building itself is kept beside it."""

    cell_px: int = 3
    range_px: int = 40
    fov_deg: int = 30
    behind_hit: BehindHit = BehindHit.OCCUPIED
    clear_no_hit: bool = True
    wall_share: float = 0.0
    truth_share: float = 0.0
    p_wall: float = 0.2
    p_space: float = 0.9
    uninformative: bool = False
    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR
    region: Region = Region.EXPLORED
    overlay: Overlay = Overlay.NONE
    surface: Surface = Surface.SOURCE
    fineness: Fineness = Fineness.FIFTIETH
    drawings: Drawings = Drawings.THIS
    picture: Picture = Picture.BELIEF
    exploring: Exploring = Exploring.ONE
    axes: FrontAxes = FrontAxes.SCORES
    min_recall: float = 0.4
    handover: Handover = Handover.RECOMMENDED
    tolerance: float = 0.05
    objectives: Objectives = Objectives.INTERPOLATED
    elitism: Elitism = Elitism.CONTROLLED
    pop_size: int = 100
    n_gen: int = 60
    seed: int = 1

    @property
    def sensor(self) -> Sensor:
        """The simulated sensor of these settings."""
        return Sensor(
            range_px=float(self.range_px),
            fov_rad=math.radians(self.fov_deg),
            behind_hit=self.behind_hit,
            clear_no_hit=self.clear_no_hit,
        )

    @property
    def prior(self) -> Prior:
        """The prior of these settings."""
        if self.uninformative:
            return Prior.uninformative()
        return Prior(p_wall=self.p_wall, p_space=self.p_space)


TABLE: Mapping[str, Setting] = {
    "cell_px": Setting(
        label="Cell size",
        unit="px",
        low=1,
        high=20,
        help="Side of one map cell in pixels of the drawing. Small cells show more "
        "detail; large ones gather more readings each.",
    ),
    "range_px": Setting(
        label="Range",
        unit="px",
        low=5,
        high=300,
        help="How far the sensor reaches, in pixels of the drawing. The source sets it "
        "to the length of a door.",
    ),
    "fov_deg": Setting(
        label="Field of view",
        unit="degrees",
        low=5,
        high=360,
        help="Full opening angle of the sensor's cone. The source's camera has 30 "
        "degrees; a turning laser scanner has 360.",
    ),
    "behind_hit": Setting(
        label="Behind a hit",
        help="What a reading says of the pixels behind the wall that it meets.",
    ),
    "clear_no_hit": Setting(
        label="A ray that meets nothing clears its pixels",
        help="On, a ray that meets no wall within range counts all of its pixels as "
        "empty. Off, it says nothing, as many real range finders do.",
    ),
    "wall_share": Setting(
        label="Wall share of the prior",
        low=0.0,
        high=0.95,
        step=0.05,
        help="A cell is a wall cell of the prior where more than this share of its "
        "pixels is wall. At 0 a single wall pixel is enough.",
    ),
    "truth_share": Setting(
        label="Wall share of the ground truth",
        low=0.0,
        high=0.95,
        step=0.05,
        help="The same threshold for the ground truth against which the map is scored.",
    ),
    "p_wall": Setting(
        label="p_wall",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of wall cells: p_free = 0.9 × p_wall where the drawing shows a "
        "wall.",
    ),
    "p_space": Setting(
        label="p_space",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of all other cells: p_free = 0.9 × p_space where the drawing shows "
        "none.",
    ),
    "uninformative": Setting(
        label="Uninformative prior",
        help="Start every cell at p_free = 0.5, as if there were no drawing.",
    ),
    "rule": Setting(
        label="Update rule",
        help="How a reading enters the map.",
    ),
    "region": Setting(
        label="Scored region",
        help="Score only cells that some reading has updated, or all cells.",
    ),
    "overlay": Setting(label="Overlay", help="What is drawn over the map."),
    "surface": Setting(
        label="Surface",
        help="The source scored 10 × 10 pairs and interpolated between them. Exact: "
        "every pair is scored by its own map. Difference: interpolated less exact.",
    ),
    "fineness": Setting(
        label="Step",
        help="Distance between the values of p_wall and p_space on the surface.",
    ),
    "drawings": Setting(
        label="Drawings", help="The chosen drawing, or all five reference drawings."
    ),
    "picture": Setting(
        label="Maps show",
        help="The probability of free; where walls were found, invented and missed; or "
        "how each cell's probability of free differs from the uninformative map's.",
    ),
    "exploring": Setting(
        label="Explore",
        help="One front and its maps; the source's search for it; or all drawings.",
    ),
    "axes": Setting(
        label="Axes",
        help="Precision and recall, or the quantities that the source minimises.",
    ),
    "min_recall": Setting(
        label="Set C: recall above",
        high=0.95,
        step=0.05,
        help="The source keeps only front points whose recall exceeds 0.40, below "
        "which too much of the building is missing.",
    ),
    "handover": Setting(
        label="Prior pair",
        help="The pair with the highest F2 within set C, or the one chosen by hand on "
        "this page or another.",
    ),
    "tolerance": Setting(
        label="Tolerance",
        high=0.3,
        step=0.01,
        help="A pair is good for a drawing if some point of its front is better by at "
        "most this much in precision and in recall.",
    ),
    "objectives": Setting(
        label="The search sees",
        help="The source let it see the interpolated table, which is an approximation.",
    ),
    "elitism": Setting(
        label="Survival",
        help="Plain NSGA-II keeps the best fronts. The source's tool also keeps some "
        "of the worse ones, for variety.",
    ),
    "pop_size": Setting(
        label="Population",
        low=10,
        high=200,
        step=10,
        help="Prior pairs in each generation.",
    ),
    "n_gen": Setting(
        label="Generations",
        low=5,
        high=200,
        step=5,
        help="How often the population is renewed; the first one is random.",
    ),
    "seed": Setting(
        label="Seed", high=9999, help="Equal seeds give equal runs, on any visit."
    ),
}

CHOICES: Mapping[Enum, str] = {
    BehindHit.OCCUPIED: "Occupied (Eq. 4.22 as printed)",
    BehindHit.UNSEEN: "Unseen (the field's usual rule)",
    UpdateRule.SUBTRACT_PRIOR: "Subtract prior",
    UpdateRule.PRIOR_ONCE: "Prior once",
    Region.EXPLORED: "Explored cells",
    Region.ALL: "All cells",
    Overlay.NONE: "None",
    Overlay.WALL_MASK: "Wall mask",
    Overlay.TRUTH: "Ground truth",
    Overlay.ERRORS: "Errors",
    Surface.SOURCE: "Source's 10 × 10",
    Surface.EXACT: "Exact",
    Surface.DIFFERENCE: "Difference",
    Fineness.TENTH: "0.1",
    Fineness.TWENTIETH: "0.05",
    Fineness.FIFTIETH: "0.02",
    Fineness.HUNDREDTH: "0.01",
    Drawings.THIS: "This drawing",
    Drawings.ALL: "All five",
    Picture.BELIEF: "Probability of free",
    Picture.ERRORS: "Errors",
    Picture.CHANGE: "Change",
    Exploring.ONE: "One front",
    Exploring.SEARCH: "Search by NSGA-II",
    Exploring.ALL: "All drawings",
    Handover.RECOMMENDED: "Recommended",
    Handover.CHOSEN: "Chosen by hand",
    FrontAxes.SCORES: "precision, recall",
    FrontAxes.INVERSE: "1/precision, 1/recall",
    Objectives.INTERPOLATED: "the source's table, interpolated",
    Objectives.EXACT: "each pair's own map",
    Elitism.FULL: "NSGA-II",
    Elitism.CONTROLLED: "NSGA-II, controlled elitism",
}


def apart_from_prior(settings: Settings) -> Settings:
    """Return only what the evidence and its scores depend on, the rest as by default.

    Two settings that agree in this share all readings, sweeps and fronts.
    """
    names = ("cell_px", "range_px", "fov_deg", "behind_hit", "clear_no_hit")
    names += ("wall_share", "truth_share", "rule", "region")
    return Settings(**{name: getattr(settings, name) for name in names})


def with_changes(settings: Settings, changes: Mapping[str, Any]) -> Settings:
    """Return the settings with some replaced; values out of bounds are refused.

    Raises
    ------
    ValueError
        With one sentence: what is wrong, what is allowed, what was got.
    """
    checked = {name: _checked(name, value) for name, value in changes.items()}
    return replace(settings, **checked)


def encode(settings: Settings) -> dict[str, str]:
    """Return the settings that differ from their defaults, as text for a link."""
    defaults = Settings()
    return {
        field.name: _text(getattr(settings, field.name))
        for field in fields(Settings)
        if getattr(settings, field.name) != getattr(defaults, field.name)
    }


def decode(query: Mapping[str, str]) -> Settings:
    """Return the settings of a link; what is unknown or wrong keeps its default."""
    return replace(Settings(), **_read(query)[0])


def unread(query: Mapping[str, str]) -> list[str]:
    """Return the names of the settings that a link gives wrong values."""
    return _read(query)[1]


def _read(query: Mapping[str, str]) -> tuple[dict[str, Any], list[str]]:
    good: dict[str, Any] = {}
    wrong: list[str] = []
    for field in fields(Settings):
        if field.name not in query:
            continue
        try:
            good[field.name] = _checked(field.name, query[field.name])
        except ValueError:
            wrong.append(field.name)
    return good, wrong


def _text(value: Any) -> str:
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, bool):
        return "1" if value else "0"
    return repr(value)


def _checked(name: str, value: Any) -> Any:
    """Return a value in the type and bounds of its setting, from text or as it is."""
    default = getattr(Settings(), name, None)
    if default is None:
        raise ValueError(f"there is no setting called {name!r}")
    if isinstance(default, Enum):
        return type(default)(value.value if isinstance(value, Enum) else value)
    if isinstance(default, bool):
        if value in (True, "1"):
            return True
        if value in (False, "0"):
            return False
        raise ValueError(f"{name} must be 0 or 1; got {value!r}")
    number = float(value)
    bounds = TABLE[name]
    if not bounds.low <= number <= bounds.high:
        raise ValueError(
            f"{name} must lie in {bounds.low} to {bounds.high}; got {value!r}"
        )
    return int(number) if isinstance(default, int) else number

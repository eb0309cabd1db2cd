"""Every setting of the app, declared once: name, default, bounds, label, unit.

Controls, the share link and the checks of outside values all read the metadata of these
fields. Nothing here depends on Streamlit.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from enum import Enum
from typing import Any

from occsim import (
    BehindHit,
    DrawingFlaws,
    MapSettings,
    Prior,
    Region,
    ScanNoise,
    ScanSettings,
    Sensor,
    UpdateRule,
)
from occsim.prior import SOURCE_PAIR
from occsim.priors import Elitism
from occsim.scan import RANGE_FINDERS
from pages._ui.choices import (
    Drawings,
    Exploring,
    Fineness,
    FrontAxes,
    Handover,
    Objectives,
    Overlay,
    Picture,
    PriorDrawing,
    Surface,
)
from pages._ui.columns import (
    OPENING_COLUMNS,
    Column,
    columns_given,
    columns_text,
    plain,
)

NO_NOISE = ScanNoise(metres_per_px=1.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Setting:
    """One setting: its bounds or choices, and its texts on screen."""

    label: str
    help: str
    low: float = 0.0
    high: float = 1.0
    step: float = 1.0
    unit: str = ""


def setting(default: Any, **declared: Any) -> Any:
    """Return a field of `Settings` with its bounds and texts."""
    return field(default=default, metadata={"setting": Setting(**declared)})


def flaw(name: str, **declared: Any) -> Any:
    """Return a field that is a field of `DrawingFlaws`: the library has its bounds."""
    bounds = DrawingFlaws.bounds(name)
    default = getattr(DrawingFlaws(), name)
    return setting(
        int(default) if bounds.step == int(bounds.step) else default,
        low=bounds.low,
        high=bounds.high,
        step=bounds.step,
        **declared,
    )


def error(name: str, **declared: Any) -> Any:
    """Return a field that is a field of `ScanNoise`: the library has its bounds."""
    bounds = ScanNoise.bounds(name)
    return setting(0.0, low=bounds.low, high=bounds.high, step=bounds.step, **declared)


@dataclass(frozen=True, kw_only=True, slots=True)
class Settings:
    """All choices of one student; the building itself is kept beside it."""

    cell_px: int = setting(
        3,
        label="Cell size",
        unit="px",
        low=1,
        high=20,
        help="Side of one map cell in pixels of the drawing. Small cells show more "
        "detail; large ones gather more readings each.",
    )
    range_px: int = setting(
        40,
        label="Range",
        unit="px",
        low=5,
        high=300,
        help="How far the sensor reaches, in pixels of the drawing. The source sets it "
        "to the length of a door.",
    )
    fov_deg: int = setting(
        30,
        label="Field of view",
        unit="degrees",
        low=5,
        high=360,
        help="Full opening angle of the sensor's cone. The source's camera has 30 "
        "degrees; a turning laser scanner has 360.",
    )
    behind_hit: BehindHit = setting(
        BehindHit.OCCUPIED,
        label="Behind a hit",
        help="What a reading says of the pixels behind the wall that it meets.",
    )
    clear_no_hit: bool = setting(
        True,
        label="A ray that meets nothing clears its pixels",
        help="On, a ray that meets no wall within range counts all of its pixels as "
        "empty. Off, it says nothing, as many real range finders do.",
    )
    wall_share: float = setting(
        0.0,
        label="Wall share of the prior",
        low=0.0,
        high=0.95,
        step=0.05,
        help="A cell is a wall cell of the prior where more than this share of its "
        "pixels is wall. At 0 a single wall pixel is enough.",
    )
    truth_share: float = setting(
        0.0,
        label="Wall share of the ground truth",
        low=0.0,
        high=0.95,
        step=0.05,
        help="The same threshold for the ground truth against which the map is scored.",
    )
    p_wall: float = setting(
        SOURCE_PAIR[0],
        label="p_wall",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of wall cells: p_free = 0.9 × p_wall where the drawing shows a "
        "wall.",
    )
    p_space: float = setting(
        SOURCE_PAIR[1],
        label="p_space",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of all other cells: p_free = 0.9 × p_space where the drawing shows "
        "none.",
    )
    uninformative: bool = setting(
        False,
        label="Uninformative prior",
        help="Start every cell at p_free = 0.5, as if there were no drawing.",
    )
    rule: UpdateRule = setting(
        UpdateRule.PRIOR_ONCE,
        label="Update rule",
        help="How a reading enters the map.",
    )
    study_rule: UpdateRule = setting(
        UpdateRule.SUBTRACT_PRIOR,
        label="Update rule of the study",
        help="The study repeats what the source did, so it opens with the rule that "
        "the source used, as we reconstruct it.",
    )
    region: Region = setting(
        Region.EXPLORED,
        label="Scored region",
        help="Score only cells that some reading has updated, or all cells.",
    )
    prior_drawing: PriorDrawing = setting(
        PriorDrawing.OWN,
        label="Drawing for the prior",
        help="Which drawing the prior is made from. The building that the robot "
        "drives through stays the same.",
    )
    thickness_px: int = flaw(
        "thickness_px",
        label="Wall thickness",
        unit="px",
        help="Thins or thickens the drawing's walls from both sides. What would vanish "
        "stays as a line of one pixel.",
    )
    shift_x_px: int = flaw(
        "shift_x_px",
        label="Shift to the right",
        unit="px",
        help="The drawing lies this far beside the building.",
    )
    shift_y_px: int = flaw(
        "shift_y_px",
        label="Shift down",
        unit="px",
        help="The drawing lies this far below the building.",
    )
    rotation_deg: float = setting(
        0.0,
        label="Rotation",
        unit="degrees",
        low=round(math.degrees(DrawingFlaws.bounds("rotation_rad").low)),
        high=round(math.degrees(DrawingFlaws.bounds("rotation_rad").high)),
        step=0.5,
        help="The drawing is turned about the middle of the sheet, clockwise.",
    )
    drawing_scale: float = flaw(
        "scale",
        label="Scale",
        help="The drawing is larger than the building, about the middle of the sheet.",
    )
    missing_share: float = flaw(
        "missing_share",
        label="Missing walls",
        help="Share of the length of the walls that the drawing leaves out, in pieces.",
    )
    false_share: float = flaw(
        "false_share",
        label="False walls",
        help="Walls that the building does not have, as a share of the length of its "
        "walls.",
    )
    flaw_seed: int = setting(
        0,
        label="Seed of missing and false walls",
        high=9999,
        help="Another seed puts them elsewhere.",
    )
    overlay: Overlay = setting(
        Overlay.NONE, label="Overlay", help="What is drawn over the map."
    )
    columns: tuple[Column, ...] = setting(
        OPENING_COLUMNS,
        label="Maps compared",
        help="The setting of each map on the page of two maps.",
    )
    beams: int = setting(
        0,
        label="Beams of a scan",
        high=max(one.n_beams for one in RANGE_FINDERS.values()),
        help="A real range finder measures along single beams. 0: every pixel is "
        "looked at, exactly.",
    )
    sigma_0_m: float = error(
        "sigma_0_m",
        label="Range noise",
        unit="m",
        help="Standard deviation of a measured range.",
    )
    sigma_2_per_m: float = error(
        "sigma_2_per_m",
        label="Its growth",
        unit="per m",
        help="What the square of the range adds to that standard deviation.",
    )
    sigma_from_m: float = error(
        "sigma_from_m",
        label="Growth begins at",
        unit="m",
        help="Nearer than this the range noise does not grow.",
    )
    dropout_share: float = error(
        "dropout_share",
        label="Dropped returns",
        help="Share of hits that give no return: black or shiny surfaces.",
    )
    short_share: float = error(
        "short_share",
        label="Short returns",
        help="Share of beams that end before the wall: someone walks past.",
    )
    glass_share: float = error(
        "glass_share",
        label="Glass",
        help="Share of the walls that the range finder looks through, in panes of 1 m.",
    )
    position_sigma_m: float = error(
        "position_sigma_m",
        label="Position error",
        unit="m",
        help="Standard deviation of each believed position, along x and along y. "
        "Readings are taken at the true pose and entered at the believed one.",
    )
    heading_sigma_deg: float = setting(
        0.0,
        label="Heading error",
        unit="degrees",
        high=round(math.degrees(ScanNoise.bounds("heading_sigma_rad").high)),
        step=0.5,
        help="Standard deviation of each believed heading.",
    )
    odometry_drift: float = error(
        "alpha_1",
        label="Odometry drift",
        help="The robot counts its own turns and steps: alpha_1 to alpha_4 of "
        "Probabilistic Robotics, Table 5.6, all four set to this. It adds up on the "
        "way.",
    )
    noise_seed: int = setting(
        0,
        label="Seed of the sensor's errors",
        high=9999,
        help="Another seed draws other errors of the same size.",
    )
    log_cell_m: float = setting(
        0.05,
        label="Cell size",
        unit="m",
        low=0.02,
        high=0.5,
        step=0.01,
        help="Side of a cell of the map that a robot's log gives.",
    )
    usable_range_m: int = setting(
        10,
        label="Usable range",
        unit="m",
        low=1,
        high=80,
        help="Nothing is mapped beyond it, and a hit beyond it clears as far as it.",
    )
    log_max_range_m: int = setting(
        0,
        label="Maximum range",
        unit="m",
        high=100,
        help="A reading at or beyond it is no return. 0: as the log says.",
    )
    log_behind_hit: BehindHit = setting(
        BehindHit.UNSEEN,
        label="Behind a hit",
        help="What a scan says of the pixels behind the end of a beam.",
    )
    log_clear_no_hit: bool = setting(
        False,
        label="A beam without return clears its sector",
        help="Off, it says nothing: black surfaces and mirrors give no return either.",
    )
    surface: Surface = setting(
        Surface.SOURCE,
        label="Surface",
        help="The source scored 10 × 10 pairs and interpolated between them. Exact: "
        "every pair is scored by its own map. Difference: interpolated less exact.",
    )
    fineness: Fineness = setting(
        Fineness.FIFTIETH,
        label="Step",
        help="Distance between the values of p_wall and p_space on the surface.",
    )
    drawings: Drawings = setting(
        Drawings.THIS,
        label="Drawings",
        help="The chosen drawing, or all five reference drawings.",
    )
    picture: Picture = setting(
        Picture.BELIEF,
        label="Maps show",
        help="The probability of free; where walls were found, invented and missed; or "
        "how each cell's probability of free differs from the uninformative map's.",
    )
    exploring: Exploring = setting(
        Exploring.ONE,
        label="Explore",
        help="One front and its maps; the source's search for it; or all drawings.",
    )
    axes: FrontAxes = setting(
        FrontAxes.SCORES,
        label="Axes",
        help="Precision and recall, or the quantities that the source minimises.",
    )
    min_recall: float = setting(
        0.4,
        label="Set C: recall above",
        high=0.95,
        step=0.05,
        help="The source keeps only front points whose recall exceeds 0.40, below "
        "which too much of the building is missing.",
    )
    handover: Handover = setting(
        Handover.CALIBRATED,
        label="Answer to hand over",
        help="Which of the answers above becomes the prior map.",
    )
    tolerance: float = setting(
        0.05,
        label="Tolerance",
        high=0.3,
        step=0.01,
        help="A pair is good for a drawing if some point of its front is better by at "
        "most this much in precision and in recall.",
    )
    objectives: Objectives = setting(
        Objectives.INTERPOLATED,
        label="The search sees",
        help="The source let it see the interpolated table, which is an approximation.",
    )
    elitism: Elitism = setting(
        Elitism.CONTROLLED,
        label="Survival",
        help="Plain NSGA-II keeps the best fronts. The source's tool also keeps some "
        "of the worse ones, for variety.",
    )
    pop_size: int = setting(
        100,
        label="Population",
        low=10,
        high=200,
        step=10,
        help="Prior pairs in each generation.",
    )
    n_gen: int = setting(
        60,
        label="Generations",
        low=5,
        high=200,
        step=5,
        help="How often the population is renewed; the first one is random.",
    )
    seed: int = setting(
        1, label="Seed", high=9999, help="Equal seeds give equal runs, on any visit."
    )

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
    def mapping(self) -> MapSettings:
        """The settings that the readings and the classes of the cells depend on."""
        return MapSettings(
            cell_px=self.cell_px,
            sensor=self.sensor,
            wall_share=self.wall_share,
            truth_share=self.truth_share,
            scan=self.scan,
        )

    @property
    def noise(self) -> ScanNoise | None:
        """What the range finder and the odometry get wrong; None where nothing is.

        A run takes the scale from its building.
        """
        noise = ScanNoise(
            metres_per_px=1.0,
            sigma_0_m=self.sigma_0_m,
            sigma_2_per_m=self.sigma_2_per_m,
            sigma_from_m=self.sigma_from_m,
            dropout_share=self.dropout_share,
            short_share=self.short_share,
            glass_share=self.glass_share,
            position_sigma_m=self.position_sigma_m,
            heading_sigma_rad=math.radians(self.heading_sigma_deg),
            **{f"alpha_{i}": self.odometry_drift for i in (1, 2, 3, 4)},
        )
        return None if noise == NO_NOISE else noise

    @property
    def dense_beams(self) -> int:
        """As many beams as neighbours are at most one pixel apart at full range."""
        across_px = math.ceil(self.range_px * math.radians(self.fov_deg))
        return min(max(across_px, 1), TABLE["beams"].high)

    @property
    def scan(self) -> ScanSettings | None:
        """How the readings are taken beam by beam; None where they are exact."""
        noise = self.noise
        if not self.beams and noise is None:
            return None
        return ScanSettings(
            n_beams=self.beams or self.dense_beams, noise=noise, seed=self.noise_seed
        )

    def mapping_of(self, column: Column) -> MapSettings:
        """The same for one map among several."""
        return replace(
            self.mapping,
            cell_px=column.cell_px,
            sensor=replace(self.sensor, behind_hit=column.behind_hit),
        )

    @property
    def column(self) -> Column:
        """These settings as those of a single map; its errors are in `flaws`."""
        names = ("prior_drawing", "p_wall", "p_space", "uninformative")
        more = ("rule", "behind_hit", "cell_px")
        return Column(**{name: getattr(self, name) for name in (*names, *more)})

    @property
    def page_choices(self) -> dict[str, object]:
        """The fields of `column` that the page chooses, not the player."""
        return {
            "prior_drawing": self.prior_drawing.value,
            "behind_hit": self.behind_hit.value,
            "cell_px": self.cell_px,
        }

    @property
    def flaws(self) -> DrawingFlaws:
        """What the drawing gets wrong; the walls of the prior alone suffer it."""
        return DrawingFlaws(
            thickness_px=self.thickness_px,
            shift_x_px=self.shift_x_px,
            shift_y_px=self.shift_y_px,
            rotation_rad=math.radians(self.rotation_deg),
            scale=self.drawing_scale,
            missing_share=self.missing_share,
            false_share=self.false_share,
            seed=self.flaw_seed,
        )

    @property
    def prior(self) -> Prior:
        """The prior of these settings."""
        if self.uninformative:
            return Prior.uninformative()
        return Prior(p_wall=self.p_wall, p_space=self.p_space)


TABLE: Mapping[str, Setting] = {
    one.name: one.metadata["setting"] for one in fields(Settings)
}
"""The declaration of each setting, by its name."""


def with_changes(settings: Settings, changes: Mapping[str, Any]) -> Settings:
    """Return the settings with some replaced; values out of bounds are refused.

    Raises
    ------
    ValueError
        With one sentence: what is wrong, what is allowed, what was got.
    """
    checked = {name: _checked(name, value) for name, value in changes.items()}
    return replace(settings, **checked)


def encode(settings: Settings, defaults: Settings | None = None) -> dict[str, str]:
    """Return the settings that differ from some defaults, as text for a link."""
    given = defaults or Settings()
    return {
        one.name: _text(getattr(settings, one.name))
        for one in fields(Settings)
        if getattr(settings, one.name) != getattr(given, one.name)
    }


def decode(
    query: Mapping[str, str], defaults: Settings | None = None
) -> tuple[Settings, list[str]]:
    """Return the settings of a link, and the names of those it gives wrong values.

    A missing or wrong value leaves the default; unknown names are ignored.
    """
    good: dict[str, Any] = {}
    wrong: list[str] = []
    for one in fields(Settings):
        if one.name not in query:
            continue
        try:
            good[one.name] = _checked(one.name, query[one.name])
        except (ValueError, OverflowError):
            wrong.append(one.name)
    return replace(defaults or Settings(), **good), wrong


def column_with(column: Column, changes: Mapping[str, Any]) -> Column:
    """Return a column with some fields replaced; the same checks as for settings.

    Raises
    ------
    ValueError
        With one sentence: what is wrong, what is allowed, what was got.
    """
    default = Column()
    checked = {
        name: _converted(name, getattr(default, name, None), value)
        for name, value in changes.items()
    }
    return replace(column, **checked)


def _text(value: Any) -> str:
    return columns_text(value) if isinstance(value, tuple) else plain(value)


def _checked(name: str, value: Any) -> Any:
    """Return a value in the type and bounds of its setting, from text or as it is."""
    return _converted(name, getattr(Settings(), name, None), value)


def _converted(name: str, default: Any, value: Any) -> Any:
    if default is None:
        raise ValueError(f"there is no setting called {name!r}")
    if isinstance(default, tuple):
        return value if isinstance(value, tuple) else _columns(value)
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


def _columns(text: str) -> tuple[Column, ...]:
    return tuple(column_with(Column(), given) for given in columns_given(text))

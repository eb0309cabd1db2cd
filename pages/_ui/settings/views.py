"""The settings of what single pages show, search and hand over."""

from dataclasses import dataclass

from occsim.priors import Elitism
from pages._ui.choices import (
    Drawings,
    Exploring,
    Fineness,
    FrontAxes,
    Handover,
    Objectives,
    Overlay,
    Picture,
    Surface,
)
from pages._ui.columns import OPENING_COLUMNS, Column
from pages._ui.settings.declared import setting


@dataclass(frozen=True, kw_only=True)
class ViewSettings:
    """What the pages show, search and hand over."""

    overlay: Overlay = setting(
        Overlay.NONE, label="Show on the map", help="What is drawn over the map."
    )
    columns: tuple[Column, ...] = setting(
        OPENING_COLUMNS,
        label="Maps compared",
        help="The setting of each map on the page of two maps.",
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

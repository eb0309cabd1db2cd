"""The choices on the pages, and the label of each."""

from collections.abc import Mapping
from enum import Enum

from occsim import BehindHit, Region, UpdateRule
from occsim.priors import Elitism

SECTIONS = (
    "1 Drawing",
    "2 Scale",
    "3 Walls",
    "4 Corrections",
    "5 Ground truth",
    "6 Trajectory",
    "7 Keep",
)
"""The sections of the page Your building; a link gives the number."""


class Overlay(Enum):
    """What the player draws over the map."""

    NONE = "none"
    WALL_MASK = "wall_mask"
    TRUTH = "truth"
    ERRORS = "errors"


class Surface(Enum):
    """How precision and recall are drawn over all prior pairs."""

    SOURCE = "source"
    EXACT = "exact"
    DIFFERENCE = "difference"


class Fineness(Enum):
    """Distance between the prior values of an exact surface."""

    TENTH = "0.1"
    TWENTIETH = "0.05"
    FIFTIETH = "0.02"
    HUNDREDTH = "0.01"


class Drawings(Enum):
    """Which drawings a chart shows."""

    THIS = "this"
    ALL = "all"


class Picture(Enum):
    """What a small map shows."""

    BELIEF = "belief"
    ERRORS = "errors"
    CHANGE = "change"


class Exploring(Enum):
    """What the Pareto explorer shows."""

    ONE = "one"
    SEARCH = "search"
    ALL = "all"


class FrontAxes(Enum):
    """In which quantities a front is drawn."""

    SCORES = "scores"
    INVERSE = "inverse"


class Objectives(Enum):
    """Where the search for a front gets the scores of each pair."""

    INTERPOLATED = "interpolated"
    EXACT = "exact"


class Handover(Enum):
    """Which answer to "the best prior" is handed over."""

    CALIBRATED = "calibrated"
    BITS = "bits"
    ONCE = "once"
    SUBTRACT = "subtract"
    CHOSEN = "chosen"


class PriorDrawing(Enum):
    """Which drawing the prior is made from."""

    OWN = "own"
    MIRRORED = "mirrored"
    EMPTY = "empty"
    A = "a"
    B = "b"
    C = "c"
    D = "d"
    E = "e"


class Flaw(Enum):
    """What the drawing of one map among several gets wrong."""

    FOUND = "found"
    THIN_1 = "thin1"
    THIN_2 = "thin2"
    THIN_3 = "thin3"
    THICK_2 = "thick2"
    SHIFTED = "shifted"
    MISSING = "missing"
    FALSE = "false"


class CellModel(Enum):
    """What a map keeps of each cell."""

    LOG_ODDS = "log_odds"
    HITS_VISITS = "hits_visits"


class Laps(Enum):
    """How often the robot has driven its tour."""

    ONE = "1"
    TWO = "2"
    THREE = "3"
    FOUR = "4"
    EIGHT = "8"


class Preset(Enum):
    """A named set of conditions."""

    BAYES = "bayes"
    SOURCE = "source"


CHOICES: Mapping[Enum, str] = {
    BehindHit.OCCUPIED: "Occupied (Eq. 4.22 as printed)",
    BehindHit.UNSEEN: "Unseen (the field's usual rule)",
    UpdateRule.PRIOR_ONCE: "Count the drawing once",
    UpdateRule.SUBTRACT_PRIOR: "Take it off at every reading (the source, as we "
    "reconstruct it)",
    Region.EXPLORED: "Cells looked at",
    Region.ALL: "All cells",
    Region.UNEXPLORED: "Cells not looked at",
    Overlay.NONE: "None",
    Overlay.WALL_MASK: "Wall mask",
    Overlay.TRUTH: "Ground truth",
    Overlay.ERRORS: "Errors",
    Surface.SOURCE: "10 × 10",
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
    Exploring.ONE: "This drawing",
    Exploring.SEARCH: "Search by NSGA-II",
    Exploring.ALL: "All drawings",
    Handover.CALIBRATED: "Calibrated",
    Handover.BITS: "Fewest bits",
    Handover.ONCE: "Best F2, drawing counted once",
    Handover.SUBTRACT: "Best F2, drawing taken off",
    Handover.CHOSEN: "Chosen by hand",
    FrontAxes.SCORES: "precision, recall",
    FrontAxes.INVERSE: "1/precision, 1/recall",
    Objectives.INTERPOLATED: "the source's table, interpolated",
    Objectives.EXACT: "each pair's own map",
    PriorDrawing.OWN: "This building's own",
    PriorDrawing.MIRRORED: "Its mirror image",
    PriorDrawing.EMPTY: "An empty sheet",
    **{
        sample: f"That of building {sample.value}"
        for sample in list(PriorDrawing)
        if len(sample.value) == 1
    },
    Flaw.FOUND: "as found",
    Flaw.THIN_1: "walls thinned by 1 px",
    Flaw.THIN_2: "walls thinned by 2 px",
    Flaw.THIN_3: "walls thinned by 3 px",
    Flaw.THICK_2: "walls thickened by 2 px",
    Flaw.SHIFTED: "shifted by 6 px",
    Flaw.MISSING: "a fifth of its walls missing",
    Flaw.FALSE: "a fifth more walls, false",
    Preset.BAYES: "By Bayes' rule",
    Preset.SOURCE: "As in the source",
    Elitism.FULL: "NSGA-II",
    Elitism.CONTROLLED: "NSGA-II, controlled elitism",
}

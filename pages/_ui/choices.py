"""Choices of the pages on sweeps and fronts; the settings declare their words."""

from enum import Enum


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
    """What the search for a front is told of each pair."""

    INTERPOLATED = "interpolated"
    EXACT = "exact"


class Handover(Enum):
    """Which prior pair the guided path hands over."""

    RECOMMENDED = "recommended"
    CHOSEN = "chosen"

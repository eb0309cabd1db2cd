"""The maxima that the source printed, for comparison only: nothing is tuned to them.

The source's five drawings may not be used; the samples are drawings of the same kinds.
Figures therefore differ, and the pattern is what can be compared.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", thesis, University of Sheffield, Tables 4.1 and 4.2; the same work as
   C. Georgiou, S. Anderson and T. Dodd, IJRR 36(3), 2017,
   doi 10.1177/0278364916687027.
"""

from typing import NamedTuple

from occsim.errors import choice
from occsim.priors.sweep import Objective


class PublishedMaximum(NamedTuple):
    """A maximum as printed."""

    percent: float
    """Largest value over the 100 pairs, percent."""
    pairs: str
    """Where it lies, (p_wall, p_space), ranges as ``first:last``."""


SOURCE_CELLS_PX = (3, 5, 10)
"""Cell sizes of the source's tables, px."""

# Table 4.1. The last 0.5 of drawing c at 10 px is printed "05".
_PRECISION = {
    3: {
        "a": PublishedMaximum(98.49, "(0.3, 0.3)"),
        "b": PublishedMaximum(99.42, "(0.3, 0.3)"),
        "c": PublishedMaximum(91.77, "(0.3, 0.3)"),
        "d": PublishedMaximum(95.56, "(0.1, 0.3)"),
        "e": PublishedMaximum(93.77, "(0.3, 0.3)"),
    },
    5: {
        "a": PublishedMaximum(75.00, "(0.3, 0.3)"),
        "b": PublishedMaximum(95.36, "(0.3, 0.3)"),
        "c": PublishedMaximum(79.00, "(0.3, 0.3)"),
        "d": PublishedMaximum(84.94, "(0.1, 0.3)"),
        "e": PublishedMaximum(90.51, "(0.1, 0.3)"),
    },
    10: {
        "a": PublishedMaximum(48.00, "(0.5, 0.6)"),
        "b": PublishedMaximum(89.14, "(0.1, 0.3)"),
        "c": PublishedMaximum(77.42, "(0.1:0.2, 0.3:0.5)"),
        "d": PublishedMaximum(92.06, "(0.1, 0.3)"),
        "e": PublishedMaximum(92.68, "(0.1, 0.3)"),
    },
}

# Table 4.2.
_RECALL = {
    3: {
        "a": PublishedMaximum(80.08, "(1, 0.2)"),
        "b": PublishedMaximum(82.77, "(0.2, 0.1:0.2)"),
        "c": PublishedMaximum(69.43, "(0.1, 1)"),
        "d": PublishedMaximum(82.70, "(0.7:1, 1)"),
        "e": PublishedMaximum(83.05, "(0.5:1, 1)"),
    },
    5: {
        "a": PublishedMaximum(66.09, "(1, 1)"),
        "b": PublishedMaximum(79.71, "(0.2, 0.2)"),
        "c": PublishedMaximum(72.05, "(1, 1)"),
        "d": PublishedMaximum(86.00, "(0.4:1, 1)"),
        "e": PublishedMaximum(88.68, "(0.9:1, 1)"),
    },
    10: {
        "a": PublishedMaximum(66.53, "(1, 1)"),
        "b": PublishedMaximum(73.42, "(0.2, 1)"),
        "c": PublishedMaximum(86.91, "(1, 1)"),
        "d": PublishedMaximum(91.69, "(0.4:0.9, 1)"),
        "e": PublishedMaximum(95.41, "(0.2, 1)"),
    },
}


def published_maximum(
    objective: Objective, cell_px: int, drawing: str
) -> PublishedMaximum | None:
    """Return what the source printed for its drawing of the same kind.

    Parameters
    ----------
    objective : Objective
        Precision (Table 4.1) or recall (Table 4.2).
    cell_px : int
        Cell size, px.
    drawing : str
        ``"a"`` to ``"e"``.

    Returns
    -------
    PublishedMaximum or None
        None for a cell size or a drawing that the source does not have.
    """
    chosen = choice("objective", objective, Objective)
    table = _PRECISION if chosen is Objective.PRECISION else _RECALL
    return table.get(cell_px, {}).get(drawing)

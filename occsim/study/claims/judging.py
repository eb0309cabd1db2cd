"""The source's claims, each a function of the facts of a case.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", thesis, University of Sheffield, sec. 4.5 and 4.6.
.. [2] C. Georgiou, S. Anderson and T. Dodd, IJRR 36(3), 2017,
   doi 10.1177/0278364916687027, abstract.
"""

from collections.abc import Callable, Mapping
from enum import Enum
from typing import NamedTuple

import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.prior import SOURCE_PAIR
from occsim.priors import SOURCE_AXIS, Objective
from occsim.study.claims.facts import NEAR, Facts

MOST = 0.5
"""Share from which "most" walls, doorways or neighbours is meant."""
SAME_COST = 0.2
"""Share by which two measured times may differ and count as the same."""
LITTLE = 0.2
"""Two steps of the sweep: a peak that moves no further moves little."""
MUCH = 20.0
"""Gain in F2 that the abstract reports, percent."""


class Finding(NamedTuple):
    """Whether a claim holds, and the number that decides it."""

    holds: bool | None
    """None where the claim does not apply."""
    value: float = float("nan")


NOT_APPLICABLE = Finding(None)


def precision_peaks_low(facts: Facts) -> Finding:
    """C1, Table 4.1: a pair of best precision has p_space in 0.3 to 0.6.

    The value is the share of the tied pairs that do.
    """
    if not _have_peaks(facts):
        return NOT_APPLICABLE
    share = _share_within(facts.precision.p_space, 0.3, 0.6)
    return Finding(share > 0.0, share)


def recall_peaks_at_one(facts: Facts) -> Finding:
    """C2, Table 4.2: all pairs of best recall have p_space = 1.

    The value is the share of the tied pairs that do.
    """
    if not _have_peaks(facts):
        return NOT_APPLICABLE
    share = _share_within(facts.recall.p_space, 1.0, 1.0)
    return Finding(share == 1.0, share)


def _share_within(values: FloatArray, low: float, high: float) -> float:
    return float(np.mean((values >= low) & (values <= high)))


def _have_peaks(facts: Facts) -> bool:
    # Without a wall in truth there is no recall; precision is 0 or undefined.
    return bool(facts.precision.p_wall.size and facts.recall.p_wall.size)


def no_pair_has_both(facts: Facts) -> Finding:
    """C3, Tables 4.1 and 4.2: no pair attains both maxima.

    The value is the number of pairs that do.
    """
    if not _have_peaks(facts):
        return NOT_APPLICABLE
    both = facts.peak(Objective.PRECISION) & facts.peak(Objective.RECALL)
    n = int(both.sum())
    return Finding(n == 0, float(n))


def surfaces_oppose(facts: Facts) -> Finding:
    """C4, Fig. 4.5: precision and recall correlate negatively over the pairs.

    The value is Pearson's coefficient over the pairs where both are defined.
    """
    tables = np.stack((facts.sweep.precision.ravel(), facts.sweep.recall.ravel()))
    tables = tables[:, ~np.isnan(tables).any(axis=0)]
    if not tables.size or (np.ptp(tables, axis=1) == 0.0).any():
        return NOT_APPLICABLE
    r = float(np.asarray(np.corrcoef(tables))[0, 1])
    return Finding(r < 0.0, r)


def precision_is_best_at_two_tenths(facts: Facts) -> Finding:
    """C5, Fig. 4.5B: precision is higher at p_wall = 0.2 than at 0.1 and 0.3.

    At the lowest p_space at which precision peaks. The value is the margin over the
    better of the two, points.
    """
    if not _have_peaks(facts):
        return NOT_APPLICABLE
    column = SOURCE_AXIS.index(float(facts.precision.p_space.min()))
    low, at, high = facts.sweep.precision[:3, column].tolist()
    margin = 100.0 * (at - max(low, high))
    return NOT_APPLICABLE if np.isnan(margin) else Finding(margin > 0.0, margin)


def source_pair_is_on_the_front(facts: Facts) -> Finding:
    """C6, Fig. 4.6: (0.2, 0.9) lies on the exact front, within 3 points.

    The value is the distance, points: the least by which precision and recall must
    both rise to reach a point of the front.
    """
    precision, recall, _ = facts.source_scores()
    front = facts.front
    if not len(front) or np.isnan(precision + recall):
        return NOT_APPLICABLE
    short = np.maximum(front.precision - precision, front.recall - recall)
    index = tuple(SOURCE_AXIS.index(p) for p in SOURCE_PAIR)
    distance = 100.0 * max(float(short.min()), 0.0)
    return Finding(bool(facts.near[index]), distance)


def best_precision_misses_walls(facts: Facts) -> Finding:
    """C8a, Fig. 4.6b: the map of best precision misses most of the walls.

    The value is the share missed, at the first of the pairs.
    """
    if not _have_peaks(facts):
        return NOT_APPLICABLE
    first = int(facts.peak(Objective.PRECISION).argmax())
    missed = 1.0 - float(facts.sweep.recall.flat[first])
    return Finding(missed > MOST, missed)


def best_recall_closes_doors(facts: Facts) -> Finding:
    """C8b, Fig. 4.6b: the map of best recall closes most of the doorways.

    The value is the share of their scored cells that it declares wall.
    """
    return _declared_share(facts, facts.openings.doorways)


def best_recall_thickens_walls(facts: Facts) -> Finding:
    """C8c, Fig. 4.6b: the map of best recall thickens most of the walls.

    The value is the share of scored free cells beside walls that it declares wall.
    """
    return _declared_share(facts, facts.openings.beside)


def _declared_share(facts: Facts, cells: BoolArray) -> Finding:
    cells = cells & facts.scored
    if not facts.recall.p_wall.size or not cells.any():
        return NOT_APPLICABLE
    pair = float(facts.recall.p_wall[0]), float(facts.recall.p_space[0])
    share = float(facts.declared(*pair)[cells].mean())
    return Finding(share > MOST, share)


def a_step_costs_the_same(facts: Facts) -> Finding:
    """C9, sec. 4.5: a step costs the same with an informative prior.

    The value is the time of a step over that with a blank prior, measured.
    """
    ratio = facts.cost_ratio
    return Finding(abs(ratio - 1.0) <= SAME_COST, ratio)


def source_pair_raises_f2(facts: Facts) -> Finding:
    """C11a, abstract of the article: (0.2, 0.9) raises F2 over no drawing.

    The value is the gain, percent of the blank map's F2.
    """
    gain = _gain(facts)
    return NOT_APPLICABLE if np.isnan(gain) else Finding(gain > 0.0, gain)


def source_pair_raises_f2_much(facts: Facts) -> Finding:
    """C11b, abstract of the article: (0.2, 0.9) raises F2 by more than 20 %.

    The value is the gain, percent of the blank map's F2.
    """
    gain = _gain(facts)
    return NOT_APPLICABLE if np.isnan(gain) else Finding(gain > MUCH, gain)


def _gain(facts: Facts) -> float:
    f2, blank = facts.source_scores()[2], facts.blank_scores()[2]
    return 100.0 * (f2 / blank - 1.0) if blank > 0.0 else float("nan")


def pairs_in_common(near: BoolArray) -> Finding:
    """C7, Fig. 4.7: the fronts of all drawings have prior pairs in common.

    Parameters
    ----------
    near : ndarray of bool, shape (N, 10, 10)
        Pairs of the sweep on the front of each drawing, within 3 points.

    Returns
    -------
    Finding
        The value is the number of pairs on all fronts.
    """
    if len(near) < 2:
        return NOT_APPLICABLE
    n = int(near.all(axis=0).sum())
    return Finding(n > 0, float(n))


def peaks_move_little(peaks: BoolArray) -> Finding:
    """C10, Tables 4.1 and 4.2: the peaks move little with the cell size.

    Parameters
    ----------
    peaks : ndarray of bool, shape (N, 2, 10, 10)
        Pairs of best precision, and of best recall, at each cell size.

    Returns
    -------
    Finding
        The value is the furthest that a peak moves between two cell sizes, in p_wall or
        p_space, from the nearest of its tied pairs to the nearest.
    """
    if len(peaks) < 2 or not peaks.any(axis=(2, 3)).all():
        return NOT_APPLICABLE
    moves = [
        _gap(one[k], other[k])
        for i, one in enumerate(peaks)
        for other in peaks[i + 1 :]
        for k in range(2)
    ]
    furthest = round(max(moves) * (SOURCE_AXIS[1] - SOURCE_AXIS[0]), 6)
    return Finding(furthest <= LITTLE, furthest)


def _gap(one: BoolArray, other: BoolArray) -> int:
    # Steps of the sweep between the nearest pairs, along the longer of both axes.
    a, b = np.argwhere(one), np.argwhere(other)
    return int(np.abs(a[:, None] - b).max(axis=2).min())


class Unit(Enum):
    """What a claim is judged on."""

    CASE = "drawings × cell sizes"
    DRAWING = "drawings"
    CELL = "cell sizes"


class Claim(NamedTuple):
    """A claim of the source."""

    sentence: str
    where: str
    """Table or figure of the thesis."""
    value: str
    """What the number says."""
    unit: Unit = Unit.CASE


CLAIMS: Mapping[str, Claim] = {
    "C1": Claim(
        "Precision peaks with p_space in 0.3 to 0.6",
        "Table 4.1",
        "share of the best pairs there",
    ),
    "C2": Claim(
        "Recall peaks only with p_space = 1",
        "Table 4.2",
        "share of the best pairs there",
    ),
    "C3": Claim(
        "No pair attains both maxima", "Tables 4.1 and 4.2", "pairs that attain both"
    ),
    "C4": Claim(
        "Precision and recall correlate negatively over the pairs",
        "Fig. 4.5",
        "correlation",
    ),
    "C5": Claim(
        "Precision is higher at p_wall = 0.2 than at 0.1 and 0.3",
        "Fig. 4.5",
        "margin, points",
    ),
    "C6": Claim(
        f"(0.2, 0.9) lies on the front, within {100 * NEAR:g} points",
        "Fig. 4.6",
        "distance, points",
    ),
    "C7": Claim(
        "The fronts of all drawings have pairs in common",
        "Fig. 4.7",
        "pairs in common",
        Unit.CELL,
    ),
    "C8a": Claim(
        "The map of best precision misses most walls", "Fig. 4.6", "share missed"
    ),
    "C8b": Claim(
        "The map of best recall closes most doorways", "Fig. 4.6", "share closed"
    ),
    "C8c": Claim(
        "The map of best recall thickens most walls",
        "Fig. 4.6",
        "share of free cells beside walls",
    ),
    "C9": Claim(
        "A step costs the same with an informative prior",
        "Sec. 4.5",
        "time over that with a blank prior",
    ),
    "C10": Claim(
        "The peaks move little with the cell size",
        "Tables 4.1 and 4.2",
        "furthest move",
        Unit.DRAWING,
    ),
    "C11a": Claim("(0.2, 0.9) raises F2 over no drawing", "Article", "gain, %"),
    "C11b": Claim(
        f"(0.2, 0.9) raises F2 by more than {MUCH:g} %", "Article", "gain, %"
    ),
}
"""All claims by their number."""

ON_A_CASE: Mapping[str, Callable[[Facts], Finding]] = {
    "C1": precision_peaks_low,
    "C2": recall_peaks_at_one,
    "C3": no_pair_has_both,
    "C4": surfaces_oppose,
    "C5": precision_is_best_at_two_tenths,
    "C6": source_pair_is_on_the_front,
    "C8a": best_precision_misses_walls,
    "C8b": best_recall_closes_doors,
    "C8c": best_recall_thickens_walls,
    "C9": a_step_costs_the_same,
    "C11a": source_pair_raises_f2,
    "C11b": source_pair_raises_f2_much,
}
"""Those that one case decides."""

"""How maps relate to a front: the nearest point, and the distance from it."""

from collections.abc import Iterable

from occsim import Scores
from occsim.priors import Maxima, ParetoFront

Pair = tuple[float, float]


def scores_at(front: ParetoFront) -> list[Pair]:
    """Precision and recall of each point."""
    return list(zip(front.precision.tolist(), front.recall.tolist(), strict=True))


def pairs_of(found: ParetoFront | Maxima) -> list[Pair]:
    """The prior pairs of a front or of maxima: p_wall, p_space."""
    return list(zip(found.p_wall.tolist(), found.p_space.tolist(), strict=True))


def is_negative(pair: Pair) -> bool:
    """Whether a pair calls drawn walls free rather than the space between them."""
    p_wall, p_space = pair
    return p_wall > p_space


def is_constant(pair: Pair) -> bool:
    """Whether a pair gives all cells the same prior, so that no wall is in it."""
    p_wall, p_space = pair
    return p_wall == p_space


def distance(front: ParetoFront, scores: Scores) -> float:
    """By how much the nearest point of a front is better, in both scores at most.

    The smallest tolerance at which the map counts as near the front; 0 on it, NaN
    where a score is undefined or there is no front.
    """
    gaps = [
        max(precision - scores.precision, recall - scores.recall)
        for precision, recall in scores_at(front)
    ]
    if not gaps or scores.precision != scores.precision:
        return float("nan")
    return max(0.0, min(gaps))


def nearest(front: ParetoFront, scores: Scores) -> int:
    """The front point nearest to a map's scores; the first if they are undefined."""
    here = scores.precision, scores.recall
    if here[0] != here[0] or here[1] != here[1]:
        return 0
    gaps = [
        abs(precision - here[0]) + abs(recall - here[1])
        for precision, recall in scores_at(front)
    ]
    return gaps.index(min(gaps))


def n_beyond(front: ParetoFront, points: Iterable[Iterable[float]]) -> int:
    """How many points of precision and recall no point of a front attains."""
    attained = scores_at(front)
    return sum(
        not any(p >= precision - 1e-9 and r >= recall - 1e-9 for p, r in attained)
        for precision, recall in points
        if precision == precision and recall == recall
    )

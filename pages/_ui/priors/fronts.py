"""How maps relate to a front: the nearest point, and the distance from it."""

from occsim import Scores
from occsim.priors import ParetoFront


def scores_at(front: ParetoFront) -> list[tuple[float, float]]:
    """Precision and recall of each point."""
    return list(zip(front.precision.tolist(), front.recall.tolist(), strict=True))


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

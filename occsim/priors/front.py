"""Fronts of precision against recall, and choices made on them.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", sec. 4.6: Figs 4.6d and 4.7, set C; C. Georgiou, S. Anderson and T. Dodd,
   IJRR 2017, doi 10.1177/0278364916687027.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, ShortRepr
from occsim.errors import ParameterError, expect, real_array, real_number, shared_shape

MIN_RECALL = 0.40
"""Threshold of set C; the source found by experiment that it keeps the structure."""

DECIMALS = 4
"""Decimals of a recommended prior value, if its interval is wide enough."""


@dataclass(frozen=True, eq=False, repr=False)
class ParetoFront(ShortRepr):
    """Prior pairs of which none beats another in both precision and recall.

    Parameters
    ----------
    p_wall, p_space : ndarray of float64, shape (K,)
        A pair that attains each point. On an exact front it is rounded to 4 decimals
        or fewer inside its rectangle, if that is wide enough; see `is_single`.
    precision, recall : ndarray of float64, shape (K,)
        The points: recall ascends strictly, precision descends strictly, both above 0.
    rectangles : ndarray of float64, shape (K, 4), optional
        Bounds p_wall_low, p_wall_high, p_space_low, p_space_high of a whole rectangle
        of pairs, the given one among them, that attain each point; None where only
        the pairs themselves are known.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> front = run.front()
    >>> bool((front.recall[1:] > front.recall[:-1]).all())
    True
    """

    p_wall: FloatArray
    p_space: FloatArray
    precision: FloatArray
    recall: FloatArray
    rectangles: FloatArray | None = None

    def __len__(self) -> int:
        return self.p_wall.size

    @property
    def is_single(self) -> BoolArray:
        """Whether p_wall, and p_space, need all their digits, (K, 2).

        False where the value has 4 decimals or fewer: the printed value attains the
        point.
        """
        pairs = np.stack((self.p_wall, self.p_space), axis=1)
        return np.asarray(pairs != np.round(pairs, DECIMALS))

    @property
    def f2(self) -> FloatArray:
        """F2 of each point: recall in twice the weight of precision, (K,)."""
        return 5.0 / (4.0 / self.recall + 1.0 / self.precision)

    @property
    def objectives(self) -> FloatArray:
        """The source's objectives to minimise, 1/precision and 1/recall, (K, 2)."""
        return np.stack((1.0 / self.precision, 1.0 / self.recall), axis=1)

    def hypervolume(self, ref: Sequence[float]) -> float:
        """Return the area that the front dominates, as `hypervolume` does.

        Parameters
        ----------
        ref : sequence of two floats
            Reference values of 1/precision and 1/recall.

        Returns
        -------
        float
        """
        return hypervolume(self.precision, self.recall, ref)

    def take(self, index: npt.ArrayLike) -> "ParetoFront":
        """Return a subset of the front's points, by index or by flag."""
        chosen = np.asarray(index)
        rows = self.rectangles
        return ParetoFront(
            p_wall=self.p_wall[chosen],
            p_space=self.p_space[chosen],
            precision=self.precision[chosen],
            recall=self.recall[chosen],
            rectangles=None if rows is None else rows[chosen],
        )


def dominates(better: npt.ArrayLike, worse: npt.ArrayLike) -> BoolArray:
    """Return whether one point is at least as good in all and better in some.

    Parameters
    ----------
    better, worse : array_like of shape (..., 2)
        Precision and recall; a point with NaN dominates and is dominated by nothing.

    Returns
    -------
    ndarray of bool, shape (...)

    Raises
    ------
    TypeError
        Where the points are not real numbers.
    ParameterError
        Where they do not come in pairs, or the shapes do not broadcast.

    Examples
    --------
    >>> from occsim import dominates
    >>> dominates([0.9, 0.5], [[0.9, 0.4], [0.8, 0.6]])
    array([ True, False])
    """
    a, b = real_array("better", better), real_array("worse", worse)
    if not a.shape[-1:] == b.shape[-1:] == (2,):
        raise ParameterError(
            f"points must have shape (..., 2); got {a.shape} and {b.shape}"
        )
    shared_shape(better=a, worse=b)
    return np.asarray((a >= b).all(axis=-1) & (a > b).any(axis=-1))


def non_dominated(precision: npt.ArrayLike, recall: npt.ArrayLike) -> BoolArray:
    """Return which points no other point dominates.

    Parameters
    ----------
    precision, recall : array_like of shape (N,)
        Points; both are better when larger.

    Returns
    -------
    ndarray of bool, shape (N,)
        Equal points are all marked; undefined ones (NaN) are not.

    Raises
    ------
    TypeError
        Where the values are not real numbers.
    ParameterError
        Where the shapes are not one and the same (N,).

    Examples
    --------
    >>> from occsim import non_dominated
    >>> non_dominated([0.9, 0.8, 0.7], [0.5, 0.4, 0.8])
    array([ True, False,  True])
    """
    p, r = _points(precision, recall)
    defined = ~(np.isnan(p) | np.isnan(r))
    marked = np.zeros(p.shape, dtype=bool)
    levels, level = np.unique(r[defined], return_inverse=True)
    best = np.full(levels.size + 1, -np.inf)
    np.maximum.at(best, level, p[defined])
    # Best precision at any strictly higher recall.
    above = np.maximum.accumulate(best[::-1])[::-1][1:]
    marked[defined] = (p[defined] == best[level]) & (p[defined] > above[level])
    return marked


def front_of(
    p_wall: FloatArray, p_space: FloatArray, precision: FloatArray, recall: FloatArray
) -> ParetoFront:
    """Return the front of evaluated prior pairs, one pair for each point.

    Parameters
    ----------
    p_wall, p_space, precision, recall : ndarray of float64, shape (N,)
        Pairs and what they score; pairs with recall 0 or NaN are left out, because
        1/precision and 1/recall are infinite there.

    Returns
    -------
    ParetoFront
    """
    defined = np.where((precision > 0.0) & (recall > 0.0), recall, np.nan)
    keep = np.flatnonzero(non_dominated(precision, defined))
    _, first = np.unique(recall[keep], return_index=True)
    keep = keep[first]
    return ParetoFront(p_wall[keep], p_space[keep], precision[keep], recall[keep])


def hypervolume(
    precision: npt.ArrayLike, recall: npt.ArrayLike, ref: Sequence[float]
) -> float:
    """Return the area between a set of points and a reference point.

    The objectives are 1/precision and 1/recall, both minimised, as in the source. The
    area covers all objective pairs that some point weakly dominates and that are no
    worse than the reference.

    Parameters
    ----------
    precision, recall : array_like of shape (N,)
        Points in any order, dominated ones allowed; NaN and 0 contribute nothing.
    ref : sequence of two floats
        Reference values of 1/precision and 1/recall.

    Returns
    -------
    float
        The area; 0 where no point is better than the reference in both.

    Raises
    ------
    TypeError
        Where the values are not real numbers.
    ParameterError
        Where the reference is not two finite numbers, or the shapes differ.

    Examples
    --------
    >>> from occsim import hypervolume
    >>> hypervolume([1.0, 0.5], [0.25, 0.5], (5, 5))  # 4 x 1 + 3 x 2
    10.0
    """
    corner = real_array("ref", ref)
    if corner.shape != (2,) or not np.isfinite(corner).all():
        raise ParameterError(f"ref must be two finite numbers; got {ref!r}")
    points = np.stack(_points(precision, recall), axis=1)
    points = 1.0 / points[(points > 0.0).all(axis=1)]
    points = points[(points < corner).all(axis=1)]
    points = points[np.argsort(points[:, 0])]
    floor = np.minimum.accumulate(points[:, 1])
    ceiling = np.concatenate((corner[1:], floor[:-1]))
    return float(np.sum((corner[0] - points[:, 0]) * (ceiling - floor)))


def _points(
    precision: npt.ArrayLike, recall: npt.ArrayLike
) -> tuple[FloatArray, FloatArray]:
    p, r = real_array("precision", precision), real_array("recall", recall)
    if p.ndim != 1 or p.shape != r.shape:
        raise ParameterError(
            "precision and recall must have one and the same shape (N,); got "
            f"{p.shape} and {r.shape}"
        )
    return p, r


def reference_point(front: ParetoFront, margin: float = 0.1) -> tuple[float, float]:
    """Return a reference for `hypervolume` a little beyond a front's worst values.

    Parameters
    ----------
    front : ParetoFront
        Usually the exact one.
    margin : float, default 0.1
        Share of the front's extent, or of its value where it has none, to add.

    Returns
    -------
    tuple of float
        Values of 1/precision and 1/recall; (1, 1), where nothing can lie, for an
        empty front.

    Raises
    ------
    TypeError
        Where the front is no `ParetoFront`.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import reference_point
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> front = run.front()
    >>> bool(reference_point(front)[1] > 1.0 / front.recall.min())
    True
    """
    expect("front", front, ParetoFront)
    margin = real_number("margin", margin)
    if not len(front):
        return 1.0, 1.0
    worst, best = front.objectives.max(axis=0), front.objectives.min(axis=0)
    extent = np.where(worst > best, worst - best, worst)
    first, second = (worst + margin * extent).tolist()
    return first, second


def set_c(front: ParetoFront, min_recall: float = MIN_RECALL) -> ParetoFront:
    """Return the source's set C: the points whose recall exceeds a threshold.

    Parameters
    ----------
    front : ParetoFront
        Any front.
    min_recall : float, default 0.40
        Threshold in [0, 1].

    Returns
    -------
    ParetoFront
        Possibly empty.

    Raises
    ------
    TypeError
        Where the front is no `ParetoFront`.
    ParameterError
        Where the threshold lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import set_c
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> front = run.front()
    >>> bool((set_c(front, 0.9).recall > 0.9).all())
    True
    """
    beyond = _beyond(front, min_recall)
    return front.take(beyond)


def recommend(front: ParetoFront, min_recall: float = MIN_RECALL) -> int | None:
    """Return which point of a front has the best F2 within set C.

    Parameters
    ----------
    front : ParetoFront
        Any front.
    min_recall : float, default 0.40
        Threshold of set C, in [0, 1].

    Returns
    -------
    int or None
        Its index in `front`; None where set C is empty.

    Raises
    ------
    TypeError
        Where the front is no `ParetoFront`.
    ParameterError
        Where the threshold lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import recommend
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> front = run.front()
    >>> best = recommend(front)
    >>> bool(front.recall[best] > 0.4)
    True
    """
    beyond = _beyond(front, min_recall)
    if not beyond.any():
        return None
    return int(np.argmax(np.where(beyond, front.f2, -np.inf)))


def _beyond(front: ParetoFront, min_recall: float) -> BoolArray:
    expect("front", front, ParetoFront)
    min_recall = real_number("min_recall", min_recall)
    if not 0.0 <= min_recall <= 1.0:
        raise ParameterError(f"min_recall must lie in [0, 1]; got {min_recall!r}")
    return np.asarray(front.recall > min_recall)

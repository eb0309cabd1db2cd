"""The exact Pareto front over a continuous box of prior pairs.

Precision TP / (TP + FP) and recall TP / (TP + FN) both rise with TP, and only precision
falls with FP. TP and FP are sums of one term that p_wall decides and one that p_space
decides, each a step function with finitely many states. If one term's state is
replaced by one of no fewer TP and no more FP, neither objective falls; so only the
states of each term that are non-dominated in (TP up, FP down) matter, and for every
total of TP only the fewest FP. What remains is enumerated.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError
from occsim.evidence import EvidenceLog
from occsim.logodds import p_free_from_log_odds
from occsim.mapping import UpdateRule
from occsim.metrics import Region, precision_of, recall_of
from occsim.prior import PRIOR_SCALE
from occsim.priors.front import ParetoFront
from occsim.priors.surface import PriorSurface, StepCount, prior_levels, prior_surface

MIN_WIDTH = 1e-12
"""Narrowest interval of l_0, nats, taken for real.

Cells whose levels agree on paper differ by the rounding of their sums, a thousand
times less than this; the states between them exist in no exact arithmetic. The tie
band, 2e-9 nats over the number of readings, is wider.
"""

EDGE = 1e-15
"""Rounding of a value p that is computed from l_0; rectangles end this much inside."""

MAX_DIGITS = 15
"""Decimals tried for a short representative; an interval of MIN_WIDTH has one."""


@dataclass(frozen=True, eq=False)
class _States:
    """Intervals of one prior value and the counts that hold throughout each.

    Parameters
    ----------
    low, high : ndarray of float64, shape (N,)
        Bounds of p_wall or p_space, both inside.
    tp, fp : ndarray of int64, shape (N,)
        Counts of the cells of that class.
    """

    low: FloatArray
    high: FloatArray
    tp: IntArray
    fp: IntArray

    def take(self, index: npt.NDArray[np.generic]) -> "_States":
        """Return only some of the states, by index or by flag."""
        return _States(
            self.low[index], self.high[index], self.tp[index], self.fp[index]
        )


def exact_front(
    evidence: EvidenceLog,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR,
    region: Region = Region.EXPLORED,
    low: float = 0.1,
    high: float = 1.0,
    scale: float = PRIOR_SCALE,
) -> ParetoFront:
    """Return every non-dominated (precision, recall) over a box of prior pairs.

    Exact for all real (p_wall, p_space) in ``[low, high]`` squared, not only for those
    of a table: ties and the ends of the box are among them.

    Parameters
    ----------
    evidence : EvidenceLog
        What the readings said.
    is_wall : ndarray of bool, shape (R, C)
        Wall cells of the drawing.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    rule : UpdateRule, default UpdateRule.SUBTRACT_PRIOR
        How a reading enters the map.
    region : Region, default Region.EXPLORED
        Which cells are scored.
    low, high : float, default 0.1 and 1
        Bounds of p_wall and p_space, in (0, 1].
    scale : float, default 0.9
        Factor on both.

    Returns
    -------
    ParetoFront
        With rectangles. Each point's pair, put through `fuse` and `score`, attains it
        exactly; it is a short decimal where one serves. Empty where no pair hits a
        wall: no walls in the truth, nothing seen, or precision undefined everywhere.

    Raises
    ------
    ParameterError
        Where a shape is not the grid's or a value lies outside its domain.
    """
    surface = prior_surface(evidence, is_wall, truth, rule, region, scale)
    return surface_front(surface, low, high)


def surface_front(
    surface: PriorSurface, low: float = 0.1, high: float = 1.0
) -> ParetoFront:
    """Return the exact front of a known surface; see `exact_front`.

    Parameters
    ----------
    surface : PriorSurface
        From `prior_surface`.
    low, high : float, default 0.1 and 1
        Bounds of p_wall and p_space, in (0, 1].

    Returns
    -------
    ParetoFront

    Raises
    ------
    ParameterError
        Where a bound lies outside its domain.
    """
    wall = _states(surface.wall_tp, surface.wall_fp, low, high, surface.scale)
    space = _states(surface.space_tp, surface.space_fp, low, high, surface.scale)
    wall, space = _pruned(wall), _pruned(space)
    i, j = _fewest_false(wall, space)
    tp, fp = wall.tp[i] + space.tp[j], wall.fp[i] + space.fp[j]
    precision = precision_of(tp, fp)
    # By TP ascending, each total once: a point stays if no higher total has
    # precision as good. A total of 0 hits nothing and belongs to no front.
    later = np.maximum.accumulate(np.append(precision, -np.inf)[::-1])[::-1][1:]
    keep = (tp > 0) & (precision > later)
    wall, space = wall.take(i[keep]), space.take(j[keep])
    return ParetoFront(
        p_wall=_representative(wall.low, wall.high, low, high),
        p_space=_representative(space.low, space.high, low, high),
        precision=precision[keep],
        recall=recall_of(tp[keep], surface.n_wall - tp[keep]),
        rectangles=np.stack((wall.low, wall.high, space.low, space.high), axis=1),
    )


def rectangles_at(
    surface: PriorSurface,
    p_wall: float,
    p_space: float,
    low: float = 0.1,
    high: float = 1.0,
) -> FloatArray:
    """Return all rectangles of prior pairs that score the same as a given pair.

    Parameters
    ----------
    surface : PriorSurface
        From `prior_surface`.
    p_wall, p_space : float
        Any pair, on a front or not.
    low, high : float, default 0.1 and 1
        Bounds of p_wall and p_space, in (0, 1].

    Returns
    -------
    ndarray of float64, shape (M, 4)
        Rows p_wall_low, p_wall_high, p_space_low, p_space_high: every pair in the box
        with the same counts of true and false positives.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.
    """
    tp, fp = (int(count) for count in surface.counts(p_wall, p_space))
    wall = _states(surface.wall_tp, surface.wall_fp, low, high, surface.scale)
    space = _states(surface.space_tp, surface.space_fp, low, high, surface.scale)
    # One number for each pair of counts; the base exceeds any count.
    base = surface.n_wall + surface.n_space + 1
    key = space.tp * base + space.fp
    order = np.argsort(key, kind="stable")
    # What p_wall leaves open; counts below zero match nothing.
    open_tp, open_fp = tp - wall.tp, fp - wall.fp
    wanted = np.where(open_fp >= 0, open_tp * base + open_fp, -1)
    first = np.searchsorted(key[order], wanted, side="left")
    stop = np.searchsorted(key[order], wanted, side="right")
    rows = [
        (wall.low[i], wall.high[i], space.low[j], space.high[j])
        for i in np.flatnonzero(stop > first)
        for j in order[first[i] : stop[i]]
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def _states(
    tp: StepCount, fp: StepCount, low: float, high: float, scale: float
) -> _States:
    # All states of one class over [low, high], by ascending prior value.
    bottom, top = prior_levels("low and high", (low, high), scale)
    if low > high:
        raise ParameterError(f"low must not exceed high; got {low!r} and {high!r}")
    starts = np.concatenate((tp.starts(), fp.starts()))
    starts = np.unique(starts[(starts > bottom) & (starts <= top)])
    starts = np.concatenate(([bottom], starts))
    counts = np.stack((tp(starts), fp(starts)))
    # Where one cell falls as another rises the state goes on.
    new = np.append(True, (np.diff(counts) != 0).any(axis=0))
    starts, counts = starts[new], counts[:, new]
    stops = np.append(np.nextafter(starts[1:], -np.inf), top)
    real = stops - starts >= MIN_WIDTH
    # The ends of the box are attained however narrow the interval that holds them.
    real[[0, -1]] = True
    p_low = p_free_from_log_odds(starts) / scale
    p_high = p_free_from_log_odds(stops) / scale
    inset = np.minimum(EDGE, 0.25 * (p_high - p_low))
    p_low, p_high = p_low + inset, p_high - inset
    p_low[0], p_high[-1] = low, high
    return _States(p_low, p_high, counts[0], counts[1]).take(real)


def _pruned(states: _States) -> _States:
    # The states non-dominated in (TP up, FP down), by ascending TP; of several with
    # the same counts the widest. From the most TP down, FP must fall.
    order = np.lexsort((states.low - states.high, states.fp, -states.tp))
    fp = states.fp[order]
    fewest_before = np.concatenate(([np.inf], np.minimum.accumulate(fp)[:-1]))
    return states.take(order[fp < fewest_before][::-1])


def _fewest_false(wall: _States, space: _States) -> tuple[IntArray, IntArray]:
    """Return, for every attainable total of TP, the states with the fewest FP.

    Parameters
    ----------
    wall, space : _States
        Pruned states of the two classes, by ascending TP.

    Returns
    -------
    i, j : ndarray of int64, shape (T,)
        Indices into `wall` and `space`, by ascending total of TP; of several pairs
        with the fewest FP, the one with the largest rectangle.
    """
    if wall.tp.size > space.tp.size:
        j, i = _fewest_false(space, wall)
        return i, j
    size = int(wall.tp[-1] + space.tp[-1]) + 1
    cost = np.full(size, np.inf)
    choice = np.zeros((2, size), dtype=np.int64)
    widths = space.high - space.low
    columns = np.arange(space.tp.size)
    for row in range(wall.tp.size):
        total = wall.tp[row] + space.tp
        # Areas stay below 1, so half of one never outweighs a false positive.
        area = (wall.high[row] - wall.low[row]) * widths
        new = wall.fp[row] + space.fp - 0.5 * area
        better = new < cost[total]
        total = total[better]
        cost[total] = new[better]
        choice[:, total] = np.stack((np.full(total.size, row), columns[better]))
    attained = np.isfinite(cost)
    return choice[0, attained], choice[1, attained]


def _representative(
    p_low: FloatArray, p_high: FloatArray, low: float, high: float
) -> FloatArray:
    """Return a value inside each interval: the shortest decimal, else the middle.

    Parameters
    ----------
    p_low, p_high : ndarray of float64, shape (N,)
        Bounds of the intervals.
    low, high : float
        Ends of the box; elsewhere the edge of an interval is kept away from.

    Returns
    -------
    ndarray of float64, shape (N,)
    """
    margin = 0.01 * (p_high - p_low)
    bottom = np.where(p_low <= low, p_low, p_low + margin)
    top = np.where(p_high >= high, p_high, p_high - margin)
    middle = 0.5 * (bottom + top)
    value = middle.copy()
    for digits in range(MAX_DIGITS, 0, -1):
        # If any decimal of so many digits lies inside, the one nearest to the middle
        # does; fewer digits overwrite more.
        nearest = np.round(middle, digits)
        value = np.where((nearest >= bottom) & (nearest <= top), nearest, value)
    return value

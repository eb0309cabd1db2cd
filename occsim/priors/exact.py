"""The exact Pareto front over a continuous box of prior pairs.

Precision TP / (TP + FP) and recall TP / (TP + FN) both rise with TP, and only precision
falls with FP. TP and FP are sums of one term that depends on p_wall and one that
depends on p_space, each a step function with finitely many states. Replacing the state
of one term by one with at least as many TP and at most as many FP lowers neither
objective. So only the states of each term that are non-dominated in (TP up, FP down)
matter, and for every total of TP only the fewest FP. The remaining combinations are
enumerated.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, expect, real_number
from occsim.evidence_log import Evidence
from occsim.logodds import DECISION_EPS, LATTICE_NATS, p_free_from_log_odds
from occsim.mapping import UpdateRule
from occsim.metrics import Region, precision_of, recall_of
from occsim.prior import PRIOR_SCALE
from occsim.priors.front import DECIMALS, ParetoFront
from occsim.priors.surface import PriorSurface, StepCount, prior_levels, prior_surface


@dataclass(frozen=True, eq=False)
class _States:
    """Intervals of one prior value, with the counts that are constant in each.

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
        """Return a subset of the states, by index or by flag."""
        return _States(
            self.low[index], self.high[index], self.tp[index], self.fp[index]
        )


def exact_front(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    low: float = 0.1,
    high: float = 1.0,
    scale: float = PRIOR_SCALE,
) -> ParetoFront:
    """Return every non-dominated (precision, recall) over a box of prior pairs.

    Exact for all real (p_wall, p_space) in ``[low, high]`` squared, not only for those
    of a table; ties and the ends of the box are included.

    Parameters
    ----------
    evidence : EvidenceLog or EvidenceTotals
        What the readings said.
    is_wall : ndarray of bool, shape (R, C)
        Wall cells of the drawing.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
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
        exactly; its values have 4 decimals or fewer, except where `is_single` says so.
        Empty where no pair hits a wall: no walls in the truth, nothing seen, or
        precision undefined everywhere.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where a shape is not the grid's or a value lies outside its domain.

    Notes
    -----
    Points that exist only because of the width of the tie band (`DECISION_EPS`) are on
    no front: an interval narrower than twice that width counts only where it contains
    an end of the box, or l_0 = 0, where unread cells tie.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, exact_front, logit
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 2], [0, 1], logit([0.3, 0.3]))
    >>> walls = [[True, False]]
    >>> front = exact_front(log, walls, walls)
    >>> front.p_wall, front.p_space, front.precision
    (array([0.4]), array([0.9]), array([1.]))
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
    TypeError
        Where the surface is no `PriorSurface`.
    ParameterError
        Where a bound lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import surface_front
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> surface = run.surface()
    >>> front = run.front()
    >>> bool((surface_front(surface).recall == front.recall).all())
    True
    """
    expect("surface", surface, PriorSurface)
    wall = _states(surface.wall_tp, surface.wall_fp, low, high, surface.scale)
    space = _states(surface.space_tp, surface.space_fp, low, high, surface.scale)
    wall, space = _pruned(wall), _pruned(space)
    i, j = _fewest_false(wall, space)
    tp, fp = wall.tp[i] + space.tp[j], wall.fp[i] + space.fp[j]
    precision = precision_of(tp, fp)
    # By TP ascending, each total once: a point stays if no higher total has the same
    # precision or better. A total of 0 is on no front.
    later = np.maximum.accumulate(np.append(precision, -np.inf)[::-1])[::-1][1:]
    keep = (tp > 0) & (precision > later)
    wall, space = wall.take(i[keep]), space.take(j[keep])
    return ParetoFront(
        p_wall=_short_decimal(wall.low, wall.high),
        p_space=_short_decimal(space.low, space.high),
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
        Any pair.
    low, high : float, default 0.1 and 1
        Bounds of p_wall and p_space, in (0, 1].

    Returns
    -------
    ndarray of float64, shape (M, 4)
        Rows p_wall_low, p_wall_high, p_space_low, p_space_high: every pair in the box
        with the same counts of true and false positives, except those within the tie
        band; see `exact_front`.

    Raises
    ------
    TypeError
        Where the surface is no `PriorSurface`.
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import rectangles_at
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> surface = run.surface()
    >>> rectangles_at(surface, 0.2, 0.9).shape[1]
    4
    """
    expect("surface", surface, PriorSurface)
    p_wall, p_space = real_number("p_wall", p_wall), real_number("p_space", p_space)
    tp, fp = (int(count) for count in surface.counts(p_wall, p_space))
    wall = _states(surface.wall_tp, surface.wall_fp, low, high, surface.scale)
    space = _states(surface.space_tp, surface.space_fp, low, high, surface.scale)
    # One number for each pair of counts; the base exceeds any count.
    base = surface.n_wall + surface.n_space + 1
    key = space.tp * base + space.fp
    order = np.argsort(key, kind="stable")
    # The counts that p_space must supply; negative ones match nothing.
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
    low, high = real_number("low", low), real_number("high", high)
    bottom, top = prior_levels("low and high", (low, high), scale)
    if low > high:
        raise ParameterError(f"low must not exceed high; got {low!r} and {high!r}")
    starts = np.concatenate((tp.starts(), fp.starts()))
    starts = np.unique(starts[(starts > bottom) & (starts <= top)])
    starts = np.concatenate(([bottom], starts))
    counts = np.stack((tp(starts), fp(starts)))
    # Where one cell falls as another rises, the counts and so the state stay.
    new = np.append(True, (np.diff(counts) != 0).any(axis=0))
    starts, counts = starts[new], counts[:, new]
    # Within the tie band a cell counts as free that would be wall without the band. A
    # tie itself is free, and its interval begins with it.
    band = DECISION_EPS // LATTICE_NATS * LATTICE_NATS
    first, last = starts + band, np.append(starts[1:] - LATTICE_NATS - band, top)
    # The ends of the box, and the tie of unread cells at l_0 = 0, are attained however
    # narrow the interval that contains them.
    first[0], last[0] = bottom, max(last[0], bottom)
    first[-1] = min(first[-1], top)
    tie = np.searchsorted(starts, 0.0, side="right") - 1
    if bottom <= 0.0 <= top:
        first[tie], last[tie] = min(first[tie], 0.0), max(last[tie], 0.0)
    real = first <= last
    # All values whose logit is rounded to the bound: nearly half a step on either side.
    # A tie that is attained alone stays one value.
    half = 0.49 * LATTICE_NATS * (first < last)
    bounds = p_free_from_log_odds([first - half, last + half]) / scale
    p_low, p_high = np.clip(bounds, low, high)
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


def _short_decimal(low: FloatArray, high: FloatArray) -> FloatArray:
    """Return a value inside each interval: the shortest decimal, else the middle.

    Parameters
    ----------
    low, high : ndarray of float64, shape (N,)
        Bounds of the intervals.

    Returns
    -------
    ndarray of float64, shape (N,)
    """
    middle = 0.5 * (low + high)
    value = middle.copy()
    for digits in range(DECIMALS, 0, -1):
        # If any decimal of so many digits lies inside, the one nearest to the middle
        # does; fewer digits overwrite more.
        nearest = np.round(middle, digits)
        value = np.where((nearest >= low) & (nearest <= high), nearest, value)
    return value

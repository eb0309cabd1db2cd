"""The counts of a final map as exact functions of the prior pair.

Wall cells answer to p_wall alone and space cells to p_space alone. In the closed form
``l = S + w l_0`` (w = 1 - k, or 1) each cell flips at one level of its prior's
log-odds l_0, so the counts of each class are step functions of one variable, known
once the levels are sorted. Every sweep and the exact Pareto front are read from them.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, require_choice
from occsim.evidence import EvidenceLog
from occsim.grid import cells_of
from occsim.logodds import DECISION_EPS, is_occupied, logit
from occsim.mapping import UpdateRule, prior_weight
from occsim.metrics import Region
from occsim.prior import PRIOR_SCALE

LEVEL_LIMIT = 1e3
"""Beyond the log-odds of any prior, nats: the smallest positive number has -745."""

MAX_STEP = 2**60
"""Longest stride of the search for a level, in numbers of the machine."""


@dataclass(frozen=True, eq=False)
class StepCount:
    """How many cells of a group are declared wall, as a function of their prior.

    Parameters
    ----------
    always : int
        Cells declared wall whatever the prior.
    falling : ndarray of float64, shape (F,)
        Sorted last levels of l_0, nats, of cells that a higher prior frees.
    rising : ndarray of float64, shape (G,)
        Sorted first levels of l_0, nats, of cells that a higher prior turns to wall:
        two or more readings that each subtract it.
    """

    always: int
    falling: FloatArray
    rising: FloatArray

    def __call__(self, prior_log_odds: FloatArray) -> IntArray:
        """Return the counts at levels of l_0 of any shape."""
        freed = np.searchsorted(self.falling, prior_log_odds, side="left")
        turned = np.searchsorted(self.rising, prior_log_odds, side="right")
        return np.asarray(self.always + self.falling.size - freed + turned)

    def starts(self) -> FloatArray:
        """Return the first level of every step, unsorted, nats."""
        return np.concatenate((np.nextafter(self.falling, np.inf), self.rising))


@dataclass(frozen=True, eq=False)
class PriorSurface:
    """True and false positives as exact functions of (p_wall, p_space).

    Parameters
    ----------
    wall_tp, wall_fp : StepCount
        Wall cells of the drawing that are wall, and space, in truth.
    space_tp, space_fp : StepCount
        The same of the other cells.
    n_wall, n_space : int
        Scored cells that are wall, and space, in truth.
    scale : float
        Factor on p_wall and p_space.
    """

    wall_tp: StepCount
    wall_fp: StepCount
    space_tp: StepCount
    space_fp: StepCount
    n_wall: int
    n_space: int
    scale: float

    def counts(
        self, p_wall: npt.ArrayLike, p_space: npt.ArrayLike
    ) -> tuple[IntArray, IntArray]:
        """Return true and false positives at prior pairs.

        Parameters
        ----------
        p_wall, p_space : array_like
            Values in (0, 1], of shapes that broadcast.

        Returns
        -------
        tp, fp : ndarray of int64
            Cells declared wall rightly and wrongly, equal to what `fuse` and `score`
            give for each pair.

        Raises
        ------
        ParameterError
            Where a value lies outside its domain.
        """
        wall = prior_levels("p_wall", p_wall, self.scale)
        space = prior_levels("p_space", p_space, self.scale)
        return (
            self.wall_tp(wall) + self.space_tp(space),
            self.wall_fp(wall) + self.space_fp(space),
        )


def prior_levels(name: str, values: npt.ArrayLike, scale: float) -> FloatArray:
    """Return the log-odds l_0 of prior values.

    Parameters
    ----------
    name : str
        What to call the values in a message.
    values : array_like
        Values in (0, 1].
    scale : float
        Factor on them, in (0, 1].

    Returns
    -------
    ndarray of float64, the shape of `values`
        ``logit(scale * values)``, nats.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain, or is 1 with a scale of 1.
    """
    p = np.asarray(values, dtype=np.float64)
    allowed = (p > 0.0) & (p <= 1.0)
    if not allowed.all():
        raise ParameterError(
            f"{name} must lie in (0, 1]; got {float(p[~allowed].flat[0])!r}"
        )
    if not 0.0 < scale <= 1.0 or (p.size and scale * p.max() >= 1.0):
        raise ParameterError(
            f"scale must lie in (0, 1] and scale * {name} below 1; got {scale!r}"
        )
    return logit(scale * p)


def prior_surface(
    evidence: EvidenceLog,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR,
    region: Region = Region.EXPLORED,
    scale: float = PRIOR_SCALE,
) -> PriorSurface:
    """Return true and false positives as exact functions of the prior pair.

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
    scale : float, default 0.9
        Factor on p_wall and p_space.

    Returns
    -------
    PriorSurface

    Raises
    ------
    ParameterError
        Where a shape is not the grid's, the scale lies outside its domain, or the
        rule or region is no member of its enum.
    """
    is_wall = cells_of("is_wall", is_wall, evidence.grid)
    truth = cells_of("truth", truth, evidence.grid)
    require_choice("region", region, Region)
    if not 0.0 < scale <= 1.0:
        raise ParameterError(f"scale must lie in (0, 1]; got {scale!r}")
    sums, counts = evidence.totals()
    scored = counts > 0 if region is Region.EXPLORED else np.ones_like(truth)
    sums, weight = sums[scored], prior_weight(counts[scored], rule)
    wall, hit = is_wall[scored], truth[scored]
    level = _flip_levels(sums, weight)
    groups = (wall & hit, wall & ~hit, ~wall & hit, ~wall & ~hit)
    n_wall = int(np.count_nonzero(hit))
    steps = [_step_count(sums[g], weight[g], level[g]) for g in groups]
    return PriorSurface(
        wall_tp=steps[0],
        wall_fp=steps[1],
        space_tp=steps[2],
        space_fp=steps[3],
        n_wall=n_wall,
        n_space=hit.size - n_wall,
        scale=scale,
    )


def _flip_levels(sums: FloatArray, weight: FloatArray) -> FloatArray:
    """Return the outermost l_0 at which each cell is still declared wall.

    Rounding is monotone, so ``fl(S + fl(w l_0))`` crosses the decision level at one
    number of the machine; it is found to the last bit, which makes every count equal
    to that of a fused map, at ties too. Cells of weight 0 get NaN.
    """
    moved = weight != 0.0
    s, w = sums[moved], weight[moved]
    # Places are counted towards the side on which the cell is free.
    side = np.where(w > 0.0, 1, -1)

    def occupied(place: IntArray) -> BoolArray:
        return is_occupied(s + w * _number_at(side * place))

    guess = np.clip((-DECISION_EPS - s) / w, -LEVEL_LIMIT, LEVEL_LIMIT)
    levels = np.full_like(sums, np.nan)
    levels[moved] = _number_at(side * _last_true(occupied, side * _place_of(guess)))
    return levels


def _last_true(holds: Callable[[IntArray], BoolArray], guess: IntArray) -> IntArray:
    """Return the last place at which something holds that later ends for good.

    Parameters
    ----------
    holds : callable
        From one place a cell, (N,), to flags (N,): true up to some place.
    guess : ndarray of int64, shape (N,)
        Usually within one of the answer; far off where S and the width of the tie band
        all but cancel.

    Returns
    -------
    ndarray of int64, shape (N,)
        Within the places of ``LEVEL_LIMIT``; its ends where the answer lies beyond.
    """
    last = int(_place_of(np.float64(LEVEL_LIMIT)))
    low, high = np.maximum(guess - 1, -last), np.minimum(guess + 1, last)
    step = 2
    while (short := ~holds(low) & (low > -last)).any():
        low[short] = np.maximum(low[short] - step, -last)
        step = min(2 * step, MAX_STEP)
    step = 2
    while (short := holds(high) & (high < last)).any():
        high[short] = np.minimum(high[short] + step, last)
        step = min(2 * step, MAX_STEP)
    while (apart := high - low > 1).any():
        middle = low + (high - low) // 2
        true = holds(middle)
        low = np.where(apart & true, middle, low)
        high = np.where(apart & ~true, middle, high)
    return low


def _place_of(number: FloatArray | np.float64) -> IntArray:
    # Numbers of the machine in their order: 0 for zero, 1 for the next above it.
    bits = np.asarray(number, dtype=np.float64).view(np.int64)
    return np.where(bits >= 0, bits, np.iinfo(np.int64).min - bits)


def _number_at(place: IntArray) -> FloatArray:
    bits = np.where(place >= 0, place, np.iinfo(np.int64).min - place)
    return bits.view(np.float64)


def _step_count(sums: FloatArray, weight: FloatArray, level: FloatArray) -> StepCount:
    return StepCount(
        always=int(np.count_nonzero(is_occupied(sums[weight == 0.0]))),
        falling=np.sort(level[weight > 0.0]),
        rising=np.sort(level[weight < 0.0]),
    )

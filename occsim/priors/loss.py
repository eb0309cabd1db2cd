"""Log loss of the final map as an exact function of the prior pair, and its optimum.

A cell's log-odds are ``l = S + w l_0`` (w = 1 - k, or 1), so the log loss of its class
is a sum of ``ln(1 + exp(+-l))``: convex in the class's l_0 under either rule. Wall
cells and space cells share no parameter, so the two minima are found one by one. Cells
of equal S, w and truth are counted, not kept: some hundred terms stand for a map.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.evidence_log import Evidence
from occsim.logodds import logit, p_free_from_log_odds, softplus
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.priors.surface import prior_levels, scored_groups

LEAST_P_FREE = 1e-6
"""The best pair is sought in [1e-6, 1 - 1e-6]: where all cells of a class are free, or
all are wall, the log loss falls all the way to 0 or 1, which are no probabilities of a
prior."""

_NEWTON_STEPS = 100  # each at least halves the bracket or converges quadratically
_CONVERGED_NATS = 1e-13


@dataclass(frozen=True, eq=False, repr=False)
class ClassLoss(ShortRepr):
    """Log loss of one class of cells as a function of its l_0, in groups of equals.

    Parameters
    ----------
    sums, weight : ndarray of float64, shape (G,)
        S and w of ``l = S + w l_0``, signed so that a higher l is a higher loss.
    count : ndarray of int64, shape (G,)
        Cells of each group.
    """

    sums: FloatArray
    weight: FloatArray
    count: IntArray

    def nats(self, level: FloatArray) -> FloatArray:
        """Return the summed log loss at levels of l_0, of their shape."""
        against = self.sums + self.weight * level[..., None]
        return np.asarray(softplus(against) @ self.count, dtype=np.float64)

    def slopes(self, level: float) -> tuple[float, float]:
        """Return the first and second derivative at a level of l_0."""
        p = p_free_from_log_odds(self.sums + self.weight * level)
        first = self.count * self.weight * p
        return float(first.sum()), float(first @ (self.weight * (1.0 - p)))

    def minimum(self) -> float:
        """Return the p_free of least loss; one half where the loss does not vary."""
        if not self.weight.any():
            return 0.5
        ends = LEAST_P_FREE, 1.0 - LEAST_P_FREE
        low, high = logit(ends).tolist()
        if self.slopes(low)[0] >= 0.0:
            return ends[0]
        if self.slopes(high)[0] <= 0.0:
            return ends[1]
        return float(p_free_from_log_odds(self._root(low, high)))

    def _root(self, low: float, high: float) -> float:
        # Newton's iteration on the slope; where it leaves the bracket, bisection.
        level = 0.0
        for _ in range(_NEWTON_STEPS):
            slope, curvature = self.slopes(level)
            low, high = (low, level) if slope > 0.0 else (level, high)
            step = slope / curvature if curvature > 0.0 else np.inf
            new = level - step if low < level - step < high else 0.5 * (low + high)
            if abs(new - level) <= _CONVERGED_NATS * max(1.0, abs(level)):
                break
            level = new
        return level


@dataclass(frozen=True, eq=False, repr=False)
class LossSurface(ShortRepr):
    """Log loss of the final map as a function of the prior pair.

    Parameters
    ----------
    wall, space : ClassLoss
        The two terms of the sum.
    n_cells : int
        Scored cells.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> surface = run.loss_surface()
    >>> bool(surface.bits(0.2, 0.8) < surface.bits(0.5, 0.5))
    True
    """

    wall: ClassLoss
    space: ClassLoss
    n_cells: int

    def bits(
        self, p_free_wall: npt.ArrayLike, p_free_space: npt.ArrayLike
    ) -> FloatArray:
        """Return the log loss of every pair of two axes.

        Parameters
        ----------
        p_free_wall : array_like of shape (A,)
            Probabilities of free of the drawing's wall cells, in (0, 1).
        p_free_space : array_like of shape (B,)
            The same of all other cells.

        Returns
        -------
        ndarray of float64, shape (A, B)
            Bits per cell, equal to `log_loss` of the map of each pair; NaN where no
            cell is scored. Numbers instead of axes give a single value.

        Raises
        ------
        TypeError
            Where the values are not real numbers.
        ParameterError
            Where a value lies outside (0, 1).
        """
        wall = self.wall.nats(prior_levels("p_free_wall", p_free_wall, 1.0))
        space = self.space.nats(prior_levels("p_free_space", p_free_space, 1.0))
        per_cell = self.n_cells * np.log(2.0) if self.n_cells else np.nan
        return np.asarray(np.add.outer(wall, space) / per_cell, dtype=np.float64)

    def best(self) -> tuple[float, float, float]:
        """Return the pair of least log loss and its bits; see `best_log_loss_pair`."""
        pair = self.wall.minimum(), self.space.minimum()
        return *pair, float(self.bits(*pair))


def loss_surface(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.ALL,
    is_unknown: BoolArray | None = None,
) -> LossSurface:
    """Return the log loss of the final map as a function of the prior pair.

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
    region : Region, default Region.ALL
        Which cells are scored.
    is_unknown : ndarray of bool, shape (R, C), optional
        Cells of which the drawing says nothing: no pair changes their prior of one
        half. None by default.

    Returns
    -------
    LossSurface

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where a shape is not the grid's, or the rule or region is no member of its enum.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, logit, loss_surface
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 0], [], logit([]))  # nothing was read
    >>> walls = [[True, False]]
    >>> loss_surface(log, walls, walls).bits([0.5, 0.25], [0.5]).round(3)
    array([[1.   ],
           [0.708]])
    """
    groups = scored_groups(evidence, is_wall, truth, rule, region, is_unknown)
    wall_hit, wall_free, space_hit, space_free = groups
    n_cells = sum(sums.size for sums, _ in groups)
    return LossSurface(
        _class_loss(wall_hit, wall_free), _class_loss(space_hit, space_free), n_cells
    )


def best_log_loss_pair(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.ALL,
) -> tuple[float, float, float]:
    """Return the prior pair whose final map has the least log loss.

    Parameters
    ----------
    evidence, is_wall, truth, rule, region
        As in `loss_surface`.

    Returns
    -------
    p_free_wall, p_free_space : float
        Probabilities, not scaled by 0.9, in [1e-6, 1 - 1e-6]; the ends are attained.
        One half for a class that has no scored cell, or whose prior cancels in every
        cell (SUBTRACT_PRIOR and one reading each).
    bits : float
        Log loss of the map, bits per cell; NaN where no cell is scored.

    Raises
    ------
    TypeError, ParameterError
        As in `loss_surface`.

    Notes
    -----
    Unique, as the log loss is strictly convex in the l_0 of either class, and exact to
    rounding: a bracketed Newton iteration in one dimension for each.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, best_log_loss_pair, logit
    >>> grid = Grid(height_px=1, width_px=4, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 0], [], logit([]))  # nothing was read
    >>> drawn = [[True, True, True, True]]
    >>> truth = [[True, True, True, False]]
    >>> [round(v, 6) for v in best_log_loss_pair(log, drawn, truth)]
    [0.25, 0.5, 0.811278]
    """
    return loss_surface(evidence, is_wall, truth, rule, region).best()


def _class_loss(*groups: tuple[FloatArray, FloatArray]) -> ClassLoss:
    """Return the loss of cells that are wall, and of cells that are free, in truth."""
    parts = []
    for sign, (sums, weight) in zip((1.0, -1.0), groups, strict=True):
        # A complex number for each cell: equal ones are found in one sort.
        values, count = np.unique(sums + 1j * weight, return_counts=True)
        parts.append((sign * values.real, sign * values.imag, count))
    sums, weight, count = (np.concatenate(part) for part in zip(*parts, strict=True))
    return ClassLoss(sums, weight, count)

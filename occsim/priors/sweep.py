"""Tables of scores over two axes of prior values: the source's sweep.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", sec. 4.6: Fig. 4.5, Tables 4.1 and 4.2; C. Georgiou, S. Anderson and
   T. Dodd, IJRR 2017, doi 10.1177/0278364916687027.
"""

from dataclasses import dataclass
from enum import Enum
from functools import cached_property

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import ParameterError, choice, expect, real_array, shared_shape
from occsim.evidence_log import Evidence
from occsim.mapping import UpdateRule
from occsim.metrics import Region, f_beta_of, precision_of, recall_of
from occsim.prior import PRIOR_SCALE
from occsim.priors.surface import PriorSurface, prior_surface

SOURCE_AXIS = tuple(round(0.1 * i, 1) for i in range(1, 11))
"""Values of p_wall and p_space that the source swept: 0.1, 0.2, ..., 1."""


class Objective(Enum):
    """Scores by which a prior pair is judged.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Objective, maxima
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> sweep = run.sweep()
    >>> best = maxima(sweep, Objective.RECALL)
    >>> bool(best.value == sweep.recall.max())
    True
    """

    PRECISION = "precision"
    RECALL = "recall"


@dataclass(frozen=True, eq=False, repr=False)
class PriorSweep(ShortRepr):
    """Scores at every pair of two axes of prior values.

    Parameters
    ----------
    p_wall : ndarray of float64, shape (A,)
        Values for wall cells.
    p_space : ndarray of float64, shape (B,)
        Values for space cells.
    tp, fp, fn, tn : ndarray of int64, shape (A, B)
        Counts of cells, as in `Scores`.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> run.sweep().precision.shape
    (10, 10)
    """

    p_wall: FloatArray
    p_space: FloatArray
    tp: IntArray
    fp: IntArray
    fn: IntArray
    tn: IntArray

    @cached_property
    def precision(self) -> FloatArray:
        """TP / (TP + FP), (A, B); NaN where nothing is declared wall."""
        return precision_of(self.tp, self.fp)

    @cached_property
    def recall(self) -> FloatArray:
        """TP / (TP + FN), (A, B); NaN where there is no wall to find."""
        return recall_of(self.tp, self.fn)

    @cached_property
    def f2(self) -> FloatArray:
        """F2, (A, B): recall in twice the weight of precision."""
        return f_beta_of(self.tp, self.fp, self.fn, 2.0)

    def values(self, objective: Objective) -> FloatArray:
        """Return the table of one objective, (A, B)."""
        return getattr(self, choice("objective", objective, Objective).value)  # type: ignore[no-any-return]


@dataclass(frozen=True, eq=False, repr=False)
class Maxima(ShortRepr):
    """The largest value in a sweep and every pair that attains it.

    Parameters
    ----------
    value : float
        The maximum; NaN where the objective is undefined everywhere.
    p_wall, p_space : ndarray of float64, shape (M,)
        The pairs, by p_wall and then p_space.
    text : str
        The pairs in short, as the source prints them: ``"(0.7:1, 1)"``.
    """

    value: float
    p_wall: FloatArray
    p_space: FloatArray
    text: str


def sweep_priors(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    p_wall: npt.ArrayLike,
    p_space: npt.ArrayLike,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    scale: float = PRIOR_SCALE,
) -> PriorSweep:
    """Return the scores of the final map for every pair of two axes.

    Equal, pair by pair, to `fuse` and `score` with ``Prior(p_wall, p_space)``.

    Parameters
    ----------
    evidence, is_wall, truth, rule, region, scale
        As in `prior_surface`.
    p_wall : array_like of shape (A,)
        Values for wall cells, in (0, 1].
    p_space : array_like of shape (B,)
        Values for space cells, in (0, 1].

    Returns
    -------
    PriorSweep

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where a value lies outside its domain, an axis is not one-dimensional, or a
        shape is not the grid's.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, logit, sweep_priors
    >>> grid = Grid(height_px=1, width_px=1, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 1], [0], logit([0.1]))
    >>> wall = [[True]]
    >>> sweep_priors(log, wall, wall, [0.2, 1.0], [0.9]).recall
    array([[1.],
           [0.]])
    """
    surface = prior_surface(evidence, is_wall, truth, rule, region, scale)
    return sweep_surface(surface, p_wall, p_space)


def sweep_surface(
    surface: PriorSurface, p_wall: npt.ArrayLike, p_space: npt.ArrayLike
) -> PriorSweep:
    """Return the scores of a known surface for every pair of two axes.

    Parameters
    ----------
    surface : PriorSurface
        From `prior_surface`.
    p_wall, p_space : array_like of shape (A,) and (B,)
        Values in (0, 1].

    Returns
    -------
    PriorSweep

    Raises
    ------
    ParameterError
        Where a value lies outside its domain or an axis is not one-dimensional.
    """
    expect("surface", surface, PriorSurface)
    axes = [
        real_array(name, axis).copy()
        for name, axis in (("p_wall", p_wall), ("p_space", p_space))
    ]
    for name, axis in zip(("p_wall", "p_space"), axes, strict=True):
        if axis.ndim != 1:
            raise ParameterError(
                f"{name} must be one-dimensional; got shape {axis.shape}"
            )
    tp, fp = surface.counts(axes[0][:, None], axes[1][None, :])
    fn, tn = surface.n_wall - tp, surface.n_space - fp
    return PriorSweep(axes[0], axes[1], tp=tp, fp=fp, fn=fn, tn=tn)


def interpolate(
    sweep: PriorSweep,
    p_wall: npt.ArrayLike,
    p_space: npt.ArrayLike,
    objective: Objective = Objective.PRECISION,
) -> FloatArray:
    """Return a bilinear interpolation of a sweep, as the source draws it (Fig. 4.5).

    Between the sweep's pairs this is an approximation: the true surface has steps.

    Parameters
    ----------
    sweep : PriorSweep
        Axes ascending, of two values or more each.
    p_wall, p_space : array_like
        Where to interpolate, within the axes, of shapes that broadcast.
    objective : Objective, default Objective.PRECISION
        Which table.

    Returns
    -------
    ndarray of float64
        NaN where a corner of non-zero weight is undefined.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where the axes do not ascend, a point lies outside them, or shapes do not
        broadcast.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import interpolate
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> sweep = run.sweep()
    >>> bool(interpolate(sweep, 0.2, 0.9) == sweep.precision[1, 8])
    True
    """
    expect("sweep", sweep, PriorSweep)
    row, row_share = _bracket("p_wall", sweep.p_wall, p_wall)
    col, col_share = _bracket("p_space", sweep.p_space, p_space)
    table = sweep.values(objective)
    total: FloatArray = np.zeros(shared_shape(p_wall=row, p_space=col))
    for i, row_weight in ((row, 1.0 - row_share), (row + 1, row_share)):
        for j, col_weight in ((col, 1.0 - col_share), (col + 1, col_share)):
            weight = row_weight * col_weight
            # An undefined corner of weight zero must not make a defined point
            # undefined.
            total = total + np.where(weight == 0.0, 0.0, weight * table[i, j])
    return total


def _bracket(
    name: str, axis: FloatArray, values: npt.ArrayLike
) -> tuple[IntArray, FloatArray]:
    # The interval of the axis that holds each value, and how far into it.
    points = real_array(name, values)
    if axis.size < 2 or not (np.diff(axis) > 0.0).all():
        raise ParameterError(
            f"the {name} axis must ascend over at least two values; got {axis.tolist()}"
        )
    if not ((points >= axis[0]) & (points <= axis[-1])).all():
        raise ParameterError(
            f"{name} must lie within the sweep, {axis[0]:g} to {axis[-1]:g}"
        )
    left = np.searchsorted(axis, points, side="right") - 1
    left = np.minimum(left, axis.size - 2)
    share = (points - axis[left]) / (axis[left + 1] - axis[left])
    return np.asarray(left, dtype=np.int64), np.asarray(share, dtype=np.float64)


def maxima(sweep: PriorSweep, objective: Objective) -> Maxima:
    """Return the largest value of an objective and all pairs that attain it.

    Ties are exact: equal ratios of whole numbers are equal in binary.

    Parameters
    ----------
    sweep : PriorSweep
        Any axes.
    objective : Objective
        Precision or recall.

    Returns
    -------
    Maxima

    Raises
    ------
    TypeError
        Where the sweep is no `PriorSweep`.
    ParameterError
        Where the objective is no `Objective`.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import Objective, maxima
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> sweep = run.sweep()
    >>> best = maxima(sweep, Objective.PRECISION)
    >>> 0.9 < best.value <= 1.0
    True
    """
    expect("sweep", sweep, PriorSweep)
    table = sweep.values(objective)
    defined = table[~np.isnan(table)]
    if not defined.size:
        none = np.empty(0)
        return Maxima(float("nan"), none, none, "–")
    value = float(defined.max())
    ties = table == value
    rows, cols = np.nonzero(ties)
    text = ties_text(sweep.p_wall, sweep.p_space, ties)
    return Maxima(value, sweep.p_wall[rows], sweep.p_space[cols], text)


def ties_text(p_wall: FloatArray, p_space: FloatArray, ties: BoolArray) -> str:
    """Return marked pairs in short, neighbours gathered into ranges.

    Parameters
    ----------
    p_wall : ndarray of float64, shape (A,)
        Axis of the rows.
    p_space : ndarray of float64, shape (B,)
        Axis of the columns.
    ties : ndarray of bool, shape (A, B)
        Marked pairs.

    Returns
    -------
    str
        ``"(0.1:0.2, 0.3:0.5)"`` for a block; several blocks are joined by ``"; "``.
    """
    blocks = []
    for rows in _runs_of_equal_rows(ties):
        for cols in _runs(ties[rows[0]]):
            wall, space = _range_text(p_wall, rows), _range_text(p_space, cols)
            blocks.append(f"({wall}, {space})")
    return "; ".join(blocks)


def _range_text(axis: FloatArray, ends: tuple[int, int]) -> str:
    first, last = (f"{axis[i]:g}" for i in ends)
    return first if first == last else f"{first}:{last}"


def _runs(flags: BoolArray) -> list[tuple[int, int]]:
    # First and last index of each run of true flags.
    edges = np.diff(flags.astype(np.int8), prepend=0, append=0)
    firsts, stops = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return list(zip(firsts.tolist(), (stops - 1).tolist(), strict=True))


def _runs_of_equal_rows(flags: BoolArray) -> list[tuple[int, int]]:
    # First and last of neighbouring rows that are marked alike. Unmarked rows are
    # grouped too, but have no runs.
    new = np.flatnonzero((flags[1:] != flags[:-1]).any(axis=1)) + 1
    firsts = [0, *new.tolist()]
    return list(zip(firsts, [*(new - 1).tolist(), len(flags) - 1], strict=True))

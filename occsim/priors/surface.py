"""The counts of a final map as exact functions of the prior pair.

Wall cells depend on p_wall alone and space cells on p_space alone. In the closed form
``l = S + w l_0`` (w = 1 - k, or 1) each cell flips at one level of its prior's log-odds
l_0, so the counts of each class are step functions of one variable, known once the
levels are sorted. Every sweep and the exact Pareto front are read from them.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import ParameterError, choice, real_array, real_number, shared_shape
from occsim.evidence_log import Evidence, require_evidence
from occsim.grid import cells_of
from occsim.logodds import DECISION_EPS, LATTICE_NATS, logit
from occsim.mapping import UpdateRule, prior_weight
from occsim.metrics import Region
from occsim.prior import PRIOR_SCALE


@dataclass(frozen=True, eq=False, repr=False)
class StepCount(ShortRepr):
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
        """Return the first level of every step on the lattice, unsorted, nats."""
        return np.concatenate((self.falling + LATTICE_NATS, self.rising))


@dataclass(frozen=True, eq=False, repr=False)
class PriorSurface(ShortRepr):
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

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> surface = run.surface()
    >>> tp, fp = surface.counts([0.1, 0.2], [0.9])
    >>> tp.shape
    (2,)
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
        TypeError
            Where the values are not real numbers.
        ParameterError
            Where a value lies outside its domain, or the shapes do not broadcast.
        """
        wall = prior_levels("p_wall", p_wall, self.scale)
        space = prior_levels("p_space", p_space, self.scale)
        shared_shape(p_wall=wall, p_space=space)
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
    TypeError
        Where the values are not real numbers.
    ParameterError
        Where a value lies outside its domain, or is 1 with a scale of 1.
    """
    p = real_array(name, values)
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
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    scale: float = PRIOR_SCALE,
    is_unknown: BoolArray | None = None,
) -> PriorSurface:
    """Return true and false positives as exact functions of the prior pair.

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
    scale : float, default 0.9
        Factor on p_wall and p_space.
    is_unknown : ndarray of bool, shape (R, C), optional
        Cells of which the drawing says nothing: no pair changes their prior of one
        half. None by default.

    Returns
    -------
    PriorSurface

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where a shape is not the grid's, the scale lies outside its domain, or the
        rule or region is no member of its enum.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, logit, prior_surface
    >>> grid = Grid(height_px=1, width_px=1, cell_px=1)
    >>> log = EvidenceLog(grid, [0, 1], [0], logit([0.1]))
    >>> wall = [[True]]  # read as wall once: found unless the prior is 0.9
    >>> prior_surface(log, wall, wall).counts([0.5, 0.99, 1.0], 0.5)[0]
    array([1, 1, 0])
    """
    groups = scored_groups(evidence, is_wall, truth, rule, region, is_unknown)
    scale = real_number("scale", scale)
    if not 0.0 < scale <= 1.0:
        raise ParameterError(f"scale must lie in (0, 1]; got {scale!r}")
    wall_hit, wall_free, space_hit, space_free = (sums.size for sums, _ in groups)
    wall_tp, wall_fp, space_tp, space_fp = (_step_count(*group) for group in groups)
    n_wall, n_space = wall_hit + space_hit, wall_free + space_free
    return PriorSurface(wall_tp, wall_fp, space_tp, space_fp, n_wall, n_space, scale)


def scored_groups(
    evidence: Evidence,
    is_wall: BoolArray,
    truth: BoolArray,
    rule: UpdateRule,
    region: Region,
    is_unknown: BoolArray | None = None,
) -> list[tuple[FloatArray, FloatArray]]:
    """Return S and w of ``l = S + w l_0`` for the scored cells, in four groups.

    Parameters
    ----------
    evidence, is_wall, truth, rule, region, is_unknown
        As in `prior_surface`.

    Returns
    -------
    list of (sums, weight), each ndarray of float64 of shape (N,)
        Wall cells of the drawing that are wall in truth, and that are free; other cells
        that are wall, and that are free.
    """
    require_evidence(evidence)
    is_wall = cells_of("is_wall", is_wall, evidence.grid)
    truth = cells_of("truth", truth, evidence.grid)
    sums, counts = evidence.totals()
    scored = choice("region", region, Region).scored(counts)
    weight = prior_weight(counts, rule)
    if is_unknown is not None:  # their l_0 is 0, whatever the pair
        weight = np.where(cells_of("is_unknown", is_unknown, evidence.grid), 0, weight)
    sums, weight = sums[scored], weight[scored]
    wall, hit = is_wall[scored], truth[scored]
    groups = (wall & hit, wall & ~hit, ~wall & hit, ~wall & ~hit)
    return [(sums[group], weight[group]) for group in groups]


def _step_count(sums: FloatArray, weight: FloatArray) -> StepCount:
    """Return the steps of cells with readings of these sums S and weights w of l_0.

    In steps of the lattice S, l_0 and the decision level are whole numbers: the last
    l_0 with ``S + w l_0 < -DECISION_EPS`` is a division of whole numbers, so every
    count equals that of a fused map, at ties too.
    """
    # The largest log-odds on the lattice that are declared wall, less S.
    wall = np.ceil(-DECISION_EPS / LATTICE_NATS) - 1.0
    room = (wall - sums / LATTICE_NATS).astype(np.int64)
    w = weight.astype(np.int64)
    falls, rises = w > 0, w < 0
    return StepCount(
        always=int(np.count_nonzero(room[w == 0] >= 0)),
        falling=np.sort(room[falls] // w[falls]) * LATTICE_NATS,
        rising=np.sort(-(room[rises] // -w[rises])) * LATTICE_NATS,
    )

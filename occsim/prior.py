"""The prior map: what the drawing says before the first reading."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray, ShortRepr
from occsim.errors import (
    ParameterError,
    bool_array,
    expect,
    real_array,
    real_number,
)
from occsim.grid import Grid, cells_of
from occsim.logodds import logit
from occsim.world import wall_cells

SOURCE_PAIR = (0.2, 0.9)
"""(p_wall, p_space) that the source chose in the end, Fig. 4.6e."""

PRIOR_SCALE = 0.9
"""Factor on p_wall and p_space: keeps a value of 1 away from infinite log-odds."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Prior:
    """Probability of free that the drawing gives to wall cells and to space cells.

    Parameters
    ----------
    p_wall, p_space : float
        Values in (0, 1]; the prior is ``scale * p_wall`` on wall cells and
        ``scale * p_space`` elsewhere. The defaults are the source's choice.
    scale : float, default 0.9
        Factor in (0, 1]. With a scale of 1, p_wall and p_space must be below 1.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim import Prior
    >>> round(Prior(p_wall=0.2, p_space=0.9).p_free_wall, 3)
    0.18
    """

    p_wall: float = SOURCE_PAIR[0]
    p_space: float = SOURCE_PAIR[1]
    scale: float = PRIOR_SCALE

    def __post_init__(self) -> None:
        for name in ("p_wall", "p_space", "scale"):
            value = real_number(name, getattr(self, name))
            if not 0.0 < value <= 1.0:
                raise ParameterError(f"{name} must lie in (0, 1]; got {value!r}")
            object.__setattr__(self, name, value)
        if max(self.p_wall, self.p_space) * self.scale >= 1.0:
            raise ParameterError(
                "scale * p_wall and scale * p_space must lie below 1, where log-odds "
                f"are finite; got {self.scale!r} * "
                f"{max(self.p_wall, self.p_space)!r}"
            )

    @classmethod
    def uninformative(cls) -> Self:
        """Return the prior that says nothing: p_free exactly one half everywhere."""
        return cls(p_wall=0.5, p_space=0.5, scale=1.0)

    @property
    def p_free_wall(self) -> float:
        """Probability of free on wall cells."""
        return self.scale * self.p_wall

    @property
    def p_free_space(self) -> float:
        """Probability of free on every other cell."""
        return self.scale * self.p_space


@dataclass(frozen=True, eq=False, repr=False)
class PriorMap(ShortRepr):
    """A prior laid over a grid.

    Parameters
    ----------
    grid : Grid
        The cells.
    is_wall : ndarray of bool, shape (R, C)
        Cells in which the drawing shows a wall.
    p_free : ndarray of float64, shape (R, C)
        Probability of free before the first reading, in (0, 1).

    Raises
    ------
    TypeError, ParameterError
        Where an array is of another type or shape, or a probability not in (0, 1).

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, PriorMap
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> walls = np.array([[True, False]])
    >>> PriorMap(grid, walls, np.array([[0.2, 0.8]])).log_odds.round(2)
    array([[-1.39,  1.39]])
    """

    grid: Grid
    is_wall: BoolArray
    p_free: FloatArray

    def __post_init__(self) -> None:
        is_wall = cells_of("is_wall", self.is_wall, self.grid)
        p_free = real_array("p_free", self.p_free)
        if p_free.shape != self.grid.shape or not ((p_free > 0) & (p_free < 1)).all():
            raise ParameterError(
                f"p_free must have shape {self.grid.shape} and lie in (0, 1); "
                f"got shape {p_free.shape}, {p_free.min()} to {p_free.max()}"
            )
        object.__setattr__(self, "is_wall", is_wall)
        object.__setattr__(self, "p_free", p_free)

    @property
    def log_odds(self) -> FloatArray:
        """Log-odds l_0 of the prior, on the lattice, ndarray of shape (R, C)."""
        return logit(self.p_free)


def prior_from_cells(
    is_wall: BoolArray,
    grid: Grid,
    prior: Prior,
    is_unknown: BoolArray | None = None,
) -> PriorMap:
    """Return the prior map of cells that are already classed.

    Parameters
    ----------
    is_wall : ndarray of bool, shape (R, C)
        Wall cells of the drawing.
    grid : Grid
        The cells.
    prior : Prior
        Values for the two classes.
    is_unknown : ndarray of bool, shape (R, C), optional
        Cells of which the drawing says nothing: p_free is one half; none by default.

    Returns
    -------
    PriorMap

    Raises
    ------
    TypeError, ParameterError
        Where an array is not bool, or not of the grid's shape.
    """
    is_wall = cells_of("is_wall", is_wall, grid)
    expect("prior", prior, Prior)
    p_free = np.where(is_wall, prior.p_free_wall, prior.p_free_space)
    if is_unknown is not None:
        p_free[cells_of("is_unknown", is_unknown, grid)] = 0.5
    return PriorMap(grid=grid, is_wall=is_wall, p_free=p_free)


def build_prior(
    wall_mask: BoolArray,
    grid: Grid,
    prior: Prior,
    wall_share: float = 0.0,
    unknown: BoolArray | None = None,
) -> PriorMap:
    """Return the prior map that a detected wall mask gives.

    Parameters
    ----------
    wall_mask : array_like of bool, shape (H, W)
        Walls found in the drawing (never the ground truth).
    grid : Grid
        Cells over the same image.
    prior : Prior
        Values for wall cells and space cells.
    wall_share : float, default 0
        Share of wall pixels that a wall cell must exceed, in [0, 1).
    unknown : array_like of bool, shape (H, W), optional
        Pixels of which the drawing says nothing; see `unknown_cells`. None by default.

    Returns
    -------
    PriorMap

    Raises
    ------
    TypeError
        Where a mask is not bool (a grey image is none), or the grid no `Grid`.
    ParameterError
        Where sizes differ or the threshold lies outside its domain.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, Prior, build_prior
    >>> grid = Grid(height_px=1, width_px=4, cell_px=2)
    >>> mask = np.array([[True, False, False, False]])
    >>> build_prior(mask, grid, Prior(p_wall=0.2, p_space=0.9)).p_free
    array([[0.18, 0.81]])
    """
    is_wall = wall_cells(wall_mask, grid, wall_share)
    return prior_from_cells(is_wall, grid, prior, unknown_cells(unknown, is_wall, grid))


def unknown_cells(
    unknown: BoolArray | None, is_wall: BoolArray, grid: Grid
) -> BoolArray | None:
    """Return the cells of which a drawing says nothing, such as a robot's map.

    Parameters
    ----------
    unknown : array_like of bool, shape (H, W), or None
        Pixels of which it says nothing.
    is_wall : ndarray of bool, shape (R, C)
        Its wall cells.
    grid : Grid
        Cells over the same image.

    Returns
    -------
    ndarray of bool, shape (R, C), or None
        Cells that are no wall cell and half or more of whose pixels are unknown; None
        where all is known.

    Raises
    ------
    TypeError, ParameterError
        Where an array is not bool, or not of its shape.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, unknown_cells
    >>> grid = Grid(height_px=1, width_px=6, cell_px=2)
    >>> unknown = np.array([[True, False, False, False, True, True]])
    >>> unknown_cells(unknown, np.array([[False, False, True]]), grid)
    array([[ True, False, False]])
    """
    is_wall = cells_of("is_wall", is_wall, grid)
    if unknown is None:
        return None
    return (grid.share(unknown) >= 0.5) & ~is_wall


def calibrated_prior(is_wall: BoolArray, truth: BoolArray) -> tuple[float, float]:
    """Return the prior that states how often the drawing is right.

    Parameters
    ----------
    is_wall : ndarray of bool, shape (R, C)
        Wall cells of the drawing.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.

    Returns
    -------
    p_free_wall, p_free_space : float
        Share of the wall cells, and of the others, that are free in truth, as
        probabilities for ``Prior(p_wall=..., p_space=..., scale=1.0)``. Laplace's
        (n + 1) / (N + 2), so that 0 and 1 do not occur; one half for a class without
        cells.

    Raises
    ------
    TypeError
        Where an array is not bool.
    ParameterError
        Where the shapes differ.

    Notes
    -----
    It needs no readings. Under PRIOR_ONCE and over all cells its log loss comes close
    to that of the best pair, `occsim.best_log_loss_pair`.

    Examples
    --------
    >>> from occsim import calibrated_prior
    >>> calibrated_prior([[True, True, False, False]], [[True, True, True, False]])
    (0.25, 0.5)
    """
    return _smoothed(_free_counts(is_wall, truth))


def estimated_prior(
    others: Iterable[tuple[BoolArray, BoolArray]],
) -> tuple[float, float]:
    """Return the calibrated prior of other drawings, for one without ground truth.

    Parameters
    ----------
    others : iterable of (is_wall, truth)
        Cells of each, as in `calibrated_prior`; sizes may differ. Leave out the drawing
        that the prior is for.

    Returns
    -------
    p_free_wall, p_free_space : float
        From the counts of all cells together; one half each without a drawing.

    Raises
    ------
    TypeError
        Where the others are no pairs of arrays of bool.
    ParameterError
        Where the shapes of a pair differ.

    Examples
    --------
    >>> from occsim import estimated_prior
    >>> estimated_prior([([[True]], [[True]]), ([[True, True]], [[True, False]])])
    (0.4, 0.5)
    """
    expect("others", others, Iterable)
    total = np.zeros((2, 2), dtype=np.int64)
    for pair in others:
        if not isinstance(pair, (tuple, list)) or len(pair) != 2:
            raise TypeError("others must hold pairs (is_wall, truth) of arrays of bool")
        total += _free_counts(*pair)
    return _smoothed(total)


def _free_counts(is_wall: BoolArray, truth: BoolArray) -> IntArray:
    """Return free and all cells of the two classes, wall cells first, (2, 2)."""
    wall = bool_array("is_wall", is_wall)
    free = ~bool_array("truth", truth, wall.shape)
    both = (wall & free).sum(), wall.sum()
    return np.array([both, (free.sum() - both[0], wall.size - both[1])])


def _smoothed(counts: IntArray) -> tuple[float, float]:
    wall, space = ((int(n) + 1) / (int(of) + 2) for n, of in counts)
    return wall, space

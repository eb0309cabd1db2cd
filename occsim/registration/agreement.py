"""How well a registered drawing's walls agree with what a robot saw."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.errors import expect
from occsim.evidence_log import Evidence, require_evidence
from occsim.logodds import is_occupied
from occsim.prior import Prior
from occsim.registration.similarity import Registration, registered_walls
from occsim.world import wall_cells


@dataclass(frozen=True, kw_only=True, slots=True)
class Agreement:
    """How well a registered drawing agrees with readings.

    Parameters
    ----------
    bits : float
        By how much more probable the readings are with the drawn walls where they lie
        than with none, as a binary logarithm. Below 0 the readings speak against them.
    n_walls_seen : int
        Drawn wall cells that a reading updated.
    n_found : int
        Those of them that the readings alone declare occupied.

    Examples
    --------
    >>> from occsim import Agreement
    >>> Agreement(bits=120.0, n_walls_seen=40, n_found=30).share_found
    0.75
    """

    bits: float
    n_walls_seen: int
    n_found: int

    @property
    def share_found(self) -> float:
        """Share of the drawn walls seen that are found; NaN where there is none."""
        return self.n_found / self.n_walls_seen if self.n_walls_seen else float("nan")


def agreement(
    walls: BoolArray,
    evidence: Evidence,
    registration: Registration,
    prior: Prior = Prior(),  # noqa: B008 - frozen
) -> Agreement:
    """Return how well a registered drawing agrees with readings.

    Parameters
    ----------
    walls : ndarray of bool, shape (H, W)
        Wall mask of the drawing.
    evidence : EvidenceLog or EvidenceTotals
        What the robot saw, on the map's grid.
    registration : Registration
        Where the drawing lies on the map.
    prior : Prior, default Prior()
        What is believed of drawn walls and of the rest.

    Returns
    -------
    Agreement

    Raises
    ------
    TypeError, ParameterError
        As `registered_walls`; where evidence or prior are of another type.

    Notes
    -----
    A cell whose readings sum to S is ``p_free e^S + 1 - p_free`` times as probable to
    give them as a wall is. To draw a wall replaces p_free of space by that of walls;
    the logarithms of these ratios are summed over the drawn wall cells. The sum is the
    logarithm of a Bayes factor. A cell counts at most a few bits, however often it was
    read, and one never looked at counts 0.

    Examples
    --------
    >>> from occsim import EvidenceLog, Grid, Prior, Registration, agreement, logit
    >>> grid = Grid(height_px=1, width_px=3, cell_px=1)
    >>> seen = EvidenceLog(grid, [0, 2], [0, 1], logit([0.9, 0.1]))
    >>> drawn = np.array([[False, True, False]])
    >>> found = agreement(drawn, seen, Registration())
    >>> round(found.bits, 2), found.n_walls_seen, found.share_found
    (1.58, 1, 1.0)
    """
    require_evidence(evidence)
    expect("prior", prior, Prior)
    mask = registered_walls(walls, registration, evidence.grid)
    drawn = wall_cells(mask, evidence.grid, 0.0)
    sums, counts = evidence.totals()
    return Agreement(
        bits=float(wall_gains(sums[drawn], prior).sum() / np.log(2.0)),
        n_walls_seen=int((counts[drawn] > 0).sum()),
        n_found=int(is_occupied(sums[drawn]).sum()),
    )


def wall_gains(sums: FloatArray, prior: Prior) -> FloatArray:
    """Return the log of how much more probable readings are if a wall is drawn, nats.

    Parameters
    ----------
    sums : ndarray of float64
        Summed log-odds of each cell's readings, nats.
    prior : Prior
        What is believed of drawn walls and of the rest.

    Returns
    -------
    ndarray of float64
        0 for a sum of 0.
    """
    wall, space = (
        np.logaddexp(np.log(p_free) + sums, np.log1p(-p_free))
        for p_free in (prior.p_free_wall, prior.p_free_space)
    )
    return np.asarray(wall - space)

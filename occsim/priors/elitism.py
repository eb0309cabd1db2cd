"""Controlled elitism, the survival rule of the source's optimiser, for pymoo.

This module imports pymoo and is itself imported only when an optimisation starts.

References
----------
.. [1] K. Deb and T. Goel, "Controlled elitist non-dominated sorting genetic algorithms
   for better convergence", EMO 2001, LNCS 1993, doi 10.1007/3-540-44719-9_5.
"""

from typing import Any

import numpy as np
from pymoo.core.survival import Survival
from pymoo.operators.survival.rank_and_crowding.metrics import get_crowding_function
from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

from occsim.priors.shares import geometric_shares


class ControlledElitism(Survival):  # type: ignore[misc]  # pymoo is untyped
    """Keep some of every front, geometrically fewer of the later ones.

    Within a front the least crowded survive. Where fronts are smaller than their
    shares, the remaining places go to the best individuals left out.

    Parameters
    ----------
    ratio : float
        Share r of a front relative to the one before it, in (0, 1).
    """

    def __init__(self, ratio: float) -> None:
        super().__init__(filter_infeasible=True)
        self.ratio = ratio
        self._sorting = NonDominatedSorting()
        self._crowding = get_crowding_function("cd")

    def _do(
        self,
        problem: Any,
        pop: Any,
        *args: Any,
        n_survive: int | None = None,
        random_state: Any = None,
        **kwargs: Any,
    ) -> Any:
        objectives = pop.get("F").astype(np.float64, copy=False)
        fronts = self._sorting.do(objectives)
        ranked = []
        for rank, front in enumerate(fronts):
            crowding = self._crowding.do(objectives[front], n_remove=0)
            for individual, distance in zip(pop[front], crowding, strict=True):
                individual.set("rank", rank)
                individual.set("crowding", distance)
            ranked.append(front[np.argsort(-crowding, kind="stable")])
        survive = len(pop) if n_survive is None else n_survive
        shares = geometric_shares([len(f) for f in fronts], survive, self.ratio)
        kept = [f[:n] for f, n in zip(ranked, shares, strict=True)]
        return pop[np.concatenate(kept)]

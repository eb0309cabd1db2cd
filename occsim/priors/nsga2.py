"""NSGA-II over prior pairs, as the source searched for the Pareto front.

An approximation of what :func:`occsim.priors.exact_front` gives exactly.

References
----------
.. [1] K. Deb, A. Pratap, S. Agarwal and T. Meyarivan, "A fast and elitist
   multiobjective genetic algorithm: NSGA-II", IEEE Trans. Evol. Comput. 6(2), 2002.
.. [2] K. Deb and T. Goel, "Controlled elitist non-dominated sorting genetic algorithms
   for better convergence", EMO 2001, doi 10.1007/3-540-44719-9_5: the variant in the
   source's reference [44], MATLAB's gamultiobj.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import product
from typing import Any

import numpy as np

from occsim._extras import needs_extra
from occsim._types import FloatArray, Progress
from occsim.errors import ParameterError, choice, real_number, whole_number
from occsim.prior import PRIOR_SCALE
from occsim.priors.front import ParetoFront, front_of, hypervolume
from occsim.priors.objectives import AnyObjective, ObjectiveFunction, as_objective

PARETO_FRACTION = 0.35
"""Default of the source's tool: share of the population on the best front."""

ONE_HALF = 0.5 / PRIOR_SCALE
"""Value of p_wall or p_space that is a prior of one half."""

PENALTY = 1e6
"""Value of 1/precision or 1/recall where the score is 0 or undefined: finite, because
distances between individuals are computed, and worse than one cell in a million."""


class Elitism(Enum):
    """Which individuals survive a generation.

    Examples
    --------
    >>> from occsim import Elitism
    >>> Elitism("controlled")
    <Elitism.CONTROLLED: 'controlled'>
    """

    FULL = "full"
    """The best fronts, as many as fit: NSGA-II."""
    CONTROLLED = "controlled"
    """Some of every front: the variant of the source's tool."""


@dataclass(frozen=True, eq=False)
class Generation:
    """The population after one generation.

    Parameters
    ----------
    number : int
        1 for the first population: random pairs, the corners of the box, and pairs
        with a prior of one half.
    population : ndarray of float64, shape (N, 2)
        Columns p_wall and p_space.
    objectives : ndarray of float64, shape (N, 2)
        Columns precision and recall; NaN where undefined.
    hypervolume : float
        Of the population against the reference point; NaN where none was given.

    Examples
    --------
    >>> from occsim import nsga2_generations
    >>> def objective(pairs):
    ...     return pairs[:, 0], 1.0 - 0.5 * pairs[:, 1]
    >>> first = next(nsga2_generations(objective, pop_size=20, seed=1))
    >>> first.number, first.population.shape
    (1, (20, 2))
    """

    number: int
    population: FloatArray
    objectives: FloatArray
    hypervolume: float

    def front(self) -> ParetoFront:
        """Return the population's non-dominated pairs."""
        pairs, scores = self.population, self.objectives
        return front_of(pairs[:, 0], pairs[:, 1], scores[:, 0], scores[:, 1])


def nsga2_generations(
    objective: AnyObjective,
    *,
    pop_size: int = 100,
    n_gen: int = 100,
    seed: int,
    elitism: Elitism = Elitism.FULL,
    pareto_fraction: float = PARETO_FRACTION,
    low: float = 0.1,
    high: float = 1.0,
    ref: Sequence[float] | None = None,
) -> Iterator[Generation]:
    """Yield the population generation by generation; leave the loop to stop.

    Parameters
    ----------
    objective : callable, PriorSweep or PriorSurface
        A function of pairs (N, 2), columns p_wall and p_space, that returns precision
        and recall, NaN allowed, as (N, 2) or as a tuple of two arrays (N,); see
        `interpolated_objective` and `exact_objective`. Or a function of two numbers,
        p_wall and p_space, called pair by pair. A sweep is interpolated, a surface
        evaluated exactly.
    pop_size : int, default 100
        Individuals in a population, 4 to 10,000.
    n_gen : int, default 100
        Generations, 1 to 10,000, the first one among them: random pairs, the four
        corners of the box, and five pairs with a prior of one half.
    seed : int
        0 to 2^32 - 1. Equal seeds give equal runs.
    elitism : Elitism, default Elitism.FULL
        Who survives.
    pareto_fraction : float, default 0.35
        With CONTROLLED, share of the population that the best front may fill, in
        (0, 1). It sets the ratio of shares r = 1 - fraction: over many fronts
        N_1 = N (1 - r) / (1 - r^K) tends to that share of N.
    low, high : float, default 0.1 and 1
        Bounds of both variables, 0 < low < high <= 1.
    ref : sequence of two floats, optional
        Reference point of the hypervolume, as 1/precision and 1/recall.

    Yields
    ------
    Generation

    Raises
    ------
    TypeError
        Where the objective is none of these.
    ParameterError
        Immediately where a value lies outside its domain; during the run where the
        objective does not return precision and recall.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import exact_objective, nsga2_generations
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> objective = exact_objective(run.evidence, run.wall_cells, run.truth_cells)
    >>> populations = nsga2_generations(objective, pop_size=20, n_gen=3, seed=1)
    >>> [one.number for one in populations]
    [1, 2, 3]
    """
    pop_size = whole_number("pop_size", pop_size, 4, 10_000)
    n_gen = whole_number("n_gen", n_gen, 1, 10_000)
    seed = whole_number("seed", seed, 0, 2**32 - 1)
    low, high = real_number("low", low), real_number("high", high)
    if not 0.0 < low < high <= 1.0:
        raise ParameterError(
            f"low and high must satisfy 0 < low < high <= 1; got {low!r} and {high!r}"
        )
    pareto_fraction = real_number("pareto_fraction", pareto_fraction)
    if not 0.0 < pareto_fraction < 1.0:
        raise ParameterError(
            f"pareto_fraction must lie in (0, 1); got {pareto_fraction!r}"
        )
    full = choice("elitism", elitism, Elitism) is Elitism.FULL
    ratio = None if full else 1.0 - pareto_fraction
    algorithm = _algorithm(pop_size, n_gen, seed, ratio, (low, high))
    return _run(algorithm, as_objective(objective), ref)


def nsga2_front(
    objective: AnyObjective,
    *,
    pop_size: int = 100,
    n_gen: int = 100,
    seed: int,
    elitism: Elitism = Elitism.FULL,
    pareto_fraction: float = PARETO_FRACTION,
    low: float = 0.1,
    high: float = 1.0,
    on_progress: Progress | None = None,
) -> ParetoFront:
    """Return the front of the last population: an approximation.

    Parameters
    ----------
    objective, pop_size, n_gen, seed, elitism, pareto_fraction, low, high
        As in `nsga2_generations`.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` after every generation.

    Returns
    -------
    ParetoFront
        Without rectangles; empty where no pair tried hits a wall.

    Raises
    ------
    TypeError
        Where the objective is none of those.
    ParameterError
        Where a value lies outside its domain, or the objective does not return
        precision and recall.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, load_sample
    >>> from occsim import exact_objective, nsga2_front
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(cell_px=10, sensor=sample.sensor))
    >>> objective = exact_objective(run.evidence, run.wall_cells, run.truth_cells)
    >>> front = nsga2_front(objective, pop_size=20, n_gen=5, seed=1)
    >>> bool((front.precision > 0.0).all())
    True
    """
    generations = nsga2_generations(
        objective,
        pop_size=pop_size,
        n_gen=n_gen,
        seed=seed,
        elitism=elitism,
        pareto_fraction=pareto_fraction,
        low=low,
        high=high,
    )
    for generation in generations:
        if on_progress is not None:
            on_progress(generation.number, n_gen)
    return generation.front()


def _algorithm(
    pop_size: int,
    n_gen: int,
    seed: int,
    ratio: float | None,
    bounds: tuple[float, float],
) -> Any:
    # Importing pymoo takes most of a second: only where an optimisation starts.
    with needs_extra("study", "NSGA-II"):
        from pymoo.algorithms.moo.nsga2 import NSGA2
        from pymoo.core.problem import Problem

        from occsim.priors.elitism import ControlledElitism

    survival = {} if ratio is None else {"survival": ControlledElitism(ratio)}
    first = _first_population(pop_size, seed, bounds)
    algorithm = NSGA2(pop_size=pop_size, sampling=first, **survival)
    problem = Problem(n_var=2, n_obj=2, xl=bounds[0], xu=bounds[1])
    algorithm.setup(problem, termination=("n_gen", n_gen), seed=seed)
    return algorithm


def _first_population(
    pop_size: int, seed: int, bounds: tuple[float, float]
) -> FloatArray:
    # Random pairs, and the priors that tie, which no random pair or small step would
    # hit: 0.9 * 1 with the sensor's readings, one half with unread cells.
    pairs = np.random.default_rng(seed).uniform(*bounds, (pop_size, 2))
    inside = bounds[0] < ONE_HALF < bounds[1]
    values = (*bounds, ONE_HALF) if inside else bounds
    known = sorted(product(values, repeat=2), key=lambda pair: ONE_HALF in pair)
    pairs[: len(known)] = known[:pop_size]
    return pairs


def _run(
    algorithm: Any, objective: ObjectiveFunction, ref: Sequence[float] | None
) -> Iterator[Generation]:
    number = 0
    while algorithm.has_next():
        offspring = algorithm.ask()
        if offspring is None or not len(offspring):
            return  # No new pair is left to try: the box holds only a few floats.
        pairs = offspring.get("X").astype(np.float64)
        scores = objective(pairs)
        offspring.set("F", _minimised(scores), "scores", scores)
        algorithm.tell(infills=offspring)
        number += 1
        population = algorithm.pop.get("X").astype(np.float64)
        kept = algorithm.pop.get("scores").astype(np.float64)
        volume = np.nan if ref is None else hypervolume(kept[:, 0], kept[:, 1], ref)
        yield Generation(number, population, kept, volume)


def _minimised(scores: FloatArray) -> FloatArray:
    # 1/precision and 1/recall, as in the source; 0 and undefined are penalised.
    positive = scores > 0.0
    return np.where(positive, 1.0 / np.where(positive, scores, 1.0), PENALTY)

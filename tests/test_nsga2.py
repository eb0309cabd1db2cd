import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import Grid, ParameterError, UpdateRule, collect_evidence, load_sample
from occsim.priors import (
    Elitism,
    Objective,
    exact_front,
    exact_objective,
    geometric_shares,
    interpolate,
    interpolated_objective,
    non_dominated,
    nsga2_front,
    nsga2_generations,
    prior_surface,
    reference_point,
    sweep_priors,
)
from occsim.world import truth_cells
from tests.test_metrics import log_of

TENTHS = np.arange(1, 11) / 10


@pytest.fixture(scope="module")
def case():
    """Section e at 10 px; its dark pixels serve as the wall mask."""
    sample = load_sample("e")
    grid = sample.world.grid(10)
    evidence = collect_evidence(sample.world, sample.trajectory, sample.sensor, grid)
    is_wall = grid.share(sample.drawing.gray < 128) > 0
    return evidence, is_wall, truth_cells(sample.world, grid)


@pytest.mark.parametrize("elitism", Elitism)
@pytest.mark.parametrize("rule", UpdateRule)
def test_the_search_nears_the_exact_front_and_never_passes_it(case, rule, elitism):
    exact = exact_front(*case, rule=rule)
    found = nsga2_front(exact_objective(*case, rule), seed=1, elitism=elitism)
    ref = reference_point(exact)
    share = found.hypervolume(ref) / exact.hypervolume(ref)
    assert 0.995 <= share <= 1.0 + 1e-12
    precision = np.append(exact.precision, found.precision)
    recall = np.append(exact.recall, found.recall)
    assert non_dominated(precision, recall)[: len(exact)].all()


def test_the_search_starts_with_the_priors_that_tie(case):
    """Corners of the box, and pairs with a prior of one half: 0.5 / 0.9."""
    objective = exact_objective(*case)
    first = next(iter(nsga2_generations(objective, pop_size=20, n_gen=1, seed=3)))
    pairs = {tuple(pair) for pair in first.population.tolist()}
    half = 0.5 / 0.9
    assert {(0.1, 0.1), (0.1, 1.0), (1.0, 0.1), (1.0, 1.0)} <= pairs
    assert {(half, half), (half, 1.0), (0.1, half)} <= pairs


def test_the_search_finds_a_point_that_only_a_prior_of_one_half_attains():
    """The map of `test_a_front_point_may_be_attained_only_at_a_tie` (test_pareto)."""
    grid = Grid(height_px=1, width_px=3, cell_px=1)
    evidence = log_of(grid, [{0: 0.1, 2: 0.1}, {2: 0.9}])
    none, truth = np.zeros((1, 3), dtype=bool), np.array([[True, False, False]])
    surface = prior_surface(evidence, none, truth, "subtract_prior", "all")
    found = nsga2_front(surface, pop_size=12, n_gen=2, seed=0)
    assert (found.precision, found.recall) == (1.0, 1.0)
    assert found.p_space == 5 / 9


def test_equal_seeds_give_equal_runs(case):
    objective = interpolated_objective(sweep_priors(*case, TENTHS, TENTHS))
    options = {"pop_size": 12, "n_gen": 6, "elitism": Elitism.CONTROLLED}
    one, two = (nsga2_front(objective, seed=7, **options) for _ in range(2))
    np.testing.assert_array_equal(one.p_wall, two.p_wall)
    np.testing.assert_array_equal(one.p_space, two.p_space)
    other = nsga2_front(objective, seed=8, **options)
    assert not np.array_equal(one.p_wall, other.p_wall)


def test_generations_can_be_watched_and_left(case):
    objective = exact_objective(*case)
    ref = reference_point(exact_front(*case))
    seen = []
    generations = nsga2_generations(objective, pop_size=20, n_gen=50, seed=3, ref=ref)
    for generation in generations:
        assert generation.population.shape == (20, 2)
        np.testing.assert_array_equal(
            generation.objectives, objective(generation.population)
        )
        front = generation.front()
        assert front.hypervolume(ref) == pytest.approx(generation.hypervolume)
        seen.append(generation.number)
        if generation.number == 4:
            break
    assert seen == [1, 2, 3, 4]


def test_progress_counts_generations(case):
    calls = []
    nsga2_front(
        exact_objective(*case),
        pop_size=8,
        n_gen=3,
        seed=1,
        on_progress=lambda done, total: calls.append((done, total)),
    )
    assert calls == [(1, 3), (2, 3), (3, 3)]


def test_the_interpolated_objective_is_the_interpolated_sweep(case):
    sweep = sweep_priors(*case, TENTHS, TENTHS)
    pairs = np.array([[0.1, 1.0], [0.33, 0.77]])
    scores = interpolated_objective(sweep)(pairs)
    for column, objective in enumerate(Objective):
        expected = interpolate(sweep, *pairs.T, objective)
        np.testing.assert_array_equal(scores[:, column], expected)


@pytest.mark.parametrize("elitism", Elitism)
def test_undefined_objectives_do_not_stop_the_search(elitism):
    # Nothing is seen: precision and recall are NaN for every pair.
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    wall = np.array([[True, False]])
    objective = exact_objective(log_of(grid, [{}]), wall, wall)
    found = nsga2_front(objective, pop_size=8, n_gen=4, seed=1, elitism=elitism)
    assert len(found) == 0


def test_shares_by_hand():
    """100 survivors of two fronts, r = 1/2: N_1 = 100 (1/2) / (3/4) = 66.7 -> 67.

    A first front of 20 passes 46.7 on: the second may keep 33.3 + 46.7 = 80.
    """
    assert geometric_shares([150, 50], 100, 0.5) == [67, 33]
    assert geometric_shares([20, 180], 100, 0.5) == [20, 80]
    # One front keeps all; what no later front can use goes back to the first.
    assert geometric_shares([200], 100, 0.5) == [100]
    assert geometric_shares([195, 5], 100, 0.5) == [95, 5]


@given(
    sizes=st.lists(st.integers(1, 60), min_size=1, max_size=12),
    ratio=st.floats(0.05, 0.95),
    share=st.floats(0.0, 1.0),
)
def test_shares_fit_the_fronts_and_fill_the_population(sizes, ratio, share):
    n_survive = 1 + int(share * (sum(sizes) - 1))
    kept = geometric_shares(sizes, n_survive, ratio)
    assert sum(kept) == n_survive
    assert all(0 <= n <= size for n, size in zip(kept, sizes, strict=True))


def test_the_best_front_is_held_to_its_share():
    """A front of 60 and 19 more of 20, Pareto fraction 0.35, 100 survivors.

    r = 0.65 and K = 20: N_1 = 35 / (1 - 0.65^20) = 35.006, N_2 = 22.75 of 20.
    """
    shares = geometric_shares([60] + [20] * 19, 100, 0.65)
    assert shares[:2] == [35, 20]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pop_size": 3}, "pop_size must be a whole number, 4 to 10,000; got 3"),
        ({"n_gen": 0}, "n_gen must be a whole number, 1 to 10,000; got 0"),
        ({"pop_size": 10.5}, "pop_size must be a whole number"),
        ({"seed": -1}, "seed must be a whole number, 0 to 4,294,967,295; got -1"),
        ({"seed": None}, "seed must be a whole number, 0 to 4,294,967,295; got None"),
        ({"elitism": "none"}, "elitism must be one of Elitism.FULL"),
        ({"low": 0.5, "high": 0.5}, "low and high must satisfy"),
        ({"pareto_fraction": 1.0}, "pareto_fraction must lie in"),
    ],
)
def test_bad_settings_are_refused_at_once(change, message):
    with pytest.raises(ParameterError, match=message):
        nsga2_generations(lambda pairs: pairs, **{"seed": 1, **change})


def test_objectives_of_other_forms_are_the_same_objective(case):
    """Columns, pair by pair, the sweep or surface itself: one and the same front."""
    sweep, surface = sweep_priors(*case, TENTHS, TENTHS), prior_surface(*case)
    exact, table = exact_objective(*case), interpolated_objective(sweep)
    forms = [
        (exact, surface),
        (exact, lambda pairs: tuple(exact(pairs).T)),
        (exact, lambda p_wall, p_space: exact(np.array([[p_wall, p_space]]))[0]),
        (table, sweep),
        (table, lambda pairs, reverse=False: table(pairs).tolist()),
    ]
    for usual, other in forms:
        one, two = (
            nsga2_front(form, pop_size=8, n_gen=3, seed=2) for form in (usual, other)
        )
        np.testing.assert_array_equal(one.p_wall, two.p_wall)
        np.testing.assert_array_equal(one.precision, two.precision)
        np.testing.assert_array_equal(one.recall, two.recall)


@pytest.mark.parametrize(
    ("objective", "message"),
    [
        (lambda pairs: pairs[:, :1], r"shape \(8, 2\); got shape \(8, 1\)"),
        (lambda pairs: (pairs[:, 0], 0.5 * pairs), "could not be read as numbers"),
        (lambda pairs: 1.0 / pairs, r"\[0, 1\] or NaN .* 1/precision .* got \d"),
        (lambda p_wall, p_space: p_wall, r"\(8, 2\); got shape \(8,\)"),
    ],
)
def test_an_objective_that_returns_something_else_is_refused(objective, message):
    with pytest.raises(ParameterError, match=message):
        nsga2_front(objective, pop_size=8, n_gen=2, seed=1)


def test_an_objective_of_another_type_is_refused_at_once():
    with pytest.raises(TypeError, match="objective must be a function of prior pairs"):
        nsga2_generations(0.5, seed=1)


def test_importing_the_library_does_not_import_pymoo():
    check = "import sys, occsim, occsim.priors; sys.exit('pymoo' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", check], check=False).returncode == 0

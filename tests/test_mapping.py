import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import (
    EvidenceLog,
    EvidenceTotals,
    Grid,
    ParameterError,
    Prior,
    Sensor,
    Trajectory,
    UpdateRule,
    World,
    build_prior,
    collect_evidence,
    fuse,
    logit,
)
from occsim.prior import PriorMap

GRID = Grid(height_px=3, width_px=4, cell_px=1)


def random_log(seed, n_readings=7):
    """An evidence log of random cells and values: fusion asks nothing of the world."""
    rng = np.random.default_rng(seed)
    sizes = rng.integers(0, GRID.n_cells + 1, n_readings)
    cells = [np.sort(rng.choice(GRID.n_cells, n, replace=False)) for n in sizes]
    return EvidenceLog(
        grid=GRID,
        indptr=np.concatenate([[0], np.cumsum(sizes)]),
        cell=np.concatenate(cells).astype(np.int32),
        log_odds=rng.uniform(-2.2, 2.2, sizes.sum()),
    )


def random_prior(seed):
    p_free = np.random.default_rng(seed).uniform(0.05, 0.95, GRID.shape)
    return PriorMap(grid=GRID, is_wall=p_free < 0.5, p_free=p_free)


def recursion(evidence, prior_map, rule, n_readings):
    """Log-odds and counts, reading by reading (Thrun, Burgard and Fox, Table 9.1)."""
    l_0 = logit(prior_map.p_free).ravel()
    log_odds, counts = l_0.copy(), np.zeros(l_0.size, dtype=int)
    for reading in range(n_readings):
        for entry in range(*evidence.indptr[reading : reading + 2]):
            cell = evidence.cell[entry]
            log_odds[cell] += evidence.log_odds[entry]
            if rule is UpdateRule.SUBTRACT_PRIOR:
                log_odds[cell] -= l_0[cell]
            counts[cell] += 1
    return log_odds.reshape(GRID.shape), counts.reshape(GRID.shape)


SEEDS = st.integers(0, 2**32 - 1)


@given(seed=SEEDS, rule=st.sampled_from(UpdateRule))
def test_closed_form_is_the_recursion_at_every_step_to_the_last_bit(seed, rule):
    evidence, prior_map = random_log(seed), random_prior(seed)
    for n_readings in range(evidence.n_readings + 1):
        result = fuse(evidence, prior_map, rule, n_readings)
        log_odds, counts = recursion(evidence, prior_map, rule, n_readings)
        np.testing.assert_array_equal(result.log_odds, log_odds)
        np.testing.assert_array_equal(result.n_updates, counts)


@given(SEEDS)
def test_with_a_prior_of_one_half_both_rules_agree(seed):
    evidence = random_log(seed)
    prior_map = build_prior(np.zeros((3, 4), bool), GRID, Prior.uninformative())
    once, subtract = (fuse(evidence, prior_map, rule) for rule in UpdateRule)
    np.testing.assert_array_equal(subtract.log_odds, once.log_odds)


@given(seed=SEEDS, rule=st.sampled_from(UpdateRule))
def test_totals_serve_as_a_log_does(seed, rule):
    evidence, prior_map = random_log(seed), random_prior(seed)
    totals = EvidenceTotals(GRID, *evidence.totals())
    of_log, of_totals = (fuse(e, prior_map, rule) for e in (evidence, totals))
    np.testing.assert_array_equal(of_totals.log_odds, of_log.log_odds)
    np.testing.assert_array_equal(of_totals.n_updates, of_log.n_updates)
    with pytest.raises(ParameterError, match="totals are those of all readings; got"):
        fuse(totals, prior_map, rule, n_readings=2)


@given(SEEDS)
def test_sums_are_exact_in_any_order(seed):
    """The sum of a cell, forwards, backwards and in whole numbers of 2^-36."""
    rng = np.random.default_rng(seed)
    values = logit(rng.uniform(0.1, 0.9, 1000))
    exact = sum(int(value * 2**36) for value in values) / 2**36
    assert np.cumsum(values)[-1] == np.cumsum(values[::-1])[-1] == exact


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"indptr": [0, 1]}, "indptr must run from 0 to the number of entries"),
        ({"indptr": [1, 2, 3]}, "indptr must run from 0"),
        ({"indptr": [0, 2, 1, 3]}, "indptr must not fall"),
        ({"indptr": []}, "indptr must run from 0"),
        ({"log_odds": [0.1, 0.2]}, "cell and log_odds have one value each"),
        ({"cell": [0, 1, 12]}, "cell must lie in 0 to 11; got 0 to 12"),
        ({"cell": [-1, 1, 2]}, "cell must lie in 0 to 11; got -1 to 2"),
        ({"cell": [0, 2**40, 2]}, "cell must lie in -2147483648 to 2147483647"),
        ({"cell": [5, 5, 2]}, "a reading must name each cell at most once"),
        ({"log_odds": [0.1, np.nan, 0.2]}, "log_odds must be finite and below 131,072"),
        ({"log_odds": [0.1, np.inf, 0.2]}, "log_odds must be finite"),
        ({"log_odds": [0.1, 1e6, 0.2]}, "log_odds must be finite and below"),
    ],
)
def test_a_log_that_is_not_sound_is_refused(change, message):
    whole = {"indptr": [0, 2, 3], "cell": [0, 1, 0], "log_odds": [0.1, 0.2, 0.3]}
    assert EvidenceLog(grid=GRID, **whole).n_readings == 2
    with pytest.raises(ParameterError, match=message):
        EvidenceLog(grid=GRID, **(whole | change))


def test_a_log_of_cells_in_any_order_is_sound():
    log = EvidenceLog(GRID, [0, 2, 4], [7, 1, 1, 7], [0.0, 1.0, 2.0, 3.0])
    np.testing.assert_array_equal(log.totals()[0].ravel()[[1, 7]], [3.0, 3.0])


@pytest.mark.parametrize(
    ("name", "value"), [("cell", [0.0, 1.0, 0.0]), ("log_odds", ["a", "b", "c"])]
)
def test_a_log_of_other_types_is_refused(name, value):
    whole = {"indptr": [0, 2, 3], "cell": [0, 1, 0], "log_odds": [0.1, 0.2, 0.3]}
    with pytest.raises(TypeError, match=f"{name} must hold"):
        EvidenceLog(grid=GRID, **(whole | {name: value}))


def test_a_log_leaves_its_callers_arrays_alone():
    cell, log_odds = np.array([0], dtype=np.int32), np.array([0.1])
    log = EvidenceLog(GRID, [0, 1], cell, log_odds)
    cell[0], log_odds[0] = 3, 9.0
    assert (log.cell[0], round(log.log_odds[0], 9)) == (0, 0.1)


@pytest.mark.parametrize(
    ("sums", "counts", "message"),
    [
        (np.full((3, 4), np.nan), np.zeros((3, 4), int), "sums must be finite"),
        (np.zeros((3, 4)), np.full((3, 4), -1), "counts must not be negative; got -1"),
        (np.zeros((4, 3)), np.zeros((3, 4), int), r"the grid's shape \(3, 4\)"),
    ],
)
def test_totals_that_are_not_sound_are_refused(sums, counts, message):
    with pytest.raises(ParameterError, match=message):
        EvidenceTotals(GRID, sums, counts)


@given(SEEDS)
def test_prior_is_kept_where_nothing_was_seen(seed):
    evidence, prior_map = random_log(seed), random_prior(seed)
    for rule in UpdateRule:
        result = fuse(evidence, prior_map, rule, 2)
        unseen = result.n_updates == 0
        np.testing.assert_array_equal(
            result.log_odds[unseen], logit(prior_map.p_free[unseen])
        )


def test_each_further_reading_pushes_away_from_a_subtracted_prior():
    # One cell, three readings of 0.5 (log-odds 0), prior 0.9: l = (1 - k) ln 9.
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence = EvidenceLog(
        grid=grid,
        indptr=np.arange(4),
        cell=np.zeros(3, dtype=np.int32),
        log_odds=np.zeros(3),
    )
    prior_map = build_prior(np.zeros((1, 1), bool), grid, Prior(p_space=1.0))
    subtract = UpdateRule.SUBTRACT_PRIOR
    steps = [fuse(evidence, prior_map, subtract, k).log_odds.item() for k in range(4)]
    np.testing.assert_allclose(steps, np.log(9) * np.array([1, 0, -1, -2]), atol=1e-10)
    once = fuse(evidence, prior_map)  # the default: the drawing is counted once
    np.testing.assert_allclose(once.p_free, [[0.9]])


def test_a_subtracted_prior_goes_on_pushing_after_many_readings():
    """One cell, 200 readings of 0.5, prior 0.9: l = (1 - 200) ln 9."""
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    cells = np.zeros(200, dtype=np.int32)
    evidence = EvidenceLog(grid, np.arange(201), cells, np.zeros(200))
    prior_map = build_prior(np.zeros((1, 1), bool), grid, Prior(p_space=1.0))
    result = fuse(evidence, prior_map, UpdateRule.SUBTRACT_PRIOR)
    np.testing.assert_allclose(result.log_odds, [[-199 * np.log(9)]], rtol=1e-10)


def test_fusing_changes_neither_log_nor_prior():
    evidence, prior_map = random_log(3), random_prior(3)
    before = [evidence.cell.copy(), evidence.log_odds.copy(), prior_map.p_free.copy()]
    first = fuse(evidence, prior_map)
    second = fuse(evidence, prior_map)
    after = [evidence.cell, evidence.log_odds, prior_map.p_free]
    for old, new in zip(before, after, strict=True):
        np.testing.assert_array_equal(old, new)
    np.testing.assert_array_equal(first.log_odds, second.log_odds)


def test_a_collected_log_cannot_be_written_to():
    world = World(occupied=np.zeros((3, 3), dtype=bool))
    trajectory = Trajectory(poses=[[1.5, 1.5, 0.0]])
    log = collect_evidence(world, trajectory, Sensor(), world.grid(1))
    for array in (log.indptr, log.cell, log.log_odds):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_totals_cannot_be_written_to():
    sums, counts = random_log(1).totals()
    for array in (sums, counts):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1


def test_a_prior_on_another_grid_is_refused():
    other = Grid(height_px=3, width_px=4, cell_px=2)
    prior_map = build_prior(np.zeros((3, 4), bool), other, Prior())
    with pytest.raises(ParameterError, match="same grid"):
        fuse(random_log(0), prior_map)


@pytest.mark.parametrize("n_readings", [-1, 8, 1.5, "2"])
def test_only_readings_that_were_taken_can_be_fused(n_readings):
    with pytest.raises(ParameterError, match="n_readings must be a whole number, 0"):
        fuse(random_log(0), random_prior(0), n_readings=n_readings)

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import (
    EvidenceLog,
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
def test_closed_form_is_the_recursion_at_every_step(seed, rule):
    evidence, prior_map = random_log(seed), random_prior(seed)
    for n_readings in range(evidence.n_readings + 1):
        result = fuse(evidence, prior_map, rule, n_readings)
        log_odds, counts = recursion(evidence, prior_map, rule, n_readings)
        np.testing.assert_allclose(result.log_odds, log_odds, atol=1e-12)
        np.testing.assert_array_equal(result.n_updates, counts)


@given(SEEDS)
def test_with_a_prior_of_one_half_both_rules_agree(seed):
    evidence = random_log(seed)
    prior_map = build_prior(np.zeros((3, 4), bool), GRID, Prior.uninformative())
    subtract, once = (fuse(evidence, prior_map, rule) for rule in UpdateRule)
    np.testing.assert_array_equal(subtract.log_odds, once.log_odds)


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
    steps = [fuse(evidence, prior_map, n_readings=k).log_odds.item() for k in range(4)]
    np.testing.assert_allclose(steps, np.log(9) * np.array([1, 0, -1, -2]), atol=1e-12)
    once = fuse(evidence, prior_map, UpdateRule.PRIOR_ONCE)
    np.testing.assert_allclose(once.p_free, [[0.9]])


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

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import (
    Grid,
    ParameterError,
    Prior,
    PriorMap,
    World,
    build_prior,
    logit,
    p_free_from_log_odds,
    truth_cells,
)
from occsim.logodds import is_occupied

GRID = Grid(height_px=2, width_px=4, cell_px=2)
LEFT_CORNER = np.array([[True, False, False, False], [False] * 4])


def test_wall_and_space_get_nine_tenths_of_their_values():
    # 0.9 * 0.2 = 0.18 on the cell with a wall pixel, 0.9 * 0.9 = 0.81 on the other.
    prior = build_prior(LEFT_CORNER, GRID, Prior(p_wall=0.2, p_space=0.9))
    np.testing.assert_array_equal(prior.is_wall, [[True, False]])
    np.testing.assert_allclose(prior.p_free, [[0.18, 0.81]])


def test_uninformative_prior_is_one_half_exactly():
    prior = build_prior(LEFT_CORNER, GRID, Prior.uninformative())
    assert (prior.p_free == 0.5).all()
    assert (prior.log_odds == 0.0).all()


def test_the_share_threshold_must_be_exceeded():
    # One of four pixels is wall: a share of 0.25 exceeds 0.24 but not 0.25.
    below = build_prior(LEFT_CORNER, GRID, Prior(), wall_share=0.24)
    at = build_prior(LEFT_CORNER, GRID, Prior(), wall_share=0.25)
    assert below.is_wall[0, 0]
    assert not at.is_wall[0, 0]


def test_ground_truth_uses_the_same_rule():
    world = World(occupied=LEFT_CORNER)
    np.testing.assert_array_equal(truth_cells(world, GRID), [[True, False]])
    assert not truth_cells(world, GRID, wall_share=0.3).any()


@given(
    seed=st.integers(0, 2**32 - 1),
    p_wall=st.floats(0.01, 1.0),
    p_space=st.floats(0.01, 1.0),
)
def test_more_ink_never_raises_the_prior(seed, p_wall, p_space):
    p_wall, p_space = sorted((p_wall, p_space))
    rng = np.random.default_rng(seed)
    mask = rng.random((9, 11)) < 0.2
    more = mask | (rng.random(mask.shape) < 0.2)
    grid = Grid(height_px=9, width_px=11, cell_px=2)
    prior = Prior(p_wall=p_wall, p_space=p_space)
    before = build_prior(mask, grid, prior).p_free
    after = build_prior(more, grid, prior).p_free
    assert (after <= before).all()


@pytest.mark.parametrize("value", [0.0, -0.1, 1.4, float("nan")])
@pytest.mark.parametrize("name", ["p_wall", "p_space", "scale"])
def test_prior_values_lie_above_zero_and_up_to_one(name, value):
    with pytest.raises(ParameterError, match=rf"{name} must lie in \(0, 1\]; got"):
        Prior(**{name: value})


def test_a_number_beyond_all_floats_is_refused():
    with pytest.raises(ParameterError, match="p_wall must be a number below 1e308"):
        Prior(p_wall=10**400)


@pytest.mark.parametrize("p_free", [[[0.0, 0.5]], [[0.5, np.nan]], [[0.5, 0.5, 0.5]]])
def test_a_prior_map_of_no_probabilities_is_refused(p_free):
    with pytest.raises(
        ParameterError, match=r"p_free must have shape \(1, 2\) and lie"
    ):
        PriorMap(grid=GRID, is_wall=np.array([[True, False]]), p_free=np.array(p_free))


def test_without_the_scale_a_value_of_one_is_refused():
    with pytest.raises(ParameterError, match="log-odds"):
        Prior(p_wall=0.2, p_space=1.0, scale=1.0)


@given(st.floats(1e-9, 1 - 1e-9))
def test_logit_and_its_inverse_undo_each_other(p_free):
    # Half a step of the lattice, 2^-37 = 7.3e-12 nats, moves p by at most as much.
    np.testing.assert_allclose(
        p_free_from_log_odds(logit(p_free)), p_free, rtol=8e-12, atol=0
    )


@given(st.floats(1e-300, 1 - 1e-9))
def test_log_odds_lie_on_the_lattice(p_free):
    """Multiples of 2^-36 nats, the nearest to the logarithm."""
    steps = float(logit(p_free)) * 2**36
    assert steps == round(steps)
    exact = math.log(p_free) - math.log1p(-p_free)
    assert abs(steps / 2**36 - exact) <= 2**-37 + 1e-12


def test_extreme_log_odds_do_not_overflow():
    np.testing.assert_array_equal(
        p_free_from_log_odds([-np.inf, -1e4, 0.0, 1e4, np.inf]), [0, 0, 0.5, 1, 1]
    )
    np.testing.assert_array_equal(logit([0.0, 1.0]), [-np.inf, np.inf])


def test_a_tie_is_not_occupied():
    # A prior of 0.9 and one reading of 0.1 cancel, on the lattice exactly.
    rest = float(logit(0.9) + logit(0.1))
    assert rest == 0.0
    np.testing.assert_array_equal(
        is_occupied([rest, 0.0, -1e-10, -1e-8, 1e-8]),
        [False, False, False, True, False],
    )

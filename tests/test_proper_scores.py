"""Log loss, Brier score, reliability: by hand, and against a loop over cells."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    ParameterError,
    Region,
    brier,
    calibrated_prior,
    estimated_prior,
    log_loss,
    logit,
    reliability,
)
from tests.test_metrics import map_of

P_FREE = st.sampled_from([0.001, 0.1, 0.25, 0.5, 0.75, 0.9, 0.999])


@st.composite
def judged_maps(draw):
    """A map of one row, and its truth."""
    n = draw(st.integers(1, 9))
    lists = (
        st.lists(one, min_size=n, max_size=n) for one in (P_FREE, st.integers(0, 2))
    )
    p_free, n_updates = (draw(one) for one in lists)
    truth = draw(st.lists(st.booleans(), min_size=n, max_size=n))
    return map_of(logit([p_free]), [n_updates]), np.array([truth])


def naive_cells(occupancy_map, truth, region):
    """p_free and truth of each scored cell."""
    for at in np.ndindex(truth.shape):
        is_explored = occupancy_map.n_updates[at] > 0
        if region is Region.ALL or is_explored == (region is Region.EXPLORED):
            yield float(occupancy_map.p_free[at]), bool(truth[at])


def test_scores_of_four_cells_by_hand():
    """p_free 0.5, 0.25, 0.9, 0.9; the first three are wall; the last two explored.

    Bits: -log2 of 0.5, 0.75, 0.1, 0.9 = 1, 0.415, 3.322, 0.152. Squared errors:
    0.25, 0.0625, 0.81, 0.01.
    """
    seen = map_of(logit([[0.5, 0.25, 0.9, 0.9]]), [[0, 0, 1, 3]])
    truth = np.array([[True, True, True, False]])
    bits = [1.0, 0.4150375, 3.3219281, 0.1520031]
    assert log_loss(seen, truth) == pytest.approx(sum(bits) / 4, abs=1e-7)
    assert log_loss(seen, truth, Region.EXPLORED) == pytest.approx(sum(bits[2:]) / 2)
    assert log_loss(seen, truth, "unexplored") == pytest.approx(sum(bits[:2]) / 2)
    assert brier(seen, truth) == pytest.approx(1.1325 / 4)
    assert brier(seen, truth, Region.EXPLORED) == pytest.approx(0.82 / 2)
    assert brier(seen, truth, Region.UNEXPLORED) == pytest.approx(0.3125 / 2)


@settings(deadline=None)
@given(case=judged_maps(), region=st.sampled_from(Region))
def test_scores_are_those_of_a_loop_over_the_cells(case, region):
    cells = list(naive_cells(*case, region))
    if not cells:
        assert math.isnan(log_loss(*case, region))
        assert math.isnan(brier(*case, region))
        return
    bits = [-math.log2(1 - p if wall else p) for p, wall in cells]
    squares = [(p - (0 if wall else 1)) ** 2 for p, wall in cells]
    assert log_loss(*case, region) == pytest.approx(np.mean(bits), rel=1e-9)
    assert brier(*case, region) == pytest.approx(np.mean(squares), rel=1e-9)


def test_a_blank_map_costs_one_bit_and_certainty_nothing_or_all_of_its_log_odds():
    truth = np.array([[True, False]])
    assert log_loss(map_of([[0.0, 0.0]], [[0, 1]]), truth) == 1.0
    assert brier(map_of([[0.0, 0.0]], [[0, 1]]), truth) == 0.25
    right = map_of([[-5000.0, np.inf]], [[1, 1]])
    assert log_loss(right, truth) == brier(right, truth) == 0.0
    wrong = map_of([[5000.0, -5000.0]], [[1, 1]])
    assert log_loss(wrong, truth) == pytest.approx(5000 / math.log(2))
    assert brier(wrong, truth) == 1.0


def test_a_reliability_diagram_by_hand():
    """Bins of 0.25. p_free 0.1, 0.1, 0.1, 0.1 | none | 0.5, 0.6 | 0.75, 1.

    Free in truth: 1 of 4; 2 of 2; 1 of 2. Gaps 0.15, 0.45, 0.375.
    """
    p_free = [[0.1, 0.1, 0.1, 0.1, 0.5, 0.6, 0.75, 1.0]]
    seen = map_of(logit(p_free), [[1] * 8])
    truth = ~np.array([[True, False, False, False, True, True, False, True]])
    diagram = reliability(seen, truth, n_bins=4)
    np.testing.assert_array_equal(diagram.edges, [0, 0.25, 0.5, 0.75, 1])
    np.testing.assert_array_equal(diagram.count, [4, 0, 2, 2])
    np.testing.assert_allclose(diagram.mean_p_free, [0.1, np.nan, 0.55, 0.875])
    np.testing.assert_allclose(diagram.share_free, [0.25, np.nan, 1.0, 0.5])
    assert diagram.expected_calibration_error == pytest.approx(
        (4 * 0.15 + 2 * 0.45 + 2 * 0.375) / 8
    )


@settings(deadline=None)
@given(case=judged_maps(), region=st.sampled_from(Region), n_bins=st.integers(1, 12))
def test_every_scored_cell_is_in_one_bin(case, region, n_bins):
    diagram = reliability(*case, region, n_bins)
    cells = list(naive_cells(*case, region))
    assert diagram.count.sum() == len(cells)
    used = diagram.count > 0
    free = (diagram.share_free * diagram.count)[used].sum()
    assert free == pytest.approx(sum(not wall for _, wall in cells))
    mean, edges = diagram.mean_p_free[used], diagram.edges
    assert (mean >= edges[:-1][used] - 1e-12).all()
    assert (mean <= edges[1:][used] + 1e-12).all()
    assert math.isnan(diagram.expected_calibration_error) == (not cells)


def test_a_map_that_states_true_shares_has_no_calibration_error():
    """Eight cells at 0.25 of which two are free, and two at 0.5, one free."""
    seen = map_of(logit([[0.25] * 8 + [0.5] * 2]), [[1] * 10])
    truth = np.array([[False] * 2 + [True] * 6 + [False, True]])
    error = reliability(seen, truth).expected_calibration_error
    assert error == pytest.approx(0.0, abs=1e-11)


def test_bins_are_a_whole_number_of_them():
    seen, truth = map_of([[0.0]], [[1]]), np.array([[True]])
    for wrong in (0, 1001, 2.5, "10"):
        with pytest.raises(ParameterError, match="n_bins must be a whole number"):
            reliability(seen, truth, n_bins=wrong)


def test_a_calibrated_prior_states_how_often_the_drawing_is_right():
    """Of 6 wall cells 1 is free: 2/8. Of 4 others 3 are free: 4/6."""
    is_wall = np.array([[True] * 6 + [False] * 4])
    truth = np.array([[False] + [True] * 5 + [True] + [False] * 3])
    assert calibrated_prior(is_wall, truth) == (2 / 8, 4 / 6)


def test_a_class_without_cells_is_calibrated_to_one_half():
    full, truth = np.ones((2, 2), dtype=bool), np.eye(2, dtype=bool)
    assert calibrated_prior(full, truth) == (3 / 6, 1 / 2)
    assert calibrated_prior(~full, truth) == (1 / 2, 3 / 6)


def test_an_estimated_prior_pools_the_cells_of_other_drawings():
    one = np.array([[True, True, False]]), np.array([[True, False, False]])
    two = np.array([[True]]), np.array([[True]])
    assert estimated_prior([one]) == calibrated_prior(*one)
    assert estimated_prior([one, two]) == (2 / 5, 2 / 3)
    assert estimated_prior(iter([two, one])) == (2 / 5, 2 / 3)
    assert estimated_prior([]) == (0.5, 0.5)


def test_drawings_to_estimate_from_are_pairs_of_cells_of_one_shape():
    cells = np.array([[True]])
    with pytest.raises(ParameterError, match="truth must be bool of shape"):
        estimated_prior([(cells, np.array([[True, False]]))])
    with pytest.raises(TypeError, match="others must hold pairs"):
        estimated_prior([cells])
    with pytest.raises(TypeError, match="is_wall must be an array of bool"):
        estimated_prior([([[1]], cells)])

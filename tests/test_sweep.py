import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import EvidenceLog, Grid, ParameterError, Prior, UpdateRule, fuse
from occsim.logodds import LATTICE_NATS
from occsim.metrics import Region, Scores, score
from occsim.prior import prior_from_cells
from occsim.priors import (
    Objective,
    PriorSweep,
    interpolate,
    maxima,
    prior_surface,
    sweep_priors,
    ties_text,
)
from tests.test_metrics import log_of, logged_cases

TENTHS = np.arange(1, 11) / 10
RULES = st.sampled_from(UpdateRule)
REGIONS = st.sampled_from(Region)
# Priors that tie with the readings below: 0.9 * 1 = 0.9, 0.9 * (1/9) = 0.1,
# 0.9 * (1/3) = 0.3, 0.9 * (7/9) = 0.7, 0.9 * (5/9) = 0.5.
TYING = [1 / 9, 1 / 3, 5 / 9, 7 / 9, 1.0]


def sweep_of(tp, fp, fn=None):
    """A sweep over (0.1, 0.2, ...) with given counts."""
    tp, fp = np.array(tp), np.array(fp)
    fn = np.zeros_like(tp) if fn is None else np.array(fn)
    axes = [TENTHS[:n] for n in tp.shape]
    return PriorSweep(*axes, tp=tp, fp=fp, fn=fn, tn=np.zeros_like(tp))


def fused_score(evidence, is_wall, truth, p_wall, p_space, rule, region):
    prior = Prior(p_wall=float(p_wall), p_space=float(p_space))
    prior_map = prior_from_cells(is_wall, evidence.grid, prior)
    return score(fuse(evidence, prior_map, rule), truth, region)


def test_a_cell_read_twice_is_wall_only_above_a_level():
    """One space cell, readings 0.3 twice: S = 2 ln(3/7) = -1.695, k = 2.

    SUBTRACT_PRIOR: l = S - l_0 is wall where l_0 > -1.695, p_free > 0.155,
    p_space > 0.173. PRIOR_ONCE: l = S + l_0 is wall where l_0 < 1.695,
    p_free < 0.845, p_space < 0.939.
    """
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence = log_of(grid, [{0: 0.3}, {0: 0.3}])
    no, yes = np.array([[False]]), np.array([[True]])
    axes = ([0.5], [0.1, 0.17, 0.18, 0.93, 0.94, 1.0])
    subtract = sweep_priors(evidence, no, yes, *axes, UpdateRule.SUBTRACT_PRIOR)
    np.testing.assert_array_equal(subtract.tp, [[0, 0, 1, 1, 1, 1]])
    once = sweep_priors(evidence, no, yes, *axes, rule=UpdateRule.PRIOR_ONCE)
    np.testing.assert_array_equal(once.tp, [[1, 1, 1, 1, 0, 0]])
    np.testing.assert_array_equal(once.recall, [[1, 1, 1, 1, 0, 0]])
    np.testing.assert_array_equal(once.precision, [[1, 1, 1, 1, np.nan, np.nan]])


def test_a_tie_is_free_but_both_sides_of_it_differ():
    # Prior 0.9 * 1 and a reading of 0.1 cancel; slightly less, and the cell is wall.
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence = log_of(grid, [{0: 0.1}])
    wall = np.array([[True]])
    sweep = sweep_priors(
        evidence, wall, wall, [0.999999, 1.0], [0.5], rule=UpdateRule.PRIOR_ONCE
    )
    np.testing.assert_array_equal(sweep.tp, [[1], [0]])


@settings(max_examples=120, deadline=None)
@given(
    case=logged_cases(p_free=(0.1, 0.3, 0.5, 0.7, 0.9)),
    p_wall=st.lists(st.sampled_from(TYING) | st.floats(0.01, 1.0), max_size=4),
    p_space=st.lists(st.sampled_from(TYING) | st.floats(0.01, 1.0), max_size=4),
    rule=RULES,
    region=REGIONS,
)
def test_sweep_equals_fusing_and_scoring_every_pair(
    case, p_wall, p_space, rule, region
):
    sweep = sweep_priors(*case, p_wall, p_space, rule=rule, region=region)
    assert sweep.precision.shape == sweep.recall.shape == (len(p_wall), len(p_space))
    for i, wall in enumerate(p_wall):
        for j, space in enumerate(p_space):
            counts = (int(x[i, j]) for x in (sweep.tp, sweep.fp, sweep.fn, sweep.tn))
            assert Scores(*counts) == fused_score(*case, wall, space, rule, region)


def test_strings_name_the_same_choices(case_of_two):
    """Each differs from the other choice, so a mix-up would be noticed."""
    for rule in UpdateRule:
        for region in Region:
            by_value = sweep_priors(*case_of_two, rule=rule.value, region=region.value)
            by_name = sweep_priors(*case_of_two, rule=rule, region=region)
            np.testing.assert_array_equal(by_value.tp, by_name.tp)
    by_name = sweep_priors(*case_of_two)
    for objective in Objective:
        assert maxima(by_name, objective.value).text == maxima(by_name, objective).text
    assert maxima(by_name, "precision").text != maxima(by_name, "recall").text


@pytest.fixture
def case_of_two():
    """Two space cells read as wall, one of them often: one is a wall in truth."""
    grid = Grid(height_px=1, width_px=3, cell_px=1)
    evidence = log_of(grid, [{0: 0.1, 1: 0.3}, {0: 0.3, 1: 0.9}, {0: 0.1}])
    no, truth = np.zeros((1, 3), dtype=bool), np.array([[True, False, True]])
    return evidence, no, truth, [0.5], [0.1, 0.4, 0.7, 1.0]


@settings(max_examples=100, deadline=None)
@given(
    case=logged_cases(p_free=(0.1, 0.2, 0.8, 0.9)),
    rule=RULES,
)
def test_counts_change_only_where_a_step_starts(case, rule):
    """On both sides of every level that a step starts at, one step of the lattice."""
    surface = prior_surface(*case, rule=rule, region=Region.ALL)
    evidence, is_wall, truth = case
    sums, counts = evidence.totals()
    weight = 1.0 - counts if rule is UpdateRule.SUBTRACT_PRIOR else 1.0
    for step in (surface.wall_tp, surface.space_fp):
        of_wall = step is surface.wall_tp
        cells = (is_wall == of_wall) & (truth == of_wall)
        for start in step.starts():
            for level in (start - LATTICE_NATS, start):
                direct = np.count_nonzero((sums + weight * level < -1e-9) & cells)
                assert step(level) == direct


@settings(max_examples=100, deadline=None)
@given(
    log_odds=st.lists(
        st.floats(-40, 40) | st.sampled_from([-1e-9, -1.01e-9, -5e-10, 0.0, 2e3, -2e3]),
        min_size=1,
        max_size=6,
    ),
    twice=st.booleans(),
    rule=RULES,
)
def test_levels_are_exact_on_the_lattice_for_any_evidence(log_odds, twice, rule):
    """One cell of each log-odds, read once, or once and then with log-odds 0.

    Log-odds near the tie band almost cancel it, and huge ones outweigh every prior;
    both sides of every step are compared with the decision itself.
    """
    n, repeats = len(log_odds), 1 + twice
    evidence = EvidenceLog(
        grid=Grid(height_px=1, width_px=n, cell_px=1),
        indptr=n * np.arange(repeats + 1),
        cell=np.tile(np.arange(n, dtype=np.int32), repeats),
        log_odds=np.array(log_odds + [0.0] * n * twice),
    )
    flags = np.ones((1, n), dtype=bool)
    step = prior_surface(evidence, flags, flags, rule).wall_tp
    sums = evidence.totals()[0].ravel()
    weight = 1 - repeats if rule is UpdateRule.SUBTRACT_PRIOR else 1
    for start in [*step.starts(), -700.0, 700.0]:
        for level in (start - LATTICE_NATS, start):
            assert step(level) == np.count_nonzero(sums + weight * level < -1e-9)


def test_without_readings_scores_are_undefined_without_a_warning():
    grid = Grid(height_px=2, width_px=2, cell_px=1)
    evidence = log_of(grid, [{}, {}])
    truth = np.eye(2, dtype=bool)
    sweep = sweep_priors(evidence, truth, truth, TENTHS, TENTHS)
    assert np.isnan(sweep.precision).all()
    assert np.isnan(sweep.recall).all()
    assert (sweep.tn == 0).all()
    best = maxima(sweep, Objective.PRECISION)
    assert np.isnan(best.value)
    assert best.p_wall.size == 0
    assert best.text == "–"


def test_no_walls_in_the_truth_leaves_recall_undefined():
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    evidence = log_of(grid, [{0: 0.1, 1: 0.1}])
    none = np.zeros((1, 2), dtype=bool)
    sweep = sweep_priors(evidence, none, none, TENTHS[:9], TENTHS[:9])
    assert np.isnan(sweep.recall).all()
    assert (sweep.precision == 0.0).all()


def test_interpolation_is_bilinear():
    """Precision 1/4, 2/4 over 3/4, 4/4; the middle is their mean, 0.625."""
    sweep = sweep_of(tp=[[1, 2], [3, 4]], fp=[[3, 2], [1, 0]])
    at = interpolate(sweep, [0.1, 0.15, 0.2, 0.2], [0.1, 0.15, 0.1, 0.175])
    np.testing.assert_allclose(at, [0.25, 0.625, 0.75, 0.9375])
    grid = interpolate(sweep, sweep.p_wall[:, None], sweep.p_space[None, :])
    np.testing.assert_allclose(grid, sweep.precision)


def test_interpolation_is_undefined_only_beside_an_undefined_corner():
    sweep = sweep_of(tp=[[0, 1, 1], [1, 1, 1]], fp=[[0, 1, 1], [1, 1, 1]])
    at = interpolate(sweep, [0.1, 0.1, 0.15, 0.2, 0.15], [0.1, 0.2, 0.15, 0.15, 0.2])
    np.testing.assert_array_equal(at, [np.nan, 0.5, np.nan, 0.5, 0.5])
    recall = interpolate(sweep, 0.15, 0.25, Objective.RECALL)
    assert recall == 1.0


def test_maxima_name_all_ties():
    sweep = sweep_of(tp=[[1, 2, 2], [0, 2, 2], [2, 1, 0]], fp=[[1, 0, 0]] * 3)
    best = maxima(sweep, Objective.PRECISION)
    assert best.value == 1.0
    np.testing.assert_array_equal(best.p_wall, [0.1, 0.1, 0.2, 0.2, 0.3])
    np.testing.assert_array_equal(best.p_space, TENTHS[[1, 2, 1, 2, 1]])
    assert best.text == "(0.1:0.2, 0.2:0.3); (0.3, 0.2)"


def test_ties_are_written_as_the_source_writes_them():
    """Table 4.2, 3 px, drawing d: "(0.7:1, 1)"; and a row with a gap."""
    ties = np.zeros((10, 10), dtype=bool)
    ties[6:, 9] = True
    assert ties_text(TENTHS, TENTHS, ties) == "(0.7:1, 1)"
    ties[0, [0, 1, 4]] = True
    text = "(0.1, 0.1:0.2); (0.1, 0.5); (0.7:1, 1)"
    assert ties_text(TENTHS, TENTHS, ties) == text


@pytest.mark.parametrize(
    ("axis", "message"),
    [
        ([0.0], r"p_wall must lie in \(0, 1\]; got .*0\.0"),
        ([1.01], "p_wall must lie in"),
        ([np.nan], "p_wall must lie in"),
        ([[0.5]], "p_wall must be one-dimensional"),
    ],
)
def test_bad_axes_are_refused(axis, message):
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence, cell = log_of(grid, [{0: 0.1}]), np.array([[True]])
    with pytest.raises(ParameterError, match=message):
        sweep_priors(evidence, cell, cell, axis, [0.5])


def test_bad_shapes_scales_and_points_are_refused():
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence, cell = log_of(grid, [{0: 0.1}]), np.array([[True]])
    with pytest.raises(ParameterError, match=r"truth must be bool .*\(1, 1\)"):
        prior_surface(evidence, cell, np.array([True]))
    with pytest.raises(ParameterError, match="scale must lie in"):
        prior_surface(evidence, cell, cell, scale=1.5)
    with pytest.raises(ParameterError, match="below 1"):
        sweep_priors(evidence, cell, cell, [1.0], [0.5], scale=1.0)
    with pytest.raises(ParameterError, match="within the sweep, 0.1 to 0.2"):
        interpolate(sweep_of(np.ones((2, 2)), np.ones((2, 2))), 0.3, 0.1)
    with pytest.raises(ParameterError, match="at least two values"):
        interpolate(sweep_of(np.ones((1, 2)), np.ones((1, 2))), 0.1, 0.1)

import moocore
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from occsim import (
    Grid,
    ParameterError,
    Prior,
    UpdateRule,
    collect_evidence,
    collect_totals,
    fuse,
    load_sample,
    sample_names,
    score,
)
from occsim.metrics import Region, precision_of, recall_of
from occsim.prior import prior_from_cells
from occsim.priors import (
    ParetoFront,
    PriorSurface,
    StepCount,
    dominates,
    exact_front,
    front_of,
    good_region,
    hypervolume,
    near_front,
    non_dominated,
    prior_surface,
    recommend,
    rectangles_at,
    reference_point,
    set_c,
    surface_front,
    sweep_priors,
)
from occsim.world import truth_cells
from tests.test_metrics import log_of, logged_cases
from tests.test_sweep import fused_score, sweep_of

RULES = st.sampled_from(UpdateRule)
REGIONS = st.sampled_from(Region)
BAND = 1e-9


def front(precision, recall):
    """A front of given points; the pairs only number them."""
    index = np.arange(len(recall)) / 100
    return ParetoFront(index, index, np.array(precision), np.array(recall))


def scores_of(tp, fp, n_wall):
    """Precision and recall of counts, NaN where undefined."""
    return precision_of(tp, fp), recall_of(tp, n_wall - tp)


def levels(evidence, cells, rule):
    """One prior value in every interval between flips, worked out cell by cell.

    Intervals within the tie band hold none but the tie itself, a prior of one half.
    """
    sums, counts = evidence.totals()
    flips = []
    for s, k in zip(sums[cells], counts[cells], strict=True):
        w = 1 - k if rule is UpdateRule.SUBTRACT_PRIOR else 1
        if w != 0:
            flips.append((-BAND - s) / w)
    bottom, top = np.log(0.09 / 0.91), np.log(9.0)
    inside = sorted(x for x in flips if bottom < x < top)
    edges = np.array([bottom, *inside, top])
    edges = edges[np.append(True, np.diff(edges) > 3 * BAND)]
    middles = 0.5 * (edges[1:] + edges[:-1])
    return [0.1, *(1 / (1 + np.exp(-middles)) / 0.9), 5 / 9, 1.0]


@settings(max_examples=150, deadline=None)
@given(case=logged_cases(p_free=(0.1, 0.2, 0.3, 0.7, 0.9)), rule=RULES, region=REGIONS)
def test_exact_front_equals_brute_force(case, rule, region):
    """Every pair of intervals, fused and scored; the best of all of them.

    Compares all points of both, and every pair and rectangle corner of the front
    against fusing and scoring it.
    """
    evidence, is_wall, truth = case
    scores = [
        fused_score(*case, p_wall, p_space, rule, region)
        for p_wall in levels(evidence, is_wall, rule)
        for p_space in levels(evidence, ~is_wall, rule)
    ]
    points = {(s.precision, s.recall) for s in scores if s.tp > 0}
    best = {p for p in points if not any(dominates(q, p) for q in points)}
    exact = exact_front(*case, rule=rule, region=region)
    assert set(zip(exact.precision, exact.recall, strict=True)) == best
    assert len(exact) == len(best)
    for i in range(len(exact)):
        w0, w1, s0, s1 = exact.rectangles[i]
        assert w0 <= exact.p_wall[i] <= w1
        assert s0 <= exact.p_space[i] <= s1
        for pair in ((exact.p_wall[i], exact.p_space[i]), (w0, s0), (w1, s1)):
            at = fused_score(*case, *pair, rule, region)
            assert (at.precision, at.recall) == (exact.precision[i], exact.recall[i])


@settings(max_examples=100, deadline=None)
@given(case=logged_cases(p_free=(0.1, 0.2, 0.3, 0.7, 0.9)), rule=RULES, region=REGIONS)
@pytest.mark.parametrize("band", [3e-10, 3e-9])
def test_no_front_depends_on_the_width_of_the_tie_band(band, case, rule, region):
    usual = exact_front(*case, rule=rule, region=region)
    with pytest.MonkeyPatch.context() as patch:
        for module in ("occsim.priors.surface", "occsim.priors.exact"):
            patch.setattr(f"{module}.DECISION_EPS", band)
        other = exact_front(*case, rule=rule, region=region)
    for name in ("p_wall", "p_space", "precision", "recall"):
        np.testing.assert_array_equal(getattr(other, name), getattr(usual, name))


@settings(max_examples=100, deadline=None)
@given(
    case=logged_cases(p_free=(0.1, 0.2, 0.3, 0.7, 0.9)),
    rule=RULES,
    region=REGIONS,
    scale=st.sampled_from([0.5, 0.9, 0.99]),
)
def test_pairs_as_printed_attain_their_points(case, rule, region, scale):
    """With 4 decimals, or to the last digit where the value is marked as single."""
    evidence, is_wall, truth = case
    front = exact_front(*case, rule=rule, region=region, scale=scale)
    pairs = np.stack((front.p_wall, front.p_space), axis=1)
    assert front.is_single.shape == (len(front), 2)
    for i, (pair, single) in enumerate(zip(pairs, front.is_single, strict=True)):
        printed = [
            float(repr(float(p)) if one else f"{p:.4f}")
            for p, one in zip(pair, single, strict=True)
        ]
        prior = Prior(p_wall=printed[0], p_space=printed[1], scale=scale)
        prior_map = prior_from_cells(is_wall, evidence.grid, prior)
        at = score(fuse(evidence, prior_map, rule), truth, region)
        assert (at.precision, at.recall) == (front.precision[i], front.recall[i])
        for p, one, (low, high) in zip(
            pair, single, front.rectangles[i].reshape(2, 2), strict=True
        ):
            # Single only where no number of 4 decimals lies inside.
            assert one == (np.floor(high * 1e4) < np.ceil(low * 1e4))
            assert low <= p <= high


LEVELS = st.lists(st.integers(-22, 21), max_size=4).map(
    lambda tenths: np.sort(np.array(tenths, dtype=np.float64) / 10)
)
STEPS = st.builds(
    StepCount, st.integers(0, 2), LEVELS, LEVELS.map(lambda level: level + 0.05)
)


@settings(max_examples=200, deadline=None)
@given(steps=st.tuples(STEPS, STEPS, STEPS, STEPS), missed=st.integers(0, 2))
def test_front_of_any_steps_equals_brute_force(steps, missed):
    """Counts that rise and fall at will, more of them than small maps have.

    Steps lie at multiples of 0.05 nats between -2.2 and 2.15, the box from -2.31 to
    2.20: the middles of the multiples are all states.
    """
    counts = [s.always + s.falling.size + s.rising.size for s in steps]
    surface = PriorSurface(
        *steps,
        n_wall=counts[0] + counts[2] + missed,
        n_space=counts[1] + counts[3],
        scale=0.9,
    )
    values = 1 / (1 + np.exp(-np.arange(-2.225, 2.2, 0.05))) / 0.9
    tp, fp = (x.ravel() for x in surface.counts(values[:, None], values[None, :]))
    best = front_of(*np.zeros((2, tp.size)), *scores_of(tp, fp, surface.n_wall))
    exact = surface_front(surface)
    np.testing.assert_array_equal(exact.precision, best.precision)
    np.testing.assert_array_equal(exact.recall, best.recall)
    tp, fp = surface.counts(exact.p_wall, exact.p_space)
    precision, recall = scores_of(tp, fp, surface.n_wall)
    np.testing.assert_array_equal(precision, exact.precision)
    np.testing.assert_array_equal(recall, exact.recall)


def test_a_front_point_may_be_attained_only_at_a_tie():
    """Three space cells: the prior of one half alone declares no false wall.

    Cell 0, a wall, is read 0.1 once: k = 1, declared wall whatever the prior. Cell 1
    is never read: false wall below one half. Cell 2 is read 0.1 and 0.9: S = 0,
    l = -l_0, false wall above one half. At p_space = 5/9 both tie.
    """
    grid = Grid(height_px=1, width_px=3, cell_px=1)
    evidence = log_of(grid, [{0: 0.1, 2: 0.1}, {2: 0.9}])
    none, truth = np.zeros((1, 3), dtype=bool), np.array([[True, False, False]])
    exact = exact_front(evidence, none, truth, UpdateRule.SUBTRACT_PRIOR, Region.ALL)
    assert (exact.precision, exact.recall) == (1.0, 1.0)
    assert exact.p_space[0] == exact.rectangles[0, 2] == exact.rectangles[0, 3] == 5 / 9
    np.testing.assert_array_equal(exact.is_single, [[False, True]])


def test_points_that_exist_only_in_the_tie_band_are_on_no_front():
    """Two space cells that tie at one half, read 3 and 7 times, S = 0 and w = -2, -6.

    Of true log-odds above 0 both are declared wall. In between, at 1e-9 / 6, only the
    second is, a wall in truth: an artefact of the band's width that would score
    precision 1.
    """
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    twice = [{0: 0.5, 1: 0.5}] * 3
    evidence = log_of(grid, [*twice, *[{1: 0.5}] * 4])
    none, truth = np.zeros((1, 2), dtype=bool), np.array([[False, True]])
    exact = exact_front(evidence, none, truth, UpdateRule.SUBTRACT_PRIOR)
    assert (exact.precision, exact.recall) == (0.5, 1.0)
    (rectangle,) = rectangles_at(
        prior_surface(evidence, none, truth, UpdateRule.SUBTRACT_PRIOR), 0.5, 0.8
    )
    np.testing.assert_allclose(rectangle, [0.1, 1.0, 5 / 9, 1.0], atol=2e-9)


ONE_READING = log_of(Grid(height_px=1, width_px=1, cell_px=1), [{0: 0.7}])
NONE = np.zeros((1, 1), dtype=bool)


@settings(max_examples=60, deadline=None)
@given(
    case=logged_cases(p_free=(0.1, 0.2, 0.3, 0.7, 0.9)),
    rule=RULES,
    region=REGIONS,
    pair=st.tuples(st.floats(0.1, 1.0), st.floats(0.1, 1.0)),
)
# 0.9 / 3 and one reading of 0.7 cancel, and a third has no exact binary value.
@example(
    (ONE_READING, NONE, NONE), UpdateRule.PRIOR_ONCE, Region.EXPLORED, (1.0, 1 / 3)
)
def test_rectangles_hold_every_pair_that_scores_the_same(case, rule, region, pair):
    evidence, is_wall, truth = case
    surface = prior_surface(*case, rule, region)
    p_wall, p_space = np.meshgrid(
        [pair[0], *levels(evidence, is_wall, rule)],
        [pair[1], *levels(evidence, ~is_wall, rule)],
    )
    tp, fp = surface.counts(p_wall, p_space)
    same = (tp == tp[0, 0]) & (fp == fp[0, 0])
    rows = rectangles_at(surface, *pair)
    inside = np.zeros_like(same)
    for w0, w1, s0, s1 in rows:
        inside |= (p_wall >= w0) & (p_wall <= w1) & (p_space >= s0) & (p_space <= s1)
    np.testing.assert_array_equal(inside, same)


def test_a_rectangle_ends_at_the_tie_that_it_holds():
    """Cell 1 is read three times with sum 0, prior subtracted: l = -2 l_0.

    It is wall where l_0 > 0, and so not at p_space = 5/9, a prior of one half.
    """
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    readings = [{0: 0.1, 1: 0.1}, {1: 0.9}, {1: 0.5}]
    none, truth = np.zeros((1, 2), dtype=bool), np.array([[True, False]])
    surface = prior_surface(log_of(grid, readings), none, truth, "subtract_prior")
    [rectangle] = rectangles_at(surface, 1.0, 0.5)
    # As far as logits are rounded to 0: half a step of 2^-36 nats, 4e-12 in p_space.
    assert 5 / 9 <= rectangle[3] <= 5 / 9 + 4e-12
    assert surface.counts(1.0, rectangle[3]) == surface.counts(1.0, 0.5)
    assert surface.counts(1.0, 5 / 9 + 2e-9) != surface.counts(1.0, 0.5)


@pytest.fixture(scope="module", params=["c", "e"])
def sample_case(request):
    """A section at 5 px; its dark pixels serve as the wall mask."""
    sample = load_sample(request.param)
    grid = sample.world.grid(5)
    evidence = collect_evidence(sample.world, sample.trajectory, sample.sensor, grid)
    is_wall = grid.share(sample.drawing.gray < 128) > 0
    return evidence, is_wall, truth_cells(sample.world, grid)


@pytest.mark.parametrize("rule", UpdateRule)
@pytest.mark.parametrize("region", Region)
def test_no_dense_sweep_beats_the_front_of_a_sample(sample_case, rule, region):
    surface = prior_surface(*sample_case, rule, region)
    exact = surface_front(surface)
    assert len(exact) > 0
    assert (np.diff(exact.recall) > 0).all()
    assert (np.diff(exact.precision) < 0).all()
    axis = np.linspace(0.1, 1.0, 181)
    sweep = sweep_priors(*sample_case, axis, axis, rule=rule, region=region)
    precision = np.append(sweep.precision.ravel(), exact.precision)
    recall = np.append(sweep.recall.ravel(), exact.recall)
    assert non_dominated(precision, recall)[-len(exact) :].all()
    ref = reference_point(exact)
    swept = hypervolume(sweep.precision.ravel(), sweep.recall.ravel(), ref)
    assert 0.0 < swept <= exact.hypervolume(ref) * (1 + 1e-12)


@pytest.mark.parametrize("cell_px", [3, 5, 10])
@pytest.mark.parametrize("name", sample_names())
def test_every_front_point_of_the_samples_is_attained_by_its_pair(name, cell_px):
    sample = load_sample(name)
    grid = sample.world.grid(cell_px)
    asked = sample.world, sample.trajectory, sample.sensor, grid
    evidence, truth = collect_totals(*asked), truth_cells(sample.world, grid)
    is_wall = grid.share(sample.drawing.gray < 128) > 0
    for rule in UpdateRule:
        for region in Region:
            exact = exact_front(evidence, is_wall, truth, rule, region)
            points = zip(exact.precision, exact.recall, strict=True)
            pairs = zip(exact.p_wall, exact.p_space, strict=True)
            for point, pair in zip(points, pairs, strict=True):
                at = fused_score(evidence, is_wall, truth, *pair, rule, region)
                assert (at.precision, at.recall) == point


def test_front_of_two_cells_by_hand():
    """Wall cell 0 and space cell 1, each read 0.3 twice: k = 2, S = -1.695.

    Each is declared wall where its p exceeds 0.155 / 0.9 = 0.1725 (0.155 is the
    inverse logit of -1.695). Cell 0 is a wall, cell 1 is not: the only front point
    is precision 1, recall 1, for p_wall above and p_space below.
    """
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    evidence = log_of(grid, [{0: 0.3, 1: 0.3}] * 2)
    walls = np.array([[True, False]])
    exact = exact_front(evidence, walls, walls, UpdateRule.SUBTRACT_PRIOR)
    assert (exact.precision, exact.recall) == (1.0, 1.0)
    level = 1 / (1 + (7 / 3) ** 2) / 0.9
    np.testing.assert_allclose(exact.rectangles, [[level, 1.0, 0.1, level]], atol=1e-8)
    # The shortest decimals inside: of one digit nearest to the middle, 0.586; below
    # 0.1725 only 0.1, the end of the box, has one digit.
    assert (exact.p_wall[0], exact.p_space[0]) == (0.6, 0.1)


def test_a_box_of_one_pair_has_that_pair():
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence, wall = log_of(grid, [{0: 0.1}]), np.array([[True]])
    exact = exact_front(evidence, wall, wall, low=0.3, high=0.3)
    assert (exact.p_wall[0], exact.p_space[0], exact.recall[0]) == (0.3, 0.3, 1.0)


@pytest.mark.parametrize("rule", UpdateRule)
@pytest.mark.parametrize("region", Region)
def test_fronts_without_a_hit_are_empty(rule, region):
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    none, one = np.zeros((1, 2), dtype=bool), np.array([[True, False]])
    seen = log_of(grid, [{0: 0.9, 1: 0.9}] * 3)
    no_walls = exact_front(seen, one, none, rule, region)
    assert len(no_walls) == 0
    assert no_walls.rectangles.shape == (0, 4)
    assert no_walls.hypervolume((10, 10)) == 0.0
    assert reference_point(no_walls) == (1.0, 1.0)
    assert recommend(no_walls) is None
    assert len(set_c(no_walls)) == 0
    unseen = exact_front(log_of(grid, [{}]), one, one, rule, region)
    # Where unseen cells are scored the prior alone decides.
    assert len(unseen) == (region is not Region.EXPLORED)


def test_one_class_may_be_empty():
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence, yes, no = log_of(grid, [{0: 0.1}]), *np.array([[[True]], [[False]]])
    for is_wall in (yes, no):
        exact = exact_front(evidence, is_wall, yes)
        assert (exact.precision, exact.recall) == (1.0, 1.0)


@pytest.mark.parametrize(("low", "high"), [(0.0, 1.0), (0.1, 1.1), (np.nan, 1.0)])
def test_bad_boxes_are_refused(low, high):
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    evidence, wall = log_of(grid, [{0: 0.1}]), np.array([[True]])
    with pytest.raises(ParameterError, match="low and high must lie in"):
        exact_front(evidence, wall, wall, low=low, high=high)
    with pytest.raises(ParameterError, match="low must not exceed high; got 0.9"):
        exact_front(evidence, wall, wall, low=0.9, high=0.2)


POINTS = st.lists(
    st.tuples(*[st.sampled_from([np.nan, 0.0, 0.25, 0.5, 0.75, 1.0])] * 2),
    max_size=12,
)


@given(POINTS)
def test_non_dominated_equals_comparing_all_pairs(points):
    points = np.array(points).reshape(-1, 2)
    naive = [
        not np.isnan(p).any() and not any(dominates(q, p) for q in points)
        for p in points
    ]
    np.testing.assert_array_equal(non_dominated(*points.T), np.array(naive, bool))


@given(POINTS)
def test_front_of_evaluated_pairs_has_each_best_point_once(points):
    points = np.array(points).reshape(-1, 2)
    index = np.arange(len(points)) / 100
    made = front_of(index, index, *points.T)
    hits = {p for p in map(tuple, points) if p[0] > 0 and p[1] > 0}
    best = {p for p in hits if not any(dominates(q, p) for q in hits)}
    assert set(zip(made.precision, made.recall, strict=True)) == best
    assert (np.diff(made.recall) > 0).all()
    for i in range(len(made)):
        row = round(made.p_wall[i] * 100)
        assert tuple(points[row]) == (made.precision[i], made.recall[i])


@given(POINTS, st.tuples(*[st.sampled_from([0.2, 0.5, 1.0])] * 2))
def test_hypervolume_never_falls_when_a_point_is_added(points, new):
    points = np.array([*points, new])
    before = hypervolume(*points[:-1].T, (8.0, 8.0))
    assert hypervolume(*points.T, (8.0, 8.0)) >= before - 1e-12


def test_hypervolume_by_hand():
    """Objectives (1, 4) and (2, 2) against (5, 5): 4 x 1 + 3 x 2 = 10.

    The point at (4, 4) is dominated, the one at (1/0.1, 1) is beyond the reference.
    """
    precision, recall = [1.0, 0.25, 0.5, 0.1], [0.25, 0.25, 0.5, 1.0]
    assert hypervolume(precision, recall, (5, 5)) == pytest.approx(10.0)
    for ref in ((1.0,), (np.inf, 1.0)):
        with pytest.raises(ParameterError, match="ref must be two finite numbers"):
            hypervolume(precision, recall, ref)


@given(st.lists(st.tuples(*[st.floats(0.1, 1.0)] * 2), min_size=1, max_size=20))
def test_hypervolume_and_dominance_equal_those_of_an_outside_library(points):
    """moocore, which pymoo brings along; some points lie beyond the reference."""
    objectives = 1.0 / np.array(points)
    ours = hypervolume(*np.array(points).T, (7.0, 7.0))
    assert ours == pytest.approx(moocore.hypervolume(objectives, ref=[7.0, 7.0]))
    np.testing.assert_array_equal(
        non_dominated(*np.array(points).T),
        moocore.is_nondominated(np.array(points), maximise=True, keep_weakly=True),
    )


def test_set_c_and_the_recommended_pair():
    """F2 = 5 P R / (4 P + R): 2.5 / 4.5, 2.8 / 3.9, 2 / 2.8 and 0.9 / 1.7."""
    four = front([1.0, 0.8, 0.5, 0.2], [0.5, 0.7, 0.8, 0.9])
    np.testing.assert_allclose(four.f2, [5 / 9, 28 / 39, 5 / 7, 9 / 17])
    assert recommend(four) == 1
    assert recommend(four, min_recall=0.7) == 2
    assert recommend(four, min_recall=0.9) is None
    np.testing.assert_array_equal(set_c(four, 0.7).recall, [0.8, 0.9])
    with pytest.raises(ParameterError, match="min_recall must lie in"):
        set_c(four, 40)


TABLE = sweep_of(
    tp=[[5, 8], [4, 0]], fp=[[0, 2], [1, 0]], fn=[[5, 2], [6, 10]]
)  # Precision 1, 0.8 over 0.8, NaN; recall 0.5, 0.8 over 0.4, 0.


def test_pairs_near_a_front_by_hand():
    """The front is (1, 0.5), (0.8, 0.8); the pair (0.8, 0.4) is 0.2 and 0.1 short."""
    ends = front([1.0, 0.8], [0.5, 0.8])
    on_it = [[True, True], [False, False]]
    np.testing.assert_array_equal(near_front(TABLE, ends, 0.0), on_it)
    np.testing.assert_array_equal(near_front(TABLE, ends, 0.15), on_it)
    near = near_front(TABLE, ends, 0.2)
    np.testing.assert_array_equal(near, [[True, True], [True, False]])
    assert not near_front(TABLE, front([], []), 1.0).any()


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.05, 0.2]))
def test_near_a_front_equals_its_definition(seed, tolerance):
    rng = np.random.default_rng(seed)
    sweep = sweep_of(*rng.integers(0, 6, (3, 4, 5)))
    pairs = np.zeros(20)
    made = front_of(pairs, pairs, sweep.precision.ravel(), sweep.recall.ravel())
    p, r = sweep.precision[..., None], sweep.recall[..., None]
    close = (made.precision - p <= tolerance + 1e-12) & (
        made.recall - r <= tolerance + 1e-12
    )
    np.testing.assert_array_equal(
        near_front(sweep, made, tolerance), close.any(axis=-1)
    )


def test_the_good_region_is_good_for_all():
    ends, other = front([1.0, 0.8], [0.5, 0.8]), front([1.0], [0.8])
    both = good_region([TABLE, TABLE], [ends, other], 0.2)
    np.testing.assert_array_equal(both, [[False, True], [False, False]])
    with pytest.raises(ParameterError, match="one front a sweep"):
        good_region([TABLE], [], 0.2)
    with pytest.raises(ParameterError, match="same axes"):
        good_region([TABLE, sweep_of(np.ones((1, 2)), np.ones((1, 2)))], [ends] * 2, 0)
    with pytest.raises(ParameterError, match="tolerance must lie in"):
        near_front(TABLE, ends, -0.1)

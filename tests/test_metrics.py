import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import EvidenceLog, Grid, ParameterError, Prior, UpdateRule, fuse, logit
from occsim.mapping import OccupancyMap
from occsim.metrics import (
    Region,
    Scores,
    coverage,
    log_loss,
    mean_entropy_bits,
    score,
    scores_by_reading,
)
from occsim.prior import prior_from_cells

LN9 = float(logit(0.9))


def map_of(log_odds, n_updates):
    log_odds = np.asarray(log_odds, dtype=np.float64)
    height, width = log_odds.shape
    grid = Grid(height_px=height, width_px=width, cell_px=1)
    return OccupancyMap(grid, log_odds, np.asarray(n_updates))


def log_of(grid, readings):
    """An evidence log from one {cell: p_free} a reading."""
    sizes = [len(reading) for reading in readings]
    cells = [cell for reading in readings for cell in reading]
    p_free = [p for reading in readings for p in reading.values()]
    return EvidenceLog(
        grid=grid,
        indptr=np.concatenate(([0], np.cumsum(sizes))).astype(np.int64),
        cell=np.array(cells, dtype=np.int32),
        log_odds=logit(np.array(p_free, dtype=np.float64)),
    )


@st.composite
def logged_cases(draw, p_free=(0.1, 0.3, 0.5, 0.9)):
    """A small log with many exact ties, wall cells, and a truth."""
    n_cells = draw(st.integers(1, 8))
    grid = Grid(height_px=1, width_px=n_cells, cell_px=1)
    reading = st.dictionaries(st.integers(0, n_cells - 1), st.sampled_from(p_free))
    evidence = log_of(grid, draw(st.lists(reading, max_size=7)))
    flags = st.lists(st.booleans(), min_size=n_cells, max_size=n_cells)
    is_wall, truth = (np.array([draw(flags)]) for _ in range(2))
    return evidence, is_wall, truth


def test_a_map_of_eight_cells_counted_by_hand():
    """Occupied, explored and wall in all eight combinations.

    The explored half has one cell of each outcome; of the four unexplored cells three
    more are declared wall or are wall, so that the regions differ.
    """
    log_odds = [[-1.0, -1.0, 1.0, 1.0], [-1.0, -1.0, 1.0, -2.0]]
    explored = [[1, 2, 1, 3], [0, 0, 0, 0]]
    truth = np.array([[True, False, True, False], [True, False, True, True]])
    occupancy_map = map_of(log_odds, explored)
    assert score(occupancy_map, truth) == Scores(tp=1, fp=1, fn=1, tn=1)
    everywhere = score(occupancy_map, truth, Region.ALL)
    assert everywhere == Scores(tp=3, fp=2, fn=2, tn=1)
    unexplored = score(occupancy_map, truth, Region.UNEXPLORED)
    assert unexplored == Scores(tp=2, fp=1, fn=1, tn=0)
    assert coverage(occupancy_map) == 0.5


def test_measures_by_hand():
    """TP 3, FP 2, FN 1, TN 4: precision 3/5, recall 3/4.

    F1 = 6 / (6 + 1 + 2), F2 = 15 / (15 + 4 + 2), IoU 3/6, accuracy 7/10.
    """
    scores = Scores(tp=3, fp=2, fn=1, tn=4)
    assert scores.precision == pytest.approx(0.6)
    assert scores.recall == pytest.approx(0.75)
    assert scores.f1 == pytest.approx(2 / 3)
    assert scores.f2 == pytest.approx(15 / 21)
    assert scores.iou == pytest.approx(0.5)
    assert scores.accuracy == pytest.approx(0.7)


def test_undefined_measures_are_nan_without_a_warning():
    nothing_declared = Scores(tp=0, fp=0, fn=2, tn=1)
    assert np.isnan(nothing_declared.precision)
    assert nothing_declared.recall == 0.0
    assert nothing_declared.f2 == 0.0
    no_walls = Scores(tp=0, fp=2, fn=0, tn=1)
    assert np.isnan(no_walls.recall)
    assert no_walls.precision == 0.0
    empty = Scores(tp=0, fp=0, fn=0, tn=0)
    for name in ("precision", "recall", "f1", "f2", "iou", "accuracy"):
        assert np.isnan(getattr(empty, name))


def test_an_exact_tie_is_not_declared_wall():
    # ln 9 - ln 9 on the lattice, and the same off by the rounding of another sum.
    tie = map_of([[logit(0.9) + logit(0.1), -1e-15, -1e-8]], [[1, 1, 1]])
    truth = np.ones((1, 3), dtype=bool)
    assert score(tie, truth) == Scores(tp=1, fp=0, fn=2, tn=0)


def test_entropy_of_known_probabilities():
    # H(0.5) = 1 bit; H(0.9) = -0.9 log2 0.9 - 0.1 log2 0.1 = 0.4689956 bits; certain 0.
    assert mean_entropy_bits(map_of([[0.0]], [[0]])) == pytest.approx(1.0)
    assert mean_entropy_bits(map_of([[LN9, -LN9]], [[1, 1]])) == pytest.approx(
        0.468995593589281
    )
    assert mean_entropy_bits(map_of([[np.inf, -5000.0]], [[1, 1]])) == 0.0


def test_truth_of_another_shape_or_type_is_refused():
    occupancy_map = map_of([[0.0, 1.0]], [[0, 1]])
    with pytest.raises(ParameterError, match=r"shape \(1, 2\).*got bool of shape"):
        score(occupancy_map, np.zeros((2, 1), dtype=bool))
    with pytest.raises(TypeError, match="got an array of int64"):
        score(occupancy_map, np.zeros((1, 2), dtype=np.int64))


def test_curves_of_three_readings_by_hand():
    """Two cells, cell 0 a wall in drawing and truth; prior 0.18 there, 0.81 on cell 1.

    l_0 = (-1.516, 1.450). Reading 1 says 0.9 of cell 1 (l = 2.197: free), reading 2
    says 0.1 of it (l = 0 - 1.450: false wall), reading 3 says 0.1 of cell 0 (wall).
    """
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    evidence = log_of(grid, [{1: 0.9}, {1: 0.1}, {0: 0.1}])
    walls = np.array([[True, False]])
    prior_map = prior_from_cells(walls, grid, Prior(p_wall=0.2, p_space=0.9))
    curves = scores_by_reading(evidence, prior_map, walls, UpdateRule.SUBTRACT_PRIOR)
    np.testing.assert_array_equal(curves.tp, [0, 0, 0, 1])
    np.testing.assert_array_equal(curves.fp, [0, 0, 1, 1])
    np.testing.assert_array_equal(curves.fn, [0, 0, 0, 0])
    np.testing.assert_array_equal(curves.tn, [0, 1, 0, 0])
    np.testing.assert_array_equal(curves.coverage, [0.0, 0.5, 0.5, 1.0])
    np.testing.assert_array_equal(curves.precision, [np.nan, np.nan, 0.0, 0.5])
    np.testing.assert_array_equal(curves.recall, [np.nan, np.nan, np.nan, 1.0])


def parts_of(log, size):
    """The log cut into parts of so many readings."""
    for start in range(0, log.n_readings, size):
        indptr = log.indptr[start : start + size + 1]
        own = slice(indptr[0], indptr[-1])
        yield EvidenceLog(
            log.grid, indptr - indptr[0], log.cell[own], log.log_odds[own]
        )


@settings(max_examples=150, deadline=None)
@given(
    case=logged_cases(),
    p_wall=st.sampled_from([0.1, 0.2, 5 / 9, 1.0]),
    p_space=st.sampled_from([0.1, 0.5, 0.9, 1.0]),
    rule=st.sampled_from(UpdateRule),
    region=st.sampled_from(Region),
    at_once=st.sampled_from([1, 3, 1 << 16]),
    in_parts_of=st.sampled_from([None, 1, 3]),
)
def test_curves_equal_fusing_and_scoring_at_every_step(
    case, p_wall, p_space, rule, region, at_once, in_parts_of
):
    evidence, is_wall, truth = case
    prior = Prior(p_wall=p_wall, p_space=p_space)
    prior_map = prior_from_cells(is_wall, evidence.grid, prior)
    handed = evidence if in_parts_of is None else parts_of(evidence, in_parts_of)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("occsim.metrics.curves.ENTRIES_AT_ONCE", at_once)
        curves = scores_by_reading(
            handed, prior_map, truth, rule, region, bits=in_parts_of != 1
        )
    assert (curves.bits is None) == (in_parts_of == 1)
    assert curves.tp.shape == (evidence.n_readings + 1,)
    for n in range(evidence.n_readings + 1):
        occupancy_map = fuse(evidence, prior_map, rule, n)
        assert curves.at(n) == score(occupancy_map, truth, region)
        assert curves.coverage[n] == coverage(occupancy_map)
        if curves.bits is not None:
            expected = log_loss(occupancy_map, truth, region)
            np.testing.assert_allclose(curves.bits[n], expected, rtol=0, atol=1e-12)


def test_ties_survive_a_long_log():
    """A cell whose readings cancel in pairs, after 60,000 entries of other cells.

    A running sum over the whole log would have grown to 1e5 nats by then; with the
    readings 0.3 and 0.7 in turn the cell stands at a tie after every second one.
    """
    grid = Grid(height_px=1, width_px=301, cell_px=1)
    others = dict.fromkeys(range(300), 0.9)
    evidence = log_of(grid, [others | {300: (0.3, 0.7)[i % 2]} for i in range(200)])
    prior_map = prior_from_cells(
        np.zeros(grid.shape, dtype=bool), grid, Prior.uninformative()
    )
    truth = np.ones(grid.shape, dtype=bool)
    curves = scores_by_reading(evidence, prior_map, truth)
    np.testing.assert_array_equal(curves.tp, [0] + [1, 0] * 100)


def test_curves_refuse_another_grid():
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    other = Grid(height_px=2, width_px=1, cell_px=1)
    walls = np.zeros((2, 1), dtype=bool)
    prior_map = prior_from_cells(walls, other, Prior())
    with pytest.raises(ParameterError, match="same grid"):
        scores_by_reading(log_of(grid, [{}]), prior_map, walls)

"""Bits on readings that were held out: by hand, and against the ground truth."""

import functools
import itertools
import math

import numpy as np
import pytest

from occsim import (
    DrawingFlaws,
    EvidenceTotals,
    Grid,
    ParameterError,
    Prior,
    Sensor,
    build_prior,
    detect_walls,
    evidence_from_scans,
    flawed_mask,
    fuse,
    held_out_bits,
    load_sample,
    simulate_scans,
    truth_cells,
)
from occsim.metrics.held_out import CLEAR_NATS, CLEAR_SHARE
from occsim.metrics.proper import surprise_bits
from tests.test_metrics import log_of

GRID = Grid(height_px=1, width_px=3, cell_px=1)


def blank(grid):
    return build_prior(
        np.zeros((grid.height_px, grid.width_px), bool), grid, Prior.uninformative()
    )


def test_two_blocks_by_hand():
    """Blocks: readings 1 and 2; readings 3 and 4. Prior one half.

    Block 1 says: cell 0 free (0.9 twice), cell 1 wall (0.1), cell 2 nothing clear
    (0.9, 0.1). Block 2 says: cell 0 wall (0.1), cell 2 nothing clear (0.6).
    Block 1 is predicted from block 2: cell 0 at p_free 0.1, so -log2 0.1; cell 1 at one
    half, 1 bit. Block 2 from block 1: cell 0 at odds 81, so -log2(1 / 82).
    """
    log = log_of(GRID, [{0: 0.9, 1: 0.1, 2: 0.9}, {0: 0.9, 2: 0.1}, {0: 0.1}, {2: 0.6}])
    found = held_out_bits(log, blank(GRID), n_folds=2)
    first = (-math.log2(0.1) + 1.0) / 2
    np.testing.assert_allclose(found.bits_by_fold, [first, math.log2(82)])
    assert found.cells_by_fold.tolist() == [2, 1]
    assert found.bits == pytest.approx((2 * first + math.log2(82)) / 3)


def test_the_prior_predicts_what_no_other_block_has_seen():
    """By hand: p_free 0.18 of the drawn wall in cell 0, 0.81 of cell 1; each is seen in
    one block only."""
    log = log_of(GRID, [{0: 0.1}, {1: 0.9}])
    drawn = build_prior(np.array([[True, False, False]]), GRID, Prior())
    found = held_out_bits(log, drawn, n_folds=2)
    np.testing.assert_allclose(found.bits_by_fold, -np.log2([0.82, 0.81]))


def test_nine_readings_of_ten_are_clear_and_eight_are_not():
    for against, cells in ((1, [1, 1]), (2, [0, 1])):
        readings = [{0: 0.1}] * against + [{0: 0.9}] * (10 - against) + [{0: 0.9}] * 10
        log = log_of(GRID, readings)
        found = held_out_bits(log, blank(GRID), n_folds=2)
        assert found.cells_by_fold.tolist() == cells


def test_where_nothing_is_clear_the_bits_are_undefined():
    log = log_of(GRID, [{0: 0.6}, {}])
    found = held_out_bits(log, blank(GRID), n_folds=2)
    assert math.isnan(found.bits)
    assert np.isnan(found.bits_by_fold).all()


def test_more_blocks_than_readings_are_refused():
    log = log_of(GRID, [{0: 0.6}, {}])
    with pytest.raises(ParameterError, match="at most the number of readings, 2; got"):
        held_out_bits(log, blank(GRID), n_folds=3)
    for n_folds in (1, 101, 2.5):
        with pytest.raises(ParameterError, match="n_folds must be a whole number, 2"):
            held_out_bits(log, blank(GRID), n_folds=n_folds)


@functools.cache
def drive(name):
    """Evidence of 90 beams over half a turn, and priors of very different worth."""
    sample = load_sample(name)
    grid = sample.world.grid(3)
    sensor = Sensor(range_px=40, fov_rad=np.pi, behind_hit="unseen")
    scans = simulate_scans(sample.world, sample.trajectory, sensor, 90)
    evidence = evidence_from_scans(scans, sensor, grid)
    found = detect_walls(sample.drawing).mask
    drawings = {
        "its own": found,
        "mirrored": np.ascontiguousarray(found[:, ::-1]),
        "20 px off": flawed_mask(found, DrawingFlaws(shift_x_px=20, shift_y_px=20)),
        "thick": flawed_mask(found, DrawingFlaws(thickness_px=3)),
    }
    priors = {
        which: build_prior(mask, grid, Prior()) for which, mask in drawings.items()
    }
    return evidence, priors | {"blank": blank(grid)}, truth_cells(sample.world, grid)


def truth_bits(evidence, prior_map, rule, truth, n_folds=5):
    """The same maps and cells, judged by the ground truth."""
    sums, counts = evidence.totals()
    ends = np.arange(n_folds + 1) * evidence.n_readings // n_folds
    bits = []
    for start, stop in itertools.pairwise(ends.tolist()):
        own, k = (
            late - early
            for late, early in zip(
                evidence.totals(stop), evidence.totals(start), strict=True
            )
        )
        rest = EvidenceTotals(evidence.grid, sums - own, counts - k)
        log_odds = fuse(rest, prior_map, rule).log_odds
        clear = (k > 0) & (abs(own) >= CLEAR_NATS)
        clear &= abs(own) >= CLEAR_SHARE * CLEAR_NATS * k
        bits.append(surprise_bits(log_odds[clear], truth[clear]))
    return np.concatenate(bits).mean()


@pytest.mark.parametrize("name", "abcde")
def test_priors_are_ranked_as_the_ground_truth_ranks_them(name):
    evidence, priors, truth = drive(name)
    held = {w: held_out_bits(evidence, p).bits for w, p in priors.items()}
    true = {w: truth_bits(evidence, p, "prior_once", truth) for w, p in priors.items()}
    for one, other in itertools.combinations(priors, 2):
        if held[one] < held[other] - 0.01:
            assert true[one] < true[other], (one, other)
    assert min(held, key=held.get) == "its own"
    assert max(held, key=held.get) == "blank"


@pytest.mark.parametrize("name", "abcde")
def test_rules_are_ranked_as_the_ground_truth_ranks_them(name):
    """The drawing counted once, taken off at every reading, and none; once and taken
    off lie within 0.01 bits on e."""
    evidence, priors, truth = drive(name)
    ways = [
        (priors["its own"], "prior_once"),
        (priors["its own"], "subtract_prior"),
        (priors["blank"], "prior_once"),
    ]
    once, off, none = (held_out_bits(evidence, *way).bits for way in ways)
    true = [truth_bits(evidence, *way, truth) for way in ways]
    assert once < off + 0.01 < none
    assert true == sorted(true)

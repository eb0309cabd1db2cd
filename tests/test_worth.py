"""What a drawing is worth in readings: by hand, by definition, and on the samples."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    Grid,
    MappingRun,
    MapSettings,
    Measure,
    ParameterError,
    Prior,
    Region,
    Sensor,
    UpdateRule,
    fuse,
    load_sample,
    log_loss,
    prior_drawing,
    sample_names,
    score,
    scores_by_reading,
    worth_in_readings,
)
from occsim.metrics.worth import SAME_SCORE
from occsim.prior import prior_from_cells
from tests.test_metrics import log_of, logged_cases

BLANK = Prior.uninformative()
ONE = Grid(height_px=1, width_px=1, cell_px=1)
WALL = np.array([[True]])


def curves_of(
    log,
    prior,
    truth=WALL,
    is_wall=WALL,
    rule=UpdateRule.PRIOR_ONCE,
    region=Region.ALL,
):
    prior_map = prior_from_cells(is_wall, log.grid, prior)
    return scores_by_reading(log, prior_map, truth, rule, region, bits=True)


def test_a_drawing_that_is_as_sure_as_two_readings_by_hand():
    """A wall read four times as 0.3 free: odds of 7/3, 5.4, 12.7, 29.6 for wall.

    A prior of 0.18 has odds of 4.56, and 10.6 after one reading: as much as two
    readings, and as three. After two (24.8) four are needed, after three there are
    none that suffice.
    """
    log = log_of(ONE, [{0: 0.3}] * 4)
    drawing, blank = (curves_of(log, one) for one in (Prior(p_wall=0.2), BLANK))
    worth = [worth_in_readings(drawing, blank, n) for n in range(5)]
    assert worth == [2, 3, 4, None, None]


def test_a_wrong_drawing_is_worth_less_than_its_readings():
    """A wall drawn as space, 0.81 free: after four readings of 0.3 odds of 6.95."""
    log = log_of(ONE, [{0: 0.3}] * 4)
    drawing = curves_of(log, Prior(p_space=0.9), is_wall=~WALL)
    blank = curves_of(log, BLANK)
    assert worth_in_readings(drawing, blank, 0) == 0
    assert worth_in_readings(drawing, blank, 4) == 3


def test_f2_counts_only_walls_that_are_declared():
    """Two walls. The blank map declares the second at its third reading only."""
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    log = log_of(grid, [{0: 0.1, 1: 0.5}, {0: 0.1}, {1: 0.3}])
    walls = np.array([[True, True]])
    drawing, blank = (
        curves_of(log, one, walls, walls, region=Region.EXPLORED)
        for one in (Prior(), BLANK)
    )
    assert worth_in_readings(drawing, blank, 0, Measure.F2) is None  # nothing explored
    assert worth_in_readings(drawing, blank, 1, Measure.F2) == 3
    assert worth_in_readings(blank, drawing, 1, "f2") == 1


@settings(max_examples=100, deadline=None)
@given(
    case=logged_cases(),
    n=st.integers(0, 7),
    rule=st.sampled_from(UpdateRule),
    region=st.sampled_from(Region),
    measure=st.sampled_from(Measure),
)
def test_the_worth_is_that_of_its_definition(case, n, rule, region, measure):
    evidence, is_wall, truth = case
    n = min(n, evidence.n_readings)
    drawing, blank = (
        curves_of(evidence, prior, truth, is_wall, rule, region)
        for prior in (Prior(), BLANK)
    )

    def goodness(prior, n_readings):
        prior_map = prior_from_cells(is_wall, evidence.grid, prior)
        occupancy_map = fuse(evidence, prior_map, rule, n_readings)
        if measure is Measure.F2:
            return score(occupancy_map, truth, region).f2
        return -log_loss(occupancy_map, truth, region)

    worth = worth_in_readings(drawing, blank, n, measure)
    target = goodness(Prior(), n)
    reached = [
        m
        for m in range(evidence.n_readings + 1)
        if goodness(BLANK, m) >= target - SAME_SCORE
    ]
    assert worth == (reached[0] if reached else None)


def test_curves_that_cannot_be_compared_are_refused():
    log = log_of(ONE, [{0: 0.3}] * 2)
    curves, shorter = curves_of(log, BLANK), curves_of(log_of(ONE, [{}]), BLANK)
    with pytest.raises(ParameterError, match="over the same readings; got 2 and 1"):
        worth_in_readings(curves, shorter)
    without = scores_by_reading(log, prior_from_cells(WALL, ONE, BLANK), WALL)
    with pytest.raises(ParameterError, match="must hold bits"):
        worth_in_readings(without, without)
    assert worth_in_readings(without, without, 1, Measure.F2) == 1
    with pytest.raises(ParameterError, match="n_readings must be a whole number"):
        worth_in_readings(curves, curves, 3)


def run_of(name, behind_hit=BehindHit.UNSEEN, mask=None):
    sample = load_sample(name)
    sensor = Sensor(
        range_px=sample.sensor.range_px,
        fov_rad=sample.sensor.fov_rad,
        behind_hit=behind_hit,
    )
    return MappingRun(sample, MapSettings(sensor=sensor), prior_mask=mask)


@pytest.mark.parametrize("name", sample_names())
def test_a_sample_is_worth_more_than_its_whole_tour(name):
    """With its drawing, counted once, a robot that has not moved knows more, in bits
    over all cells, than the blank robot after all readings (science.md, point 5)."""
    run = run_of(name)
    assert run.worth_in_readings(Prior()) is None
    assert run.bits(Prior(), n_readings=0) < run.bits(BLANK)
    assert run.worth_in_readings(BLANK) == 0
    last = len(run.building.trajectory)
    assert run.worth_in_readings(BLANK, last) <= last


def test_a_wrong_drawing_is_worth_few_readings():
    """World c with the drawing of d and of c: the wrong one is passed on the tour."""
    worth = {
        which: run_of(
            "c", mask=prior_drawing(load_sample("c"), which)
        ).worth_in_readings(Prior())
        for which in ("c", "d", "empty")
    }
    assert worth["c"] is None
    assert worth["d"] is not None
    assert worth["d"] < len(load_sample("c").trajectory)


def test_a_run_compares_f2_over_the_cells_that_were_looked_at():
    run = run_of("c", BehindHit.OCCUPIED)
    ours, blank = (run.curves(one).f2 for one in (Prior(), BLANK))
    n = 40
    reached = np.flatnonzero(blank >= ours[n])
    expected = int(reached[0]) if reached.size else None
    assert run.worth_in_readings(Prior(), n, Measure.F2) == expected
    assert run.worth_in_readings(Prior(), n, "f2") == expected
    assert math.isnan(ours[0])

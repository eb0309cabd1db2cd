"""What the library's functions and parameters make of arguments of other types."""

import numpy as np
import pytest

from occsim import (
    Drawing,
    Grid,
    ParameterError,
    Prior,
    Region,
    Sensor,
    Trajectory,
    UpdateRule,
    World,
    build_prior,
    exact_front,
    fuse,
    score,
    scores_by_reading,
    sweep_priors,
)
from occsim.logodds import is_occupied, logit
from tests.test_metrics import log_of

GRID = Grid(height_px=1, width_px=2, cell_px=1)
WALL = np.array([[True, False]])
LOG = log_of(GRID, [{0: 0.1, 1: 0.9}, {0: 0.1}])
PRIOR_MAP = build_prior(WALL, GRID, Prior())
PAIR = [0.2], [0.9]

WITH_RULE = {
    "fuse": lambda rule: fuse(LOG, PRIOR_MAP, rule),
    "curves": lambda rule: scores_by_reading(LOG, PRIOR_MAP, WALL, rule),
    "sweep": lambda rule: sweep_priors(LOG, WALL, WALL, *PAIR, rule),
    "front": lambda rule: exact_front(LOG, WALL, WALL, rule),
}
WITH_REGION = {
    "score": lambda region: score(fuse(LOG, PRIOR_MAP), WALL, region),
    "curves": lambda region: scores_by_reading(LOG, PRIOR_MAP, WALL, region=region),
    "sweep": lambda region: sweep_priors(LOG, WALL, WALL, *PAIR, region=region),
    "front": lambda region: exact_front(LOG, WALL, WALL, region=region),
}


@pytest.mark.parametrize("call", WITH_RULE.values(), ids=WITH_RULE)
@pytest.mark.parametrize("rule", [*[r.value for r in UpdateRule], None])
def test_a_rule_in_quotes_is_refused_not_taken_for_the_other(call, rule):
    with pytest.raises(ParameterError, match=r"rule must be one of UpdateRule\.SUB"):
        call(rule)


@pytest.mark.parametrize("call", WITH_REGION.values(), ids=WITH_REGION)
@pytest.mark.parametrize("region", [*[r.value for r in Region], None])
def test_a_region_in_quotes_is_refused_not_taken_for_the_other(call, region):
    with pytest.raises(ParameterError, match=r"region must be one of Region\.EXPL"):
        call(region)


def test_lists_serve_as_arrays():
    cells = WALL.tolist()
    assert score(fuse(LOG, PRIOR_MAP), cells) == score(fuse(LOG, PRIOR_MAP), WALL)
    listed, given = (sweep_priors(LOG, c, c, *PAIR) for c in (cells, WALL))
    np.testing.assert_array_equal(listed.tp, given.tp)


def test_world_and_trajectory_may_be_given_by_place():
    assert World(WALL).shape == (1, 2)
    assert Trajectory([[0.5, 0.5, 0.0]]).poses.shape == (1, 3)


def test_numbers_of_single_precision_keep_exact_ties():
    """A prior of 0.9 and one reading of 0.1 cancel; in float32 they miss by 2e-7."""
    prior = Prior(p_wall=np.float32(1), p_space=np.float32(1))
    prior_map = build_prior(WALL, GRID, prior)
    assert prior_map.p_free.dtype == np.float64
    assert not is_occupied(prior_map.log_odds + logit(0.1)).any()
    sensor = Sensor(range_px=np.float32(20), fov_rad=np.int64(1))
    assert sensor == Sensor(range_px=20.0, fov_rad=1.0)
    assert isinstance(sensor.range_px, float)


@pytest.mark.parametrize("value", ["0.5", None, np.array([0.1, 0.2]), 1j])
def test_what_is_no_number_is_refused_in_a_sentence(value):
    with pytest.raises(ParameterError, match="p_wall must be a number; got"):
        Prior(p_wall=value)
    with pytest.raises(ParameterError, match="range_px must be a number; got"):
        Sensor(range_px=value)


def test_clearing_without_a_hit_is_true_or_false():
    assert Sensor(clear_no_hit=np.bool_(False)) == Sensor(clear_no_hit=False)
    with pytest.raises(ParameterError, match="clear_no_hit must be True or False"):
        Sensor(clear_no_hit="no")


def test_log_odds_beyond_probability_are_undefined_without_a_warning():
    np.testing.assert_array_equal(logit([-0.1, 1.1]), [np.nan, np.nan])


def test_a_drawing_leaves_its_callers_array_alone():
    pixels = np.zeros((4, 5, 3), dtype=np.uint8)
    drawing = Drawing(pixels)
    pixels[:] = 255
    assert not drawing.rgb.any()
    assert not drawing.rgb.flags.writeable

"""Pictures of maps, files of prior maps, and the recursion that is timed."""

import csv
import io
import json

import cv2
import numpy as np
import pytest

from occsim import (
    Grid,
    ParameterError,
    Prior,
    Region,
    UpdateRule,
    fuse,
    load_drawing,
)
from occsim.io.map_pictures import (
    OutcomeColours,
    belief_picture,
    change_picture,
    outcome_picture,
)
from occsim.io.prior_map import prior_csv, prior_json, prior_npy, prior_png
from occsim.mapping import OccupancyMap
from occsim.prior import prior_from_cells
from occsim.study.cost import fuse_stepwise, step_costs
from tests.test_metrics import log_of

COLOURS = OutcomeColours(
    hit="#010101",
    false_wall="#ff0000",
    missed_wall="#0000ff",
    free="#ffffff",
    unseen="#c8c8c8",
    hatch="#8f8f8f",
)
# 5 x 7 px in cells of 3: two rows and three columns, the last ones partial.
GRID = Grid(height_px=5, width_px=7, cell_px=3)
IS_WALL = np.array([[True, False, False], [False, True, False]])
PRIOR = Prior(p_wall=0.2, p_space=0.9)
PRIOR_MAP = prior_from_cells(IS_WALL, GRID, PRIOR)


def drawing():
    image = np.full((8, 9), 255, np.uint8)
    return load_drawing(cv2.imencode(".png", image)[1].tobytes(), name="plan.png")


def test_cells_become_squares_cut_at_the_edge():
    """p_free 0.9 * 0.2 = 0.18 is grey 46 (45.9), 0.9 * 0.9 = 0.81 is 207 (206.55)."""
    picture = belief_picture(PRIOR_MAP.p_free, GRID)
    expected = np.full((5, 7), 207)
    expected[:3, :3] = 46
    expected[3:, 3:6] = 46
    np.testing.assert_array_equal(picture, expected)


def test_zoom_makes_every_pixel_a_square():
    small = belief_picture(PRIOR_MAP.p_free, GRID)
    large = belief_picture(PRIOR_MAP.p_free, GRID, zoom=2)
    np.testing.assert_array_equal(large, small.repeat(2, axis=0).repeat(2, axis=1))


def test_a_picture_needs_the_grids_shape():
    with pytest.raises(ParameterError, match=r"\(2, 3\); got \(2, 2\)"):
        belief_picture(np.zeros((2, 2)), GRID)


def one_row_map():
    """Five cells: hit, false wall, missed wall, free, and one never read."""
    grid = Grid(height_px=1, width_px=5, cell_px=1)
    log_odds = np.array([[-1.0, -1.0, 0.0, 1.0, -1.0]])
    n_updates = np.array([[1, 1, 1, 1, 0]])
    truth = np.array([[True, False, True, False, True]])
    return OccupancyMap(grid, log_odds, n_updates), truth


def test_outcomes_have_their_colours():
    picture = outcome_picture(*one_row_map(), COLOURS)
    np.testing.assert_array_equal(
        picture[0],
        [[1, 1, 1], [255, 0, 0], [0, 0, 255], [255, 255, 255], [200, 200, 200]],
    )


def test_unscored_cells_are_hatched_and_all_cells_can_be_scored():
    """Of a 6 x 6 px cell every sixth pixel along each row is a hatching line."""
    grid = Grid(height_px=6, width_px=6, cell_px=6)
    unread = OccupancyMap(grid, np.array([[-1.0]]), np.array([[0]]))
    truth = np.array([[True]])
    picture = outcome_picture(unread, truth, COLOURS).reshape(-1, 3).tolist()
    assert picture.count([143, 143, 143]) == 6
    assert picture.count([200, 200, 200]) == 30
    everywhere = outcome_picture(unread, truth, COLOURS, Region.ALL)
    np.testing.assert_array_equal(everywhere, np.ones((6, 6, 3)))
    unexplored = outcome_picture(unread, truth, COLOURS, Region.UNEXPLORED)
    np.testing.assert_array_equal(unexplored, everywhere)


def test_changes_diverge_from_zero_and_stop_at_the_limit():
    grid = Grid(height_px=1, width_px=5, cell_px=1)
    change = np.array([[-9.0, -1.0, 0.0, 0.5, 1.0]])
    colours = ("#000000", "#808080", "#ff80ff")
    picture = change_picture(change, grid, colours)
    np.testing.assert_array_equal(
        picture[0],
        [[0, 0, 0], [0, 0, 0], [128, 128, 128], [192, 128, 192], [255, 128, 255]],
    )


def test_the_array_file_is_exact_and_needs_no_pickle():
    read = np.load(io.BytesIO(prior_npy(PRIOR_MAP)), allow_pickle=False)
    np.testing.assert_array_equal(read, PRIOR_MAP.p_free)


def test_the_table_has_a_line_for_each_row_of_cells():
    text = prior_csv(PRIOR_MAP)
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = [[float(value) for value in row] for row in csv.reader(lines)]
    np.testing.assert_allclose(rows, PRIOR_MAP.p_free, rtol=1e-11)
    assert lines[0] == "0.18,0.81,0.81"


def test_the_picture_file_has_the_drawings_size():
    data = np.frombuffer(prior_png(PRIOR_MAP), np.uint8)
    decoded = cv2.imdecode(data, cv2.IMREAD_UNCHANGED)
    np.testing.assert_array_equal(decoded, belief_picture(PRIOR_MAP.p_free, GRID))


def test_the_settings_make_the_same_prior_again():
    chosen_on = {"update_rule": "subtract_prior", "precision": float("nan")}
    document = json.loads(prior_json(PRIOR_MAP, PRIOR, drawing(), chosen_on))
    kept = document["prior"]
    again = Prior(**{name: kept[name] for name in ("p_wall", "p_space", "scale")})
    assert again == PRIOR
    assert kept["n_wall_cells"] == 2
    assert kept["n_unknown_cells"] == 0
    unknown = ~IS_WALL & (np.arange(IS_WALL.size).reshape(IS_WALL.shape) % 2 == 0)
    partly = prior_from_cells(IS_WALL, GRID, PRIOR, unknown)
    document = json.loads(prior_json(partly, PRIOR, drawing(), chosen_on))
    assert document["prior"]["n_unknown_cells"] == unknown.sum() > 0
    assert document["drawing"]["name"] == "plan.png"
    assert document["grid"]["n_rows"] == 2
    assert document["chosen_on"] == {"update_rule": "subtract_prior", "precision": None}
    assert document["software"]["occsim"]


EVIDENCE = log_of(GRID, [{0: 0.1, 1: 0.9}, {0: 0.3}, {1: 0.9, 4: 0.1, 5: 0.7}])


@pytest.mark.parametrize("rule", UpdateRule)
def test_the_recursion_gives_what_the_closed_form_gives(rule):
    stepwise = fuse_stepwise(EVIDENCE, PRIOR_MAP, rule)
    closed = fuse(EVIDENCE, PRIOR_MAP, rule)
    np.testing.assert_array_equal(stepwise.log_odds, closed.log_odds)
    np.testing.assert_array_equal(stepwise.n_updates, closed.n_updates)


def test_costs_come_one_for_each_prior_and_run():
    blank = prior_from_cells(IS_WALL, GRID, Prior.uninformative())
    costs = step_costs(EVIDENCE, [PRIOR_MAP, blank], repeats=3)
    assert [cost.seconds.shape for cost in costs] == [(3,), (3,)]
    for cost in costs:
        low, high = cost.range_us
        assert 0.0 < low <= cost.median_us <= high


def test_costs_need_a_run_and_one_grid():
    with pytest.raises(
        ParameterError, match="repeats must be a whole number, 1 to 1,000,000; got 0"
    ):
        step_costs(EVIDENCE, [PRIOR_MAP], repeats=0)
    other = Grid(height_px=5, width_px=7, cell_px=5)
    elsewhere = prior_from_cells(np.zeros(other.shape, bool), other, PRIOR)
    with pytest.raises(ParameterError, match="same grid"):
        fuse_stepwise(EVIDENCE, elsewhere)

"""The statements of the pages hold for the drawings that they show."""

import pytest

from occsim import (
    Prior,
    UpdateRule,
    collect_evidence,
    fuse,
    load_sample,
    sample_names,
    score,
    truth_cells,
)
from occsim.prior import prior_from_cells
from occsim.world import wall_cells

CELL_PX = 3


@pytest.fixture(scope="module", params=sample_names())
def recall(request):
    """Recall of a reference drawing by p_wall and update rule, p_space at 0.9."""
    building = load_sample(request.param)
    grid = building.world.grid(CELL_PX)
    log = collect_evidence(building.world, building.trajectory, building.sensor, grid)
    is_wall = wall_cells(building.wall_mask, grid)
    truth = truth_cells(building.world, grid)

    def at(p_wall, rule):
        prior_map = prior_from_cells(is_wall, grid, Prior(p_wall=p_wall, p_space=0.9))
        return score(fuse(log, prior_map, rule), truth).recall

    return at


def test_build_a_map_asks_what_p_wall_of_one_does_to_recall(recall):
    # "It rises ... Switch to prior once, and it falls."
    subtract, once = UpdateRule.SUBTRACT_PRIOR, UpdateRule.PRIOR_ONCE
    assert recall(1.0, subtract) > recall(0.2, subtract)
    assert recall(1.0, once) < recall(0.2, once)

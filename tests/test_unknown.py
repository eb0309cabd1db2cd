"""Cells of which a drawing says nothing: a robot's map of what it never saw."""

from dataclasses import replace

import numpy as np
import pytest

from occsim import (
    Corrections,
    Grid,
    MappingRun,
    MapSettings,
    Prior,
    Region,
    UpdateRule,
    build_prior,
    calibrated_prior,
    fuse,
    load_sample,
    log_loss,
    score,
    unknown_cells,
)
from occsim.imaging.transform import Transform
from occsim.io.metric import MetricFrame
from occsim.io.project import Project, dump_project, load_project
from occsim.io.ros_map import MapMode, RosMap, building_from_map, load_files, pack
from occsim.samples import prior_unknown
from occsim.study.claims.facts import facts_of

D = load_sample("d")
PAIRS = [(0.2, 0.9), (0.5, 0.5), (1.0, 0.1), (0.7, 1.0)]


def unknown(building=D):
    """The right third of a drawing, with the walls in it."""
    mask = np.zeros(building.drawing.shape, dtype=bool)
    mask[:, 2 * mask.shape[1] // 3 :] = True
    return mask


def run_of(building=None, cell_px=4):
    building = replace(D, unknown=unknown()) if building is None else building
    return MappingRun(building, MapSettings(cell_px=cell_px, sensor=building.sensor))


RUN = run_of()


def test_a_cell_is_unknown_where_half_of_it_is_and_none_of_it_is_wall():
    """Cells of 2 x 2 px: two unknown pixels; one; three and a wall; four."""
    pixels = np.array([[1, 0, 1, 0, 1, 1, 1, 1], [1, 0, 0, 0, 1, 0, 1, 1]], dtype=bool)
    grid = Grid(height_px=2, width_px=8, cell_px=2)
    is_wall = np.array([[False, False, True, False]])
    found = unknown_cells(pixels, is_wall, grid)
    np.testing.assert_array_equal(found, [[True, False, False, True]])
    walls = np.zeros((2, 8), dtype=bool)
    walls[1, 5] = True
    p_free = build_prior(walls, grid, Prior(), unknown=pixels).p_free
    np.testing.assert_allclose(p_free, [[0.5, 0.81, 0.18, 0.5]], rtol=1e-15)


@pytest.mark.parametrize("region", Region)
@pytest.mark.parametrize("rule", UpdateRule)
def test_surfaces_of_scores_and_bits_are_those_of_the_maps(rule, region):
    surface, loss = RUN.surface(rule, region), RUN.loss_surface(rule, region)
    for p_wall, p_space in PAIRS:
        prior = Prior(p_wall=p_wall, p_space=p_space)
        p_free = np.where(RUN.wall_cells, prior.p_free_wall, prior.p_free_space)
        p_free[RUN.unknown_cells] = 0.5
        start = RUN.prior_map(prior)
        np.testing.assert_array_equal(start.p_free, p_free)
        final = fuse(RUN.evidence, start, rule)
        scores = score(final, RUN.truth_cells, region)
        assert surface.counts(p_wall, p_space) == (scores.tp, scores.fp)
        bits = loss.bits(prior.p_free_wall, prior.p_free_space)
        assert bits == pytest.approx(log_loss(final, RUN.truth_cells, region))


def test_no_pair_changes_what_is_unknown_and_the_pair_is_calibrated_without_it():
    maps = [RUN.map(Prior(p_wall=p, p_space=1.0)) for p in (0.1, 1.0)]
    blank = RUN.map(Prior.uninformative())
    cells = RUN.unknown_cells
    assert 0.1 < cells.mean() < 0.4
    for one in maps:
        np.testing.assert_array_equal(one.log_odds[cells], blank.log_odds[cells])
    assert (maps[0].log_odds != maps[1].log_odds).any()
    known = ~cells
    assert RUN.calibrated == calibrated_prior(
        RUN.wall_cells[known], RUN.truth_cells[known]
    )
    assert RUN.calibrated != run_of(D).calibrated


def test_a_wall_drawn_by_hand_over_the_unknown_is_a_wall():
    added = np.zeros(D.drawing.shape, dtype=bool)
    added[40:44, -12:-8] = True
    drawn = replace(
        D,
        unknown=unknown(),
        corrections=Corrections.from_masks(added, np.zeros_like(added)),
    )
    before, after = (
        RUN.prior_map(Prior()).p_free,
        run_of(drawn).prior_map(Prior()).p_free,
    )
    (changed,) = {
        (before[at], after[at]) for at in map(tuple, np.argwhere(before != after))
    }
    assert changed == (0.5, Prior().p_free_wall)


def test_other_drawings_have_their_own_unknown():
    building = RUN.building
    np.testing.assert_array_equal(
        prior_unknown(building, "mirrored"), building.unknown[:, ::-1]
    )
    assert not prior_unknown(building, "empty").any()
    assert prior_unknown(building) is building.unknown
    empty = RUN.with_prior_mask(np.zeros_like(unknown()), prior_unknown(building, "c"))
    np.testing.assert_array_equal(empty.prior_map(Prior()).p_free, Prior().p_free_space)
    # Walls with errors, and the building's own unknown.
    other = RUN.with_prior_mask(np.zeros_like(unknown()))
    assert (other.prior_map(Prior()).p_free == 0.5).mean() == pytest.approx(
        1 / 3, abs=0.02
    )
    assert RUN.with_prior_mask(None) is RUN


def test_the_unknown_turns_with_the_drawing_and_is_part_of_the_digest():
    building = RUN.building
    assert building.digest != D.digest
    assert building.digest == replace(D, unknown=unknown()).digest
    turned = building.transformed(Transform.quarter_turns(building.drawing.shape, 1))
    np.testing.assert_array_equal(turned.unknown.sum(), building.unknown.sum())
    assert turned.unknown.shape == building.unknown.shape[::-1]


def test_a_project_keeps_the_unknown():
    opened = load_project(dump_project(Project(building=RUN.building))).building
    np.testing.assert_array_equal(opened.unknown, RUN.building.unknown)
    assert opened.digest == RUN.building.digest
    assert load_project(dump_project(Project(building=D))).building.unknown is None


def robots_map():
    """A room with a wall across, unknown outside and in a corner inside."""
    values = np.full((60, 90), -1)
    values[5:55, 5:85] = 0
    values[5:55, [5, 84]] = values[[5, 54], 5:85] = values[5:30, 40] = 100
    values[40:50, 60:80] = -1
    return RosMap(values, 0.05, (1.0, -2.0, 0.0))


def test_a_robots_map_stays_unknown_in_the_prior_and_in_its_export():
    ros_map = robots_map()
    run = run_of(building_from_map(ros_map), cell_px=1)
    prior_map = run.prior_map(Prior())
    np.testing.assert_array_equal(prior_map.p_free == 0.5, ros_map.is_unknown)
    frame = MetricFrame(height_px=60, metres_per_px=0.05, origin_x_m=1, origin_y_m=-2)
    out = RosMap.of_prior(prior_map, frame, run.unknown_cells)
    packed = pack(out, "prior", mode=MapMode.RAW)
    again = load_files({"prior.zip": packed})
    np.testing.assert_array_equal(again.is_unknown, ros_map.is_unknown)
    np.testing.assert_array_equal(again.is_occupied, ros_map.is_occupied)


def test_claims_are_judged_with_the_prior_that_leaves_the_unknown_alone():
    facts = next(iter(facts_of(RUN.building, 4)))
    np.testing.assert_array_equal(facts.is_unknown, RUN.unknown_cells)
    pair = 0.2, 0.9
    declared = facts.declared(*pair) & facts.scored
    tp, fp = facts.surface.counts(*pair)
    assert declared.sum() == tp + fp

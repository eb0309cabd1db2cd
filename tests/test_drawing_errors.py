"""The drawing's errors and the presets of conditions, as the pages use them."""

import numpy as np
import pytest

from occsim import DrawingFlaws, Region, UpdateRule, flawed_mask
from occsim.io.replay import unpack_walls
from pages._ui import compute, presets, replays
from pages._ui.choices import Preset, PriorDrawing
from pages._ui.settings import Settings, with_changes
from tests.test_pages import control, launch, said

BUILD = "pages/1_Build_a_map.py"


def settings(**changes):
    return with_changes(Settings(), changes)


def test_without_errors_the_prior_is_made_from_the_drawing():
    assert compute.prior_mask(compute.sample("d"), settings()) is None


def test_errors_touch_the_prior_and_neither_the_readings_nor_the_truth():
    building = compute.sample("d")
    plain = compute.run(building, settings())
    thinned = compute.run(building, settings(thickness_px=-2))
    assert thinned.evidence is plain.evidence
    assert thinned.mapped.truth_cells is plain.mapped.truth_cells
    expected = flawed_mask(building.wall_mask, DrawingFlaws(thickness_px=-2))
    np.testing.assert_array_equal(thinned.mapped.prior_mask, expected)
    assert thinned.mapped.wall_cells.sum() < plain.mapped.wall_cells.sum()


def test_the_player_replays_the_prior_of_the_drawing_with_its_errors():
    building = compute.sample("d")
    run = compute.run(building, settings(prior_drawing=PriorDrawing.E))
    parts = replays.replay(building, run.settings).parts
    [(walls, _)] = [unpack_walls(part.data) for part in parts if part.kind == "walls"]
    np.testing.assert_array_equal(walls, run.mapped.wall_cells)


def test_only_drawings_of_the_same_size_are_offered():
    offered = compute.prior_drawings(compute.sample("c"))
    assert {one.value for one in offered} == {"own", "mirrored", "empty", "d", "e"}


def test_a_drawing_chosen_for_a_building_of_another_size_is_not_used():
    asked = settings(prior_drawing=PriorDrawing.D)
    assert compute.prior_mask(compute.sample("a"), asked) is None


def test_errors_are_set_on_the_page_and_taken_back_at_once():
    app = launch(BUILD)
    app.slider(key=control(app, "thickness_px")).set_value(-2).run()
    assert app.session_state["settings"].thickness_px == -2
    next(one for one in app.button if one.label == "No errors").click()
    app.run()
    assert not app.exception
    assert app.session_state["settings"].flaws == DrawingFlaws()


# --- Presets --------------------------------------------------------------------------


def test_the_app_opens_by_bayes_rule():
    assert presets.current(Settings()) is Preset.BAYES


@pytest.mark.parametrize("preset", Preset)
def test_a_preset_is_left_by_any_of_its_parts(preset):
    chosen = settings(**presets.PRESETS[preset])
    assert presets.current(chosen) is preset
    left = with_changes(chosen, {"region": Region.ALL})
    assert presets.current(left) is None
    assert presets.departures(left, presets.nearest(left)) == ["scored region"]


def test_the_page_says_which_part_left_the_preset():
    app = launch(BUILD)
    app.segmented_control(key=control(app, "preset")).set_value(Preset.SOURCE).run()
    chosen = app.session_state["settings"]
    assert (chosen.rule, chosen.thickness_px) == (UpdateRule.SUBTRACT_PRIOR, -2)
    app.slider(key=control(app, "thickness_px")).set_value(-3).run()
    words = "\n".join(said(app.caption))
    assert "As in the source, but changed: thickness of the drawing's walls." in words

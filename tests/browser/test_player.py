"""The map player in a real browser: its numbers equal occsim's, its controls work."""

import numpy as np
import pytest

from occsim import Prior, Region, UpdateRule, fuse, log_loss, logit, score
from occsim.metrics import scores_by_reading
from occsim.prior import prior_from_cells
from pages._ui import words
from tests.browser.players import (
    CELL_PX,
    ROOT,
    choose,
    inspect,
    open_player,
    point_of,
    run,
    scrub,
    settled,
    shown,
    slide,
    wait_until,
)

pytestmark = pytest.mark.browser


REGIONS = {"looked": Region.EXPLORED, "unseen": Region.UNEXPLORED}


@pytest.mark.parametrize("rule", UpdateRule, ids=lambda value: value.value)
def test_scores_are_those_of_occsim_at_any_step_and_prior(page, app_url, rule):
    log, is_wall, truth = run()
    player = open_player(page, app_url)
    choose(player, "rule", rule.value)
    for p_wall, p_space in ((0.2, 0.9), (0.05, 1.0), (0.63, 0.31)):
        slide(player, "p_wall", p_wall)
        slide(player, "p_space", p_space)
        prior = Prior(p_wall=p_wall, p_space=p_space)
        prior_map = prior_from_cells(is_wall, log.grid, prior)
        for step in (0, 1, 137, log.n_readings, 136):
            scrub(player, step)
            now = fuse(log, prior_map, rule, n_readings=step)
            for name, region in REGIONS.items():
                at = score(now, truth, region)
                counts = [at.tp, at.fp, at.fn, at.tn]
                numbers = inspect(player, name)
                assert numbers["counts"] == counts, (step, name)
                bits = log_loss(now, truth, region)
                found = numbers["bits"]
                assert found == pytest.approx(bits, abs=1e-9) or np.isnan(bits)
            everywhere = log_loss(now, truth, Region.ALL)
            assert inspect(player, "bits") == pytest.approx(everywhere, abs=1e-9)
            assert shown(player, "explored") == [int((now.n_updates > 0).sum())]


def test_the_table_says_each_score_in_both_regions_and_the_blank_maps(page, app_url):
    log, is_wall, truth = run()
    player = open_player(page, app_url)
    scrub(player, 137)
    for prior, cells in (
        (Prior(), ".table tbody td:not(.blank)"),
        (Prior.uninformative(), ".table tbody td.blank"),
    ):
        start = prior_from_cells(is_wall, log.grid, prior)
        now = fuse(log, start, UpdateRule.PRIOR_ONCE, n_readings=137)
        expected = []
        for name in ("precision", "recall", "f2", "bits"):
            for region in REGIONS.values():
                at = score(now, truth, region)
                bits = name == "bits"
                value = log_loss(now, truth, region) if bits else getattr(at, name)
                expected.append(f"{value:.3f}" if bits else words.percent(value))
        assert player.locator(cells).all_inner_texts() == expected


@pytest.mark.parametrize("rule", UpdateRule)
def test_log_odds_are_those_of_occsim_after_walking_both_ways(page, app_url, rule):
    log, is_wall, _ = run()
    player = open_player(page, app_url)
    choose(player, "rule", rule.value)
    prior_map = prior_from_cells(is_wall, log.grid, Prior(p_wall=0.2, p_space=0.9))
    for step in (300, 37, 212):
        scrub(player, step)
        values = inspect(player, "logOdds")
        expected = fuse(log, prior_map, rule, n_readings=step).log_odds
        np.testing.assert_array_equal(values, expected.ravel())


def test_uninformative_prior_is_one_half_and_disables_the_sliders(page, app_url):
    log, is_wall, truth = run()
    player = open_player(page, app_url)
    player.get_by_label("uninformative prior").check()
    scrub(player, 250)
    prior_map = prior_from_cells(is_wall, log.grid, Prior.uninformative())
    at = scores_by_reading(log, prior_map, truth).at(250)
    assert shown(player, "tp", "fp", "fn", "tn") == [at.tp, at.fp, at.fn, at.tn]
    for name in ("p_wall", "p_space"):
        assert player.locator(f"[data-slider={name}] input").is_disabled()


def test_a_slider_shows_the_probability_that_it_sets(page, app_url):
    player = open_player(page, app_url)
    slide(player, "p_wall", 0.35)
    slide(player, "p_space", 0.8)
    words = player.locator(".slider small").all_inner_texts()
    assert words == ["pfree = 0.9 × 0.35 = 0.315", "pfree = 0.9 × 0.80 = 0.720"]


def test_keys_step_jump_and_play(page, app_url):
    last = run()[0].n_readings
    player = open_player(page, app_url)
    player.focus()
    steps = []
    for key in ("Home", "ArrowRight", "Shift+ArrowRight", "ArrowLeft", "End"):
        page.keyboard.press(key)
        steps += shown(player, "step")
    assert steps == [0, 1, 11, 10, last]
    page.keyboard.press("Space")  # from the end, play starts again
    wait_until(page, player, "root => root.dataset.step > 3 && root.dataset.step < 200")
    page.keyboard.press("Space")
    assert shown(player, "playing") == [0]


def test_replay_stops_at_the_last_reading(page, app_url):
    last = run()[0].n_readings
    player = open_player(page, app_url)
    scrub(player, last - 5)
    player.get_by_role("button", name="Play").click()
    wait_until(page, player, "root => root.dataset.playing === '0'")
    assert shown(player, "step") == [last]


def test_a_curve_scrubs_where_it_is_pressed(page, app_url):
    player = open_player(page, app_url)
    box = player.locator("[data-score=recall] canvas").bounding_box()
    page.mouse.click(box["x"] + 5, box["y"] + 20)
    assert shown(player, "step")[0] < 10
    page.mouse.click(box["x"] + box["width"] - 20, box["y"] + 20)
    assert shown(player, "step") == [run()[0].n_readings]


def most_read_wall_cell():
    log, is_wall, _ = run()
    counts = np.where(is_wall, log.totals()[1], 0)
    return int(counts.argmax())


def test_a_pinned_cell_shows_the_term_of_each_of_its_readings(page, app_url):
    """Under SUBTRACT_PRIOR reading k adds its log-odds less l_0, and they sum to l."""
    log, is_wall, _ = run()
    cell = most_read_wall_cell()
    player = open_player(page, app_url)
    choose(player, "rule", UpdateRule.SUBTRACT_PRIOR.value)
    page.mouse.click(*point_of(player, cell))
    scrub(player, log.n_readings)
    entries = np.flatnonzero(log.cell == cell)
    l_0 = float(logit(0.18))
    history = inspect(player, "history")
    assert history["prior"] == l_0
    assert [t["reading"] for t in history["terms"]] == log.reading[entries].tolist()
    added = [term["added"] for term in history["terms"]]
    np.testing.assert_array_equal(added, log.log_odds[entries] - l_0)
    prior_map = prior_from_cells(is_wall, log.grid, Prior())
    total = fuse(log, prior_map, UpdateRule.SUBTRACT_PRIOR).log_odds.flat[cell]
    assert l_0 + sum(added) == pytest.approx(total, abs=1e-9)
    facts = player.locator("[data-part=cell-facts]").inner_text()
    assert f"{abs(total):.3f}" in facts

    first = int(log.reading[entries[0]])
    box = player.locator("[data-part=terms]").bounding_box()
    page.mouse.click(box["x"] + inspect(player, "bars")[1], box["y"] + 20)
    assert shown(player, "step") == [first + 1]
    page.keyboard.press("Escape")
    assert player.locator("[data-part=tiles]").is_visible()


def test_hovering_shows_a_cells_numbers_on_both_pictures(page, app_url):
    log, is_wall, _ = run()
    cell = most_read_wall_cell()
    player = open_player(page, app_url)
    scrub(player, log.n_readings)
    page.mouse.move(*point_of(player, cell))
    card = player.locator(".card")
    card.wait_for()
    text = card.inner_text()
    assert "wall cell" in text
    assert "0.180" in text
    assert str(int(log.totals()[1].flat[cell])) in text
    final = fuse(log, prior_from_cells(is_wall, log.grid, Prior())).log_odds.flat[cell]
    assert f"declared\t{'wall' if final < -1e-9 else 'no wall'}" in text.replace(
        "\n", "\t"
    )
    assert inspect(player, "hover") == cell


def test_cells_can_be_inspected_and_pinned_by_keyboard(page, app_url):
    player = open_player(page, app_url)
    player.locator("[data-pane=map] canvas").focus()
    before = shown(player, "step")
    page.keyboard.press("ArrowRight")
    first = inspect(player, "hover")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    n_cols = run()[0].grid.n_cols
    assert inspect(player, "pin") == first + n_cols
    assert shown(player, "step") == before


def test_leaving_the_page_loses_nothing(page, app_url):
    player = open_player(page, app_url)
    slide(player, "p_wall", 0.55)
    choose(player, "overlay", "errors")
    scrub(player, 99)
    settled(page)
    page.get_by_test_id("stPageLink").get_by_text("Home").click()
    page.wait_for_selector(f"{ROOT}.compact[data-ready='1']")
    page.get_by_test_id("stPageLink").get_by_text("Build a map").first.click()
    page.wait_for_selector(f"{ROOT}[data-step='99']")
    player = page.locator(ROOT)
    assert player.evaluate("root => root.dataset.pWall") == "0.55"
    assert player.locator("input[name=overlay][value=errors]").is_checked()


def test_another_cell_size_in_mid_play_stops_and_keeps_the_step(page, app_url):
    player = open_player(page, app_url)
    slide(player, "p_space", 0.6)
    scrub(player, 100)
    settled(page)
    player.get_by_role("button", name="Play").click()
    wait_until(page, player, "root => root.dataset.step > 105")
    slider = page.get_by_test_id("stSlider").filter(has_text="Cell size")
    slider.get_by_role("slider").press("ArrowRight")
    wait_until(page, player, "root => root.dataset.cellPx === '4'")
    (step,) = shown(player, "step")
    assert shown(player, "playing") == [0]
    assert step > 105
    settled(page)
    assert shown(player, "step") == [step]
    assert player.evaluate("root => root.dataset.pSpace") == "0.6"


def test_a_telephone_shows_everything_in_one_column(page, app_url):
    page.set_viewport_size({"width": 390, "height": 844})
    player = open_player(page, app_url)
    wide = "() => document.documentElement.scrollWidth - window.innerWidth"
    assert page.evaluate(wide) <= 0
    frame = player.bounding_box()
    for part in player.locator("canvas, button, input, select").all():
        if not part.is_visible():
            continue
        box = part.bounding_box()
        assert box["x"] >= frame["x"] - 1
        assert box["x"] + box["width"] <= frame["x"] + frame["width"] + 1
    for button in player.locator(".transport button, .transport select").all():
        box = button.bounding_box()
        assert min(box["width"], box["height"]) >= 44


def test_a_hidden_player_waits_and_comes_back_whole(page, app_url):
    """A page that is left has no width for a moment, so nothing can be drawn on it."""
    player = open_player(page, app_url)
    player.get_by_role("button", name="Play").click()
    before = player.locator("[data-pane=map] canvas").bounding_box()
    player.evaluate("root => { root.style.display = 'none'; }")
    wait_until(page, player, "root => root.inspect().scale === 0")
    player.evaluate("root => { root.style.display = ''; }")
    wait_until(page, player, "root => root.inspect().scale > 0")
    assert player.locator("[data-pane=map] canvas").bounding_box() == before


REPLAY_SETTINGS = {
    "cell_px": ("Cell size", "ArrowRight"),
    "range_px": ("Range", "ArrowRight"),
    "fov_deg": ("Field of view", "ArrowRight"),
    "behind_hit": ("Unseen", None),
    "clear_no_hit": ("A ray that meets nothing", None),
    "wall_share": ("Wall share of the prior", "End"),
    "truth_share": ("Wall share of the ground truth", "End"),
}
"""Settings that send the player another replay: label on the page, key or click."""


def change(page, player, name):
    """Change a setting of the page by hand; wait for the replay that follows."""
    label, key = REPLAY_SETTINGS[name]
    before = player.evaluate("root => root.player.header.digest")
    is_hidden = name not in ("cell_px", "range_px", "fov_deg")
    if is_hidden:
        page.get_by_role("button", name="More settings").click()
    if key:
        slider = page.get_by_test_id("stSlider").filter(has_text=label)
        slider.get_by_role("slider").press(key)
    else:
        page.get_by_text(label).first.click()
    page.wait_for_function(
        "([root, before]) => root.player.header.digest !== before",
        arg=[player.element_handle(), before],
    )
    if is_hidden:
        page.keyboard.press("Escape")
    settled(page)


@pytest.mark.parametrize("name", REPLAY_SETTINGS)
def test_a_pinned_cell_outlives_a_change_of_each_setting(page, app_url, name):
    """The pin stays on the same point of the drawing; map, play and scrub go on."""
    log, _, _ = run()
    player = open_player(page, app_url)
    cell = log.grid.n_cells - 2
    page.mouse.click(*point_of(player, cell))
    scrub(player, 200)
    settled(page)
    change(page, player, name)
    now = run(CELL_PX + 1)[0].grid if name == "cell_px" else log.grid
    row, col = divmod(cell, log.grid.n_cols)
    x, y = (col + 0.5) * CELL_PX, (row + 0.5) * CELL_PX
    pinned = int(y // now.cell_px) * now.n_cols + int(x // now.cell_px)
    assert inspect(player, "pin") == pinned
    row, col = divmod(pinned, now.n_cols)
    title = player.locator("[data-part=cell-name]").inner_text()
    assert title == f"Cell row {row}, column {col}"
    assert shown(player, "step") == [200]
    scrub(player, 10)
    player.get_by_role("button", name="Play").click()
    wait_until(page, player, "root => root.dataset.step > 12")


def test_the_numbers_shown_after_a_change_of_cell_size_are_the_new_ones(page, app_url):
    """A restored player scores and draws the new data, not its previous data."""
    player = open_player(page, app_url)
    page.mouse.click(*point_of(player, most_read_wall_cell()))
    scrub(player, 200)
    settled(page)
    change(page, player, "cell_px")
    log, is_wall, truth = run(CELL_PX + 1)
    prior_map = prior_from_cells(is_wall, log.grid, Prior())
    at = scores_by_reading(log, prior_map, truth, UpdateRule.PRIOR_ONCE).at(200)
    assert shown(player, "tp", "fp", "fn", "tn") == [at.tp, at.fp, at.fn, at.tn]


COUNT_WHAT_IS_HEARD = """root => {
  root.heard = [];
  const live = "output, [role=status], [role=alert], [aria-live]:not([aria-live=off])";
  for (const region of root.querySelectorAll(live)) {
    new MutationObserver(() => root.heard.push(region.textContent)).observe(
      region, { childList: true, characterData: true, subtree: true });
  }
}"""


def test_a_screen_reader_hears_the_scores_when_the_replay_pauses(page, app_url):
    player = open_player(page, app_url)
    player.evaluate(COUNT_WHAT_IS_HEARD)
    player.get_by_role("button", name="Play").click()
    (step,) = shown(player, "step")
    wait_until(page, player, f"root => root.dataset.step > {step + 10}")
    assert player.evaluate("root => root.heard") == []
    player.get_by_role("button", name="Pause").click()
    wait_until(page, player, "root => root.heard.length")
    (said,) = player.evaluate("root => root.heard")
    (step,) = shown(player, "step")
    recall = player.locator("[data-value='looked recall']").inner_text()
    assert said.startswith(f"reading {step} of {run()[0].n_readings}: looked at: ")
    assert f"Recall {recall}" in said


def test_a_screen_reader_hears_the_pinned_cell(page, app_url):
    player = open_player(page, app_url)
    player.evaluate(COUNT_WHAT_IS_HEARD)
    player.locator("[data-pane=map] canvas").focus()
    page.keyboard.press("ArrowRight")
    (hovered,) = player.evaluate("root => root.heard")
    page.keyboard.press("Enter")
    wait_until(page, player, "root => root.heard.length > 1")
    *_, pinned = player.evaluate("root => root.heard")
    n_cols = run()[0].grid.n_cols
    row, col = divmod(inspect(player, "pin"), n_cols)
    for said in (hovered, pinned):
        assert f"Cell row {row}, column {col}: class " in said
        assert "p_free 0." in said


def test_a_document_imposed_in_mid_play_stops_the_replay(page, app_url):
    player = open_player(page, app_url)
    (rev,) = shown(player, "rev")
    slide(player, "p_wall", 0.5)
    settled(page)
    player.get_by_role("button", name="Play").click()
    page.get_by_role("button", name="Reset all").click()
    wait_until(page, player, f"root => root.dataset.rev > {rev}")
    (step,) = shown(player, "step")
    assert shown(player, "playing") == [0]
    settled(page)
    assert shown(player, "step") == [step]
    assert player.evaluate("root => root.dataset.pWall") == "0.2"

"""Two maps on one clock in a real browser: what it shows is what occsim computes."""

import re
from functools import cache

import numpy as np
import pytest

from occsim import (
    MappingRun,
    MapSettings,
    Measure,
    Prior,
    Region,
    UpdateRule,
    calibrated_prior,
    load_sample,
    log_loss,
    prior_drawing,
    score,
)
from occsim.logodds import is_occupied
from pages._ui import palette, words
from tests.browser.players import ROOT, inspect, scrub, settled, wait_until
from tests.browser.test_painted_pixels import decoded, rgb
from tests.browser.test_player import COUNT_WHAT_IS_HEARD

pytestmark = pytest.mark.browser

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
REGIONS = {"looked": Region.EXPLORED, "unseen": Region.UNEXPLORED}


@cache
def run(cell_px=3, drawing="own"):
    """Sample c as the page opens it, the prior made from some drawing."""
    sample = load_sample("c")
    made = MappingRun(sample, MapSettings(cell_px=cell_px, sensor=sample.sensor))
    return made.with_prior_mask(prior_drawing(sample, drawing))


def open_maps(page, app_url, query=""):
    page.goto(f"{app_url}/Two_maps{query}")
    page.wait_for_selector(f"{ROOT}.several[data-ready='1']")
    return page.locator(ROOT)


def choose_word(player, column, word, value):
    """Choose a word of a map's header, as a list offers it."""
    header = player.locator(f"[data-header='{column}']")
    if not header.locator(f"[data-for={word}]").is_visible():
        header.locator(".more").click()
    header.locator(f"[data-word={word}]").select_option(value)


def assert_map(numbers, now, truth):
    """A map's numbers in the browser are those of occsim's map."""
    np.testing.assert_array_equal(numbers["logOdds"], now.log_odds.ravel())
    for name, region in REGIONS.items():
        at = score(now, truth, region)
        assert numbers[name]["counts"] == [at.tp, at.fp, at.fn, at.tn]
        bits = log_loss(now, truth, region)
        assert np.isnan(bits) or numbers[name]["bits"] == pytest.approx(bits, abs=1e-9)
    assert numbers["bits"] == pytest.approx(log_loss(now, truth), abs=1e-9)


def counts_of(player, where):
    """The referee's counts: how often the maps differ, A is right, B is."""
    shown = [player.locator(f"[data-count='{where} {i}']") for i in (2, 0, 1)]
    return [int(count.inner_text().replace(",", "")) for count in shown]


def expected_counts(a, b, truth, looked):
    walls = [is_occupied(one.log_odds) for one in (a, b)]
    differ = (walls[0] != walls[1]) & looked
    right = [int((differ & (wall == truth)).sum()) for wall in walls]
    return [int(differ.sum()), *right]


def test_it_opens_with_both_rules_at_the_start_and_asks_first(page, app_url):
    player = open_maps(page, app_url)
    page.wait_for_url(re.compile("drawing=c"))
    assert player.evaluate("root => root.dataset.step") == "0"
    assert (
        "which map will find more"
        in player.locator("[data-part=question]").inner_text()
    )
    assert player.locator(".header .differs > span").all_inner_texts() == [
        "once",
        "taken off at every reading",
    ]
    assert "0.2, 0.9" in player.locator("[data-part=same]").inner_text()


def test_an_answer_starts_the_tour_which_lasts_ten_seconds(page, app_url):
    """All numbers at its end are those of occsim, and so are the words."""
    of, last = run(), run().evidence.n_readings
    player = open_maps(page, app_url)
    player.evaluate("""root => {
        root.began = performance.now();
        new MutationObserver(() => {
            if (root.dataset.playing === "0") root.ended = performance.now();
        }).observe(root, { attributes: true, attributeFilter: ["data-playing"] });
        root.querySelector("[data-answer='0']").click();
    }""")
    wait_until(page, player, f"root => root.dataset.step === '{last}'")
    wait_until(page, player, "root => root.ended")
    assert 9 < player.evaluate("root => (root.ended - root.began) / 1000") < 15
    maps = [of.map(Prior(), rule) for rule in (ONCE, SUBTRACT)]
    for numbers, now in zip(inspect(player, "maps"), maps, strict=True):
        assert_map(numbers, now, of.truth_cells)
    scores = [of.scores(Prior(), rule) for rule in (ONCE, SUBTRACT)]
    found = [f"{at.tp} of {at.tp + at.fn}" for at in scores]
    said = player.locator("[data-part=question]").inner_text()
    assert said == (
        f"You said: A. Of the walls looked at, A finds {found[0]}, B finds {found[1]}."
    )
    blank = of.scores(Prior.uninformative())
    f2 = [f"{words.percent(at.f2)}" for at in (*scores, blank)]
    names = [
        f"{name} {value}" for name, value in zip(("A", "B", "blank"), f2, strict=True)
    ]
    assert player.locator("[data-score=f2] .values span").all_inner_texts() == names
    looked = maps[0].n_updates > 0
    for where, cells in (("looked", looked), ("unseen", ~looked)):
        expected = expected_counts(*maps, of.truth_cells, cells)
        assert counts_of(player, where) == expected


def test_the_counts_follow_every_step_in_both_directions(page, app_url):
    of = run()
    player = open_maps(page, app_url)
    for step in (40, 300, 299, 123):
        scrub(player, step)
        maps = [of.map(Prior(), rule, step) for rule in (ONCE, SUBTRACT)]
        looked = maps[0].n_updates > 0
        expected = expected_counts(*maps, of.truth_cells, looked)
        assert counts_of(player, "looked") == expected, step


def samples_of(player, view, grid):
    """The painted colour in the middle of each cell of a view."""
    url = player.locator("canvas").nth(view).evaluate("canvas => canvas.toDataURL()")
    picture = decoded(url).astype(np.float64)
    k = picture.shape[1] / grid.width_px
    rows = ((np.arange(grid.n_rows) + 0.5) * grid.cell_px * k).astype(int)
    cols = ((np.arange(grid.n_cols) + 0.5) * grid.cell_px * k).astype(int)
    return picture[np.ix_(rows, cols)]


def test_each_map_and_their_difference_are_painted_as_occsim_has_them(page, app_url):
    """Cells that were looked at, but for those under the robot and its cone."""
    of, step = run(), 300
    player = open_maps(page, app_url)
    scrub(player, step)
    maps = [of.map(Prior(), rule, step) for rule in (ONCE, SUBTRACT)]
    looked = maps[0].n_updates > 0
    for view, now in enumerate(maps):
        samples = samples_of(player, view, of.grid)
        grey = np.rint(255 * now.p_free)[:, :, None]
        close = (np.abs(samples - grey) <= 1.01).all(axis=-1)
        assert close[looked].mean() > 0.97
    walls = [is_occupied(one.log_odds) for one in maps]
    right = np.where(walls[0] == of.truth_cells, 0, 1)
    colours = np.array([rgb(one) for one in palette.COLUMNS])[right]
    same = np.where(walls[0][:, :, None], rgb(palette.UNSEEN), rgb(palette.FREE))
    expected = np.where((walls[0] != walls[1])[:, :, None], colours, same)
    close = (np.abs(samples_of(player, 2, of.grid) - expected) <= 1.01).all(axis=-1)
    assert close[looked].mean() > 0.99


def test_another_drawing_for_one_map_sends_its_walls_and_no_readings(page, app_url):
    player = open_maps(page, app_url, "?step=200")
    choose_word(player, 1, "drawing", "mirrored")
    wait_until(
        page,
        player,
        "root => root.player.columns[1].drawn !== root.player.columns[0].drawn",
    )
    sizes = player.evaluate("root => root.player.header.sizes")
    kinds = player.evaluate("root => root.player.header.parts.map(({ kind }) => kind)")
    sent = [kind for kind, size in zip(kinds, sizes, strict=True) if size]
    assert sent == ["walls"]
    mirrored = run(drawing="mirrored")
    assert_map(
        inspect(player, "maps")[1],
        mirrored.map(Prior(), SUBTRACT, 200),
        mirrored.truth_cells,
    )
    bold = player.locator("[data-header='1'] .differs > span").all_inner_texts()
    assert bold == ["its mirror image", "taken off at every reading"]
    player.evaluate("root => { root.seen = root.player.loading; }")
    choose_word(player, 1, "drawing", "own")  # known: at once, without Python
    assert player.evaluate(
        "root => root.player.columns[1].drawn === root.player.columns[0].drawn"
        " && root.seen === root.player.loading"
    )
    assert player.evaluate("root => Number(root.dataset.recolourMs)") < 300


def test_prior_and_rule_are_changed_in_the_header(page, app_url):
    of = run()
    player = open_maps(page, app_url, "?step=200")
    choose_word(player, 1, "rule", "prior_once")
    choose_word(player, 1, "pair", "calibrated")
    p_wall, p_space = calibrated_prior(of.wall_cells, of.truth_cells)
    calibrated = Prior(p_wall=p_wall, p_space=p_space, scale=1.0)
    assert_map(
        inspect(player, "maps")[1], of.map(calibrated, ONCE, 200), of.truth_cells
    )
    choose_word(player, 1, "pair", "hand")
    player.locator("[data-header='1'] [data-hand=p_wall]").fill("0.55")
    assert_map(
        inspect(player, "maps")[1],
        of.map(Prior(p_wall=0.55), ONCE, 200),
        of.truth_cells,
    )
    choose_word(player, 1, "drawing", "none")
    assert_map(
        inspect(player, "maps")[1],
        of.map(Prior.uninformative(), ONCE, 200),
        of.truth_cells,
    )


def test_maps_of_other_cells_are_compared_in_pixels_which_the_page_says(page, app_url):
    step = 250
    player = open_maps(page, app_url, f"?step={step}&columns=--z5")
    runs = run(), run(5)
    maps = [one.map(Prior(), ONCE, step) for one in runs]
    for numbers, now, of in zip(inspect(player, "maps"), maps, runs, strict=True):
        assert_map(numbers, now, of.truth_cells)
    height, width = runs[0].building.world.occupied.shape

    def pixels(cells, of):
        side = of.settings.cell_px
        grown = cells.repeat(side, axis=0).repeat(side, axis=1)
        return grown[:height, :width]

    walls = [
        pixels(is_occupied(now.log_odds), of)
        for now, of in zip(maps, runs, strict=True)
    ]
    looked = np.logical_and(
        *(pixels(now.n_updates > 0, of) for now, of in zip(maps, runs, strict=True))
    )
    truth = runs[0].building.world.occupied
    for where, at in (("looked", looked), ("unseen", ~looked)):
        differ = (walls[0] != walls[1]) & at
        right = [int((differ & (wall == truth)).sum()) for wall in walls]
        assert counts_of(player, where) == [int(differ.sum()), *right]
    assert "pixel by pixel" in player.locator(".note").inner_text()


def test_what_a_drawing_is_worth_is_what_occsim_says(page, app_url):
    of = run()
    player = open_maps(page, app_url)
    for step in (0, 60, 455):
        scrub(player, step)
        texts = player.locator(".worth").all_inner_texts()
        for text, rule in zip(texts, (ONCE, SUBTRACT), strict=True):
            bits, f2 = (
                of.worth_in_readings(Prior(), step, measure, rule)
                for measure in (Measure.BITS, Measure.F2)
            )
            found = re.findall(r"after (\d+) reading|never on this tour", text)
            # Before the first reading there is no F2.
            worths = (bits,) if step == 0 else (bits, f2)
            assert found == ["" if n is None else str(n) for n in worths]


def test_a_count_pins_the_next_such_cell_whose_ladders_end_at_the_maps(page, app_url):
    of, last = run(), run().evidence.n_readings
    player = open_maps(page, app_url, f"?step={last}")
    maps = [of.map(Prior(), rule) for rule in (ONCE, SUBTRACT)]
    walls = [is_occupied(one.log_odds) for one in maps]
    b_is_right = (walls[0] != walls[1]) & (walls[1] == of.truth_cells)
    cells = np.flatnonzero(b_is_right & (maps[0].n_updates > 0))
    pinned = []
    for _ in range(2):
        player.locator("[data-count='looked 1']").click()
        pinned.append(inspect(player, "pin"))
    assert pinned == [cells[0], cells[1 % cells.size]]
    for i, numbers in enumerate(inspect(player, "maps")):
        history = numbers["history"]
        total = maps[i].log_odds.flat[pinned[-1]]
        assert history["terms"][-1]["total"] == total
        off = {term["off"] for term in history["terms"]}
        assert off == ({0} if i == 0 else {-history["prior"]})
        verdict = player.locator(".verdict").nth(i).inner_text()
        declared = "wall" if walls[i].flat[pinned[-1]] else "no wall"
        truth = "wall" if of.truth_cells.flat[pinned[-1]] else "free"
        assert verdict.endswith(f"declared {declared}; in truth {truth}")


def test_the_cursor_is_at_the_same_place_in_all_views(page, app_url):
    player = open_maps(page, app_url)
    box = player.locator("[data-pane=difference] canvas").bounding_box()
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 0.6 * box["height"])
    x, y = player.evaluate("root => root.player.hover")
    assert (x // 3, y // 3) == (0.3 * 300 // 3, 0.6 * 240 // 3)
    assert "A declares" in player.locator(".card").inner_text()


def test_settings_step_and_pin_survive_a_reload(page, app_url):
    player = open_maps(page, app_url)
    player.get_by_role("button", name="Add a third map").click()
    choose_word(player, 2, "drawing", "none")
    scrub(player, 77)
    player.locator("[data-pane=map] canvas").first.click(position={"x": 60, "y": 90})
    settled(page)
    before = player.evaluate("root => root.player.state")
    page.reload()
    page.wait_for_selector(f"{ROOT}[data-step='77']")
    after = page.locator(ROOT).evaluate("root => root.player.state")
    assert after["columns"] == before["columns"]
    assert len(after["columns"]) == 3
    assert after["pin_px"] == pytest.approx(before["pin_px"], rel=1e-4)


def test_keys_play_and_step_and_a_screen_reader_hears_only_the_pause(page, app_url):
    player = open_maps(page, app_url)
    player.focus()
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("ArrowRight")
    assert player.evaluate("root => root.dataset.step") == "11"
    settled(page)
    player.evaluate(COUNT_WHAT_IS_HEARD)
    page.keyboard.press("Space")
    wait_until(page, player, "root => root.dataset.step > 60")
    assert player.evaluate("root => root.heard") == []
    page.keyboard.press("Space")
    wait_until(page, player, "root => root.heard.length")
    [said] = player.evaluate("root => root.heard")
    assert "map A, looked at: Precision" in said
    assert "map B, looked at: Precision" in said


@pytest.mark.parametrize("columns", ["", "&columns=--u1--z1"])
def test_a_telephone_shows_all_maps_in_one_column_with_one_transport(
    page, app_url, columns
):
    page.set_viewport_size({"width": 390, "height": 844})
    player = open_maps(page, app_url, f"?step=99{columns}")
    wide = "() => document.documentElement.scrollWidth - window.innerWidth"
    assert page.evaluate(wide) <= 0
    boxes = [canvas.bounding_box() for canvas in player.locator(".pane canvas").all()]
    assert all(box["x"] >= 0 and box["x"] + box["width"] <= 390 for box in boxes)
    tops = [box["y"] for box in boxes]
    assert tops == sorted(tops)
    assert len({box["width"] for box in boxes}) == 1
    # The transport stays in sight while the maps are looked at.
    assert player.locator("[data-do=play]").bounding_box()["y"] < 844


def test_too_much_is_refused_in_a_sentence_and_the_maps_stay(page, app_url):
    """One pixel cells, a whole turn and the longest range are too many updates."""
    player = open_maps(page, app_url, "?range_px=300&fov_deg=360&columns=--z1")
    assert "choose larger cells" in page.get_by_test_id("stAlert").inner_text()
    assert player.evaluate("root => root.player.columns.length") == 2

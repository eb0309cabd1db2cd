"""The home page as a visitor meets it: watch, vote, let it drive on, flip."""

import pytest

from occsim import (
    MappingRun,
    MapSettings,
    Prior,
    Region,
    UpdateRule,
    load_sample,
    prior_drawing,
)
from pages._ui import glossary, home, words
from pages._ui.columns import HOME_SAMPLE
from tests.browser.players import settled, wait_until

pytestmark = pytest.mark.browser

PLAYER = ".player.compact[data-ready='1']"
ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
ANSWERS = ["No drawing", "Its own drawing", "The wrong drawing"]
LAST = len(load_sample(HOME_SAMPLE).trajectory)
HALF = LAST // 2


def number(text):
    return int(text.replace(",", ""))


def open_home(page, app_url):
    page.goto(app_url)
    page.wait_for_selector(PLAYER)
    return page.locator(PLAYER)


def go_to_half(page, player):
    """What playing for some seconds would come to; the rest is played."""
    player.evaluate(f"root => {{ root.player.position = {HALF - 3}; }}")
    wait_until(page, player, f"root => root.dataset.step === '{HALF}'")


def vote(page, player, answer):
    player.get_by_role("button", name=answer).click()
    player.evaluate(f"root => {{ root.player.position = {LAST - 3}; }}")
    wait_until(page, player, f"root => root.dataset.step === '{LAST}'")
    settled(page)


def maps():
    """The three maps by occsim: run and prior."""
    sample = load_sample(HOME_SAMPLE)
    run = MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))
    other = run.with_prior_mask(prior_drawing(sample, "d"))
    return [(run, Prior.uninformative()), (run, Prior()), (other, Prior())]


def assert_counts(player, step, rule):
    """Under each map stands what occsim counts."""
    shown = player.locator(".tally").all()
    for tally, (run, prior) in zip(shown, maps(), strict=True):
        for name, region in (
            ("looked", Region.EXPLORED),
            ("unseen", Region.UNEXPLORED),
        ):
            at = run.scores(prior, rule, region, n_readings=step)
            found = [
                number(tally.locator(f"[data-tally='{name} {part}']").inner_text())
                for part in ("found", "walls", "false")
            ]
            assert found == [at.tp, at.tp + at.fn, at.fp]


def test_a_visitor_watches_votes_and_flips_the_switch(page, app_url):
    player = open_home(page, app_url)
    telling = player.locator("[data-part=telling]")
    # It plays by itself, from the first reading.
    wait_until(page, player, "root => Number(root.dataset.step) > 3")
    assert telling.inner_text().startswith("Where the robot looks, it finds out.")
    assert player.get_by_role("button", name=ANSWERS[0]).is_hidden()

    go_to_half(page, player)
    assert player.evaluate("root => root.dataset.playing") == "0"
    assert telling.inner_text() == "Which will be best when it has seen every room?"
    assert_counts(player, HALF, ONCE)
    assert player.get_by_role("radio", name="once").is_hidden()

    vote(page, player, ANSWERS[0])
    said = "You said: no drawing. Best where the robot looked: its own drawing."
    assert telling.inner_text() == said
    assert_counts(player, LAST, ONCE)
    assert page.get_by_text(home.FINDING).count() == 0

    player.get_by_text("again at every reading").click()
    finding = page.get_by_role("link", name=home.FINDING)
    finding.wait_for()
    assert_counts(player, LAST, SUBTRACT)
    for shown, (run, prior) in zip(
        player.locator("[data-tally=f2]").all_inner_texts(), maps(), strict=True
    ):
        f2 = [words.percent(run.scores(prior, rule).f2) for rule in (ONCE, SUBTRACT)]
        assert shown == " → ".join(f2)
    player.get_by_text("once", exact=True).click()
    finding.wait_for(state="detached")
    assert_counts(player, LAST, ONCE)

    player.get_by_text("again at every reading").click()
    finding.click()
    page.wait_for_url("**/Two_maps*")


def test_the_answer_is_still_there_after_another_page(page, app_url):
    player = open_home(page, app_url)
    go_to_half(page, player)
    vote(page, player, ANSWERS[2])
    page.get_by_role("link", name="Build a map").first.click()
    page.wait_for_selector(".player:not(.compact)[data-ready='1']")
    page.get_by_role("link", name="Home").first.click()
    player = page.locator(PLAYER)
    player.wait_for()
    assert (
        player.locator("[data-part=telling]")
        .inner_text()
        .startswith("You said: the wrong drawing.")
    )
    shown = player.evaluate("root => [root.dataset.step, root.player.playing]")
    assert shown == [str(LAST), False]
    assert page.get_by_text("(visited, predicted)").count() == 1


def test_space_pauses_and_plays_without_a_click_before(page, app_url):
    player = open_home(page, app_url)
    wait_until(page, player, "root => Number(root.dataset.step) > 3")
    page.keyboard.press("Space")
    (step, playing) = player.evaluate("r => [r.dataset.step, r.dataset.playing]")
    assert playing == "0"
    # No other key moves it.
    page.keyboard.press("End")
    assert player.evaluate("root => root.dataset.step") == step
    page.keyboard.press("Space")
    wait_until(page, player, f"root => Number(root.dataset.step) > {int(step) + 2}")


def test_the_question_is_answered_with_the_keyboard(page, app_url):
    player = open_home(page, app_url)
    go_to_half(page, player)
    player.get_by_role("button", name=ANSWERS[1]).focus()
    page.keyboard.press("Space")
    wait_until(page, player, f"root => Number(root.dataset.step) > {HALF + 2}")
    page.keyboard.press("Space")  # the focus is on the maps now
    assert player.evaluate("root => root.dataset.playing") == "0"


def test_who_wants_no_motion_starts_it_alone(chromium, app_url):
    context = chromium.new_context(reduced_motion="reduce")
    page = context.new_page()
    player = open_home(page, app_url)
    page.wait_for_timeout(800)
    assert player.evaluate("root => root.dataset.step") == "0"
    player.get_by_role("button", name="Play").click()
    go_to_half(page, player)
    player.get_by_role("button", name=ANSWERS[1]).click()
    wait_until(page, player, f"root => root.dataset.step === '{LAST}'")


def test_a_telephone_shows_all_three_maps_at_once(chromium, app_url):
    context = chromium.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    player = open_home(page, app_url)
    go_to_half(page, player)
    boxes = [one.bounding_box() for one in player.locator(".pane canvas").all()]
    assert len(boxes) == 3
    assert all(box["width"] > 120 for box in boxes)
    for part in player.locator(".pane canvas, [data-vote], [data-do=play]").all():
        box = part.bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
        assert box["y"] + box["height"] <= 844
    for button in player.locator("[data-vote], [data-do=play]").all():
        box = button.bounding_box()
        assert min(box["width"], box["height"]) >= 44
    sizes = player.locator(".tally, [data-part=telling]").evaluate_all(
        "all => all.map((one) => parseFloat(getComputedStyle(one).fontSize))"
    )
    assert min(sizes) >= 13


SIZES = {"laptop": (1280, 720), "projector": (1920, 1080), "phone": (390, 844)}


@pytest.mark.parametrize("size", SIZES.values(), ids=SIZES)
def test_the_maps_need_no_more_room_than_is_kept_for_them(chromium, app_url, size):
    width, height = size
    context = chromium.new_context(viewport={"width": width, "height": height})
    page = context.new_page()
    player = open_home(page, app_url)
    room = page.locator(".st-key-home_maps")
    kept = float(room.evaluate("e => parseFloat(getComputedStyle(e).minHeight)"))
    assert kept - 30 < player.bounding_box()["height"] <= kept
    go_to_half(page, player)
    vote(page, player, ANSWERS[1])
    player.get_by_text("again at every reading").click()
    assert room.bounding_box()["height"] == pytest.approx(kept, abs=0.5)


def test_a_term_says_what_it_means_when_it_has_the_focus(page, app_url):
    open_home(page, app_url)
    term = page.locator("abbr", has_text="precision").first
    assert term.get_attribute("title") == glossary.meaning("precision")
    term.focus()
    shown = term.evaluate("node => getComputedStyle(node, '::after').content")
    assert glossary.meaning("precision") in shown

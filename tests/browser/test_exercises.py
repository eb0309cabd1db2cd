"""Exercises in a real browser: solved by what one sets, and kept over a reload."""

import re

import pytest

from occsim import MappingRun, MapSettings, Prior, load_sample
from occsim.exercises import load_exercises
from occsim.run.laps import lap_scores
from pages._ui.compute import EXERCISES

pytestmark = pytest.mark.browser


def test_what_was_solved_outlives_a_reload(page, app_url):
    n = sum(not one.is_open for one in load_exercises(EXERCISES, prove=False))
    page.goto(f"{app_url}/Exercises")
    page.get_by_text(f"0 of {n} solved").wait_for()
    page.locator(".st-key-open_count_a_thousand button").first.click()
    page.get_by_text("Exercise 4: Count a thousand cells").wait_for()
    page.get_by_text("yes", exact=True).first.click()
    for label, number in (
        ("How many free cells read empty?", "162"),
        ("How many walls read empty?", "82"),
        ("which share is free?", "0.664"),
    ):
        box = page.get_by_label(label)
        box.fill(number)
        box.press("Enter")
    page.get_by_label("Which rule gives this number?").click()
    page.get_by_role("option", name="count the drawing once").click()
    page.get_by_role("button", name="Check").click()
    page.get_by_text("Solved.").wait_for()
    page.get_by_role("link", name="Exercises").click()
    page.get_by_text(f"1 of {n} solved").wait_for()
    page.wait_for_function(
        "(localStorage.getItem('occsim.progress') ?? '').includes('true')"
    )
    page.goto(f"{app_url}/Exercises")  # a new session of the server
    page.get_by_text(f"1 of {n} solved").wait_for()
    page.get_by_text("Clear what this browser keeps").click()
    page.get_by_role("button", name="Clear it all").click()
    page.get_by_text(f"0 of {n} solved").wait_for()
    page.wait_for_function("localStorage.getItem('occsim.progress') === null")
    page.goto(f"{app_url}/Exercises")
    page.get_by_text(f"0 of {n} solved").wait_for()


def opened(page, app_url, name, path="Build_a_map"):
    page.goto(f"{app_url}/{path}?exercise={name}")
    page.wait_for_selector(".player[data-ready='1']")
    return page.locator(".player")


def test_the_rule_that_is_to_be_found_out_is_not_seen(page, app_url):
    player = opened(page, app_url, "which_rule")
    page.get_by_text("controls are hidden by exercise 15").wait_for()
    seen = player.inner_text()
    for word in ("Update rule", "Precision", "Recall", "F2", "log-odds after each"):
        assert word not in seen
    assert player.locator("[data-slider=p_wall] input").is_enabled()
    # A pinned cell has its numbers, but not the ladder, which would tell the rule.
    player.locator("[data-pane=map] canvas").click(position={"x": 200, "y": 180})
    player.locator("[data-part=cell-facts]").get_by_text("readings k").wait_for()
    assert "Prior" in player.inner_text()
    assert not player.locator(".terms").is_visible()
    assert "rule=" not in page.url


def test_a_locked_rule_is_seen_and_does_not_move(page, app_url):
    player = opened(page, app_url, "run_the_control")
    assert player.locator("input[name=rule][value=subtract_prior]").is_disabled()
    assert player.locator("[data-part=uninformative]").is_disabled()
    player.locator("[data-slider=p_wall] input").fill("0.12")
    assert player.locator("[data-slider=p_wall] .value").inner_text() == "0.12"
    # An edited link does not move it either, and the scores stay.
    page.wait_for_url("**p_wall=0.12**")
    page.goto(page.url + "&rule=subtract_prior&uninformative=1")
    page.wait_for_selector(".player[data-ready='1']")
    assert player.locator("input[name=rule][value=prior_once]").is_checked()
    assert not player.locator("[data-part=uninformative]").is_checked()
    assert player.get_by_text("Precision").first.is_visible()


def test_one_slider_moves_both_values_of_a_control_experiment(page, app_url):
    player = opened(page, app_url, "run_the_control")
    moved = player.get_by_role("slider", name="p_wall")
    moved.focus()
    moved.press("ArrowLeft")
    assert moved.input_value() == "0.54"
    assert player.get_by_role("slider", name="p_space").input_value() == "0.54"
    page.wait_for_url("**p_space=0.54**")


def test_laps_are_set_in_the_header_of_a_map(page, app_url):
    """Exercise 22: recall of c after one, two and three laps is what occsim says."""
    player = opened(page, app_url, "drive_it_again", "Two_maps")
    recall = player.locator("[data-value='looked recall']").first
    player.get_by_role("button", name="More settings of map A").click()
    laps = player.get_by_label("Laps of the same tour of map A")
    sample = load_sample("c")
    run = MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))
    for n in (3, 2, 1, 3):
        laps.select_option(str(n))
        shown = float(recall.inner_text().split()[0])
        assert shown == round(100 * lap_scores(run, Prior(), n).recall, 1)
    page.wait_for_url("**columns=l3*")


def test_an_exercise_of_the_transport_alone_can_be_played(page, app_url):
    player = opened(page, app_url, "first_wall")
    assert not player.locator("[data-slider=p_wall]").is_visible()
    player.get_by_role("button", name="One reading forward").click()
    assert player.locator("[data-part=counter]").inner_text().startswith("reading")


def letters(text):
    """A text without what Markdown, mathematics and escapes put between its words."""
    return re.sub(rb"[^A-Za-z0-9]+", b"", text.replace(rb"\text", b""))


@pytest.mark.parametrize(
    "name", ["first_wall", "which_rule", "run_the_control", "upside_down"]
)
def test_no_answer_is_sent_before_it_is_asked_for(page, app_url, name):
    """Nor in what the page does not show: all that the server sends is looked at."""
    exercise = next(one for one in load_exercises(EXERCISES) if one.id == name)
    sent = []
    page.on(
        "websocket",
        lambda socket: socket.on(
            "framereceived",
            lambda frame: sent.append(
                frame if isinstance(frame, bytes) else frame.encode()
            ),
        ),
    )
    opened(page, app_url, name)
    page.get_by_role("button", name="Hint").wait_for()
    assert letters(exercise.title.encode()) in letters(b"".join(sent))
    for answer in (exercise.after, *exercise.hints):
        assert letters(answer.encode()) not in letters(b"".join(sent))
    page.get_by_role("button", name="Hint").click()
    page.get_by_text("Hint.").wait_for()
    first, second = exercise.hints[:2]
    assert letters(first.encode()) in letters(b"".join(sent))
    assert letters(second.encode()) not in letters(b"".join(sent))

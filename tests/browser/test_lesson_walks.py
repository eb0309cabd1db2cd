"""Each lesson walked in a real browser: predict, act, see both side by side."""

import re

import pytest

from pages._ui.course import COURSE
from tests.browser.players import scrub, settled
from tests.browser.test_home import go_to_half, open_home, vote
from tests.browser.test_lens import click_cell, drag, part, ready

pytestmark = pytest.mark.browser

RESULT = "You predicted:"


def open_lesson(page, app_url, number):
    """Open a lesson by its link; what it draws first is its question."""
    path = COURSE[number].path.rpartition("/")[2][2:-3]
    page.goto(f"{app_url}/{path}?lesson={number}")
    panel = page.locator(".st-key-lesson")
    panel.get_by_text("Predict.").wait_for()
    page.locator("h1", has_text=f"{number}. {COURSE[number].title}").wait_for()
    assert RESULT not in panel.inner_text()
    assert "Why." not in panel.inner_text()
    return panel


def predict(panel, answer):
    panel.get_by_role("button", name=answer, exact=True).click()
    panel.get_by_text(RESULT).wait_for()
    panel.get_by_text("Why.").wait_for()


def result_of(panel, number):
    """What stands beside the prediction once it is as wanted."""
    return panel.locator(f".st-key-predict_{number}")


def test_lesson_0_the_vote_is_kept_and_lesson_5_shows_it_again(page, app_url):
    player = open_home(page, app_url)
    go_to_half(page, player)
    vote(page, player, "No drawing")
    player.get_by_text("again at every reading").click()
    page.get_by_role("link", name="Find out why: lesson 5").click()
    panel = page.locator(".st-key-lesson")
    predict(panel, "this building's")
    said = result_of(panel, 5)
    said.get_by_text("On the first page you voted for no drawing.").wait_for()
    assert "do not agree" in said.inner_text()
    page.get_by_role("link", name="Home").first.click()
    page.get_by_text("(visited, predicted)").first.wait_for()


def test_lesson_1_a_reading_that_says_nothing_is_looked_for(page, app_url):
    panel = open_lesson(page, app_url, 1)
    lens = ready(page)
    predict(panel, "no, it cannot")
    said = result_of(panel, 1)
    assert "From here no cell that holds both says nothing" in said.inner_text()
    drag(page, lens, (8.5, 16.5), (8.5, 28.5))
    click_cell(page, lens, 6, 9)
    said.get_by_text("It can: from here").wait_for()
    assert "You predicted: no, it cannot." in said.inner_text()
    assert "do not agree" in said.inner_text()


def test_lesson_2_a_second_reading_and_the_way_there_from_lesson_1(page, app_url):
    open_lesson(page, app_url, 1)
    lens = ready(page)
    page.get_by_role("button", name="Next: 2. Readings add up").click()
    page.get_by_role("heading", name="2. Readings add up: Why log-odds?").wait_for()
    panel = page.locator(".st-key-lesson")
    predict(panel, "only in l")
    said = result_of(panel, 2)
    assert "From the prior 0.18" in said.inner_text()
    assert "result agree" in said.inner_text()
    lens = ready(page)
    part(lens, "prior").press("ArrowRight")
    said.get_by_text("From the prior 0.19").wait_for()


def test_lesson_3_the_first_wall_stands_in_the_cone(page, app_url):
    panel = open_lesson(page, app_url, 3)
    player = page.locator(".player[data-ready='1']")
    player.wait_for()
    assert player.evaluate("root => root.dataset.step") == "0"
    assert player.locator("[data-part=uninformative]").is_checked()
    predict(panel, "the outer walls")
    n = re.search(r"after reading (\d+) of", result_of(panel, 3).inner_text())
    for _ in range(int(n.group(1))):
        player.locator("[data-do=forward]").click()
    assert player.evaluate("root => root.dataset.step") == n.group(1)
    found = player.locator("[data-value='looked recall']")
    assert float(found.inner_text().split()[0]) > 0


def test_lesson_4_the_blank_map_never_catches_up(page, app_url):
    panel = open_lesson(page, app_url, 4)
    player = page.locator(".player.several[data-ready='1']")
    player.wait_for()
    # The lesson asks, so the maps do not.
    assert player.locator("[data-answer]").count() == 0
    predict(panel, "half of them")
    said = result_of(panel, 4).inner_text()
    assert "Never: after all 420 readings" in said
    scrub(player, 420)
    without = player.locator(".foot").nth(1).locator("[data-value='unseen recall']")
    assert without.inner_text().startswith("0.0")


def test_lesson_5_the_line_up_by_both_rules(page, app_url):
    panel = open_lesson(page, app_url, 5)
    player = page.locator(".player.several[data-ready='1']")
    player.wait_for()
    predict(panel, "another building's")
    said = result_of(panel, 5).inner_text()
    assert "With another building's drawing" in said
    assert "Exercise 16 asks for the scores" in said
    player.get_by_role("button", name="Line-up, taken off").click()
    player.locator("[data-header='2']").wait_for()
    assert player.locator("[data-header]").count() == 3
    scrub(player, 455)
    second = player.locator(".foot").nth(1).locator("[data-value='looked f2']")
    assert second.inner_text().startswith("86.2")


def test_lesson_6_coverage_is_bought_with_precision(page, app_url):
    panel = open_lesson(page, app_url, 6)
    predict(panel, "no")
    said = result_of(panel, 6)
    assert "It has looked at 65.6 % so far" in said.inner_text()
    slider = page.get_by_role("slider", name="Field of view")
    slider.focus()
    for _ in range(15):
        slider.press("ArrowRight")
    slider.press("PageUp")
    settled(page)
    while "so far" in said.inner_text():
        slider.press("PageUp")
        settled(page)
    assert "do not agree" in said.inner_text()
    page.get_by_role("button", name=re.compile(r"^\d+$")).nth(2).click()
    page.get_by_text("Lit, orange: false walls, looked at").wait_for()


def test_lesson_7_the_other_front_comes_after_the_prediction(page, app_url):
    panel = open_lesson(page, app_url, 7)
    page.get_by_text("Pareto front under this rule").wait_for()
    predict(panel, "no, the same")
    page.get_by_text("Pareto front under each rule").wait_for()
    assert "the drawing's opposite" in result_of(panel, 7).inner_text()
    panel.get_by_role("link", name="Best prior").click()
    page.get_by_text("Three best priors for one house").wait_for()


def test_lesson_8_the_pattern_goes_with_the_rule(page, app_url):
    panel = open_lesson(page, app_url, 8)
    predict(panel, "near the middle")
    assert "in 15 of 15 cases" in result_of(panel, 8).inner_text()


def test_lesson_9_the_control_does_as_well_only_where_the_robot_looked(page, app_url):
    panel = open_lesson(page, app_url, 9)
    predict(panel, "only where the robot looked")
    said = result_of(panel, 9).inner_text()
    assert "The control is 0.12 on every cell" in said
    assert "result agree" in said
    panel.get_by_role("button", name="Exercise 23").click()
    page.get_by_text("Exercise 23: Yours").wait_for()


def test_predictions_outlive_a_reload(page, app_url):
    panel = open_lesson(page, app_url, 4)
    predict(panel, "never on this tour")
    page.wait_for_function(
        "(localStorage.getItem('occsim.progress') ?? '').includes('never')"
    )
    page.reload()  # a new session of the server
    panel.get_by_text("You predicted: never on this tour.").wait_for()
    assert page.locator("h1").inner_text().startswith("4. ")
    page.get_by_role("button", name="Leave the lesson").click()
    page.get_by_role("heading", name="Two maps", exact=True).wait_for()

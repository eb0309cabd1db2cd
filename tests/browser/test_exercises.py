"""Exercises in a real browser: solved by what one sets, and kept over a reload."""

import pytest

pytestmark = pytest.mark.browser


def test_what_was_solved_outlives_a_reload(page, app_url):
    page.goto(f"{app_url}/Exercises")
    # While the exercises are proven, the button may be drawn twice.
    page.get_by_text("0 of 22 solved").wait_for()
    page.locator(".st-key-open_count_a_thousand button").first.click()
    page.get_by_text("Exercise 4: Count a thousand cells.").wait_for()
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
    page.get_by_text("1 of 22 solved").wait_for()
    page.wait_for_function(
        "(localStorage.getItem('occsim.progress') ?? '').includes('true')"
    )
    page.goto(f"{app_url}/Exercises")  # a new session of the server
    page.get_by_text("1 of 22 solved").wait_for()

"""Where things stand: nothing runs past an edge."""

import pytest

from pages._ui import shell

pytestmark = pytest.mark.browser

PAGES = [one.path.rpartition("/")[2].partition("_")[2][:-3] for one in shell.PAGES[1:]]


@pytest.mark.parametrize("size", [(1280, 720), (390, 844)], ids=["laptop", "phone"])
@pytest.mark.parametrize("path", ["", *PAGES])
def test_nothing_runs_past_the_right_edge(chromium, app_url, path, size):
    width, height = size
    context = chromium.new_context(viewport={"width": width, "height": height})
    page = context.new_page()
    page.goto(f"{app_url}/{path}")
    # The last part of a page.
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for()
    past_the_edge = page.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert past_the_edge <= 0
    context.close()


@pytest.mark.parametrize("section", [1, 2, 4, 5, 6])
def test_a_section_with_a_board_fits_a_small_laptop(page, app_url, section):
    page.goto(f"{app_url}/Your_building?section={section}")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for()
    page.wait_for_timeout(1000)  # the board takes its height
    row = page.locator(".st-key-ending").bounding_box()
    assert row["y"] + row["height"] <= 720


def test_the_board_s_slider_ends_at_the_edge_of_a_telephone(chromium, app_url):
    context = chromium.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    page.goto(f"{app_url}/Your_building?section=6")
    slider = page.get_by_role("slider", name="How strongly the walls are shown")
    slider.wait_for()
    box, board = slider.bounding_box(), page.locator(".board canvas").bounding_box()
    assert box["x"] + box["width"] <= board["x"] + board["width"]

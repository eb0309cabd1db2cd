"""A drawing registered on a robot's map in a real browser, by mouse and by touch."""

import re

import pytest
from playwright.sync_api import expect

pytestmark = pytest.mark.browser

AGREES = re.compile(r"^([\d.]+) % of the drawn walls")
READY = ".board[data-ready='1']"


class Section:
    """The section, and its two boards."""

    def __init__(self, page, url):
        self.page = page
        page.goto(f"{url}/Robot_data")
        page.get_by_role("radio", name="A drawing for the log").click()
        expect(self.agreement()).to_be_visible(timeout=60_000)
        expect(page.locator(READY)).to_have_count(2, timeout=30_000)

    def agreement(self):
        return self.page.get_by_text(AGREES)

    def percent(self):
        return float(AGREES.match(self.agreement().first.inner_text()).group(1))

    def board(self, index):
        return self.page.locator(".board").nth(index)

    def points(self, index):
        state = self.board(index).evaluate("root => root.boardState()")
        return [point[:2] for point in state["points"]]

    def screen(self, index, x, y):
        """Where a point of a board's picture is in the window."""
        self.board(index).scroll_into_view_if_needed()
        camera = self.board(index).evaluate("root => root.boardState().camera")
        box = self.board(index).locator("canvas").bounding_box()
        return (
            box["x"] + camera["x"] + x * camera["scale"],
            box["y"] + camera["y"] + y * camera["scale"],
        )

    def changed_from(self, old):
        text = re.compile(rf"^{old} %")
        expect(self.agreement().first).not_to_have_text(text, timeout=30_000)


def test_a_rough_registration_is_refined_undone_and_mapped_with(page, app_url):
    section = Section(page, app_url)
    rough = section.percent()
    page.get_by_role("button", name="Refine by what the robot saw").click()
    section.changed_from(rough)
    # As `tests/test_registering.py` says of all five samples.
    assert rough < 20 < 70 < section.percent()
    page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(section.agreement().first).to_have_text(
        re.compile(rf"^{rough} %"), timeout=30_000
    )
    page.get_by_role("radio", name="Map with it").click()
    expect(page.get_by_text("on scans held out")).to_be_visible(timeout=60_000)
    expect(page.get_by_text("Where they differ")).to_be_visible()
    expect(page.locator(".tiles")).to_be_hidden()  # no scores without a truth


@pytest.mark.parametrize("by_touch", [False, True], ids=["mouse", "touch"])
def test_two_points_on_the_map_register_the_drawing_again(chromium, app_url, by_touch):
    size = {"width": 390, "height": 844} if by_touch else {"width": 1280, "height": 720}
    context = chromium.new_context(viewport=size, has_touch=by_touch)
    section = Section(context.new_page(), app_url)
    page, rough = section.page, section.percent()
    tap = page.touchscreen.tap if by_touch else page.mouse.click
    # Away from the ends that are there: near one, a tap would take it.
    for x, y in ((90, 20), (100, 120)):
        tap(*section.screen(1, x, y))
        page.wait_for_timeout(400)  # two quick taps would be one double tap
    section.changed_from(rough)
    found = section.points(1)
    assert [[round(v) for v in p] for p in found] == [[90, 20], [100, 120]]
    expect(page.get_by_role("button", name="Undo", exact=True).first).to_be_enabled()

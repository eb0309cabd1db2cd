"""A student's own building in a real browser: drawn on, left, kept and opened again."""

import re
import time

import cv2
import numpy as np
import pytest
from playwright.sync_api import expect

from occsim import load_sample
from occsim.io.project import load_project
from pages._ui.state import OPENING
from tests.browser.test_board import READY, near

pytestmark = pytest.mark.browser

CORRECTIONS = "4 Corrections"
ADDED = re.compile(r"^[1-9][\d,]* px added")
TOOLS = {
    "1 Drawing": "frame",
    "2 Scale": "ruler",
    CORRECTIONS: "brush",
    "6 Trajectory": "waypoints",
}


class Workshop:
    """The page, used by mouse and keyboard."""

    def __init__(self, page, url):
        self.page = page
        page.goto(f"{url}/Your_building")
        expect(page.get_by_role("heading", name="Your building")).to_be_visible()

    def section(self, name):
        self.page.get_by_role("radio", name=name, exact=True).click()

    def board(self, section):
        self.section(section)
        # The board of the previous section stays for a moment.
        self.page.locator(f"{READY} [data-tool={TOOLS[section]}]").wait_for()
        expect(self.page.locator(".board")).to_have_count(1)
        return self.page.locator(".board")

    def state(self):
        return self.page.locator(".board").evaluate("root => root.boardState()")

    def screen(self, x, y):
        """Where a point of the drawing is in the window."""
        camera = self.state()["camera"]
        box = self.page.locator(".board canvas").bounding_box()
        return (
            box["x"] + camera["x"] + x * camera["scale"],
            box["y"] + camera["y"] + y * camera["scale"],
        )

    def drag(self, start, end):
        mouse = self.page.mouse
        mouse.move(*self.screen(*start))
        mouse.down()
        mouse.move(*self.screen(*end), steps=4)
        mouse.up()

    def click(self, x, y):
        self.page.mouse.click(*self.screen(x, y))

    def says(self, text):
        expect(self.page.get_by_text(text).first).to_be_visible()

    def shows(self, title):
        """The list of drawings has this one chosen."""
        chosen = self.page.get_by_role("combobox", name="Drawing")
        expect(chosen).to_have_value(title)

    def upload(self, label, name, content):
        self.page.get_by_label(label).locator("visible=true").first.wait_for()
        # The uploader of the section that was left may be there for a moment.
        uploader = self.page.locator("[data-testid=stFileUploader]")
        uploader = uploader.filter(has_text=label).locator("input[type=file]")
        uploader.set_input_files(
            {"name": name, "mimeType": "application/octet-stream", "buffer": content}
        )

    def download(self, label):
        with self.page.expect_download() as waiting:
            self.page.get_by_role("button", name=label).click()
        return waiting.value.path().read_bytes()

    def project(self):
        self.section("7 Keep")
        return load_project(self.download("Download the project")).building


@pytest.fixture
def workshop(page, app_url):
    return Workshop(page, app_url)


def plan():
    """A plan that is not one of ours: two rooms with a door of 30 px."""
    image = np.full((240, 330), 255, np.uint8)
    cv2.rectangle(image, (15, 15), (315, 225), 0, 8)
    cv2.line(image, (165, 15), (165, 105), 0, 8)
    cv2.line(image, (165, 135), (165, 225), 0, 8)
    return cv2.imencode(".png", image)[1].tobytes()


def test_corrections_survive_other_pages_and_are_undone(workshop, page):
    workshop.board(CORRECTIONS)
    started = time.monotonic()
    workshop.drag((230, 260), (260, 260))
    workshop.says(ADDED)
    print(f"a stroke is in Python after {time.monotonic() - started:.2f} s")
    page.get_by_role("link", name="Build a map").click()
    page.locator(".player").first.wait_for()
    page.get_by_role("link", name="Your building").click()
    page.locator(READY).wait_for()
    assert workshop.state()["steps"] == 1
    building = workshop.project()
    assert building.wall_mask[260, 245]
    assert not building.walls_found[260, 245]
    workshop.board(CORRECTIONS).locator("[data-act=undo]").click()
    workshop.says("0 px added, 0 px erased")
    assert not workshop.project().wall_mask[260, 245]


def test_every_stroke_of_a_quick_series_is_kept(workshop, page):
    workshop.board(CORRECTIONS)
    x, y = workshop.screen(100, 100)
    for k in range(40):
        page.mouse.move(x + 4 * k, y)
        page.mouse.down()
        page.mouse.move(x + 4 * k + 10, y + 30)
        page.mouse.up()
    expect(workshop.page.locator(".board")).to_have_attribute("data-steps", "40")
    assert workshop.state()["steps"] == 40
    shown = np.array(list(workshop.state()["mask"])) == "1"
    np.testing.assert_array_equal(workshop.project().wall_mask.ravel(), shown)


def test_a_finger_draws_as_well(chromium, app_url):
    context = chromium.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    page = context.new_page()
    workshop = Workshop(page, app_url)
    workshop.board(CORRECTIONS).scroll_into_view_if_needed()
    touch = page.context.new_cdp_session(page)
    for kind, point in (
        ("touchStart", (230, 150)),
        ("touchMove", (245, 160)),
        ("touchMove", (260, 170)),
        ("touchEnd", None),
    ):
        places = [] if point is None else [workshop.screen(*point)]
        touch.send(
            "Input.dispatchTouchEvent",
            {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in places]},
        )
    workshop.says(ADDED)
    context.close()


def test_an_uploaded_plan_is_measured_toured_kept_and_opened_again(
    workshop, page, chromium, app_url
):
    workshop.board("1 Drawing")
    workshop.upload("Drawing", "plan.png", plan())
    workshop.says("330 × 240 px")
    workshop.board("2 Scale")
    workshop.click(165, 105)
    workshop.click(165, 135)
    workshop.says(re.compile(r"(29|30|31)(\.\d+)? px \(0\.90 m\)"))
    workshop.board("6 Trajectory")
    for x, y in ((60, 60), (60, 120), (260, 120), (260, 60)):
        workshop.click(x, y)
    workshop.says(re.compile(r"3[23] poses in the trajectory"))
    before = workshop.project()
    np.testing.assert_allclose(
        [corner[:2] for corner in before.sketch],
        [(60, 60), (60, 120), (260, 120), (260, 60)],
        atol=0.75,
    )
    content = workshop.download("Download the project")
    other = Workshop(chromium.new_context().new_page(), app_url)
    other.section("7 Keep")
    other.upload("Project file", "plan.zip", content)
    other.shows("Yours: plan.png")
    assert other.project().digest == before.digest
    other.board("6 Trajectory")
    points = other.state()["points"]
    assert len(points) == 4
    assert near(points[0], 60, 60)
    other.page.context.close()


def test_a_damaged_project_is_refused_and_changes_nothing(workshop, page):
    workshop.board(CORRECTIONS)
    workshop.drag((230, 260), (260, 260))
    workshop.says(ADDED)
    workshop.section("7 Keep")
    workshop.upload("Project file", "bad.zip", b"PK\x03\x04 and then nothing")
    workshop.says("bad.zip cannot be opened")
    assert not workshop.project().corrections.is_empty


def test_poses_are_edited_in_the_table(workshop, page):
    workshop.board("6 Trajectory")
    page.get_by_role("radio", name="Table", exact=True).click()
    table = page.locator("[data-testid=stDataFrame] canvas").first
    table.wait_for()
    editor = page.locator("#portal input, #portal textarea")
    for _ in range(20):  # a click on a table that is still being laid out is lost
        box = table.bounding_box()
        # The first value of the first row: below the header, right of the markers.
        page.mouse.dblclick(box["x"] + 70, box["y"] + 52)
        page.wait_for_timeout(250)
        if editor.count():
            break
    editor.first.fill("33.5")
    expect(editor.first).to_have_value("33.5")
    editor.first.press("Enter")
    workshop.shows(f"Yours: {load_sample(OPENING).title}")
    assert workshop.project().trajectory.poses[0, 0] == 33.5

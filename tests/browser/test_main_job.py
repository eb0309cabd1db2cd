"""The main job in a browser: open, change, leave and return, upload a drawing."""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from occsim import MappingRun, MapSettings, Prior, load_drawing
from occsim.building import building_from_drawing
from pages._ui.uploads import WORKING_PX

pytestmark = pytest.mark.browser

REAL_DRAWING = Path(__file__).resolve().parents[3] / (
    "shared/examples/cad_floor_drawing.png"
)
PLAYER = ".player[data-ready='1']"


def two_rooms() -> bytes:
    """A plan that is not a sample: two rooms with a door between them."""
    image = np.full((200, 320), 255, np.uint8)
    cv2.rectangle(image, (12, 12), (307, 187), 0, 6)
    cv2.line(image, (160, 12), (160, 80), 0, 6)
    cv2.line(image, (160, 120), (160, 187), 0, 6)
    cv2.putText(image, "HALL", (40, 100), cv2.FONT_HERSHEY_SIMPLEX, 0.5, 0, 1)
    return cv2.imencode(".png", image)[1].tobytes()


def foreign_drawing() -> bytes:
    """A real CAD floor where the machine has one, else a plan made here."""
    return REAL_DRAWING.read_bytes() if REAL_DRAWING.is_file() else two_rooms()


def open_page(page, app_url, query=""):
    page.goto(f"{app_url}/Build_a_map{query}")
    page.wait_for_selector(PLAYER)
    settled(page)


def settled(page):
    """Wait until the server has finished its run."""
    page.wait_for_timeout(500)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")


def counts(page):
    """The player's (tp, fp, fn, tn) at the step that it shows."""
    data = page.locator(PLAYER).evaluate("root => ({...root.dataset})")
    return tuple(int(data[name]) for name in ("tp", "fp", "fn", "tn"))


def shown(page, name):
    return page.locator(PLAYER).evaluate("(root, name) => root.dataset[name]", name)


def nudge(page, label, times):
    """Move a slider of the page to the right by so many steps of its keyboard."""
    slider = page.get_by_role("slider", name=label)
    slider.focus()
    for _ in range(times):
        page.keyboard.press("ArrowRight")
    settled(page)


def upload(page, label, name, data):
    page.get_by_text("Upload", exact=True).click()
    chooser = page.locator("[data-testid=stFileUploader]").filter(has_text=label)
    chooser.locator("input[type=file]").set_input_files(
        {"name": name, "mimeType": "application/octet-stream", "buffer": data}
    )
    settled(page)
    page.keyboard.press("Escape")


def test_the_page_opens_in_the_middle_of_the_story(page, app_url):
    open_page(page, app_url)
    step, total = int(shown(page, "step")), int(shown(page, "nReadings"))
    assert step == total // 2
    assert counts(page)[0] > 0


def test_a_slider_changes_the_map_and_keeps_the_step(page, app_url):
    open_page(page, app_url)
    page.locator("[data-part=scrub]").fill("77")
    before = counts(page)
    nudge(page, "Cell size", 3)
    assert shown(page, "step") == "77"
    assert counts(page) != before


def test_leaving_the_page_loses_nothing(page, app_url):
    open_page(page, app_url)
    page.locator("[data-slider=p_wall] input").fill("0.35")
    page.locator("[data-slider=p_wall] input").dispatch_event("change")
    page.locator("[data-part=scrub]").fill("99")
    page.locator("[data-part=scrub]").dispatch_event("change")
    settled(page)
    before = counts(page)
    page.get_by_role("link", name="Home").first.click()
    page.get_by_role("link", name="Build a map").first.click()
    page.wait_for_selector(f"{PLAYER}[data-step='99']")
    assert page.locator("[data-slider=p_wall] .value").inner_text() == "0.35"
    assert counts(page) == before


def test_leaving_in_the_middle_of_a_replay_keeps_the_reading_that_was_shown(
    page, app_url
):
    open_page(page, app_url)
    page.locator("[data-part=scrub]").fill("40")
    page.locator("[data-part=scrub]").dispatch_event("change")
    settled(page)
    page.locator("[data-do=play]").click()
    page.wait_for_timeout(1200)
    page.get_by_role("link", name="Home").first.click()
    page.wait_for_selector(f".compact{PLAYER}")
    page.get_by_role("link", name="Build a map").first.click()
    page.wait_for_selector(f".player:not(.compact){PLAYER[7:]}")
    settled(page)
    assert int(shown(page, "step")) > 40


def test_reset_all_restores_the_preset(page, app_url):
    open_page(page, app_url, "?drawing=d&cell_px=7&p_wall=0.6")
    assert page.locator("[data-slider=p_wall] .value").inner_text() == "0.60"
    page.get_by_role("button", name="Reset all").click()
    settled(page)
    assert page.locator("[data-slider=p_wall] .value").inner_text() == "0.20"
    assert page.get_by_role("slider", name="Cell size").input_value() == "3"
    drawing = page.locator("[data-testid=stSelectbox]").filter(has_text="Drawing")
    assert "d: Offices" in drawing.inner_text() + drawing.locator("input").input_value()


def test_a_drawing_that_is_not_ours_maps_at_once(page, app_url):
    data = foreign_drawing()
    open_page(page, app_url)
    upload(page, "Drawing", "foreign.png", data)
    page.get_by_text("No ground truth was given").wait_for()
    page.wait_for_selector(PLAYER)
    total = int(shown(page, "nReadings"))
    page.locator("[data-part=scrub]").fill(str(total))

    # The same by occsim: the range is the proposed length of a door, in whole pixels.
    drawing = load_drawing(data, name="foreign.png")
    own = building_from_drawing(drawing, working_px=WORKING_PX)
    sensor = replace(own.sensor, range_px=float(round(own.sensor.range_px)))
    expected = MappingRun(own, MapSettings(sensor=sensor)).scores(Prior())
    assert total == len(own.trajectory)
    assert counts(page) == (expected.tp, expected.fp, expected.fn, expected.tn)


def test_a_bad_file_is_answered_and_the_map_stays(page, app_url):
    open_page(page, app_url)
    before = counts(page)
    upload(page, "Drawing", "words.png", b"this is no image")
    assert page.locator("[data-testid=stAlert]").count() == 1
    assert counts(page) == before

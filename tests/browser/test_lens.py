"""The lens in a real browser: a student does what the lesson asks."""

import re

import numpy as np
import pytest

from occsim import lens_world, one_reading
from pages._ui.components.lens.document import OPENING, with_texts
from tests.test_lens import pose_of, sensor_of

pytestmark = pytest.mark.browser

PATH = "What_the_sensor_says"
ROOT = ".lens"


def open_lens(page, app_url, **texts):
    query = "&".join(f"lens_{name}={text}" for name, text in texts.items())
    page.goto(f"{app_url}/{PATH}?{query}")
    return ready(page)


def ready(page):
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    return page.locator(ROOT)


def part(lens, name):
    return lens.locator(f"[data-part={name}]")


def inspect(lens):
    """What is chosen and read, once the frame that shows it has been drawn."""
    return lens.evaluate(
        """root => new Promise(resolve =>
            requestAnimationFrame(() =>
                requestAnimationFrame(() => resolve(root.inspect()))))"""
    )


def texts_of(lens):
    return inspect(lens)["texts"]


def point(lens, x, y):
    """A place of the world on the page, CSS px; the stage is scrolled into view."""
    lens.locator("canvas").scroll_into_view_if_needed()
    box = lens.locator("canvas").bounding_box()
    scale = inspect(lens)["scale"]
    return box["x"] + x * scale, box["y"] + y * scale


def settled(page):
    """Wait until the page has taken what the lens committed."""
    page.wait_for_timeout(700)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")


@pytest.fixture(autouse=True)
def finished(page):
    """A window that closes while its script still runs leaves an error in the log."""
    yield
    settled(page)


def drag(page, lens, start, end):
    page.mouse.move(*point(lens, *start))
    page.mouse.down()
    page.mouse.move(*point(lens, *end), steps=12)
    page.mouse.up()


def click_cell(page, lens, row, col, cell_px=4):
    page.mouse.click(*point(lens, (col + 0.5) * cell_px, (row + 0.5) * cell_px))


def expect_reading_of_occsim(lens):
    """The numbers on the screen are those of the library for what is chosen."""
    shown = inspect(lens)
    document, wrong = with_texts(OPENING, {**shown["texts"]})
    assert not wrong
    world = lens_world()
    grid = world.grid(document.cell_px)
    seen = one_reading(world, pose_of(document), sensor_of(document), grid)
    np.testing.assert_array_equal(shown["empty"], seen.n_empty.ravel())
    np.testing.assert_array_equal(shown["object"], seen.n_object.ravel())
    np.testing.assert_array_equal(shown["said"], seen.log_odds.ravel())
    assert shown["hidden"] == (seen.object & ~world.occupied).sum()
    return seen


def test_it_opens_on_a_cell_that_holds_as_much_empty_as_object(page, app_url):
    lens = open_lens(page, app_url)
    assert part(lens, "cell-name").inner_text() == "Cell row 2, column 9"
    assert part(lens, "q").inner_text() == "8 / 16 = 0.50"
    assert part(lens, "n-hidden").inner_text() == "66 free pixels are called object"
    assert lens.locator("[data-case][aria-current=true]").count() == 1
    assert "otherwise" in lens.locator("[data-case][data-live]").inner_text()
    expect_reading_of_occsim(lens)


def test_exercise_1_a_reading_that_says_nothing_is_found_by_hand(page, app_url):
    lens = open_lens(page, app_url, pose="8.5_16.5_0")
    drag(page, lens, (8.5, 16.5), (8.5, 28.5))
    click_cell(page, lens, 6, 9)
    assert texts_of(lens)["pose"] == "8.5_28.5_0"
    assert part(lens, "verdict").inner_text() == "says nothing"
    assert part(lens, "log-odds").inner_text() == "ln(0.50 / 0.50) = 0.00"
    seen = expect_reading_of_occsim(lens)
    assert (seen.n_empty[6, 9], seen.n_object[6, 9], seen.log_odds[6, 9]) == (8, 8, 0)
    settled(page)
    said = part(lens, "said").inner_text()
    assert said == "cell 6, 9: 8 empty, 8 object, says nothing"


def test_exercise_1_is_judged_by_what_is_on_the_screen(page, app_url):
    """The click on Check follows the last choice at once."""
    page.goto(f"{app_url}/Exercises")
    page.get_by_role("button", name="Exercise 1", exact=True).click()
    lens = ready(page)
    settled(page)
    page.get_by_text("yes", exact=True).first.click()
    settled(page)
    drag(page, lens, (8.5, 16.5), (8.5, 28.5))
    click_cell(page, lens, 6, 9)
    page.get_by_role("button", name="Check").click()
    page.get_by_text("Solved. You predicted: yes.").wait_for()


def test_exercise_2_what_hides_behind_the_pillar(page, app_url):
    lens = open_lens(page, app_url, pose="14.5_6.5_0")
    assert part(lens, "n-hidden").inner_text() == "189 free pixels are called object"
    lens.get_by_label("not seen").check()
    assert expect_reading_of_occsim(lens).object.sum() == 7
    assert part(lens, "n-hidden").inner_text() == "0 free pixels are called object"


def test_all_of_it_by_keyboard(page, app_url):
    lens = open_lens(page, app_url)
    part(lens, "robot").focus()
    for _ in range(18):
        page.keyboard.press("ArrowDown")
    assert texts_of(lens)["pose"] == "8.5_28.5_0"
    page.keyboard.press("Tab")
    for key in ("ArrowRight", "Shift+ArrowLeft", "]", "[", "["):
        page.keyboard.press(key)
    assert texts_of(lens)["pose"] == "8.5_28.5_331"
    page.keyboard.press("]")
    page.keyboard.press("]")
    page.keyboard.press("ArrowLeft")
    assert texts_of(lens)["pose"] == "8.5_28.5_0"
    page.keyboard.press("Tab")
    for _ in range(4):
        page.keyboard.press("ArrowDown")
    assert texts_of(lens)["cell"] == "6_9"
    settled(page)
    said = part(lens, "said").inner_text()
    assert said == "cell 6, 9: 8 empty, 8 object, says nothing"
    part(lens, "prior").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    assert texts_of(lens)["prior"] == "0.29"
    settled(page)
    said = part(lens, "said").inner_text()
    # ln(0.29 / 0.71) + ln 9 = 1.30.
    assert said == "prior 0.29, 1 reading: log-odds +1.30, p free 0.786"


def test_the_handle_turns_the_robot(page, app_url):
    lens = open_lens(page, app_url)
    box = part(lens, "handle").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(*point(lens, 8.5, 25), steps=8)
    page.mouse.up()
    assert texts_of(lens)["pose"] == "8.5_10.5_90"
    expect_reading_of_occsim(lens)


def test_a_pixel_at_the_pointer_tells_its_ray_and_its_z(page, app_url):
    lens = open_lens(page, app_url)
    page.mouse.move(*point(lens, 41.5, 10.5))
    words = (
        "Pixel row 10, column 41, 33.0 px away; its ray meets a wall at z = 29.5: "
        "at it or behind it, object"
    )
    page.get_by_text(words).wait_for()


def test_readings_add_up_and_in_another_order_to_the_same(page, app_url):
    lens = open_lens(page, app_url)
    total = lens.locator(".line .total")
    assert total.text_content() == "pfree = 0.664"
    part(lens, "read-empty").click()
    assert total.text_content() == "pfree = 0.947"
    part(lens, "read-object").click()
    part(lens, "read-cell").click()
    assert part(lens, "chips").inner_text() == "empty, empty, object, 8 : 8"
    before = inspect(lens)["total"]
    part(lens, "turn").click()
    assert part(lens, "chips").inner_text() == "8 : 8, empty, empty, object"
    assert inspect(lens)["total"] == before
    assert lens.locator(".line .bar").count() == 5
    lens.get_by_label("Take it off at every reading").check()
    assert lens.locator(".line .bar.less").count() == 4
    for _ in range(3):
        part(lens, "undo").click()
    assert lens.locator(".line .bar").count() == 3


def test_a_thousand_cells_are_counted_and_the_chosen_rule_is_marked(page, app_url):
    lens = open_lens(page, app_url)
    table = part(lens, "once-table")
    assert "162 / 244 = 0.664" in table.inner_text()
    assert re.search(r"taken off each time\s+0\.900", table.inner_text())
    assert "drawing counted once" in table.locator("[data-live]").inner_text()
    lens.locator("[data-part=twice-name]").click()
    twice = part(lens, "twice-table").inner_text()
    numbers = ("0.9468", "0.9973", "0.1800", "0.8200", "0.0027", "0.0532")
    assert all(number in twice for number in numbers)


def test_the_prior_is_dragged_and_its_cells_are_counted_anew(page, app_url):
    lens = open_lens(page, app_url)
    box = part(lens, "prior").bounding_box()
    line = part(lens, "line").bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(line["x"] + line["width"] / 2, line["y"] + 46, steps=10)
    page.mouse.up()
    assert texts_of(lens)["prior"] == "0.50"
    assert "500 are free and 500 wall" in part(lens, "such").inner_text()


def test_a_reload_keeps_pose_cell_and_readings(page, app_url):
    lens = open_lens(page, app_url)
    drag(page, lens, (8.5, 10.5), (8.5, 28.5))
    click_cell(page, lens, 6, 9)
    part(lens, "read-object").click()
    settled(page)
    chosen = texts_of(lens)
    page.reload()
    lens = ready(page)
    again = texts_of(lens)
    assert {**again, "rev": 0} == {**chosen, "rev": 0}
    assert len(page.url.split("?")[1]) < 160


def test_the_page_stays_where_it_is_when_something_was_chosen(page, app_url):
    page.set_viewport_size({"width": 390, "height": 600})
    lens = open_lens(page, app_url)
    part(lens, "read-object").hover()  # scrolls until nothing lies over the button
    page.wait_for_timeout(200)
    before = part(lens, "read-object").bounding_box()["y"]
    part(lens, "read-object").click()
    settled(page)
    assert part(lens, "read-object").bounding_box()["y"] == before
    # The row of pages shows the current one all the same.
    link = page.locator(".st-key-current_page").bounding_box()
    assert 0 <= link["x"] < link["x"] + link["width"] <= 390


def test_the_lens_is_as_it_was_left(page, app_url):
    lens = open_lens(page, app_url, pose="14.5_6.5_0")
    lens.get_by_label("not seen").check()
    settled(page)
    part(lens, "read-object").click()
    page.get_by_role("link", name="Build a map").first.click()
    page.wait_for_selector(".player[data-ready='1']")
    page.get_by_role("link", name="What the sensor says").first.click()
    lens = ready(page)
    texts = texts_of(lens)
    assert (texts["pose"], texts["behind"]) == ("14.5_6.5_0", "unseen")
    assert texts["chips"] == "e_o"


def test_a_drag_is_drawn_within_a_frame(page, app_url):
    """Widest view and smallest cells; a frame at 60 a second lasts 16.7 ms."""
    lens = open_lens(page, app_url, fov=360, range=58, size=2, pose="20.5_14.5_0")
    page.mouse.move(*point(lens, 20.5, 14.5))
    page.mouse.down()
    times = []
    for i in range(60):
        page.mouse.move(*point(lens, 20.5 + 0.2 * i, 14.5 + i % 5))
        times.append(float(lens.get_attribute("data-show-ms")))
    page.mouse.up()
    print(
        f"a frame of a drag: median {np.median(times):.1f} ms, worst {max(times):.1f}"
    )
    assert np.median(times) < 10.0
    expect_reading_of_occsim(lens)


def test_a_telephone_shows_stage_sliders_cell_and_line_in_that_order(page, app_url):
    size = {"width": 390, "height": 844}
    page.set_viewport_size(size)
    lens = open_lens(page, app_url)
    names = ("canvas", "[data-part=range]", ".cell", ".line", ".counting")
    tops = [lens.locator(name).first.bounding_box()["y"] for name in names]
    assert tops == sorted(tops)
    assert tops[1] < size["height"]
    assert page.evaluate("document.documentElement.scrollWidth") == size["width"]
    click_cell(page, lens, 2, 8)
    assert texts_of(lens)["cell"] == "2_8"

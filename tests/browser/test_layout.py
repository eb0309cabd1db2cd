"""Where things stand: nothing runs past an edge."""

import pytest

from pages._ui import navigation

pytestmark = pytest.mark.browser

PAGES = [
    one.path.rpartition("/")[2].partition("_")[2][:-3] for one in navigation.PAGES[1:]
]


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


def test_the_navigation_is_one_row_on_a_small_laptop(page, app_url):
    page.goto(f"{app_url}/Study")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for()
    links = [link.bounding_box() for link in page.locator(".st-key-lessons a").all()]
    assert len(links) == len(navigation.PAGES)
    assert len({box["y"] for box in links}) == 1
    # A window has a scroll bar of 15 px, which the headless browser has not.
    assert links[-1]["x"] + links[-1]["width"] <= 1280 - 32 - 15


@pytest.mark.parametrize("section", [1, 2, 4, 5, 6])
def test_a_section_with_a_board_fits_a_small_laptop(page, app_url, section):
    page.goto(f"{app_url}/Your_building?section={section}")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for()
    page.wait_for_timeout(1000)  # the board takes its height
    row = page.locator(".st-key-ending").bounding_box()
    assert row["y"] + row["height"] <= 720


@pytest.mark.parametrize("section", [4, 5, 6])
def test_the_tools_of_the_board_are_one_row_on_a_small_laptop(page, app_url, section):
    page.goto(f"{app_url}/Your_building?section={section}")
    page.locator(".board[data-ready='1']").wait_for()
    bar = page.locator(".board .bar > *:visible")
    boxes = [one.bounding_box() for one in bar.all()]
    assert len(boxes) >= 4
    assert len({box["y"] + box["height"] / 2 for box in boxes}) == 1


def test_the_board_s_slider_ends_at_the_edge_of_a_telephone(chromium, app_url):
    context = chromium.new_context(viewport={"width": 390, "height": 844})
    page = context.new_page()
    page.goto(f"{app_url}/Your_building?section=6")
    slider = page.get_by_role("slider", name="How strongly the walls are shown")
    slider.wait_for()
    box, board = slider.bounding_box(), page.locator(".board canvas").bounding_box()
    assert box["x"] + box["width"] <= board["x"] + board["width"]


# --- A telephone: what is changed and what it changes are on one screen ---------------


@pytest.fixture
def phone(chromium):
    return chromium.new_context(viewport={"width": 390, "height": 844}).new_page()


def is_whole_on_screen(part):
    box = part.bounding_box()
    return box["y"] >= -1 and box["y"] + box["height"] <= 844 + 1


@pytest.mark.parametrize(
    ("path", "root", "picture", "controls"),
    [
        ("Build_a_map", ".player", "[data-pane=map] canvas", ".side input:enabled"),
        ("What_the_sensor_says", ".lens", ".stage", ".controls input, .adding button"),
    ],
)
def test_the_map_stays_in_sight_of_its_controls(
    phone, app_url, path, root, picture, controls
):
    phone.goto(f"{app_url}/{path}")
    player = phone.locator(f"{root}[data-ready='1']")
    player.wait_for()
    for control in player.locator(controls).all():
        # As a thumb does: the control comes to the lower half of the screen.
        control.evaluate("node => node.scrollIntoView({block: 'end'})")
        assert is_whole_on_screen(control)
        assert is_whole_on_screen(player.locator(picture))


@pytest.mark.parametrize("path", ["Build_a_map", "Build_a_map?lesson=3", "Two_maps"])
def test_the_sensor_s_settings_stand_above_their_map_on_a_telephone(
    phone, app_url, path
):
    """In one row to swipe: a slider that is moved changes a map that is seen."""
    phone.goto(f"{app_url}/{path}")
    phone.locator(".player[data-ready='1']").wait_for()
    phone.wait_for_timeout(500)  # the maps take their height
    row = phone.locator(".st-key-map_controls")
    sliders = row.get_by_role("slider").all()
    assert len(sliders) == (2 if path == "Two_maps" else 3)
    for slider in sliders:
        slider.scroll_into_view_if_needed()
        assert is_whole_on_screen(slider)
        assert is_whole_on_screen(phone.locator("[data-pane=map] canvas").first)
    assert row.bounding_box()["height"] < 100
    assert phone.evaluate("document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize("section", [4, 5])
def test_the_board_s_sliders_can_be_moved_on_a_telephone(phone, app_url, section):
    phone.goto(f"{app_url}/Your_building?section={section}")
    phone.locator(".board[data-ready='1']").wait_for()
    for slider in phone.locator(".board input[type=range]").all():
        assert slider.bounding_box()["width"] >= 40


def test_an_exercise_stands_beside_its_button_on_a_telephone(phone, app_url):
    phone.goto(f"{app_url}/Exercises")
    row = phone.locator(".st-key-exercises > div").filter(has_text="What is behind")
    button = row.get_by_role("button", name="Exercise 2").bounding_box()
    title = row.get_by_text("What is behind the pillar?").bounding_box()
    assert title["x"] >= button["x"] + button["width"]
    assert abs(title["y"] - button["y"]) < button["height"]


def test_the_last_row_is_one_row_on_a_telephone(phone, app_url):
    phone.goto(f"{app_url}/Study")
    ending = phone.locator(".st-key-ending")
    ending.get_by_text("Reset all").wait_for()
    copy, reset = (ending.get_by_text(name) for name in ("Copy link", "Reset all"))
    copy.wait_for()
    assert abs(copy.bounding_box()["y"] - reset.bounding_box()["y"]) < 10


@pytest.mark.parametrize(
    ("path", "lesson", "root", "pictures"),
    [
        ("What_the_sensor_says", 1, ".lens", ".stage"),
        ("Build_a_map", 3, ".player", "[data-pane=map] canvas, [data-do=play]"),
        ("Two_maps", 4, ".player", "[data-pane=map] canvas, [data-do=play]"),
        ("Two_maps", 5, ".player", "[data-pane=map] canvas, [data-do=play]"),
    ],
)
def test_a_lesson_s_question_and_its_maps_are_on_one_screen_of_a_telephone(
    phone, app_url, path, lesson, root, pictures
):
    phone.goto(f"{app_url}/{path}?lesson={lesson}")
    player = phone.locator(f"{root}[data-ready='1']")
    player.wait_for()
    phone.wait_for_timeout(500)  # the maps take their height
    question = phone.locator(f".st-key-predict_{lesson}")
    assert is_whole_on_screen(question)
    maps = player.locator(pictures).all()
    assert all(is_whole_on_screen(one) for one in maps)
    see = phone.get_by_text("See.", exact=True)
    assert see.bounding_box()["y"] > maps[0].bounding_box()["y"]


def test_two_maps_and_their_headers_fit_a_telephone(phone, app_url):
    phone.goto(f"{app_url}/Two_maps")
    phone.locator(".player[data-ready='1']").wait_for()
    phone.locator(".stage").evaluate("node => node.scrollIntoView({block: 'start'})")
    for part in phone.locator("[data-pane=map] :is(canvas, .header)").all():
        assert is_whole_on_screen(part)
    assert is_whole_on_screen(phone.locator("[data-do=play]"))


def test_the_captions_of_the_scores_are_whole_on_a_small_laptop(page, app_url):
    page.goto(f"{app_url}/Build_a_map")
    page.locator(".player[data-ready='1']").wait_for()
    captions = page.locator(".player [data-score] small")
    assert captions.count() == 4
    for caption in captions.all():
        assert caption.evaluate("node => node.scrollWidth <= node.clientWidth")

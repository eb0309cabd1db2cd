"""A class in a real browser: a telephone in a prepared class, a vote, a projector."""

import pytest

from pages._ui.course import COURSE

pytestmark = pytest.mark.browser

PHONE = {"width": 390, "height": 844}
LAPTOP = {"width": 1280, "height": 720}
PROVING_MS = 120_000
"""The first page that lists exercises proves them."""


def window(chromium, size):
    return chromium.new_context(viewport=size).new_page()


def test_what_a_teacher_hides_and_locks_holds_on_a_telephone(chromium, app_url):
    teacher = window(chromium, LAPTOP)
    teacher.goto(f"{app_url}/Build_a_map?drawing=d&p_wall=0.3")
    teacher.wait_for_selector(".player[data-ready='1']")
    teacher.get_by_role("link", name="Class", exact=True).click()
    make = teacher.get_by_role("button", name="Make the link")
    make.wait_for(timeout=PROVING_MS)
    rows = teacher.locator(".st-key-class_controls [data-testid=stButtonGroup]")
    for name, wanted in (("Update rule", "hide"), ("Uninformative", "lock")):
        # Faster than the page runs: no click may be taken back.
        rows.filter(has_text=name).get_by_role("radio", name=wanted).click()
    make.click()
    link = teacher.locator(".st-key-class_made code").first.inner_text()
    for name, wanted in (("Update rule", "hide"), ("Uninformative", "lock")):
        button = rows.filter(has_text=name).get_by_role("radio", name=wanted)
        assert button.get_attribute("aria-checked") == "true"
    student = window(chromium, PHONE)
    student.goto(f"{app_url}/")
    field = student.get_by_label("I have a class code")
    field.fill(link.partition("class=")[2].upper())
    student.get_by_role("button", name="Go", exact=True).click()
    student.wait_for_selector(".player[data-ready='1']")
    # The rule, and the conditions that would tell it.
    student.get_by_text("2 controls are hidden by your teacher.").wait_for()
    player = student.locator(".player")
    assert not player.locator("input[name=rule]").first.is_visible()
    assert player.locator("[data-part=uninformative]").is_disabled()
    assert player.locator("[data-slider=p_wall] .value").inner_text() == "0.30"
    student.reload()
    student.get_by_text("2 controls are hidden by your teacher.").wait_for()


def test_a_vote_is_counted_and_shown_when_the_teacher_says_so(chromium, app_url):
    teacher = window(chromium, LAPTOP)
    teacher.goto(f"{app_url}/Class")
    teacher.get_by_role("button", name="Make the link").wait_for(timeout=PROVING_MS)
    teacher.get_by_role("radio", name="Vote").click()
    teacher.get_by_role("button", name="Open a room").click()
    link = teacher.locator("code").first.inner_text()
    students = [window(chromium, PHONE) for _ in range(2)]
    for student in students:
        student.goto(link)
        student.get_by_role("button", name="Its own drawing").click()
        student.get_by_text("Your answer:").wait_for()
    # After a reload it is the same voter, who may change the answer.
    students[0].reload()
    students[0].get_by_text("Your answer: Its own drawing").wait_for()
    students[0].get_by_role("button", name="No drawing").click()
    students[0].get_by_text("Your answer: No drawing").wait_for()
    teacher.get_by_text("2 answers").wait_for()
    assert not students[1].get_by_role("progressbar").count()
    teacher.get_by_role("button", name="Show the answers").click()
    students[1].get_by_text("Its own drawing (yours): 1").wait_for()
    students[1].get_by_text("No drawing: 1").wait_for()


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080)])
@pytest.mark.parametrize(
    ("path", "more"),
    [
        ("Build_a_map", ""),
        ("Build_a_map", "&lesson=3"),
        ("Two_maps", ""),
        ("Two_maps", "&lesson=4"),
        ("Two_maps", "&lesson=5"),
    ],
)
def test_map_and_transport_fit_a_projector(chromium, app_url, path, size, more):
    width, height = size
    page = window(chromium, {"width": width, "height": height})
    page.goto(f"{app_url}/{path}?projector=1&step=100{more}")
    page.wait_for_selector(".player[data-ready='1']")
    page.wait_for_timeout(1000)  # the maps take their height
    transport = page.locator(".transport").bounding_box()
    assert transport["y"] + transport["height"] <= height
    for number in page.locator(".st-key-lesson_keys a").all():
        box = number.bounding_box()
        assert 0 <= box["x"] <= width - box["width"]
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    picture = page.locator("[data-pane=map] canvas").first.bounding_box()
    assert picture["width"] * (2 if path == "Build_a_map" else 3) > 0.65 * width


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080)])
@pytest.mark.parametrize(
    ("lesson", "pictures"),
    [
        (1, ".lens[data-ready='1'] .stage"),
        (3, ".player[data-ready='1'] :is([data-pane] canvas, [data-do=play])"),
        (4, ".player[data-ready='1'] :is([data-pane] canvas, [data-do=play])"),
        (5, ".player[data-ready='1'] :is([data-pane] canvas, [data-do=play])"),
    ],
)
def test_a_lesson_s_question_is_seen_with_its_maps_on_a_projector(
    chromium, app_url, lesson, pictures, size
):
    width, height = size
    page = window(chromium, {"width": width, "height": height})
    path = COURSE[lesson].path.partition("_")[2].removesuffix(".py")
    page.goto(f"{app_url}/{path}?projector=1&lesson={lesson}")
    page.locator(pictures).first.wait_for()
    page.wait_for_timeout(1000)  # the maps take their height
    question = page.locator(f".st-key-predict_{lesson}")
    assert question.get_by_role("button").count() == len(COURSE[lesson].options)
    asked = question.bounding_box()
    boxes = [one.bounding_box() for one in page.locator(pictures).all()]
    assert 0 <= asked["y"] < asked["y"] + asked["height"] <= boxes[0]["y"]
    assert all(box["y"] + box["height"] <= height for box in boxes)


def test_on_a_projector_digits_open_the_lessons_and_space_plays(page, app_url):
    page.goto(f"{app_url}/What_the_sensor_says?projector=1")
    page.wait_for_selector(".lens[data-ready='1']")
    page.keyboard.press("3")
    page.wait_for_url("**/Build_a_map?*projector=1*")
    page.get_by_text(COURSE[3].title).first.wait_for(state="attached")
    page.wait_for_selector(".player[data-ready='1']")
    page.keyboard.press(" ")
    page.wait_for_selector(".player[data-playing='1']")
    page.keyboard.press(" ")
    page.wait_for_selector(".player[data-playing='0']")
    page.get_by_role("button", name="Leave the projector").click()
    page.wait_for_url(lambda url: "projector" not in url)
    page.keyboard.press("1")
    page.wait_for_timeout(500)
    assert "Build_a_map" in page.url

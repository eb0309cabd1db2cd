"""A student without a pointer: from home to a lesson, a map, an exercise, a class."""

import pytest

from tests.browser.test_accessible import settled

pytestmark = pytest.mark.browser

MOST_STOPS = 70
FOCUSED = """() => {
  let node = document.activeElement;
  while (node?.shadowRoot?.activeElement) node = node.shadowRoot.activeElement;
  if (!node || node === document.body || node.tagName === "MAIN") return null;
  const box = node.getBoundingClientRect();
  const drawn = ({ outlineStyle, outlineWidth, boxShadow }) =>
    (outlineStyle !== "none" && parseFloat(outlineWidth) > 0) || boxShadow !== "none";
  let near = node;
  let isMarked = false;
  // A slider's thumb and a choice show the ring on what is around their input.
  for (let i = 0; near && i < 4; i++, near = near.parentElement) {
    isMarked ||= drawn(getComputedStyle(near));
  }
  const text = node.getAttribute("aria-label") ?? (node.innerText || node.value);
  const isSeen = box.bottom > 0 && box.top < innerHeight && box.width > 0;
  return { lines: `${text}`.split("\\n"), isMarked, isSeen };
}"""


def go_to(page, name, key="Tab"):
    """Press Tab until what has this name has the focus, and shows it."""
    for _ in range(MOST_STOPS):
        page.keyboard.press(key)
        found = page.evaluate(FOCUSED)
        # An icon is a line of its own.
        if found and any(line.startswith(name) for line in found["lines"]):
            assert found["isMarked"], f"{name} has the focus and does not show it"
            assert found["isSeen"], f"{name} has the focus off the screen"
            return
    raise AssertionError(f"{name} cannot be reached with {key}")


def follow(page, name, path):
    """Follow a link of the navigation, which the top of a page has."""
    page.keyboard.press("Control+Home")
    go_to(page, name, "Shift+Tab" if page.evaluate(FOCUSED) else "Tab")
    page.keyboard.press("Enter")
    page.wait_for_url(f"**/{path}*")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for()
    settled(page)


def test_everything_from_home_to_a_class_is_done_with_keys(page, app_url):
    page.goto(app_url)
    settled(page)
    go_to(page, "1. What the sensor says")
    page.keyboard.press("Enter")
    page.wait_for_url("**/What_the_sensor_says?*lesson=1*")
    page.locator(".lens[data-ready='1']").wait_for()
    settled(page)
    predict_and_move_the_robot(page)
    follow(page, "Build a map", "Build_a_map")
    play_scrub_pin_and_change_the_prior(page)
    follow(page, "Exercises", "Exercises")
    answer_and_take_a_hint(page)
    follow(page, "Class", "Class")
    go_to(page, "Prepare")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    page.get_by_role("button", name="Open a room").wait_for()


def predict_and_move_the_robot(page):
    go_to(page, "no, it cannot")
    page.keyboard.press("Enter")
    page.get_by_text("You predicted:").wait_for()
    settled(page)
    go_to(page, "Robot at x 8.5")
    page.keyboard.press("ArrowRight")
    page.get_by_role("button", name="Robot at x 9.5").wait_for()


def play_scrub_pin_and_change_the_prior(page):
    player = page.locator(".player[data-ready='1']")
    go_to(page, "Occupancy grid map")
    for key in ("ArrowRight", "ArrowDown", "Enter"):
        page.keyboard.press(key)
    player.and_(page.locator("[data-pinned='1']")).wait_for()
    go_to(page, "Play")
    page.keyboard.press("Enter")
    player.and_(page.locator("[data-playing='1']")).wait_for()
    page.keyboard.press("Enter")
    player.and_(page.locator("[data-playing='0']")).wait_for()
    go_to(page, "Reading")
    page.keyboard.press("Home")
    page.keyboard.press("ArrowRight")
    player.and_(page.locator("[data-step='1']")).wait_for()
    go_to(page, "p_wall")
    page.keyboard.press("ArrowRight")
    player.locator("[data-slider=p_wall] .value", has_text="0.21").wait_for()
    settled(page)


def answer_and_take_a_hint(page):
    go_to(page, "Exercise 11")
    page.keyboard.press("Enter")
    page.wait_for_url("**/Build_a_map*")
    page.get_by_role("button", name="Leave the exercise").wait_for()
    settled(page)
    page.keyboard.press("Control+Home")
    go_to(page, "0")  # the first of the answers
    page.keyboard.press("Space")
    page.get_by_role("button", name="Check").and_(page.locator(":enabled")).wait_for()
    settled(page)
    go_to(page, "Hint")
    page.keyboard.press("Enter")
    page.get_by_text("Hint. ").wait_for()

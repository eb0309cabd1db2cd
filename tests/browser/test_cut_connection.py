"""A server that goes away: the page says so, and a reload brings back what was kept."""

import pytest

from tests.browser.running import free_port, running_app
from tests.browser.test_main_job import settled
from tests.test_pages import png, rooms

pytestmark = pytest.mark.browser

CUT = ".occsim-cut"
PLAYER = ".player[data-ready='1']"


@pytest.fixture
def window(browser):
    """A window whose console is not watched: a lost server is an error there."""
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    context.set_default_timeout(60_000)
    page = context.new_page()
    # Leaving a building that the server lost is what these tests do.
    page.on("dialog", lambda dialog: dialog.accept())
    yield page
    context.close()


def range_px(window) -> str:
    return window.get_by_role("slider", name="Range").input_value()


def restarted(window, port, tmp_path, query, before=lambda: None):
    """A server that served the window, ended, and was started again."""
    with running_app(tmp_path / "first.log", port=port) as url:
        window.goto(f"{url}/Build_a_map{query}")
        window.wait_for_selector(PLAYER)
        before()
        assert window.locator(CUT).count() == 0
    said = window.locator(CUT)
    said.wait_for()
    assert "connection to the server was cut" in said.inner_text()
    assert said.get_attribute("role") == "alert"
    return running_app(tmp_path / "second.log", port=port)


def came_back(window):
    """The page has run again, in a session of the new server."""
    window.wait_for_selector("[data-test-connection-state=CONNECTED]")
    window.locator(CUT).get_by_text("is back").wait_for()
    settled(window)


def test_a_restarted_server_is_noticed_and_the_next_move_is_kept(window, tmp_path):
    """The session of the new server opens by the address as it is now, before the
    student moves."""

    def move(to: int) -> None:
        slider = window.get_by_role("slider", name="Range")
        slider.focus()
        slider.press("ArrowRight")
        window.wait_for_url(f"**range_px={to}**")

    query = "?drawing=d&range_px=33"
    with restarted(window, free_port(), tmp_path, query, lambda: move(34)):
        came_back(window)
        assert range_px(window) == "34"
        move(35)
        assert "drawing=d" in window.url
        assert range_px(window) == "35"
        window.locator(CUT).wait_for(state="detached")


def test_a_reload_after_a_restart_brings_the_settings_back(window, tmp_path):
    with restarted(window, free_port(), tmp_path, "?drawing=d&range_px=33"):
        came_back(window)
        window.get_by_role("button", name="Reload").click()
        window.wait_for_selector(PLAYER)
        assert window.locator(CUT).count() == 0
        assert "range_px=33" in window.url
        assert range_px(window) == "33"


def test_a_building_that_a_restarted_server_no_longer_has_is_told(window, tmp_path):
    def upload():
        window.get_by_role("button", name="Upload").click()
        window.locator("input[type=file]").first.set_input_files(
            {"name": "plan.png", "mimeType": "image/png", "buffer": png(rooms())}
        )
        window.wait_for_url("**work=**")

    with restarted(window, free_port(), tmp_path, "?range_px=33", upload):
        window.get_by_text("no longer on this server").wait_for()
        window.wait_for_selector(PLAYER)

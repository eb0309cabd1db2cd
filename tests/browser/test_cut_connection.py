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


def test_a_restarted_server_is_noticed_and_a_reload_brings_the_settings_back(
    window, tmp_path
):
    with restarted(window, free_port(), tmp_path, "?drawing=d&range_px=33"):
        # The client connects again by itself, to a session that knows nothing: what
        # happened must still be said.
        window.wait_for_selector("[data-test-connection-state=CONNECTED]")
        window.wait_for_timeout(1000)
        assert window.locator(CUT).is_visible()
        window.get_by_role("button", name="Reload").click()
        window.wait_for_selector(PLAYER)
        assert window.locator(CUT).count() == 0
        assert "range_px=33" in window.url
        assert range_px(window) == "33"


def test_a_restart_loses_one_move_and_no_setting(window, tmp_path):
    """The first event reaches a session that does not know the slider yet."""
    with restarted(window, free_port(), tmp_path, "?drawing=d&range_px=33"):
        window.wait_for_selector("[data-test-connection-state=CONNECTED]")
        slider = window.get_by_role("slider", name="Range")
        slider.focus()
        slider.press("ArrowRight")
        settled(window)
        assert range_px(window) == "33"
        assert window.locator(CUT).is_visible()
        slider.focus()
        slider.press("ArrowRight")
        window.wait_for_url("**range_px=34**")
        assert "drawing=d" in window.url
        window.locator(CUT).wait_for(state="detached")


def test_a_building_that_a_restarted_server_no_longer_has_is_told(window, tmp_path):
    def upload():
        window.get_by_role("button", name="Upload").click()
        window.locator("input[type=file]").first.set_input_files(
            {"name": "plan.png", "mimeType": "image/png", "buffer": png(rooms())}
        )
        window.wait_for_url("**work=**")

    with restarted(window, free_port(), tmp_path, "?range_px=33", upload):
        window.wait_for_selector("[data-test-connection-state=CONNECTED]")
        window.get_by_role("button", name="Reload").click()
        window.get_by_text("no longer on this server").wait_for()
        window.wait_for_selector(PLAYER)

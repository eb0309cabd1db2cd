"""What axe-core finds on every page: nothing of ours.

Ours or not is decided by the element: what Streamlit alone builds is listed below with
the reason why it stays.
"""

import pytest
from axe_playwright_python.sync_playwright import Axe

from pages._ui.navigation import PAGES

pytestmark = pytest.mark.browser

OF_STREAMLIT = {
    # The drop zone of an uploader has the role "presentation" and a name; its button
    # does the same work.
    ("presentation-role-conflict", "stFileUploaderDropzone"),
}
"""Findings that stay: the rule, and a part of the element."""
TAGS = [f"wcag2{one}" for one in ("a", "aa", "1a", "1aa", "2aa")] + ["best-practice"]
# Without the elements that passed, which are up to 3 MB a page.
OPTIONS = {"runOnly": TAGS, "resultTypes": ["violations"]}
LAPTOP = {"width": 1280, "height": 720}
PHONE = {"width": 390, "height": 844}
PAGE_PATHS = [
    "" if one.path == "app.py" else one.path.split("_", 1)[1][:-3] for one in PAGES
]
MORE_PATHS = [
    *(f"Your_building?section={number}" for number in (2, 4, 6)),
    "What_the_sensor_says?exercise=says_nothing",
    "Build_a_map?pin=100,100",
]


def settled(page):
    """Wait until the page and the components on it are drawn."""
    page.wait_for_timeout(300)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")
    for part in page.locator(".player, .lens").all():
        part.and_(page.locator("[data-ready='1']")).wait_for()
    page.wait_for_timeout(500)  # what fades in is whole


def background(page):
    app = page.locator("[data-testid=stApp]")
    return app.evaluate("element => getComputedStyle(element).backgroundColor")


def findings(page):
    """The rule, the element and the reason of each finding that is ours."""
    found = Axe().run(page, options=OPTIONS).response["violations"]
    return [
        f"{one['id']}: {node['html'][:200]}: {node['failureSummary']}"
        for one in found
        for node in one["nodes"]
        if not any(
            one["id"] == rule and part in node["html"] for rule, part in OF_STREAMLIT
        )
    ]


@pytest.mark.parametrize("path", PAGE_PATHS + MORE_PATHS)
def test_no_page_has_a_finding_of_ours(chromium, app_url, path):
    """On a laptop, light, and then the same page on a telephone, dark."""
    context = chromium.new_context(viewport=LAPTOP, color_scheme="light")
    page = context.new_page()
    page.goto(f"{app_url}/{path}")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for(timeout=60_000)
    settled(page)
    assert findings(page) == []
    light = background(page)
    page.emulate_media(color_scheme="dark")
    page.set_viewport_size(PHONE)
    settled(page)
    assert background(page) != light
    assert findings(page) == []
    context.close()

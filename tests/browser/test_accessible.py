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
VIEWS = {"laptop light": (1280, 720, "light"), "phone dark": (390, 844, "dark")}
PAGE_PATHS = [
    "" if one.path == "app.py" else one.path.split("_", 1)[1][:-3] for one in PAGES
]
MORE_PATHS = [
    *(f"Your_building?section={number}" for number in (2, 4, 6)),
    "What_the_sensor_says?exercise=says_nothing",
    "Build_a_map?pin=100,100",
]
CASES = [(path, view) for view in VIEWS for path in PAGE_PATHS]
CASES += [(path, "phone dark") for path in MORE_PATHS]


def findings(page):
    """The rule, the element and the reason of each finding that is ours."""
    found = Axe().run(page, options={"runOnly": TAGS}).response["violations"]
    return [
        f"{one['id']}: {node['html'][:200]}: {node['failureSummary']}"
        for one in found
        for node in one["nodes"]
        if not any(
            one["id"] == rule and part in node["html"] for rule, part in OF_STREAMLIT
        )
    ]


@pytest.mark.parametrize(("path", "view"), CASES)
def test_no_page_has_a_finding_of_ours(chromium, app_url, path, view):
    width, height, scheme = VIEWS[view]
    size = {"width": width, "height": height}
    context = chromium.new_context(viewport=size, color_scheme=scheme)
    page = context.new_page()
    page.goto(f"{app_url}/{path}")
    page.locator(".st-key-ending").get_by_text("Reset all").wait_for(timeout=60_000)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")
    for part in page.locator(".player, .lens").all():
        part.and_(page.locator("[data-ready='1']")).wait_for()
    page.wait_for_timeout(500)  # what fades in is whole
    assert findings(page) == []
    context.close()

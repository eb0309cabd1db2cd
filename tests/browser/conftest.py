"""Fixtures for what a person does: the app's address, a window of a real browser."""

import contextlib

import pytest
from playwright.sync_api import Error

from tests.browser.running import no_trouble, running_app, running_chromium


@pytest.fixture(scope="session")
def app_url(tmp_path_factory):
    """The address of the app; what its server wrote is read when all is done."""
    log_path = tmp_path_factory.mktemp("app") / "server.log"
    with running_app(log_path) as url:
        yield url
    no_trouble(log_path)


@pytest.fixture(scope="session")
def chromium():
    with running_chromium() as browser:
        yield browser


def error_text(line) -> list[str]:
    """What a console line complains of; Streamlit's probes for its base path aside.

    On a deep link its client first asks for the health of a server below that path,
    and the browser logs the 404 of that question.
    """
    probe = "404" in line.text and "_stcore" in line.location.get("url", "")
    where = line.location.get("url", "")
    return [f"{line.text} {where}"] if line.type == "error" and not probe else []


@pytest.fixture
def page(chromium):
    """A fresh window of 1280 x 720; an error on its console fails the test."""
    context = chromium.new_context(viewport={"width": 1280, "height": 720})
    window = context.new_page()
    window.set_default_timeout(30_000)
    errors: list[str] = []
    window.on("pageerror", lambda error: errors.append(str(error)))
    window.on("console", lambda line: errors.extend(error_text(line)))
    yield window
    with contextlib.suppress(Error):  # the browser may be gone already
        context.close()
    assert not errors, errors

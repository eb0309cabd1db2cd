"""Fixtures for browser tests: the app's address, windows of a real browser."""

import contextlib

import pytest
from playwright.sync_api import Error, expect

from tests.browser.running import (
    complaints,
    no_complaint,
    running_app,
    running_chromium,
)

PATIENCE_MS = 30_000
"""A test fails later, but not because the machine is busy."""
expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="session")
def app_url(tmp_path_factory):
    """The address of the app; the server's log is checked at the end."""
    log_path = tmp_path_factory.mktemp("app") / "server.log"
    with running_app(log_path) as url:
        yield url
    no_complaint(log_path)


@pytest.fixture(scope="session")
def browser():
    with running_chromium() as browser:
        yield browser


class Windows:
    """A browser whose windows are all watched for errors."""

    def __init__(self, browser):
        self.browser = browser
        self.contexts = []
        self.errors: list[str] = []

    def new_context(self, **options):
        context = self.browser.new_context(**options)
        context.set_default_timeout(PATIENCE_MS)
        context.on("weberror", lambda event: self.errors.append(str(event.error)))
        context.on("console", lambda line: self.errors.extend(complaints(line)))
        self.contexts.append(context)
        return context

    def close(self):
        for context in self.contexts:
            with contextlib.suppress(Error):  # the browser may be closed already
                context.close()


@pytest.fixture
def chromium(browser):
    """The browser; an error on the console of any window fails the test."""
    windows = Windows(browser)
    yield windows
    windows.close()
    assert not windows.errors, windows.errors


@pytest.fixture
def page(chromium):
    """A fresh window of 1280 x 720."""
    return chromium.new_context(viewport={"width": 1280, "height": 720}).new_page()

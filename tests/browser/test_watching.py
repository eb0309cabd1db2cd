"""An error in any window of the browser is noticed."""

import pytest

from tests.browser.conftest import Windows

pytestmark = pytest.mark.browser


@pytest.mark.parametrize(
    "script",
    [
        "console.error('a fault')",
        "setTimeout(() => { throw new Error('a fault'); })",
        "void Promise.reject(new Error('a fault'))",
    ],
)
def test_an_error_of_any_kind_is_kept(browser, script):
    windows = Windows(browser)
    page = windows.new_context().new_page()
    page.evaluate(script)
    page.wait_for_timeout(100)
    windows.close()
    assert len(windows.errors) == 1
    assert "a fault" in windows.errors[0]

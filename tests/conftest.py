"""Settings of hypothesis, and a check of the pages' log."""

import logging
import os

import pytest
from hypothesis import HealthCheck, settings

# No deadline: a test must not fail because the machine is busy.
settings.register_profile(
    "here", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("ci", settings.get_profile("here"), derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")


def pytest_collection_modifyitems(items):
    """The minute of the random students goes first: at the end it would run alone."""
    items.sort(key=lambda item: "robust/test_student" not in item.nodeid)


@pytest.fixture(autouse=True)
def pages_log_no_error(request):
    """Fail a test in which a page or a callback caught and logged an error.

    A page shows a sentence instead of a traceback, so `AppTest.exception` is empty.
    A test that provokes such an error is marked ``provokes_errors``.
    """
    met = []
    handler = logging.Handler(logging.ERROR)
    handler.emit = lambda record: met.append(record.getMessage())
    logger = logging.getLogger("pages")
    logger.addHandler(handler)
    yield met
    logger.removeHandler(handler)
    if not request.node.get_closest_marker("provokes_errors"):
        assert not met, met

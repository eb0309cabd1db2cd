"""The running app and a real Chromium, for tests and for the README's pictures."""

import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, ConsoleMessage, sync_playwright

ROOT = Path(__file__).resolve().parents[2]
START_SECONDS = 60
# As tests/run looks for it.
CHROMIUM_NAMES = ("chromium", "chromium-browser", "google-chrome")
# What Playwright turns off itself: of two such lists Chromium takes the last one.
OFF_BY_PLAYWRIGHT = [
    "AvoidUnnecessaryBeforeUnloadCheckSync",
    "DestroyProfileOnBrowserClose",
    "HttpsUpgrades",
    "HttpsFirstBalancedModeAutoEnable",
    "LensOverlay",
    "MediaRouter",
    "PaintHolding",
    "ThirdPartyStoragePartitioning",
    "AvoidCorsURLLoaderRestartOnRedirect",
    "OptimizationHints",
    "NetworkTimeServiceQuerying",
    "AimEnabled",
    "PreconnectToSearch",
]
# Pages of the address bar's list of suggestions, which each window loads unseen: 0.8 s
# of a processor for a window, where an empty page takes 0.25 s.
SUGGESTIONS = ["WebUIOmniboxPopup", "WebUIOmniboxAimPopup"]
CHROMIUM_ARGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-features=" + ",".join(OFF_BY_PLAYWRIGHT + SUGGESTIONS),
]


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _is_up(url: str) -> bool:
    try:
        with urllib.request.urlopen(f"{url}/_stcore/health", timeout=2) as answer:
            return answer.status == 200
    except OSError:
        return False


@contextmanager
def running_app(
    log_path: Path, script: str = "app.py", port: int | None = None
) -> Iterator[str]:
    """Start the app as the README does, on a free port; give its address."""
    port = port or free_port()
    url = f"http://localhost:{port}"
    command = [sys.executable, "-m", "streamlit", "run", script]
    options = ["--server.port", str(port), "--server.headless", "true"]
    with log_path.open("w") as log:
        server = subprocess.Popen(
            command + options, cwd=ROOT, stdout=log, stderr=subprocess.STDOUT
        )
        try:
            deadline = time.monotonic() + START_SECONDS
            while not _is_up(url):
                if server.poll() is not None or time.monotonic() > deadline:
                    raise RuntimeError(f"no app at {url}:\n{log_path.read_text()}")
                time.sleep(0.2)
            yield url
        finally:
            server.terminate()
            server.wait(timeout=20)


ASGI = re.compile(
    r"Exception in ASGI application\n"
    r"(?:\n|(?:Traceback|During handling|  |[\w.]+(?:Error|Disconnected))[^\n]*\n)*"
)
UNOPENED = "WebSocket is not connected"
"""What Streamlit's server logs where a browser leaves before its websocket is open."""


def no_complaint(log_path: Path) -> None:
    """Fail where the server logged an error or a warning."""
    text = ASGI.sub(lambda m: "" if UNOPENED in m[0] else m[0], log_path.read_text())
    for complaint in ("Traceback", "Warning"):
        where = text.find(complaint)
        assert where < 0, text[max(0, where - 500) : where + 2000]


def complaints(line: ConsoleMessage) -> list[str]:
    """Errors in a console line, except Streamlit's probes for its base path.

    On a deep link its client first asks for the health of a server below that path,
    and the browser logs a 404 for that request.
    """
    where = line.location.get("url", "")
    is_probe = "404" in line.text and "_stcore" in where
    return [f"{line.text} {where}"] if line.type == "error" and not is_probe else []


@contextmanager
def running_chromium() -> Iterator[Browser]:
    """Start the browser that CHROMIUM names, one on the PATH, or Playwright's own."""
    names = os.environ.get("CHROMIUM"), *CHROMIUM_NAMES
    found = next(filter(None, (shutil.which(name) for name in names if name)), None)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=found, args=CHROMIUM_ARGS)
        yield browser
        browser.close()

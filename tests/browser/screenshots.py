"""Take the README's pictures: python -m tests.browser.screenshots."""

import tempfile
from pathlib import Path

from tests.browser.running import ROOT, running_app, running_chromium

FOLDER = ROOT / "assets" / "screenshots"
PICTURES = {"build_a_map": "/Build_a_map"}
SIZE = {"width": 1280, "height": 720}


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    with (
        tempfile.TemporaryDirectory() as scratch,
        running_app(Path(scratch) / "server.log") as url,
        running_chromium() as browser,
    ):
        page = browser.new_page(viewport=SIZE)
        for name, path in PICTURES.items():
            page.goto(url + path)
            page.wait_for_selector(".player[data-ready='1']")
            page.wait_for_timeout(1500)
            page.screenshot(path=FOLDER / f"{name}.png")


if __name__ == "__main__":
    main()

"""A random student: ``python -m tests.robust.student --minutes 2 --seed 1``.

Clicks, types, draws, uploads, reloads, and clicks several times within 50 ms. Fails
where the app's server logs a traceback, a page shows that it failed, or the browser
has an error on its console. The same seed gives the same choices, though not the same
timing.
"""

import argparse
import random
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from playwright.sync_api import Error, Locator, Page

from tests.browser.running import complaints, running_app, running_chromium

FAILED = "an error in this program"
PAUSE_MS = (0, 20, 120, 400, 1200)
SHORT_MS = 1500
"""Wait, ms, for an element that the last click may have removed."""
CLICKABLE = (
    '[data-testid="stButton"] button, [data-testid="stButtonGroup"] button, '
    '[data-testid="stCheckbox"] label, [data-testid="stRadio"] label, '
    '[data-testid="stPopover"] button, summary'
)
IN_COMPONENTS = ".player button, .player label, .board button, .address button"


def plan(rng: random.Random) -> bytes:
    """A small plan of rooms, of one size or another."""
    height, width = rng.choice([(160, 220), (300, 260), (90, 400)])
    image = np.full((height, width), 255, np.uint8)
    cv2.rectangle(image, (8, 8), (width - 9, height - 9), 0, 6)
    cv2.line(image, (width // 2, 8), (width // 2, height // 2), 0, 6)
    return cv2.imencode(".png", image)[1].tobytes()


def files(rng: random.Random) -> dict[str, object]:
    """A file for an upload: right or wrong."""
    poses = "x,y,theta\n" + "".join(
        f"{rng.uniform(0, 200):.1f},{rng.uniform(0, 200):.1f},{rng.uniform(0, 6):.2f}\n"
        for _ in range(30)
    )
    name, content = rng.choice(
        [
            ("plan.png", plan(rng)),
            ("plan.png", plan(rng)),
            ("way.csv", poses.encode()),
            ("empty.png", b""),
            ("words.png", b"no image at all"),
            ("words.csv", b"a,b,c\nx,y,z\n"),
            ("broken.zip", b"PK\x03\x04 no archive"),
        ]
    )
    return {"name": name, "mimeType": "application/octet-stream", "buffer": content}


OVERTAKEN = ("/media/", "Download Button source error")
KEY_TOO_EARLY = "Cannot rerun script when disconnected"
"""Streamlit's own key r, pressed before the page has its connection."""


def is_serious(complaint: str) -> bool:
    """Whether a line on the console is more than a run or a key out of time.

    A picture of a run that the next click interrupted may be gone when the browser asks
    for it; the next run sends its own.
    """
    return not any(word in complaint for word in (*OVERTAKEN, KEY_TOO_EARLY))


class Student:
    """One student in one window."""

    def __init__(self, page: Page, url: str, rng: random.Random):
        self.page, self.url, self.rng = page, url, rng
        self.last: list[str] = []
        self.acts: list[tuple[int, Callable[[], None]]] = [
            (6, self.click_something),
            (6, self.move_a_slider),
            (4, self.go_to_a_page),
            (4, self.click_in_a_component),
            (4, self.draw_on_a_canvas),
            (4, self.burst),
            (3, self.choose_from_a_list),
            (2, self.upload),
            (2, self.undo_and_redo),
            (1, self.reload),
            (1, self.go_back),
            (1, self.press_keys),
        ]

    def act(self) -> None:
        """Do one action; an action that is not possible is no fault."""
        weights = [weight for weight, _ in self.acts]
        [(_, what)] = self.rng.choices(self.acts, weights)
        self.last = [*self.last[-30:], what.__name__]
        try:
            what()
        except Error as error:
            # The element went away, or something lay over it.
            self.last[-1] += f" ({str(error).splitlines()[0][:60]})"
        self.page.wait_for_timeout(self.rng.choice(PAUSE_MS))

    def check(self) -> None:
        """Fail where the page says that it failed."""
        self.page.wait_for_timeout(300)
        boxes = self.page.locator('[data-testid="stException"]').count()
        failed = self.page.get_by_text(FAILED).count()
        if boxes or failed:
            raise AssertionError(f"the page failed after {self.last}")

    def one_of(self, selector: str) -> Locator:
        found = self.page.locator(selector)
        count = found.count()
        if not count:
            raise Error(f"no {selector[:40]}")
        return found.nth(self.rng.randrange(count))

    def click_something(self) -> None:
        self.one_of(CLICKABLE).click(timeout=SHORT_MS)

    def click_in_a_component(self) -> None:
        self.one_of(IN_COMPONENTS).click(timeout=SHORT_MS)

    def move_a_slider(self) -> None:
        slider = self.one_of('input[type="range"], [role="slider"]')
        slider.focus(timeout=SHORT_MS)
        keys = ["ArrowRight", "ArrowLeft", "PageUp", "PageDown", "Home", "End"]
        for _ in range(self.rng.randint(1, 6)):
            self.page.keyboard.press(self.rng.choice(keys))

    def go_to_a_page(self) -> None:
        self.one_of('.st-key-lessons a[href], [data-testid="stPageLink"] a').click(
            timeout=SHORT_MS
        )

    def choose_from_a_list(self) -> None:
        self.one_of('[data-testid="stSelectbox"] [role="combobox"]').click(
            timeout=SHORT_MS
        )
        self.one_of('[role="option"]').click(timeout=SHORT_MS)

    def draw_on_a_canvas(self) -> None:
        box = self.one_of("canvas").bounding_box(timeout=SHORT_MS)
        if box is None:
            return

        def place() -> tuple[float, float]:
            x = box["x"] + self.rng.random() * box["width"]
            return x, box["y"] + self.rng.random() * box["height"]

        self.page.mouse.move(*place())
        self.page.mouse.down()
        for _ in range(self.rng.randint(0, 5)):
            self.page.mouse.move(*place(), steps=3)
        self.page.mouse.up()

    def burst(self) -> None:
        """Click several things within 50 ms."""
        picks = [self.rng.random() for _ in range(self.rng.randint(2, 6))]
        self.page.evaluate(
            """([selector, picks]) => {
                for (const pick of picks) {
                    const all = [...document.querySelectorAll(selector)];
                    if (all.length) all[Math.floor(pick * all.length)].click();
                }
            }""",
            [CLICKABLE + ', [data-testid="stPageLink"] a', picks],
        )

    def undo_and_redo(self) -> None:
        for label in self.rng.choices(["Undo", "Redo", "Reset all"], k=3):
            button = self.page.get_by_role("button", name=label, exact=True).first
            if button.count():
                button.dispatch_event("click", timeout=SHORT_MS)

    def upload(self) -> None:
        self.one_of('input[type="file"]').set_input_files(
            files(self.rng), timeout=SHORT_MS
        )

    def reload(self) -> None:
        self.page.reload()

    def go_back(self) -> None:
        self.page.evaluate("history.back()")

    def press_keys(self) -> None:
        keys = ["Tab", "Enter", "Space", "Escape", "ArrowRight", "Control+z", "r"]
        for _ in range(self.rng.randint(1, 8)):
            self.page.keyboard.press(self.rng.choice(keys))


def study(minutes: float, seed: int, log_path: Path) -> int:
    """Run a random student for some time; return the number of actions."""
    rng = random.Random(seed)
    errors: list[str] = []
    done = 0
    with running_app(log_path) as url, running_chromium() as browser:
        sizes = [(1280, 720), (390, 844), (1920, 1080)]
        width, height = rng.choice(sizes)
        page = browser.new_page(viewport={"width": width, "height": height})
        page.set_default_timeout(20_000)
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "console", lambda line: errors.extend(filter(is_serious, complaints(line)))
        )
        page.on("dialog", lambda dialog: dialog.accept())
        page.goto(url)
        student = Student(page, url, rng)
        end = time.monotonic() + 60.0 * minutes
        while time.monotonic() < end:
            student.act()
            done += 1
            if done % 5 == 0:
                student.check()
            if not page.url.startswith(url):
                page.goto(url)
            if errors:
                raise AssertionError(f"{errors[:3]} after {student.last}")
        student.check()
    log = log_path.read_text()
    if "Traceback" in log:
        raise AssertionError(log[log.index("Traceback") :][:3000])
    return done


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=2.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        try:
            done = study(options.minutes, options.seed, Path(folder) / "server.log")
        except AssertionError as failure:
            print(f"seed {options.seed}: {failure}")
            return 1
    print(f"seed {options.seed}: {done} things done, no failure")
    return 0


if __name__ == "__main__":
    sys.exit(main())

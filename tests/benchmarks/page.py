"""Home and "Build a map" in a real browser, warm, beside a blank Streamlit page."""

import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median

from playwright.sync_api import Page

from tests.benchmarks.table import Row, timed_row
from tests.browser.running import running_app, running_chromium

PLAYER = ".player[data-ready='1']"
REPEATS = 7
FRAMES_JS = """root => new Promise(done => {
    let frames = 0;
    const start = performance.now();
    const count = now => {
        frames += 1;
        now - start < 3000 ? requestAnimationFrame(count) : done(frames / 3);
    };
    root.querySelector('[data-do=play]').click();
    requestAnimationFrame(count);
})"""
HEADER_JS = """(root, [word, value]) => new Promise(done => {
    const start = performance.now();
    const list = root.querySelector(`[data-header="1"] [data-word=${word}]`);
    list.value = value;
    list.dispatchEvent(new Event('change'));
    const wait = () => {
        const { columns, state } = root.player;
        const key = JSON.stringify([state.columns[1], state.overlay]);
        columns[1].key === key ? done(performance.now() - start) : setTimeout(wait, 2);
    };
    wait();
})"""


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as scratch, running_chromium() as browser:
        log = Path(scratch) / "server.log"
        blank_app = Path(scratch) / "blank.py"
        blank_app.write_text("import streamlit\nstreamlit.write('ready')\n")
        with running_app(log, str(blank_app)) as url:
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            blank = _opening_ms(page, url, "text=ready")
        with running_app(log) as url:
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            yield _opening_row("home", _opening_ms(page, url, PLAYER), blank, 1500)
            opening = _opening_ms(page, f"{url}/Build_a_map", PLAYER)
            yield _opening_row("page", opening, blank, 2000)
            yield timed_row(
                "a moved slider's new map on screen, new settings each time",
                _slider_ms(page),
                400,
            )
            yield from _player_rows(page)
            page.goto(f"{url}/Two_maps?columns=--rsubtract_prior--u1")
            page.wait_for_selector(PLAYER)
            yield from _three_maps_rows(page)


def _opening_row(name: str, ms: float, blank_ms: float, goal_ms: float) -> Row:
    beside = f"blank Streamlit page {blank_ms:.0f} ms, x {ms / blank_ms:.1f}"
    return timed_row(f"{name} open until the player is drawn", ms, goal_ms, beside)


def _median_ms(call: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return 1e3 * median(times)


def _opening_ms(page: Page, url: str, ready: str) -> float:
    def open_it() -> None:
        page.goto(url)
        page.wait_for_selector(ready)

    open_it()
    return _median_ms(open_it)


def _slider_ms(page: Page) -> float:
    """Time from the key that moves the range to the player's new replay."""
    page.get_by_role("slider", name="Range").focus()

    def move() -> None:
        player = page.locator(PLAYER).element_handle()
        before = player.evaluate("root => root.player.header.digest")
        page.keyboard.press("ArrowRight")
        page.wait_for_function(
            "([root, before]) => root.player.header.digest !== before",
            arg=[player, before],
        )

    return _median_ms(move)


def _player_rows(page: Page) -> Iterator[Row]:
    player = page.locator(PLAYER)
    recolour, scrub = [], []
    for value in range(30):
        slider = player.locator("[data-slider=p_space] input")
        slider.fill(f"{0.3 + 0.02 * value:.2f}")
        recolour.append(float(player.evaluate("root => root.dataset.recolourMs")))
        player.locator("[data-part=scrub]").fill(str(10 * value))
        scrub.append(float(player.evaluate("root => root.dataset.drawMs")))
    yield timed_row("prior moved in the player, script time", median(recolour), 30)
    yield timed_row("scrubbed in the player, script time", median(scrub), 30)
    yield _frames_row("replay", page)


def _frames_row(name: str, page: Page) -> Row:
    frames = page.locator(PLAYER).evaluate(FRAMES_JS)
    return Row(name, f"{frames:.0f} frames/s", "60 frames/s", "", frames > 58)


def _three_maps_rows(page: Page) -> Iterator[Row]:
    yield _frames_row("three maps on one clock", page)
    page.locator("[data-header='1'] .more").click()
    known = [
        _header_ms(page, "rule", ("prior_once", "subtract_prior")[i % 2])
        for i in range(8)
    ]
    yield timed_row("a map's rule changed in its header", median(known), 300)
    drawings = ("mirrored", "d", "e", "empty")
    new = [_header_ms(page, "drawing", drawing) for drawing in drawings]
    yield timed_row("a map's drawing changed, its walls sent", median(new), 300)


def _header_ms(page: Page, word: str, value: str) -> float:
    """Time from a choice in the second map's header until that map is redrawn."""
    return page.locator(PLAYER).evaluate(HEADER_JS, [word, value])

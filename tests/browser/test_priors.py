"""Sweep, explorer, best prior and study in a real browser."""

import json
import re
import time
from pathlib import Path

import numpy as np
import pytest

from occsim import Prior
from occsim.io.prior_map import prior_npy
from pages._ui import compute
from pages._ui.settings import Settings
from tests.test_priors_pages import longest_front

pytestmark = pytest.mark.browser

PICTURE = "[data-testid=stImage] img"


def open_page(page, app_url, path):
    page.goto(f"{app_url}/{path}")
    page.wait_for_selector("h1")
    settled(page)


def settled(page):
    """Wait until the server has finished its run."""
    page.wait_for_timeout(500)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")
    page.wait_for_timeout(300)


def chosen(page):
    """The pair whose map is on the screen."""
    # Its title is (p_wall, p_space) = (0.2, 0.9), the names set as mathematics.
    title = page.locator("strong").filter(has=page.locator(".katex")).first
    text = title.inner_text()
    p_wall, p_space = re.search(r"\(([\d.]+), ([\d.]+)\)$", text).groups()
    return float(p_wall), float(p_space)


def chart(page, number):
    return page.locator("[data-testid=stPlotlyChart] .js-plotly-plot").nth(number)


def place(plot, x, y):
    """The pixel of the window at which a chart shows (x, y)."""
    return plot.evaluate(
        """(plot, [x, y]) => {
            const { xaxis, yaxis } = plot._fullLayout;
            const box = plot.getBoundingClientRect();
            return [box.left + xaxis._offset + xaxis.l2p(x),
                    box.top + yaxis._offset + yaxis.l2p(y)];
        }""",
        [x, y],
    )


def still_place(page, plot, x, y):
    """The same, once the charts above have taken their height."""
    last, at = None, place(plot, x, y)
    while at != last:
        page.wait_for_timeout(300)
        last, at = at, place(plot, x, y)
    return at


def click_at(page, plot, x, y):
    """Click a place in a chart; return the seconds until another map was shown."""
    plot.scroll_into_view_if_needed()
    left, top = still_place(page, plot, x, y)
    page.mouse.move(left, top)
    page.wait_for_timeout(150)
    before = page.locator(PICTURE).first.get_attribute("src")
    start = time.perf_counter()
    page.mouse.click(left, top)
    page.wait_for_function(
        "([css, src]) => document.querySelector(css).getAttribute('src') !== src",
        arg=[PICTURE, before],
    )
    return time.perf_counter() - start


def test_a_click_on_a_surface_shows_the_map_of_that_pair(page, app_url):
    open_page(page, app_url, "Sweep_the_priors?drawing=a")
    for number, (p_wall, p_space) in enumerate([(0.5, 0.3), (0.8, 0.7)]):
        seconds = click_at(page, chart(page, number), p_space, p_wall)
        print(f"map of a pair after {1000 * seconds:.0f} ms")
        settled(page)
        assert chosen(page) == (p_wall, p_space)
    run = compute.reference_run("a", Settings())
    recall = run.scores(Prior(p_wall=0.8, p_space=0.7)).recall
    assert page.get_by_text(f"{100 * recall:.1f} %").first.is_visible()


def test_a_second_click_keeps_the_pair_and_pages_share_it(page, app_url):
    open_page(page, app_url, "Sweep_the_priors?drawing=a")
    plot = chart(page, 0)
    click_at(page, plot, 0.3, 0.5)
    settled(page)
    left, top = place(plot, 0.3, 0.5)
    page.mouse.click(left, top)
    settled(page)
    assert chosen(page) == (0.5, 0.3)
    page.get_by_role("link", name="Pareto explorer").click()
    page.wait_for_selector("h1:has-text('Pareto explorer')")
    settled(page)
    assert chosen(page) == (0.5, 0.3)
    page.get_by_role("link", name="Build a map").click()
    player = page.locator(".player[data-ready='1']")
    player.wait_for()
    settled(page)
    player.focus()
    page.keyboard.press("End")
    page.wait_for_timeout(300)
    shown = player.evaluate("root => ({...root.dataset})")
    run = compute.reference_run("a", Settings())
    scores = run.scores(Prior(p_wall=0.5, p_space=0.3))
    assert (int(shown["tp"]), int(shown["fp"])) == (scores.tp, scores.fp)


def test_a_click_on_the_front_shows_its_map(page, app_url):
    name, front = longest_front(5)
    open_page(page, app_url, f"Pareto_explorer?drawing={name}&cell_px=5")
    seconds = []
    for i in (0, len(front) - 1):
        at = 100 * float(front.recall[i]), 100 * float(front.precision[i])
        seconds.append(click_at(page, chart(page, 0), *at))
        settled(page)
        expected = float(front.p_wall[i]), float(front.p_space[i])
        assert chosen(page) == pytest.approx(expected, rel=1e-3)
        assert page.get_by_text("The chosen pair is on the front.").first.is_visible()
    print("map of a point after", [f"{1000 * s:.0f} ms" for s in seconds])
    page.get_by_role("button", name="Best precision", exact=True).first.click()
    settled(page)
    # The point that was clicked last is still selected in the chart.
    click_at(page, chart(page, 0), *at)
    settled(page)
    assert chosen(page) == pytest.approx(expected, rel=1e-3)


def test_a_search_is_watched_stopped_and_replayed(page, app_url):
    open_page(page, app_url, "Pareto_explorer?exploring=search&n_gen=200&pop_size=200")
    page.get_by_role("button", name="Run the search").click()
    page.get_by_text(re.compile(r"Generation \d+ of 200")).first.wait_for()
    page.get_by_role("button", name="Stop").click()
    page.get_by_text(re.compile(r"Stopped\. \d+ generations of 200 pairs")).wait_for()
    settled(page)
    plot = chart(page, 0)
    frames = plot.evaluate("plot => plot._transitionData._frames.length")
    assert 1 <= frames < 200
    page.locator(".updatemenu-button").first.click()
    page.wait_for_timeout(500)


def test_the_prior_map_that_is_downloaded_is_the_recommended_one(page, app_url):
    open_page(page, app_url, "Best_prior?drawing=b&cell_px=5")
    files = {}
    for name in ("PNG", "NPY", "CSV", "JSON"):
        with page.expect_download() as waiting:
            page.get_by_role("button", name=name, exact=True).click()
        files[name] = waiting.value.path().read_bytes()
    document = json.loads(files["JSON"])
    names = ("p_wall", "p_space", "scale")
    kept = {name: document["prior"][name] for name in names}
    run = compute.reference_run("b", Settings(cell_px=5))
    made = run.prior_map(Prior(**kept))
    assert files["NPY"] == prior_npy(made)
    rows = [line for line in files["CSV"].decode().splitlines() if line[0] != "#"]
    read = np.array([[float(v) for v in row.split(",")] for row in rows])
    np.testing.assert_allclose(read, made.p_free, rtol=1e-11)
    assert files["PNG"].startswith(b"\x89PNG")
    assert document["chosen_on"]["recall"] > 0.4


def test_the_study_prints_its_tables(page, app_url):
    open_page(page, app_url, "Study")
    start = time.perf_counter()
    page.get_by_text(re.compile(r"of 15 cases, and nowhere else")).first.wait_for()
    print(f"study on screen {time.perf_counter() - start:.1f} s after the title")
    page.locator("[data-testid=stTable]").nth(1).wait_for()
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Tables (CSV)").click()
    lines = waiting.value.path().read_text().splitlines()
    assert len(lines) == 31


def test_a_chart_is_saved_as_svg_under_its_name(page, app_url):
    open_page(page, app_url, "Sweep_the_priors")
    chart = page.locator(".js-plotly-plot").first
    chart.hover()
    with page.expect_download() as saved:
        chart.locator(".modebar-btn").click()
    assert saved.value.suggested_filename == "surface_precision_prior_once.svg"
    assert Path(saved.value.path()).read_text().startswith("<svg")

"""Helpers for tests of the map player: its first run, and its controls."""

from functools import cache

import numpy as np

from occsim import MappingRun, MapSettings, Sensor, load_sample

CELL_PX = 3
FOV_RAD = np.pi / 6
ROOT = ".player"


@cache
def run(cell_px=CELL_PX):
    """The run that the page shows first, by occsim: log, wall cells, truth."""
    sample = load_sample("a")
    sensor = Sensor(range_px=sample.sensor.range_px, fov_rad=FOV_RAD)
    made = MappingRun(sample, MapSettings(cell_px=cell_px, sensor=sensor))
    return made.evidence, made.wall_cells, made.truth_cells


def open_player(page, app_url, query=""):
    page.goto(f"{app_url}/Build_a_map?drawing=a{query}")
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    return page.locator(ROOT)


def shown(player, *names):
    data = player.evaluate("root => ({...root.dataset})")
    return [int(data[name]) for name in names]


def inspect(player, name):
    """One of the player's numbers: hover, pin, scale, log-odds, the pinned history.

    All of them are some 10,000 numbers twice over, half a second for Playwright.
    """
    return player.evaluate("(root, name) => root.inspect()[name]", name)


def scrub(player, step):
    player.locator("[data-part=scrub]").fill(str(step))


def slide(player, name, value):
    player.locator(f"[data-slider={name}] input").fill(f"{value:.2f}")


def choose(player, name, value):
    player.locator(f"input[name={name}][value={value}]").check()


def point_of(player, cell, grid=None):
    """Where the middle of a cell is on the page, CSS px."""
    grid = grid or run()[0].grid
    box = player.locator("[data-pane=map] canvas").bounding_box()
    row, col = divmod(cell, grid.n_cols)
    scale = box["width"] / grid.width_px
    x, y = (col + 0.5) * grid.cell_px, (row + 0.5) * grid.cell_px
    return box["x"] + x * scale, box["y"] + y * scale


def wait_until(page, player, condition):
    page.wait_for_function(condition, arg=player.element_handle())


def settled(page):
    """Wait until the page has processed the player's commit."""
    page.wait_for_timeout(600)
    page.wait_for_selector("[data-testid=stApp][data-test-script-state=notRunning]")

"""gmapping's counts in a browser: `hits_visits` of the same scans, to the pixel."""

import numpy as np
import pytest

from occsim import ScanLog, Sensor, hits_visits, load_sample, simulate_scans
from pages._ui import logs
from pages._ui.compute import with_walls
from pages._ui.robot_data.played import play_log, simulated_log
from pages._ui.settings import Settings
from tests.browser.players import ROOT, inspect, scrub, wait_until
from tests.browser.test_two_maps import choose_word, open_maps, samples_of

pytestmark = pytest.mark.browser

OF_CLASSES = {0.1: 26, 0.5: 128, 0.9: 230}
"""Grey of occupied, unknown and free: 255 p_free, rounded."""


def first(scan_log, n):
    """The first n scans of a log."""
    most = scan_log.max_range_px
    return ScanLog(
        scan_log.poses[:n], scan_log.bearings_rad, scan_log.ranges_px[:n], most
    )


def assert_counted(player, step, scan_log, sensor, grid):
    """Map B is that of the counts, in its numbers and in its painted pixels.

    What lies under the robot and its beams, within the sensor's reach, is left out.
    """
    scrub(player, step)
    declared = hits_visits(first(scan_log, step), sensor, grid).declared()
    numbers = inspect(player, "maps")[1]
    np.testing.assert_array_equal(numbers["logOdds"], declared.log_odds.ravel())
    rows, cols = np.mgrid[: grid.n_rows, : grid.n_cols] + 0.5
    x, y, _ = scan_log.poses[step - 1]
    away = np.hypot(cols * grid.cell_px - x, rows * grid.cell_px - y)
    clear = (declared.n_updates > 0) & (away > sensor.range_px + 8)
    assert clear.sum() > 100
    grey = np.vectorize(OF_CLASSES.get)(declared.p_free.round(9))
    painted = samples_of(player, 1, grid)
    wrong = np.abs(painted - grey[:, :, None]).max(axis=-1) > 1.01
    assert not (wrong & clear).any()
    assert (declared.p_free[clear] < 0.2).any()
    assert (declared.p_free[clear] > 0.8).any()


def scans_of(range_px, fov_deg):
    """The scans of sample c, a beam for each pixel of the rim, as the page says."""
    sample = load_sample("c")
    sensor = Sensor(range_px=range_px, fov_rad=np.deg2rad(fov_deg))
    n_beams = int(np.ceil(sensor.range_px * sensor.fov_rad))
    return simulate_scans(sample.world, sample.trajectory, sensor, n_beams), sensor


def test_counts_on_two_maps_are_the_librarys_also_after_changed_settings(page, app_url):
    world = load_sample("c").world
    player = open_maps(page, app_url, "?range_px=24&fov_deg=40")
    choose_word(player, 1, "model", "hits_visits")
    wait_until(page, player, "root => root.player.columns[1].log.coded")
    scan_log, sensor = scans_of(24, 40)
    for step in (200, scan_log.n_scans, 150):
        assert_counted(player, step, scan_log, sensor, world.grid(3))
    choose_word(player, 1, "cell_px", "5")
    wait_until(page, player, "root => root.player.columns[1].log.cellPx === 5")
    assert_counted(player, 300, scan_log, sensor, world.grid(5))
    page.locator("[data-testid=stSlider] input[type=range]").first.press("ArrowRight")
    wait_until(page, player, "root => root.player.scene.rangePx === 25")
    wait_until(page, player, "root => root.player.columns[1].log.coded")
    scan_log, sensor = scans_of(25, 40)
    assert_counted(player, 300, scan_log, sensor, world.grid(5))


def test_counts_of_a_log_are_the_librarys(page, app_url):
    page.goto(f"{app_url}/Robot_data?usable_range_m=3")
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    page.get_by_role("radio", name="Beside gmapping's").click()
    player = page.locator(ROOT)
    wait_until(page, player, "root => root.player?.columns?.[1]?.log.coded")
    options = logs.options(Settings(usable_range_m=3))
    made = play_log(simulated_log(with_walls(load_sample("b"))), options)
    scan_log = made.scans.scan_log
    for step in (scan_log.n_scans, 200):
        assert_counted(player, step, scan_log, made.sensor, made.grid)

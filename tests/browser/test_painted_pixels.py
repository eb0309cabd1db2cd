"""The player's pixels: every cell's colour, and the sensor's cone, against occsim.

The canvases are read back as pictures and compared with arrays that occsim computed.
"""

import base64
from itertools import product

import cv2
import numpy as np
import pytest

from occsim import Prior, UpdateRule, fuse, load_sample
from occsim.logodds import is_occupied
from occsim.prior import prior_from_cells
from pages._ui import palette
from pages._ui.choices import Overlay
from tests.browser.players import choose, open_player, run, scrub, settled, slide

pytestmark = pytest.mark.browser

TINT = 0.55
"""Share of an overlay's colour over the grey beneath."""
ROBOT_PX = 8
"""Radius around the robot's mark, with a margin, px of the canvas."""
STEPS_AND_PRIORS = [(0, 0.2, 0.9), (137, 0.63, 0.31), (420, 0.05, 1.0), (136, 1.0, 0.1)]


def rgb(colour):
    return np.array(list(bytes.fromhex(colour.removeprefix("#"))), dtype=np.float64)


def decoded(url):
    data = np.frombuffer(base64.b64decode(url.partition(",")[2]), np.uint8)
    return cv2.cvtColor(cv2.imdecode(data, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)


def painted(player, pane):
    """What a canvas shows, uint8 of shape (height, width, 3)."""
    selector = f"[data-pane={pane}] canvas"
    url = player.locator(selector).evaluate("canvas => canvas.toDataURL()")
    return decoded(url).astype(np.float64)


def paper(player):
    """The drawing without marks over it, at the size of its canvas."""
    url = player.evaluate("root => root.player.paper.toDataURL()")
    return decoded(url).astype(np.float64)


class Cone:
    """Where the sensor is drawn, px of the canvas."""

    def __init__(self, shape, step, range_px, fov_rad):
        pose = load_sample("a").trajectory.poses[max(0, step - 1)]
        self.shape = shape[:2]
        self.scale = shape[1] / run()[0].grid.width_px
        self.at = pose[:2] * self.scale
        self.reach = range_px * self.scale
        turns = np.linspace(pose[2] - fov_rad / 2, pose[2] + fov_rad / 2, 200)
        rays = np.stack([np.cos(turns), np.sin(turns)], axis=-1)
        out = np.linspace(ROBOT_PX / self.reach, 1, 100)[:, None]
        self.arc = self.at + self.reach * rays
        first, last = (self.at + self.reach * out * rays[i] for i in (0, -1))
        is_circle = fov_rad > 2 * np.pi - 1e-6
        self.pieces = [self.arc] if is_circle else [first, last, self.arc]
        self.rim = self.arc if is_circle else np.vstack([self.at, self.arc])

    def mask(self, *, filled=False, width=1):
        """Pixels of the outline, `width` wide, and of the robot; or of all within."""
        mask = np.zeros(self.shape, np.uint8)
        # Sub-pixel corners: OpenCV takes them as whole 1/16 of a pixel, and counts
        # from pixel centres.
        points = np.rint((self.rim - 0.5) * 16).astype(np.int32)
        if filled:
            cv2.fillPoly(mask, [points], 1, shift=4)
        cv2.polylines(mask, [points], isClosed=True, color=1, thickness=width, shift=4)
        middle = tuple(int(v) for v in np.rint((self.at - 0.5) * 16))
        cv2.circle(mask, middle, ROBOT_PX * 16, 1, -1, shift=4)
        return mask > 0


def home_cone(shape, step):
    return Cone(shape, step, load_sample("a").sensor.range_px, np.pi / 6)


def cell_samples(picture, step):
    """The painted colour in the middle of each cell (R * C, 3); False under a mark."""
    grid = run()[0].grid
    k = picture.shape[1] / grid.width_px
    rows = np.minimum((np.arange(grid.n_rows) + 0.5) * grid.cell_px, grid.height_px - 1)
    cols = np.minimum((np.arange(grid.n_cols) + 0.5) * grid.cell_px, grid.width_px - 1)
    at = np.ix_((rows * k).astype(int), (cols * k).astype(int))
    is_clear = ~home_cone(picture.shape, step).mask(width=8)[at].ravel()
    assert is_clear.mean() > 0.97
    return picture[at].reshape(-1, 3), is_clear


def fused(step, p_wall, p_space, rule):
    log, is_wall, _ = run()
    prior_map = prior_from_cells(
        is_wall, log.grid, Prior(p_wall=p_wall, p_space=p_space)
    )
    return fuse(log, prior_map, rule, n_readings=step)


def show(player, step, p_wall, p_space):
    slide(player, "p_wall", p_wall)
    slide(player, "p_space", p_space)
    scrub(player, step)


@pytest.mark.parametrize(
    ("rule", "overlay"),
    list(product(UpdateRule, [Overlay.NONE, Overlay.WALL_MASK, Overlay.TRUTH])),
    ids=lambda value: value.value,
)
def test_each_cell_has_the_grey_of_its_belief(page, app_url, rule, overlay):
    """Black is occupied; an overlay lays 0.55 of its colour over the grey."""
    _, is_wall, truth = run()
    marked, tint = {
        Overlay.NONE: (np.zeros_like(truth), palette.PAPER),
        Overlay.WALL_MASK: (is_wall, palette.WALL_MASK),
        Overlay.TRUTH: (truth, palette.GROUND_TRUTH),
    }[overlay]
    player = open_player(page, app_url)
    choose(player, "rule", rule.value)
    choose(player, "overlay", overlay.value)
    for step, p_wall, p_space in STEPS_AND_PRIORS:
        show(player, step, p_wall, p_space)
        samples, is_clear = cell_samples(painted(player, "map"), step)
        occupancy_map = fused(step, p_wall, p_space, rule)
        p_free = occupancy_map.p_free.ravel()
        is_seen = occupancy_map.n_updates.ravel() > 0
        grey = np.repeat(np.rint(255 * p_free)[:, None], 3, axis=1)
        tinted = grey + (rgb(tint) - grey) * TINT
        expected = np.where(marked.ravel()[:, None], tinted, grey)
        assert_cells(samples, expected, is_clear, is_seen)


def outcome_colours(occupancy_map, truth):
    """The colour of each cell's outcome (R * C, 3), as if all were scored."""
    is_declared = is_occupied(occupancy_map.log_odds).ravel()
    wall = np.where(is_declared[:, None], rgb(palette.HIT), rgb(palette.MISSED_WALL))
    free = np.where(is_declared[:, None], rgb(palette.FALSE_WALL), rgb(palette.FREE))
    return np.where(truth.ravel()[:, None], wall, free)


@pytest.mark.parametrize("rule", UpdateRule, ids=lambda value: value.value)
def test_each_cell_has_the_colour_of_its_outcome(page, app_url, rule):
    """What no reading has seen is hatched over the outcome of its prior."""
    _, _, truth = run()
    player = open_player(page, app_url)
    choose(player, "rule", rule.value)
    choose(player, "overlay", "errors")
    for step, p_wall, p_space in STEPS_AND_PRIORS:
        show(player, step, p_wall, p_space)
        samples, is_clear = cell_samples(painted(player, "map"), step)
        occupancy_map = fused(step, p_wall, p_space, rule)
        is_seen = occupancy_map.n_updates.ravel() > 0
        colours = outcome_colours(occupancy_map, truth)
        assert_cells(samples, colours, is_clear, is_seen)


HATCH_ALPHA = 0.3
"""Opacity of the lines over cells that no reading has seen, one dark and one light."""


def assert_cells(samples, colours, is_clear, is_seen):
    """Cells that were seen have their colour; the others are hatched over it."""
    at = is_clear & is_seen
    np.testing.assert_allclose(samples[at], colours[at], atol=1.01)
    at = is_clear & ~is_seen
    below = colours[at]
    dark, light = rgb(palette.HATCH_DARK), rgb(palette.HATCH_LIGHT)
    low = below + HATCH_ALPHA * (dark - below)
    high = below + HATCH_ALPHA * (light - below)
    # Colours under a mask are stored in whole steps of their opacity.
    assert ((samples[at] >= low - 3) & (samples[at] <= high + 3)).all()
    if not at.any():
        return
    # Two lines, each 1 px wide, 6 px apart along a row, at 45 degrees: 0.24 of the area
    # each, part of it faint at their edges. One of the two shows on any grey.
    contrast = np.abs(samples[at] - below).max(axis=1)
    on_line = contrast > 0.5 * HATCH_ALPHA * np.maximum(below, 255 - below).max(axis=1)
    assert 0.1 < on_line.mean() < 0.6


def test_an_exact_tie_is_not_painted_as_wall(page, app_url):
    """A prior of 0.9 and one reading of 0.1 cancel under PRIOR_ONCE."""
    log, _, truth = run()
    step = log.n_readings
    player = open_player(page, app_url)
    choose(player, "rule", UpdateRule.PRIOR_ONCE.value)
    choose(player, "overlay", "errors")
    show(player, step, 1.0, 1.0)
    samples, is_clear = cell_samples(painted(player, "map"), step)
    log_odds = fused(step, 1.0, 1.0, UpdateRule.PRIOR_ONCE).log_odds.ravel()
    at = (np.abs(log_odds) < 1e-9) & is_clear
    assert at.sum() > 200
    is_wall = truth.ravel()[:, None]
    not_declared = np.where(is_wall, rgb(palette.MISSED_WALL), rgb(palette.FREE))
    np.testing.assert_allclose(samples[at], not_declared[at], atol=1.01)


@pytest.mark.parametrize(
    ("range_px", "fov_deg"), [(40, 30), (90, 75), (25, 200), (60, 360)]
)
def test_the_cone_has_the_angle_and_the_reach_of_the_sensor(
    page, app_url, range_px, fov_deg
):
    player = open_player(page, app_url, f"&range_px={range_px}&fov_deg={fov_deg}")
    settled(page)
    for step in (1, 150, 333):
        scrub(player, step)
        # On the map only what marks the sensor has a colour; cells are grey.
        picture = painted(player, "map")
        cone = Cone(picture.shape, step, range_px, np.deg2rad(fov_deg))
        is_coloured = np.ptp(picture, axis=-1) > 40
        assert not (is_coloured & ~cone.mask(width=6)).any()
        for piece in cone.pieces:
            # Dashes of 4 px with gaps of 3.
            assert share_near(is_coloured, piece) > 0.4


def share_near(is_painted, points):
    """Share of the points on the canvas with a painted pixel at or beside them."""
    grown = cv2.dilate(is_painted.astype(np.uint8), np.ones((3, 3)))
    row, col = (np.floor(points[:, i]).astype(int) for i in (1, 0))
    height, width = is_painted.shape
    inside = (row >= 0) & (row < height) & (col >= 0) & (col < width)
    return grown[row[inside], col[inside]].mean()


def test_the_drawing_is_tinted_inside_the_cone_and_nowhere_else(page, app_url):
    player = open_player(page, app_url, "&range_px=90&fov_deg=75")
    settled(page)
    below = paper(player)
    for step, alpha in ((0, 0.08), (150, 0.18), (333, 0.18)):
        scrub(player, step)
        picture = painted(player, "drawing")
        cone = Cone(picture.shape, step, 90, np.deg2rad(75))
        is_rim = cone.mask(width=8)
        is_inside = cone.mask(filled=True) & ~is_rim
        is_outside = ~cone.mask(filled=True) & ~is_rim
        tinted = below + alpha * (rgb(palette.SENSOR) - below)
        # The path runs over both.
        assert np.isclose(picture, tinted, atol=2)[is_inside].mean() > 0.85
        assert np.isclose(picture, below, atol=2)[is_outside].mean() > 0.9

"""The section that registers a drawing on a log: what it does and what it says."""

import functools

import numpy as np
import pytest

from occsim import (
    Corrections,
    Prior,
    Registration,
    Trajectory,
    held_out_bits,
    load_sample,
)
from occsim.building import DOOR_WIDTH_M
from occsim.io.metric import MetricFrame, poses_to_image, poses_to_metric
from occsim.prior import prior_from_cells
from pages._ui import logs
from pages._ui.columns import DRAWN_COLUMNS
from pages._ui.components.board import BoardPoint
from pages._ui.compute import with_walls
from pages._ui.robot_data import registered, registering
from pages._ui.robot_data.played import play_log, simulated_log
from pages._ui.settings import Settings
from tests.boards import committed_tiles
from tests.test_pages import launch, said, upload
from tests.test_robot_data import LABEL, PAGE, log_of


@functools.cache
def opened(name):
    """A sample, its simulated log on its map, and how the section opens."""
    building = with_walls(load_sample(name))
    made = play_log(simulated_log(building), logs.options(Settings()))
    return building, made, registered.opening("here", building, made)


def corners_off_m(registration, building, made):
    """How far the drawing's corners lie from where they are, m; the worst of them."""
    height, width = building.drawing.shape
    scale = building.metres_per_px or DOOR_WIDTH_M / building.sensor.range_px
    frame = MetricFrame(height_px=height, metres_per_px=scale)
    corners = [[0, 0], [width, 0], [0, height], [width, height]]
    metric = poses_to_metric(Trajectory([[*c, 0.0] for c in corners]), frame)
    true = poses_to_image(metric, made.scans.frame).poses[:, :2]
    off = np.hypot(*(registration.points(corners) - true).T)
    return off.max() * made.scans.frame.metres_per_px


@pytest.mark.parametrize("name", "abcde")
def test_what_the_section_says_of_refining(name):
    """From 1.1 m to 10 cm at all corners; held-out scans are predicted better: than
    with the drawing as it opens, and than without one."""
    building, made, opening = opened(name)
    refined = registered.refined(building.wall_mask, opening.now, made)
    assert corners_off_m(opening.now, building, made) == pytest.approx(1.1, abs=0.05)
    assert corners_off_m(refined, building, made) < 0.10
    before, after = (
        registered.agrees(building.wall_mask, one, made)
        for one in (opening.now, refined)
    )
    assert after.share_found > 0.7 > 0.2 > before.share_found
    assert after.bits > 0 > before.bits

    def bits(registration, prior):
        walls = registered.walls_on_map(building.wall_mask, registration, made)
        prior_map = prior_from_cells(walls.mask, made.grid, prior)
        return held_out_bits(made.evidence, prior_map).bits

    once = bits(refined, Prior())
    assert once < bits(opening.now, Prior())
    assert once < bits(refined, Prior.uninformative())


def test_the_points_at_which_it_opens_lie_on_both_pictures():
    building, made, opening = opened("b")
    for points, shape in (
        (opening.drawing_points, building.drawing.shape),
        (opening.map_points, (made.grid.height_px, made.grid.width_px)),
    ):
        assert len(points) == 2
        assert all(0 <= p.x_px <= shape[1] and 0 <= p.y_px <= shape[0] for p in points)


def test_a_registration_is_said_in_the_words_of_the_page():
    """By hand: map of 5 cm a px; 0.4 px of it a px of the drawing are 20 mm."""
    _, made, _ = opened("b")
    lies = Registration(scale=0.4, rotation_rad=-np.pi / 6, shift_x_px=20, shift_y_px=4)
    assert registering.where(lies, made) == (
        "A pixel of the drawing is 20.0 mm; turned 30.0° anticlockwise; its upper left "
        "corner is at x = 1.00 m, y = 0.20 m from the map's, y down."
    )


def test_a_drawing_beside_the_map_is_said_to_be_where_the_robot_never_looked():
    building, made, _ = opened("b")
    far = Registration(shift_x_px=1e6)
    found = registered.agrees(building.wall_mask, far, made)
    assert registering.agreement_words(found) == (
        "The robot looked at none of the drawn walls, +0 bits"
    )


def section(app):
    key = "view_robot_section"
    return run(app.segmented_control(key=key).set_value("A drawing for the log"))


def step(app, name):
    key = f"view_{registering.STEP}"
    return run(app.segmented_control(key=key).set_value(name))


def run(element):
    app = element.run()
    assert not app.exception
    return app


def button(app, label):
    return next(b for b in app.button if b.label.startswith(label))


def agreement_of(app):
    return next(t for t in said(app.markdown) if "of the drawn walls" in t)


def test_refine_and_undo_on_the_page():
    app = section(launch(PAGE))
    opening = agreement_of(app)
    assert button(app, "Undo").disabled
    app = run(button(app, "Refine").click())
    refined = agreement_of(app)
    assert refined != opening
    assert "Before: " + opening.strip("*.") in refined
    app = run(button(app, "Undo").click())
    assert agreement_of(app) == opening
    app = run(button(app, "Redo").click())
    assert agreement_of(app) == refined


def points_commit(app, key, points):
    """What a board tells when two points were set on it."""
    document = app.session_state["boards"][key].imposed
    rows = [[x, y, 1] for x, y in points]
    return {"committed": {"rev": document.rev, "token": document.token, "points": rows}}


def test_two_points_on_each_board_register_a_drawing_on_an_uploaded_log():
    app = section(upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain"))
    assert button(app, "Refine").disabled
    for key, points in (
        (registering.DRAWING_KEY, [(100, 100), (200, 100)]),
        (registering.MAP_KEY, [(10, 10), (10, 30)]),
    ):
        # Taken after the script; in a browser, by a callback before it.
        app.session_state[key] = points_commit(app, key, points)
        app = run(run(app))
    so_far = app.session_state.robot.registrations
    assert so_far.map_points[1] == BoardPoint(x_px=10.0, y_px=30.0)
    # By hand: 100 px to the right become 20 px down.
    assert so_far.now.scale == pytest.approx(0.2)
    assert so_far.now.rotation_rad == pytest.approx(np.pi / 2)
    assert not button(app, "Refine").disabled
    app = step(app, "Map with it")
    assert any("on scans held out" in text for text in said(app.markdown))


def test_two_points_at_one_place_are_refused_in_a_sentence():
    app = section(upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain"))
    for key, points in (
        (registering.DRAWING_KEY, [(100, 100), (200, 100)]),
        (registering.MAP_KEY, [(10, 10), (10, 10)]),
    ):
        # Taken after the script; in a browser, by a callback before it.
        app.session_state[key] = points_commit(app, key, points)
        app = run(run(app))
    assert "must lie apart" in said(app.error)[0]


def trace(app):
    """Draw a wall on the map of the log."""
    app = step(app, "Or trace walls")
    imposed = app.session_state["boards"][registering.TRACE_KEY].imposed
    mask = np.zeros(imposed.shape, bool)
    mask[5:8, 4:40] = True
    drawn = Corrections.between(~mask & mask, mask)
    tiles = committed_tiles(imposed.corrections, drawn)
    says = {"rev": imposed.rev, "token": imposed.token, "tiles": tiles}
    app.session_state[registering.TRACE_KEY] = {"committed": says}
    return run(app)


def test_without_a_drawing_the_map_asks_for_one_and_a_traced_one_serves():
    app = section(upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain"))
    app = step(app, "Map with it")
    assert "Register a drawing on the map first, or trace walls." in said(app.info)
    app = step(trace(app), "Map with it")
    rows = next(t for t in said(app.markdown) if "on scans held out" in t)
    assert "no drawing" in rows
    assert "drawing, counted once" in rows


def test_maps_with_the_drawing_and_without_start_side_by_side():
    without, with_it = DRAWN_COLUMNS
    assert (without.uninformative, with_it.uninformative) == (True, False)
    assert with_it.cell_px == without.cell_px == 1

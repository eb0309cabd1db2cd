"""The page "Your building": each section's controls, and every bad file."""

import io
import math
import zipfile
from dataclasses import fields, replace

import cv2
import numpy as np
import pytest
from PIL import Image

from occsim import (
    Corrections,
    HeadingMode,
    Trajectory,
    TrajectoryFormat,
    dump_trajectory,
    load_sample,
)
from occsim.corrections import unpack_mask
from occsim.io.images import drawing_png
from occsim.io.project import Project, dump_project
from occsim.walls import WallParams, detect_walls
from pages._ui.compute import with_walls
from pages._ui.state import OPENING
from pages._ui.your_building import detecting, poses
from tests.boards import committed_tiles
from tests.test_pages import control, launch, png, rooms, said, upload

PAGE = "pages/2_Your_building.py"
SECTIONS = (
    *("1 Drawing", "2 Scale", "3 Walls", "4 Corrections"),
    *("5 Ground truth", "6 Trajectory", "7 Keep"),
)
WAYS = ("Sketch", "Plan", "Table", "Files")


POSES = b"x_px,y_px,theta_deg\n100,100,0\n110,100,90\n"


def at(section, app=None, **views):
    """The page at one of its sections."""
    app = app or launch(PAGE)
    before = app.session_state.get("views", {})
    app.session_state["views"] = {**before, "section": section, **views}
    app.run()
    assert not app.exception
    return app


def own(app):
    return app.session_state["own"]


def press(app, label):
    next(button for button in app.button if button.label == label).click().run()
    assert not app.exception
    return app


def test_doubtful_pieces_are_counted_and_go_to_the_board():
    """The page says how many; walls from elsewhere have none."""
    drawing = load_sample("b").drawing
    app = upload(at("1 Drawing"), "Drawing", "b.png", drawing_png(drawing))
    found = detect_walls(own(app).drawing)
    n = found.certainty.doubtful
    assert n > 0
    app = at("3 Walls", app)
    expected = f"{n} doubtful pieces to accept or remove in 4 Corrections"
    assert any(expected in text for text in said(app.markdown))
    app = at("4 Corrections", app)
    sent = app.session_state["boards"]["board_walls"].imposed.doubtful
    assert unpack_mask(sent, drawing.shape).sum() == found.doubtful.sum()
    other = replace(own(app), found=~found.mask)
    assert detecting.doubtful(other) == b""


def with_rooms():
    return upload(at("1 Drawing"), "Drawing", "rooms.png", png(rooms()))


def commit(app, key, **edits):
    """Commit a drawn document from the board of this key."""
    imposed = app.session_state["boards"][key].imposed
    says = {"rev": imposed.rev, "token": imposed.token, **edits}
    app.session_state[key] = {"committed": says}
    app.run()
    assert not app.exception
    return app


def dots(*rows):
    """Corrections of `rooms`: wall of 6 x 6 px around column 50 in these rows."""
    added = np.zeros((160, 220), dtype=bool)
    for row in rows:
        added[row - 3 : row + 3, 47:53] = True
    return Corrections.from_masks(added, np.zeros_like(added))


def paint(app, key, corrections):
    """Commit these corrections as all the corrections of the board."""
    imposed = app.session_state["boards"][key].imposed
    tiles = committed_tiles(imposed.corrections, corrections)
    return commit(app, key, tiles=tiles)


@pytest.mark.parametrize("section", SECTIONS)
def test_every_section_opens_without_a_message(section):
    assert not at(section).error


@pytest.mark.parametrize("way", WAYS)
def test_every_way_to_a_trajectory_opens(way):
    assert not at("6 Trajectory", way=way).error


# --- Drawing --------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["png", "jpg", "tiff", "bmp", "webp", "gif", "pdf"])
def test_every_kind_of_file_is_taken(kind):
    out = io.BytesIO()
    names = {"jpg": "JPEG", "tiff": "TIFF"}
    Image.fromarray(rooms()).convert("RGB").save(out, names.get(kind, kind.upper()))
    app = upload(at("1 Drawing"), "Drawing", f"plan.{kind}", out.getvalue(), "any/any")
    assert not app.error
    assert own(app).title == f"plan.{kind}"
    assert own(app).wall_mask.any()


def test_a_page_of_a_pdf_is_chosen():
    out = io.BytesIO()
    sheets = [
        Image.fromarray(image).convert("RGB") for image in (rooms(), rooms(220, 160))
    ]
    sheets[0].save(out, "PDF", save_all=True, append_images=sheets[1:])
    app = upload(at("1 Drawing"), "Drawing", "two.pdf", out.getvalue())
    height, width = own(app).drawing.shape
    assert width > height
    app.number_input(key="view_pdf_page").set_value(2).run()
    assert not app.exception
    height, width = own(app).drawing.shape
    assert height > width


def test_a_large_drawing_is_worked_on_at_the_size_that_is_shown():
    app = at("1 Drawing", working_px=500)
    app = upload(app, "Drawing", "large.png", png(rooms(700, 1000)))
    assert own(app).drawing.shape == (350, 500)
    shown = "500 × 350 px. Scaled down from 1000 × 700 px."
    assert shown in said(app.caption)


def test_turning_and_undoing():
    app = press(with_rooms(), "Turn right")
    assert own(app).drawing.shape == (220, 160)
    assert own(app).n_outside == own(app).n_inside_walls == 0
    app = press(app, "Undo")
    assert own(app).drawing.shape == (160, 220)
    assert app.session_state["choice"] == "own"
    app = press(app, "Undo")
    assert app.session_state["choice"] == OPENING


def test_strokes_in_a_row_are_undone_and_done_again_as_one():
    app = at("4 Corrections", with_rooms())
    for rows in ((70,), (70, 80)):
        app = paint(app, "board_walls", dots(*rows))
    app = press(app, "Undo")
    assert own(app).corrections.is_empty
    app = press(app, "Redo")
    assert own(app).corrections == dots(70, 80)
    app = press(press(app, "Undo"), "Undo")
    assert app.session_state["choice"] == OPENING


def test_a_rectangle_on_the_board_crops():
    app = commit(with_rooms(), "board_crop", points=[[0, 0, 1], [120, 100, 1]])
    app = press(app, "Crop to the rectangle")
    assert own(app).drawing.shape == (100, 120)


def test_a_tilted_drawing_is_offered_to_be_straightened():
    turn = cv2.getRotationMatrix2D((250, 200), 3.0, 1.0)  # anticlockwise on the screen
    plan = cv2.warpAffine(rooms(400, 500), turn, (500, 400), borderValue=255)
    app = upload(at("1 Drawing"), "Drawing", "tilted.png", png(plan))
    label = next(b.label for b in app.button if b.label.startswith("Straighten"))
    assert abs(float(label.removeprefix("Straighten by ").rstrip("°")) - 3.0) < 0.3
    press(app, label)
    assert any(b.label == "No tilt found" for b in app.button)


# --- Scale ----------------------------------------------------------------------------


def test_two_clicks_across_a_door_set_range_and_scale():
    app = at("2 Scale", with_rooms())
    # A length of 30 px.
    app = commit(app, "board_door", points=[[10, 20, 1], [28, 44, 1]])
    assert own(app).sensor.range_px == 30.0
    assert own(app).door_px == 30.0
    assert own(app).metres_per_px == pytest.approx(0.03)
    assert app.session_state["settings"].range_px == 30
    assert any("30 px (0.90 m)" in text.value for text in app.markdown)
    app.number_input(key="view_door_width_m").set_value(1.2).run()
    assert own(app).metres_per_px == pytest.approx(0.04)
    app = press(app, "Forget the scale")
    assert own(app).metres_per_px is None
    assert any("pixels only" in info.value for info in app.info)


# --- Walls, corrections, ground truth -------------------------------------------------


def test_a_wall_parameter_finds_the_walls_again_and_keeps_corrections():
    app = at("4 Corrections", with_rooms())
    app = paint(app, "board_walls", dots(80))
    assert own(app).corrections == dots(80)
    assert own(app).wall_mask[80, 50]
    app = at("3 Walls", app)
    slider = next(s for s in app.slider if s.key and s.key.startswith("wall_"))
    slider.set_value(slider.max).run()
    assert not app.exception
    field = slider.key.removeprefix("wall_").split(":")[0]
    assert getattr(own(app).wall_params, field) == slider.max
    assert own(app).wall_mask[80, 50]


def test_lengths_are_in_metres_where_the_scale_is_known():
    app = launch("pages/1_Build_a_map.py")
    # Sample a: doors of 40 px and 0.9 m, cells of 3 px.
    label = app.slider(key=control(app, "cell_px")).label
    assert label.replace("\u00a0", " ") == "Cell size (px; 0.07 m)"
    app = upload(app, "Drawing", "rooms.png", png(rooms()))
    assert app.slider(key=control(app, "cell_px")).label == "Cell size (px)"


def test_corrections_are_counted_and_discarded():
    app = paint(at("4 Corrections", with_rooms()), "board_walls", dots(80))
    counted = "36 px added, 0 px erased"
    assert any(caption.value == counted for caption in app.caption)
    app = press(app, "Discard all corrections")
    assert own(app).corrections.is_empty
    button = next(b for b in app.button if b.label == "Discard all corrections")
    assert button.disabled


def test_a_crop_plans_the_tour_again():
    app = commit(with_rooms(), "board_crop", points=[[0, 0, 1], [120, 160, 1]])
    app = press(app, "Crop to the rectangle")
    assert own(app).trajectory is own(app).tour
    assert own(app).n_outside == 0


def test_undone_strokes_leave_the_mask():
    app = at("4 Corrections", with_rooms())
    app = paint(app, "board_walls", dots(80))
    app = paint(app, "board_walls", dots())
    assert own(app).corrections.is_empty
    assert not own(app).wall_mask[80, 50]


def test_a_pose_edited_in_the_table_is_there_when_the_table_is_opened_again():
    """x from 100 to 101, a look at Files, the table again: 101, also after an undo."""
    app = with_rooms()
    app = upload(at("6 Trajectory", app, way="Files"), "Trajectory", "a.csv", POSES)
    app = at("6 Trajectory", app, way="Table")
    first = app.session_state["table"]
    edit = {"edited_rows": {0: {"x_px": 101.0}}, "added_rows": [], "deleted_rows": []}
    app.session_state[first.key] = edit
    app = at("6 Trajectory", app, way="Files")
    app = at("6 Trajectory", app, way="Table")
    again = app.session_state["table"]
    assert again.rev > first.rev
    assert again.source is own(app).trajectory
    assert again.given["x_px"][0] == own(app).trajectory.poses[0, 0]


def test_a_commit_that_makes_no_sense_changes_nothing():
    app = at("4 Corrections", with_rooms())
    kept = own(app)
    for tiles in (None, 5, "all", "eJw=", [["brush", 1, 2, 3]]):
        app = commit(app, "board_walls", tiles=tiles)
    assert own(app) is kept


def test_a_board_that_left_the_screen_starts_from_what_was_drawn():
    app = at("4 Corrections", with_rooms())
    app = paint(app, "board_walls", dots(80))
    rev = app.session_state["boards"]["board_walls"].imposed.rev
    app = at("4 Corrections", at("7 Keep", app))
    imposed = app.session_state["boards"]["board_walls"].imposed
    assert imposed.overlay == dots(80)
    assert imposed.rev > rev


def test_ground_truth_from_the_mask_from_nothing_and_none():
    app = press(at("5 Ground truth", with_rooms()), "Start from the wall mask")
    np.testing.assert_array_equal(own(app).truth, own(app).wall_mask)
    app = paint(app, "board_truth", dots(80))
    assert own(app).world.occupied[80, 50]
    assert not own(app).wall_mask[80, 50]
    app = press(app, "Start from an empty mask")
    assert not own(app).world.occupied.any()
    app = press(app, "Map without ground truth")
    assert own(app).truth is None
    assert any("sees the wall mask itself" in text.value for text in app.markdown)


# --- Trajectory -----------------------------------------------------------------------


def test_a_sketch_becomes_a_trajectory():
    app = at("6 Trajectory", with_rooms())
    # From (30, 80) to (70, 80) px, a waypoint at each end.
    app = commit(app, "board_path", points=[[30, 80, 1], [70, 80, 1]])
    np.testing.assert_allclose(
        own(app).trajectory.poses, [[x, 80, 0] for x in (30, 40, 50, 60, 70)]
    )
    app.slider(key="view_step_px").set_value(20).run()
    assert len(own(app).trajectory) == 3
    app.toggle(key="view_turn").set_value(True).run()
    assert len(own(app).trajectory) == 9
    app.selectbox(key="view_heading_mode").select(HeadingMode.FOUR).run()
    assert len(own(app).trajectory) == 12
    app.toggle(key="view_show_poses").set_value(True).run()
    assert not app.exception


def test_poses_are_planned_and_undone():
    app = at("6 Trajectory", with_rooms(), way="Plan")
    first = own(app).trajectory
    app = press(app, "Plan a tour for this sensor")
    assert len(own(app).trajectory) > 60
    app.slider(key="view_max_readings").set_value(60).run()
    app = press(app, "Plan a tour for this sensor")
    assert 50 <= len(own(app).trajectory) <= 60
    app = press(app, "Draw random poses")
    assert len(own(app).trajectory) == 300
    assert not app.error
    for _ in range(3):
        app = press(app, "Undo")
    assert own(app).trajectory is first


def test_a_world_without_free_space_is_answered_in_one_sentence():
    app = upload(
        with_rooms(), "Drawing", "black.png", png(np.zeros((90, 90), np.uint8))
    )
    assert len(app.error) <= 1
    assert not app.exception


@pytest.mark.parametrize("kind", TrajectoryFormat)
def test_every_trajectory_file_is_taken(kind):
    trajectory = load_sample(OPENING).trajectory
    app = at("6 Trajectory", way="Files")
    content = dump_trajectory(trajectory, kind)
    app = upload(app, "Trajectory", f"path.{kind.value}", content, "any/any")
    assert not app.error
    np.testing.assert_allclose(
        own(app).trajectory.poses[:, :2], trajectory.poses[:, :2]
    )


def test_the_unit_of_the_angles_may_be_chosen_afterwards():
    app = at("6 Trajectory", way="Files")
    app = upload(app, "Trajectory", "a.csv", b"100,100,90\n100,110,180\n", "text/csv")
    assert "degrees or radians" in said(app.error)[0]
    app.radio(key="view_angle_unit").set_value("Degrees").run()
    assert not app.error
    np.testing.assert_allclose(own(app).trajectory.poses[:, 2], [math.pi / 2, math.pi])


def test_poses_are_marked_where_they_cannot_be():
    # In a room, in the outer wall, 4 px left of the drawing, and far off.
    rows = [[60, 80, 0], [110, 12, 1], [-4, 30, 2], [9e5, 30, 0]]
    plan = replace(own(with_rooms()), trajectory=Trajectory(poses=rows))
    figure = poses.poses_figure(plan, 400)
    _, free, bad = figure.data
    assert (list(free.x), free.marker.symbol) == ([60], "arrow")
    assert (list(bad.x), bad.marker.symbol) == ([110, -4, 9e5], "x")
    left, right = figure.layout.xaxis.range
    assert left < -4
    assert right == 220
    many = replace(plan, trajectory=Trajectory(poses=rows[:1] * (poses.MANY + 1)))
    assert poses.poses_figure(many, 400).data[1].marker.symbol is None


# --- Keep -----------------------------------------------------------------------------


def test_a_project_brings_everything_back():
    app = at("2 Scale", with_rooms())
    app = commit(app, "board_door", points=[[10, 20, 1], [28, 44, 1]])
    saved = own(app)
    content = dump_project(Project(building=saved, settings={"cell_px": "7"}))
    app = upload(at("7 Keep"), "Project file", "mine.zip", content, "application/zip")
    assert not app.error
    assert own(app).digest == saved.digest
    assert own(app).door_px == 30.0
    assert app.session_state["settings"].cell_px == 7
    app = press(app, "Undo")
    assert app.session_state["choice"] == OPENING


def zip_with(name, content):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        archive.writestr(name, content)
    return out.getvalue()


BAD_PROJECTS = {
    "empty": b"",
    "words": b"no zip",
    "another zip": zip_with("readme.txt", b"hello"),
    "a path": zip_with("../../project.json", b"{}"),
    "cut short": zip_with("project.json", b"{}" * 100)[:-30],
}


@pytest.mark.parametrize("kind", BAD_PROJECTS)
def test_a_bad_project_is_answered_in_one_sentence_and_loses_nothing(kind):
    app = at("7 Keep", with_rooms())
    kept, settings = own(app), app.session_state["settings"]
    app = upload(app, "Project file", "bad.zip", BAD_PROJECTS[kind], "application/zip")
    assert len(app.error) == 1
    assert own(app) is kept
    assert app.session_state["settings"] is settings


TUM = b"1.0 1 2 0 0 0 0 1\n"
"""1 m to the right and 2 m up, looking to the right."""


def asks(app):
    return any("are in metres" in one.value for one in app.info)


def test_a_file_in_metres_is_placed_where_the_student_says():
    """At 0.05 m per px, 1 m right of the corner and 2 m above it; then of a corner at
    (0.5, -1)."""
    app = at("2 Scale", with_rooms())
    app = commit(app, "board_door", points=[[10, 20, 1], [28, 20, 1]])  # 0.9 m
    app = at("6 Trajectory", app, way="Files")
    before, height = own(app).trajectory, own(app).drawing.shape[0]
    app = upload(app, "Trajectory", "log.tum", TUM, "any/any")
    assert not app.error
    assert asks(app)
    assert own(app).trajectory is before
    assert any("0.05 m per pixel" in one.value for one in app.caption)
    app = press(app, "Place the poses")
    assert own(app).trajectory.poses[0] == pytest.approx([20.0, height - 40.0, 0.0])
    app.number_input(key="view_frame_x_m").set_value(0.5).run()
    app.number_input(key="view_frame_y_m").set_value(-1.0).run()
    app = press(app, "Place the poses")
    assert own(app).trajectory.poses[0] == pytest.approx([10.0, height - 60.0, 0.0])
    app = press(press(app, "Undo"), "Undo")
    assert own(app).trajectory is before
    app = upload(app, "Trajectory", "log.csv", POSES, "any/any")
    assert not asks(app)
    assert not any(one.label == "Place the poses" for one in app.button)


def test_a_drawing_without_a_scale_gets_the_one_that_its_poses_are_placed_with():
    """Turned to the left by a quarter, the file's x points down the drawing."""
    app = at("6 Trajectory", with_rooms(), way="Files")
    assert own(app).metres_per_px is None
    app = upload(app, "Trajectory", "log.tum", TUM, "any/any")
    app.number_input(key="view_frame_metres_per_px").set_value(0.1).run()
    app.number_input(key="view_frame_turn_deg").set_value(-90.0).run()
    app.number_input(key="view_frame_y_m").set_value(4.0).run()
    app = press(app, "Place the poses")
    height = own(app).drawing.shape[0]
    # From the corner, 2 m down its frame's y axis: to its right; and 1 m up.
    expected = [20.0, height - 10.0, -np.pi / 2]
    assert own(app).trajectory.poses[0] == pytest.approx(expected)
    assert own(app).metres_per_px == pytest.approx(0.1)


BAD_FILES = {
    ("1 Drawing", "Drawing", "empty.png"): b"",
    ("1 Drawing", "Drawing", "words.pdf"): b"no PDF at all",
    ("1 Drawing", "Drawing", "cut.pdf"): b"%PDF-1.4\n1 0 obj",
    ("1 Drawing", "Drawing", "cut.png"): png(rooms())[:300],
    ("1 Drawing", "Drawing", "map.yaml"): b"image: a.pgm\nresolution: 0.05\n",
    ("1 Drawing", "Drawing", "scans.log"): b"FLASER 2 1.0 2.0 0 0 0 0 0 0 1 h 1\n",
    ("1 Drawing", "Drawing", "scans.bag"): b"#ROSBAG V2.0\n" + bytes(100),
    ("5 Ground truth", "Ground truth", "small.png"): png(rooms(80, 90)),
    ("6 Trajectory", "Trajectory", "map.pgm"): b"P5 2 2 255\n" + bytes(4),
    ("6 Trajectory", "Trajectory", "scans.bag"): b"#ROSBAG V2.0\n" + bytes(100),
    ("6 Trajectory", "Trajectory", "words.csv"): b"x,y,theta\na,b,c\n",
    ("6 Trajectory", "Trajectory", "pickle.npy"): b"\x93NUMPY\x01\x00",
    ("6 Trajectory", "Trajectory", "bad.mat"): b"MATLAB 5.0 MAT-file, cut",
    ("6 Trajectory", "Trajectory", "bad.json"): b'{"poses": [[1, 2]]}',
    ("6 Trajectory", "Trajectory", "bad.tum"): b"1 2 3 4 5 6 7 north\n",
}


@pytest.mark.parametrize("case", BAD_FILES, ids=lambda case: case[2])
def test_a_bad_file_is_answered_in_one_sentence_and_loses_nothing(case):
    section, label, name = case
    app = at(section, with_rooms(), way="Files")
    kept = own(app)
    app = upload(app, label, name, BAD_FILES[case], "any/any")
    assert len(app.error) == 1
    assert "\n" not in app.error[0].value
    assert name in app.error[0].value.replace("\\", "")
    assert own(app) is kept


@pytest.mark.parametrize("end", ["low", "high"])
def test_a_project_with_wall_parameters_at_their_bounds_opens_on_the_page(end):
    """The page's sliders take whatever the library allows."""
    values = {
        one.name: getattr(WallParams.bounds(one.name), end)
        for one in fields(WallParams)
        if one.name != "straighten"
    }
    assert values
    project = replace(with_walls(load_sample("d")), wall_params=WallParams(**values))
    app = with_rooms()
    data = dump_project(Project(building=project))
    app = upload(at("7 Keep", app), "Project file", "mine.zip", data, "application/zip")
    assert not app.error
    app = at("3 Walls", app)
    assert not app.error
    assert own(app).wall_params == WallParams(**values)

"""Buildings: masks with their corrections, and drawings brought into shape."""

import math
from dataclasses import replace

import cv2
import numpy as np
import pytest

from occsim import (
    Building,
    Corrections,
    Drawing,
    DrawingError,
    HeadingMode,
    ParameterError,
    Trajectory,
    TrajectoryError,
    load_sample,
)
from occsim.building import (
    building_from_drawing,
    random_trajectory,
    sketched_trajectory,
    truth_from_image,
)
from occsim.imaging.transform import Transform
from occsim.io.trajectories.pose_table import pose_columns, trajectory_from_columns
from occsim.sensor import Sensor
from occsim.walls import WallParams, detect_walls
from occsim.world import World

SHAPE = (60, 90)


def room():
    """A room with walls of 4 px, an opening in its right wall, drawn in black."""
    mask = np.zeros(SHAPE, dtype=bool)
    mask[5:55, 5:85] = True
    mask[9:51, 9:81] = False
    mask[25:35, 81:85] = False
    return mask


def plane(*box):
    """A mask of one filled box: x, y, width, height."""
    x, y, width, height = box
    mask = np.zeros(SHAPE, dtype=bool)
    mask[y : y + height, x : x + width] = True
    return mask


def building(**changes):
    rgb = np.where(room()[..., None], 0, 255).repeat(3, axis=2).astype(np.uint8)
    parts = {
        "drawing": Drawing(rgb=rgb, name="room"),
        "found": room(),
        "corrections": Corrections.from_masks(plane(50, 20, 6, 10), plane(5, 5, 9, 9)),
        "truth": room() | plane(50, 20, 6, 10),
        "trajectory": Trajectory(poses=[[30.0, 45.0, 0.0], [52.5, 25.5, 1.0]]),
        "sketch": ((30.0, 20.0, True), (70.0, 20.0, False)),
        "door_px": 10.0,
        "metres_per_px": 0.09,
    }
    return Building(**{**parts, **changes})


def turned(building, turns):
    return building.transformed(Transform.quarter_turns(building.drawing.shape, turns))


def cropped(building, *box):
    return building.transformed(Transform.crop(building.drawing.shape, *box))


def straightened(building, tilt):
    shape = building.drawing.shape
    return building.transformed(Transform.straighten(shape, tilt))


# --- What it holds --------------------------------------------------------------------


def test_the_prior_is_made_of_corrected_walls_and_the_world_of_the_truth():
    made = building()
    expected = (room() | plane(50, 20, 6, 10)) & ~plane(5, 5, 9, 9)
    np.testing.assert_array_equal(made.wall_mask, expected)
    np.testing.assert_array_equal(made.world.occupied, made.truth)
    without = building(truth=None)
    np.testing.assert_array_equal(without.world.occupied, expected)
    # Of the erased box of 9 x 9 px, 5 x 5 px lie inside the room.
    assert (made.n_added, made.n_erased) == (60, 81 - 25)


def test_walls_are_looked_for_where_none_are_given():
    params = WallParams(straighten=False)
    made = building(found=None, corrections=None, truth=None, wall_params=params)
    found = detect_walls(made.drawing, params).mask
    np.testing.assert_array_equal(made.wall_mask, found)
    assert made.walls_found is made.walls_found
    assert made.corrections.is_empty


def test_the_digest_follows_what_a_result_depends_on():
    made = building()
    one_pixel = room()
    one_pixel[30, 40] = True
    no_corrections = Corrections.none(SHAPE)
    others = [
        building(corrections=no_corrections),
        building(truth=one_pixel),
        building(truth=None),
        building(trajectory=Trajectory(poses=[[30.0, 45.0, 0.0]])),
    ]
    assert len({made.digest, *(other.digest for other in others)}) == 5
    words = building(title="x", about="y", name="z", door_px=3.0, sketch=())
    assert words.digest == made.digest


def test_a_building_is_shown_in_one_line():
    assert repr(building()) == "Building('room': 90 x 60 px, 2 poses)"


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        (
            {"found": np.zeros((9, 8), bool)},
            DrawingError,
            "the wall mask must have the drawing's size, 90 x 60 px; got 8 x 9 px",
        ),
        ({"truth": np.zeros((9, 8), bool)}, DrawingError, "the ground truth must have"),
        ({"corrections": Corrections.none((9, 8))}, DrawingError, "the corrections"),
        ({"truth": np.zeros(SHAPE)}, DrawingError, "array of bool; got float64"),
        ({"door_px": 0.0}, ParameterError, "door_px must be above 0 and finite; got 0"),
        ({"metres_per_px": math.nan}, ParameterError, "metres_per_px must be above 0"),
    ],
)
def test_parts_that_do_not_fit_are_refused(changes, error, message):
    with pytest.raises(error, match=message):
        building(**changes)


# --- Moved with its drawing -----------------------------------------------------------


def test_turning_turns_everything():
    turn = turned(building(), 1)
    assert turn.drawing.shape == (90, 60)
    np.testing.assert_array_equal(turn.truth, np.rot90(building().truth, -1))
    np.testing.assert_array_equal(
        turn.corrections.planes, np.rot90(building().corrections.planes, -1, (1, 2))
    )
    # Clockwise about the top left corner, then moved right by the height: (60 - y, x).
    np.testing.assert_allclose(
        turn.trajectory.poses,
        [[15.0, 30.0, math.pi / 2], [34.5, 52.5, 1.0 + math.pi / 2]],
    )
    assert turn.sketch == ((40.0, 30.0, True), (40.0, 70.0, False))
    assert turn.n_inside_walls == building().n_inside_walls == 1
    assert (turn.door_px, turn.metres_per_px) == (10.0, 0.09)


def test_four_quarter_turns_change_nothing():
    again = building()
    for _ in range(4):
        again = turned(again, 1)
    assert again.drawing.digest == building().drawing.digest
    np.testing.assert_array_equal(again.world.occupied, building().world.occupied)
    assert again.corrections == building().corrections
    np.testing.assert_allclose(
        again.trajectory.poses - building().trajectory.poses,
        [[0, 0, 2 * math.pi]] * 2,
        atol=1e-9,
    )


def test_cropping_keeps_what_is_inside():
    part = cropped(building(), 10, 15, 60, 30)
    assert part.drawing.shape == (30, 60)
    np.testing.assert_array_equal(part.truth, building().truth[15:45, 10:70])
    np.testing.assert_array_equal(
        part.corrections.planes, building().corrections.planes[:, 15:45, 10:70]
    )
    np.testing.assert_allclose(part.trajectory.poses[0], [20.0, 30.0, 0.0])
    with pytest.raises(DrawingError, match="must keep at least 8 px"):
        cropped(building(), 10, 15, 5, 30)


def test_straightening_brings_truth_and_poses_along():
    tilt = math.radians(5)
    straight = straightened(building(), tilt)
    height, width = straight.drawing.shape
    assert height > 60
    assert width > 90
    # The pose in the middle of the page stays in the middle, and looks 5 degrees less.
    middle = building(trajectory=Trajectory(poses=[[45.0, 30.0, tilt]]))
    pose = straightened(middle, tilt).trajectory.poses[0]
    np.testing.assert_allclose(pose, [width / 2, height / 2, 0.0], atol=1e-9)
    kept = straight.world.occupied.sum() / building().world.occupied.sum()
    assert kept == pytest.approx(1.0, abs=0.03)


def test_lengths_shrink_with_the_drawing():
    small = building(sensor=Sensor(range_px=30.0)).transformed(Transform.fit(SHAPE, 30))
    assert small.drawing.shape == (20, 30)
    assert small.sensor.range_px == pytest.approx(10.0)
    assert small.door_px == pytest.approx(10.0 / 3)
    assert small.metres_per_px == pytest.approx(0.27)


def plan():
    """A room of 260 x 160 px with walls of 8 px, in the middle of the sheet."""
    sheet = np.full((200, 300), 255, np.uint8)
    cv2.rectangle(sheet, (20, 20), (280, 180), 0, 8)
    return Drawing(rgb=sheet[..., None].repeat(3, axis=2))


def test_walls_are_found_anew_and_corrections_stay():
    made = building_from_drawing(plan(), Sensor())
    dot = np.zeros((200, 300), dtype=bool)
    dot[98:104, 98:104] = True
    corrected = replace(made, corrections=Corrections.from_masks(dot, dot & False))
    turn = turned(corrected, 2)
    assert turn.wall_mask[99, 199]
    assert turn.wall_mask[20, 150]


def test_a_planned_tour_is_planned_again_and_a_given_trajectory_moves():
    made = building_from_drawing(plan(), Sensor())
    assert made.tour is made.trajectory
    part = cropped(made, 0, 0, 160, 200)
    assert part.tour is part.trajectory
    assert part.n_outside == part.n_inside_walls == 0
    given = replace(made, trajectory=Trajectory(poses=made.trajectory.poses))
    moved = cropped(given, 0, 0, 160, 200)
    np.testing.assert_array_equal(moved.trajectory.poses, given.trajectory.poses)
    assert moved.n_outside > 0
    assert moved.tour is None


# --- Where it comes from --------------------------------------------------------------


def test_a_large_drawing_is_scaled_down_and_says_so():
    made = building_from_drawing(plan(), Sensor(), working_px=150)
    assert made.drawing.shape == (100, 150)
    assert made.about == "Scaled down from 300 × 200 px."
    assert building_from_drawing(plan(), Sensor(), working_px=300).about == ""
    # A ground truth of the drawing's first size is scaled down with it.
    truth = truth_from_image(plan(), made.drawing.shape)
    assert truth.shape == (100, 150)
    assert truth_from_image(plan(), (100, 140)).shape == (200, 300)


def test_thin_walls_of_a_large_ground_truth_are_kept():
    """Three walls of 2 px on 3000 px, scaled down to 1500 x 1000 px."""
    rgb = np.full((2000, 3000, 3), 255, np.uint8)
    for x in (501, 1200, 2203):
        rgb[:, x : x + 2] = 0
    truth = truth_from_image(Drawing(rgb=rgb), (1000, 1500))
    # From 501 half a pixel each in two columns; from 1200 one whole column.
    expected = [250, 251, 600, 1101, 1102]
    assert np.flatnonzero(truth.all(axis=0)).tolist() == expected
    assert truth.sum() == 5 * 1000


def test_a_sample_knows_its_scale_and_its_sensor():
    made = load_sample("a")
    assert made.door_px == 40.0
    assert made.metres_per_px == pytest.approx(0.0225)
    assert made.sensor.range_px == 40.0
    assert made.wall_mask.any()


# --- Trajectories ---------------------------------------------------------------------


def test_random_poses_follow_their_seed():
    world = World(occupied=room())
    one, same, other = (random_trajectory(world, 20, seed).poses for seed in (4, 4, 5))
    np.testing.assert_array_equal(one, same)
    assert (one != other).any()


def test_a_sketch_turns_at_waypoints_only():
    sketch = ((0.0, 0.0, True), (4.0, 0.0, False), (8.0, 0.0, True))
    still = sketched_trajectory(sketch, 4.0)
    turning = sketched_trajectory(sketch, 4.0, HeadingMode.ALONG, turn=True)
    assert still.poses[:, 0].tolist() == [0, 4, 8]
    assert turning.poses[:, 0].tolist() == [0, 0, 0, 0, 4, 8, 8, 8, 8]


def test_a_table_gives_its_poses_back():
    poses = np.array([[1.5, 2.25, 0.0], [-3.0, 4.0, 7.0]])
    columns = pose_columns(Trajectory(poses=poses))
    assert columns["x_px"] == [1.5, -3.0]
    assert columns["theta_deg"] == pytest.approx([0.0, 401.0704565915])
    np.testing.assert_allclose(trajectory_from_columns(columns).poses, poses)


def test_a_table_may_end_in_empty_rows_but_not_in_half_ones():
    columns = {"x_px": [1.0, None], "y_px": [2.0, math.nan], "theta_deg": [90.0, None]}
    poses = trajectory_from_columns(columns).poses
    np.testing.assert_allclose(poses, [[1.0, 2.0, math.pi / 2]])
    columns["y_px"] = [2.0, 5.0]
    with pytest.raises(TrajectoryError, match="row 2 needs x, y and a heading; got 1"):
        trajectory_from_columns(columns)
    with pytest.raises(TrajectoryError, match="at least one pose; got an empty table"):
        trajectory_from_columns({"x_px": [], "y_px": [], "theta_deg": []})

"""Buildings: masks with their corrections, and drawings brought into shape."""

import math

import cv2
import numpy as np
import pytest

from occsim import Drawing, DrawingError, HeadingMode, Trajectory, TrajectoryError
from occsim.building import (
    Building,
    CorrectedMask,
    building_from_drawing,
    building_from_sample,
    empty_mask,
    random_trajectory,
    sketched_trajectory,
    transformed,
    truth_from_image,
)
from occsim.imaging.transform import Transform
from occsim.io.trajectories.pose_table import pose_columns, trajectory_from_columns
from occsim.sensor import Sensor
from occsim.strokes import Stroke, StrokeKind
from occsim.world import World

SHAPE = (60, 90)
# From pixel centre to pixel centre and of odd width: the same pixels after a turn.
BRUSH = Stroke(kind=StrokeKind.BRUSH, points=((20.5, 30.5), (40.5, 30.5)), width_px=5)
BOX = Stroke(kind=StrokeKind.RECTANGLE, points=((50, 20), (56, 30)))


def room():
    """A room with walls of 4 px, an opening in its right wall, drawn in black."""
    mask = np.zeros(SHAPE, dtype=bool)
    mask[5:55, 5:85] = True
    mask[9:51, 9:81] = False
    mask[25:35, 81:85] = False
    return mask


def building(**changes):
    rgb = np.where(room()[..., None], 0, 255).repeat(3, axis=2).astype(np.uint8)
    parts = {
        "drawing": Drawing(rgb=rgb, name="room"),
        "walls": CorrectedMask(room(), (BOX,)),
        "truth": CorrectedMask(room(), (BRUSH, BOX)),
        "trajectory": Trajectory(poses=[[30.0, 45.0, 0.0], [52.5, 25.5, 1.0]]),
        "sketch": ((30.0, 20.0, True), (70.0, 20.0, False)),
        "door_px": 10.0,
        "metres_per_px": 0.09,
    }
    return Building(**{**parts, **changes})


def turned(building, turns):
    turn = Transform.quarter_turns(building.drawing.shape, turns)
    return transformed(building, turn)


def cropped(building, *box):
    return transformed(building, Transform.crop(building.drawing.shape, *box))


def straightened(building, tilt):
    straight = Transform.straighten(building.drawing.shape, tilt)
    return transformed(building, straight)


def test_turning_turns_everything():
    turn = turned(building(), 1)
    assert turn.drawing.shape == (90, 60)
    np.testing.assert_array_equal(
        turn.world.occupied, np.rot90(building().world.occupied, -1)
    )
    # Clockwise about the top left corner, then moved right by the height: (60 - y, x).
    np.testing.assert_allclose(
        turn.trajectory.poses,
        [[15.0, 30.0, math.pi / 2], [34.5, 52.5, 1.0 + math.pi / 2]],
    )
    assert turn.sketch == ((40.0, 30.0, True), (40.0, 70.0, False))
    assert turn.n_inside_walls == building().n_inside_walls == 1
    assert turn.metres_per_px == 0.09


def test_four_turns_are_none():
    again = building()
    for _ in range(4):
        again = turned(again, 1)
    assert again.drawing.digest == building().drawing.digest
    np.testing.assert_array_equal(again.world.occupied, building().world.occupied)
    assert again.truth.strokes == building().truth.strokes
    np.testing.assert_allclose(
        again.trajectory.poses - building().trajectory.poses,
        [[0, 0, 2 * math.pi]] * 2,
        atol=1e-9,
    )


def test_cropping_keeps_what_is_inside():
    part = cropped(building(), 10, 15, 60, 30)
    assert part.drawing.shape == (30, 60)
    np.testing.assert_array_equal(
        part.world.occupied, building().world.occupied[15:45, 10:70]
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


def test_walls_are_found_anew_and_corrections_stay():
    plan = np.full((200, 300), 255, np.uint8)
    cv2.rectangle(plan, (20, 20), (280, 180), 0, 8)
    drawing = Drawing(rgb=plan[..., None].repeat(3, axis=2))
    made = building_from_drawing(drawing, Sensor())
    dot = Stroke(kind=StrokeKind.BRUSH, points=((100.5, 100.5),), width_px=6)
    made = Building(
        drawing=drawing,
        walls=made.walls.with_strokes((dot,)),
        trajectory=made.trajectory,
    )
    turn = turned(made, 2)
    assert turn.wall_mask[99, 199]
    assert turn.wall_mask[20, 150]


def test_a_large_drawing_is_scaled_down_and_says_so():
    plan = np.full((200, 300, 3), 255, np.uint8)
    cv2.rectangle(plan, (20, 20), (280, 180), (0, 0, 0), 8)
    drawing = Drawing(rgb=plan)
    made = building_from_drawing(drawing, Sensor(), working_px=150)
    assert made.drawing.shape == (100, 150)
    assert made.about == "Scaled down from 300 × 200 px."
    assert building_from_drawing(drawing, Sensor(), working_px=300).about == ""
    # A ground truth of the drawing's first size is scaled down with it.
    truth = truth_from_image(drawing, made.drawing.shape)
    assert truth.base.shape == (100, 150)
    assert truth_from_image(drawing, (100, 140)).base.shape == (200, 300)


def test_a_sample_knows_its_scale():
    made = building_from_sample("a")
    assert made.door_px == 40.0
    assert made.metres_per_px == pytest.approx(0.0225)
    assert not empty_mask(made.drawing).mask.any()


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

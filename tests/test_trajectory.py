"""Trajectories: validation, poses off the floor, and files of every format."""

import io
import json
import struct

import numpy as np
import pytest
import scipy.io
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from occsim.errors import ParameterError, TrajectoryError
from occsim.geometry import CARDINAL_HEADINGS_RAD
from occsim.io.metric import MetricFrame, poses_to_image, poses_to_metric
from occsim.io.trajectories import (
    MAX_POSES,
    TrajectoryFormat,
    dump_trajectory,
    load_trajectory,
    read_trajectory_table,
)
from occsim.io.trajectories.mat import MAX_INFLATED_BYTES
from occsim.trajectory import (
    MAX_RESAMPLED,
    HeadingMode,
    Trajectory,
    drop_poses,
    inside_walls,
    outside_drawing,
    resample,
)
from occsim.world import World

TWO = [[1.5, 2.5, 0.5], [3.0, 4.25, -1.25]]
"""Two poses, headings in radians, that binary fractions hold exactly."""

TWO_DEG = [[1.5, 2.5, 90.0], [3.0, 4.25, 270.0]]
TWO_DEG_IN_RAD = [[1.5, 2.5, np.pi / 2], [3.0, 4.25, 1.5 * np.pi]]

poses = arrays(
    np.float64,
    st.tuples(st.integers(1, 12), st.just(3)),
    elements=st.floats(-1e4, 1e4, allow_subnormal=False),
)


def test_poses_are_checked_and_copied():
    given_poses = np.array(TWO)
    trajectory = Trajectory(poses=given_poses)
    given_poses[0, 0] = 99.0
    assert trajectory.poses.tolist() == TWO
    with pytest.raises(TrajectoryError, match=r"got shape \(2, 2\)"):
        Trajectory(poses=np.zeros((2, 2)))
    with pytest.raises(TrajectoryError, match="pose 2 is"):
        Trajectory(poses=[[0, 0, 0], [0, np.nan, 0]])


def test_poses_outside_and_in_walls_are_marked_and_dropped():
    """A 3 x 4 world with its right column wall; pixel (r, c) covers [c, c+1) x .."""
    occupied = np.zeros((3, 4), bool)
    occupied[:, 3] = True
    world = World(occupied=occupied)
    trajectory = Trajectory(
        poses=[[0, 0, 0], [3.0, 1, 0], [2.999, 1, 0], [4.0, 1, 0], [1, -0.1, 0]]
    )
    assert outside_drawing(trajectory, world).tolist() == [
        False,
        False,
        False,
        True,
        True,
    ]
    assert inside_walls(trajectory, world).tolist() == [False, True] + [False] * 3
    drop = outside_drawing(trajectory, world) | inside_walls(trajectory, world)
    assert drop_poses(trajectory, drop).poses[:, 0].tolist() == [0.0, 2.999]
    with pytest.raises(TrajectoryError, match="all 5 poses"):
        drop_poses(trajectory, np.ones(5, bool))


@pytest.mark.parametrize(
    "text",
    [
        "x,y,theta\n1.5,2.5,0.5\n3,4.25,-1.25\n",
        "1.5,2.5,0.5\n3,4.25,-1.25",
        "1.5, 2.5, 0.5\r\n3, 4.25, -1.25\r\n\r\n",
        "1.5 2.5 0.5\n3 4.25 -1.25\n",
        "  1.5\t2.5\t0.5\n3\t4.25\t-1.25\n",
        "1.5;2.5;0.5;\n3;4.25;-1.25;\n",
        "1,5;2,5;0,5\n3;4,25;-1,25\n",
        "1,5 2,5 0,5\n3 4,25 -1,25\n",
        "# a comment\n\n1.5,2.5,5e-1\n% another\n+3,4.25,-1.25\n",
        "theta_rad,name,y_px,x_px\n0.5,a door,2.5,1.5\n-1.25,,4.25,3\n",
        "Y [px];Heading (rad);X [px]\n2,5;0,5;1,5\n4,25;-1,25;3\n",
        "# x y theta\n1.5 2.5 0.5\n3 4.25 -1.25\n",
        '"x","y","yaw"\n"1.5","2.5","0.5"\n"3","4.25","-1.25"\n',
        "pos_x\tpos_y\torientation\n1.5\t2.5\t0.5\n3\t4.25\t-1.25\n",
        "[[1.5, 2.5, 0.5], [3, 4.25, -1.25]]",
        '{"poses": [[1.5, 2.5, 0.5], [3, 4.25, -1.25]]}',
        '[{"theta": 0.5, "x": 1.5, "y": 2.5}, {"x": 3, "y": 4.25, "theta": -1.25}]',
    ],
)
def test_text_is_read_however_it_is_laid_out(text):
    assert load_trajectory(text.encode()).poses.tolist() == TWO


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_other_encodings_are_read(encoding):
    text = "x;y;theta [°]\n1.5;2.5;90\n3;4.25;270\n"
    loaded = load_trajectory(text.encode(encoding))
    np.testing.assert_allclose(loaded.poses, TWO_DEG_IN_RAD, rtol=1e-15)


@pytest.mark.parametrize(
    ("title", "degrees"),
    [
        ("theta", None),
        ("theta_deg", True),
        ("theta [degrees]", True),
        ("Theta (°)", True),
        ("θ/rad", False),
        ("yaw_rad", False),
        ("heading rad", False),
    ],
)
def test_header_says_the_unit_of_headings(title, degrees):
    table = read_trajectory_table(f"x,y,{title}\n1,2,3\n".encode())
    assert table.degrees is degrees
    assert table.needs_angle_unit == (degrees is None)
    assert table.values.tolist() == [[1, 2, 3]]


def test_caller_decides_the_unit_over_the_file():
    data = b"x,y,theta_deg\n1.5,2.5,90\n3,4.25,270\n"
    np.testing.assert_allclose(load_trajectory(data).poses, TWO_DEG_IN_RAD)
    assert load_trajectory(data, degrees=False).poses.tolist() == TWO_DEG
    bare = b"1.5,2.5,90\n3,4.25,270\n"
    np.testing.assert_allclose(
        load_trajectory(bare, degrees=True).poses, TWO_DEG_IN_RAD
    )


def test_headings_beyond_a_turn_without_a_unit_are_asked_about():
    with pytest.raises(TrajectoryError, match="pose 2 has 270, beyond one turn"):
        load_trajectory(b"0,0,1\n3,4.25,270\n0,0,90\n")
    assert load_trajectory(b"0,0,6.2832\n").poses[0, 2] == 6.2832


def test_file_on_disk_is_read_by_path(tmp_path):
    path = tmp_path / "walk.csv"
    path.write_text("1.5,2.5,0.5\n3,4.25,-1.25\n")
    assert load_trajectory(path).poses.tolist() == TWO
    assert load_trajectory(str(path)).poses.tolist() == TWO
    with pytest.raises(TrajectoryError, match="none.csv cannot be opened"):
        load_trajectory(tmp_path / "none.csv")


def test_tum_quaternions_become_headings():
    """Yaw of a turn by a about z is a: qz = sin(a/2), qw = cos(a/2)."""
    half = np.sqrt(0.5)
    text = f"# made by hand\n0.0 10 20 5 0 0 0 1\n1.5 11 21 5 0 0 {half} {half}\n"
    table = read_trajectory_table(text.encode())
    assert table.metres
    expected = [[10, 20, 0], [11, 21, np.pi / 2]]
    np.testing.assert_allclose(table.values, expected)
    with pytest.raises(TrajectoryError, match="line 1: the quaternion"):
        load_trajectory(b"0 1 2 3 0 0 0 0", name="a.tum")


FRAME = MetricFrame(height_px=100, metres_per_px=0.05)
"""At (x, y) m lies the pixel (20 x, 100 - 20 y); a turn to the left is negative."""

POSE_M = [1.0, 2.0, np.pi / 2]
POSE_PX = [[20.0, 60.0, -np.pi / 2]]
HALF = repr(float(np.sqrt(0.5)))

METRIC_FILES = {
    "tum": f"7 1 2 0 0 0 {HALF} {HALF}",
    "tum, qw first, named": "#timestamp tx ty tz qw qx qy qz\n"
    f"7 1 2 0 {HALF} 0 0 {HALF}",
    "quaternion before the place": f"qw,qx,qy,qz,x,y\n{HALF},0,0,{HALF},1,2",
    "quaternion after it": f"t;y;x;qz;qy;qx;qw\n7;2;1;{HALF};0;0;{HALF}",
    "euroc": "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], "
    "q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], "
    "v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1]\n"
    f"1403636579763555584,1,2,0.5,{HALF},0,0,{HALF},9,9,9,9",
    "ros": "%time,field.header.seq,field.pose.pose.position.x,"
    "field.pose.pose.position.y,field.pose.pose.position.z,"
    "field.pose.pose.orientation.x,field.pose.pose.orientation.y,"
    "field.pose.pose.orientation.z,field.pose.pose.orientation.w,"
    "field.twist.twist.linear.x,field.twist.twist.angular.z\n"
    f"7,1,1,2,0,0,0,{HALF},{HALF},5,5",
    "plotjuggler": "__time,/odom/pose/pose/position/x,/odom/pose/pose/position/y,"
    "/odom/pose/pose/orientation/yaw_deg\n7,1,2,90",
    "metres in the titles": "x_m,y_m,yaw_deg\n1,2,90",
    "centimetres": "x [cm];y [cm];heading (deg)\n100;200;90",
    "nothing but a frame": f"1,2,{np.pi / 2}",
    # A camera that looks along its z, which is up on a plan.
    "kitti": "1 0 0 1 0 1 0 0 0 0 1 2",
    "kitti, z up": "0 -1 0 1 1 0 0 2 0 0 1 0",
}


@pytest.mark.parametrize("text", METRIC_FILES.values(), ids=METRIC_FILES)
def test_metres_come_into_the_image_frame_whatever_the_order(text):
    loaded = load_trajectory(text.encode(), frame=FRAME)
    np.testing.assert_allclose(loaded.poses, POSE_PX, atol=1e-12)


@pytest.mark.parametrize(
    "text", [t for k, t in METRIC_FILES.items() if "but a frame" not in k]
)
def test_metres_are_never_taken_for_pixels(text):
    with pytest.raises(TrajectoryError, match="are in metres; .* its scale, .* corner"):
        load_trajectory(text.encode(), degrees=False)


def test_frame_is_for_metres_and_a_frame():
    with pytest.raises(TrajectoryError, match="in px; a frame is for metres"):
        load_trajectory(b"x_px,y_px,theta_rad\n1,2,0", frame=FRAME)
    with pytest.raises(TypeError, match="must be a MetricFrame; got float"):
        load_trajectory(b"x_m,y_m,theta_rad\n1,2,0", frame=0.05)
    tiny = MetricFrame(height_px=1, metres_per_px=1e-300)
    with pytest.raises(TrajectoryError, match="finite"):
        load_trajectory(b"x_m,y_m,theta_rad\n1e9,2,0", frame=tiny)


def test_pixels_are_preferred_to_metres_where_a_file_has_both():
    data = b"x_m,x_px,y_m,y_px,theta_rad\n1,20,2,40,0.5\n"
    assert load_trajectory(data).poses.tolist() == [[20, 40, 0.5]]


@pytest.mark.parametrize(
    "text",
    [
        "1,5;2,5;0,5",
        "1,234;12,5;0,5",  # a thousand has three digits after its comma
        "1,234;0,500;0,5",  # and none begins with zero
        "1,234\t2\t0,5",
    ],
)
def test_decimal_comma_is_read_where_another_number_shows_it(text):
    (first, *_), *_ = load_trajectory(text.encode()).poses.tolist()
    assert first in (1.5, 1.234)


@pytest.mark.parametrize(
    "text", ["1,234;5;0", "1,234\t5\t0", "1,234;5;0.5", "7;5;0\n12,500;-1,234;0"]
)
def test_comma_that_may_be_of_thousands_is_refused(text):
    with pytest.raises(TrajectoryError, match="may be .* or .*decimal point"):
        load_trajectory(text.encode())


UP, RIGHT, DOWN, LEFT = 1.5 * np.pi, 0.0, 0.5 * np.pi, np.pi
CORNER = [[0, 0], [10, 0], [10, 5]]
"""Right 10 px, then down 5 px."""


def test_path_is_resampled_at_equal_steps_looking_along():
    """Steps of 4 px along 15 px: at 0, 4, 8, 12 (2 px past the corner) and the end."""
    expected = [
        [0, 0, RIGHT],
        [4, 0, RIGHT],
        [8, 0, RIGHT],
        [10, 2, DOWN],
        [10, 5, DOWN],
    ]
    np.testing.assert_allclose(resample(CORNER, 4).poses, expected, atol=1e-12)


def test_position_at_a_corner_looks_the_way_that_leaves_it():
    poses = resample(CORNER, 5).poses
    np.testing.assert_allclose(
        poses, [[0, 0, RIGHT], [5, 0, RIGHT], [10, 0, DOWN], [10, 5, DOWN]]
    )


def test_robot_turns_on_the_spot_at_waypoints():
    poses = resample(CORNER, 6, turn_at_waypoints=True).poses
    around = [RIGHT, DOWN, LEFT, UP]
    expected = [[0, 0, look] for look in around]
    expected += [[6, 0, RIGHT]]
    expected += [[10, 0, look] for look in (DOWN, LEFT, UP, RIGHT)]
    expected += [[10, 2, DOWN]]
    expected += [[10, 5, look] for look in (DOWN, LEFT, UP, RIGHT)]
    np.testing.assert_allclose(poses, expected, atol=1e-12)


def test_turns_may_be_given_waypoint_by_waypoint():
    # A free line from (0, 0) over (2, 0) to a waypoint at (4, 0), where it turns.
    line = [(0, 0), (2, 0), (4, 0), (4, 0)]
    poses = resample(line, 3, turn_at_waypoints=[False, False, True, False]).poses
    np.testing.assert_allclose(poses[:, 0], [0, 3, 4, 4, 4, 4], atol=1e-12)
    quarters = np.arange(4) * np.pi / 2
    np.testing.assert_allclose(poses[2:, 2], quarters, atol=1e-12)
    with pytest.raises(ParameterError, match=r"each of the 4 waypoints; got shape"):
        resample(line, 3, turn_at_waypoints=[True])


def test_headings_are_snapped_or_all_four():
    """A way 30 degrees below the right: nearest of the four is right."""
    way = [[0, 0], [10 * np.cos(np.pi / 6), 5]]
    along = resample(way, 5).poses
    np.testing.assert_allclose(along[:, 2], np.pi / 6)
    snapped = resample(way, 5, heading_mode=HeadingMode.CARDINAL).poses
    np.testing.assert_allclose(snapped[:, :2], along[:, :2])
    assert set(snapped[:, 2]) == {RIGHT}
    four = resample(way, 5, heading_mode=HeadingMode.FOUR).poses
    assert four[:, 2].tolist() == [RIGHT, DOWN, LEFT, UP] * 3


def test_single_waypoint_is_one_pose():
    assert resample([[3, 4]], 5).poses.tolist() == [[3, 4, 0]]
    assert resample([[3, 4], [3, 4]], 5).poses.tolist() == [[3, 4, 0]]


waypoints = st.lists(
    st.tuples(st.floats(-500, 500), st.floats(-500, 500)), min_size=1, max_size=8
)


@settings(deadline=None)
@given(
    points=waypoints,
    step=st.floats(0.5, 300),
    mode=st.sampled_from(HeadingMode),
    turn=st.booleans(),
)
def test_resampled_path_keeps_step_ends_and_headings(points, step, mode, turn):
    poses = resample(points, step, heading_mode=mode, turn_at_waypoints=turn).poses
    gaps = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert (gaps <= step + 1e-6).all()
    np.testing.assert_allclose(poses[0, :2], points[0], atol=1e-6)
    np.testing.assert_allclose(poses[-1, :2], points[-1], atol=1e-4)
    if mode is not HeadingMode.ALONG:
        assert set(poses[:, 2]) <= set(CARDINAL_HEADINGS_RAD)
    if mode is HeadingMode.FOUR:
        looks = poses.reshape(-1, 4, 3)
        assert (looks[:, :, :2] == looks[:, :1, :2]).all()
        assert (np.sort(looks[:, :, 2]) == CARDINAL_HEADINGS_RAD).all()
    if turn:
        for point in points:
            at = np.hypot(*(poses[:, :2] - point).T) < 1e-4
            assert set(CARDINAL_HEADINGS_RAD) <= set(poses[at, 2])
    # No longer than the path, and as long where every waypoint is a position.
    length = np.hypot(*np.diff(np.array(points), axis=0).T).sum()
    assert gaps.sum() <= length + 1e-6
    if turn:
        assert gaps.sum() == pytest.approx(length, abs=1e-4)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ([], "one or more pairs"),
        ([[1, 2, 3]], "one or more pairs"),
        ([["a", "b"]], "one or more pairs"),
        ([[1, np.nan]], "finite"),
        ([[0, 0], [MAX_RESAMPLED + 5, 0]], "at most 50,000"),
    ],
)
def test_bad_waypoints_are_refused(points, said):
    with pytest.raises(TrajectoryError, match=said):
        resample(points, 1)


def test_bad_resampling_is_refused():
    with pytest.raises(ParameterError, match="step_px must be above 0"):
        resample(CORNER, 0)
    with pytest.raises(ParameterError, match="must be one of HeadingMode.ALONG"):
        resample(CORNER, 1, heading_mode="sideways")


def npy(values, **options) -> bytes:
    out = io.BytesIO()
    np.save(out, values, **options)
    return out.getvalue()


def mat(variables: dict, **options) -> bytes:
    out = io.BytesIO()
    scipy.io.savemat(out, variables, **options)
    return out.getvalue()


def test_arrays_of_any_real_type_and_order_are_read():
    for dtype in (np.float32, ">f8", np.float64):
        assert load_trajectory(npy(np.array(TWO, dtype))).poses.tolist() == TWO
    assert load_trajectory(npy(np.asfortranarray(TWO))).poses.tolist() == TWO
    whole = np.array([[1, 2, 3]], np.int16)
    assert load_trajectory(npy(whole)).poses.tolist() == [[1, 2, 3]]


@pytest.mark.parametrize("compressed", [False, True])
def test_matlab_array_of_any_name_is_read(compressed):
    data = mat({"s": 4.0, "R": np.array(TWO)}, do_compression=compressed)
    assert load_trajectory(data).poses.tolist() == TWO
    both = mat({"other": np.ones((2, 3)), "poses": np.array(TWO)})
    assert load_trajectory(both).poses.tolist() == TWO
    old = mat({"R": np.array(TWO)}, format="4")
    assert load_trajectory(old, name="old.mat").poses.tolist() == TWO
    degrees = mat({"trajectory_deg": np.array(TWO_DEG)})
    np.testing.assert_allclose(load_trajectory(degrees).poses, TWO_DEG_IN_RAD)


@pytest.mark.parametrize("dtype", ["f8", "f4", "i1", "u1", "i2", "u2", "i4", "i8"])
@pytest.mark.parametrize("options", [{}, {"do_compression": True}, {"format": "4"}])
def test_matlab_numbers_of_every_type_are_read_as_scipy_reads_them(dtype, options):
    whole = np.arange(12).reshape(4, 3).astype(dtype)
    others = {} if "format" in options else {"cell": np.array(["b"], object)}
    data = mat(others | {"way": whole}, **options)
    expected = scipy.io.loadmat(io.BytesIO(data))["way"]
    loaded = read_trajectory_table(data, name="way.mat").values
    assert loaded.dtype == np.float64
    np.testing.assert_array_equal(loaded, expected)


def test_big_endian_matlab_file_is_read():
    """Written out by hand after MathWorks' description of the format."""
    values = np.array(TWO).T.astype(">f8").tobytes()  # column by column
    body = struct.pack(">IIII", 6, 8, 6, 0)  # flags: class 6, double
    body += struct.pack(">IIii", 5, 8, 2, 3)  # dimensions 2 x 3
    body += struct.pack(">HH4s", 1, 1, b"R")  # the name, a small element
    body += struct.pack(">II", 9, len(values)) + values
    header = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x01\x00MI"
    data = header + struct.pack(">II", 14, len(body)) + body
    assert load_trajectory(data).poses.tolist() == TWO


BAD_FILES = [
    (b"", "empty"),
    (b"\n\n# nothing\n", "no poses"),
    (b"x,y,theta\n", "no poses"),
    (b"1,2,3\n4,five,6\n", "line 2: y must be a finite number; got 'five'"),
    (b"x,y,theta\n1,2,nan\n", "line 2: theta must be a finite number; got 'nan'"),
    (b"1,2,3\n\n4,inf,6\n", "line 3: y"),
    (b"1,2,\n", "line 1: three columns"),
    (b"x,y,theta\n1,2\n", "line 2: 3 columns are needed; got 2: '1', '2'"),
    (b"1,2\n3,4\n", "line 1: three columns x, y, theta are needed"),
    (b"1,2,3,4\n", "or a header that names them; got 4 columns"),
    (b"a,b,c\n1,2,3\n", "must name the columns x, y and theta"),
    (b"x_m,y_m,theta\n1,2,3\n", "in metres; px in the drawing are needed"),
    (b"hello", "must name the columns"),
    (b"1,2,3\n" * 100_000, "has 100,000 poses; at most 50,000"),
    (b"1,2,3\n" * 4_000_000, "24.0 MB; at most 20 MB"),
    (bytes(300), "not a text file"),
    (b"\xff\xfe\x00", "not a text file"),
    (b"\x80\x04\x95pickle", "not a text file"),
    (b"PK\x03\x04" + bytes(60), "is a zip archive, not a trajectory"),
    (b"[[1, 2, 3", "not valid JSON"),
    (b"[" * 40_000, "not valid JSON"),
    (b"[" * 100_000, "too long; a JSON file may have 10 MB, 50,000 poses"),
    (
        b"[" + b"[" * 992 + b"]" * 993,
        "pose 1: a list of 3 numbers is needed; got a|not valid",
    ),
    (b'[{"x": 1, "y": 2, "theta": "\\ud800"}]', "pose 1: every value must be a num"),
    (b'[{"\\ud800": 1, "x": 2, "y": 3, "theta": 4}, {"x": 1}]', "pose 2: the keys"),
    (b"1,2,1e16", "headings 1e\\+06; got 1, 2, 1e\\+16"),
    (b"1,1e300,0", "positions at most 1e\\+09"),
    (b"1\n" * 9_000_000, "about 9,000,000 lines; at most 200,000"),
    (b"x" * 19_000_000, "line 1 has 19,000,000 bytes; at most 10,000"),
    (b"1,2,3\n1,2,3,4\n", "line 2: 3 columns are needed; got 4"),
    (b"1_0,2,3\n", "line 1: x must be a finite number; got '1_0'"),
    (b"a,b,c,d,e,f,g,h\n" + b"1,2,3,4,0,0,0,1\n", "must name the columns x, y and th"),
    (b"#a,b,c,d,e,f,g,h\n" + b"1,2,3,4,0,0,0,1\n", "must name the columns x, y and t"),
    (b"#t x y z a b c d\n" + b"1 2 3 4 0 0 0 1\n", "must name the columns x, y and t"),
    (b"1 2 3 4 5 6 7 8\n", "quaternion qx qy qz qw must have length 1"),
    (b"0 1 2 0 1 0 0 0\n0 1 2 0 .8 0 0 .6\n", "seem to have qw first"),
    (b"1 2 3 4 5 6 7 8 9 10 11 12\n", "these hold no rotation"),
    (b"x_px,y_m,theta\n1,2,3\n", "must name the columns"),
    (b"#ROSBAG V2.0\n" + bytes(99), "is a ROS 1 bag, not a trajectory"),
    (b"ODOM 0 0 0 0 0 0 0.1 host 0.1\n", "a robot's log in CARMEN format"),
    (b"\x89PNG\r\n\x1a\n" + bytes(99), "is an image, not a trajectory; open it as"),
    (b"%PDF-1.7\n", "is a PDF, not a trajectory"),
    (b"[]", "no poses"),
    (b"{}", "must hold a list of poses"),
    (b"[1, 2, 3]", "pose 1: a list of 3 numbers is needed; got 1"),
    (b"[[1, 2, 3], [1, 2]]", "pose 2: a list of 3 numbers"),
    (b'[[1, 2, "3"]]', "pose 1: every value must be a number"),
    (b"[[1, 2, true]]", "pose 1: every value must be a number"),
    (b"[[1, 2, NaN]]", "pose 1: every number must be finite"),
    (b"[[1, 2, 1" + b"0" * 400 + b"]]", "pose 1: every number must be finite"),
    (b'[{"x": 1, "y": 2, "theta": 3}, {"x": 1}]', "pose 2: the keys"),
    (b'[{"x": 1, "y": 2}]', "must have x, y and theta"),
    (b'{"poses": [[1, 2, 3]], "columns": 5}', "must have x, y and theta"),
    (npy(np.zeros((3, 2))), r"shape \(S, 3\), rows of x, y, theta; got \(3, 2\)"),
    (npy(np.zeros((0, 3))), "no poses"),
    (npy(np.zeros((MAX_POSES + 1, 3), np.int8)), "at most 50,000"),
    (npy(np.full((2, 3), np.inf)), "pose 1: every number must be finite"),
    (npy(np.zeros((2, 3), complex)), "real numbers; got complex128"),
    (npy(np.array([[{}, 1, 2]], object), allow_pickle=True), "real numbers"),
    (npy(np.zeros((9, 3)))[:-8], "cut short"),
    # As many bytes as before, so that the header stays as long as it says.
    (
        npy(np.zeros((1, 3))).replace(b"(1, 3), }   ", b"(True, 3), }"),
        r"\(S, 3\).*True",
    ),
    (b"\x93NUMPY\x01\x00", "header of .* is damaged"),
    (b"\x93NUMPY\x01\x00\x06\x00(((((\n", "header of .* is damaged"),
    (b"\x89HDF\r\n\x1a\n" + bytes(99), "MATLAB 7.3"),
    (mat({"a": np.ones((4, 2))}), r"must hold one real matrix .* got a \(4, 2\)"),
    (mat({"a": np.ones((2, 3)), "b": np.ones((2, 3))}), "or one called trajectory"),
    (mat({"a": np.array([["abc"]])}), "must hold one real matrix"),
    (mat({"a": np.ones((2, 3))})[:180], "damaged"),
    (mat({"a": np.ones((2, 3)) * 1j}), "must hold one real matrix"),
]


@pytest.mark.parametrize(("data", "said"), BAD_FILES, ids=range(len(BAD_FILES)))
def test_bad_file_is_refused_in_one_sentence(data, said):
    with pytest.raises(TrajectoryError, match=said) as caught:
        load_trajectory(data)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 320


def test_matlab_file_that_unpacks_without_end_is_refused():
    """40 MB of zeros pack into 40 kB."""
    data = mat({"a": np.zeros(MAX_INFLATED_BYTES, np.uint8)}, do_compression=True)
    assert len(data) < 200_000
    with pytest.raises(TrajectoryError, match="unpacks to more than 40 MB"):
        load_trajectory(data)


@pytest.mark.parametrize("file_format", list(TrajectoryFormat))
@settings(deadline=None)
@given(values=poses)
def test_every_format_gives_back_what_was_written(file_format, values):
    trajectory = Trajectory(poses=values)
    name = f"a.{file_format.value}"
    loaded = load_trajectory(
        dump_trajectory(trajectory, file_format), name=name, degrees=False
    ).poses
    if file_format is TrajectoryFormat.TUM:
        np.testing.assert_array_equal(loaded[:, :2], values[:, :2])
        turn = np.exp(1j * loaded[:, 2]) - np.exp(1j * values[:, 2])
        np.testing.assert_allclose(np.abs(turn), 0.0, atol=1e-9)
    else:
        np.testing.assert_array_equal(loaded, values)


@pytest.mark.parametrize("file_format", list(TrajectoryFormat))
def test_degrees_are_written_and_the_file_says_so(file_format):
    data = dump_trajectory(Trajectory(poses=TWO_DEG_IN_RAD), file_format, degrees=True)
    table = read_trajectory_table(data, name=f"a.{file_format.value}")
    says = {TrajectoryFormat.NPY: None, TrajectoryFormat.TUM: False}
    assert table.degrees is says.get(file_format, True)
    if file_format is not TrajectoryFormat.TUM:
        np.testing.assert_allclose(table.values, TWO_DEG, rtol=1e-15)


def test_unknown_format_is_refused():
    with pytest.raises(ParameterError, match="file_format must be one of .* got 'xls'"):
        dump_trajectory(Trajectory(poses=TWO), "xls")


@settings(deadline=None)
@given(
    data=st.binary(max_size=200) | st.text("0123,.; \t\nxy#[]{}\"'-e").map(str.encode)
)
def test_any_bytes_are_read_or_refused(data):
    message = ""
    try:
        load_trajectory(data)
    except TrajectoryError as error:  # any other error fails the test
        message = str(error)
    assert "\n" not in message


@settings(deadline=None)
@given(
    data=st.sampled_from(
        [
            mat({"a": np.array(TWO)}, do_compression=True),
            mat({"a": np.array(TWO)}),
            npy(np.array(TWO)),
            json.dumps(TWO).encode(),
        ]
    ),
    flips=st.lists(
        st.tuples(st.integers(0, 400), st.integers(0, 255)), min_size=1, max_size=6
    ),
)
def test_damaged_files_are_read_or_refused(data, flips):
    damaged = bytearray(data)
    for position, value in flips:
        damaged[position % len(damaged)] = value
    message = ""
    try:
        load_trajectory(bytes(damaged), name="a.mat" if data[:6] == b"MATLAB" else "a")
    except TrajectoryError as error:  # any other error fails the test
        message = str(error)
    assert len(message) < 320


def test_metric_poses_with_y_up_come_into_the_image_frame():
    """A map of 100 px height at 0.05 m a pixel, its lower left corner at (-1, 2) m.

    (0, 2) m is 1 m = 20 px right of that corner, at the bottom edge, y = 100 px;
    (-1, 7) m is 5 m = 100 px above it, at the top edge. A yaw to the left (up on the
    screen) is a negative heading.
    """
    frame = MetricFrame(height_px=100, metres_per_px=0.05, origin_x_m=-1, origin_y_m=2)
    metric = [[0, 2, 0], [-1, 7, np.pi / 2]]
    expected = [[20, 100, 0], [0, 0, -np.pi / 2]]
    image = poses_to_image(metric, frame)
    np.testing.assert_allclose(image.poses, expected, atol=1e-12)
    np.testing.assert_allclose(poses_to_metric(image, frame), metric, atol=1e-12)


def test_metric_frame_is_checked():
    with pytest.raises(ParameterError, match="metres_per_px must be above 0"):
        MetricFrame(height_px=10, metres_per_px=0)
    with pytest.raises(ParameterError, match="height_px must be 1 or more"):
        MetricFrame(height_px=0, metres_per_px=1)
    with pytest.raises(ParameterError, match="the origin must be finite"):
        MetricFrame(height_px=1, metres_per_px=1, origin_x_m=float("nan"))

"""Bags of ROS 1 and 2: what their messages say, and where it lies on a map."""

import contextlib
import io
import math
import sqlite3
import subprocess
import sys
import zipfile

import numpy as np
import pytest

import occsim.io.bags.parts
from occsim import RobotFileError, Sensor, Trajectory, load_sample, simulate_scans
from occsim.io import bags
from occsim.io.bags import PoseSource
from occsim.io.metric import MetricFrame, poses_to_metric
from tests.test_carmen import hits_m

pytest.importorskip("rosbags", reason="the extra ros")

from tests.bags import OLD_TF, Bag  # noqa: E402


def poses_m(log):
    return poses_to_metric(log.scan_log.trajectory, log.frame)


def driven(bag):
    """One scan half-way between (0, 0) facing +x and (2, 0) facing +y."""
    bag.odometry(10, (0, 0, 0)).odometry(12, (2, 0, math.pi / 2))
    return bag.scan(11, [3, 4, 5])


def split_bag(folder, suffix=".mcap"):
    """The files of a recording that ROS 2 split: 3 scans, the last without a pose.

    The first file says where the range finder sits, and the first pose.
    """
    first, second = Bag(2), Bag(2)
    first.tf(9, "base_link", "laser", (0.5, 0, 0), topic="/tf_static")
    first.odometry(10, (0, 0, 0)).scan(10, [3, 4, 5])
    second.odometry(12, (2, 0, 0)).scan(12, [3, 4, 5]).scan(99, [3, 4, 5])
    contents = []
    for name, bag in (("a", first), ("b", second)):
        (folder / name).mkdir()
        contents.append(bag.content(folder / name, suffix))
    names = f"drive_2{suffix}", f"drive_10{suffix}"
    return {**dict(zip(names, contents, strict=True)), "metadata.yaml": b"x: ../../y"}


@pytest.mark.parametrize("suffix", [".mcap", ".db3"])
def test_the_folder_of_a_recording_is_one_log(tmp_path, suffix):
    """By hand: the laser sits half a metre ahead, at x = 0.5 and x = 2.5."""
    files = split_bag(tmp_path, suffix)
    folder = tmp_path / "drive"
    folder.mkdir()
    for name, data in files.items():
        (folder / name).write_bytes(data)
    zipped = {f"drive/{name}": data for name, data in files.items()}
    for source in (folder, bags.join(files), bags.join(zipped)):
        log = bags.load(source)
        np.testing.assert_allclose(poses_m(log), [[0.5, 0, 0], [2.5, 0, 0]], atol=1e-9)
        assert log.n_left_out == 1


def zipped_bag(**files):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return out.getvalue()


BAD_FOLDERS = {
    "packed parts": ({"a.mcap.zstd": b"x"}, "unpack them first"),
    "two bags": ({"a/a.mcap": b"x", "b/b.mcap": b"x"}, "one bag is read at a time"),
    "a part that is none": ({"a.mcap": b"no bag"}, "is none of ROS"),
}


@pytest.mark.parametrize("kind", BAD_FOLDERS)
def test_a_folder_that_is_no_bag_is_refused_in_a_sentence(kind):
    files, says = BAD_FOLDERS[kind]
    data = zipped_bag(**files)
    assert bags.is_bag(data)
    with pytest.raises(RobotFileError, match=says):
        bags.load(data)


def test_files_beside_those_of_a_bag_are_refused():
    with pytest.raises(RobotFileError, match="got notes.txt among them"):
        bags.join({"a.mcap": b"", "notes.txt": b""})
    with pytest.raises(RobotFileError, match="needs a .db3 or .mcap"):
        bags.join({"metadata.yaml": b""})


def test_a_folder_that_unpacks_to_too_much_is_refused(monkeypatch):
    monkeypatch.setattr(occsim.io.bags.parts, "MAX_FILE_BYTES", 10)
    data = zipped_bag(**{"a.mcap": bytes(8), "b.mcap": bytes(8)})
    with pytest.raises(RobotFileError, match="may unpack to at most 0 MB together"):
        occsim.io.bags.parts._unzipped(data)


@pytest.mark.parametrize(
    ("ros", "suffix", "compression"),
    [
        (1, ".bag", None),
        (1, ".bag", "BZ2"),
        (1, ".bag", "LZ4"),
        (2, ".db3", None),
        (2, ".mcap", None),
    ],
)
def test_a_scan_lies_half_way_between_two_poses(tmp_path, ros, suffix, compression):
    """By hand: at (1, 0) facing 45 degrees up; right 3 m, ahead 4 m, left 5 m."""
    log = bags.load(driven(Bag(ros)).content(tmp_path, suffix, compression))
    half = math.sqrt(0.5)
    np.testing.assert_allclose(poses_m(log), [[1, 0, math.pi / 4]], atol=1e-9)
    np.testing.assert_allclose(
        sorted(hits_m(log).tolist()),
        sorted(
            [
                [1 + 3 * half, -3 * half],
                [1 + 4 * half, 4 * half],
                [1 - 5 * half, 5 * half],
            ]
        ),
        atol=1e-6,  # angles are float32
    )
    assert log.times_s.tolist() == [11.0]
    assert (log.scan_topic, log.poses_from) == ("/scan", "/odom")
    assert log.scan_log.max_range_px == pytest.approx(30 / 0.05)


def test_a_simulated_drive_comes_back_as_it_was(tmp_path):
    sample = load_sample("d")
    height = sample.world.shape[0]
    frame = MetricFrame(height_px=height, metres_per_px=0.05, origin_x_m=-3)
    poses = Trajectory(sample.trajectory.poses[::40])
    sensor = Sensor(range_px=60, fov_rad=np.pi)
    drive = simulate_scans(sample.world, poses, sensor, 90)
    bag = Bag(2)
    step = np.pi / 90
    for time_s, (pose, row) in enumerate(
        zip(poses_to_metric(poses, frame), drive.ranges_px[:, ::-1], strict=True), 1
    ):
        bag.odometry(time_s, pose)
        bag.scan(
            time_s,
            row * 0.05,
            angle_min=-np.pi / 2 + step / 2,
            angle_increment=step,
            range_max=3.0,
            range_min=0.0,
        )
    log = bags.load(bag.content(tmp_path, ".mcap"))
    np.testing.assert_allclose(
        log.scan_log.ranges_px, drive.ranges_px, rtol=1e-6, atol=1e-5
    )
    np.testing.assert_allclose(log.scan_log.bearings_rad, drive.bearings_rad, atol=1e-5)
    np.testing.assert_allclose(
        poses_m(log)[:, :2], poses_to_metric(poses, frame)[:, :2], atol=1e-9
    )


@pytest.mark.parametrize("ros", [1, 2])
def test_transforms_lead_from_the_map_to_the_range_finder(tmp_path, ros):
    """By hand: map to odom shifts by (10, 0); the robot stands at (1, 2) facing up; the
    range finder 0.5 m ahead of its middle, facing back: at (11, 2.5), facing down."""
    suffix = ".bag" if ros == 1 else ".db3"
    bag = Bag(ros)
    for time_s in (1, 3):
        bag.tf(time_s, "map", "odom", (10, 0, 0))
        bag.tf(time_s, "odom", "base_link", (time_s - 1, 2, math.pi / 2))
        bag.odometry(time_s, (time_s - 1, 2, math.pi / 2))
    bag.tf(0, "base_link", "laser", (0.5, 0, math.pi), topic="/tf_static")
    bag.scan(2, [3, 4, 5])
    content = bag.content(tmp_path, suffix)
    log = bags.load(content)
    np.testing.assert_allclose(poses_m(log), [[11, 2.5, -math.pi / 2]], atol=1e-9)
    assert log.poses_from == "frames map to laser"
    # Odometry knows no map, but where the range finder sits is fixed.
    counted = bags.load(content, poses="odometry")
    np.testing.assert_allclose(poses_m(counted), [[1, 2.5, -math.pi / 2]], atol=1e-9)
    assert counted.poses_from == "/odom"


def test_transforms_of_the_first_ros_have_a_type_of_their_own(tmp_path):
    bag = Bag(1)
    for time_s in (1, 3):
        bag.tf(time_s, "/odom", "/laser", (time_s, 0, 0), kind=OLD_TF)
    log = bags.load(bag.scan(2, [1, 1]).content(tmp_path))
    np.testing.assert_allclose(poses_m(log), [[2, 0, 0]], atol=1e-9)


def test_a_range_finder_upside_down_sees_its_left_on_the_right(tmp_path):
    """As by hand above, but 3 m to the left and 5 m to the right of (1, 0)."""
    bag = driven(Bag())
    bag.tf(0, "base_link", "laser", (0, 0, 0), "/tf_static", quaternion=(1, 0, 0, 0))
    half = math.sqrt(0.5)
    np.testing.assert_allclose(
        sorted(hits_m(bags.load(bag.content(tmp_path))).tolist()),
        [
            [1 - 3 * half, 3 * half],
            [1 + 4 * half, 4 * half],
            [1 + 5 * half, -5 * half],
        ],
        atol=1e-6,
    )


def test_the_topic_with_the_most_scans_is_taken_unless_one_is_named(tmp_path):
    bag = driven(Bag()).scan(11.1, [1, 1], topic="/rear").scan(11.2, [1, 1], "/rear")
    content = bag.content(tmp_path)
    assert bags.load(content).scan_topic == "/rear"
    assert bags.load(content, scan_topic="/scan").scan_log.n_beams == 3
    with pytest.raises(RobotFileError, match="no scans in /top; it has them in /rear,"):
        bags.load(content, scan_topic="/top")


def test_scans_without_poses_around_them_and_of_other_beams_are_counted(tmp_path):
    bag = driven(Bag()).scan(9, [1, 1, 1]).scan(13, [1, 1, 1]).scan(11.5, [1, 1])
    log = bags.load(bag.content(tmp_path))
    assert (log.scan_log.n_scans, log.n_left_out) == (1, 3)


def test_readings_below_the_least_range_are_invalid_and_at_the_greatest_none(tmp_path):
    bag = driven(Bag())
    bag.messages.pop()
    bag.scan(11, [0.05, 29, 30, math.inf, math.nan])
    ranges = bags.load(bag.content(tmp_path)).scan_log.ranges_px[0, ::-1] * 0.05
    np.testing.assert_allclose(ranges, [np.nan, 29, np.inf, np.inf, np.nan])
    short = bags.load(bag.content(tmp_path), max_range_m=20).scan_log
    assert short.max_range_px == 400
    assert np.isinf(short.ranges_px[0, ::-1][1])


HERE = 0, 0, 0


def two_transforms(one, other):
    return Bag().tf(1, *one, HERE).tf(2, *other, (1, 0, 0)).scan(1, [1])


SAYS_TOO_LITTLE = {
    "no scans": (
        lambda: Bag().odometry(1, HERE),
        {},
        "no topic of sensor_msgs/LaserScan",
    ),
    "no poses": (
        lambda: Bag().scan(1, [1]),
        {},
        "neither transforms that lead to it nor nav_msgs/Odometry",
    ),
    "no transforms": (
        lambda: driven(Bag()),
        {"poses": PoseSource.TRANSFORMS},
        "no transforms that lead",
    ),
    "no odometry": (
        lambda: Bag().scan(1, [1]),
        {"poses": "odometry"},
        "it has no nav_msgs/Odometry",
    ),
    "another time": (
        lambda: Bag().odometry(1, HERE).odometry(2, (1, 0, 0)).scan(3, [1]),
        {},
        "no scan lies within the times of the poses from /odom",
    ),
    "two parents": (
        lambda: two_transforms(("a", "laser"), ("b", "laser")),
        {},
        "the frame laser must have one parent",
    ),
    "a circle": (
        lambda: two_transforms(("a", "laser"), ("laser", "a")),
        {},
        "and not be its own",
    ),
    "a pose of nothing": (
        lambda: driven(Bag()).odometry(12.5, (math.nan, 0, 0)),
        {},
        "must be finite",
    ),
    "far away": (
        lambda: driven(Bag()).odometry(13, (1e9, 0, 0)).scan(13, [1] * 3),
        {},
        "map would span",
    ),
}


@pytest.mark.parametrize(
    ("bag", "options", "sentence"), SAYS_TOO_LITTLE.values(), ids=SAYS_TOO_LITTLE
)
def test_a_bag_that_says_too_little_is_refused_in_a_sentence(
    tmp_path, bag, options, sentence
):
    with pytest.raises(RobotFileError, match=sentence) as refused:
        bags.load(bag().content(tmp_path), **options)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


@pytest.mark.parametrize("suffix", [".bag", ".db3", ".mcap"])
def test_a_damaged_bag_is_refused_in_a_sentence(tmp_path, suffix):
    content = driven(Bag(1 if suffix == ".bag" else 2)).content(tmp_path, suffix)
    half = len(content) // 2
    for damaged in (content[:half], content[:40], content[:half] + bytes(half)):
        with pytest.raises(RobotFileError) as refused:
            bags.load(damaged)
        assert "\n" not in str(refused.value)
        assert len(str(refused.value)) < 250


def test_a_file_that_is_no_bag_and_none_at_all(tmp_path):
    with pytest.raises(RobotFileError, match="is none of ROS"):
        bags.load(b"FLASER 3 1 1 1")
    with pytest.raises(RobotFileError, match="cannot be opened"):
        bags.load(tmp_path / "none.bag")
    (tmp_path / "own.bag").write_bytes(driven(Bag()).content(tmp_path))
    assert bags.load(tmp_path / "own.bag").scan_log.n_scans == 1


def test_a_message_of_a_gigabyte_ends_its_process_only(tmp_path):
    """A file of 50 kB whose messages are computed as they are read."""
    path = tmp_path / "bomb.db3"
    path.write_bytes(driven(Bag(2)).content(tmp_path, ".db3"))
    with contextlib.closing(sqlite3.connect(path)) as database:
        database.executescript(
            """
            CREATE TABLE other (id INTEGER PRIMARY KEY, topic_id INTEGER,
                timestamp INTEGER, data AS (zeroblob(999999999)));
            INSERT INTO other (id, topic_id, timestamp)
                SELECT id, topic_id, timestamp FROM messages;
            DROP TABLE messages;
            ALTER TABLE other RENAME TO messages;
            """
        )
    assert path.stat().st_size < 100_000
    with pytest.raises(RobotFileError, match="damaged"):
        bags.load(path)


def test_without_rosbags_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "rosbags.interfaces", None)
    sentence = r"a ROS bag needs rosbags: pip install 'occsim\[ros\]'"
    with pytest.raises(ImportError, match=sentence):
        bags.load(b"#ROSBAG V2.0\n")


def test_a_bag_that_takes_too_long_is_refused(monkeypatch, tmp_path):
    def late(*_, timeout, **__):
        raise subprocess.TimeoutExpired("python", timeout)

    monkeypatch.setattr(subprocess, "run", late)
    with pytest.raises(RobotFileError, match="longer than 60 s to read"):
        bags.load(driven(Bag()).content(tmp_path))

"""The page Robot data: a log, simulated or uploaded, becomes a map."""

import re
import sys

import numpy as np
import pytest

from occsim import RobotFileError, load_sample
from occsim.io import bags
from occsim.io.log_run import open_log
from occsim.io.project import Project, dump_project
from occsim.io.ros_map import RosMap, pack
from pages._ui.robot_data import scans
from pages._ui.words import ordinal
from tests.test_carmen import flaser
from tests.test_pages import control, file_in, launch, said, upload
from tests.test_timed import CSV, TUM

PAGE = "pages/4_Robot_data.py"
LABEL = "Log of scans"


def log_of(n=12, beams=9):
    """A CARMEN log: a robot drives 0.1 m a scan along a corridor, 2 m wide."""
    bearings = np.linspace(-90.0, 90.0, beams)
    with np.errstate(divide="ignore"):
        ranges = np.minimum(1.0 / np.abs(np.sin(np.radians(bearings))), 6.0)
    words = " ".join(f"{r:.2f}" for r in ranges)
    lines = [
        f"FLASER {beams} {words} {0.1 * i:.2f} 0 0 0 0 0 {i} robot {i}"
        for i in range(n)
    ]
    return "\n".join(lines).encode() + b"\n"


def caption(app):
    return next(text for text in said(app.caption) if re.search(r"\bscans? of", text))


def test_it_opens_with_a_log_of_its_own():
    app = launch(PAGE)
    assert not app.error
    assert "Simulated on the tour of this building" in caption(app)


def test_a_log_is_mapped_in_metres():
    app = upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain")
    assert not app.error
    text = caption(app)
    assert text.startswith("own.log: 12 scans of 9 beams")
    # Walls 1 m to either side and half a metre around: 3 m high.
    assert "× 3.0 m in cells of 5 cm" in text
    # No drawing is chosen while a log of one's own is shown.
    assert not [box for box in app.selectbox if box.label == "Drawing"]


def test_the_cell_size_of_a_log_can_be_changed():
    app = upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain")
    app.slider(key=control(app, "log_cell_m")).set_value(0.2).run()
    assert "in cells of 20 cm" in caption(app)


DAMAGED = {
    "a damaged line": (log_of() + b"FLASER 9 1 2 x\n", "line 13"),
    "a drawing": (b"\x89PNG\r\n\x1a\n0000", "an image"),
    "nothing": (b"", "empty"),
    "words": (b"this is no log\n", "FLASER"),
}


@pytest.mark.parametrize("kind", DAMAGED)
def test_a_damaged_log_is_refused_in_a_sentence_and_the_last_one_stays(kind):
    data, says = DAMAGED[kind]
    app = upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain")
    app = upload(app, LABEL, "bad.log", data, "text/plain")
    (message,) = said(app.error)
    assert "bad.log" in message
    assert says in message
    assert caption(app).startswith("own.log")


def test_a_map_that_would_be_too_large_is_refused_and_can_be_changed():
    far = log_of().replace(b" 0.50 0 0 0 0 0", b" 900.0 900 0 0 0 0")
    app = upload(launch(PAGE), LABEL, "far.log", far, "text/plain")
    assert "allowed" in said(app.error)[0]
    assert "Simulated" in caption(app)


def test_timed_scans_are_placed_by_their_trajectory():
    app = upload(launch(PAGE), LABEL, "scans.csv", CSV, "text/csv")
    assert (
        "timed scans need a TUM trajectory: upload both together" in said(app.error)[0]
    )
    poses = "Trajectory (TUM), before timed scans"
    app = upload(app, poses, "poses.txt", TUM, "text/plain")
    app = upload(app, LABEL, "scans.csv", CSV, "text/csv")
    assert not app.error
    assert caption(app).startswith("scans.csv: 1 scan of 3 beams")


def test_the_words_are_those_of_the_maps_that_are_shown():
    app = launch(PAGE)
    assert any("Where beams ended, all" in text for text in said(app.markdown))
    app.segmented_control(key="view_robot_maps").set_value(scans.BESIDE).run()
    assert not app.exception
    assert any("B is the share of beams" in text for text in said(app.markdown))
    assert not any("Where beams ended, all" in text for text in said(app.markdown))


def test_scans_without_a_pose_at_their_time_are_counted():
    app = upload(launch(PAGE), "Trajectory (TUM), before timed scans", "p.txt", TUM)
    late = CSV.partition(b"\n")[0] + b"\n11,3,4,5\n99,3,4,5\n"
    assert "Left out: 1 more" in caption(upload(app, LABEL, "scans.csv", late))


def test_a_log_in_millimetres_is_not_mapped_without_a_word():
    """All ranges lie beyond the reach, so nothing returns, and the map stays grey."""
    content = flaser([1500, 2000, 1500]).encode()
    app = upload(launch(PAGE), LABEL, "own.log", content, "text/plain")
    assert "No beam met anything" in caption(app)
    assert "in metres?" in caption(app)


def test_a_bag_is_mapped_where_rosbags_is_installed(tmp_path):
    pytest.importorskip("rosbags", reason="the extra ros")
    from tests.test_bags import Bag, driven

    content = driven(Bag(2)).content(tmp_path, ".mcap")
    app = upload(launch(PAGE), LABEL, "drive.mcap", content)
    assert not app.error
    assert caption(app).startswith("drive.mcap: 1 scan of 3 beams")


def test_without_rosbags_a_bag_is_refused_in_a_sentence(monkeypatch):
    monkeypatch.setitem(sys.modules, "rosbags.interfaces", None)
    with pytest.raises(RobotFileError, match="a ROS bag needs rosbags: pip install"):
        open_log(b"#ROSBAG V2.0\n")


def test_one_can_go_back_to_the_simulated_log():
    app = upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain")
    next(b for b in app.button if b.label.startswith("Back")).click().run()
    assert "Simulated" in caption(app)
    assert file_in(app, LABEL) is None


def test_what_was_left_out_is_said():
    app = launch(PAGE)
    assert "was used" not in caption(app)
    assert [ordinal(n) for n in (2, 3, 4, 11, 21, 112)] == [
        "2nd",
        "3rd",
        "4th",
        "11th",
        "21st",
        "112th",
    ]


def give(app, *files):
    """Give several files to the upload of a log at once."""
    uploader = next(x for x in app.get("file_uploader") if x.label == LABEL)
    uploader.set_value([(name, data, "text/plain") for name, data in files])
    app.run()
    assert not app.exception
    return app


def test_timed_scans_and_their_trajectory_are_given_together():
    app = give(launch(PAGE), ("poses.txt", TUM), ("scans.csv", CSV))
    assert not app.error
    assert caption(app).startswith("scans.csv: 1 scan of 3 beams")


def test_several_logs_are_not_one_log():
    app = give(launch(PAGE), ("a.log", log_of()), ("b.log", log_of()))
    assert "one log is mapped at a time" in said(app.error)[0]
    # The next one is alone, though it is given to the same upload.
    app = upload(app, LABEL, "own.log", log_of())
    assert not app.error
    assert caption(app).startswith("own.log")
    assert file_in(app, LABEL) is None


def test_the_folder_of_a_bag_is_given_as_its_files_or_as_a_zip(tmp_path):
    pytest.importorskip("rosbags", reason="the extra ros")
    from tests.test_bags import split_bag

    parts = split_bag(tmp_path)
    app = give(launch(PAGE), *parts.items())
    assert not app.error
    assert "2 scans of 3 beams" in caption(app)
    app = upload(launch(PAGE), LABEL, "bag.zip", bags.join(parts))
    assert "2 scans of 3 beams" in caption(app)


OTHERS = {
    "a TUM file": (TUM, "p.txt", "trajectory in TUM format", "scans are missing"),
    "KITTI poses": (
        b"1 0 0 0 0 1 0 0 0 0 1 0\n" * 3,
        "00.txt",
        "as KITTI writes them",
        "no times",
    ),
    "poses": (b"x\n1 2 0.5\n"[2:], "p.csv", "table of numbers", "6 Trajectory"),
    "a yaml": (
        b"image: a.pgm\nresolution: 0.05\n",
        "a.yaml",
        "the .yaml of a robot's map",
        "together with its image",
    ),
    "a picture": (
        b"\x89PNG\r\n\x1a\n0000",
        "a.png",
        "an image",
        "open it as a drawing (Your building",
    ),
    "a map": (
        b"P5 2 2 255\n\x00\xcd\xfe\xfe",
        "a.pgm",
        "a robot's map in ROS format",
        "together with its .yaml",
    ),
    "a pose graph": (b"VERTEX_SE2 0 0 0 0\n", "a.g2o", "a pose graph", "are missing"),
    "an array": (b"\x93NUMPY\x01\x00", "a.npy", "a NumPy array", "NPZ file of several"),
    "a zip of a map": (pack(RosMap([[0, 100]], 0.1)), "a.zip", "a .yaml", "A ROS map"),
    "a project": (
        dump_project(Project(building=load_sample("d"))),
        "a.zip",
        "a project of this application",
        "7 Keep",
    ),
}


@pytest.mark.parametrize("kind", OTHERS)
def test_a_file_that_is_no_log_is_told_what_is_missing_and_where_it_fits(kind):
    data, name, is_what, where = OTHERS[kind]
    with pytest.raises(RobotFileError) as refused:
        open_log(data)
    message = str(refused.value)
    assert is_what in message
    assert where in message
    app = upload(launch(PAGE), LABEL, name, data)
    assert is_what in said(app.error)[0]


def test_a_wrong_trajectory_is_refused_when_it_is_given():
    label = "Trajectory (TUM), before timed scans"
    app = upload(launch(PAGE), label, "own.log", log_of(), "text/plain")
    assert 'numbers are needed; got "FLASER"' in said(app.error)[0]

"""The kind of a user's file, and the sentence that says where to open it."""

import os

import numpy as np
import pytest
from PIL import Image

from occsim._files import printable, read_source
from occsim.errors import DrawingError
from occsim.imaging import FileKind, kind_of_file, load_drawing
from tests.test_drawing import PICTURE, encoded

YAML = (
    b"image: depot.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0]\nnegate: 0\n"
    b"occupied_thresh: 0.65\nfree_thresh: 0.25\n"
)
LEVELS = np.array([0, 205, 254, 254], np.uint8)
ROS_MAP = encoded(np.tile(LEVELS, (20, 8)), "PPM")
"""Occupied, unknown, free: the levels that map_saver writes."""

KINDS = [
    (encoded(PICTURE, "PNG"), "", FileKind.IMAGE),
    (encoded(PICTURE, "JPEG"), "plan.log", FileKind.IMAGE),
    (b"%PDF-1.7\n", "", FileKind.PDF),
    (b"junk before\n%PDF-1.7\n", "", FileKind.PDF),
    (ROS_MAP, "", FileKind.ROBOT_MAP),
    (
        b"P5\n# CREATOR: map_saver.cpp 0.05 m/pix\n4 2\n255\n" + bytes(8),
        "",
        "ROBOT_MAP",
    ),
    (encoded(PICTURE[:, :, 1], "PPM"), "plan.pgm", FileKind.IMAGE),
    (encoded(np.tile(np.uint8([0, 255]), (9, 9)), "PPM"), "a.pgm", FileKind.IMAGE),
    (YAML, "", FileKind.MAP_YAML),
    (b"a: 1\n", "depot.yaml", FileKind.MAP_YAML),
    (b"ODOM 0 0 0 0 0 0 0.000246 pippo 0.000246\n", "intel.gfs.log", "CARMEN_LOG"),
    (b"PARAM robot_frontlaser_offset 0.0\nFLASER 180 1.2\n", "", FileKind.CARMEN_LOG),
    (b"#ROSBAG V2.0\n" + bytes(40), "", FileKind.ROS_BAG),
    (b"SQLite format 3\0" + bytes(40), "rosbag2_0.db3", FileKind.ROS_BAG_SQLITE),
    (b"\x89MCAP0\r\n" + bytes(40), "", FileKind.ROS_BAG_MCAP),
    (b"VERTEX_SE2 0 1 2 0.5\n", "", FileKind.POSE_GRAPH),
    (b"AC1032" + bytes(40), "", FileKind.DWG),
    (b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", "", FileKind.DXF),
    (b"AutoCAD Binary DXF\r\n\x1a\0", "", FileKind.DXF),
    (b'<?xml version="1.0"?>\n<svg xmlns="x">', "", FileKind.SVG),
    (b"\0\0\0\x18ftypheic" + bytes(40), "", FileKind.HEIC),
    (b"\0\0\0\x18ftypavif" + bytes(40), "", FileKind.HEIC),
    (b"ISO-10303-21;\nHEADER;", "house.ifc", FileKind.IFC),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(40), "house.rvt", FileKind.OFFICE),
    (b"<!DOCTYPE html><html>", "", FileKind.HTML),
    (b"PK\x03\x04" + bytes(40), "", FileKind.ZIP),
    (b"\x93NUMPY\x01\0", "", FileKind.NUMPY),
    (b"x,y,theta\n1,2,3\n", "", FileKind.TEXT),
    ("x;y;θ\n".encode("utf-16"), "", FileKind.TEXT),
    (bytes(range(256)), "", FileKind.UNKNOWN),
    (b"", "", FileKind.TEXT),
]


@pytest.mark.parametrize(("data", "name", "kind"), KINDS, ids=range(len(KINDS)))
def test_kind_is_recognised_by_content_then_by_name(data, name, kind):
    assert kind_of_file(data, name).name == getattr(kind, "name", kind)


@pytest.mark.parametrize(
    ("data", "name", "kind"), [case for case in KINDS if case[0]], ids=str
)
def test_the_refusal_of_another_file_says_where_to_open_it(data, name, kind):
    found = kind_of_file(data, name)
    if found in (FileKind.IMAGE, FileKind.PDF):
        return
    with pytest.raises(DrawingError) as caught:
        load_drawing(data, name=name or "file")
    assert found.about in str(caught.value)
    assert found.advice in str(caught.value)


def test_robot_map_is_taken_as_a_drawing_only_where_that_is_asked_for():
    with pytest.raises(DrawingError, match="robot's map in ROS format, not a drawing"):
        load_drawing(ROS_MAP, name="depot.pgm")
    drawing = load_drawing(ROS_MAP, allow_robot_map=True)
    assert drawing.gray[0, :4].tolist() == LEVELS.tolist()


def test_image_with_a_maps_yaml_beside_it_is_a_map(tmp_path):
    path = tmp_path / "depot.pgm"
    path.write_bytes(encoded(PICTURE, "PNG"))
    assert load_drawing(path).shape == (20, 30)
    (tmp_path / "depot.yaml").write_bytes(b"scale: 3\n")
    assert load_drawing(path).shape == (20, 30)
    (tmp_path / "depot.yaml").write_bytes(YAML)
    with pytest.raises(DrawingError, match="robot's map"):
        load_drawing(path)
    assert load_drawing(path, allow_robot_map=True).shape == (20, 30)


def read(path):
    return read_source(
        path, what="file", needed="a file", max_bytes=100, error=DrawingError
    )


def test_only_regular_files_are_read(tmp_path):
    """A device has no end, and a pipe may wait for ever."""
    pipe = tmp_path / "pipe"
    if hasattr(os, "mkfifo"):
        os.mkfifo(pipe)
    for path in ("/dev/zero", pipe, tmp_path, tmp_path / "none", "a\0b", ""):
        with pytest.raises(DrawingError, match="cannot be opened"):
            read(path)
        with pytest.raises(DrawingError, match="cannot be opened"):
            load_drawing(path)


def test_name_is_one_line_of_text_that_can_be_encoded(tmp_path):
    assert printable("plan\n\ud800.png") == "plan\ufffd\ufffd.png"
    assert len(printable("x" * 500)) == 100
    with pytest.raises(DrawingError) as caught:
        load_drawing(b"hello", name="a\nb\ud800\x1b[2J")
    str(caught.value).encode()
    assert "\n" not in str(caught.value)


def test_no_message_is_long():
    with pytest.raises(DrawingError) as caught:
        load_drawing(Image.new("L", (9, 9)).tobytes(), name="x" * 10_000)
    assert len(str(caught.value)) < 300

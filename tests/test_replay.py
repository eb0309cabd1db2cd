"""The bytes that the player is sent hold the run exactly, and in the stated layout."""

import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import EvidenceLog, Grid, ParameterError, Sensor, Trajectory, World
from occsim.imaging import Drawing
from occsim.io.preview import PREVIEW_MAX_PX, encode_preview
from occsim.io.replay import (
    pack_log,
    pack_scene,
    pack_walls,
    unpack_log,
    unpack_scene,
    unpack_walls,
)


def blank(height: int, width: int) -> Drawing:
    return Drawing(rgb=np.full((height, width, 3), 255, np.uint8))


def log_of(grid: Grid, readings: list[dict[int, float]]) -> EvidenceLog:
    """A log whose readings are given as cell -> log-odds."""
    sizes = [len(reading) for reading in readings]
    return EvidenceLog(
        grid=grid,
        indptr=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        cell=np.array([c for r in readings for c in r], np.int32),
        log_odds=np.array([v for r in readings for v in r.values()], np.float64),
    )


def pack(log: EvidenceLog, truth=None, n_poses=None) -> bytes:
    return pack_log(
        log,
        truth=np.zeros(log.grid.shape, np.bool_) if truth is None else truth,
        trajectory=Trajectory(poses=np.zeros((n_poses or log.n_readings, 3))),
    )


def scene(poses, occupied, drawing=None) -> bytes:
    return pack_scene(
        World(occupied=occupied),
        trajectory=Trajectory(poses=poses),
        sensor=Sensor(range_px=12.5, fov_rad=0.75),
        drawing=drawing or blank(*occupied.shape),
    )


@st.composite
def runs(draw):
    grid = Grid(
        height_px=draw(st.integers(1, 30)),
        width_px=draw(st.integers(1, 30)),
        cell_px=draw(st.integers(1, 7)),
    )
    cells = st.integers(0, grid.n_cells - 1)
    values = st.floats(-3, 3, allow_nan=False)
    readings = draw(
        st.lists(st.dictionaries(cells, values, max_size=12), min_size=1, max_size=8)
    )
    flags = st.lists(st.booleans(), min_size=grid.n_cells, max_size=grid.n_cells)
    classes = [np.array(draw(flags)).reshape(grid.shape) for _ in range(2)]
    return log_of(grid, readings), *classes


@given(runs())
def test_unpacking_gives_back_what_was_packed(run):
    """Entries may come in any order within a reading; the replay has them by cell."""
    log, is_wall, truth = run
    evidence, judged_by = unpack_log(pack(log, truth))
    order = np.lexsort((log.cell, log.reading))
    assert evidence.grid == log.grid
    np.testing.assert_array_equal(evidence.indptr, log.indptr)
    np.testing.assert_array_equal(evidence.cell, log.cell[order])
    np.testing.assert_array_equal(evidence.log_odds, log.log_odds[order])
    np.testing.assert_array_equal(judged_by, truth)
    walls, unknown = unpack_walls(pack_walls(is_wall))
    np.testing.assert_array_equal(walls, is_wall)
    assert unknown is None
    walls, unknown = unpack_walls(pack_walls(is_wall, truth))  # any flags will do
    np.testing.assert_array_equal(walls, is_wall)
    np.testing.assert_array_equal(unknown, truth)


@given(st.integers(1, 9), st.integers(1, 30), st.integers(1, 30), st.randoms())
def test_a_scene_holds_poses_sensor_world_and_drawing(n_poses, height, width, random):
    poses = np.arange(3.0 * n_poses).reshape(-1, 3) / 8
    flags = [random.random() < 0.3 for _ in range(height * width)]
    occupied = np.array(flags).reshape(height, width)
    found = unpack_scene(scene(poses, occupied))
    np.testing.assert_array_equal(found.poses, poses.astype(np.float32))
    np.testing.assert_array_equal(found.occupied, occupied)
    assert (found.range_px, found.fov_rad) == (12.5, 0.75)
    assert found.preview == encode_preview(blank(height, width))


def test_bytes_of_a_log_follow_the_documented_layout():
    """A 2 x 3 grid worked by hand.

    Reading 1 updates cells 1, 2 (a run that skips 1) and 5 (a run that skips cells 3
    and 4); reading 2 updates cell 0. The two log-odds -1 and 2 become indices 0 and 1.
    Truth bits 000010 fill the high end of one byte: 0x08.
    """
    grid = Grid(height_px=4, width_px=6, cell_px=2)
    log = log_of(grid, [{1: 2.0, 2: -1.0, 5: 2.0}, {0: -1.0}])
    truth = np.array([[0, 0, 0], [0, 1, 0]], np.bool_)
    expected = (
        struct.pack("<4s3I", b"OGL2", 4, 6, 2)
        + struct.pack("<4I", 2, 4, 3, 2)
        + struct.pack("<2I", 1, 0)
        + struct.pack("<2d", -1.0, 2.0)
        + struct.pack("<2I", 2, 1)
        + struct.pack("<3I", 1, 2, 0)
        + struct.pack("<3I", 2, 1, 1)
        + bytes([1, 0, 1, 0])
        + bytes([0x08])
    )
    assert zlib.decompress(pack(log, truth)) == expected


def test_bytes_of_scene_and_walls_follow_the_documented_layout():
    """2 x 3 px and cells; bits 100001 fill the high end of one byte: 0x84."""
    flags = np.array([[1, 0, 0], [0, 0, 1]], np.bool_)
    poses = np.array([[1, 2, 0.5], [3, 4, 0.25]])
    preview = encode_preview(blank(2, 3))
    expected = (
        struct.pack("<4s5I", b"OGS2", 2, 3, 2, len(preview), 0)
        + struct.pack("<2d", 12.5, 0.75)
        + struct.pack("<6f", 1, 2, 0.5, 3, 4, 0.25)
        + bytes([0x84])
        + preview
    )
    assert zlib.decompress(scene(poses, flags)) == expected
    walls = struct.pack("<4s2I", b"OGW2", 2, 3) + bytes([0x84])
    assert zlib.decompress(pack_walls(flags)) == walls


@pytest.mark.parametrize(("n_values", "width"), [(256, 1), (257, 2), (65537, 4)])
def test_value_indices_are_as_wide_as_the_values_need(n_values, width):
    grid = Grid(height_px=300, width_px=300, cell_px=1)
    readings = [dict(enumerate(np.linspace(-2, 2, n_values).tolist()))]
    log = log_of(grid, readings)
    packed = pack(log)
    assert struct.unpack_from("<I", zlib.decompress(packed), 32) == (width,)
    np.testing.assert_array_equal(unpack_log(packed)[0].log_odds, log.log_odds)


def test_a_run_that_saw_nothing_is_a_replay_too():
    log = log_of(Grid(height_px=3, width_px=3, cell_px=3), [{}, {}])
    evidence, _ = unpack_log(pack(log))
    np.testing.assert_array_equal(evidence.indptr, [0, 0, 0])
    assert evidence.cell.size == 0


def decoded(preview: bytes):
    return cv2.imdecode(np.frombuffer(preview, np.uint8), cv2.IMREAD_UNCHANGED)


def test_preview_of_a_grey_drawing_has_one_channel_and_sixteen_levels():
    ramp = np.tile(np.arange(256, dtype=np.uint8)[None, :, None], (20, 1, 3))
    picture = decoded(encode_preview(Drawing(rgb=ramp)))
    assert picture.shape == (20, 256)
    np.testing.assert_array_equal(np.unique(picture), np.arange(0, 256, 17))
    assert np.abs(picture.astype(int) - ramp[:, :, 0]).max() <= 8


def test_preview_keeps_colour_with_red_first_in_the_drawing():
    red = np.zeros((9, 9, 3), np.uint8)
    red[:, :, 0] = 255
    picture = decoded(encode_preview(Drawing(rgb=red)))
    np.testing.assert_array_equal(picture[4, 4], [0, 0, 255])  # OpenCV: blue first


def test_preview_is_shrunk_with_its_aspect_kept():
    picture = decoded(encode_preview(blank(1000, 3000)))
    assert picture.shape == (400, PREVIEW_MAX_PX)


def test_preview_of_a_noisy_scan_is_a_jpeg_smaller_than_its_png():
    noise = np.random.default_rng(5).normal(200, 30, (800, 1000, 1))
    rgb = np.repeat(np.clip(noise, 0, 255).astype(np.uint8), 3, axis=2)
    assert encode_preview(Drawing(rgb=rgb))[:3] == b"\xff\xd8\xff"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"truth": np.zeros((1, 1), np.bool_)}, "truth must have the grid's shape"),
        ({"n_poses": 3}, "one pose for each of the 2 readings; got 3"),
    ],
)
def test_sizes_that_do_not_fit_are_refused(changes, message):
    log = log_of(Grid(height_px=4, width_px=6, cell_px=2), [{0: 1.0}, {1: 1.0}])
    with pytest.raises(ParameterError, match=message):
        pack(log, **changes)


def test_a_drawing_of_another_size_than_the_world_is_refused():
    world = np.zeros((4, 6), np.bool_)
    with pytest.raises(ParameterError, match=r"the world, \(4, 6\) px; got \(5, 5\)"):
        scene(np.zeros((1, 3)), world, blank(5, 5))


def test_a_run_too_long_for_a_browser_is_refused(monkeypatch):
    monkeypatch.setattr("occsim.io.replay.MAX_ENTRIES", 2)
    log = log_of(Grid(height_px=4, width_px=6, cell_px=2), [{0: 1.0, 1: 1.0, 2: 1.0}])
    with pytest.raises(ParameterError, match="at most 2 cell updates; this run has 3"):
        pack(log)


PARTS = {
    "OGL2": (pack(log_of(Grid(height_px=4, width_px=6, cell_px=2), [{0: 1.0}])), 58),
    "OGS2": (scene(np.zeros((2, 3)), np.zeros((4, 6), np.bool_)), 60),
    "OGW2": (pack_walls(np.zeros((4, 6), np.bool_)), 14),
}
UNPACK = {"OGL2": unpack_log, "OGS2": unpack_scene, "OGW2": unpack_walls}


@pytest.mark.parametrize("kind", PARTS)
def test_bytes_that_are_no_part_of_a_replay_are_refused(kind):
    packed, shorter = PARTS[kind]
    content = zlib.decompress(packed)
    assert len(content) > shorter
    UNPACK[kind](packed)
    for bad in (
        b"",
        b"no zlib stream",
        zlib.compress(content[:10]),
        zlib.compress(content[:shorter]),
        zlib.compress(b"OGR9" + content[4:]),
        *(other for name, (other, _) in PARTS.items() if name != kind),
    ):
        with pytest.raises(ParameterError, match=rf"version 2 \({kind}\), whole"):
            UNPACK[kind](bad)

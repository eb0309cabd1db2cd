"""Project files: a round trip loses nothing, and hostile files are refused."""

import io
import json
import struct
import zipfile
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    Building,
    Corrections,
    Drawing,
    Registration,
    Sensor,
    Trajectory,
    load_drawing,
)
from occsim.io.images import class_png, mask_png, png
from occsim.io.project import (
    MAX_LOG_BYTES,
    Project,
    ProjectError,
    RobotData,
    dump_project,
    load_project,
)
from occsim.io.project.archive import (
    CORRECTIONS,
    DRAWING,
    FOUND,
    JSON_NAME,
    LOG,
    OLD_TRUTH,
    TRACED,
    TRAJECTORY_NAME,
    TRUTH,
    UNKNOWN,
    WALLS,
)
from occsim.io.project.robot import FIELDS
from occsim.walls import WallParams

SHAPE = (20, 30)


def frame():
    mask = np.zeros(SHAPE, dtype=bool)
    mask[[0, -1], :] = mask[:, [0, -1]] = True
    return mask


def corrections():
    added, erased = np.zeros((2, *SHAPE), dtype=bool)
    added[3:6, 3:10] = erased[:, 11:13] = True
    return Corrections.from_masks(added, erased)


def building(**changes):
    """A small room in colour, corrected by hand, with a ground truth of its own."""
    rgb = np.random.default_rng(3).integers(0, 256, (*SHAPE, 3), dtype=np.uint8)
    parts = {
        "drawing": Drawing(rgb=rgb, name="room.png"),
        "found": frame(),
        "corrections": corrections(),
        "truth": frame() & ~np.eye(*SHAPE, dtype=bool),
        "trajectory": Trajectory(poses=[[10.1, 5.2, 0.3], [-2.0, 1 / 3, -4.0]]),
        "wall_params": WallParams(ink_level=0.25, straighten=False),
        "sensor": Sensor(range_px=7.5, fov_rad=1 / 3, behind_hit=BehindHit.UNSEEN),
        "sketch": ((1.0, 2.5, True), (20.0, 10.0, False)),
        "door_px": 7.5,
        "metres_per_px": 0.12,
        "name": "room 7",
        "title": "Grüße · 家 · 🏠",
        "about": "A room.",
    }
    return Building(**{**parts, **changes})


def assert_same(opened, saved):
    assert opened.digest == saved.digest
    assert opened.drawing.name == saved.drawing.name
    np.testing.assert_array_equal(opened.walls_found, saved.walls_found)
    np.testing.assert_array_equal(opened.truth, saved.truth)
    np.testing.assert_array_equal(opened.trajectory.poses, saved.trajectory.poses)
    names = ("corrections", "wall_params", "sensor", "sketch", "door_px")
    for name in (*names, "metres_per_px", "name", "title", "about"):
        assert getattr(opened, name) == getattr(saved, name)


def test_a_project_opens_as_it_was_saved():
    saved = building()
    content = dump_project(Project(building=saved, settings={"cell_px": "5"}))
    opened = load_project(content)
    assert_same(opened.building, saved)
    assert opened.building.tour is None
    assert opened.settings == {"cell_px": "5"}


def test_a_project_without_truth_or_scale_opens_as_it_was_saved():
    saved = building(truth=None, door_px=None, metres_per_px=None, sketch=())
    assert_same(load_project(dump_project(Project(building=saved))).building, saved)


def test_a_planned_tour_is_still_one_after_opening():
    saved = replace(building(), tour=building().trajectory)
    assert load_project(dump_project(Project(building=saved))).building.tour is None
    saved = replace(saved, tour=saved.trajectory)
    opened = load_project(dump_project(Project(building=saved))).building
    assert opened.tour is opened.trajectory


def test_the_same_project_gives_the_same_bytes():
    content = dump_project(Project(building=building()))
    assert content == dump_project(Project(building=building()))
    # No time of saving is in it: two saved at other times are equal as well.
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        dates = {entry.date_time for entry in archive.infolist()}
    assert dates == {(1980, 1, 1, 0, 0, 0)}


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 2, st.floats(-100, 100)), min_size=1),
    st.lists(st.tuples(*[st.floats(-1e5, 1e5)] * 2, st.booleans()), max_size=5),
)
def test_any_poses_and_sketch_survive(poses, corners):
    saved = building(trajectory=Trajectory(poses=poses), sketch=tuple(corners))
    assert_same(load_project(dump_project(Project(building=saved))).building, saved)


def test_texts_that_could_not_be_read_back_are_not_written():
    saved = building(title="a \ud83d half", about="x" * 3000)
    texts = {"p\udc00": "q"}
    opened = load_project(dump_project(Project(building=saved, settings=texts)))
    assert opened.building.title == "a ? half"
    assert opened.building.about == "x" * 2000
    assert opened.settings == {"p?": "q"}


def test_images_are_what_a_person_expects():
    content = dump_project(Project(building=building()))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        images = {
            name: load_drawing(archive.read(name)).gray
            for name in archive.namelist()
            if name.endswith(".png")
        }
        others = set(archive.namelist()) - set(images)
    assert others == {"project.json", "trajectory.csv"}
    assert set(images) == {DRAWING, FOUND, CORRECTIONS, WALLS, TRUTH}
    # Row 4: a wall at the rim, added from column 3 on, erased from column 11 on.
    assert images[WALLS][4, [0, 2, 3, 9, 10, 11]].tolist() == [0, 255, 0, 0, 255, 255]
    assert images[CORRECTIONS][4, [0, 3, 10, 11, 13]].tolist() == [
        *(128, 255, 128),
        *(0, 128),
    ]


def test_corrections_painted_in_another_program_are_read_by_the_nearest_level():
    levels = np.full(SHAPE, 130, np.uint8)
    levels[2, 2:5] = (250, 200, 190)
    levels[3, 2:5] = (5, 60, 70)
    opened = load_project(archive_with({CORRECTIONS: png(levels)})).building
    assert np.argwhere(opened.corrections.planes).tolist() == [
        *([0, 2, 2], [0, 2, 3]),
        *([1, 3, 2], [1, 3, 3]),
    ]


def version_1(*, drop=(), **changes):
    """A file as the first release wrote it: vector strokes, and two images a mask."""
    old = {
        "version": 1,
        "wall_strokes": [["brush", 12, 12, 16, 26, 1]],
        "truth_strokes": [],
    }
    left_out = {"sensor", "is_planned", "short_name"}
    values = {k: v for k, v in stored_json().items() if k not in left_out}
    images = {OLD_TRUTH: mask_png(frame()), JSON_NAME: json.dumps(values | old)}
    return archive_with(images | changes, drop=(CORRECTIONS, *drop))


def test_a_file_of_the_first_release_opens():
    opened = load_project(version_1()).building
    saved = building()
    assert opened.digest == saved.digest
    np.testing.assert_array_equal(opened.walls_found, saved.walls_found)
    np.testing.assert_array_equal(opened.truth, saved.truth)
    # Of the strokes, only the changed pixels are kept.
    expected = Corrections.between(frame(), saved.wall_mask)
    assert opened.corrections == expected
    assert opened.sensor == Sensor(range_px=7.5)
    assert opened.name == "room.png"
    with pytest.raises(ProjectError, match=r"walls.png is missing"):
        load_project(version_1(drop=[WALLS]))


def test_classes_are_painted_in_their_colours():
    classes = np.array([[0, 1] * 4] * 8, dtype=np.uint8)
    rgb = load_drawing(class_png(classes, ["#ffffff", "#0072B2"])).rgb
    assert rgb[0, 0].tolist() == [255, 255, 255]
    assert rgb[0, 1].tolist() == [0, 0x72, 0xB2]


# --- Hostile files --------------------------------------------------------------------

SAVED = dump_project(Project(building=building()))


def stored_json():
    with zipfile.ZipFile(io.BytesIO(SAVED)) as source:
        return json.loads(source.read(JSON_NAME))


def archive_with(changes=None, *, drop=(), compression=zipfile.ZIP_DEFLATED):
    """The archive of `building`, some of its files replaced or left out."""
    with zipfile.ZipFile(io.BytesIO(SAVED)) as source:
        files = {name: source.read(name) for name in source.namelist()}
    files |= changes or {}
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", compression) as archive:
        for name, data in files.items():
            if name not in drop:
                archive.writestr(name, data)
    return out.getvalue()


def json_with(**changes):
    """The JSON of `building` with some values replaced."""
    return {JSON_NAME: json.dumps(stored_json() | changes).encode()}


def nested(key, depth):
    """The JSON of `building`, one value lists within lists."""
    text = json.dumps(stored_json() | {key: "here"})
    return {JSON_NAME: text.replace('"here"', "[" * depth + "]" * depth).encode()}


def directory(data, name):
    """Where the entry of a file begins in the table of contents."""
    return data.rindex(b"PK\x01\x02", 0, data.rindex(name.encode()))


def with_declared_size(data, name, size):
    """The archive with a wrong size of a file in its table of contents."""
    at = directory(data, name)
    return data[: at + 24] + struct.pack("<I", size) + data[at + 28 :]


def with_offset(data, name, offset):
    """The archive with a wrong offset of a file in its table of contents."""
    at = directory(data, name)
    return data[: at + 42] + struct.pack("<I", offset) + data[at + 46 :]


def with_name(data, name, raw):
    """The archive, a name replaced by other bytes that are said to be UTF-8."""
    out = data.replace(name.encode(), raw)
    at = out.rindex(b"PK\x01\x02", 0, out.rindex(raw))
    return out[: at + 8] + struct.pack("<H", 0x800) + out[at + 10 :]


def lie_about_directory(data):
    """The archive, the table of contents said to begin far beyond its end."""
    at = data.rindex(b"PK\x05\x06")
    return data[: at + 16] + struct.pack("<I", 2**32 - 2) + data[at + 20 :]


def damaged(compression):
    """The archive packed another way, a byte in each file's content changed."""
    data = bytearray(archive_with(compression=compression))
    for at in range(60, len(data) - 1000, 97):
        data[at] ^= 0x55
    return bytes(data)


WIDE = png(np.zeros((8, 40_000), np.uint8))
HUGE_IMAGES = {name: b"\x89PNG" * 8_000_000 for name in (DRAWING, FOUND, WALLS, TRUTH)}
HOSTILE = {
    "empty": (b"", "is empty"),
    "words": (b"no zip at all", "not an undamaged zip archive"),
    "cut short": (archive_with()[:-200], "not an undamaged zip archive"),
    "a path": (archive_with({"../evil.png": b""}), "holds only .* got '../evil.png'"),
    "an absolute path": (archive_with({"/etc/passwd": b""}), "holds only"),
    "a stranger": (archive_with({"virus.exe": b""}), "holds only"),
    "many entries": (b"PK\x01\x02" * 100_000, "few files; got 100000"),
    "no drawing": (archive_with(drop=[DRAWING]), "drawing.png is missing"),
    "no json": (archive_with(drop=[JSON_NAME]), "project.json is missing"),
    "no walls": (archive_with(drop=[FOUND]), "walls_found.png is missing"),
    "no corrections": (archive_with(drop=[CORRECTIONS]), "corrections.png is missing"),
    "no poses": (archive_with(drop=[TRAJECTORY_NAME]), "trajectory.csv is missing"),
    "a bomb": (
        archive_with({JSON_NAME: b" " * 9_000_000}),
        "project.json may unpack to at most 4 MB; got 9 MB",
    ),
    "a bomb of many": (
        archive_with(HUGE_IMAGES),
        "may unpack to at most 100 MB together; got 128 MB",
    ),
    "a bomb that lies": (
        with_declared_size(archive_with({JSON_NAME: b" " * 9_000_000}), JSON_NAME, 9),
        "cannot be opened",
    ),
    "a size that lies": (
        with_declared_size(archive_with(), WALLS, 9),
        "cannot be opened",
    ),
    "an offset that lies": (with_offset(archive_with(), WALLS, 10**9), "undamaged"),
    "a directory that lies": (lie_about_directory(archive_with()), "undamaged"),
    "a name that is no text": (
        with_name(archive_with(), "walls.png", b"w\xff\xfels.png"),
        "undamaged",
    ),
    "bzip2": (archive_with(compression=zipfile.ZIP_BZIP2), "stored or deflated"),
    "lzma": (archive_with(compression=zipfile.ZIP_LZMA), "stored or deflated"),
    "damaged deflate": (damaged(zipfile.ZIP_DEFLATED), "cannot be opened"),
    "damaged bzip2": (damaged(zipfile.ZIP_BZIP2), "cannot be opened"),
    "damaged lzma": (damaged(zipfile.ZIP_LZMA), "cannot be opened"),
    "a wide image": (
        archive_with(dict.fromkeys((DRAWING, FOUND, CORRECTIONS, WALLS, TRUTH), WIDE)),
        "each side of walls_found.png must lie between",
    ),
    "no png": (archive_with({DRAWING: b"GIF89a"}), "must be a PNG image"),
    "a damaged image": (
        archive_with({DRAWING: png(np.zeros(SHAPE, np.uint8))[:60]}),
        "damaged",
    ),
    "another size": (
        archive_with({FOUND: mask_png(np.zeros((9, 9), bool))}),
        "walls_found.png must have the drawing's size, 30 x 20 px; got 9 x 9 px",
    ),
    "other corrections": (
        archive_with({CORRECTIONS: mask_png(np.zeros((20, 9), bool))}),
        "corrections.png must have the drawing's size",
    ),
    "another truth": (
        archive_with({TRUTH: mask_png(np.zeros((9, 9), bool))}),
        "truth.png must have the drawing's size",
    ),
    "no numbers": (archive_with({TRAJECTORY_NAME: b"x,y,theta\na,b,c\n"}), "trajector"),
    "no object": (archive_with({JSON_NAME: b"[1]"}), "must hold an object"),
    "no text": (archive_with({JSON_NAME: b"\xff\xfe\x00"}), "must be JSON"),
    "deep": (archive_with({JSON_NAME: b"[" * 200_000}), "must be JSON"),
    "another format": (archive_with(json_with(format="x")), "its format must be"),
    "the future": (
        archive_with(json_with(version=3)),
        "its version must be 1 or 2.*got 3",
    ),
    "a true version": (
        archive_with(json_with(version=True)),
        "its version must be 1 or 2",
    ),
    "a title that is none": (archive_with(json_with(title=5)), "title must be text"),
    "a long title": (archive_with(json_with(title="x" * 5000)), "title must be text"),
    "half a character": (archive_with(json_with(title="\ud83d")), "title must be text"),
    "half a name": (archive_with(json_with(name="\udc00.png")), "name must be text"),
    "half a key": (
        archive_with(json_with(settings={"\ud83d": "5"})),
        "settings must be",
    ),
    "half a setting": (
        archive_with(json_with(settings={"a": "\ud83d"})),
        "settings must",
    ),
    "a wrong door": (archive_with(json_with(door_px=-1)), r"door_px must lie in \(0"),
    "a door of words": (archive_with(json_with(door_px="9")), "door_px must lie in"),
    "no scale": (
        archive_with(json_with(metres_per_px=float("nan"))),
        "metres_per_px must",
    ),
    "a huge scale": (
        archive_with(json_with(metres_per_px=10**400)),
        "metres_per_px must",
    ),
    "no sketch": (archive_with(json_with(sketch=None)), "sketch must be"),
    "a far corner": (
        archive_with(json_with(sketch=[[1e9, 0, True]])),
        "sketch must be",
    ),
    "three numbers": (archive_with(json_with(sketch=[[1, 2, 3]])), "sketch must be"),
    "two numbers": (archive_with(json_with(sketch=[[1, 2]])), "sketch must be"),
    "strange walls": (
        archive_with(json_with(wall_params={"evil": 1})),
        "wall_params must",
    ),
    "wall words": (
        archive_with(json_with(wall_params={"ink_level": "much"})),
        "ink_level in wall_params must be a number; got 'much'",
    ),
    "a wall number": (
        archive_with(json_with(wall_params={"straighten": 1})),
        "straighten in wall_params must be true or false",
    ),
    "walls out of bounds": (
        archive_with(json_with(wall_params={"ink_level": 7})),
        r"ink_level must lie in \[0, 0\.95\]",
    ),
    "a blind sensor": (
        archive_with(json_with(sensor={"range_px": 0})),
        "range_px must be",
    ),
    "a strange sensor": (
        archive_with(json_with(sensor={"behind_hit": ["unseen"]})),
        "behind_hit in sensor must be one of occupied, unseen; got",
    ),
    "settings that are none": (
        archive_with(json_with(settings=[])),
        "settings must be",
    ),
    "numbers for texts": (
        archive_with(json_with(settings={"a": 1})),
        "settings must be",
    ),
    "another unknown": (
        archive_with({UNKNOWN: mask_png(np.zeros((9, 9), bool))}),
        "unknown.png must have the drawing's size",
    ),
    "a robot of words": (
        archive_with(json_with(robot="no")),
        "robot must be an object",
    ),
    "a long name of a log": (
        archive_with(json_with(robot={"log_name": "x" * 5000})),
        "log_name must be short text",
    ),
    "half a registration": (
        archive_with(json_with(robot={"registration": {"scale": 1}})),
        "registration must hold the numbers",
    ),
    "a registration of words": (
        archive_with(json_with(robot={"registration": dict.fromkeys(FIELDS, "1")})),
        "registration must hold the numbers",
    ),
    "a registration out of bounds": (
        archive_with(json_with(robot={"registration": dict.fromkeys(FIELDS, 1e9)})),
        "scale must lie in",
    ),
    "three points": (
        archive_with(json_with(robot={"map_points": [[1, 2]] * 3})),
        "map_points must be at most 2 points",
    ),
    "a point far off": (
        archive_with(json_with(robot={"drawing_points": [[1, -2]]})),
        "drawing_points must be at most 2 points",
    ),
    "an origin of two": (
        archive_with(json_with(robot={"origin": [1, 2]})),
        "origin must be x_m, y_m, yaw_rad",
    ),
    "a log too large": (
        archive_with({LOG: b" " * 21_000_000}),
        "log may unpack to at most 20 MB; got 21 MB",
    ),
    "traced walls that are none": (
        archive_with({TRACED: b"GIF89a"}),
        "traced.png must be a PNG image",
    ),
    "huge traced walls": (
        archive_with({TRACED: mask_png(np.zeros((4001, 4000), bool))}),
        "traced.png has 4,000 x 4,001 px; a map may have 1 to 16,000,000 px",
    ),
}


def test_a_robots_data_opens_as_it_was_saved():
    traced = np.zeros((33, 44), dtype=bool)
    traced[3:9, 5] = True
    robot = RobotData(
        log=b"FLASER 1 2\n",
        log_name="drive.log",
        log_poses=b"0 0 0 0 0 0 0 1",
        map_id="map 1",
        registration=Registration(scale=0.4, rotation_rad=-1 / 3, shift_x_px=20.25),
        drawing_points=((1.0, 2.5), (1 / 3, 7.0)),
        map_points=((3.0, 4.0),),
        traced=traced,
        origin=(-1.5, 2.0, 0.1),
    )
    content = dump_project(Project(building=building(), robot=robot))
    opened = load_project(content).robot
    for one in fields(RobotData):
        if one.name != "traced":
            assert getattr(opened, one.name) == getattr(robot, one.name), one.name
    np.testing.assert_array_equal(opened.traced, traced)
    nothing = load_project(dump_project(Project(building=building()))).robot
    assert all(not getattr(nothing, one.name) for one in fields(RobotData))


@pytest.mark.parametrize(
    "data",
    [
        # Eastings and northings of UTM, as outdoor maps have them.
        {"origin": (4.5e5, 5.2e6, 0.1)},
        {"log": b"1", "log_poses": bytes(MAX_LOG_BYTES - 1)},
        {"traced": np.eye(3, 7, dtype=bool)},
        {"traced": np.ones((9, 600), dtype=bool)},
    ],
    ids=["a far origin", "a long trajectory", "a small map", "a corridor's map"],
)
def test_whatever_a_robots_data_holds_opens_again(data):
    robot = RobotData(**data)
    opened = load_project(dump_project(Project(building=building(), robot=robot))).robot
    for name, value in data.items():
        np.testing.assert_array_equal(getattr(opened, name), value)


def test_a_name_that_no_file_may_have_is_written_as_one_that_can_be_read():
    robot = RobotData(log=b"1", log_name="\ud800" + "x" * 5000)
    opened = load_project(dump_project(Project(building=building(), robot=robot))).robot
    assert opened.log_name == "?" + "x" * 1999


def test_a_log_that_could_not_be_read_back_is_not_written():
    large = RobotData(log=bytes(MAX_LOG_BYTES + 1))
    with pytest.raises(ProjectError, match="log of a project may hold 20 MB"):
        dump_project(Project(building=building(), robot=large))


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_hostile_file_is_refused_in_one_sentence(kind):
    content, reason = HOSTILE[kind]
    with pytest.raises(ProjectError, match=reason) as refused:
        load_project(content, name="mine.zip")
    assert "mine.zip" in str(refused.value)
    message = str(refused.value)
    assert "\n" not in message
    message.encode()  # the message can be shown, whatever the file holds


@pytest.mark.parametrize("key", ["format", "version", "title", "door_px", "settings"])
def test_lists_in_lists_are_refused_however_deep(key):
    # Around the depth at which json, and the code for the message, fail.
    for depth in range(900, 1001, 2):
        with pytest.raises(ProjectError, match="cannot be opened"):
            load_project(archive_with(nested(key, depth)))


def test_a_file_may_be_in_it_once():
    out = io.BytesIO(archive_with())
    with zipfile.ZipFile(out, "a") as archive, pytest.warns(UserWarning, match="Dupl"):
        archive.writestr(JSON_NAME, b"{}")
    with pytest.raises(ProjectError, match="each file may be in it once"):
        load_project(out.getvalue())


def test_an_encrypted_file_is_refused():
    data = bytearray(archive_with())
    data[data.rindex(b"PK\x01\x02") + 8] |= 1
    with pytest.raises(ProjectError, match="encrypted"):
        load_project(bytes(data))


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_a_damaged_byte_is_refused_or_changes_a_value_within_its_bounds(data):
    content = bytearray(SAVED)
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    try:
        opened = load_project(bytes(content))
    except ProjectError:
        return
    assert opened.building.drawing.shape == SHAPE


def test_a_project_with_wall_parameters_of_release_0_1_opens():
    """It named parameters that the detection no longer has; they are left out."""
    old = {"ink_level": 0.3, "fill_level": 0.2, "max_symbol_px": 9.0}
    old |= {"max_wall_px": 40.0, "min_slenderness": 3.0}
    project = load_project(archive_with(json_with(wall_params=old)))
    assert project.building.wall_params == WallParams(ink_level=0.3)

"""Project files: a round trip loses nothing, and nothing hostile gets in."""

import io
import json
import struct
import zipfile

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import Drawing, OccsimError, Trajectory, load_drawing
from occsim.building import Building, CorrectedMask
from occsim.io.images import class_png, mask_png, png
from occsim.io.project import (
    DRAWING_NAME,
    JSON_NAME,
    TRAJECTORY_NAME,
    TRUTH_BASE,
    WALLS_BASE,
    Project,
    ProjectError,
    dump_project,
    load_project,
)
from occsim.strokes import MAX_POINTS, Stroke, StrokeKind, apply_strokes
from occsim.walls import WallParams

SHAPE = (20, 30)
BRUSH = Stroke(kind=StrokeKind.BRUSH, points=((3.0, 4.0), (9.5, 4.25)), width_px=3)
ERASER = Stroke(kind=StrokeKind.ERASER, points=((12.0, 0.0), (12.0, 20.0)), width_px=2)


def frame():
    mask = np.zeros(SHAPE, dtype=bool)
    mask[[0, -1], :] = mask[:, [0, -1]] = True
    return mask


def building(**changes):
    """A small room in colour, corrected by hand, with a ground truth of its own."""
    rgb = np.random.default_rng(3).integers(0, 256, (*SHAPE, 3), dtype=np.uint8)
    parts = {
        "drawing": Drawing(rgb=rgb, name="room.png"),
        "walls": CorrectedMask(frame(), (BRUSH, ERASER)),
        "truth": CorrectedMask(frame(), (ERASER,)),
        "trajectory": Trajectory(poses=[[10.1, 5.2, 0.3], [-2.0, 1 / 3, -4.0]]),
        "wall_params": WallParams(ink_level=0.25, straighten=False),
        "sketch": ((1.0, 2.5, True), (20.0, 10.0, False)),
        "door_px": 7.5,
        "metres_per_px": 0.12,
        "title": "Grüße · 家",
        "about": "A room.",
    }
    return Building(**{**parts, **changes})


def assert_same(opened, saved):
    assert opened.digest == saved.digest
    assert opened.drawing.name == saved.drawing.name
    for layer in ("walls", "truth"):
        a, b = getattr(opened, layer), getattr(saved, layer)
        assert (a is None) == (b is None)
        if a is not None:
            np.testing.assert_array_equal(a.base, b.base)
            np.testing.assert_array_equal(a.mask, b.mask)
            assert a.strokes == b.strokes
    np.testing.assert_array_equal(opened.trajectory.poses, saved.trajectory.poses)
    names = ("wall_params", "sketch", "door_px", "metres_per_px", "title", "about")
    for name in names:
        assert getattr(opened, name) == getattr(saved, name)


def test_a_project_opens_as_it_was_saved():
    saved = building()
    content = dump_project(Project(building=saved, settings={"cell_px": "5"}))
    opened = load_project(content)
    assert_same(opened.building, saved)
    assert opened.settings == {"cell_px": "5"}


def test_a_project_without_truth_or_scale_opens_as_it_was_saved():
    saved = building(truth=None, door_px=None, metres_per_px=None, sketch=())
    assert_same(load_project(dump_project(Project(building=saved))).building, saved)


def test_the_same_project_gives_the_same_bytes():
    assert dump_project(Project(building=building())) == dump_project(
        Project(building=building())
    )


@settings(max_examples=25, deadline=None)
@given(
    st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 2, st.floats(-100, 100)), min_size=1),
    st.lists(st.tuples(*[st.floats(-1e5, 1e5)] * 2, st.booleans()), max_size=5),
)
def test_any_poses_and_sketch_survive(poses, corners):
    saved = building(trajectory=Trajectory(poses=poses), sketch=tuple(corners))
    assert_same(load_project(dump_project(Project(building=saved))).building, saved)


def test_images_are_what_a_person_expects():
    content = dump_project(Project(building=building()))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = set(archive.namelist())
    assert names == {
        *("project.json", "drawing.png", "trajectory.csv"),
        *("walls_found.png", "walls.png", "truth_base.png", "truth.png"),
    }


# --- Corrections ----------------------------------------------------------------------


def test_a_corrected_mask_is_the_same_however_its_strokes_came():
    at_once = CorrectedMask(frame(), (BRUSH, ERASER))
    grown = CorrectedMask(frame(), (BRUSH,)).with_strokes((BRUSH, ERASER))
    undone = at_once.with_strokes((BRUSH,))
    np.testing.assert_array_equal(grown.mask, at_once.mask)
    np.testing.assert_array_equal(undone.mask, apply_strokes(frame(), (BRUSH,)))


def test_too_many_strokes_are_kept_as_pixels():
    # Each has half of the points allowed, so two of the three stay strokes.
    long = Stroke(kind=StrokeKind.BRUSH, points=((5.5, 5.5),) * (MAX_POINTS // 2))
    many = CorrectedMask(np.zeros(SHAPE, bool), (BRUSH, long, long))
    saved = building(walls=many)
    opened = load_project(dump_project(Project(building=saved))).building
    np.testing.assert_array_equal(opened.wall_mask, saved.wall_mask)
    assert opened.walls.strokes == (long, long)


def test_classes_are_painted_in_their_colours():
    classes = np.array([[0, 1] * 4] * 8, dtype=np.uint8)
    rgb = load_drawing(class_png(classes, ["#ffffff", "#0072B2"])).rgb
    assert rgb[0, 0].tolist() == [255, 255, 255]
    assert rgb[0, 1].tolist() == [0, 0x72, 0xB2]


# --- Hostile files --------------------------------------------------------------------

SAVED = dump_project(Project(building=building()))


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


def told(**changes):
    """The JSON of `building` with some values replaced."""
    with zipfile.ZipFile(io.BytesIO(SAVED)) as source:
        values = json.loads(source.read(JSON_NAME))
    return {JSON_NAME: json.dumps(values | changes).encode()}


def with_declared_size(data, name, size):
    """The archive, its table of contents lying about the size of a file."""
    at = data.rindex(b"PK\x01\x02", 0, data.rindex(name.encode()))
    return data[: at + 24] + struct.pack("<I", size) + data[at + 28 :]


WIDE = png(np.zeros((8, 40_000), np.uint8))
HOSTILE = {
    "empty": (b"", "is empty"),
    "words": (b"no zip at all", "not an undamaged zip archive"),
    "cut short": (archive_with()[:-200], "not an undamaged zip archive"),
    "a path": (archive_with({"../evil.png": b""}), "holds only .* got '../evil.png'"),
    "an absolute path": (archive_with({"/etc/passwd": b""}), "holds only"),
    "a stranger": (archive_with({"virus.exe": b""}), "holds only"),
    "no drawing": (archive_with(drop=[DRAWING_NAME]), "drawing.png is missing"),
    "no json": (archive_with(drop=[JSON_NAME]), "project.json is missing"),
    "no walls": (archive_with(drop=[WALLS_BASE]), "walls_found.png is missing"),
    "no poses": (archive_with(drop=[TRAJECTORY_NAME]), "trajectory.csv is missing"),
    "a bomb": (
        archive_with({JSON_NAME: b" " * 9_000_000}),
        "project.json may unpack to at most 8 MB; got 9 MB",
    ),
    "a bomb that lies": (
        with_declared_size(archive_with({JSON_NAME: b" " * 9_000_000}), JSON_NAME, 9),
        "cannot be opened",
    ),
    "a wide image": (archive_with({DRAWING_NAME: WIDE}), "each side of a drawing"),
    "no png": (archive_with({DRAWING_NAME: b"GIF89a"}), "must be a PNG image"),
    "a damaged image": (
        archive_with({DRAWING_NAME: png(np.zeros((40, 40), np.uint8))[:60]}),
        "damaged",
    ),
    "another size": (
        archive_with({WALLS_BASE: mask_png(np.zeros((9, 9), bool))}),
        "the wall mask must have the drawing's size, 30 x 20 px; got 9 x 9 px",
    ),
    "another truth": (
        archive_with({TRUTH_BASE: mask_png(np.zeros((9, 9), bool))}),
        "the ground truth must have the drawing's size",
    ),
    "no numbers": (archive_with({TRAJECTORY_NAME: b"x,y,theta\na,b,c\n"}), "trajector"),
    "no object": (archive_with({JSON_NAME: b"[1]"}), "must hold an object"),
    "no text": (archive_with({JSON_NAME: b"\xff\xfe\x00"}), "must be JSON"),
    "deep": (archive_with({JSON_NAME: b"[" * 200_000}), "must be JSON"),
    "another format": (archive_with(told(format="x")), "its format must be"),
    "the future": (archive_with(told(version=2)), "its version must be 1.*got 2"),
    "a true version": (archive_with(told(version=True)), "its version must be 1"),
    "a title that is none": (archive_with(told(title=5)), "title must be text"),
    "a long title": (archive_with(told(title="x" * 5000)), "title must be text"),
    "a wrong door": (archive_with(told(door_px=-1)), r"door_px must lie in \(0"),
    "a door of words": (archive_with(told(door_px="9")), "door_px must lie in"),
    "no scale": (archive_with(told(metres_per_px=float("nan"))), "metres_per_px must"),
    "a huge scale": (archive_with(told(metres_per_px=10**400)), "metres_per_px must"),
    "no sketch": (archive_with(told(sketch=None)), "sketch must be"),
    "a far corner": (archive_with(told(sketch=[[1e9, 0, True]])), "sketch must be"),
    "three numbers": (archive_with(told(sketch=[[1, 2, 3]])), "sketch must be"),
    "two numbers": (archive_with(told(sketch=[[1, 2]])), "sketch must be"),
    "strange strokes": (
        archive_with(told(wall_strokes=[["x", 4, 0, 0]])),
        "a stroke's kind must be one of",
    ),
    "no strokes": (archive_with(told(wall_strokes=None)), "strokes must be a list"),
    "strange walls": (archive_with(told(wall_params={"evil": 1})), "wall_params must"),
    "wall words": (
        archive_with(told(wall_params={"ink_level": "much"})),
        "ink_level in wall_params must be a number; got 'much'",
    ),
    "a wall number": (
        archive_with(told(wall_params={"straighten": 1})),
        "straighten in wall_params must be true or false",
    ),
    "walls out of bounds": (
        archive_with(told(wall_params={"ink_level": 7})),
        r"ink_level must lie in \[0, 1\)",
    ),
    "settings that are none": (archive_with(told(settings=[])), "settings must be"),
    "numbers for texts": (archive_with(told(settings={"a": 1})), "settings must be"),
    "lzma": (
        archive_with(compression=zipfile.ZIP_LZMA).replace(
            b"\x0e\x00",
            b"\x63\x00",  # a packing that nobody knows
        ),
        "cannot be opened",
    ),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_hostile_file_is_refused_in_one_sentence(kind):
    content, reason = HOSTILE[kind]
    with pytest.raises(OccsimError, match=reason) as refused:
        load_project(content, name="mine.zip")
    assert "mine.zip" in str(refused.value)
    assert "\n" not in str(refused.value)


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
    except OccsimError:
        return
    assert opened.building.drawing.shape == SHAPE

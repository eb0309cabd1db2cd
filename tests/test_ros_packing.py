"""A ROS map as one zip file, or as two files given together."""

import io
import zipfile

import numpy as np
import pytest

from occsim import MappingRun, MapSettings, Prior, RobotFileError, load_sample
from occsim.io.metric import MetricFrame
from occsim.io.ros_map import MapMode, RosMap, dump, load_files, map_names, pack

MAP = RosMap([[100, 0, -1], [37, 20, 66]], 0.05, (1.5, -2.25, 0.5))


def zipped(**files):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return file.getvalue()


def same(one, other):
    np.testing.assert_array_equal(one.values, other.values)
    assert (one.resolution_m, one.origin) == (other.resolution_m, other.origin)


@pytest.mark.parametrize("mode", [MapMode.RAW, MapMode.SCALE])
def test_a_packed_map_is_read_back_bit_by_bit(mode):
    same(load_files({"map.zip": pack(MAP, mode=mode)}), MAP)


def test_yaml_and_image_are_told_apart_by_their_endings_alone():
    yaml, image = dump(MAP, "depot", mode=MapMode.RAW)
    # The browser renamed the second download.
    same(load_files({"depot (1).pgm": image, "depot.yaml": yaml}), MAP)


def test_equal_maps_are_packed_as_equal_bytes():
    assert pack(MAP) == pack(RosMap(MAP.values, MAP.resolution_m, MAP.origin))


def test_companions_of_macos_are_passed_over():
    yaml, image = dump(MAP, mode=MapMode.RAW)
    data = zipped(
        **{
            "a/map.yaml": yaml,
            "a/map.pgm": image,
            "__MACOSX/a/._map.pgm": b"x",
            "a/.hidden.yaml": b"x",
            "readme.txt": b"x",
        }
    )
    same(load_files({"a.zip": data}), MAP)


@pytest.mark.parametrize(
    ("files", "says"),
    [
        ({"map.yaml": b"x"}, "needs one image .*got none"),
        ({"map.pgm": b"x", "b.pgm": b"x"}, "needs one .yaml"),
        ({"map.zip": b"PK\x03\x04 damaged"}, "undamaged zip"),
        (
            {"map.zip": zipped(**{"a.yaml": b"x", "b.yaml": b"x"})},
            "there are 2 maps, a.yaml, b.yaml: one must be chosen",
        ),
        ({"map.zip": zipped(**{"a.yaml": b"0" * 100_000, "a.pgm": b"x"})}, "at most"),
    ],
)
def test_what_is_no_map_is_refused_in_a_sentence(files, says):
    with pytest.raises(RobotFileError, match=says):
        load_files(files)


OTHER = RosMap([[0, 100], [100, 100], [-1, -1]], 0.1, (5.0, 0.0, 0.0))


def two_maps(folders=("", "")):
    """A zip of two maps; each .yaml names its image, and the other one comes first."""
    entries = {}
    for folder, name, one in zip(folders, ("up", "down"), (MAP, OTHER), strict=True):
        same_name = "map" if any(folders) else name
        yaml, image = dump(one, same_name, mode=MapMode.RAW)
        entries |= {
            f"{folder}{same_name}.pgm": image,
            f"{folder}{same_name}.yaml": yaml,
        }
    return {"maps.zip": zipped(**entries)}


@pytest.mark.parametrize("folders", [("", ""), ("up/", "down/")])
def test_of_several_maps_the_chosen_one_is_read_with_its_own_image(folders):
    files = two_maps(folders)
    down, up = map_names(files)
    assert (down[:4], up[:2]) == ("down", "up")
    same(load_files(files, which=up), MAP)
    same(load_files(files, which=down), OTHER)
    with pytest.raises(RobotFileError, match="there are 2 maps, down.*one must be cho"):
        load_files(files)
    with pytest.raises(RobotFileError, match="one must be chosen"):
        load_files(files, which="../up.yaml")


def test_several_maps_may_be_given_as_single_files():
    files = {}
    for name, one in (("up", MAP), ("down", OTHER)):
        yaml, image = dump(one, name, mode=MapMode.RAW)
        files |= {f"{name}.yaml": yaml, f"{name}.pgm": image}
    assert map_names(files) == ("down.yaml", "up.yaml")
    same(load_files(files, which="down.yaml"), OTHER)
    del files["down.pgm"]
    files["other.pgm"] = b"P2 1 1 255 0"
    with pytest.raises(RobotFileError, match="names the image down.pgm; got other.pgm"):
        load_files(files, which="down.yaml")


@pytest.mark.parametrize("name", "abcde")
def test_our_maps_and_priors_are_read_back_as_they_were_written(name):
    sample = load_sample(name)
    run = MappingRun(sample, MapSettings(cell_px=3, sensor=sample.sensor))
    height_px, _ = sample.drawing.shape
    frame = MetricFrame(height_px=height_px, metres_per_px=sample.metres_per_px)
    for made in (
        RosMap.of_map(run.map(Prior.uninformative()), frame),
        RosMap.of_map(run.map(Prior()), frame),
        RosMap.of_prior(run.prior_map(Prior()), frame),
    ):
        same(load_files({"map.zip": pack(made, mode=MapMode.RAW)}), made)

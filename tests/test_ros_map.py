"""ROS maps: read as nav2's map_server reads them, and written so that it can."""

import io
import math
import time

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from occsim import (
    Grid,
    OccupancyMap,
    ParameterError,
    Prior,
    RobotFileError,
    Sensor,
    Trajectory,
    build_prior,
    collect_evidence,
    fuse,
    load_sample,
    simulate_scans,
)
from occsim.imaging.kinds import FileKind, kind_of_file
from occsim.io.metric import MetricFrame, poses_to_image, poses_to_metric
from occsim.io.ros_map import MapMode, RosMap, dump, load, save

ABOUT = {
    "image": "map.pgm",
    "resolution": 0.05,
    "origin": "[-1.0, -2.0, 0.0]",
    "negate": 0,
    "occupied_thresh": 0.65,
    "free_thresh": 0.196,
}


def yaml(**changed):
    values = {k: v for k, v in (ABOUT | changed).items() if v is not None}
    return "".join(f"{key}: {value}\n" for key, value in values.items()).encode()


def pgm(levels, most=255):
    levels = np.atleast_2d(levels)
    header = f"P5\n# made by hand\n{levels.shape[1]} {levels.shape[0]}\n{most}\n"
    kind = np.uint8 if most < 256 else ">u2"
    return header.encode() + levels.astype(kind).tobytes()


def png(pixels):
    file = io.BytesIO()
    Image.fromarray(np.asarray(pixels, np.uint8)).save(file, "PNG")
    return file.getvalue()


def values_of(levels, **changed):
    return load(yaml(**changed), pgm(levels)).values.ravel().tolist()


def nav2_value(rgb, alpha, meta):
    """One pixel, by nav2_map_server's loadMapFromFile, word for word.

    Brightness is the mean of the channels; in mode trinary an image with transparency
    has a fourth. occ is what is left to 1, or with negate the brightness itself.
    """
    channels = list(rgb)
    if meta["mode"] == "trinary" and alpha is not None:
        channels.append(alpha)
    shade = sum(channels) / len(channels) / 255
    occ = shade if meta["negate"] else 1.0 - shade
    if meta["mode"] == "raw":
        level = math.floor(shade * 255 + 0.5)
        return level if level <= 100 else -1
    if meta["mode"] == "scale" and alpha not in (None, 255):
        return -1
    if meta["occupied_thresh"] < occ:
        return 100
    if occ < meta["free_thresh"]:
        return 0
    if meta["mode"] == "trinary":
        return -1
    low, high = meta["free_thresh"], meta["occupied_thresh"]
    return round((occ - low) / (high - low) * 100)


@settings(max_examples=150, deadline=None)
@given(
    st.sampled_from(["trinary", "scale", "raw"]),
    st.booleans(),
    # Odd thousandths: no level of 255 lies on them.
    st.integers(0, 400).map(lambda k: k / 1000 + 0.00011),
    st.integers(500, 998).map(lambda k: k / 1000 + 0.00011),
    st.sampled_from(["L", "RGB", "RGBA"]),
    st.integers(0, 2**32 - 1),
)
def test_pixels_are_read_as_nav2_reads_them(mode, negate, low, high, kind, seed):
    rng = np.random.default_rng(seed)
    shape = (5, 7, len(kind)) if len(kind) > 1 else (5, 7)
    pixels = rng.integers(0, 256, shape)
    if kind == "RGBA":
        pixels[:, :, 3] = rng.choice([0, 128, 255], (5, 7))
    meta = {"mode": mode, "negate": negate, "occupied_thresh": high, "free_thresh": low}
    about = yaml(**meta | {"negate": int(negate)})
    found = load(about, png(pixels)).values
    for place in np.ndindex(5, 7):
        pixel = np.atleast_1d(pixels[place]).tolist()
        rgb = pixel[:3] if len(pixel) > 1 else pixel * 3
        alpha = pixel[3] if kind == "RGBA" else None
        assert found[place] == nav2_value(rgb, alpha, meta)


def test_three_levels_are_occupied_unknown_and_free():
    assert values_of([0, 205, 254, 255, 89, 90, 206]) == [100, -1, 0, 0, 100, -1, 0]
    assert values_of([0, 205, 254], negate=1) == [0, 100, 100]


def test_with_the_higher_threshold_of_newer_files_unknown_reads_as_free():
    """Level 205 is occ = 50 / 255 = 0.196, below 0.25: nav2 calls it free."""
    assert values_of([0, 205, 254], free_thresh=0.25) == [100, 0, 0]
    found = load(yaml(free_thresh=0.25), pgm([0, 205, 254]), free_thresh=0.196)
    assert found.values.tolist() == [[100, -1, 0]]


def test_the_raw_level_is_the_percentage():
    assert values_of([0, 1, 50, 100, 101, 255], mode="raw") == [0, 1, 50, 100, -1, -1]


def test_scale_spreads_what_lies_between_the_thresholds():
    """By hand, thresholds 0.2 and 0.6: occ 0.4 (level 153) is half-way."""
    about = {"mode": "scale", "free_thresh": 0.2, "occupied_thresh": 0.6}
    assert values_of([0, 102, 153, 204, 255], **about) == [100, 100, 50, 0, 0]


def test_images_of_either_kind_and_depth_say_the_same():
    levels = np.array([[0, 205], [254, 100]])
    plain = b"P2\n# a comment\n2 2 # another\n255\n0 205\n# and one\n254 100\n"
    deep = pgm(levels * 257, most=65535)
    file = io.BytesIO()
    Image.fromarray((levels * 257).astype(np.uint16)).save(file, "PNG")
    bitmap = cv2.imencode(".bmp", np.kron(levels, np.ones((8, 8))).astype(np.uint8))[1]
    expected = load(yaml(), pgm(levels)).values
    for image in (plain, deep, png(levels), file.getvalue()):
        np.testing.assert_array_equal(load(yaml(), image).values, expected)
    large = load(yaml(), bitmap.tobytes()).values
    np.testing.assert_array_equal(large[::8, ::8], expected)


def test_rows_of_a_large_map_are_read_strip_by_strip(monkeypatch):
    levels = np.random.default_rng(0).integers(0, 256, (30, 20))
    whole = load(yaml(), pgm(levels)).values
    monkeypatch.setattr("occsim.io.ros_map.files.PIXELS_AT_ONCE", 64)
    np.testing.assert_array_equal(load(yaml(), pgm(levels)).values, whole)


VALUES = st.integers(0, 2**32 - 1).map(
    lambda seed: np.random.default_rng(seed).integers(-1, 101, (9, 13)).astype(np.int8)
)


@settings(max_examples=40, deadline=None)
@given(VALUES, st.floats(-100, 100), st.floats(-3, 3), st.floats(0.001, 2))
def test_maps_come_back_as_they_were_to_the_last_bit(values, x, yaw, resolution):
    ros_map = RosMap(values, resolution, (x, -x / 3, yaw))
    for mode, image_format in (("raw", "pgm"), ("raw", "png"), ("scale", "png")):
        found = load(*dump(ros_map, mode=mode, image_format=image_format))
        np.testing.assert_array_equal(found.values, values)
        assert (found.resolution_m, found.origin) == (resolution, ros_map.origin)
    three = RosMap(np.select([values > 65, values >= 0], [100, 0], -1), resolution)
    for image_format in ("pgm", "png"):
        found = load(*dump(three, image_format=image_format))
        np.testing.assert_array_equal(found.values, three.values)


def test_what_trinary_cannot_keep_becomes_unknown():
    ros_map = RosMap([[0, 19, 20, 50, 65, 66, 100, -1]], 0.05)
    found = load(*dump(ros_map)).values
    assert found.tolist() == [[0, 0, -1, -1, -1, 100, 100, -1]]


def test_a_map_is_written_beside_its_yaml_and_found_there(tmp_path):
    ros_map = RosMap([[0, 100, -1]], 0.05, (1.0, 2.0, 0.5))
    for mode, ending in (("trinary", "pgm"), ("scale", "png"), ("raw", "pgm")):
        save(ros_map, tmp_path / f"{mode}.yaml", mode=mode)
        assert (tmp_path / f"{mode}.{ending}").is_file()
        found = load(tmp_path / f"{mode}.yaml")
        np.testing.assert_array_equal(found.values, ros_map.values)
        assert found.origin == ros_map.origin


def test_nav2_reads_what_is_written():
    """Levels and keys of map_saver: 0 occupied, 254 free, 205 unknown."""
    about, image = dump(RosMap([[100, 0, -1]], 0.05))
    assert image == b"P5\n3 1\n255\n" + bytes([0, 254, 205])
    assert about.decode().splitlines() == [
        "image: map.pgm",
        "mode: trinary",
        "resolution: 0.05",
        "origin: [0.0, 0.0, 0.0]",
        "negate: 0",
        "occupied_thresh: 0.65",
        "free_thresh: 0.196",
    ]


@pytest.mark.parametrize("name", ["", "../map", "a b", ".hidden", "a\nb", "x" * 300, 3])
def test_a_name_that_is_no_plain_file_name_is_refused(name):
    with pytest.raises(ParameterError, match="name must be letters, digits"):
        dump(RosMap([[0]], 0.05), name)


def test_scale_needs_transparency_for_unknown():
    with pytest.raises(ParameterError, match="image_format must be png in mode scale"):
        dump(RosMap([[0, -1]], 0.05), mode="scale", image_format="pgm")
    found = load(*dump(RosMap([[0, 33]], 0.05), mode="scale", image_format="pgm"))
    assert found.values.tolist() == [[0, 33]]
    with pytest.raises(ParameterError, match="image_format must be pgm or png"):
        dump(RosMap([[0]], 0.05), image_format="gif")


def test_an_occupancy_grid_runs_from_the_bottom_up():
    ros_map = RosMap([[1, 2], [3, 4], [5, -1]], 0.1, (1.0, 2.0, 0.3))
    data = ros_map.occupancy_grid()
    assert data.tolist() == [5, -1, 3, 4, 1, 2]
    assert data.dtype == np.int8
    back = RosMap.from_occupancy_grid(
        data, width=2, resolution_m=0.1, origin=ros_map.origin
    )
    np.testing.assert_array_equal(back.values, ros_map.values)
    with pytest.raises(ParameterError, match="whole rows of width 4"):
        RosMap.from_occupancy_grid(data, width=4, resolution_m=0.1)


def test_a_turned_origin_turns_poses():
    """By hand: lower left corner at (1, 2), turned by a quarter to the left.

    The drawing, 10 px of 0.5 m high, then has its x along the frame's y, and its y
    (down) along the frame's x.
    """
    quarter = math.pi / 2
    ros_map = RosMap(np.zeros((10, 20), int), 0.5, (1.0, 2.0, quarter))
    poses_m = [[1.0, 2.0, quarter], [1.0, 5.0, quarter], [-1.0, 2.0, math.pi]]
    found = poses_to_image(poses_m, ros_map.frame)
    expected = [[0, 10, 0], [6, 10, 0], [0, 6, -quarter]]
    np.testing.assert_allclose(found.poses, expected, atol=1e-12)
    back = poses_to_metric(found, ros_map.frame)
    np.testing.assert_allclose(np.cos(back[:, 2]), np.cos([quarter, quarter, math.pi]))
    np.testing.assert_allclose(back[:, :2], np.array(poses_m)[:, :2], atol=1e-12)


def test_without_a_turn_frames_are_what_they_were_to_the_last_bit():
    frame = MetricFrame(
        height_px=100, metres_per_px=0.05, origin_x_m=-1.7, origin_y_m=2.3
    )
    poses = np.random.default_rng(0).normal(size=(50, 3))
    found = poses_to_image(poses, frame).poses
    np.testing.assert_array_equal(found[:, 0], (poses[:, 0] + 1.7) / 0.05)
    np.testing.assert_array_equal(found[:, 1], 100 - (poses[:, 1] - 2.3) / 0.05)


def test_a_map_of_ours_is_kept_to_the_per_cent_and_in_its_place():
    sample = load_sample("d")
    height = sample.world.shape[0]
    frame = MetricFrame(height_px=height, metres_per_px=0.05, origin_x_m=3.0)
    grid = sample.world.grid(7)
    blank = build_prior(np.zeros(sample.world.shape, bool), grid, Prior.uninformative())
    found = fuse(
        collect_evidence(sample.world, sample.trajectory, sample.sensor, grid), blank
    )
    ros_map = RosMap.of_map(found, frame)
    assert ros_map.resolution_m == pytest.approx(0.35)
    seen = found.n_updates > 0
    assert (ros_map.is_unknown == ~seen).all()
    assert np.abs(ros_map.p_free - found.p_free)[seen].max() <= 0.005 + 1e-12
    # The upper left corner of the map is that of the drawing.
    corner = Trajectory([[0.0, 0.0, 0.0]])
    np.testing.assert_allclose(
        poses_to_metric(corner, ros_map.frame), poses_to_metric(corner, frame)
    )
    prior = build_prior(sample.world.occupied, grid, Prior())
    as_prior = RosMap.of_prior(prior, frame)
    assert np.abs(as_prior.p_free - prior.p_free).max() <= 0.005 + 1e-12
    with pytest.raises(ParameterError, match="frame must be that of a drawing"):
        RosMap.of_prior(prior, MetricFrame(height_px=3, metres_per_px=0.05))


def test_a_turned_map_of_ours_keeps_its_upper_corner():
    grid = Grid(height_px=10, width_px=9, cell_px=4)
    frame = MetricFrame(
        height_px=10, metres_per_px=0.1, origin_x_m=1.0, origin_yaw_rad=0.7
    )
    blank = OccupancyMap(grid, np.zeros(grid.shape), np.zeros(grid.shape, int))
    corner = Trajectory([[0.0, 0.0, 0.2]])
    np.testing.assert_allclose(
        poses_to_metric(corner, RosMap.of_map(blank, frame).frame),
        poses_to_metric(corner, frame),
    )


def test_a_map_serves_as_world_and_as_prior():
    values = np.zeros((40, 60), int)
    values[:, :2] = values[:, -2:] = values[:2] = values[-2:] = 100
    values[10:20, 30:50] = -1
    ros_map = RosMap(values, 0.05)
    world = ros_map.world()
    assert world.occupied.sum() == (values == 100).sum()
    log = simulate_scans(world, Trajectory([[20, 20, 0]]), Sensor(range_px=80), 3)
    assert log.ranges_px[0, 1] == 38.0
    prior = ros_map.prior_map(world.grid(2))
    assert prior.p_free[0, 0] == pytest.approx(0.1)
    assert prior.p_free[5, 15] == 0.5
    assert prior.p_free[10, 10] == pytest.approx(0.9)
    assert prior.is_wall[0, 0]
    odd = ros_map.prior_map(world.grid(7), certainty=0.8)
    # By hand: 7 x 7 px, the first two columns and rows occupied, 24 of 49.
    assert odd.p_free[0, 0] == pytest.approx((24 * 0.2 + 25 * 0.8) / 49)
    with pytest.raises(ParameterError, match=r"certainty must lie in \(0.5, 1\)"):
        ros_map.prior_map(world.grid(7), certainty=1.0)
    with pytest.raises(ParameterError, match="grid must cover"):
        ros_map.prior_map(Grid(height_px=3, width_px=3, cell_px=1))


GOOD_FORMS = {
    "a list below": b"origin:\n- -1.0\n- -2.0\n- 0\n",
    "an indented list": b"origin:\n  - -1.0\n  - -2.0\n  - 0\n",
    "a list over lines": b"origin: [-1.0,\n  -2.0,\n  0.0]\n",
    "a comment": b"origin: [-1.0, -2.0, 0] # of the map\n",
    "numbers of other forms": b"origin: [-1, -2.e0, .0]\n",
}


@pytest.mark.parametrize("origin", GOOD_FORMS.values(), ids=GOOD_FORMS)
def test_origins_are_read_in_every_form_that_programs_write(origin):
    found = load(yaml(origin=None) + origin, pgm([0]))
    assert found.origin == (-1.0, -2.0, 0.0)


def test_yaml_may_have_quotes_comments_marks_and_other_keys(tmp_path):
    (tmp_path / "my map #1.pgm").write_bytes(pgm([0, 254]))
    text = yaml(image='"my map #1.pgm"', negate="false", mode="Trinary")
    text = b"\xef\xbb\xbf---\n# a map\n" + text.replace(b"\n", b"\r\n")
    text += b"cost:\n  lethal: 100\n  more: [1, 2]\n"
    text = text.replace(b"---", b"%YAML 1.2\r\n---").replace(b"mode:", b'"mode":')
    (tmp_path / "map.yaml").write_bytes(text)
    assert load(tmp_path / "map.yaml").values.tolist() == [[100, 0]]


BAD_YAML = {
    "nothing": (b" \n", "must name image, resolution"),
    "a key missing": (yaml(resolution=None), "resolution is missing"),
    "no text": (b"\xff\xfe\x00", "is not text in UTF-8"),
    "no key": (b"just words\n", 'line 1: "key: value" is needed; got just words'),
    "a key twice": (yaml() + b"image: b.pgm\n", "image stands there twice"),
    "an anchor": (yaml(image="&a map.pgm"), "image in the .yaml must be the name"),
    "a tag": (yaml(image="!!python/object:os.system"), "must be the name of a file"),
    "a list for a name": (yaml(image="[a, b]"), "must be the name of a file"),
    "words for a number": (yaml(resolution="small"), "must be a number; got small"),
    "no finite number": (yaml(resolution=".inf"), "must be a number; got .inf"),
    "a huge number": (yaml(resolution="1e999"), "must be above 0 and finite"),
    "many digits": (
        yaml(resolution="1" * 9000),
        "resolution in the .yaml must be a nu",
    ),
    "no size": (yaml(resolution=0), "resolution must be above 0"),
    "two numbers": (yaml(origin="[1, 2]"), "must be a list of x, y and yaw"),
    "one number": (yaml(origin="1"), "must be a list of x, y and yaw"),
    "an open list": (yaml(origin="[1, 2, 3"), "free_thresh is missing"),
    "an unknown mode": (yaml(mode="colour"), "must be one of trinary, scale, raw"),
    "a share above 1": (
        yaml(occupied_thresh=65),
        r"must lie in \[0, 1\]; got 0.196, 65",
    ),
    "thresholds exchanged": (
        yaml(mode="scale", free_thresh=0.7),
        "free_thresh must lie below occupied_thresh in mode scale",
    ),
    "too long": (yaml() + b"# \n" * 30_000, "at most 64,000 are allowed"),
}


@pytest.mark.parametrize(("text", "sentence"), BAD_YAML.values(), ids=BAD_YAML)
def test_a_yaml_that_makes_no_sense_is_refused_in_a_sentence(text, sentence):
    with pytest.raises(RobotFileError, match=sentence) as refused:
        load(text, pgm([0]))
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


BAD_IMAGES = {
    "nothing": b"",
    "no image": b"not an image at all",
    "half a header": b"P5\n3",
    "no size": b"P5\n0 5\n255\n",
    "a huge size": b"P5\n999999999 999999999\n255\n",
    "a size beyond the limit": b"P5\n4001 4001\n255\n",
    "no levels": b"P5\n3 3\n0\n" + bytes(9),
    "too many levels": b"P5\n3 3\n65536\n" + bytes(18),
    "cut": b"P5\n3 3\n255\n" + bytes(8),
    "cut, two bytes each": b"P5\n3 3\n300\n" + bytes(17),
    "words": b"P2\n2 1\n255\n1 two\n",
    "negative": b"P2\n2 1\n255\n1 -2\n",
    "too few": b"P2\n2 1\n255\n1\n",
    "spaces": b"P2\n2 1\n255\n1" + b" " * 100_000 + b"2",
    "a cut PNG": png(np.zeros((9, 9)))[:-40],
    "a PNG's mark": b"\x89PNG\r\n\x1a\n",
    "a huge PNG": png(np.zeros((9, 9))).replace(
        b"IHDR\x00\x00\x00\x09\x00\x00\x00\x09", b"IHDR\x7f\x00\x00\x09\x7f\x00\x00\x09"
    ),
}


@pytest.mark.parametrize("image", BAD_IMAGES.values(), ids=BAD_IMAGES)
def test_a_damaged_image_is_refused_in_a_sentence(image):
    with pytest.raises(RobotFileError) as refused:
        load(yaml(), image)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 250


def test_the_image_must_lie_in_the_folder_of_the_yaml(tmp_path):
    inside, outside = tmp_path / "maps", tmp_path / "secret.pgm"
    (inside / "images").mkdir(parents=True)
    outside.write_bytes(pgm([0, 254]))
    (inside / "images" / "a.pgm").write_bytes(pgm([0, 254]))
    (inside / "link.pgm").symlink_to(outside)
    about = inside / "map.yaml"
    about.write_bytes(yaml(image="images/a.pgm"))
    assert load(about).values.tolist() == [[100, 0]]
    for image in ("../secret.pgm", outside, "link.pgm", "images/../../secret.pgm", "."):
        about.write_bytes(yaml(image=image))
        with pytest.raises(RobotFileError, match="must lie in the folder of the .yaml"):
            load(about)
    for image in ("missing.pgm", "images", "a\0b"):
        about.write_bytes(yaml(image=image))
        with pytest.raises(RobotFileError):
            load(about)


def test_contents_need_both_files():
    with pytest.raises(RobotFileError, match="the image map.pgm is needed beside"):
        load(yaml())


@pytest.mark.parametrize(
    ("parts", "error", "sentence"),
    [
        (([[0.5]], 0.05), TypeError, "values must hold whole numbers"),
        (([0, 1], 0.05), ParameterError, "must have shape"),
        (([[101]], 0.05), ParameterError, "lie in -1 to 100"),
        (([[-2]], 0.05), ParameterError, "lie in -1 to 100"),
        (([[]], 0.05), (TypeError, ParameterError), "values must"),
        (([[0]], 0.0), ParameterError, "metres_per_px must be above 0"),
        (([[0]], 0.05, (0, 0, math.nan)), ParameterError, "origin must be finite"),
    ],
)
def test_a_map_that_makes_no_sense_is_refused(parts, error, sentence):
    with pytest.raises(error, match=sentence):
        RosMap(*parts)


def test_modes_may_be_named_by_their_value():
    assert dump(RosMap([[0]], 0.05), mode="raw") == dump(
        RosMap([[0]], 0.05), mode=MapMode.RAW
    )


def test_headers_of_spaces_and_comments_are_refused_at_once():
    """Before, 30 spaces took minutes, and 90 MB of comments 10 GB of memory."""
    for padding in (b" " * 5_000, b"#\n" * 1_000_000):
        start = time.process_time()
        assert kind_of_file(b"P5" + padding + b"x") is not FileKind.ROBOT_MAP
        with pytest.raises(RobotFileError, match="the header of map.pgm is damaged"):
            load(yaml(), b"P5" + padding + b"x")
        with pytest.raises(RobotFileError, match="levels are announced, others follow"):
            load(yaml(), b"P2 4000 4000 255\n" + padding + b"x")
        assert time.process_time() - start < 1.0

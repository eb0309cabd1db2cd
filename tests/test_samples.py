"""The five reference drawings: their properties, and that the script makes their
files."""

import cv2
import numpy as np
import pytest

from assets.samples.make import build
from assets.samples.make.plan import Plan, Style
from occsim.errors import ParameterError
from occsim.samples import FOLDER, load_sample, prior_drawing, sample_names

NAMES = ("a", "b", "c", "d", "e")


@pytest.fixture(params=NAMES)
def sample(request):
    return load_sample(request.param)


def wall_pixels(name):
    return cv2.imread(str(FOLDER / f"{name}_truth.png"), cv2.IMREAD_UNCHANGED)


def test_the_references_come_first_in_order():
    assert sample_names()[:5] == NAMES


def test_an_unknown_name_is_refused_with_the_names_there_are():
    with pytest.raises(ParameterError, match=r"one of a, b, c, d, e.*got 'z'"):
        load_sample("z")


def test_loading_twice_gives_the_same_object():
    assert load_sample("d") is load_sample("d")


def test_drawing_and_truth_have_the_same_size(sample):
    assert sample.drawing.shape == sample.world.shape
    expected = (350, 460) if sample.name in "ab" else (240, 300)
    assert sample.drawing.shape == expected


@pytest.mark.parametrize("name", NAMES)
def test_truth_is_black_and_white_only(name):
    assert set(np.unique(wall_pixels(name)).tolist()) == {0, 255}


def test_the_sensor_reaches_one_door_length(sample):
    length = 40.0 if sample.name in "ab" else 20.0
    assert sample.door_px == length
    assert sample.sensor.range_px == length
    assert sample.sensor.fov_rad == pytest.approx(np.pi / 6)


def test_titles_and_texts_are_there(sample):
    assert sample.title
    assert sample.about.endswith(".")


def test_a_few_hundred_poses_with_cardinal_headings(sample):
    quarter_turns = sample.trajectory.poses[:, 2] / (np.pi / 2)
    assert 250 <= len(sample.trajectory) <= 600
    assert set(np.round(quarter_turns, 9).tolist()) == {0.0, 1.0, 2.0, 3.0}


def test_poses_keep_clear_of_walls(sample):
    """At least 3 px from any wall pixel's centre."""
    free = (~sample.world.occupied).astype(np.uint8)
    distance = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    cols, rows = np.floor(sample.trajectory.poses[:, :2]).astype(int).T
    assert distance[rows, cols].min() >= 3.0


def test_the_tour_goes_through_no_wall(sample):
    """Straight from each pose to the next, looked at every quarter of a pixel."""
    positions = sample.trajectory.poses[:, :2]
    for start, end in zip(positions[:-1], positions[1:], strict=True):
        n = 4 * int(np.hypot(*(end - start))) + 2
        cols, rows = np.floor(np.linspace(start, end, n)).astype(int).T
        assert not sample.world.occupied[rows, cols].any()


def test_all_poses_stand_in_one_connected_free_space(sample):
    free = (~sample.world.occupied).astype(np.uint8)
    _, part = cv2.connectedComponents(free, connectivity=4)
    cols, rows = np.floor(sample.trajectory.poses[:, :2]).astype(int).T
    assert len(set(part[rows, cols].tolist())) == 1


def test_walls_are_dark_or_outlined_in_the_drawing(sample):
    """Registration: the truth's outer line of wall pixels carries ink; windows and the
    faces of hollow walls do so too, so that nearly every such pixel is dark."""
    wall = sample.world.occupied.astype(np.uint8)
    inner = cv2.erode(wall, np.ones((3, 3), np.uint8), borderValue=1)
    faces = (wall > 0) & (inner == 0)
    assert np.mean(sample.drawing.gray[faces] < 160) > 0.97


def test_no_large_dark_area_outside_the_truth(sample):
    """Solid walls are all in the truth: what is dark elsewhere is thin or small."""
    dark = ((sample.drawing.gray < 100) & ~sample.world.occupied).astype(np.uint8)
    opened = cv2.morphologyEx(dark, cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    assert opened.sum() == 0


@pytest.mark.parametrize("name", NAMES)
def test_truth_and_drawing_are_as_the_script_makes_them(name):
    plan = build.BRIEFS[name].draw()
    np.testing.assert_array_equal(wall_pixels(name) == 0, plan.truth())
    drawn = cv2.imread(str(FOLDER / f"{name}_drawing.png"), cv2.IMREAD_UNCHANGED)
    # Lettering and anti-aliasing may differ a little between library versions.
    difference = np.abs(drawn.astype(int) - plan.sheet.picture())
    assert difference.mean() < 1.0


def test_the_index_is_as_the_script_makes_it():
    assert build.index() == (FOLDER / "samples.json").read_bytes()


def test_a_pixel_is_wall_where_walls_cover_half_of_it():
    """A wall from x = 1.5 to 3.25 covers half of column 1 and a quarter of column 3."""
    plan = Plan(5, 2)
    plan.walls(Style.SOLID, [(1.5, 0, 3.25, 2)])
    expected = np.array([[False, True, True, False, False]] * 2)
    np.testing.assert_array_equal(plan.truth(), expected)


def test_doors_are_gaps_and_windows_are_wall_in_the_truth():
    """A wall of 2 px over 30 px with a door at 4 to 10 and a window at 16 to 24."""
    plan = Plan(30, 12)
    plan.walls(Style.HOLLOW, [(0, 8, 30, 10)])
    plan.door((4, 9), (10, 9), (0, -1), 2)
    plan.window((16, 9), (24, 9), 2)
    expected = np.zeros((12, 30), bool)
    expected[8:10] = True
    expected[8:10, 4:10] = False
    np.testing.assert_array_equal(plan.truth(), expected)


def test_a_prior_may_come_from_a_wrong_drawing():
    """Its own, left and right exchanged, none at all, or another of the same size."""
    c, d = load_sample("c"), load_sample("d")
    assert prior_drawing(c) is c.wall_mask
    np.testing.assert_array_equal(prior_drawing(c, "d"), d.wall_mask)
    mirrored = prior_drawing(c, "mirrored")
    np.testing.assert_array_equal(np.fliplr(mirrored), c.wall_mask)
    assert (mirrored != c.wall_mask).any()
    assert not prior_drawing(c, "empty").any()
    assert prior_drawing(c, "empty").shape == c.wall_mask.shape


def test_a_drawing_of_another_size_is_refused_and_the_fitting_ones_named():
    with pytest.raises(ParameterError, match="'empty', 'c', 'd', 'e'; got 'a'"):
        prior_drawing(load_sample("c"), "a")

"""One transform: working size, crop, quarter turns and straightening."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from occsim.errors import DrawingError, ParameterError
from occsim.imaging import MAX_PIXELS, Drawing
from occsim.imaging.transform import Transform


def blank(height: int, width: int) -> np.ndarray:
    return np.full((height, width, 3), 255, np.uint8)


def dot(height: int, width: int, x: int, y: int) -> Drawing:
    """White, with a black square of 3 x 3 px whose middle pixel is (y, x)."""
    rgb = blank(height, width)
    rgb[y - 1 : y + 2, x - 1 : x + 2] = 0
    return Drawing(rgb=rgb, name="dot")


def centre_of_ink(drawing: Drawing) -> np.ndarray:
    """Mean position, x and y, of what is dark."""
    ink = 255.0 - drawing.gray
    rows, cols = np.indices(ink.shape) + 0.5
    return np.array([(cols * ink).sum(), (rows * ink).sum()]) / ink.sum()


def fitted(drawing: Drawing, max_side_px: int) -> Drawing:
    return Transform.fit(drawing.shape, max_side_px).drawing(drawing)


def test_large_drawing_is_scaled_down_by_area():
    """Two by two pixels of 0, 0, 0 and 255 have the mean 64."""
    tile = np.array([[0, 0], [0, 255]], np.uint8)
    rgb = np.repeat(np.tile(tile, (10, 20))[:, :, None], 3, axis=2)
    small = fitted(Drawing(rgb=rgb, name="n"), 20)
    assert small.shape == (10, 20)
    assert (small.rgb == 64).all()
    assert small.name == "n"


def test_drawing_that_fits_stays_itself():
    drawing = dot(30, 40, 10, 10)
    assert fitted(drawing, 40) is drawing
    with pytest.raises(ParameterError, match="max_side_px must be 8 or more; got 7"):
        fitted(drawing, 7)


def test_crop_keeps_what_lies_inside_both():
    drawing = dot(30, 40, 20, 15)
    part = Transform.crop((30, 40), 10, 5, 100, 20).drawing(drawing)
    assert part.shape == (20, 30)
    assert np.array_equal(part.rgb, drawing.rgb[5:25, 10:])
    corner = Transform.crop((30, 40), -5, -5, 20, 20)
    assert corner.new_shape == (15, 15)
    assert np.array_equal(corner.drawing(drawing).rgb, drawing.rgb[:15, :15])
    with pytest.raises(DrawingError, match="40 x 30 px; got 5 x 20 px"):
        Transform.crop((30, 40), 35, 0, 20, 20)
    with pytest.raises(DrawingError, match="got 0 x 8 px"):
        Transform.crop((30, 40), 90, 0, 20, 8)


def test_quarter_turn_is_clockwise():
    """The top row becomes the right column."""
    rgb = blank(8, 12)
    rgb[0] = 0
    turned = Transform.quarter_turns((8, 12)).drawing(Drawing(rgb=rgb))
    assert turned.shape == (12, 8)
    assert (turned.rgb[:, -1] == 0).all()
    assert (turned.rgb[:, :-1] == 255).all()


@given(turns=st.integers(-8, 8))
def test_quarter_turns_are_those_of_numpy_for_drawing_and_mask(turns):
    rgb = np.random.default_rng(1).integers(0, 256, (20, 33, 3), np.uint8)
    turn = Transform.quarter_turns((20, 33), turns)
    turned = turn.drawing(Drawing(rgb=rgb))
    assert np.array_equal(turned.rgb, np.rot90(rgb, -turns))
    mask = rgb[..., 0] > 128
    assert np.array_equal(turn.mask(mask), np.rot90(mask, -turns))


@settings(deadline=None)
@given(
    x=st.integers(20, 100),
    y=st.integers(15, 60),
    turns=st.integers(-5, 5),
    tilt=st.floats(-0.7, 0.7),
    side=st.integers(60, 140),
)
def test_points_follow_the_drawing_through_every_transform(x, y, turns, tilt, side):
    """The dot's centre of ink lies where the transforms take its middle."""
    drawing, point = dot(80, 120, x, y), np.array([[x + 0.5, y + 0.5]])
    for make, tolerance in (
        (lambda shape: Transform.quarter_turns(shape, turns), 1e-6),
        (lambda shape: Transform.straighten(shape, tilt), 0.05),
        (lambda shape: Transform.crop(shape, 3, -2, 10_000, 10_000), 0.05),
        (lambda shape: Transform.fit(shape, side), 0.1),
    ):
        transform = make(drawing.shape)
        drawing, point = transform.drawing(drawing), transform.points(point)
        assert drawing.shape == transform.new_shape
        assert np.allclose(centre_of_ink(drawing), point, atol=tolerance)


@settings(deadline=None)
@given(turns=st.integers(0, 3), tilt=st.floats(-0.7, 0.7))
def test_headings_turn_with_the_drawing(turns, tilt):
    """A pose that looks at a point looks at it afterwards as well."""
    pose, ahead = np.array([[30.0, 20.0, 0.4]]), 5.0
    seen = pose[:, :2] + ahead * np.array([[np.cos(0.4), np.sin(0.4)]])
    for transform in (
        Transform.quarter_turns((80, 120), turns),
        Transform.straighten((80, 120), tilt),
    ):
        x, y, theta = transform.poses(pose)[0]
        looked_at = [x + ahead * np.cos(theta), y + ahead * np.sin(theta)]
        np.testing.assert_allclose(transform.points(seen)[0], looked_at, atol=1e-9)


def test_straightening_by_nothing_changes_nothing():
    drawing = dot(40, 50, 20, 20)
    assert Transform.straighten((40, 50), 0.0).drawing(drawing) is drawing


def test_straightened_corners_are_white_and_all_is_kept():
    drawing = Drawing(rgb=np.zeros((60, 90, 3), np.uint8))
    turned = Transform.straighten((60, 90), np.radians(10)).drawing(drawing)
    # ceil(60 cos 10 + 90 sin 10) and ceil(90 cos 10 + 60 sin 10), degrees.
    assert turned.shape == (75, 100)
    assert (turned.rgb[0, 0] == 255).all()
    assert (255.0 - turned.gray).sum() / 255.0 == pytest.approx(60 * 90, rel=0.01)


def test_large_tilt_is_refused():
    with pytest.raises(ParameterError, match=r"\[-pi/4, pi/4\]; got 1.0"):
        Transform.straighten((20, 20), 1.0)
    with pytest.raises(ParameterError, match="got nan"):
        Transform.straighten((20, 20), float("nan"))
    side = math.isqrt(MAX_PIXELS)
    with pytest.raises(DrawingError, match="megapixels; turned upright it would have"):
        Transform.straighten((side, side), 0.5)


# --- Masks ----------------------------------------------------------------------------


@settings(deadline=None)
@given(
    st.integers(60, 200),
    st.integers(60, 200),
    st.integers(8, 59),
    st.integers(0, 2**32 - 1),
)
@example(60, 107, 8, 709)  # a centre falls on an edge, 53.5 * 8 / 107 = 4
def test_no_wall_pixel_is_lost_when_a_mask_is_shrunk(height, width, side, seed):
    """Counted by a loop: each wall pixel's centre falls into a wall pixel."""
    mask = np.random.default_rng(seed).random((height, width)) < 0.01
    fit = Transform.fit((height, width), side)
    small = np.zeros(fit.new_shape, dtype=bool)
    new_height, new_width = fit.new_shape
    for row, col in np.argwhere(mask).tolist():
        # In whole numbers: a centre may lie on the edge between two pixels.
        new_row = (2 * row + 1) * new_height // (2 * height)
        small[new_row, (2 * col + 1) * new_width // (2 * width)] = True
    assert np.array_equal(fit.mask(mask), small)


def test_walls_of_two_pixels_stay_whole_on_a_tenth_of_the_size():
    mask = np.zeros((3000, 2000), dtype=bool)
    mask[:, 700:702] = mask[1111:1113] = True
    small = Transform.fit(mask.shape, 300).mask(mask)
    assert small.shape == (300, 200)
    assert small[:, 70].all()
    assert small[111].all()
    assert small.sum() == 300 + 200 - 1


# Not 45: there pixel centres lie on the line's edges, 0 or 1 of 2 diagonals is taken by
# chance, and OpenCV 4 and 5 differ.
@pytest.mark.parametrize("tilt_deg", [-40.0, -3.0, 0.5, 12.0, 44.0])
def test_a_line_of_one_pixel_is_not_broken_by_straightening(tilt_deg):
    mask = np.zeros((80, 120), dtype=bool)
    mask[40, 10:110] = True
    turned = Transform.straighten(mask.shape, np.radians(tilt_deg)).mask(mask)
    cols = np.flatnonzero(turned.any(axis=0))
    assert np.array_equal(cols, np.arange(cols[0], cols[-1] + 1))
    assert turned.sum() == pytest.approx(100, abs=4)


def test_a_mask_of_another_shape_is_refused():
    with pytest.raises(DrawingError, match=r"shape \(30, 40\).*got \(40, 30\)"):
        Transform.quarter_turns((30, 40)).mask(np.zeros((40, 30), dtype=bool))

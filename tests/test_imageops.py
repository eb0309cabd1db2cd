"""Working size, crop, quarter turns and straightening of drawings."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim.errors import DrawingError, ParameterError
from occsim.imaging import Drawing
from occsim.imaging.transform import (
    crop,
    crop_matrix,
    deskew,
    deskew_matrix,
    fit_matrix,
    fit_to,
    move_points,
    rotate90,
    rotate90_matrix,
)


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


def test_large_drawing_is_scaled_down_by_area():
    """Two by two pixels of 0, 0, 0 and 255 have the mean 64."""
    tile = np.array([[0, 0], [0, 255]], np.uint8)
    rgb = np.repeat(np.tile(tile, (10, 20))[:, :, None], 3, axis=2)
    small = fit_to(Drawing(rgb=rgb, name="n"), 20)
    assert small.shape == (10, 20)
    assert (small.rgb == 64).all()
    assert small.name == "n"


def test_drawing_that_fits_stays_itself():
    drawing = dot(30, 40, 10, 10)
    assert fit_to(drawing, 40) is drawing
    with pytest.raises(ParameterError, match="max_side_px must be 8 or more"):
        fit_to(drawing, 7)


def test_crop_keeps_what_lies_inside_both():
    drawing = dot(30, 40, 20, 15)
    part = crop(drawing, 10, 5, 100, 20)
    assert part.shape == (20, 30)
    assert np.array_equal(part.rgb, drawing.rgb[5:25, 10:])
    assert crop(drawing, -5, -5, 20, 20).shape == (15, 15)
    with pytest.raises(DrawingError, match="40 x 30 px; got 5 x 20 px"):
        crop(drawing, 35, 0, 20, 20)
    with pytest.raises(DrawingError, match="got 0 x 8 px"):
        crop(drawing, 90, 0, 20, 8)


def test_quarter_turn_is_clockwise():
    """The top row becomes the right column."""
    rgb = blank(8, 12)
    rgb[0] = 0
    turned = rotate90(Drawing(rgb=rgb))
    assert turned.shape == (12, 8)
    assert (turned.rgb[:, -1] == 0).all()
    assert (turned.rgb[:, :-1] == 255).all()


@given(turns=st.integers(-8, 8))
def test_four_quarter_turns_are_none(turns):
    drawing = dot(20, 33, 5, 7)
    back = rotate90(rotate90(drawing, turns), -turns)
    assert back.digest == drawing.digest
    assert rotate90(drawing, turns + 4).digest == rotate90(drawing, turns).digest


@settings(deadline=None)
@given(
    x=st.integers(20, 100),
    y=st.integers(15, 60),
    turns=st.integers(-5, 5),
    tilt=st.floats(-0.7, 0.7),
    side=st.integers(60, 140),
)
def test_points_follow_the_drawing_through_every_operation(x, y, turns, tilt, side):
    """The dot's centre of ink lies where the matrices take its middle."""
    drawing = dot(80, 120, x, y)
    point = np.array([[x + 0.5, y + 0.5]])
    assert np.allclose(centre_of_ink(drawing), point)
    moved = rotate90(drawing, turns)
    point = move_points(point, rotate90_matrix(drawing.shape, turns))
    assert np.allclose(centre_of_ink(moved), point, atol=1e-6)
    turned = deskew(moved, tilt)
    point = move_points(point, deskew_matrix(moved.shape, tilt))
    assert np.allclose(centre_of_ink(turned), point, atol=0.05)
    part = crop(turned, 3, -2, 10_000, 10_000)
    point = move_points(point, crop_matrix(3, -2))
    assert np.allclose(centre_of_ink(part), point, atol=0.05)
    small = fit_to(part, side)
    point = move_points(point, fit_matrix(part.shape, side))
    assert np.allclose(centre_of_ink(small), point, atol=0.1)


def test_deskew_by_nothing_changes_nothing():
    drawing = dot(40, 50, 20, 20)
    assert deskew(drawing, 0.0).digest == drawing.digest


def test_deskewed_corners_are_white_and_all_is_kept():
    drawing = Drawing(rgb=np.zeros((60, 90, 3), np.uint8))
    turned = deskew(drawing, np.radians(10))
    # ceil(60 cos 10 + 90 sin 10) and ceil(90 cos 10 + 60 sin 10), degrees.
    assert turned.shape == (75, 100)
    assert (turned.rgb[0, 0] == 255).all()
    assert (255.0 - turned.gray).sum() / 255.0 == pytest.approx(60 * 90, rel=0.01)


def test_large_tilt_is_refused():
    with pytest.raises(ParameterError, match=r"\[-pi/4, pi/4\]; got 1.0"):
        deskew(dot(20, 20, 9, 9), 1.0)
    with pytest.raises(ParameterError, match="got nan"):
        deskew_matrix((20, 20), float("nan"))

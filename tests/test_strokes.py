"""Strokes: which pixels they cover, and how they are written down."""

import json
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim.errors import ParameterError
from occsim.strokes import (
    TEST_POINT,
    Stroke,
    StrokeKind,
    apply_strokes,
    decode_strokes,
    encode_strokes,
    pack_mask,
    unpack_mask,
)
from occsim.strokes.stroke import BOXES, FILLED, TWO_POINTS

SHAPE = (24, 32)


def stroke(kind, *points, width_px=1.0):
    return Stroke(kind=StrokeKind(kind), points=points, width_px=width_px)


def drawn(*strokes, shape=(6, 8)):
    """The mask of some strokes on an empty image, as lines of # and dots."""
    mask = apply_strokes(np.zeros(shape, dtype=bool), strokes)
    return ["".join("#" if pixel else "." for pixel in row) for row in mask]


# --- By hand: each picture was counted out on squared paper from the rule. ---


def test_line_of_width_one_through_centres_covers_one_row():
    assert drawn(stroke("line", (2.5, 2.5), (5.5, 2.5))) == [
        "........",
        "........",
        "..####..",
        "........",
        "........",
        "........",
    ]


@pytest.mark.parametrize("y", [2.0, 2.25, 2.5, 2.75])
@pytest.mark.parametrize("width_px", [1, 2, 3, 4])
def test_level_line_is_as_many_rows_high_as_it_is_wide(y, width_px):
    mask = apply_strokes(
        np.zeros((9, 40), dtype=bool),
        [stroke("line", (5, y + 2), (35, y + 2), width_px=width_px)],
    )
    assert mask[:, 20].sum() == width_px


def test_slanted_line_covers_the_pixels_it_passes_nearest():
    assert drawn(stroke("line", (1.5, 1.5), (4.5, 4.5))) == [
        "........",
        ".#......",
        "..#.....",
        "...#....",
        "....#...",
        "........",
    ]


def test_dot_of_the_thinnest_brush_on_a_pixel_corner_is_not_lost():
    # The corner (3, 2) is the outer corner of the pixel in row 2, column 3.
    assert drawn(stroke("brush", (3, 2)), shape=(4, 5)) == [
        ".....",
        ".....",
        "...#.",
        ".....",
    ]


def test_round_brush_of_width_four_on_a_corner_leaves_its_corners_out():
    # Radius 2 about (4, 3): test points are 0.5 +- 1/64 and 1.5 +- 1/64 away along each
    # axis; the four with both about 1.5 are more than 2 away (2.10 to 2.14).
    assert drawn(stroke("brush", (4, 3), width_px=4)) == [
        "........",
        "...##...",
        "..####..",
        "..####..",
        "...##...",
        "........",
    ]


def test_rectangle_is_filled_between_its_corners_in_any_order():
    wanted = [
        "........",
        ".####...",
        ".####...",
        "........",
        "........",
        "........",
    ]
    assert drawn(stroke("rectangle", (1, 1), (5, 3))) == wanted
    assert drawn(stroke("rectangle", (5, 1), (1, 3))) == wanted


def test_outline_has_square_corners_and_an_empty_middle():
    assert drawn(stroke("outline", (1.5, 1.5), (6.5, 4.5))) == [
        "........",
        ".######.",
        ".#....#.",
        ".#....#.",
        ".######.",
        "........",
    ]


def test_later_strokes_win():
    wall = stroke("rectangle", (0, 0), (8, 6))
    door = stroke("clear", (3, 0), (5, 6))
    cut = stroke("eraser", (0, 2.5), (8, 2.5))
    assert drawn(wall, door, cut) == [
        "###..###",
        "###..###",
        "........",
        "###..###",
        "###..###",
        "###..###",
    ]
    assert drawn(door, cut, wall) == ["########"] * 6


def test_strokes_outside_the_image_have_no_effect_on_it():
    assert drawn(
        stroke("brush", (-50, -50), (-20, 3), width_px=9),
        stroke("rectangle", (20, 20), (40, 40)),
        stroke("outline", (-9, -9), (30, 30), width_px=3),
        shape=(3, 4),
    ) == ["....", "....", "...."]


def test_mask_given_is_not_written_to():
    mask = np.zeros((4, 4), dtype=bool)
    mask.setflags(write=False)
    assert apply_strokes(mask, [stroke("rectangle", (0, 0), (4, 4))]).all()
    assert not mask.any()


# --- Against a naive loop over pixels. ---


def distance_to_segment(p, a, b):
    """Textbook distance from a point to a segment."""
    along = b - a
    squared = along @ along
    share = 0.0 if squared == 0 else np.clip((p - a) @ along / squared, 0, 1)
    return np.hypot(*(p - a - share * along))


def is_covered(one, row, col):
    """Whether the rule gives a pixel to a stroke, read word by word."""
    test = np.array([col + TEST_POINT, row + TEST_POINT])
    points = np.array(one.points)
    radius = one.width_px / 2
    if one.kind in BOXES:
        low, high = points.min(axis=0), points.max(axis=0)
        if one.kind in FILLED:
            return bool(((test >= low) & (test <= high)).all())
        outer = ((test >= low - radius) & (test <= high + radius)).all()
        inner = ((test > low + radius) & (test < high - radius)).all()
        return bool(outer and not inner)
    if (np.floor(points) == [col, row]).all(axis=1).any():
        return True
    ends = points[1:] if len(points) > 1 else points
    return any(
        distance_to_segment(test, a, b) <= radius
        for a, b in zip(points, ends, strict=False)
    )


coordinates = st.tuples(
    st.integers(-40, 4 * 40).map(lambda n: n / 4),
    st.integers(-40, 4 * 32).map(lambda n: n / 4),
)


@st.composite
def strokes(draw):
    kind = draw(st.sampled_from(StrokeKind))
    n = (2, 2) if kind in TWO_POINTS else (1, 5)
    return Stroke(
        kind=kind,
        points=tuple(draw(st.lists(coordinates, min_size=n[0], max_size=n[1]))),
        width_px=draw(st.integers(4, 60)) / 4,
    )


@settings(max_examples=60, deadline=None)
@given(strokes(), st.booleans())
def test_stroke_covers_exactly_what_the_rule_says(one, full):
    before = np.full(SHAPE, full)
    changed = apply_strokes(before, [one]) != before
    covered = np.array(
        [[is_covered(one, r, c) for c in range(SHAPE[1])] for r in range(SHAPE[0])]
    )
    expected = covered & (before == one.erases)
    assert (changed == expected).all()


@given(st.lists(strokes(), max_size=6), st.integers(0, 6))
def test_strokes_can_be_applied_in_two_goes(many, cut):
    empty = np.zeros(SHAPE, dtype=bool)
    in_two = apply_strokes(apply_strokes(empty, many[:cut]), many[cut:])
    assert (in_two == apply_strokes(empty, many)).all()


# --- Written down and read back. ---


@given(st.lists(strokes(), max_size=8))
def test_strokes_survive_json(many):
    written = json.dumps(encode_strokes(many))
    assert decode_strokes(json.loads(written)) == tuple(many)


def test_stroke_is_written_as_differences_of_quarters():
    line = stroke("line", (10, 20.25), (12.5, 20), width_px=3)
    assert encode_strokes([line]) == [["line", 12, 40, 81, 10, -1]]


@pytest.mark.parametrize(
    ("encoded", "says"),
    [
        ("brush", "must be a list of lists; got str"),
        (None, "must be a list of lists; got NoneType"),
        ({"0": 1}, "must be a list of lists; got dict"),
        ([7], r"must be \[kind, width"),
        ([["brush", 4, 8]], r"must be \[kind, width"),
        ([["brush", 4, 8, 8, 1]], r"must be \[kind, width"),
        ([["spray", 4, 8, 8]], "kind must be one of brush, .*; got 'spray'"),
        ([[["brush"], 4, 8, 8]], "kind must be one of"),
        ([["brush", 4, 8.5, 8]], "whole numbers"),
        ([["brush", 4, True, 8]], "whole numbers"),
        ([["brush", 4, 10**400, 8]], "whole numbers"),
        ([["brush", 4, float("nan"), 8]], "whole numbers"),
        ([["brush", 3, 8, 8]], r"width_px must lie in \[1, 512\]; got 0.75"),
        ([["brush", 9999, 8, 8]], "width_px must lie in"),
        ([["brush", 4, 400_004, 8]], "within 100000 px"),
        ([["line", 4, 8, 8]], "a line has exactly 2 points; got 1"),
        ([["brush", 4, 8, 8]] * 4, "at most 3 strokes are accepted; got 4"),
        (
            [["brush", 4, *[0] * 22]],
            "at most 10 points of strokes are accepted; got 11",
        ),
    ],
)
def test_what_is_no_list_of_strokes_is_refused(encoded, says):
    with pytest.raises(ParameterError, match=says):
        decode_strokes(encoded, max_strokes=3, max_points=10)


def test_stroke_refuses_a_kind_that_is_none():
    with pytest.raises(ParameterError, match="kind must be a StrokeKind"):
        Stroke(kind="brush", points=((0, 0),))


def test_stroke_without_points_is_refused():
    with pytest.raises(ParameterError, match="1 to 65536 points; got 0"):
        stroke("brush")


def test_mask_of_another_dimension_is_refused():
    with pytest.raises(ParameterError, match=r"shape \(H, W\); got \(4, 4, 3\)"):
        apply_strokes(np.zeros((4, 4, 3), dtype=bool), [])


@given(st.integers(1, 13), st.integers(1, 13), st.randoms(use_true_random=False))
def test_packed_mask_comes_back(height, width, random):
    flags = [random.random() < 0.3 for _ in range(height * width)]
    mask = np.array(flags).reshape(height, width)
    assert (unpack_mask(pack_mask(mask), (height, width)) == mask).all()


def test_no_bytes_are_a_mask_without_any_pixel():
    assert not unpack_mask(b"", (3, 5)).any()


@pytest.mark.parametrize(
    ("packed", "says"),
    [
        (zlib.compress(b""), "must hold 2 bytes; this one holds 0"),
        (b"not zlib", "must be zlib data"),
        (zlib.compress(b"x"), "must hold 2 bytes; this one holds 1"),
        (zlib.compress(bytes(10**6)), "must hold 2 bytes; this one holds more"),
    ],
)
def test_bytes_that_hold_no_such_mask_are_refused(packed, says):
    with pytest.raises(ParameterError, match=says):
        unpack_mask(packed, (3, 5))

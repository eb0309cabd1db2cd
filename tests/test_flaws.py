"""What a drawing gets wrong, by hand, by properties and over many seeds."""

import math
from dataclasses import fields

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from occsim import DrawingFlaws, ParameterError, flawed_mask, load_sample, sample_names
from occsim.flaws import moving

MASKS = npst.arrays(
    np.bool_, st.tuples(st.integers(1, 14), st.integers(1, 14)), elements=st.booleans()
)
FLAWS = st.builds(
    DrawingFlaws,
    thickness_px=st.integers(-4, 4),
    shift_x_px=st.floats(-20, 20),
    shift_y_px=st.floats(-20, 20),
    rotation_rad=st.floats(-math.pi, math.pi),
    scale=st.floats(0.3, 3.0),
    missing_share=st.floats(0, 1),
    false_share=st.floats(0, 1),
    seed=st.integers(0, 3),
)


def drawn(*rows):
    """A mask from rows of text: # is wall."""
    return np.array([[sign == "#" for sign in row] for row in rows])


def n_pieces(mask, connectivity=8):
    return cv2.connectedComponents(mask.astype(np.uint8), connectivity=connectivity)[0]


def n_holes(mask):
    """Free regions, joined by sides, that do not reach the outside."""
    return n_pieces(np.pad(~mask, 1, constant_values=True), 4) - 2


def room(height=100, width=140, thickness=5):
    """Four walls round a room, a third of the sheet's side from its edge."""
    mask = np.zeros((height, width), dtype=bool)
    mask[30 : height - 30, 30 : width - 30] = True
    inner = 30 + thickness
    mask[inner : height - inner, inner : width - inner] = False
    return mask


@given(mask=MASKS, seed=st.integers(0, 9))
def test_a_drawing_without_flaws_is_handed_back_itself(mask, seed):
    assert flawed_mask(mask, DrawingFlaws(seed=seed)) is mask


@settings(max_examples=300, deadline=None)
@given(mask=MASKS, flaws=FLAWS)
def test_any_flaws_give_a_mask_of_the_same_size_and_leave_the_given_one(mask, flaws):
    """Empty, full and 1 px sheets among them, and whatever the order in memory."""
    before = mask.copy()
    result = flawed_mask(mask, flaws)
    assert result.dtype == np.bool_
    assert result.shape == mask.shape
    np.testing.assert_array_equal(mask, before)
    np.testing.assert_array_equal(result, flawed_mask(mask, flaws))
    turned = np.asfortranarray(mask)
    np.testing.assert_array_equal(result, flawed_mask(turned, flaws))
    every_other = np.repeat(mask, 2, axis=1)[:, ::2]
    np.testing.assert_array_equal(result, flawed_mask(every_other, flaws))


def test_thinned_by_one_a_wall_of_four_keeps_two_and_a_wall_of_two_keeps_a_line():
    """The ends of the wall of four move in by one; the line keeps its length."""
    mask = drawn(
        "..........",
        ".########.",
        ".########.",
        ".########.",
        ".########.",
        "..........",
        ".########.",
        ".########.",
        "..........",
    )
    expected = drawn(
        "..........",
        "..........",
        "..######..",
        "..######..",
        "..........",
        "..........",
        "..........",
        ".########.",
        "..........",
    )
    result = flawed_mask(mask, DrawingFlaws(thickness_px=-1))
    np.testing.assert_array_equal(result, expected)


def test_a_line_of_one_px_stays_whole_however_often_it_is_thinned():
    mask = drawn("#.....#", ".#...#.", "..#.#..", "...#...", "...#...")
    result = flawed_mask(mask, DrawingFlaws(thickness_px=-50))
    np.testing.assert_array_equal(result, mask)


@settings(max_examples=300, deadline=None)
@given(mask=MASKS, thickness_px=st.integers(-5, -1))
def test_thinned_walls_lie_in_the_old_ones_with_the_same_pieces_and_holes(
    mask, thickness_px
):
    result = flawed_mask(mask, DrawingFlaws(thickness_px=thickness_px))
    assert not (result & ~mask).any()
    assert n_pieces(result) == n_pieces(mask)
    assert n_holes(result) == n_holes(mask)


@pytest.mark.parametrize("name", sample_names())
def test_a_sample_thinned_to_lines_keeps_its_rooms_and_is_one_px_thick(name):
    mask = load_sample(name).wall_mask
    lines = flawed_mask(mask, DrawingFlaws(thickness_px=-50))
    assert n_pieces(lines) == n_pieces(mask)
    assert n_holes(lines) == n_holes(mask)
    blocks = lines[:-1, :-1] & lines[1:, :-1] & lines[:-1, 1:] & lines[1:, 1:]
    assert blocks.sum() <= 0.01 * lines.sum()


@settings(deadline=None)
@given(mask=MASKS, thickness_px=st.integers(1, 6))
def test_thickened_walls_reach_what_is_near_enough(mask, thickness_px):
    rows, cols = np.nonzero(mask)
    at = np.moveaxis(np.indices(mask.shape), 0, -1)[:, :, None]
    steps = ((at - np.stack((rows, cols), axis=-1)) ** 2).sum(axis=-1)
    expected = (steps <= thickness_px**2).any(axis=-1)
    result = flawed_mask(mask, DrawingFlaws(thickness_px=thickness_px))
    np.testing.assert_array_equal(result, expected)


@settings(deadline=None)
@given(mask=MASKS, dx=st.integers(-20, 20), dy=st.integers(-20, 20))
def test_a_shift_by_whole_px_is_that_of_the_array(mask, dx, dy):
    height, width = mask.shape
    sheet = np.pad(mask, 20)
    expected = sheet[20 - dy : 20 - dy + height, 20 - dx : 20 - dx + width]
    result = flawed_mask(mask, DrawingFlaws(shift_x_px=dx, shift_y_px=dy))
    np.testing.assert_array_equal(result, expected)


@settings(deadline=None)
@given(mask=npst.arrays(np.bool_, (9, 9)), turns=st.integers(-2, 2))
def test_a_quarter_turn_goes_from_x_towards_y(mask, turns):
    """On the screen, y down, that is clockwise: rot90 counts the other way."""
    result = flawed_mask(mask, DrawingFlaws(rotation_rad=turns * math.pi / 2))
    np.testing.assert_array_equal(result, np.rot90(mask, -turns))


def naive_move(mask, flaws):
    """Both halves of the rule, pixel by pixel."""
    height, width = mask.shape
    centre = complex(width / 2, height / 2)
    shift = complex(flaws.shift_x_px, flaws.shift_y_px)
    turn = flaws.scale * complex(
        math.cos(flaws.rotation_rad), math.sin(flaws.rotation_rad)
    )
    result = np.zeros_like(mask)
    for row, col in np.ndindex(mask.shape):
        own = complex(col + 0.5, row + 0.5)
        for point, eps, forward in (
            ((own - centre) * turn + centre + shift, 1e-6, True),
            ((own - centre - shift) / turn + centre, -1e-6, False),
        ):
            at = math.floor(point.imag + eps), math.floor(point.real + eps)
            if 0 <= at[0] < height and 0 <= at[1] < width:
                if forward:
                    result[at] |= mask[row, col]
                else:
                    result[row, col] |= mask[at]
    return result


@settings(max_examples=200, deadline=None)
@given(
    mask=MASKS,
    flaws=st.builds(
        DrawingFlaws,
        shift_x_px=st.floats(-5, 5),
        shift_y_px=st.sampled_from([0.0, 0.5, -1.25]),
        rotation_rad=st.floats(-math.pi, math.pi),
        scale=st.floats(0.3, 3.0),
    ),
)
def test_moved_walls_are_those_of_a_naive_loop(mask, flaws):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(moving, "_bridged", lambda walls: walls)
        result = flawed_mask(mask, flaws)
    np.testing.assert_array_equal(result, naive_move(mask, flaws))


@settings(max_examples=100, deadline=None)
@given(
    angle=st.floats(0, math.pi),
    rotation_rad=st.floats(-math.pi, math.pi),
    scale=st.floats(0.5, 1.4),
)
def test_a_thin_line_is_never_broken_by_turning_and_scaling(angle, rotation_rad, scale):
    sheet = np.zeros((81, 81), dtype=np.uint8)
    ends = [
        (round(40 + r * math.cos(angle)), round(40 + r * math.sin(angle)))
        for r in (-25, 25)
    ]
    line = cv2.line(sheet, *ends, color=1).astype(bool)
    flaws = DrawingFlaws(rotation_rad=rotation_rad, scale=scale)
    result = flawed_mask(line, flaws)
    assert n_pieces(result) == 2  # the line and the paper
    assert np.ptp(np.argwhere(result), axis=0).max() >= 0.7 * 50 * scale - 2


def lengths(mask, thickness=5):
    """Length of walls of one thickness."""
    return mask.sum() / thickness


@pytest.mark.parametrize("share", [0.1, 0.3, 0.6])
def test_missing_and_false_walls_have_the_share_of_length_over_seeds(share):
    mask = room(300, 400)
    whole = lengths(mask)
    for seed in range(20):
        missing = flawed_mask(mask, DrawingFlaws(missing_share=share, seed=seed))
        assert not (missing & ~mask).any()
        assert lengths(missing) / whole == pytest.approx(1 - share, abs=0.02)
        false = flawed_mask(mask, DrawingFlaws(false_share=share, seed=seed))
        assert not (mask & ~false).any()
        assert lengths(false) / whole == pytest.approx(1 + share, abs=0.04)
    ends = [
        flawed_mask(mask, DrawingFlaws(missing_share=one, seed=1)) for one in (0.0, 1.0)
    ]
    assert ends[0] is mask
    assert not ends[1].any()


@pytest.mark.parametrize("name", sample_names())
def test_on_a_sample_the_shares_hold_in_pixels_too(name):
    mask = load_sample(name).wall_mask
    for seed in range(5):
        missing = flawed_mask(mask, DrawingFlaws(missing_share=0.25, seed=seed))
        assert missing.sum() / mask.sum() == pytest.approx(0.75, abs=0.06)
        false = flawed_mask(mask, DrawingFlaws(false_share=0.25, seed=seed))
        assert false.sum() / mask.sum() == pytest.approx(1.25, abs=0.08)


def test_a_missing_piece_is_about_a_door_long_and_goes_through_the_wall():
    """One wall 5 px thick: pieces of 5 thicknesses, 25 px, and one of the rest."""
    mask = np.zeros((60, 1000), dtype=bool)
    mask[20:25] = True
    left = flawed_mask(mask, DrawingFlaws(missing_share=0.1, seed=4))
    assert (left[20:25].all(axis=0) | ~left[20:25].any(axis=0)).all()
    edges = np.diff(np.pad(~left[22], 1).astype(int))
    gaps = np.flatnonzero(edges == -1) - np.flatnonzero(edges == 1)
    assert gaps.sum() == pytest.approx(100, abs=5)
    assert 4 <= len(gaps) <= 5
    assert set(gaps) & {25, 26, 27}


def test_false_walls_have_the_drawings_thickness_and_directions():
    """A drawing of one long level wall, 4 px thick: so are its false walls."""
    mask = np.zeros((200, 300), dtype=bool)
    mask[20:24] = True
    false = flawed_mask(mask, DrawingFlaws(false_share=0.5, seed=2)) & ~mask
    _, _, boxes, _ = cv2.connectedComponentsWithStats(false.astype(np.uint8))
    heights = boxes[1:, cv2.CC_STAT_HEIGHT]
    assert np.median(heights) == 4
    assert (boxes[1:, cv2.CC_STAT_WIDTH] > boxes[1:, cv2.CC_STAT_HEIGHT]).all()


def test_one_flaw_leaves_the_places_of_the_other():
    mask = room(300, 400)
    both = flawed_mask(mask, DrawingFlaws(missing_share=0.2, false_share=0.3))
    missing = flawed_mask(mask, DrawingFlaws(missing_share=0.2))
    false = flawed_mask(mask, DrawingFlaws(false_share=0.3))
    np.testing.assert_array_equal(both, missing | (false & ~mask))
    other = flawed_mask(mask, DrawingFlaws(missing_share=0.2, seed=1))
    assert (other != missing).any()


def test_flaws_come_in_the_documented_order():
    """Redrawn, then thinned or thickened, then moved: as if one after the other."""
    mask = room(120, 160)
    redrawn = {"missing_share": 0.2, "false_share": 0.2, "seed": 3}
    moved = {"rotation_rad": 0.1, "scale": 1.1, "shift_x_px": 7.0}
    steps = flawed_mask(mask, DrawingFlaws(**redrawn))
    steps = flawed_mask(steps, DrawingFlaws(thickness_px=-1))
    steps = flawed_mask(steps, DrawingFlaws(**moved))
    at_once = flawed_mask(mask, DrawingFlaws(thickness_px=-1, **redrawn, **moved))
    np.testing.assert_array_equal(at_once, steps)


def test_the_same_seed_gives_the_same_walls_everywhere():
    """Counts recorded on x86-64 Linux, numpy 2.4, OpenCV 5.0."""
    flaws = DrawingFlaws(
        thickness_px=-1,
        rotation_rad=0.03,
        scale=1.02,
        shift_x_px=2.5,
        missing_share=0.2,
        false_share=0.2,
        seed=5,
    )
    result = flawed_mask(room(), flaws)
    assert (int(result.sum()), int(np.flatnonzero(result).sum())) == (660, 4517935)


@pytest.mark.parametrize("name", [item.name for item in fields(DrawingFlaws)])
def test_a_sliders_range_holds_the_default_and_is_allowed(name):
    low, high, step = DrawingFlaws.bounds(name)
    assert low <= getattr(DrawingFlaws(), name) <= high
    assert 0 < step <= high - low
    for value in (low, high):
        DrawingFlaws(**{name: value})


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("thickness_px", 0.5),
        ("thickness_px", -51),
        ("missing_share", 1.01),
        ("false_share", -0.1),
        ("scale", 0.0),
        ("shift_x_px", math.nan),
        ("rotation_rad", math.inf),
        ("seed", -1),
        ("shift_y_px", "6"),
    ],
)
def test_what_cannot_be_a_flaw_is_refused_by_name(name, value):
    with pytest.raises(ParameterError, match=rf"{name} must .* got"):
        DrawingFlaws(**{name: value})


def test_a_picture_or_a_row_is_no_mask():
    with pytest.raises(TypeError, match="mask must be an array of bool"):
        flawed_mask(np.zeros((3, 3), np.uint8), DrawingFlaws())
    with pytest.raises(ParameterError, match=r"shape \(H, W\)"):
        flawed_mask(np.zeros(3, bool), DrawingFlaws())
    with pytest.raises(ParameterError, match="no flaw of a drawing is named 'tilt'"):
        DrawingFlaws.bounds("tilt")

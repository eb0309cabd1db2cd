"""Corrections: an overlay of added and erased pixels, small, and taken tile by tile."""

import math
import tracemalloc
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis.extra import numpy as arrays

from occsim import Corrections, ParameterError
from occsim.corrections import TILE_PX, pack_mask, unpack_mask
from occsim.imaging.transform import Transform
from tests.boards import tiles

SHAPE = (70, 130)  # tiles of 64 px: two rows and three columns, most of them cut off


def masks(shape=SHAPE):
    return arrays.arrays(bool, shape)


def some(seed, shape=SHAPE, share=0.1):
    """Corrections of random pixels."""
    draw = np.random.default_rng(seed).random(shape)
    return Corrections.from_masks(draw < share, draw > 1.0 - share)


@settings(max_examples=20, deadline=None)
@given(masks(), masks(), masks())
def test_added_pixels_are_wall_and_erased_ones_are_none(mask, added, erased):
    erased = erased & ~added
    corrections = Corrections.from_masks(added, erased)
    expected = np.where(added, True, np.where(erased, False, mask))
    np.testing.assert_array_equal(corrections.apply(mask), expected)
    np.testing.assert_array_equal(corrections.planes, [added, erased])


@settings(max_examples=20, deadline=None)
@given(masks(), masks())
def test_the_difference_of_two_masks_takes_one_to_the_other(before, after):
    corrections = Corrections.between(before, after)
    np.testing.assert_array_equal(corrections.apply(before), after)
    assert corrections.planes.sum() == (before != after).sum()


def test_nothing_corrected_is_empty_and_leaves_the_mask_itself():
    mask = np.eye(5, dtype=bool)
    nothing = Corrections.none((5, 5))
    assert nothing.is_empty
    assert nothing.apply(mask) is mask
    assert Corrections.between(mask, mask) == nothing
    assert not nothing.planes.any()
    assert not some(1).is_empty


def test_equal_pixels_are_equal_corrections():
    assert some(1) == some(1)
    assert hash(some(1)) == hash(some(1))
    assert some(1) != some(2)


def test_corrections_say_how_much_they_hold():
    added = np.zeros((4, 6), dtype=bool)
    added[0, :3] = True
    assert repr(Corrections.from_masks(added, np.roll(added, 1, axis=0))) == (
        "Corrections(6 x 4 px: 3 px added, 3 px erased)"
    )


def test_hundreds_of_strokes_take_a_few_tens_of_kilobytes():
    """250 curves of 8 px, half of them erasers, on 1500 x 1000 px."""
    rng = np.random.default_rng(5)
    value = np.zeros((1000, 1500), dtype=np.int8)
    for number in range(250):
        x, y, angle = rng.uniform(0, 1500), rng.uniform(0, 1000), rng.uniform(0, 6.28)
        for _ in range(100):
            angle += rng.normal(0.0, 0.05)
            x, y = x + math.cos(angle), y + math.sin(angle)
            top, left = max(int(y) - 4, 0), max(int(x) - 4, 0)
            value[top : int(y) + 4, left : int(x) + 4] = 1 + number % 2
    corrections = Corrections.from_masks(value == 1, value == 2)
    assert corrections.planes.sum() > 100_000
    assert len(corrections.packed) < 60_000


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda m: Corrections.from_masks(m, m[:3]), r"one shape.*\(5, 5\) and \(3, 5"),
        (lambda m: Corrections.from_masks(m, m), "not both; got 5 in both"),
        (lambda m: Corrections.between(m, m[:3]), "before and after must have one"),
        (lambda m: Corrections.none((4, 5)).apply(m), r"shape \(4, 5\); got \(5, 5\)"),
    ],
)
def test_masks_that_do_not_fit_are_refused(make, message):
    with pytest.raises(ParameterError, match=message):
        make(np.eye(5, dtype=bool))


# --- Moved with the drawing -----------------------------------------------------------


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_corrections_turn_with_the_drawing(turns):
    turned = some(1).transformed(Transform.quarter_turns(SHAPE, turns))
    np.testing.assert_array_equal(
        turned.planes, np.rot90(some(1).planes, -turns, axes=(1, 2))
    )


def test_where_both_meet_in_a_smaller_pixel_the_wall_stays():
    added, erased = np.zeros((2, 20, 20), dtype=bool)
    added[4, 4] = erased[5, 5] = erased[8, 8] = True
    small = Corrections.from_masks(added, erased).transformed(
        Transform.fit((20, 20), 10)
    )
    assert np.argwhere(small.planes).tolist() == [[0, 2, 2], [1, 4, 4]]


# --- Tiles ----------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [SHAPE, (64, 64), (1, 1), (65, 700), (128, 192)])
@pytest.mark.parametrize("before", [None, 2])
def test_tiles_replace_what_they_hold(shape, before):
    old = Corrections.none(shape) if before is None else some(before, shape)
    new = some(3, shape)
    assert old.with_tiles(tiles(old, new)) == new


def test_tiles_that_are_not_sent_stay_as_they_are():
    old = some(1)
    planes = old.planes
    planes[:, :64, 64:128] = False  # the second tile of the first row
    new = Corrections.from_masks(*planes)
    sent = tiles(old, new)
    assert len(zlib.decompress(sent)) == 1 + 2 * TILE_PX**2 // 8
    assert old.with_tiles(sent) == new
    assert old.with_tiles(tiles(old, old)) == old


def test_pixels_of_a_tile_beyond_the_mask_have_no_effect():
    tile = np.zeros((2, TILE_PX, TILE_PX), dtype=bool)
    tile[0, 10:, 5:] = True
    content = b"\x80" + np.packbits(tile).tobytes()
    drawn = Corrections.none((20, 30)).with_tiles(zlib.compress(content))
    assert drawn.planes[0].sum() == 10 * 25


EVERY_TILE = b"\xfc"  # six flags for 70 x 130 px, high bit first
WHOLE = EVERY_TILE + b"\x00" * 6 * 1024


@pytest.mark.parametrize(
    ("sent", "message"),
    [
        (b"", "cut short"),
        (b"no zlib", "must be zlib data"),
        (zlib.compress(WHOLE)[:-3], "cut short"),
        (zlib.compress(WHOLE + b"\x00"), "may hold 6145 bytes; these hold more"),
        (zlib.compress(WHOLE) + b"more", "must end; 4 bytes follow"),
        (zlib.compress(b""), "must hold 1 bytes of flags"),
        (zlib.compress(WHOLE[:-1]), "for each tile that is set; got 6144 bytes"),
        (zlib.compress(b"\x04" + WHOLE[1:]), "got 6145 bytes"),
        (zlib.compress(b"\x02" + b"\x00" * 1024), "for each tile that is set"),
        (zlib.compress(b"\x80" + b"\xff" * 1024), "added or erased, not both"),
    ],
)
def test_bytes_that_are_no_tiles_are_refused(sent, message):
    with pytest.raises(ParameterError, match=message):
        Corrections.none(SHAPE).with_tiles(sent)


def test_a_bomb_is_not_unpacked():
    bomb = zlib.compress(bytes(50_000_000))
    tracemalloc.start()
    with pytest.raises(ParameterError, match="may hold 6145 bytes; these hold more"):
        Corrections.none(SHAPE).with_tiles(bomb)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1_000_000


# --- Packing --------------------------------------------------------------------------


@given(masks((3, 5)))
def test_a_packed_mask_is_unpacked_as_it_was(mask):
    np.testing.assert_array_equal(unpack_mask(pack_mask(mask), mask.shape), mask)


def test_bits_are_in_the_order_that_the_browser_reads():
    assert zlib.decompress(pack_mask(np.array([[1, 0, 0], [0, 0, 1]]))) == b"\x84"


def test_nothing_unpacks_to_an_empty_mask():
    assert not unpack_mask(b"", (4, 5)).any()


@pytest.mark.parametrize(
    ("packed", "message"),
    [
        (b"junk", "must be zlib data"),
        (pack_mask(np.ones((9, 9), bool)), "may hold 10 bytes; these hold more"),
        (pack_mask(np.ones((2, 3), bool)), r"shape \(8, 10\) must hold 10 bytes; got"),
        (pack_mask(np.ones((8, 10), bool))[:-2], "cut short"),
    ],
)
def test_a_mask_of_another_size_is_refused(packed, message):
    with pytest.raises(ParameterError, match=message):
        unpack_mask(packed, (8, 10))

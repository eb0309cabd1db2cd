"""A commit of the drawing board is checked before it is used."""

import base64
import json
import zlib
from dataclasses import replace

import numpy as np
import pytest

from occsim import Corrections
from occsim.corrections import TILE_PX, pack_mask, unpack_mask
from pages._ui.components.board import (
    MAX_PATH_POINTS,
    BoardDocument,
    BoardMode,
    BoardPoint,
    board_data,
    decode_commit,
)
from tests.boards import committed_tiles

SHAPE = (100, 150)
NOTHING = Corrections.none(SHAPE)


def document(**changes):
    return replace(BoardDocument(height_px=100, width_px=150, token="ours"), **changes)


def box(x, y, width, height):
    """Corrections that add a filled box."""
    added = np.zeros(SHAPE, dtype=bool)
    added[y : y + height, x : x + width] = True
    return Corrections.from_masks(added, np.zeros_like(added))


def commit(corrections, imposed=NOTHING, **changes):
    tiles = committed_tiles(imposed, corrections)
    return {"rev": 0, "token": "ours", "tiles": tiles, **changes}


def path(*points, **changes):
    return {"rev": 0, "token": "ours", "points": list(points), **changes}


def test_committed_tiles_become_the_documents_corrections():
    drawn = decode_commit(commit(box(60, 10, 20, 5)), document(), BoardMode.WALLS)
    assert drawn == document(overlay=box(60, 10, 20, 5))
    assert drawn.mask().sum() == 100


def test_the_mask_is_the_corrected_base():
    base = np.zeros(SHAPE, dtype=bool)
    base[20] = True
    erased = np.zeros(SHAPE, dtype=bool)
    erased[20, :50] = True
    overlay = Corrections.from_masks(np.eye(*SHAPE, dtype=bool) & ~erased, erased)
    shown = document(base=pack_mask(base), overlay=overlay)
    np.testing.assert_array_equal(shown.mask(), overlay.apply(base))


def test_each_commit_is_complete_so_that_one_may_be_lost():
    imposed = document(overlay=box(0, 0, 9, 9))
    first = box(0, 0, 30, 9)
    both = Corrections.from_masks(
        first.planes[0] | box(100, 80, 9, 9).planes[0], first.planes[1]
    )
    last = decode_commit(
        commit(both, imposed.overlay), imposed, mode := BoardMode.WALLS
    )
    assert last.overlay == both
    # Undone changes are as in the imposed document.
    undone = commit(imposed.overlay, imposed.overlay)
    assert decode_commit(undone, imposed, mode) == imposed


def test_committed_points_become_the_documents():
    drawn = decode_commit(
        path([0.5, 1, 1], [150, 100, 0]), document(), BoardMode.TRAJECTORY
    )
    assert drawn.points == (
        BoardPoint(x_px=0.5, y_px=1.0),
        BoardPoint(x_px=150.0, y_px=100.0, is_waypoint=False),
    )


def test_commit_on_an_older_document_is_answered_with_none():
    drawn = commit(box(1, 1, 2, 2))
    assert decode_commit(drawn, document(rev=1), BoardMode.WALLS) is None
    assert decode_commit(drawn, document(token="another"), BoardMode.WALLS) is None


@pytest.mark.parametrize(
    "bad",
    [
        None,
        "commit",
        [],
        {},
        {"rev": 0, "token": "ours"},
        commit(NOTHING, tiles=7),
        commit(NOTHING, tiles=["eJw="]),
        commit(NOTHING, tiles="not base64"),
        commit(NOTHING, tiles="ééé="),
        commit(NOTHING, tiles="AAAA" * 10_000),
        commit(NOTHING, tiles=base64.b64encode(b"no zlib").decode()),
        commit(NOTHING, tiles=committed_tiles(NOTHING, box(1, 1, 9, 9))[:-8]),
        commit(NOTHING, rev=[[[0]]]),
    ],
)
def test_anything_but_tiles_is_refused_on_walls(bad):
    assert decode_commit(bad, document(), BoardMode.WALLS) is None


def test_the_whole_of_a_drawing_may_be_scribbled_over():
    """The largest commit: every tile, its pixels without any order."""
    added = np.random.default_rng(1).random(SHAPE) < 0.5
    scribble = Corrections.from_masks(added, ~added)
    drawn = decode_commit(commit(scribble), document(), BoardMode.WALLS)
    assert drawn.overlay == scribble


def test_a_commit_longer_than_its_drawing_allows_is_not_decoded():
    drawn = commit(box(1, 1, 9, 9))
    packed = zlib.compress(zlib.decompress(base64.b64decode(drawn["tiles"])), level=0)
    # Empty blocks after the header of two bytes: valid, and as long as one likes.
    for n_blocks, is_taken in ((5, True), (5000, False)):
        padded = packed[:2] + b"\x00\x00\x00\xff\xff" * n_blocks + packed[2:]
        tiles = base64.b64encode(padded).decode()
        taken = decode_commit(drawn | {"tiles": tiles}, document(), BoardMode.WALLS)
        assert (taken is not None) == is_taken


@pytest.mark.parametrize(
    "points",
    [
        None,
        "12",
        [7],
        [[1, 2]],
        [[1, 2, 3]],
        [[True, 2, 1]],
        [[1, 2, True]],
        [[1, 2, 1.0]],
        [[-1, 2, 1]],
        [[150.25, 2, 1]],
        [[2, 100.25, 1]],
        [[float("nan"), 2, 1]],
        [["1", "2", "1"]],
        [[1, 2, 1]] * (MAX_PATH_POINTS + 1),
    ],
)
def test_anything_but_points_in_the_drawing_is_refused_on_paths(points):
    bad = path() | {"points": points}
    assert decode_commit(bad, document(), BoardMode.TRAJECTORY) is None


@pytest.mark.parametrize("n", [1, 3])
def test_length_and_crop_have_two_points_or_none(n):
    bad = path(*[[1, 1, 1]] * n)
    assert decode_commit(bad, document(), BoardMode.MEASURE) is None
    assert decode_commit(bad, document(), BoardMode.CROP) is None


def test_browser_gets_header_drawing_walls_corrections_and_doubts_in_this_order():
    base = pack_mask(np.ones(SHAPE, dtype=bool))
    doubtful = pack_mask(np.zeros(SHAPE, dtype=bool))
    overlay = box(3, 4, 5, 6)
    data = board_data(
        b"picture",
        document(
            base=base,
            overlay=overlay,
            doubtful=doubtful,
            points=(BoardPoint(x_px=1.5, y_px=2),),
        ),
        mode=BoardMode.WALLS,
        key="board",
    )
    length = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + length])
    sent = data[4 + length :]
    assert sent == b"picture" + base + overlay.packed + doubtful
    assert header["sizes"] == [7, len(base), len(overlay.packed), len(doubtful)]
    assert (header["width"], header["height"]) == (150, 100)
    assert header["tilePx"] == TILE_PX
    assert header["points"] == [[1.5, 2, 1]]
    corrections = sent[7 + len(base) : -len(doubtful)]
    planes = unpack_mask(corrections, (2, *SHAPE))
    np.testing.assert_array_equal(planes, overlay.planes)


def test_same_document_gives_the_same_bytes():
    given = {"mode": BoardMode.WALLS, "key": "board"}
    assert board_data(b"", document(), **given) == board_data(b"", document(), **given)

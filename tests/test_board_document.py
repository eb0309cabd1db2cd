"""What a browser commits from the drawing board is checked before it is believed."""

import json
from dataclasses import replace

import numpy as np
import pytest

from occsim.strokes import Stroke, StrokeKind, encode_strokes, pack_mask
from pages._ui.components.board import (
    FOLD_ABOVE,
    KEEP,
    MAX_PATH_POINTS,
    BoardDocument,
    BoardMode,
    BoardPoint,
    board_data,
    decode_commit,
)


def document(**changes):
    return replace(BoardDocument(height_px=30, width_px=40, token="ours"), **changes)


def dots(n, start=0):
    return tuple(
        Stroke(
            kind=StrokeKind.BRUSH,
            points=(((i + start) % 40 + 0.5, (i + start) // 40 + 0.5),),
        )
        for i in range(n)
    )


def commit(strokes=(), first=0, **changes):
    encoded = json.loads(json.dumps(encode_strokes(strokes)))
    return {"rev": 0, "token": "ours", "first": first, "strokes": encoded, **changes}


def path(*points, **changes):
    return {"rev": 0, "token": "ours", "points": list(points), **changes}


def test_committed_strokes_become_the_documents():
    drawn = decode_commit(commit(dots(3)), document(), BoardMode.WALLS)
    assert drawn == document(strokes=dots(3))
    assert drawn.mask().sum() == 3


def test_committed_points_become_the_documents():
    drawn = decode_commit(
        path([2, 4, 1], [160, 120, 0]), document(), BoardMode.TRAJECTORY
    )
    assert drawn.points == (
        BoardPoint(x_px=0.5, y_px=1.0),
        BoardPoint(x_px=40.0, y_px=30.0, is_waypoint=False),
    )


def test_commit_on_an_older_document_is_answered_with_none():
    assert decode_commit(commit(dots(1)), document(rev=1), BoardMode.WALLS) is None
    other = document(token="another")
    assert decode_commit(commit(dots(1)), other, BoardMode.WALLS) is None


@pytest.mark.parametrize(
    "bad",
    [
        None,
        "commit",
        [],
        {},
        {"rev": 0, "token": "ours"},
        commit(first=-1),
        commit(first=1),
        commit(first=True),
        commit(first="0"),
        commit() | {"strokes": "brush"},
        commit() | {"strokes": [["spray", 4, 1, 1]]},
        commit() | {"strokes": [["brush", 4, 10**9, 1]]},
        commit() | {"strokes": [["brush", 4, 1, 1]] * 5000},
    ],
)
def test_anything_but_strokes_is_refused_on_walls(bad):
    assert decode_commit(bad, document(), BoardMode.WALLS) is None


@pytest.mark.parametrize(
    "points",
    [
        None,
        "12",
        [7],
        [[1, 2]],
        [[1, 2, 3]],
        [[1.5, 2, 1]],
        [[True, 2, 1]],
        [[-1, 2, 1]],
        [[161, 2, 1]],
        [[2, 121, 1]],
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


def test_folding_keeps_the_mask_and_the_newest_strokes():
    base = np.zeros((30, 40), dtype=bool)
    base[20] = True
    full = document(base=pack_mask(base), strokes=dots(FOLD_ABOVE + 1))
    assert full.should_fold
    folded = full.folded()
    assert not folded.should_fold
    assert folded.strokes == full.strokes[-KEEP:]
    assert folded.first == FOLD_ABOVE + 1 - KEEP
    assert folded.rev == full.rev
    assert (folded.mask() == full.mask()).all()


def test_long_scribbles_are_folded_before_there_are_many():
    corners = tuple((x % 40 + 0.5, x % 30 + 0.5) for x in range(3000))
    scribble = Stroke(kind=StrokeKind.BRUSH, points=corners)
    full = document(strokes=(scribble,) * 7)
    assert full.should_fold
    folded = full.folded()
    assert (folded.first, len(folded.strokes)) == (4, 3)
    assert not folded.should_fold
    assert (folded.mask() == full.mask()).all()


def test_few_strokes_are_not_folded():
    few = document(strokes=dots(KEEP))
    assert few.folded() is few


def test_commit_under_way_while_strokes_were_folded_loses_and_repeats_nothing():
    folded = document(strokes=dots(FOLD_ABOVE + 1)).folded()
    late = decode_commit(commit(dots(FOLD_ABOVE + 5)), folded, BoardMode.WALLS)
    assert late.strokes == dots(KEEP + 4, start=folded.first)
    assert late.first == folded.first


def test_browser_gets_header_drawing_and_mask_in_this_order():
    base = pack_mask(np.ones((30, 40), dtype=bool))
    data = board_data(
        b"picture",
        document(base=base, strokes=dots(2)),
        mode=BoardMode.WALLS,
        key="board",
    )
    length = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + length])
    assert header["imageBytes"] == len(b"picture")
    assert header["strokes"] == encode_strokes(dots(2))
    assert (header["width"], header["height"]) == (40, 30)
    assert data[4 + length :] == b"picture" + base


def test_same_document_gives_the_same_bytes():
    given = {"mode": BoardMode.WALLS, "key": "board"}
    assert board_data(b"", document(), **given) == board_data(b"", document(), **given)

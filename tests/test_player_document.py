"""The data sent to the player, and the checks on its commits."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import BehindHit, UpdateRule
from occsim.logodds import DECISION_EPS
from pages._ui.choices import Flaw, Overlay, PriorDrawing
from pages._ui.columns import MAX_COLUMNS, Column
from pages._ui.components.player import (
    SPEEDS,
    Part,
    PlayerDocument,
    Replay,
    decode_commit,
    encode_document,
    held_parts,
    player_data,
)
from pages._ui.settings import TABLE
from tests.test_settings import ANY_COLUMN

ONE = PlayerDocument(rev=4, step=12)
SEVERAL = PlayerDocument(rev=4, step=12, columns=(Column(), Column()))
REPLAY = Replay(
    "base",
    (Part("scene", "", b"replay"), Part("log", "occupied 3", b"readings")),
    (PriorDrawing.OWN,),
)


def documents(columns):
    return st.builds(
        PlayerDocument,
        rev=st.just(4),
        columns=columns,
        overlay=st.sampled_from(Overlay),
        step=st.integers(0, 5000),
        speed=st.none() | st.sampled_from(SPEEDS),
        pin_px=st.none() | st.tuples(st.floats(0, 4000), st.floats(0, 4000)),
        predicted=st.none() | st.integers(0, MAX_COLUMNS),
    )


one_map = documents(st.tuples(ANY_COLUMN))
several_maps = documents(st.lists(ANY_COLUMN, min_size=2, max_size=3).map(tuple))
json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner),
    max_leaves=6,
)


@pytest.mark.parametrize(("kind", "imposed"), [(one_map, ONE), (several_maps, SEVERAL)])
@given(data=st.data())
def test_a_commit_comes_back_as_it_was_chosen(kind, imposed, data):
    document = data.draw(kind)
    commit = json.loads(json.dumps(encode_document(document)))
    assert decode_commit(commit, imposed) == document


names = st.sampled_from(list(encode_document(ONE)))
column_names = st.sampled_from(list(encode_document(ONE)["columns"][0]))
any_columns = st.lists(st.dictionaries(column_names, json_values), max_size=4)


@pytest.mark.parametrize("imposed", [ONE, SEVERAL])
@given(st.dictionaries(names, json_values), json_values | any_columns)
def test_whatever_is_committed_the_document_stays_within_bounds(
    imposed, commit, columns
):
    document = decode_commit({**commit, "columns": columns, "rev": 4}, imposed)
    assert document.rev == 4
    assert len(document.columns) in ((1,) if imposed is ONE else (2, 3))
    for column in document.columns:
        assert_column_is_valid(column)
    assert isinstance(document.overlay, Overlay)
    assert isinstance(document.step, int)
    assert document.step >= 0
    assert document.speed is None or document.speed in SPEEDS
    assert document.pin_px is None or all(map(math.isfinite, document.pin_px))
    assert document.predicted is None or 0 <= document.predicted <= MAX_COLUMNS
    assert document.compact is False


def assert_column_is_valid(column):
    for name in ("p_wall", "p_space", "cell_px"):
        assert TABLE[name].low <= getattr(column, name) <= TABLE[name].high
    assert isinstance(column.cell_px, int)
    assert isinstance(column.uninformative, bool)
    assert isinstance(column.calibrated, bool)
    assert isinstance(column.rule, UpdateRule)
    assert isinstance(column.behind_hit, BehindHit)
    assert isinstance(column.flaw, Flaw)
    assert isinstance(column.prior_drawing, PriorDrawing)


@given(json_values)
def test_what_is_no_document_changes_nothing(commit):
    assert decode_commit(commit, ONE) == ONE


def test_a_commit_on_an_older_document_is_ignored():
    late = encode_document(PlayerDocument(rev=3, columns=(Column(p_wall=0.7),)))
    assert decode_commit(late, ONE) == ONE


@pytest.mark.parametrize("value", [0.0, 1.5, -1, "much", None, math.nan, 10**400, []])
def test_a_prior_out_of_bounds_keeps_the_one_that_was_imposed(value):
    commit = {"rev": 4, "columns": [{"p_wall": value}]}
    assert decode_commit(commit, ONE).columns == ONE.columns


def parts_of(data):
    """The header and the payloads of what is sent."""
    size = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + size])
    payloads, at = [], 4 + size
    for one in header["sizes"]:
        payloads.append(data[at : at + one])
        at += one
    return header, payloads


def test_header_and_parts_travel_as_one_string_of_bytes():
    header, payloads = parts_of(player_data(REPLAY, ONE, key="here"))
    assert payloads == [b"replay", b"readings"]
    assert [part["name"] for part in header["parts"]] == ["", "occupied 3"]
    assert header["key"] == "here"
    assert header["document"] == encode_document(ONE)
    constants = header["constants"]
    assert (constants["decisionEps"], constants["priorScale"]) == (DECISION_EPS, 0.9)
    # gmapping's threshold, and the log-odds of a clear reading: ln 9.
    assert constants["occupiedAbove"] == 0.25
    assert constants["declared"] == pytest.approx(math.log(9))


def test_a_part_that_the_browser_holds_is_named_but_not_sent_again():
    held = held_parts({"held": [REPLAY.parts[1].id, 7, None]})
    header, payloads = parts_of(player_data(REPLAY, ONE, "here", held))
    assert payloads == [b"replay", b""]
    assert header["parts"][1]["id"] == REPLAY.parts[1].id


@given(json_values)
def test_what_a_browser_says_that_it_holds_is_not_trusted(said):
    assert all(isinstance(one, str) for one in held_parts({"held": said}))
    held_parts(said)


def test_equal_input_gives_equal_bytes_so_that_nothing_is_sent_again():
    first, second = (player_data(REPLAY, ONE, key="here") for _ in range(2))
    assert first == second
    other = Replay("base", (Part("scene", "", b"other"),), REPLAY.drawings)
    assert player_data(other, ONE, key="here") != first


def digest(replay):
    return parts_of(player_data(replay, ONE, key="here"))[0]["digest"]


def test_the_digest_tells_replays_apart_by_parts_and_base():
    other = Replay("another", REPLAY.parts, REPLAY.drawings)
    fewer = Replay("base", REPLAY.parts[:1], REPLAY.drawings)
    assert len({digest(one) for one in (REPLAY, other, fewer)}) == 3

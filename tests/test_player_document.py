"""The data sent to the player, and the checks on its commits."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import Region, UpdateRule
from occsim.logodds import DECISION_EPS
from pages._ui.choices import Overlay
from pages._ui.components.player import (
    SPEEDS,
    PlayerDocument,
    decode_commit,
    encode_document,
    player_data,
)
from pages._ui.settings import TABLE

IMPOSED = PlayerDocument(rev=4, step=12)

documents = st.builds(
    PlayerDocument,
    rev=st.just(4),
    p_wall=st.floats(TABLE["p_wall"].low, TABLE["p_wall"].high),
    p_space=st.floats(TABLE["p_space"].low, TABLE["p_space"].high),
    uninformative=st.booleans(),
    rule=st.sampled_from(UpdateRule),
    region=st.sampled_from(Region),
    overlay=st.sampled_from(Overlay),
    step=st.integers(0, 5000),
    speed=st.sampled_from(SPEEDS),
    pin_px=st.none() | st.tuples(st.floats(0, 4000), st.floats(0, 4000)),
)
json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner),
    max_leaves=6,
)


@given(documents)
def test_a_commit_comes_back_as_it_was_chosen(document):
    commit = json.loads(json.dumps(encode_document(document)))
    assert decode_commit(commit, IMPOSED) == document


@given(st.dictionaries(st.sampled_from(list(encode_document(IMPOSED))), json_values))
def test_whatever_is_committed_the_document_stays_within_bounds(commit):
    document = decode_commit({**commit, "rev": 4}, IMPOSED)
    assert document.rev == 4
    for name in ("p_wall", "p_space"):
        assert TABLE[name].low <= getattr(document, name) <= TABLE[name].high
    assert isinstance(document.uninformative, bool)
    assert isinstance(document.rule, UpdateRule)
    assert isinstance(document.region, Region)
    assert isinstance(document.overlay, Overlay)
    assert isinstance(document.step, int)
    assert document.step >= 0
    assert document.speed is None or document.speed in SPEEDS
    assert document.pin_px is None or all(map(math.isfinite, document.pin_px))
    assert document.compact is False


@given(json_values)
def test_what_is_no_document_changes_nothing(commit):
    assert decode_commit(commit, IMPOSED) == IMPOSED


def test_a_commit_on_an_older_document_is_ignored():
    late = encode_document(PlayerDocument(rev=3, p_wall=0.7))
    assert decode_commit(late, IMPOSED) == IMPOSED


@pytest.mark.parametrize("value", [0.0, 1.5, -1, "much", None, math.nan, 10**400, []])
def test_a_prior_out_of_bounds_keeps_the_one_that_was_imposed(value):
    assert decode_commit({"rev": 4, "p_wall": value}, IMPOSED).p_wall == IMPOSED.p_wall


def test_header_and_replay_travel_as_one_string_of_bytes():
    data = player_data(b"replay", IMPOSED, key="here")
    size = int.from_bytes(data[:4], "little")
    header = json.loads(data[4 : 4 + size])
    assert data[4 + size :] == b"replay"
    assert header["key"] == "here"
    assert header["document"] == encode_document(IMPOSED)
    assert header["constants"] == {"decisionEps": DECISION_EPS, "priorScale": 0.9}


def test_equal_input_gives_equal_bytes_so_that_nothing_is_sent_again():
    first, second = (player_data(b"replay", IMPOSED, key="here") for _ in range(2))
    assert first == second
    assert player_data(b"other", IMPOSED, key="here") != first

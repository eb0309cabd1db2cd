"""Votes and classes in the server's memory: counted right, bounded, gone in time."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pages._ui.classroom import rooms as module
from pages._ui.classroom.kept import ALPHABET, Classes, new_code, typed
from pages._ui.classroom.prepared import (
    MAX_BYTES,
    MAX_LINK,
    ClassError,
    Prepared,
    from_json,
    packed,
    to_json,
    unpacked,
)
from pages._ui.classroom.rooms import MAX_VOTERS, RoomError, Rooms
from pages._ui.limits import NAMES

OPTIONS = ("yes", "no", "only once")


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


# --- Rooms ----------------------------------------------------------------------------


def test_a_hundred_votes_in_one_burst_are_counted_right():
    """Each of 100 voters in turn changes once; voter i ends at option i % 3."""
    rooms = Rooms()
    code, key = rooms.open("Will it?", OPTIONS)

    def vote(i):
        rooms.answer(code, f"voter {i}", (i + 1) % 3)
        rooms.answer(code, f"voter {i}", i % 3)

    with ThreadPoolExecutor(32) as pool:
        list(pool.map(vote, range(100)))
    rooms.show(code, key)
    seen = rooms.seen(code)
    assert (seen.n_answers, seen.counts) == (100, (34, 33, 33))


def test_the_counts_are_unknown_until_they_are_shown():
    rooms = Rooms()
    code, key = rooms.open("Will it?", OPTIONS)
    rooms.answer(code, "a", 2)
    assert rooms.seen(code, "a") == module.Seen("Will it?", OPTIONS, 1, None, 2)
    rooms.show(code, key)
    assert rooms.seen(code, "b").counts == (0, 0, 1)
    rooms.show(code, key, shown=False)
    assert rooms.seen(code).counts is None


def test_an_answer_after_they_are_shown_is_refused():
    rooms = Rooms()
    code, key = rooms.open("Will it?", OPTIONS)
    rooms.answer(code, "a", 0)
    rooms.show(code, key)
    with pytest.raises(RoomError, match="shown already"):
        rooms.answer(code, "a", 1)
    assert rooms.seen(code).counts == (1, 0, 0)


def test_only_who_opened_a_room_can_show_it():
    rooms = Rooms()
    code, key = rooms.open("Will it?", OPTIONS)
    for wrong in ("", key[:-1], key + "0", "\ud800"):
        with pytest.raises(RoomError, match="Only the person who opened"):
            rooms.show(code, wrong)
    assert rooms.seen(code).counts is None


@pytest.mark.parametrize("option", [-1, 3, 10**9])
def test_an_option_that_is_not_there_is_refused(option):
    rooms = Rooms()
    code, _ = rooms.open("Will it?", OPTIONS)
    with pytest.raises(RoomError, match="no such option"):
        rooms.answer(code, "a", option)


def test_a_room_is_gone_after_three_hours():
    clock = Clock()
    rooms = Rooms(timer=clock)
    code, _ = rooms.open("Will it?", OPTIONS)
    clock.now = 3 * 3600 - 1
    rooms.answer(code, "a", 0)  # an answer does not make it last longer
    clock.now = 3 * 3600 + 1
    assert rooms.seen(code) is None
    with pytest.raises(RoomError, match="closed"):
        rooms.answer(code, "a", 0)


def test_too_many_rooms_close_none_that_is_open():
    clock = Clock()
    rooms = Rooms(max_rooms=2, timer=clock)
    first, _ = rooms.open("Will it?", OPTIONS)
    rooms.open("Will it?", OPTIONS)
    with pytest.raises(RoomError, match="Too many"):
        rooms.open("Will it?", OPTIONS)
    assert rooms.seen(first)
    clock.now = 3 * 3600 + 1
    rooms.open("Will it?", OPTIONS)


def test_a_room_has_room_for_so_many_and_those_in_it_may_change():
    rooms = Rooms()
    code, _ = rooms.open("Will it?", OPTIONS)
    for i in range(MAX_VOTERS):
        rooms.answer(code, str(i), 0)
    with pytest.raises(RoomError, match="full"):
        rooms.answer(code, "one more", 0)
    rooms.answer(code, "0", 1)
    assert rooms.seen(code).n_answers == MAX_VOTERS


@pytest.mark.parametrize(
    ("question", "options", "why"),
    [
        ("", OPTIONS, "question"),
        ("x" * 301, OPTIONS, "question"),
        ("Will it?", ("yes", " "), "2 to 5 options"),
        ("Will it?", "abcdef", "2 to 5 options"),
        ("Will it?", ("yes", "y" * 81), "80 characters"),
        ("Will it?", ("yes", "yes "), "the same"),
    ],
)
def test_a_question_that_cannot_be_asked_is_refused(question, options, why):
    with pytest.raises(RoomError, match=why):
        Rooms().open(question, options)


# --- Classes --------------------------------------------------------------------------

texts = st.text(max_size=30)
classes = st.builds(
    Prepared,
    page=texts,
    texts=st.dictionaries(texts, texts, max_size=5),
    hide=st.lists(st.sampled_from(sorted(NAMES)), max_size=5).map(tuple),
    lock=st.lists(st.sampled_from(sorted(NAMES)), max_size=5).map(tuple),
    exercises=st.lists(texts, max_size=3).map(tuple),
)


@given(prepared=classes)
def test_a_class_comes_back_as_it_was_prepared(prepared):
    assert from_json(to_json(prepared)) == prepared
    assert unpacked(packed(prepared)) == prepared
    kept = Classes()
    assert kept.find(kept.keep(prepared)) == prepared


@given(prepared=classes, at=st.integers(0, 10**6), char=st.sampled_from("abcXYZ019-_"))
def test_an_edited_link_of_a_class_is_refused(prepared, at, char):
    text = packed(prepared)
    at %= len(text)
    edited = text[:at] + char + text[at + 1 :]
    if edited != text:
        with pytest.raises(ClassError, match="cut or edited"):
            unpacked(edited)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"[]",
        b"{}",
        b"[" * 5000,
        b'{"page": 1, "texts": {}, "hide": [], "lock": [], "exercises": []}',
        b'{"page": "a", "texts": {"a": 1}, "hide": [], "lock": [], "exercises": []}',
        b'{"page": "a", "texts": {}, "hide": [1], "lock": [], "exercises": []}',
        b'{"page": "a", "texts": {}, "hide": "rule", "lock": [], "exercises": []}',
        b'{"page": "a", "texts": {}, "hide": ["x"], "lock": [], "exercises": []}',
        b" " * (MAX_BYTES + 1),
        b"\xff",
    ],
)
def test_what_is_no_class_is_refused(content):
    with pytest.raises(ClassError):
        from_json(content)


def test_a_class_that_is_too_long_for_a_link_has_none():
    many = tuple(new_code(900) for _ in range(20))
    prepared = Prepared(page="x", exercises=many)
    assert packed(prepared) is None
    assert len(packed(Prepared(page="x"))) < MAX_LINK


def test_classes_are_bounded_in_bytes_and_the_oldest_goes_first():
    one = Prepared(page="x" * 1000)
    kept = Classes(max_bytes=2500)
    first, second, third = (kept.keep(one) for _ in range(3))
    assert kept.find(first) is None
    assert kept.find(second) == kept.find(third) == one


def test_a_class_larger_than_the_bound_is_refused():
    with pytest.raises(ClassError, match="at most"):
        Classes().keep(Prepared(page="x" * MAX_BYTES))


def test_a_code_is_read_as_it_is_typed_on_a_telephone():
    code = new_code()
    assert len(code) == 12
    assert set(code) <= set(ALPHABET)
    dashed = f" {code[:4]}-{code[4:8]} {code[8:]}".upper()
    assert typed(dashed) == code

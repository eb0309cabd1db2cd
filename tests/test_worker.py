"""The process that opens uploaded drawings."""

import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from occsim import OccsimError, load_drawing
from occsim.building import building_from_drawing
from pages._ui import worker
from pages._ui.worker import Workers
from tests.test_pages import png, rooms


@pytest.fixture
def one():
    made = Workers(1)
    yield made
    made.end()


def drawing(width=220):
    return load_drawing(png(rooms(160, width)), name="own plan")


def test_it_opens_a_drawing_as_this_process_would(one):
    here = building_from_drawing(drawing(), working_px=120)
    there = one.open_drawing(drawing(), 120)
    assert there.digest == here.digest
    assert there.title == "own plan"
    np.testing.assert_array_equal(there.trajectory.poses, here.trajectory.poses)
    # What was planned is renewed when the building is turned or cropped.
    assert there.trajectory is there.tour


def test_a_refusal_is_the_same_sentence_and_the_process_goes_on(one):
    with pytest.raises(OccsimError) as here:
        building_from_drawing(drawing(), working_px=0)
    for _ in range(2):
        with pytest.raises(type(here.value)) as there:
            one.open_drawing(drawing(), 0)
        assert str(there.value) == str(here.value)
    process = one._all[0]._process
    one.open_drawing(drawing(), 1500)
    assert one._all[0]._process is process


def test_callers_wait_for_each_other_and_each_gets_their_own(one):
    with ThreadPoolExecutor(4) as threads:
        made = list(
            threads.map(lambda i: one.open_drawing(drawing(220 + i), 1500), range(4))
        )
    assert [one.drawing.shape[1] for one in made] == [220, 221, 222, 223]


def test_a_drawing_is_opened_though_the_process_was_killed(one):
    one.open_drawing(drawing(), 1500)
    first = one._all[0]._process
    first.kill()
    first.wait()
    assert one.open_drawing(drawing(), 1500).drawing.shape == (160, 220)
    assert one._all[0]._process is not first


def test_a_process_that_dies_at_work_is_replaced_by_this_one(one, monkeypatch):
    monkeypatch.setattr(worker.sys, "executable", "/none")
    assert one.open_drawing(drawing(), 1500).drawing.shape == (160, 220)


def test_other_threads_run_while_a_drawing_is_opened(one):
    """A slider's run needs this process; an upload may not hold it up."""
    big = load_drawing(png(rooms(900, 1400)))
    one.open_drawing(drawing(), 1500)
    with ThreadPoolExecutor(1) as threads:
        start = time.process_time()
        threads.submit(one.open_drawing, big, 1500).result()
        spent = time.process_time() - start
    start = time.process_time()
    building_from_drawing(big)
    assert spent < 0.3 * (time.process_time() - start)


def test_it_can_be_started_before_there_is_a_drawing(one):
    one.start_early()
    process = one._all[0]._process
    one.start_early()
    assert one._all[0]._process is process
    assert one.open_drawing(drawing(), 1500).title == "own plan"
    assert one._all[0]._process is process


def test_another_process_is_started_only_where_all_are_at_work():
    two = Workers(2)
    try:
        for _ in range(2):
            two.call(time.sleep, 0.0)
        assert [each._process is None for each in two._all] == [False, True]
        with ThreadPoolExecutor(2) as threads:
            list(threads.map(lambda _: two.call(time.sleep, 0.5), range(2)))
        assert [each._process is None for each in two._all] == [False, False]
    finally:
        two.end()

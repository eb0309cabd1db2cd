"""The clients of the load script reach the app as a browser does."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.browser.running import no_complaint, running_app
from tests.load import machine, students
from tests.load.__main__ import faults, table, tracebacks
from tests.load.client import client_at
from tests.load.students import ACTIONS, Round


@pytest.mark.browser
def test_a_student_does_all_that_a_round_asks_and_a_refusal_is_seen(tmp_path):
    log = tmp_path / "server.log"
    turn = Round(number=1, think_s=(0.0, 0.0))

    async def visit(url: str) -> None:
        async with client_at(url, seed=1) as client:
            await turn.student(client, place=0)
            assert client.refused == ""
            # The drawing is used: it has no scale, as the sample did.
            assert ("slider", "Range (px)") in client.widgets
            await client.upload("plan.pdf", b"%PDF-1.4 and no more")
            assert "plan.pdf" in client.refused.replace("\\", "")
            await client.open(students.LENS)
            assert "sensor_lens" in client.components
            await client.open(students.TWO_MAPS)
            assert "map_player" in client.components

    with running_app(log) as url, ThreadPoolExecutor(1) as pool:
        # In a thread of its own: another test's browser may have a loop running here.
        pool.submit(asyncio.run, visit(url)).result()
        pid = machine.server_at(url)
        assert machine.memory_mb(pid) > 100
        assert len(machine.children(pid)) >= 1
    no_complaint(log)
    assert {what: len(turn.seconds[what]) for what in ACTIONS} == {
        **dict.fromkeys(ACTIONS, 1),
        students.SAME: 2,
        students.OWN: 2,
    }
    assert all(what in table([turn]) for what in ACTIONS)


def rounds_of(seconds: float) -> list[Round]:
    turn = Round(number=1, think_s=(0.0, 0.0))
    for what in ACTIONS:
        turn.seconds[what] = [seconds] * 20
    return [turn]


def test_times_and_memory_within_the_aims_are_no_fault():
    memory_mb = [250, 400, 420, 430, 430]
    assert faults(rounds_of(0.5), memory_mb, n_clients=10) == []


@pytest.mark.parametrize(
    ("seconds", "memory_mb", "said"),
    [
        (1.2, [250, 400, 400, 400], ["slider, all the same: p95 1.20 s"]),
        (0.5, [250, 610, 610, 610], ["the server has 610 MB"]),
        (0.5, [100, 510, 510, 510], ["41 MB a session"]),
        (0.5, [250, 300, 310, 320, 340, 350], ["memory grows: from 320 to 350 MB"]),
    ],
)
def test_each_aim_that_is_missed_is_said(seconds, memory_mb, said):
    found = faults(rounds_of(seconds), memory_mb, n_clients=10)
    assert len(found) == len(said)
    assert all(a.startswith(b) for a, b in zip(found, said, strict=True))


def test_a_traceback_in_the_log_is_a_fault():
    assert tracebacks("started\nstopping\n") == []
    assert tracebacks("started\nTraceback (most\n  line\n") == [
        "Traceback (most\n  line\n"
    ]

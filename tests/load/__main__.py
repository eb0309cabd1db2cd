"""A class of students on one server: ``python -m tests.load --clients 30``.

Each opens the home page, the lens, two maps and a map of its own, moves sliders as the
teacher says, uploads a drawing that nobody else has and moves sliders on it, and thinks
in between. Printed are p50 and p95 of each action, the server's memory after each
round, and whether that is within the aims. Ends with 1 where it is not.
"""

import argparse
import asyncio
import os
import sys
import tempfile
from contextlib import AsyncExitStack
from pathlib import Path

import numpy as np

from tests.browser.running import running_app
from tests.load import students
from tests.load.attack import attack
from tests.load.client import Client, client_at
from tests.load.machine import memory_mb, server_at
from tests.load.students import ACTIONS, Round

AIMS_S = {
    students.OPEN_HOME: 1.5,
    students.SAME: 1.0,
    students.OWN: 4.0,
    students.UPLOAD: 2.5,
}
"""Longest p95 of an action, s."""
MAX_MB, MAX_SESSION_MB = 600, 40
"""Most memory of the server with its decoders, and what a session may add to it, MB."""
FLAT = 0.05
"""Most growth over the second half of the rounds, as a share."""


def line_of(what: str, seconds: list[float]) -> str:
    """One action: how often it was done, and its p50 and p95."""
    p50, p95 = np.percentile(seconds, (50, 95))
    aim = f"  (aim {AIMS_S[what]:.1f})" if what in AIMS_S else ""
    return f"  {what:24} {len(seconds):4} times  {p50:5.2f}  {p95:5.2f} s{aim}"


def table(rounds: list[Round]) -> str:
    """Every action of some rounds, a line each."""
    lines = [f"  {'':24}             p50    p95"]
    for what in ACTIONS:
        all_of_them = [one for turn in rounds for one in turn.seconds[what]]
        lines += [line_of(what, all_of_them)] if all_of_them else []
    return "\n".join(lines)


def faults(rounds: list[Round], used_mb: list[float], n_clients: int) -> list[str]:
    """The aims that were missed, in a sentence each; the first memory is of no one."""
    found = []
    for what, aim_s in AIMS_S.items():
        p95 = np.percentile([one for turn in rounds for one in turn.seconds[what]], 95)
        if p95 > aim_s:
            found.append(f"{what}: p95 {p95:.2f} s, aim {aim_s} s")
    empty, *after = used_mb
    if after[-1] > MAX_MB:
        found.append(f"the server has {after[-1]:.0f} MB, aim {MAX_MB} MB")
    a_session = (after[-1] - empty) / n_clients
    if a_session > MAX_SESSION_MB:
        found.append(f"{a_session:.0f} MB a session, aim {MAX_SESSION_MB} MB")
    middle = after[(len(after) - 1) // 2]
    if after[-1] > (1 + FLAT) * middle:
        found.append(f"memory grows: from {middle:.0f} to {after[-1]:.0f} MB")
    return found


async def take_rounds(
    clients: list[Client], n_rounds: int, think_s: tuple[float, float], pid: int
) -> tuple[list[Round], list[float]]:
    """Run the rounds, a line each; their times, and the memory after each, MB."""
    rounds, used_mb = [], []
    for number in range(1, n_rounds + 1):
        turn = Round(number, think_s)
        await asyncio.gather(
            *(turn.student(one, place) for place, one in enumerate(clients))
        )
        rounds.append(turn)
        used_mb.append(memory_mb(pid))
        busy = f"machine {os.getloadavg()[0]:.1f} busy"
        print(f"round {number}: server {used_mb[-1]:.0f} MB, {busy}", flush=True)
        print(table([turn]), flush=True)
    return rounds, used_mb


async def warm(url: str) -> None:
    """Open each page once: the first visitor waits for imports."""
    async with client_at(url, seed=0) as client:
        for page in (students.HOME, students.LENS, students.TWO_MAPS, students.MAP):
            await client.open(page)


async def measure(url: str, options: argparse.Namespace) -> list[str]:
    """Run all rounds, print what they took, and return the aims that were missed."""
    pid = server_at(url)
    await warm(url)
    empty_mb = memory_mb(pid)
    print(f"without students: server {empty_mb:.0f} MB", flush=True)
    async with AsyncExitStack() as stack:
        clients = [
            await stack.enter_async_context(client_at(url, seed))
            for seed in range(options.clients)
        ]
        think_s = options.think / 2, options.think * 3 / 2
        taken = await take_rounds(clients, options.rounds, think_s, pid)
        if options.hostile:
            await attack(clients[0], clients[1 : 1 + options.hostile])
    rounds, used_mb = taken
    print(f"all rounds of {len(clients)} clients\n{table(rounds)}")
    print("  memory by round, MB: " + " ".join(f"{mb:.0f}" for mb in used_mb))
    print(f"  a session: {(used_mb[-1] - empty_mb) / len(clients):.1f} MB")
    return faults(rounds, [empty_mb, *used_mb], len(clients))


def tracebacks(log: str) -> list[str]:
    """What the server logged from the first traceback on, cut short; empty if none."""
    where = log.find("Traceback")
    return [log[where : where + 3000]] if where >= 0 else []


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m tests.load",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--clients", type=int, default=30)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument(
        "--think", type=float, default=10.0, help="mean time between two actions, s"
    )
    parser.add_argument(
        "--hostile",
        type=int,
        default=0,
        metavar="N",
        help="afterwards upload hostile files while N clients move sliders",
    )
    parser.add_argument("--url", help="a server on this machine; one is started else")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    if options.url:
        missed = asyncio.run(measure(options.url, options))
    else:
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "server.log"
            with running_app(log) as url:
                missed = asyncio.run(measure(url, options))
            missed += tracebacks(log.read_text())
    print("\n".join(missed) if missed else "every aim is met")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())

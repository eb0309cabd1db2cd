"""One line of the benchmark's table, and how its time is taken."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Row:
    """One figure, the figure aimed at, and what it is compared with.

    Each module of this folder that has a function ``rows() -> Iterable[Row]`` is part
    of the table.
    """

    what: str
    ours: str
    aim: str
    beside: str = ""
    reached: bool = True


def median_ms(
    call: Callable[[], object],
    repeats: int = 9,
    clock: Callable[[], float] = time.perf_counter,
) -> float:
    """Return the median time of a call, ms, after one that warms up."""
    call()
    times = []
    for _ in range(repeats):
        start = clock()
        call()
        times.append(clock() - start)
    return 1e3 * median(times)


def timed_row(what: str, ms: float, aim_ms: float, beside: str = "") -> Row:
    """Return a row for a time that should stay below a figure."""
    digits = 1 if ms >= 1 else 3
    return Row(what, f"{ms:.{digits}f} ms", f"< {aim_ms:g} ms", beside, ms < aim_ms)


def print_table(rows: list[Row]) -> None:
    """Print rows in columns of even width."""
    lines = [("what", "ours", "aim", "", "beside")]
    lines += [
        (row.what, row.ours, row.aim, "" if row.reached else "MISSED", row.beside)
        for row in rows
    ]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        cells = (cell.ljust(n) for cell, n in zip(line, widths, strict=True))
        print("  ".join(cells).rstrip())

"""How far a long command is, on standard error."""

import shutil
import sys
import time
from collections.abc import Iterator
from typing import TextIO

from occsim.study import Step

BAR = 24
"""Characters of the bar."""


def shown(steps: Iterator[Step], stream: TextIO | None = None) -> Iterator[Step]:
    """Pass steps on, and show how far they are.

    On a terminal this is one line that is written over; elsewhere, a plain line a case.

    Parameters
    ----------
    steps : iterator of Step
        Of a batch.
    stream : text file, optional
        Standard error by default.

    Yields
    ------
    Step
    """
    stream = stream or sys.stderr
    is_terminal, start, computed = stream.isatty(), time.monotonic(), 0
    for step in steps:
        computed += not step.is_kept
        if not is_terminal:
            print(f"[{step.done}/{step.total}] {said(step)}", file=stream, flush=True)
        else:
            each = (time.monotonic() - start) / max(computed, 1)
            line = bar(step, each)
            failed = f"\r\x1b[K{said(step)}\n" if step.reason else ""
            print(f"{failed}\r\x1b[K{line}", end="", file=stream, flush=True)
        yield step
    if is_terminal:
        print(file=stream)


def said(step: Step) -> str:
    """Return what became of a case."""
    how = "kept" if step.is_kept else "computed"
    how = f"no result: {step.reason}" if step.reason else how
    return f"{step.name}, {step.cell_px} px: {how}"


def bar(step: Step, each_s: float, columns: int | None = None) -> str:
    """Return one line of progress.

    Parameters
    ----------
    step : Step
        The latest.
    each_s : float
        Seconds that a computed case takes.
    columns : int, optional
        Width of the terminal, by default as it is.

    Returns
    -------
    str
    """
    columns = columns or shutil.get_terminal_size().columns
    full = BAR * step.done // step.total
    left = _duration(each_s * (step.total - step.done))
    about = f"about {left} left" if step.done < step.total else "done"
    line = f"[{'#' * full}{'.' * (BAR - full)}] {step.done}/{step.total}  {about}"
    return f"{line}  {step.name}"[: columns - 1]


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 90 else f"{minutes / 60.0:.1f} h"

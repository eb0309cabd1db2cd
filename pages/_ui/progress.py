"""What a student has done with the exercises, and the file that holds it.

The browser keeps the same text that a student hands in. Nothing of it is trusted: a
file may have been edited, so what it claims is judged again from the states in it.
"""

import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from occsim import __version__
from occsim.errors import OccsimError
from occsim.exercises import Verdict

FORMAT = "occsim progress"
MAX_CHARS = 200_000
"""Most characters of a progress: some hundred times what one hour gives."""
MAX_ROWS, MAX_ITEMS = 100, 20
MAX_TEXT, MAX_LINK = 400, 3_000
ID = re.compile(r"[a-z0-9_]{1,40}")

Values = Mapping[str, float | str]


class ProgressError(OccsimError):
    """A text is no progress of this program."""


@dataclass(frozen=True, slots=True)
class Tried:
    """A state that was judged by one check of an exercise.

    Parameters
    ----------
    link : str
        The state, as in the query of a link.
    answers, moved : mapping
        What no link holds: the answers, and how far each prior was moved.
    numbers : mapping
        Scores of that state; NaN where one is undefined.
    time : str
        When, ISO 8601, UTC.
    """

    link: str
    answers: Values = field(default_factory=dict)
    moved: Values = field(default_factory=dict)
    numbers: Mapping[str, float] = field(default_factory=dict)
    time: str = ""


@dataclass(frozen=True, slots=True)
class Attempt:
    """How far a student has come with one exercise.

    ``first`` is what was predicted, None before. ``tried`` holds the state that each
    check was last judged by. ``moved`` holds how far each prior was moved while the
    pinned cell stayed; ``seen`` the pin and the pair last seen.
    """

    first: str | None = None
    answers: Values = field(default_factory=dict)
    stage: int = 0
    n_hints: int = 0
    n_checks: int = 0
    is_solved: bool = False
    tried: Mapping[int, Tried] = field(default_factory=dict)
    verdict: Verdict | None = None
    moved: Mapping[str, float] = field(default_factory=dict)
    seen: tuple[Any, ...] = ()


@dataclass(frozen=True, slots=True)
class Progress:
    """A file as it was handed in.

    ``lessons`` holds what was predicted in each, as it is written; ``name`` is what the
    student is called.
    """

    attempts: Mapping[str, Attempt]
    lessons: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""
    version: str = ""
    time: str = ""


def to_text(
    attempts: Mapping[str, Attempt],
    lessons: Mapping[str, Any] | None = None,
    name: str = "",
    time: str = "",
) -> str:
    """Return the progress as JSON; without a time it is the same as long as nothing
    was done."""
    rows = {
        key: _row(one)
        for key, one in attempts.items()
        if one.first is not None or one.n_checks or one.n_hints
    }
    head = {"format": FORMAT, "version": __version__}
    more = {"name": name, "time": time} if time else {}
    done = {"exercises": rows, "lessons": dict(lessons or {})}
    return json.dumps({**head, **more, **done}, allow_nan=False)


def _row(one: Attempt) -> dict[str, Any]:
    return {
        "solved": one.is_solved,
        "predicted": one.first,
        "answers": dict(one.answers),
        "checks": one.n_checks,
        "hints": one.n_hints,
        "stage": one.stage,
        "tried": {str(stage): _tried_row(tried) for stage, tried in one.tried.items()},
    }


def _tried_row(tried: Tried) -> dict[str, Any]:
    numbers = {
        name: None if math.isnan(value) else value
        for name, value in tried.numbers.items()
    }
    return {
        "link": tried.link,
        "answers": dict(tried.answers),
        "moved": dict(tried.moved),
        "numbers": numbers,
        "time": tried.time,
    }


# --- Reading, with every value checked ------------------------------------------------


def from_text(text: str) -> Progress:
    """Return the progress in a text.

    Raises
    ------
    ProgressError
        With one sentence, where anything in it is not as it is written.
    """
    if len(text) > MAX_CHARS:
        raise ProgressError(f"a progress has at most {MAX_CHARS:,} characters")
    try:
        given = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ProgressError("this is not JSON") from error
    if not isinstance(given, dict) or given.get("format") != FORMAT:
        raise ProgressError("this is not a progress of the exercises")
    rows = _mapping(given.get("exercises"), "exercises", MAX_ROWS)
    return Progress(
        {_id(name): _attempt(row) for name, row in rows.items()},
        _mapping(given.get("lessons", {}), "lessons"),
        *(_text(given.get(name, ""), name) for name in ("name", "version", "time")),
    )


def _attempt(row: Any) -> Attempt:
    row = _mapping(row, "an exercise")
    tried = _mapping(row.get("tried", {}), "tried")
    first = row.get("predicted")
    return Attempt(
        first=None if first is None else _text(first, "predicted"),
        answers=_values(row.get("answers", {}), "answers"),
        stage=_count(row.get("stage", 0), "stage"),
        n_hints=_count(row.get("hints"), "hints"),
        n_checks=_count(row.get("checks"), "checks"),
        is_solved=row.get("solved") is True,
        tried={_stage(stage): _tried(one) for stage, one in tried.items()},
    )


def _tried(row: Any) -> Tried:
    row = _mapping(row, "tried")
    numbers = _mapping(row.get("numbers", {}), "numbers")
    return Tried(
        link=_text(row.get("link"), "link", MAX_LINK),
        answers=_values(row.get("answers", {}), "answers"),
        moved=_values(row.get("moved", {}), "moved"),
        numbers={
            name: math.nan if value is None else _number(value, "numbers")
            for name, value in numbers.items()
        },
        time=_text(row.get("time", ""), "time"),
    )


def _mapping(given: Any, name: str, most: int = MAX_ITEMS) -> Mapping[str, Any]:
    if not isinstance(given, dict) or len(given) > most:
        raise ProgressError(f"{name} must be a table of at most {most} entries")
    for key in given:
        _text(key, f"a name in {name}")
    return given


def _text(given: Any, name: str, most: int = MAX_TEXT) -> str:
    if not isinstance(given, str) or len(given) > most:
        raise ProgressError(f"{name} must be a text of at most {most} characters")
    return given


def _id(given: str) -> str:
    if not ID.fullmatch(given):
        raise ProgressError("an exercise has a name that no exercise has")
    return given


def _stage(given: str) -> int:
    if not given.isascii() or not given.isdigit():
        raise ProgressError("tried must be numbered")
    return _count(int(given), "stage")


def _count(given: Any, name: str) -> int:
    if isinstance(given, bool) or not isinstance(given, int) or not 0 <= given < 10**6:
        raise ProgressError(f"{name} must be a whole number")
    return given


def _number(given: Any, name: str) -> float:
    is_number = isinstance(given, (int, float)) and not isinstance(given, bool)
    if not is_number or not abs(given) < 1e12:
        raise ProgressError(f"{name} must be numbers")
    return float(given)


def _values(given: Any, name: str) -> dict[str, float | str]:
    return {
        key: _text(value, name) if isinstance(value, str) else _number(value, name)
        for key, value in _mapping(given, name).items()
    }

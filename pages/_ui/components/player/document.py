"""What the student has chosen in the player: to the browser, and back with checks."""

import contextlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from enum import Enum
from typing import Any

from pages._ui.choices import Overlay
from pages._ui.columns import MAX_COLUMNS, MIN_COLUMNS, Column
from pages._ui.settings import column_with

SPEEDS = (5, 15, 30, 60, 120)
"""Readings per second."""
BOUND = 1_000_000
"""More than any drawing's pixels along a side, or any trajectory's poses."""
MAX_HELD = 500
"""More parts than a browser keeps."""


@dataclass(frozen=True, kw_only=True, slots=True)
class PlayerDocument:
    """What the student has chosen in the player.

    Parameters
    ----------
    rev : int
        Counts the times that Python imposed a document; the player echoes it.
    columns : tuple of Column
        The maps. One stands beside its drawing with controls; two or three stand side
        by side, and each header is its setting.
    overlay : Overlay
        What the maps show.
    step : int
        Number of readings in the maps; the player clamps it to the run's number.
    speed : int or None
        Readings per second, one of `SPEEDS`; None lets a replay last 10 s.
    pin_px : tuple of float or None
        Point x, y of the drawing, px, whose cell is pinned.
    predicted : int or None
        Index of the map that was said to find more walls, or to be best;
        `MAX_COLUMNS` if none was.
    compact : bool
        Maps that play by themselves and have no controls but play and pause; they ask
        half-way which will be best, and at the end offer the other update rule.
    """

    rev: int = 0
    columns: tuple[Column, ...] = (Column(),)
    overlay: Overlay = Overlay.NONE
    step: int = 0
    speed: int | None = None
    pin_px: tuple[float, float] | None = None
    predicted: int | None = None
    compact: bool = False


def encode_document(document: PlayerDocument) -> dict[str, Any]:
    """Return the document as JSON values."""
    return {
        **_json(document),
        "columns": [_json(column) for column in document.columns],
    }


def _json(values: Any) -> dict[str, Any]:
    return {
        name: value.value if isinstance(value, Enum) else value
        for name, value in asdict(values).items()
    }


def decode_commit(commit: object, document: PlayerDocument) -> PlayerDocument:
    """Return the document that a browser committed, every field checked.

    The input is not trusted: a value that is not a mapping, or echoes another rev,
    leaves `document` unchanged; a field that is missing or of the wrong kind keeps its
    value.
    """
    if not isinstance(commit, Mapping) or commit.get("rev") != document.rev:
        return document
    speed = commit.get("speed", document.speed)
    step = _bounded(commit.get("step"))
    predicted = commit.get("predicted")
    return replace(
        document,
        columns=_columns(commit.get("columns"), document.columns),
        overlay=_overlay(commit.get("overlay"), document.overlay),
        step=document.step if step is None else int(step),
        speed=speed if speed is None or speed in SPEEDS else document.speed,
        pin_px=_point(commit.get("pin_px")),
        predicted=int(predicted) if predicted in range(MAX_COLUMNS + 1) else None,
    )


def with_place(document: PlayerDocument, texts: Mapping[str, str]) -> PlayerDocument:
    """Return the document at the place in a link."""
    commit = encode_document(document)
    for name in "step", "speed":
        with contextlib.suppress(ValueError):
            commit |= {name: int(texts[name])} if name in texts else {}
    with contextlib.suppress(ValueError):
        if "pin" in texts:
            commit["pin_px"] = [float(at) for at in texts["pin"].split(",")]
    return decode_commit(commit, document)


def held_parts(commit: object) -> frozenset[str]:
    """Return the ids of the parts that a browser says it holds."""
    said = commit.get("held") if isinstance(commit, Mapping) else None
    if not isinstance(said, (list, tuple)):
        return frozenset()
    return frozenset(one for one in said[:MAX_HELD] if isinstance(one, str))


def _columns(value: object, otherwise: tuple[Column, ...]) -> tuple[Column, ...]:
    """Return the columns committed; a single map stays one, several stay several."""
    low, high = (1, 1) if len(otherwise) == 1 else (MIN_COLUMNS, MAX_COLUMNS)
    if not isinstance(value, (list, tuple)) or not low <= len(value) <= high:
        return otherwise
    return tuple(
        _column(one, otherwise[min(i, len(otherwise) - 1)])
        for i, one in enumerate(value)
    )


def _column(value: object, otherwise: Column) -> Column:
    if not isinstance(value, Mapping):
        return otherwise
    column = otherwise
    for one in fields(Column):
        try:
            column = column_with(column, {one.name: value[one.name]})
        except (KeyError, ValueError, TypeError, OverflowError):
            continue
    return column


def _overlay(value: object, otherwise: Overlay) -> Overlay:
    try:
        return Overlay(value)
    except ValueError:
        return otherwise


def _bounded(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return value if 0 <= value <= BOUND else None


def _point(value: object) -> tuple[float, float] | None:
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        return None
    x, y = (_bounded(v) for v in value)
    return None if x is None or y is None else (float(x), float(y))

"""The values in the JSON of a project, each checked for its type and its bounds."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any

from occsim.building import Sketch
from occsim.io.project.archive import JSON_NAME, ProjectError, shown
from occsim.io.project.checks import MAX_TEXT, is_number, is_text
from occsim.sensor import BehindHit, Sensor
from occsim.walls import WallParams

FORMAT = "occsim-project"
VERSION = 2
"""Version of the layout that the package describes."""

VERSIONS = (1, VERSION)
"""Versions that can be read."""

MAX_SETTINGS = 200
MAX_SKETCH = 5000
MAX_METRES_PER_PX = 100.0
MAX_LENGTH_PX = 100_000.0


@dataclass(frozen=True, kw_only=True, slots=True)
class ProjectValues:
    """The content of the JSON, checked.

    ``parts`` are arguments of `occsim.Building`; ``is_planned`` says whether the
    trajectory is the building's tour. ``robot`` is not checked yet.
    """

    version: int
    drawing_name: str
    is_planned: bool
    parts: dict[str, Any]
    settings: Mapping[str, str]
    robot: object


def read_values(content: bytes) -> ProjectValues:
    """Return the content of the JSON.

    Raises
    ------
    OccsimError
        Where it is not JSON, or a value is of another type or out of its bounds.
    """
    document = _json(content)
    _check_version(document)
    door_px = _length(document, "door_px", MAX_LENGTH_PX)
    return ProjectValues(
        version=document["version"],
        drawing_name=_text(document, "name"),
        is_planned=document.get("is_planned") is True,
        parts={
            "wall_params": _wall_params(document.get("wall_params")),
            "sensor": _sensor(document.get("sensor"), door_px),
            "sketch": _sketch(document.get("sketch")),
            "door_px": door_px,
            "metres_per_px": _length(document, "metres_per_px", MAX_METRES_PER_PX),
            "name": _text(document, "short_name"),
            "title": _text(document, "title"),
            "about": _text(document, "about"),
        },
        settings=_settings(document.get("settings")),
        robot=document.get("robot"),
    )


def _json(content: bytes) -> Mapping[str, Any]:
    """Return the object that the JSON holds."""
    try:
        document = json.loads(content)
    except (ValueError, RecursionError):
        raise ProjectError(f"{JSON_NAME} must be JSON; it is not") from None
    if not isinstance(document, dict):
        raise ProjectError(f"{JSON_NAME} must hold an object; it does not")
    return document


def _check_version(document: Mapping[str, Any]) -> None:
    kind, version = document.get("format"), document.get("version")
    if kind != FORMAT:
        raise ProjectError(f"its format must be {FORMAT!r}; got {shown(kind)}")
    if type(version) is not int or version not in VERSIONS:
        raise ProjectError(
            f"its version must be {' or '.join(map(str, VERSIONS))}, those that this "
            f"application reads; got {shown(version)}"
        )


def _text(document: Mapping[str, Any], key: str) -> str:
    value = document.get(key, "")
    if not is_text(value):
        raise ProjectError(
            f"{key} must be text of at most {MAX_TEXT} whole characters; "
            f"got {shown(value)}"
        )
    return str(value)


def _length(document: Mapping[str, Any], key: str, highest: float) -> float | None:
    value = document.get(key)
    if value is None:
        return None
    if not is_number(value) or not 0 < value <= highest:
        raise ProjectError(f"{key} must lie in (0, {highest:g}]; got {shown(value)}")
    return float(value)


def _sketch(value: object) -> Sketch:
    if (
        not isinstance(value, list)
        or len(value) > MAX_SKETCH
        or not all(_is_corner(corner) for corner in value)
    ):
        raise ProjectError(
            f"sketch must be at most {MAX_SKETCH} corners of x, y, px, within "
            f"{MAX_LENGTH_PX:g} px of the drawing, and true for a waypoint"
        )
    return tuple((float(x), float(y), is_waypoint) for x, y, is_waypoint in value)


def _is_corner(value: object) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 3
        and all(is_number(v) and abs(v) <= MAX_LENGTH_PX for v in value[:2])
        and isinstance(value[2], bool)
    )


def _sensor(value: object, door_px: float | None) -> Sensor:
    """Return the proposed sensor; for an old file, the one that fits the door."""
    if value is None:
        return Sensor() if door_px is None else Sensor(range_px=door_px)
    checked = _parameters(value, "sensor", Sensor)
    if "behind_hit" in checked:
        checked["behind_hit"] = BehindHit(checked["behind_hit"])
    return Sensor(**checked)


RETIRED = ("fill_level", "max_symbol_px", "max_wall_px", "min_slenderness")
"""Parameters of wall detection in release 0.1; its project files hold them."""


def _wall_params(value: object) -> WallParams:
    """Return the settings of wall detection, without those that it no longer has."""
    if isinstance(value, dict):
        value = {key: got for key, got in value.items() if key not in RETIRED}
    return WallParams(**_parameters(value, "wall_params", WallParams))


def _parameters(value: object, what: str, kind: type[Any]) -> dict[str, Any]:
    """Return values by the names and types of a class, which checks their bounds."""
    kinds = {item.name: item.type for item in fields(kind)}
    if not isinstance(value, dict) or not set(value) <= set(kinds):
        raise ProjectError(f"{what} must hold only {', '.join(kinds)}")
    for key, got in value.items():
        wanted = kinds[key]
        if isinstance(wanted, type) and issubclass(wanted, Enum):
            values = [choice.value for choice in wanted]
            is_right, needed = got in values, f"one of {', '.join(values)}"
        elif wanted is bool:
            is_right, needed = isinstance(got, bool), "true or false"
        else:
            is_right, needed = is_number(got), "a number"
        if not is_right:
            raise ProjectError(f"{key} in {what} must be {needed}; got {shown(got)}")
    return value


def _settings(value: object) -> Mapping[str, str]:
    """Return the application's settings; the application checks their meaning."""
    if (
        not isinstance(value, dict)
        or len(value) > MAX_SETTINGS
        or not all(is_text(key) and is_text(text) for key, text in value.items())
    ):
        raise ProjectError(
            f"settings must be an object of at most {MAX_SETTINGS} texts"
        )
    return value

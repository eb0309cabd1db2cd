"""The ``.yaml`` of a ROS map: the few forms of YAML that such files take.

A whole YAML reader would be one more dependency, and one more way in for hostile
files: this one knows ``key: value``, lists of numbers, quotes and comments.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np

from occsim._files import printable
from occsim.errors import RobotFileError

MAX_YAML_BYTES = 64_000
NEEDED = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")

Yaml = str | list[str]
"""A value as it is written, without quotes; a list of such."""

_KEY = re.compile(r"""["']?([A-Za-z_]\w*)["']?\s*:(?:\s+(.*))?$""")
_NUMBER = re.compile(r"[-+]?(\d{1,50}(\.\d{0,50})?|\.\d{1,50})([eE][-+]?\d{1,3})?$")
_TRUE = {"true", "yes", "on", "y"}
_FALSE = {"false", "no", "off", "n"}


class MapMode(Enum):
    """How the brightness of an image is read.

    Examples
    --------
    >>> from occsim.io.ros_map import MapMode
    >>> MapMode("trinary")
    <MapMode.TRINARY: 'trinary'>
    """

    TRINARY = "trinary"
    """Occupied, free, or unknown, by two thresholds."""
    SCALE = "scale"
    """Between the thresholds, a percentage; transparent pixels are unknown."""
    RAW = "raw"
    """The level itself is the percentage; 101 to 255 are unknown."""


@dataclass(frozen=True, kw_only=True, slots=True)
class MapMeta:
    """What the ``.yaml`` of a map says.

    Parameters
    ----------
    image : str
        Name of the image's file.
    resolution_m : float
        Side of a pixel, m.
    origin : tuple of float
        x, y, m, of the image's lower left corner, and yaw, rad.
    negate : bool
        Whether white is occupied.
    occupied_thresh, free_thresh : float
        Above, and below, which share of darkness a pixel is occupied, and free.
    mode : MapMode
        How pixels are read.
    """

    image: str
    resolution_m: float
    origin: tuple[float, float, float]
    negate: bool = False
    occupied_thresh: float = 0.65
    free_thresh: float = 0.196
    mode: MapMode = MapMode.TRINARY

    def __post_init__(self) -> None:
        if not 0.0 < self.resolution_m < np.inf:
            raise RobotFileError(
                f"resolution must be above 0 and finite; got {self.resolution_m}"
            )
        if not np.isfinite(self.origin).all():
            raise RobotFileError(f"origin must be finite; got {self.origin}")
        low, high = self.free_thresh, self.occupied_thresh
        if not (0.0 <= low <= 1.0 and 0.0 <= high <= 1.0):
            raise RobotFileError(
                f"free_thresh and occupied_thresh must lie in [0, 1]; got {low}, {high}"
            )
        if self.mode is MapMode.SCALE and low >= high:
            raise RobotFileError(
                "free_thresh must lie below occupied_thresh in mode scale; got "
                f"{low}, {high}"
            )


def parse_meta(data: bytes, name: str) -> MapMeta:
    """Return what the ``.yaml`` of a map says.

    Parameters
    ----------
    data : bytes
        The file's content.
    name : str
        What to call it.

    Returns
    -------
    MapMeta

    Raises
    ------
    RobotFileError
        Where it is too long, no text, lacks a key, or a value makes no sense.
    """
    if len(data) > MAX_YAML_BYTES:
        raise RobotFileError(
            f"{name} has {len(data):,} bytes; at most {MAX_YAML_BYTES:,} are allowed"
        )
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise RobotFileError(f"{name} is not text in UTF-8") from None
    values = _values(text, name)
    missing = [key for key in NEEDED if key not in values]
    if missing:
        raise RobotFileError(
            f"{name} must name {', '.join(NEEDED)}; {', '.join(missing)} is missing"
        )
    return MapMeta(
        image=_text(values, "image", name),
        resolution_m=_number(values["resolution"], "resolution", name),
        origin=_origin(values["origin"], name),
        negate=_flag(values["negate"], name),
        occupied_thresh=_number(values["occupied_thresh"], "occupied_thresh", name),
        free_thresh=_number(values["free_thresh"], "free_thresh", name),
        mode=_mode(values.get("mode", "trinary"), name),
    )


def dump_meta(meta: MapMeta) -> bytes:
    """Return the ``.yaml`` of a map; numbers in full precision."""
    lines = [
        f"image: {meta.image}",
        f"mode: {meta.mode.value}",
        f"resolution: {meta.resolution_m!r}",
        f"origin: [{', '.join(map(repr, meta.origin))}]",
        f"negate: {int(meta.negate)}",
        f"occupied_thresh: {meta.occupied_thresh!r}",
        f"free_thresh: {meta.free_thresh!r}",
        "",
    ]
    return "\n".join(lines).encode()


def _values(text: str, name: str) -> dict[str, Yaml]:
    """Return the values at the top level; what stands deeper is passed over."""
    values: dict[str, Yaml] = {}
    key, open_list = "", False
    for number, raw in enumerate(text.splitlines(), 1):
        line = _without_comment(raw).rstrip()
        bare = line.strip()
        if not bare or bare in ("---", "...") or raw.startswith("%YAML"):
            continue
        known = values.get(key)
        if open_list and isinstance(known, str):
            values[key] = known + " " + bare
            open_list = "]" not in bare
        elif bare.startswith("- ") and key and (known == "" or isinstance(known, list)):
            values[key] = [*(known or []), _unquoted(bare[2:])]
        elif line[0] not in " \t":
            found = _KEY.match(line)
            if found is None:
                raise RobotFileError(
                    f'{name}, line {number}: "key: value" is needed; got '
                    f"{printable(bare[:40])}"
                )
            key = found[1]
            if key in values:
                raise RobotFileError(f"{name}, line {number}: {key} stands there twice")
            values[key] = (found[2] or "").strip()
            open_list = values[key][:1] == "[" and "]" not in values[key]
    return {key: _parts(value) for key, value in values.items()}


def _without_comment(line: str) -> str:
    """Return a line up to a # outside quotes, at its start or behind a gap."""
    quote = ""
    for place, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter
        elif letter == "#" and (place == 0 or line[place - 1] in " \t"):
            return line[:place]
    return line


def _parts(value: Yaml) -> Yaml:
    if isinstance(value, str) and value[:1] == "[" and value[-1:] == "]":
        return [_unquoted(part) for part in value[1:-1].split(",")]
    return _unquoted(value) if isinstance(value, str) else value


def _unquoted(text: str) -> str:
    text = text.strip()
    if len(text) > 1 and text[0] == text[-1] and text[0] in "\"'":
        return text[1:-1]
    return text


def _text(values: Mapping[str, Yaml], key: str, name: str) -> str:
    value = values[key]
    if not isinstance(value, str) or not value or value[0] in "&*!|>{%@`":
        raise RobotFileError(f"{key} in {name} must be the name of a file")
    return value


def _number(value: Yaml, key: str, name: str) -> float:
    if not isinstance(value, str) or not _NUMBER.match(value):
        shown = printable(str(value)[:40])
        raise RobotFileError(f"{key} in {name} must be a number; got {shown}")
    return float(value)


def _origin(value: Yaml, name: str) -> tuple[float, float, float]:
    if not isinstance(value, list) or len(value) != 3:
        raise RobotFileError(f"origin in {name} must be a list of x, y and yaw")
    x, y, yaw = (_number(part, "origin", name) for part in value)
    return x, y, yaw


def _flag(value: Yaml, name: str) -> bool:
    word = value.lower() if isinstance(value, str) else ""
    if word in _TRUE | _FALSE:
        return word in _TRUE
    return _number(value, "negate", name) != 0.0


def _mode(value: Yaml, name: str) -> MapMode:
    modes = {mode.value: mode for mode in MapMode}
    word = value.lower() if isinstance(value, str) else ""
    if word not in modes:
        raise RobotFileError(
            f"mode in {name} must be one of {', '.join(modes)}; got "
            f"{printable(str(value)[:40])}"
        )
    return modes[word]

"""Project files: a building and the settings beside it, in one zip archive.

The archive holds images as PNG (``drawing``, ``walls_found`` before and ``walls`` after
correction, ``truth_base`` and ``truth`` likewise), ``trajectory.csv`` and
``project.json`` with everything else: strokes, sketch, scale, the settings of wall
detection, the settings of the application as text, versions. ``walls.png`` and
``truth.png`` are for people; a reader draws the strokes again.

An archive is hostile until checked: only these names are read, never as paths, none
beyond its limit of bytes; images are checked before they are decoded; every value of
the JSON has to be of its type and in its bounds. Walls are not detected anew, so a
project stays what it was when the detection improves.
"""

import io
import json
import math
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from occsim._files import read_source
from occsim.building import Building, CorrectedMask
from occsim.errors import OccsimError
from occsim.imaging import MAX_FILE_BYTES, Drawing, load_drawing
from occsim.io.images import drawing_png, mask_png
from occsim.io.trajectories import (
    TrajectoryFormat,
    dump_trajectory,
    load_trajectory,
)
from occsim.strokes import decode_strokes, encode_strokes
from occsim.walls import WallParams
from occsim.world import world_from_image

FORMAT = "occsim-project"
VERSION = 1
"""Of the layout described above; a reader refuses any other."""

MAX_JSON_BYTES = 8_000_000
"""Strokes at their limit stay below."""

MAX_TEXT = 2000
"""Longest title or setting, characters."""

MAX_SKETCH = 5000
MAX_METRES_PER_PX = 100.0
MAX_LENGTH_PX = 100_000.0

PNG_MARK = b"\x89PNG\r\n\x1a\n"
JSON_NAME, TRAJECTORY_NAME = "project.json", "trajectory.csv"
DRAWING_NAME, TITLED = "drawing.png", ("title", "about")
WALLS_BASE, WALLS = "walls_found.png", "walls.png"
TRUTH_BASE, TRUTH = "truth_base.png", "truth.png"
IMAGES = (DRAWING_NAME, WALLS_BASE, WALLS, TRUTH_BASE, TRUTH)
LIMITS: Mapping[str, int] = {
    JSON_NAME: MAX_JSON_BYTES,
    TRAJECTORY_NAME: 20_000_000,
    **dict.fromkeys(IMAGES, MAX_FILE_BYTES),
}
"""Names that an archive may hold, and how many bytes each may unpack to."""

# Fixed, so that the same project gives the same bytes; the earliest that zip knows.
_DATE = (1980, 1, 1, 0, 0, 0)


class ProjectError(OccsimError):
    """A file cannot be opened as a project."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Project:
    """What one file keeps.

    Parameters
    ----------
    building : Building
        Drawing, walls, ground truth, trajectory, scale.
    settings : mapping of str to str
        Whatever the application wants back, as text.
    """

    building: Building
    settings: Mapping[str, str] = field(default_factory=dict)


def dump_project(project: Project) -> bytes:
    """Return the content of a project file.

    Parameters
    ----------
    project : Project
        Its settings must be text. Of more strokes than can be read back, the oldest
        are kept as pixels only.

    Returns
    -------
    bytes
        A zip archive; the same project gives the same bytes.
    """
    building = _with_few_strokes(project.building)
    truth = building.truth
    told = _description(building, project.settings)
    files = {
        JSON_NAME: json.dumps(told, indent=1).encode("ascii"),
        DRAWING_NAME: drawing_png(building.drawing),
        WALLS_BASE: mask_png(building.walls.base),
        WALLS: mask_png(building.walls.mask),
        TRAJECTORY_NAME: dump_trajectory(building.trajectory, TrajectoryFormat.CSV),
    }
    if truth is not None:
        files |= {TRUTH_BASE: mask_png(truth.base), TRUTH: mask_png(truth.mask)}
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, _DATE), content, _packing(name))
    return out.getvalue()


def _packing(name: str) -> int:
    """Return how to store a file: PNG is compressed already."""
    return zipfile.ZIP_STORED if name in IMAGES else zipfile.ZIP_DEFLATED


def _with_few_strokes(building: Building) -> Building:
    truth = building.truth
    return replace(
        building,
        walls=building.walls.with_few_strokes(),
        truth=None if truth is None else truth.with_few_strokes(),
    )


def _description(building: Building, settings: Mapping[str, str]) -> dict[str, Any]:
    """Return what stands in the JSON."""
    # The package imports its modules before it knows its version.
    from occsim import __version__

    truth = building.truth
    return {
        "format": FORMAT,
        "version": VERSION,
        "occsim": __version__,
        "title": building.title[:MAX_TEXT],
        "about": building.about[:MAX_TEXT],
        "name": building.drawing.name[:MAX_TEXT],
        "door_px": building.door_px,
        "metres_per_px": building.metres_per_px,
        "sketch": [list(corner) for corner in building.sketch],
        "wall_params": asdict(building.wall_params),
        "wall_strokes": encode_strokes(building.walls.strokes),
        "truth_strokes": None if truth is None else encode_strokes(truth.strokes),
        "settings": dict(settings),
    }


def load_project(source: bytes | str | Path, *, name: str | None = None) -> Project:
    """Return the project in a file that `dump_project` wrote; nothing is trusted.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        What to call the file in messages.

    Returns
    -------
    Project

    Raises
    ------
    OccsimError
        `ProjectError` where the file is no such archive, damaged, too large, of
        another version, or a value in it is out of bounds; `DrawingError`,
        `TrajectoryError` or `ParameterError` where a part is.
    """
    data, file_name = read_source(
        source,
        what=name or "the project file",
        needed="a project file (.zip) saved by this application",
        max_bytes=MAX_FILE_BYTES,
        error=ProjectError,
    )
    name = name or file_name
    try:
        return _project(_unpacked(data, name), name)
    except OccsimError as error:
        raise type(error)(f"{name} cannot be opened: {error}") from None


def _unpacked(data: bytes, name: str) -> dict[str, bytes]:
    """Return the content of the archive's files by name."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
            _check_entries(entries)
            return {entry.filename: _content(archive, entry) for entry in entries}
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError):
        raise ProjectError(
            "it is not an undamaged zip archive; a project file saved by this "
            "application is needed"
        ) from None


def _check_entries(entries: list[zipfile.ZipInfo]) -> None:
    """Refuse an archive by its table of contents, before anything is unpacked."""
    names = [entry.filename for entry in entries]
    strange = [name for name in names if name not in LIMITS]
    if strange:
        raise ProjectError(
            f"a project holds only {', '.join(LIMITS)}; got {strange[0]!r:.60}"
        )
    if len(set(names)) < len(names):
        raise ProjectError("each file may be in it once; one is there again")
    missing = {JSON_NAME, DRAWING_NAME, WALLS_BASE, TRAJECTORY_NAME} - set(names)
    if missing:
        raise ProjectError(f"{', '.join(sorted(missing))} is missing")
    if any(entry.flag_bits & 1 for entry in entries):
        raise ProjectError("it is encrypted; a project without password is needed")
    for entry in entries:
        _check_size(entry.filename, entry.file_size)


def _check_size(name: str, size: int) -> None:
    if size > LIMITS[name]:
        raise ProjectError(
            f"{name} may unpack to at most {LIMITS[name] / 1e6:.0f} MB; "
            f"got {size / 1e6:.0f} MB"
        )


def _content(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """Unpack one file, no further than its limit whatever its header says."""
    with archive.open(entry) as file:
        content = file.read(LIMITS[entry.filename] + 1)
    _check_size(entry.filename, len(content))
    return content


def _project(files: Mapping[str, bytes], name: str) -> Project:
    told = _json(files[JSON_NAME])
    _check_version(told)
    walls = CorrectedMask(
        _mask(files, WALLS_BASE), decode_strokes(told.get("wall_strokes"))
    )
    truth = None
    if TRUTH_BASE in files:
        strokes = decode_strokes(told.get("truth_strokes"))
        truth = CorrectedMask(_mask(files, TRUTH_BASE), strokes)
    building = Building(
        drawing=_image(files, DRAWING_NAME, _text(told, "name")),
        walls=walls,
        truth=truth,
        trajectory=load_trajectory(files[TRAJECTORY_NAME], name=TRAJECTORY_NAME),
        wall_params=_wall_params(told.get("wall_params")),
        sketch=_sketch(told.get("sketch")),
        door_px=_length(told, "door_px", MAX_LENGTH_PX),
        metres_per_px=_length(told, "metres_per_px", MAX_METRES_PER_PX),
        **{key: _text(told, key) for key in TITLED},
    )
    return Project(building=building, settings=_settings(told.get("settings")))


def _image(files: Mapping[str, bytes], name: str, title: str) -> Drawing:
    if not files[name].startswith(PNG_MARK):
        raise ProjectError(f"{name} must be a PNG image; it is not")
    drawing = load_drawing(files[name], name=name)
    return Drawing(rgb=drawing.rgb, name=title, digest=drawing.digest)


def _mask(files: Mapping[str, bytes], name: str) -> Any:
    return world_from_image(_image(files, name, name)).occupied


def _json(content: bytes) -> Mapping[str, Any]:
    """Return the object that the JSON holds."""
    try:
        told = json.loads(content)
    except (ValueError, RecursionError):
        raise ProjectError(f"{JSON_NAME} must be JSON; it is not") from None
    if not isinstance(told, dict):
        raise ProjectError(f"{JSON_NAME} must hold an object; it does not")
    return told


def _check_version(told: Mapping[str, Any]) -> None:
    kind, version = told.get("format"), told.get("version")
    if kind != FORMAT:
        raise ProjectError(f"its format must be {FORMAT!r}; got {kind!r:.60}")
    if type(version) is not int or version != VERSION:
        raise ProjectError(
            f"its version must be {VERSION}, the one that this application reads; "
            f"got {version!r:.60}"
        )


def _text(told: Mapping[str, Any], key: str) -> str:
    value = told.get(key, "")
    if not isinstance(value, str) or len(value) > MAX_TEXT:
        raise ProjectError(f"{key} must be text of at most {MAX_TEXT} characters")
    return value


def _length(told: Mapping[str, Any], key: str, highest: float) -> float | None:
    value = told.get(key)
    if value is None:
        return None
    if not _is_number(value) or not 0 < value <= highest:
        raise ProjectError(f"{key} must lie in (0, {highest:g}]; got {value!r:.60}")
    return float(value)


def _is_number(value: object) -> bool:
    # bool is an int to Python; a huge int has no float.
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) < 1e15 and math.isfinite(value)


def _sketch(value: object) -> tuple[tuple[float, float, bool], ...]:
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
        and all(_is_number(v) and abs(v) <= MAX_LENGTH_PX for v in value[:2])
        and isinstance(value[2], bool)
    )


def _wall_params(value: object) -> WallParams:
    """Return the settings of wall detection; their own class checks the bounds."""
    kinds = {item.name: item.type for item in fields(WallParams)}
    if not isinstance(value, dict) or not set(value) <= set(kinds):
        raise ProjectError("wall_params must be the settings of wall detection")
    for key, got in value.items():
        is_right = isinstance(got, bool) if kinds[key] is bool else _is_number(got)
        if not is_right:
            raise ProjectError(
                f"{key} in wall_params must be "
                f"{'true or false' if kinds[key] is bool else 'a number'}; "
                f"got {got!r:.60}"
            )
    return WallParams(**value)


def _settings(value: object) -> Mapping[str, str]:
    """Return the application's settings; it checks itself what they mean."""
    if (
        not isinstance(value, dict)
        or len(value) > 200
        or not all(isinstance(v, str) and len(v) <= MAX_TEXT for v in value.values())
    ):
        raise ProjectError("settings must be an object of at most 200 texts")
    return value

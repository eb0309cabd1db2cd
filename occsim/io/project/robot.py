"""What a project holds of a robot's data: its log, a registration, traced walls."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from occsim._types import BoolArray
from occsim.imaging import png_size
from occsim.io.images import mask_png
from occsim.io.project.archive import (
    LIMITS,
    LOG,
    LOG_POSES,
    TRACED,
    ProjectError,
    shown,
)
from occsim.io.project.checks import is_number, is_text, written_text
from occsim.io.ros_map.image import read_image
from occsim.registration import Registration

MAX_POINTS = 2
"""Most points on drawing and on map, each."""
FAR_PX = 100_000.0
FIELDS = ("scale", "rotation_rad", "shift_x_px", "shift_y_px")
ORIGIN = ("x_m", "y_m", "yaw_rad")

Points = tuple[tuple[float, float], ...]


@dataclass(frozen=True, eq=False, kw_only=True)
class RobotData:
    """A robot's data beside a building.

    Parameters
    ----------
    log : bytes, optional
        A log of scans as it was uploaded, of any format that `occsim.io` reads; it is
        not read here.
    log_name : str
        The name of its file.
    log_poses : bytes, optional
        The TUM trajectory of timed scans.
    map_id : str
        Tells the log's map from others; the application's.
    registration : Registration, optional
        Where the building's drawing lies on that map.
    drawing_points, map_points : tuple of (float, float)
        x, y, px, of the points that gave it; two each at most.
    traced : ndarray of bool, shape (H, W), optional
        Walls traced on that map, one pixel of it each.
    origin : tuple of float, optional
        x, y, m, of the drawing's lower left corner in a robot's frame, and its turn to
        the left about it, rad.

    Examples
    --------
    >>> from occsim.io.project import RobotData
    >>> RobotData(log=b"FLASER ...", log_name="drive.log").registration is None
    True
    """

    log: bytes | None = None
    log_name: str = ""
    log_poses: bytes | None = None
    map_id: str = ""
    registration: Registration | None = None
    drawing_points: Points = ()
    map_points: Points = ()
    traced: BoolArray | None = None
    origin: tuple[float, float, float] | None = None


def robot_files(robot: RobotData) -> dict[str, bytes]:
    """Return its files by their names in the archive.

    Raises
    ------
    ProjectError
        Where one is too large to be read back.
    """
    files = {LOG: robot.log, LOG_POSES: robot.log_poses}
    files[TRACED] = None if robot.traced is None else mask_png(robot.traced)
    found = {name: data for name, data in files.items() if data is not None}
    for name, data in found.items():
        if len(data) > LIMITS[name]:
            raise ProjectError(
                f"{name} of a project may hold {LIMITS[name] / 1e6:.0f} MB; got "
                f"{len(data) / 1e6:.0f} MB"
            )
    return found


def robot_document(robot: RobotData) -> dict[str, Any]:
    """Return what the JSON says of it."""
    lies = robot.registration
    return {
        "log_name": written_text(robot.log_name),
        "map_id": robot.map_id,
        "registration": lies and {name: getattr(lies, name) for name in FIELDS},
        "drawing_points": [list(point) for point in robot.drawing_points],
        "map_points": [list(point) for point in robot.map_points],
        "origin": robot.origin and list(robot.origin),
    }


def read_robot(document: object, files: Mapping[str, bytes]) -> RobotData:
    """Return it from the JSON and the files of an archive.

    Raises
    ------
    OccsimError
        Where a value is of another type or out of its bounds.
    """
    if document is None:
        document = {}
    if not isinstance(document, dict):
        raise ProjectError(f"robot must be an object; got {shown(document)}")
    return RobotData(
        log=files.get(LOG),
        log_name=_text(document, "log_name"),
        log_poses=files.get(LOG_POSES),
        map_id=_text(document, "map_id"),
        registration=_registration(document.get("registration")),
        drawing_points=_points(document, "drawing_points"),
        map_points=_points(document, "map_points"),
        traced=_traced(files),
        origin=_origin(document.get("origin")),
    )


def _text(document: Mapping[str, Any], key: str) -> str:
    value = document.get(key, "")
    if not is_text(value):
        raise ProjectError(f"{key} must be short text; got {shown(value)}")
    return str(value)


def _registration(value: object) -> Registration | None:
    if value is None:
        return None
    if (
        not isinstance(value, dict)
        or set(value) != set(FIELDS)
        or not all(is_number(one) for one in value.values())
    ):
        raise ProjectError(f"registration must hold the numbers {', '.join(FIELDS)}")
    return Registration(**{name: float(value[name]) for name in FIELDS})


def _points(document: Mapping[str, Any], key: str) -> Points:
    value = document.get(key, [])
    if (
        not isinstance(value, list)
        or len(value) > MAX_POINTS
        or not all(_is_point(one) for one in value)
    ):
        raise ProjectError(
            f"{key} must be at most {MAX_POINTS} points x, y, px, 0 to {FAR_PX:g}"
        )
    return tuple((float(x), float(y)) for x, y in value)


def _is_point(value: object) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(is_number(one) and 0 <= one <= FAR_PX for one in value)
    )


def _origin(value: object) -> tuple[float, float, float] | None:
    if value is None:
        return None
    if (
        not isinstance(value, list)
        or len(value) != len(ORIGIN)
        or not all(is_number(one) for one in value)
    ):
        raise ProjectError(f"origin must be {', '.join(ORIGIN)}; got {shown(value)}")
    x, y, yaw = (float(one) for one in value)
    return x, y, yaw


def _traced(files: Mapping[str, bytes]) -> BoolArray | None:
    if TRACED not in files:
        return None
    if png_size(files[TRACED]) is None:
        raise ProjectError(f"{TRACED} must be a PNG image; it is not")
    # As the map of a robot: it may be smaller or longer than any drawing.
    return read_image(files[TRACED], TRACED).colour < 0.5

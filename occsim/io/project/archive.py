"""The archive of a project: which files it holds, unpacked within limits."""

import reprlib
from collections.abc import Mapping

from occsim._archives import unpacked
from occsim.errors import OccsimError
from occsim.imaging import png_size

MAX_UNPACKED_BYTES = 100_000_000
"""Total size of all files of an archive, unpacked, bytes."""

JSON_NAME, TRAJECTORY_NAME = "project.json", "trajectory.csv"
DRAWING = "drawing.png"
FOUND, CORRECTIONS, WALLS = "walls_found.png", "corrections.png", "walls.png"
UNKNOWN = "unknown.png"
LOG, LOG_POSES, TRACED = "log", "log_trajectory.txt", "traced.png"
MAX_LOG_BYTES = 20_000_000
"""Largest robot's log in a project, with its trajectory, bytes."""
TRUTH, OLD_TRUTH = "truth.png", "truth_base.png"
IMAGES = (DRAWING, FOUND, CORRECTIONS, WALLS, UNKNOWN, TRUTH, OLD_TRUTH)
LIMITS: Mapping[str, int] = {
    JSON_NAME: 4_000_000,
    TRAJECTORY_NAME: 8_000_000,
    LOG: MAX_LOG_BYTES,
    LOG_POSES: MAX_LOG_BYTES,
    TRACED: 8_000_000,
    **dict.fromkeys(IMAGES, MAX_UNPACKED_BYTES),
}
"""Names that an archive may hold, and how many bytes each may unpack to."""


class ProjectError(OccsimError):
    """A file cannot be opened as a project.

    Examples
    --------
    >>> from occsim.io.project import ProjectError, load_project
    >>> try:
    ...     load_project(b"no archive")
    ... except ProjectError as error:
    ...     print(type(error).__name__)
    ProjectError
    """


def unpacked_project(data: bytes) -> dict[str, bytes]:
    """Return the content of the archive's files by name.

    Raises
    ------
    ArchiveError
        Where it is not an archive, is damaged or too large, or holds other files.
    """
    return unpacked(
        data,
        LIMITS,
        required={JSON_NAME, DRAWING, FOUND, TRAJECTORY_NAME},
        max_bytes=MAX_UNPACKED_BYTES,
        what="a project",
        needed="a project file saved by this application",
    )


def check_images(files: Mapping[str, bytes]) -> None:
    """Refuse images of another format or size before any is decoded."""
    sizes = {}
    for name in IMAGES:
        if name in files:
            size = png_size(files[name])
            if size is None:
                raise ProjectError(f"{name} must be a PNG image; it is not")
            sizes[name] = f"{size[0]} x {size[1]} px"
    for name, found in sizes.items():
        if found != sizes[DRAWING]:
            raise ProjectError(
                f"{name} must have the drawing's size, {sizes[DRAWING]}; got {found}"
            )


def shown(value: object) -> str:
    """Return a value for a message: short, however deep or long it is."""
    return reprlib.repr(value)

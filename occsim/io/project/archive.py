"""The archive of a project: which files it holds, unpacked within limits."""

import reprlib
from collections.abc import Mapping

from occsim._archives import unpacked
from occsim.errors import OccsimError

MAX_UNPACKED_BYTES = 100_000_000
"""Total size of all files of an archive, unpacked, bytes."""

PNG_MARK = b"\x89PNG\r\n\x1a\n"
JSON_NAME, TRAJECTORY_NAME = "project.json", "trajectory.csv"
DRAWING = "drawing.png"
FOUND, CORRECTIONS, WALLS = "walls_found.png", "corrections.png", "walls.png"
TRUTH, OLD_TRUTH = "truth.png", "truth_base.png"
IMAGES = (DRAWING, FOUND, CORRECTIONS, WALLS, TRUTH, OLD_TRUTH)
LIMITS: Mapping[str, int] = {
    JSON_NAME: 4_000_000,
    TRAJECTORY_NAME: 8_000_000,
    **dict.fromkeys(IMAGES, MAX_UNPACKED_BYTES),
}
"""Names that an archive may hold, and how many bytes each may unpack to."""


class ProjectError(OccsimError):
    """A file cannot be opened as a project."""


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
            if not files[name].startswith(PNG_MARK):
                raise ProjectError(f"{name} must be a PNG image; it is not")
            # Width and height stand first in the first chunk, big-endian.
            width, height = (
                int.from_bytes(files[name][at : at + 4]) for at in (16, 20)
            )
            sizes[name] = f"{width} x {height} px"
    for name, size in sizes.items():
        if size != sizes[DRAWING]:
            raise ProjectError(
                f"{name} must have the drawing's size, {sizes[DRAWING]}; got {size}"
            )


def shown(value: object) -> str:
    """Return a value for a message: short, however deep or long it is."""
    return reprlib.repr(value)

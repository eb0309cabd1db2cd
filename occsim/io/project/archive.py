"""The archive of a project: which files it holds, unpacked within limits."""

import io
import reprlib
import zipfile
import zlib
from collections.abc import Mapping

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

MAX_ENTRIES = 100
"""Most entries of the table of contents, which zipfile reads before it can be
checked."""

_ENTRY_MARK = b"PK\x01\x02"

# What zipfile raises on damage: bad offsets are ValueError or OSError, names that are
# no UTF-8 UnicodeDecodeError, which is a ValueError.
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    OSError,
    OverflowError,
    NotImplementedError,
    ValueError,
)


class ProjectError(OccsimError):
    """A file cannot be opened as a project."""


def unpacked(data: bytes) -> dict[str, bytes]:
    """Return the content of the archive's files by name.

    Raises
    ------
    ProjectError
        Where it is not an archive, is damaged or too large, or holds other files.
    """
    n_entries = data.count(_ENTRY_MARK)
    if n_entries > MAX_ENTRIES:
        raise ProjectError(f"a project has few files; got {n_entries}")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
            _check_entries(entries)
            return {entry.filename: _content(archive, entry) for entry in entries}
    except ProjectError:
        raise
    except _DAMAGE:
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
            f"a project holds only {', '.join(LIMITS)}; got {shown(strange[0])}"
        )
    if len(set(names)) < len(names):
        raise ProjectError("each file may be in it once; one is there twice")
    missing = {JSON_NAME, DRAWING, FOUND, TRAJECTORY_NAME} - set(names)
    if missing:
        raise ProjectError(f"{', '.join(sorted(missing))} is missing")
    if any(entry.flag_bits & 1 for entry in entries):
        raise ProjectError("it is encrypted; a project without password is needed")
    ways = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
    if any(entry.compress_type not in ways for entry in entries):
        raise ProjectError("its files must be stored or deflated; one is not")
    for entry in entries:
        _check_size(entry.filename, entry.file_size)
    total = sum(entry.file_size for entry in entries)
    if total > MAX_UNPACKED_BYTES:
        raise ProjectError(
            f"its files may unpack to at most {MAX_UNPACKED_BYTES / 1e6:.0f} MB "
            f"together; got {total / 1e6:.0f} MB"
        )


def _check_size(name: str, size: int) -> None:
    if size > LIMITS[name]:
        raise ProjectError(
            f"{name} may unpack to at most {LIMITS[name] / 1e6:.0f} MB; "
            f"got {size / 1e6:.0f} MB"
        )


def _content(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """Unpack one file, no further than the size that was checked."""
    with archive.open(entry) as file:
        content = file.read(entry.file_size + 1)
    if len(content) != entry.file_size:
        raise ProjectError(f"{entry.filename} has another size than the archive says")
    return content


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

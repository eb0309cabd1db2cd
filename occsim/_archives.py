"""Zip archives, refused by their table of contents before anything is unpacked."""

import io
import reprlib
import zipfile
import zlib
from collections.abc import Collection, Mapping

from occsim.errors import OccsimError

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


class ArchiveError(OccsimError):
    """An archive is damaged, too large, or holds other files."""


def unpacked(
    data: bytes,
    limits: Mapping[str, int],
    *,
    required: Collection[str],
    max_bytes: int,
    what: str,
    needed: str,
    others_ignored: bool = False,
) -> dict[str, bytes]:
    """Return the content of an archive's files by name.

    Parameters
    ----------
    data : bytes
        The archive.
    limits : mapping
        Names of the files that it may hold, and how many bytes each may unpack to.
    required : collection of str
        Names of the files that it must hold.
    max_bytes : int
        Total size of all files, unpacked, bytes.
    what, needed : str
        What it is, and what is needed in place of a damaged file, for messages.
    others_ignored : bool, default False
        Whether files of other names are passed over, not refused.

    Returns
    -------
    dict of bytes

    Raises
    ------
    ArchiveError
        Where it is not an archive, is damaged or too large, or holds other files.
    """
    _check_entries(data, what)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
            if others_ignored:
                entries = [entry for entry in entries if entry.filename in limits]
            _check_names([entry.filename for entry in entries], limits, required, what)
            _check_packing(entries, what)
            _check_sizes(entries, limits, max_bytes)
            return {entry.filename: _content(archive, entry) for entry in entries}
    except ArchiveError:
        raise
    except _DAMAGE:
        raise ArchiveError(
            f"it is not an undamaged zip archive; {needed} is needed"
        ) from None


def names_in(data: bytes, *, what: str, needed: str) -> list[str]:
    """Return the names of an archive's files; nothing is unpacked.

    Parameters
    ----------
    data : bytes
        The archive.
    what, needed : str
        As in `unpacked`.

    Raises
    ------
    ArchiveError
        Where it is not an archive, is damaged, or has too many files.
    """
    _check_entries(data, what)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return archive.namelist()
    except _DAMAGE:
        raise ArchiveError(
            f"it is not an undamaged zip archive; {needed} is needed"
        ) from None


def _check_entries(data: bytes, what: str) -> None:
    n_entries = data.count(_ENTRY_MARK)
    if n_entries > MAX_ENTRIES:
        raise ArchiveError(f"{what} has few files; got {n_entries}")


def _check_names(
    names: list[str], limits: Mapping[str, int], required: Collection[str], what: str
) -> None:
    strange = [name for name in names if name not in limits]
    if strange:
        raise ArchiveError(
            f"{what} holds only {', '.join(limits)}; got {reprlib.repr(strange[0])}"
        )
    if len(set(names)) < len(names):
        raise ArchiveError("each file may be in it once; one is there twice")
    missing = set(required) - set(names)
    if missing:
        raise ArchiveError(f"{', '.join(sorted(missing))} is missing")


def _check_packing(entries: list[zipfile.ZipInfo], what: str) -> None:
    if any(entry.flag_bits & 1 for entry in entries):
        raise ArchiveError(f"it is encrypted; {what} without password is needed")
    ways = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}
    if any(entry.compress_type not in ways for entry in entries):
        raise ArchiveError("its files must be stored or deflated; one is not")


def _check_sizes(
    entries: list[zipfile.ZipInfo], limits: Mapping[str, int], max_bytes: int
) -> None:
    for entry in entries:
        if entry.file_size > limits[entry.filename]:
            raise ArchiveError(
                f"{entry.filename} may unpack to at most "
                f"{limits[entry.filename] / 1e6:.0f} MB; "
                f"got {entry.file_size / 1e6:.0f} MB"
            )
    total = sum(entry.file_size for entry in entries)
    if total > max_bytes:
        raise ArchiveError(
            f"its files may unpack to at most {max_bytes / 1e6:.0f} MB together; "
            f"got {total / 1e6:.0f} MB"
        )


def _content(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """Unpack one file, no further than the size that was checked."""
    with archive.open(entry) as file:
        content = file.read(entry.file_size + 1)
    if len(content) != entry.file_size:
        raise ArchiveError(f"{entry.filename} has another size than the archive says")
    return content

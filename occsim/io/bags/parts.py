"""The files of a bag: one, or those of the folder in which ROS 2 keeps it."""

import io
import re
import zipfile
from collections.abc import Mapping
from pathlib import Path

from occsim import _archives
from occsim._files import printable, read_source
from occsim.errors import RobotFileError
from occsim.io.bags.limits import MAX_FILE_BYTES

MARKS = {b"#ROSBAG V2.0": ".bag", b"\x89MCAP0\r\n": ".mcap", b"SQLite format 3": ".db3"}
"""How the files of bags begin, and the suffix by which `rosbags` knows them."""

ENDINGS = (".db3", ".mcap")
PACKED = (".db3.zstd", ".mcap.zstd")
METADATA = "metadata.yaml"
ZIP_MARK = b"PK"
WHAT = "a zip file of a bag's folder"
NEEDED = "a bag of ROS"
_EPOCH = (1980, 1, 1, 0, 0, 0)


def is_bag(data: bytes) -> bool:
    r"""Return whether a file begins as a bag's does, or is the zip of a bag's folder.

    Examples
    --------
    >>> from occsim.io import bags
    >>> bags.is_bag(b"#ROSBAG V2.0\n"), bags.is_bag(b"FLASER 3")
    (True, False)
    """
    return data.startswith(tuple(MARKS)) or _is_zipped_folder(data)


def join(files: Mapping[str, bytes]) -> bytes:
    """Return the files of a bag's folder as one zip file, for `load`.

    Parameters
    ----------
    files : mapping of str to bytes
        Content by name: parts of one recording (.db3 or .mcap), with or without
        ``metadata.yaml``, which is not needed.

    Returns
    -------
    bytes

    Raises
    ------
    RobotFileError
        Where there is no part of a bag, or a file that is none.

    Examples
    --------
    >>> from occsim.io import bags
    >>> bags.is_bag(bags.join({"drive_0.mcap": b"", "drive_1.mcap": b""}))
    True
    """
    parts = _part_names(list(files))
    others = set(files) - set(parts) - {n for n in files if _base(n) == METADATA}
    if others:
        raise RobotFileError(
            f"the files of a bag must be .db3 or .mcap and {METADATA}; got "
            f"{printable(min(others))} among them"
        )
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as archive:
        for name in parts:
            archive.writestr(zipfile.ZipInfo(_base(name), _EPOCH), files[name])
    return out.getvalue()


def read_parts(source: bytes | str | Path) -> tuple[list[bytes], str]:
    """Return the contents of a bag's files in their order, and what to call it.

    Raises
    ------
    RobotFileError
        Where the source is missing, too large, damaged, or has no part of a bag.
    """
    if isinstance(source, str | Path) and Path(source).is_dir():
        folder = Path(source)
        names = _part_names(sorted(path.name for path in folder.iterdir()))
        sizes = [(folder / name).stat().st_size for name in names]
        if sum(sizes) > MAX_FILE_BYTES:
            raise RobotFileError(
                f"the bag {printable(folder.name)} may have "
                f"{MAX_FILE_BYTES / 1e6:.0f} MB; it has {sum(sizes) / 1e6:.0f} MB"
            )
        return [(folder / name).read_bytes() for name in names], folder.name
    data, name = read_source(
        source,
        what="the bag",
        needed=NEEDED,
        max_bytes=MAX_FILE_BYTES,
        error=RobotFileError,
    )
    return (_unzipped(data) if data.startswith(ZIP_MARK) else [data]), name


def suffix_of(data: bytes, name: str) -> str:
    """Return the suffix by which `rosbags` knows a file.

    Raises
    ------
    RobotFileError
        Where it begins as no bag's does.
    """
    suffix = next((s for mark, s in MARKS.items() if data.startswith(mark)), None)
    if suffix is None:
        raise RobotFileError(f"{name} is none of ROS (.bag, .mcap or .db3)")
    return suffix


def _is_zipped_folder(data: bytes) -> bool:
    if not data.startswith(ZIP_MARK):
        return False
    try:
        names = _archives.names_in(data, what=WHAT, needed=WHAT)
    except _archives.ArchiveError:
        return False
    return any(name.lower().endswith((*ENDINGS, *PACKED)) for name in names)


def _unzipped(data: bytes) -> list[bytes]:
    try:
        names = _archives.names_in(data, what=WHAT, needed=NEEDED)
        parts = _part_names(names)
        found = _archives.unpacked(
            data,
            dict.fromkeys(parts, MAX_FILE_BYTES),
            required=parts,
            max_bytes=MAX_FILE_BYTES,
            what=WHAT,
            needed=NEEDED,
            others_ignored=True,
        )
    except _archives.ArchiveError as error:
        raise RobotFileError(str(error)) from None
    return [found[name] for name in parts]


def _part_names(names: list[str]) -> list[str]:
    """Return the names of a recording's files, in its order: 2 before 10."""
    parts = [name for name in names if name.lower().endswith(ENDINGS)]
    parts = [one for one in parts if not _base(one).startswith(".")]
    if any(name.lower().endswith(PACKED) for name in names):
        raise RobotFileError(
            "the files of this bag are compressed as a whole (.zstd), which is not "
            "read: unpack them first (unzstd)"
        )
    if not parts:
        raise RobotFileError("a bag's folder needs a .db3 or .mcap file; got none")
    if len({name.rpartition("/")[0] for name in parts}) > 1:
        folders = sorted({name.rpartition("/")[0] or "." for name in parts})
        raise RobotFileError(
            f"one bag is read at a time; got {printable(folders[0])} and "
            f"{printable(folders[1])}"
        )
    return sorted(parts, key=_place)


def _place(name: str) -> tuple[tuple[str, int], ...]:
    pieces = re.findall(r"(\D*)(\d{0,18})", name)
    return tuple((text, int(number or 0)) for text, number in pieces)


def _base(name: str) -> str:
    return name.rpartition("/")[2]

"""What a file is that is no log of scans, and where it fits instead."""

from occsim._archives import ArchiveError, names_in
from occsim.imaging import FileKind

_MISSING = "It says where a robot was, not what it saw: the scans are missing"
_PATH = "without scans it is a path for a drawing (Your building, 6 Trajectory)"
_MAP = "open it as a robot's map (Robot data, A ROS map)"

TUM_FIELDS, KITTI_FIELDS, POSE_FIELDS = 8, 12, (3, 4)
"""Numbers in a line of a trajectory: TUM's time, place and quaternion; KITTI's three
rows of a matrix; x, y, theta, or these after a time."""

_KINDS = {
    FileKind.IMAGE: "A picture shows walls, not scans: open it as a drawing (Your "
    f"building, 1 Drawing). Where it is a robot's map, {_MAP} together with its .yaml",
    FileKind.ROBOT_MAP: f"A map has no scans: {_MAP} together with its .yaml",
    FileKind.MAP_YAML: f"A map has no scans: {_MAP} together with its image",
    FileKind.PDF: "It has no scans: open it as a drawing (Your building, 1 Drawing)",
    FileKind.POSE_GRAPH: f"{_MISSING}; {_PATH}, exported as x, y, theta",
    FileKind.NUMPY: "One array has no bearings: scans are an NPZ file of several; "
    "poses alone are a path for a drawing (Your building, 6 Trajectory)",
    FileKind.MATLAB: "Scans are an NPZ file here; poses alone are a path for a drawing "
    "(Your building, 6 Trajectory)",
    FileKind.ARCHIVE: "Unpack it first",
}


def about_other_file(data: bytes, kind: FileKind) -> str:
    """Return sentences on a file that is no log: what it is, what is missing.

    Parameters
    ----------
    data : bytes
        The file's content.
    kind : FileKind
        Its kind.

    Returns
    -------
    str
        To follow "NAME is"; empty where nothing is known but its kind, or where it may
        be a damaged log.

    Examples
    --------
    >>> from occsim.imaging import kind_of_file
    >>> from occsim.io.log_advice import about_other_file
    >>> tum = b"0.5 1 2 0 0 0 0 1"
    >>> about_other_file(tum, kind_of_file(tum))[:31]
    'a trajectory in TUM format. It '
    """
    if kind is FileKind.TEXT:
        return _of_numbers(_fields(data))
    if kind is FileKind.ZIP:
        return _of_archive(data)
    return f"{kind.about}. {_KINDS[kind]}" if kind in _KINDS else ""


def _fields(data: bytes) -> int:
    """Return how many numbers the first line has that is no comment; 0 for words."""
    for line in data[:4096].decode("utf-8", "replace").splitlines():
        words = line.replace(",", " ").replace(";", " ").split()
        if words and not words[0].startswith(("#", "%", "//")):
            return len(words) if all(map(_is_number, words)) else 0
    return 0


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _of_numbers(n_fields: int) -> str:
    if n_fields == TUM_FIELDS:
        return (
            f"a trajectory in TUM format. {_MISSING}. Upload it as the trajectory of "
            f"timed scans (CSV or NPZ); {_PATH}"
        )
    if n_fields == KITTI_FIELDS:
        return (
            f"a list of poses as KITTI writes them. {_MISSING}, and there are no times "
            f"by which scans could be placed; {_PATH}"
        )
    if n_fields in POSE_FIELDS:
        return f"a table of numbers, as poses are written. {_MISSING}; {_PATH}"
    return ""


def _of_archive(data: bytes) -> str:
    try:
        names = names_in(data, what="a log", needed="a log")
    except ArchiveError:
        return ""
    if "project.json" in names:
        return "a project of this application. Open it there (Your building, 7 Keep)"
    if any(name.lower().endswith((".yaml", ".yml")) for name in names):
        return f"a zip file with a .yaml. If it is a map, it has no scans: {_MAP}"
    if not any(name.lower().endswith(".npy") for name in names):
        return "a zip archive. Unpack it and choose the log in it"
    return ""

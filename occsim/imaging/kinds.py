"""What kind of file a user's file is, and where it can be opened."""

import re
import struct
from enum import Enum

HEAD_BYTES = 4096
"""Bytes of a file that are examined; of a robot's map, all pixels are."""


class FileKind(Enum):
    """Kinds of files that users open; the value is the name for messages.

    Attributes
    ----------
    about : str
        What the file is, for a sentence: "a DWG file".
    advice : str
        What to do with it where it is no drawing.
    """

    IMAGE = "an image", "open it as a drawing"
    PDF = "a PDF", "open it as a drawing"
    ROBOT_MAP = (
        "a robot's map in ROS format",
        "open it together with its .yaml on the page Robot data",
    )
    MAP_YAML = (
        "the .yaml of a robot's map in ROS format",
        "open it together with its image on the page Robot data",
    )
    CARMEN_LOG = "a robot's log in CARMEN format", "open it on the page Robot data"
    ROS_BAG = "a ROS 1 bag", "export its scans as a CARMEN log"
    ROS_BAG_SQLITE = (
        "an SQLite database, as ROS 2 bags are",
        "export its scans as a CARMEN log",
    )
    ROS_BAG_MCAP = "an MCAP recording of ROS 2", "export its scans as a CARMEN log"
    POSE_GRAPH = "a pose graph in g2o format", "export its poses as x, y, theta"
    ZIP = (
        "a zip archive",
        "open it as a project if this application saved it, else unpack it",
    )
    ARCHIVE = "a packed archive", "unpack it and choose the drawing in it"
    NUMPY = "a NumPy array", "open it as a trajectory if it is one"
    MATLAB = "a MATLAB file", "open it as a trajectory if it is one"
    DWG = "a DWG file", "export it as PDF or PNG"
    DXF = "a DXF file", "export it as PDF or PNG"
    SVG = "an SVG file", "export it as PDF or PNG"
    IFC = "an IFC or STEP model", "export a plan of one storey as PDF or PNG"
    POSTSCRIPT = "a PostScript file", "export it as PDF or PNG"
    OFFICE = "a document of an office or CAD program", "export it as PDF or PNG"
    PHOTOSHOP = "a Photoshop file", "export it as PNG"
    HEIC = "a HEIC or AVIF photograph", "export it as JPEG or PNG"
    JPEG_2000 = "a JPEG 2000 or JPEG XL image", "export it as JPEG or PNG"
    HTML = "a web page", "save the picture in it, not the page"
    TEXT = "plain text", "open it as a trajectory if it is a table of poses"
    UNKNOWN = "a file of another kind", "export it as PDF or PNG"

    about: str
    advice: str

    def __init__(self, about: str, advice: str) -> None:
        self.about, self.advice = about, advice


IMAGES = (FileKind.IMAGE, FileKind.ROBOT_MAP)

PNG_MARK = b"\x89PNG\r\n\x1a\n"

_MARKS = (
    (rb"\x89PNG\r\n\x1a\n|\xff\xd8\xff|GIF8|BM|RIFF....WEBP", FileKind.IMAGE),
    (rb"II\*\0|MM\0\*|II\+\0|MM\0\+|P[1-7fF][\s#]", FileKind.IMAGE),
    (rb"#ROSBAG V", FileKind.ROS_BAG),
    (rb"SQLite format 3\0", FileKind.ROS_BAG_SQLITE),
    (rb"\x89MCAP", FileKind.ROS_BAG_MCAP),
    (rb"(VERTEX_SE[23]|EDGE_SE[23])\b", FileKind.POSE_GRAPH),
    (rb"PK(\x03\x04|\x05\x06)", FileKind.ZIP),
    (rb"7z\xbc\xaf|Rar!|\x1f\x8b|BZh\d|\xfd7zXZ", FileKind.ARCHIVE),
    (rb"\x93NUMPY", FileKind.NUMPY),
    (rb"MATLAB [57]|\x89HDF", FileKind.MATLAB),
    (rb"AC10|AC1\.|MC0", FileKind.DWG),
    (rb"AutoCAD Binary DXF|\s*999\r?\n|\s*0\r?\n\s*SECTION\b", FileKind.DXF),
    (rb"ISO-10303-21", FileKind.IFC),
    (rb"%!PS|\xc5\xd0\xd3\xc6", FileKind.POSTSCRIPT),
    (rb"\xd0\xcf\x11\xe0|\{\\rtf", FileKind.OFFICE),
    (rb"8BPS", FileKind.PHOTOSHOP),
    (rb"....ftyp(hei|hev|mif|msf|avi)", FileKind.HEIC),
    (rb"\0\0\0\x0c(jP|JXL) |\xff\x4f\xff\x51|\xff\x0a", FileKind.JPEG_2000),
)
_CONTENTS = (
    (rb"%PDF-", FileKind.PDF),  # readers accept some bytes before the signature
    (rb"(?i)<svg\b", FileKind.SVG),
    (rb"(?i)<!doctype html|<html\b", FileKind.HTML),
    (rb"(?m)^(FLASER|RLASER|ROBOTLASER\d|RAWLASER\d|ODOM) \S", FileKind.CARMEN_LOG),
    (rb"(?m)^PARAM \w+ \S|^# CARMEN\b", FileKind.CARMEN_LOG),
    (
        rb"(?ms)^image\s*:.*^resolution\s*:|^resolution\s*:.*^image\s*:",
        FileKind.MAP_YAML,
    ),
)
_SUFFIXES = {
    **dict.fromkeys((".yaml", ".yml"), FileKind.MAP_YAML),
    **{".bag": FileKind.ROS_BAG, ".db3": FileKind.ROS_BAG_SQLITE},
    **{".mcap": FileKind.ROS_BAG_MCAP, ".dwg": FileKind.DWG, ".dxf": FileKind.DXF},
    **dict.fromkeys((".rvt", ".skp", ".vsdx", ".dgn", ".ifc"), FileKind.OFFICE),
}
# Levels that a map server writes: occupied, unknown, free.
_MAP_LEVELS = b"\x00\xcd\xfe"
# One space at a time: with runs of them, what does not match takes time that doubles
# with each.
_PGM_HEADER = re.compile(rb"P5((?:\s|#[^\n]*\n)+\d+){3}\s")
_MAP_COMMENT = re.compile(rb"#[^\n]*(m/pix|map_saver|Map_generator)")


def png_size(data: bytes) -> tuple[int, int] | None:
    """Return width and height of a PNG image, px, by its header; None for other files.

    Parameters
    ----------
    data : bytes
        The file's content.

    Returns
    -------
    tuple of int, or None
        0 where the header is cut short.
    """
    if not data.startswith(PNG_MARK):
        return None
    # They stand first in the first chunk, big-endian.
    width, height = struct.unpack_from(">II", data[:24].ljust(24, b"\0"), 16)
    return width, height


def kind_of_file(data: bytes, name: str = "") -> FileKind:
    """Return what kind of file this is, by its content, else by its name.

    Parameters
    ----------
    data : bytes
        The file's content.
    name : str, optional
        The file's name; its suffix decides where the content says nothing.

    Returns
    -------
    FileKind
        `FileKind.ROBOT_MAP` for a PGM whose levels are those of a map server, 0, 205
        and 254, or that says so in its comment.

    Examples
    --------
    >>> kind_of_file(b"AC1032...", "floor.dwg").about
    'a DWG file'
    """
    head = data[:HEAD_BYTES]
    for pattern, kind in _MARKS:
        if re.match(pattern, head, re.DOTALL):
            is_map = kind is FileKind.IMAGE and _is_robot_map(data)
            return FileKind.ROBOT_MAP if is_map else kind
    for pattern, kind in _CONTENTS:
        if re.search(pattern, head):
            return kind
    suffix = "." + name.lower().rpartition(".")[2]
    return _SUFFIXES.get(suffix) or (
        FileKind.TEXT if _is_text(head) else FileKind.UNKNOWN
    )


def _is_robot_map(data: bytes) -> bool:
    header = _PGM_HEADER.match(data[:HEAD_BYTES])
    if header is None:
        return False
    if _MAP_COMMENT.search(header.group()):
        return True
    levels = data[header.end() :]
    # Paper is 255, so a drawing has neither of these two levels.
    has_own = b"\xcd" in levels or b"\xfe" in levels
    return has_own and not levels.translate(None, _MAP_LEVELS)


def _is_text(head: bytes) -> bool:
    if b"\0" in head:
        return head.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        head.decode("utf-8")
    except UnicodeDecodeError as error:
        return error.start > len(head) - 4  # the last character may be cut
    return True

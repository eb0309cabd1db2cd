"""The drawing board: walls, a trajectory, a length or a crop, by hand on a drawing.

One Streamlit component. Python sends the drawing, the base mask and the edits once; the
board edits by itself, shows every stroke at once and tells Python when the hand lets
go. What a stroke covers is defined in `occsim.strokes` and drawn by the same rule in
``raster.js``. The scripts beside this file are plain functions, joined here in a fixed
order into the one module that Streamlit wants.
"""

import json
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from pathlib import Path
from typing import Any

from occsim import ParameterError
from occsim.strokes import (
    LATTICE,
    Stroke,
    apply_strokes,
    decode_strokes,
    encode_strokes,
    pack_mask,
    unpack_mask,
)
from pages._ui import palette
from pages._ui.components import component, keep_state

FOLDER = Path(__file__).parent
SCRIPTS = (
    "raster.js",
    "camera.js",
    "document.js",
    "walls.js",
    "paths.js",
    "tools.js",
    "paint.js",
    "pointer.js",
    "panel.js",
    "board.js",
)
COMPONENT = "drawing_board"
HEIGHT_PX = 560
FOLD_ABOVE = 256
"""Strokes that are sent back with each commit, before the oldest join the base mask."""
FOLD_POINTS = 20_000
"""Points of strokes, likewise."""
KEEP = 128
"""Newest strokes that stay strokes then: so many can still be undone."""
KEEP_POINTS = 10_000
"""Most points of those; long scribbles leave room for fewer strokes."""
MAX_STROKE_POINTS = 2_000
"""The board simplifies a longer stroke further."""
MAX_PATH_POINTS = 5_000
"""No sketch has as many; they are resampled anyway."""


class BoardMode(Enum):
    """What is drawn on the board."""

    WALLS = "walls"
    """Strokes on a wall mask."""
    TRAJECTORY = "trajectory"
    """A polyline, by waypoints or free hand."""
    MEASURE = "measure"
    """The two ends of a length."""
    CROP = "crop"
    """Two opposite corners of a rectangle, whole pixels."""


@dataclass(frozen=True, kw_only=True, slots=True)
class BoardPoint:
    """One point of a path, a length or a crop.

    Parameters
    ----------
    x_px, y_px : float
        In the image frame, whole quarters of a pixel, inside the drawing.
    is_waypoint : bool
        Placed by a click; otherwise one of the many of a free-hand line.
    """

    x_px: float
    y_px: float
    is_waypoint: bool = True


@dataclass(frozen=True, kw_only=True, slots=True)
class BoardDocument:
    """What a board holds; one for each thing that is drawn (one mode).

    Parameters
    ----------
    height_px, width_px : int
        Size of the drawing.
    base : bytes
        Wall mask that the strokes correct, or that is shown under a path, packed by
        `occsim.strokes.pack_mask`; empty for none.
    first : int
        Number of oldest strokes that were laid into the base under this `rev`.
    strokes : tuple of Stroke
        The others, oldest first.
    points : tuple of BoardPoint
        What the other modes draw.
    rev : int
        Counts the times that Python imposed other contents; the board echoes it.
    token : str
        Tells this document from one of another session with the same `rev`.
    """

    height_px: int
    width_px: int
    base: bytes = b""
    first: int = 0
    strokes: tuple[Stroke, ...] = ()
    points: tuple[BoardPoint, ...] = ()
    rev: int = 0
    token: str = field(default_factory=lambda: secrets.token_hex(6))

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the drawing, px."""
        return self.height_px, self.width_px

    @property
    def should_fold(self) -> bool:
        """Whether so much has gathered that the oldest strokes should be folded."""
        return len(self.strokes) > FOLD_ABOVE or _n_points(self.strokes) > FOLD_POINTS

    def mask(self) -> Any:
        """Return the wall mask with all strokes, bool of shape (H, W)."""
        return apply_strokes(unpack_mask(self.base, self.shape), self.strokes)

    def folded(self) -> "BoardDocument":
        """Return the same document, all but the newest strokes laid into its base.

        To be imposed under the same `rev`: the board keeps what was drawn meanwhile.
        """
        new = self.strokes[-KEEP:]
        while _n_points(new) > KEEP_POINTS:
            new = new[1:]
        if len(new) == len(self.strokes):
            return self
        old = self.strokes[: len(self.strokes) - len(new)]
        base = apply_strokes(unpack_mask(self.base, self.shape), old)
        first = self.first + len(old)
        return replace(self, base=pack_mask(base), first=first, strokes=new)


def _n_points(strokes: tuple[Stroke, ...]) -> int:
    return sum(len(stroke.points) for stroke in strokes)


COLOURS = {
    "paper": palette.PAPER,
    "halo": palette.HALO,
    "wallMask": palette.WALL_MASK,
    "stroke": palette.STROKE,
    "eraser": palette.ERASER,
    "path": palette.PATH,
    "falseWall": palette.FALSE_WALL,
    "mark": palette.MARK,
    "crosshair": palette.CROSSHAIR,
}


def drawing_board(
    backdrop: bytes,
    document: BoardDocument,
    *,
    mode: BoardMode,
    key: str,
    on_commit: Callable[[], None] | None = None,
    metres_per_px: float | None = None,
    height_px: int = HEIGHT_PX,
) -> BoardDocument | None:
    """Show the board; return the document with what was drawn on it, if anything was.

    How the caller keeps state. Hold two documents: the one *imposed* (the argument
    here) and the one that is *current* (what this call returned last, else the imposed
    one). Pass the imposed one unchanged from run to run: the drawing travels with it,
    and any change sends both. Impose another only

    * where contents change from outside (another drawing, a project opened, a reset):
      ``replace(current, ..., rev=rev + 1)``;
    * where the page was left and entered again, the same way, so that the board starts
      from what is current;
    * where ``current.should_fold``: ``current.folded()``, with the same rev.

    Commits carry all edits since the document was imposed. They may be merged on their
    way, one that echoes an older rev is answered with None, and one that was under way
    while strokes were folded is understood. A run can be cut short by the next one, so
    the surest place to take a commit is `on_commit`, which runs first: there
    ``decode_commit(value of the key, field "committed"; imposed, mode)`` gives the same
    as this call.

    Parameters
    ----------
    backdrop : bytes
        The drawing as PNG, JPEG or WebP, of any resolution; stretched to the
        document's size.
    document : BoardDocument
        The imposed document.
    mode : BoardMode
        What is drawn.
    key : str
        Key of the component; another one for each mode on a page.
    on_commit : callable, optional
        Called before the run in which a commit arrives.
    metres_per_px : float, optional
        Scale of the drawing, for lengths in metres beside those in pixels.
    height_px : int, default 560
        Height of the board with its toolbar.

    Returns
    -------
    BoardDocument or None
        Decoded and checked; None before the first commit on this rev.
    """
    data = board_data(
        backdrop,
        document,
        mode=mode,
        key=key,
        metres_per_px=metres_per_px,
        height_px=height_px,
    )
    result = component(COMPONENT, FOLDER, SCRIPTS)(
        key=key, data=data, on_committed_change=on_commit or keep_state
    )
    return decode_commit(result.get("committed"), document, mode)


def board_data(
    backdrop: bytes,
    document: BoardDocument,
    *,
    mode: BoardMode,
    key: str,
    metres_per_px: float | None = None,
    height_px: int = HEIGHT_PX,
) -> bytes:
    """Return what the browser gets.

    Four bytes with the length of the header (little-endian), the header (JSON, UTF-8),
    the drawing as it was given, the packed base mask to the end.
    """
    header = {
        "key": key,
        "mode": mode.value,
        "token": document.token,
        "rev": document.rev,
        "width": document.width_px,
        "height": document.height_px,
        "heightPx": height_px,
        "metresPerPx": metres_per_px,
        "hasMask": bool(document.base) or mode is BoardMode.WALLS,
        "first": document.first,
        "strokes": encode_strokes(document.strokes),
        "points": [_encoded(point) for point in document.points],
        "limits": {"points": MAX_PATH_POINTS, "strokePoints": MAX_STROKE_POINTS},
        "imageBytes": len(backdrop),
        "colours": COLOURS,
    }
    encoded = json.dumps(header, separators=(",", ":"), allow_nan=False).encode()
    length = len(encoded).to_bytes(4, "little")
    return length + encoded + backdrop + document.base


def _encoded(point: BoardPoint) -> list[int]:
    x, y = round(point.x_px * LATTICE), round(point.y_px * LATTICE)
    return [x, y, int(point.is_waypoint)]


def decode_commit(
    commit: object, document: BoardDocument, mode: BoardMode
) -> BoardDocument | None:
    """Return the document with the edits that a browser committed, all of it checked.

    Anything may come: what is no commit on this document, or holds anything that the
    board does not write, gives None.
    """
    if not isinstance(commit, Mapping):
        return None
    if (commit.get("rev"), commit.get("token")) != (document.rev, document.token):
        return None
    try:
        if mode is BoardMode.WALLS:
            return _with_strokes(document, commit)
        points = _decoded_points(commit.get("points"), document, mode)
        return replace(document, points=points)
    except ParameterError:
        return None


def _with_strokes(
    document: BoardDocument, commit: Mapping[str, object]
) -> BoardDocument:
    first = commit.get("first")
    # A board never counts further than Python has told it to.
    if type(first) is not int or not 0 <= first <= document.first:
        raise ParameterError(f"first must lie in [0, {document.first}]; got {first!r}")
    strokes = decode_strokes(commit.get("strokes"))
    # Those that were folded while this commit was under way are in the base already.
    return replace(document, strokes=strokes[document.first - first :])


def _decoded_points(
    encoded: object, document: BoardDocument, mode: BoardMode
) -> tuple[BoardPoint, ...]:
    most = MAX_PATH_POINTS if mode is BoardMode.TRAJECTORY else 2
    if not isinstance(encoded, list) or len(encoded) > most:
        raise ParameterError(f"points must be a list of at most {most}")
    if mode is not BoardMode.TRAJECTORY and len(encoded) == 1:
        raise ParameterError("points must be none or two; got 1")
    return tuple(_decoded(point, document) for point in encoded)


def _decoded(point: object, document: BoardDocument) -> BoardPoint:
    if not isinstance(point, list) or [type(n) for n in point] != [int, int, int]:
        raise ParameterError(f"a point must be three whole numbers; got {point!r:.40}")
    x, y, kind = point
    bounds = document.width_px * LATTICE, document.height_px * LATTICE
    if not (0 <= x <= bounds[0] and 0 <= y <= bounds[1] and kind in (0, 1)):
        raise ParameterError("a point must lie inside the drawing")
    return BoardPoint(x_px=x / LATTICE, y_px=y / LATTICE, is_waypoint=bool(kind))

"""The drawing board: walls, a trajectory, a length or a crop, drawn on a drawing.

One Streamlit component. Python sends the drawing, the walls and the corrections over
them once; the board edits the corrections by itself and, at the end of each gesture,
tells Python which tiles differ from what was sent, pixel by pixel. The scripts beside
this file are plain functions, joined here in a fixed order into the single module that
Streamlit expects.
"""

import base64
import binascii
import secrets
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from pathlib import Path
from typing import Any

from occsim import Corrections, ParameterError
from occsim.corrections import TILE_PX, unpack_mask
from pages._ui import palette
from pages._ui.components import component, keep_state, packed

FOLDER = Path(__file__).parent
SCRIPTS = (
    "raster.js",
    "camera.js",
    "document.js",
    "walls.js",
    "doubt.js",
    "paths.js",
    "tools.js",
    "paint.js",
    "pointer.js",
    "panel.js",
    "board.js",
)
COMPONENT = "drawing_board"
HEIGHT_PX = 560
MAX_PATH_POINTS = 5_000
"""Most points of a path; no sketch needs as many."""


class BoardMode(Enum):
    """What is drawn on the board."""

    WALLS = "walls"
    """Corrections over a wall mask."""
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
        In the image frame, inside the drawing.
    is_waypoint : bool
        Placed by a click; otherwise a point of a free-hand line.
    """

    x_px: float
    y_px: float
    is_waypoint: bool = True


@dataclass(frozen=True, kw_only=True, slots=True)
class BoardDocument:
    """The content of a board in one mode.

    Parameters
    ----------
    height_px, width_px : int
        Size of the drawing.
    base : bytes
        Wall mask that is corrected, or that is shown under a path, packed by
        `occsim.corrections.pack_mask`; empty for none.
    overlay : Corrections or None
        Corrections of that mask; None for no corrections.
    doubtful : bytes
        Pieces to be accepted or removed, packed in the same way; empty for none.
    points : tuple of BoardPoint
        The points drawn in the other modes.
    rev : int
        Counts the times that Python imposed other contents; the board echoes it.
    token : str
        Distinguishes this document from one of another session with the same `rev`.
    """

    height_px: int
    width_px: int
    base: bytes = b""
    overlay: Corrections | None = None
    doubtful: bytes = b""
    points: tuple[BoardPoint, ...] = ()
    rev: int = 0
    token: str = field(default_factory=lambda: secrets.token_hex(6))

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the drawing, px."""
        return self.height_px, self.width_px

    @property
    def corrections(self) -> Corrections:
        """The corrections, possibly empty."""
        return self.overlay or Corrections.none(self.shape)

    def mask(self) -> Any:
        """Return the corrected wall mask, bool of shape (H, W)."""
        return self.corrections.apply(unpack_mask(self.base, self.shape))


COLOURS = {
    "paper": palette.PAPER,
    "halo": palette.HALO,
    "wallMask": palette.WALL_MASK,
    "doubtful": palette.DOUBTFUL,
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
    from the current contents; if it remembers the same contents, its undo history
    stays.

    Commits carry all edits since the document was imposed. They may be merged or lost
    in transit: the last one is complete. One that echoes an older rev is answered with
    None. A run can be cut short by the next one, so the surest place to take a commit
    is `on_commit`, which runs first: there ``decode_commit(value of the key, field
    "committed"; imposed, mode)`` gives the same as this call.

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
    """Return what the browser gets: header, drawing, walls, corrections, doubts."""
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
        "points": [[p.x_px, p.y_px, int(p.is_waypoint)] for p in document.points],
        "maxPoints": MAX_PATH_POINTS,
        "tilePx": TILE_PX,
        "colours": COLOURS,
    }
    return packed(
        header,
        backdrop,
        document.base,
        document.corrections.packed,
        document.doubtful,
    )


def decode_commit(
    commit: object, document: BoardDocument, mode: BoardMode
) -> BoardDocument | None:
    """Return the document with the edits that a browser committed, all of it checked.

    The input is not trusted: anything that is not a commit on this document, or that
    the board would not write, gives None.
    """
    if not isinstance(commit, Mapping):
        return None
    if (commit.get("rev"), commit.get("token")) != (document.rev, document.token):
        return None
    try:
        if mode is BoardMode.WALLS:
            tiles = _decoded_bytes(commit.get("tiles"), document)
            return replace(document, overlay=document.corrections.with_tiles(tiles))
        points = _decoded_points(commit.get("points"), document, mode)
        return replace(document, points=points)
    except ParameterError:
        return None


def _decoded_bytes(encoded: object, document: BoardDocument) -> bytes:
    # Two bits a pixel in whole tiles are a third of a character in base64; half a
    # character leaves room for what packing adds where it gains nothing.
    area = (document.height_px + TILE_PX) * (document.width_px + TILE_PX)
    if not isinstance(encoded, str) or len(encoded) > area // 2:
        raise ParameterError("tiles must be text, no longer than the drawing allows")
    try:
        return base64.b64decode(encoded, validate=True)
    except (binascii.Error, ValueError):  # ValueError: characters beyond ASCII
        raise ParameterError("tiles must be base64; they are not") from None


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
    if not isinstance(point, list) or len(point) != 3:
        raise ParameterError("a point must be a list of three numbers")
    x, y, kind = point
    if type(x) not in (int, float) or type(y) not in (int, float):
        raise ParameterError("the place of a point must be two numbers")
    # Also false for NaN, which compares with nothing.
    if not (0 <= x <= document.width_px and 0 <= y <= document.height_px):
        raise ParameterError("a point must lie inside the drawing")
    if type(kind) is not int or kind not in (0, 1):
        raise ParameterError("a point must be a waypoint, 1, or not, 0")
    return BoardPoint(x_px=float(x), y_px=float(y), is_waypoint=bool(kind))

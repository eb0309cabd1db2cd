"""The drawing board of this page, tied to the building that is drawn on."""

from collections.abc import Callable

from occsim.strokes import Stroke, pack_mask
from pages._ui import compute, state
from pages._ui.board import BoardDocument, BoardMode, BoardPoint, drawing_board
from pages._ui.workshop import state as kept

HEIGHT_PX = 520
"""The board and what stands above it fit in 720 px."""

Source = tuple[object, ...]


def board(
    key: str, mode: BoardMode, source: Source, make: Callable[[], BoardDocument]
) -> BoardDocument | None:
    """Show a board; return what it holds if a hand has changed it."""
    building = state.building()
    drawn = drawing_board(
        compute.backdrop(building.drawing),
        kept.board_document(key, source, make),
        mode=mode,
        key=key,
        metres_per_px=building.metres_per_px,
        height_px=HEIGHT_PX,
    )
    return None if drawn is None or drawn == kept.on_board(key) else drawn


def document(**contents: object) -> BoardDocument:
    """A new document of the size of the drawing."""
    height, width = state.building().drawing.shape
    return BoardDocument(height_px=height, width_px=width, **contents)


def mask_board(key: str, layer: str) -> None:
    """Show the board that corrects a mask of the building, ``walls`` or ``truth``."""
    mask = getattr(state.building(), layer)
    drawn = board(
        key,
        BoardMode.WALLS,
        (mask,),
        lambda: document(base=pack_mask(mask.base), strokes=mask.strokes),
    )
    if drawn is None:
        return
    # The board sends no strokes that are in its base already.
    strokes: tuple[Stroke, ...] = mask.strokes[: drawn.first] + drawn.strokes
    corrected = mask.with_strokes(strokes)
    state.edit(lambda: state.edit_building(**{layer: corrected}), tag=key)
    kept.take_from_board(key, drawn, (corrected,))


def points_board(
    key: str,
    mode: BoardMode,
    take: Callable[[tuple[BoardPoint, ...]], None] = lambda points: None,
) -> tuple[BoardPoint, ...]:
    """Show a board on which two points are set; return those that it holds.

    Points that are new are given to `take`.
    """
    source = (state.building().drawing,)
    drawn = board(key, mode, source, document)
    if drawn is not None:
        kept.take_from_board(key, drawn, source)
        take(drawn.points)
    return kept.on_board(key).points

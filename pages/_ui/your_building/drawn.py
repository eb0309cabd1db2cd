"""The drawing board of this page, tied to the building that is drawn on."""

from collections.abc import Callable

from occsim import Corrections
from occsim.corrections import pack_mask
from pages._ui import compute, state
from pages._ui.components.board import (
    BoardDocument,
    BoardMode,
    BoardPoint,
    drawing_board,
)
from pages._ui.state import boards as kept

HEIGHT_PX = 520
"""The board and what stands above it fit in 720 px."""


def board(
    key: str,
    mode: BoardMode,
    source: Callable[[], kept.Source],
    make: Callable[[], BoardDocument],
    take: Callable[[BoardDocument], None],
) -> BoardDocument:
    """Show a board; return what it holds.

    What a hand has changed is given to `take`: in the callback, before the script runs,
    so that all of the page speaks of it; after the script, for a commit that came
    without its callback; before it, for an edit that the last stroke cut short.
    """

    def take_new(drawn: BoardDocument | None) -> None:
        if drawn is not None and drawn != kept.on_board(key):
            take(drawn)

    building = state.building()
    cut_short = kept.unfinished(key, source())
    if cut_short is not None:
        take(cut_short)
    returned = drawing_board(
        compute.backdrop(building.drawing),
        kept.board_document(key, source(), make),
        mode=mode,
        key=key,
        on_commit=lambda: take_new(kept.committed(key, mode)),
        metres_per_px=building.metres_per_px,
        height_px=HEIGHT_PX,
    )
    take_new(returned)
    return kept.on_board(key)


def document(**contents: object) -> BoardDocument:
    """A new document of the size of the drawing."""
    height, width = state.building().drawing.shape
    return BoardDocument(height_px=height, width_px=width, **contents)


def walls_board(key: str) -> None:
    """Show the board that corrects the walls found."""

    def source(corrections: Corrections) -> kept.Source:
        return state.building().walls_found, corrections

    def shown() -> kept.Source:
        return source(state.building().corrections)

    def make() -> BoardDocument:
        found, corrections = shown()
        return document(base=pack_mask(found), overlay=corrections)

    def take(drawn: BoardDocument) -> None:
        after = drawn.corrections
        with kept.taking(key, drawn, shown(), source(after)):
            state.edit(lambda: state.edit_building(corrections=after), tag=key)

    board(key, BoardMode.WALLS, shown, make, take)


def truth_board(key: str) -> None:
    """Show the board on which the ground truth is drawn."""

    def shown() -> kept.Source:
        return (state.building().truth,)

    def take(drawn: BoardDocument) -> None:
        after = drawn.mask()
        with kept.taking(key, drawn, shown(), (after,)):
            state.edit(lambda: state.edit_building(truth=after), tag=key)

    board(
        key,
        BoardMode.WALLS,
        shown,
        lambda: document(base=pack_mask(state.building().truth)),
        take,
    )


def points_board(
    key: str,
    mode: BoardMode,
    use: Callable[[tuple[BoardPoint, ...]], None] = lambda points: None,
) -> tuple[BoardPoint, ...]:
    """Show a board on which two points are set; return those that it holds.

    Points that are new are given to `use`.
    """

    def source() -> kept.Source:
        return (state.building().drawing,)

    def take(drawn: BoardDocument) -> None:
        with kept.taking(key, drawn, source(), source()):
            use(drawn.points)

    return board(key, mode, source, document, take).points

"""The drawing board of this page, tied to the building."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from occsim.corrections import pack_mask
from pages._ui import state
from pages._ui.components.board import (
    BoardDocument,
    BoardMode,
    BoardPoint,
    drawing_board,
)
from pages._ui.state import boards as kept
from pages._ui.your_building import detecting

HEIGHT_PX = 480
"""Height that lets the board and the controls above it fit in 720 px."""


@dataclass(frozen=True)
class Paper:
    """What a board lies on: a picture, its scale, and the board's height."""

    picture: bytes
    metres_per_px: float | None
    height_px: int = HEIGHT_PX


def drawing_paper() -> Paper:
    """The building's drawing."""
    building = state.building()
    return Paper(detecting.backdrop(building.drawing), building.metres_per_px)


def board(
    key: str,
    mode: BoardMode,
    source: Callable[[], kept.Source],
    make: Callable[[], BoardDocument],
    take: Callable[[BoardDocument], None],
    *,
    paper: Paper | None = None,
) -> BoardDocument:
    """Show a board of some parts of the building, `source`; return its document.

    It lies on the building's drawing, or on another paper.

    Changes go to `take`, an edit that can be undone: in the callback, before the script
    runs, so that the whole page shows them; after the script, for a commit that came
    without its callback.
    """

    def take_new(drawn: BoardDocument | None) -> None:
        if drawn is not None and drawn != kept.on_board(key):
            state.edit(partial(_taken, drawn), tag=key)

    def _taken(drawn: BoardDocument) -> None:
        take(drawn)
        kept.note(key, drawn, source())

    def take_committed() -> None:
        take_new(kept.committed(key, mode))

    kept.keep_taker(key, take_committed)
    paper = paper or drawing_paper()
    returned = drawing_board(
        paper.picture,
        kept.board_document(key, source(), make),
        mode=mode,
        key=key,
        on_commit=take_committed,
        metres_per_px=paper.metres_per_px,
        height_px=paper.height_px,
    )
    take_new(returned)
    return kept.on_board(key)


def document(**contents: object) -> BoardDocument:
    """A new document of the size of the drawing."""
    height, width = state.building().drawing.shape
    return BoardDocument(height_px=height, width_px=width, **contents)


def walls_board(key: str) -> None:
    """Show the board that corrects the walls found."""

    def shown() -> kept.Source:
        return state.building().walls_found, state.building().corrections

    def make() -> BoardDocument:
        found, corrections = shown()
        return document(
            base=pack_mask(found),
            overlay=corrections,
            doubtful=detecting.doubtful(state.building()),
        )

    def take(drawn: BoardDocument) -> None:
        state.edit_building(corrections=drawn.corrections)

    board(key, BoardMode.WALLS, shown, make, take)


def truth_board(key: str) -> None:
    """Show the board on which the ground truth is drawn."""

    def shown() -> kept.Source:
        return (state.building().truth,)

    def make() -> BoardDocument:
        return document(base=pack_mask(state.building().truth))

    def take(drawn: BoardDocument) -> None:
        state.edit_building(truth=drawn.mask())

    board(key, BoardMode.WALLS, shown, make, take)


def points_board(
    key: str,
    mode: BoardMode,
    use: Callable[[tuple[BoardPoint, ...]], None] = lambda points: None,
) -> tuple[BoardPoint, ...]:
    """Show a board on which two points are set; return those that it holds.

    New points are passed to `use`.
    """

    def source() -> kept.Source:
        return (state.building().drawing,)

    return board(key, mode, source, document, lambda drawn: use(drawn.points)).points

"""The setting of one map among several: drawing, prior, rule, readings and cells."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import Enum

from occsim import BehindHit, DrawingFlaws, UpdateRule
from occsim.prior import SOURCE_PAIR
from pages._ui.choices import CellModel, Flaw, Laps, PriorDrawing

FLAWS: Mapping[Flaw, DrawingFlaws] = {
    Flaw.FOUND: DrawingFlaws(),
    Flaw.THIN_1: DrawingFlaws(thickness_px=-1),
    Flaw.THIN_2: DrawingFlaws(thickness_px=-2),
    Flaw.THIN_3: DrawingFlaws(thickness_px=-3),
    Flaw.THICK_2: DrawingFlaws(thickness_px=2),
    Flaw.SHIFTED: DrawingFlaws(shift_x_px=6),
    Flaw.MISSING: DrawingFlaws(missing_share=0.2),
    Flaw.FALSE: DrawingFlaws(false_share=0.2),
}
"""The errors of a drawing that a map can be given by name."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Column:
    """One map of the player.

    Parameters
    ----------
    prior_drawing : PriorDrawing
        The drawing that the prior is made from.
    flaw : Flaw
        What that drawing gets wrong.
    p_wall, p_space : float
        The prior pair.
    calibrated : bool
        Take the pair from the drawing's own cells and the truth instead.
    uninformative : bool
        A prior of one half everywhere: no drawing at all.
    rule : UpdateRule
        How a reading enters the map.
    behind_hit : BehindHit
        What a reading says of the pixels behind the wall that it meets.
    cell_px : int
        Side of a cell, px.
    model : CellModel
        What the map keeps of each cell: log-odds, or gmapping's counts, which take no
        prior.
    laps : Laps
        How often the robot has driven its tour: each lap adds the same readings again.
    """

    prior_drawing: PriorDrawing = PriorDrawing.OWN
    flaw: Flaw = Flaw.FOUND
    p_wall: float = SOURCE_PAIR[0]
    p_space: float = SOURCE_PAIR[1]
    calibrated: bool = False
    uninformative: bool = False
    rule: UpdateRule = UpdateRule.PRIOR_ONCE
    behind_hit: BehindHit = BehindHit.OCCUPIED
    cell_px: int = 3
    model: CellModel = CellModel.LOG_ODDS
    laps: Laps = Laps.ONE


MIN_COLUMNS, MAX_COLUMNS = 2, 3
OPENING_COLUMNS = (Column(), Column(rule=UpdateRule.SUBTRACT_PRIOR))
"""The page of two maps opens with the two update rules."""
HOME_SAMPLE = "e"
HOME_COLUMNS = (
    Column(uninformative=True),
    Column(),
    Column(prior_drawing=PriorDrawing.D),
)
"""The home page maps a building with no drawing, with its own, and with another's."""
LOG_COLUMNS = (Column(uninformative=True, behind_hit=BehindHit.UNSEEN, cell_px=1),)
"""A robot's log is mapped without a drawing, in cells of one pixel of its own map."""
DRAWN_COLUMNS = (*LOG_COLUMNS, Column(behind_hit=BehindHit.UNSEEN, cell_px=1))
"""The same, and a map with the drawing that was registered on it."""
_LETTERS = dict(
    zip("dfwscurbzml", [one.name for one in fields(Column)], strict=True),
)
"""The field that each letter stands for in a link."""


def columns_text(columns: tuple[Column, ...]) -> str:
    """Return columns as short text for a link: what departs from a default column."""
    return "--".join("-".join(_departures(column)) for column in columns)


def _departures(column: Column) -> list[str]:
    default = Column()
    return [
        letter + plain(getattr(column, name))
        for letter, name in _LETTERS.items()
        if getattr(column, name) != getattr(default, name)
    ]


def plain(value: object) -> str:
    """Return a choice, a switch or a number as text for a link."""
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, bool):
        return "1" if value else "0"
    return repr(value)


def columns_given(text: str) -> list[dict[str, str]]:
    """Return what a text of `columns_text` says of each column, values unchecked.

    Raises
    ------
    ValueError
        Where a letter stands for no field, or there are too few or too many columns.
    """
    given = [
        {_field_of(part[0]): part[1:] for part in column.split("-") if part}
        for column in text.split("--")
    ]
    if not MIN_COLUMNS <= len(given) <= MAX_COLUMNS:
        raise ValueError(
            f"columns must be {MIN_COLUMNS} or {MAX_COLUMNS} maps; got {len(given)}"
        )
    return given


def _field_of(letter: str) -> str:
    if letter not in _LETTERS:
        raise ValueError(f"columns have no field {letter!r}")
    return _LETTERS[letter]

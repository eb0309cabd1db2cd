"""The examples of the page of two maps: a button each, and the maps that it shows."""

from occsim import UpdateRule
from pages._ui.choices import Flaw, PriorDrawing
from pages._ui.columns import OPENING_COLUMNS, Column

SUBTRACT = UpdateRule.SUBTRACT_PRIOR
BOLD = (0.1, 1.0)
"""At p_wall = 0.1 one clear look cannot free a wall that is not there: 0.9 * p_wall
must exceed 0.1, what a reading says of a wall."""

Example = tuple[str, tuple[Column, ...]]


def examples(drawings: tuple[PriorDrawing, ...]) -> list[Example]:
    """Return label and maps of each example; the wrong drawing has the same size."""
    wrong = Column(prior_drawing=_another(drawings))
    bold = Column(p_wall=BOLD[0], p_space=BOLD[1])
    thin = Column(rule=SUBTRACT, flaw=Flaw.THIN_2)
    return [
        ("Once or subtract", OPENING_COLUMNS),
        ("Drawing or none", (Column(), Column(uninformative=True))),
        ("Right or wrong drawing", (Column(), wrong)),
        ("Bold or humble", (bold, Column())),
        ("As found or thinned by 2 px", (Column(rule=SUBTRACT), thin)),
        ("3 or 1 px cells", (Column(), Column(cell_px=1))),
    ]


def _another(drawings: tuple[PriorDrawing, ...]) -> PriorDrawing:
    """The first sample of this size, else the building's own drawing mirrored."""
    samples = [one for one in drawings if len(one.value) == 1]
    return samples[0] if samples else PriorDrawing.MIRRORED

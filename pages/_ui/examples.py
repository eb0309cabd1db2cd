"""The examples of the page of two maps: a button each, and the maps that it shows."""

from dataclasses import replace

from occsim import UpdateRule
from pages._ui.choices import CellModel, Flaw, PriorDrawing
from pages._ui.columns import MAX_COLUMNS, OPENING_COLUMNS, Column

COUNTS = CellModel.HITS_VISITS
SUBTRACT = UpdateRule.SUBTRACT_PRIOR
BOLD = (0.1, 1.0)
"""At p_wall = 0.1 one clear look cannot free a wall that is not there: 0.9 * p_wall
must exceed 0.1, what a reading says of a wall."""
LINE_UP = {UpdateRule.PRIOR_ONCE: "once", SUBTRACT: "taken off"}

Example = tuple[str, tuple[Column, ...]]


def examples(
    drawings: tuple[PriorDrawing, ...], lesson: int | None = None
) -> list[Example]:
    """Return label and maps of each example; the wrong drawing has the same size.

    In a lesson they are those that it is about.
    """
    of_lesson = {4: _of_lesson_4, 5: _of_lesson_5}
    return of_lesson.get(lesson, _all)(drawings)


def _of_lesson_4(_: tuple[PriorDrawing, ...]) -> list[Example]:
    blank, control = Column(uninformative=True), Column(p_wall=0.12, p_space=0.12)
    return [
        ("Drawing or none", (Column(), blank)),
        ("Drawing or control", (Column(), control)),
        ("3 or 1 px cells, none", (blank, replace(blank, cell_px=1))),
    ]


def _of_lesson_5(drawings: tuple[PriorDrawing, ...]) -> list[Example]:
    lined_up = [PriorDrawing.OWN, *others(drawings)][:MAX_COLUMNS]
    return [
        ("Once or subtract", OPENING_COLUMNS),
        *(
            (
                f"Line-up, {label}",
                tuple(Column(prior_drawing=one, rule=rule) for one in lined_up),
            )
            for rule, label in LINE_UP.items()
        ),
    ]


def _all(drawings: tuple[PriorDrawing, ...]) -> list[Example]:
    wrong = Column(prior_drawing=others(drawings)[0])
    bold = Column(p_wall=BOLD[0], p_space=BOLD[1])
    thin = Column(rule=SUBTRACT, flaw=Flaw.THIN_2)
    return [
        ("Once or subtract", OPENING_COLUMNS),
        ("Drawing or none", (Column(), Column(uninformative=True))),
        ("Right or wrong drawing", (Column(), wrong)),
        ("Bold or humble", (bold, Column())),
        ("As found or thinned by 2 px", (Column(rule=SUBTRACT), thin)),
        ("Log-odds or counts", (Column(uninformative=True), Column(model=COUNTS))),
        ("3 or 1 px cells", (Column(), Column(cell_px=1))),
    ]


def others(drawings: tuple[PriorDrawing, ...]) -> list[PriorDrawing]:
    """The samples of this size, else the building's own drawing mirrored."""
    samples = [one for one in drawings if len(one.value) == 1]
    return samples or [PriorDrawing.MIRRORED]

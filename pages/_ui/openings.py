"""What a drawing, an exercise and a class open with, and how a link says it."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from occsim import load_sample
from occsim.building import Building
from occsim.exercises import Exercise
from pages._ui.classroom.prepared import Prepared
from pages._ui.columns import Column
from pages._ui.components.lens.document import OPENING as LENS_OPENING
from pages._ui.components.lens.document import LensDocument, link_texts, with_texts
from pages._ui.settings import TABLE, Settings, column_with, encode, with_changes

LENS_PREFIX = "lens_"
"""Of the lens's names in a link."""


def of_building(building: Building) -> Settings:
    """The settings that a drawing opens with: the range is the length of its doors."""
    door_px = building.door_px or building.sensor.range_px
    bounds = TABLE["range_px"]
    return Settings(range_px=round(min(max(door_px, bounds.low), bounds.high)))


def of_sample(name: str) -> Settings:
    """The settings that a reference drawing opens with."""
    return of_building(load_sample(name))


def of_exercise(exercise: Exercise) -> Settings:
    """The settings that an exercise opens with; those it does not name are defaults."""
    own = {name: value for name, value in exercise.settings.items() if name in TABLE}
    settings = with_changes(of_sample(exercise.setup.drawing), own)
    if exercise.page == "two_maps":
        settings = replace(settings, columns=_columns(exercise))
    return settings


def _columns(exercise: Exercise) -> tuple[Column, ...]:
    """Map A is the student's; map B the reference of the exercise, or no drawing."""
    own = _column(exercise.settings)
    reference = exercise.context.reference
    other = _column(reference) if reference else Column(uninformative=True)
    return own, other


def _column(given: Mapping[str, Any]) -> Column:
    names = {one.name for one in fields(Column)}
    return column_with(
        Column(), {name: value for name, value in given.items() if name in names}
    )


def middle(cell: tuple[int, int], cell_px: int) -> tuple[float, float]:
    """The middle of a cell, px of the drawing."""
    row, col = cell
    return (col + 0.5) * cell_px, (row + 0.5) * cell_px


def lens_of_exercise(exercise: Exercise) -> LensDocument:
    """The lens as an exercise opens it."""
    setup = exercise.setup
    x, y, degrees = setup.lens_pose
    made = LensDocument(
        x_px=x,
        y_px=y,
        heading_deg=degrees,
        cell_px=setup.lens_cell_px,
        behind_hit=setup.behind_hit,
        clear_no_hit=setup.clear_no_hit,
        fov_deg=round(setup.fov_deg),
        p_free=setup.prior.p_free_wall,
        rule=setup.rule,
    )
    if setup.range_px is not None:
        made = replace(made, range_px=round(setup.range_px))
    if setup.lens_cell is None:
        return made
    row, col = setup.lens_cell
    return replace(made, row=row, col=col)


def lens_of_class(prepared: Prepared) -> LensDocument:
    """The lens as a class opens it."""
    return with_texts(LENS_OPENING, lens_texts(prepared.texts))[0]


def lens_texts(query: Mapping[str, str]) -> dict[str, str]:
    """What a link says of the lens."""
    return {
        name.removeprefix(LENS_PREFIX): text
        for name, text in query.items()
        if name.startswith(LENS_PREFIX)
    }


def texts_of_exercise(exercise: Exercise) -> dict[str, str]:
    """What a link says that opens an exercise as it begins."""
    setup, name = exercise.setup, exercise.setup.drawing
    settings = of_exercise(exercise)
    last = len(load_sample(name).trajectory)
    texts = {
        "drawing": name,
        **encode(settings, of_sample(name)),
        "step": str(last if setup.step == "end" else setup.step),
        "exercise": exercise.id,
    }
    if setup.cell is not None:
        point = middle(setup.cell, settings.cell_px)
        texts["pin"] = ",".join(f"{at:g}" for at in point)
    if exercise.page == "what_the_sensor_says":
        lens = link_texts(lens_of_exercise(exercise))
        texts |= {LENS_PREFIX + name: text for name, text in lens.items()}
    return texts

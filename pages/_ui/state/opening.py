"""The settings that a drawing, an exercise and a class open with."""

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import streamlit as st

from occsim import load_sample
from occsim.exercises import Exercise
from pages._ui.classroom.prepared import Prepared
from pages._ui.columns import Column
from pages._ui.components.lens.document import OPENING as LENS_OPENING
from pages._ui.components.lens.document import LensDocument, with_texts
from pages._ui.settings import TABLE, Settings, column_with, decode, with_changes

OWN = "own"
LENS_PREFIX = "lens_"
"""Of the lens's names in a link."""


def defaults(name: str) -> Settings:
    """The settings that a drawing opens with: the range is the length of its doors."""
    own = st.session_state.own if name == OWN else load_sample(name)
    door_px = own.door_px or own.sensor.range_px
    bounds = TABLE["range_px"]
    return Settings(range_px=round(min(max(door_px, bounds.low), bounds.high)))


def of_exercise(exercise: Exercise) -> Settings:
    """The settings that an exercise opens with; those it does not name are defaults."""
    own = {name: value for name, value in exercise.settings.items() if name in TABLE}
    settings = with_changes(defaults(exercise.setup.drawing), own)
    if exercise.page == "two_maps":
        settings = replace(settings, columns=_columns(exercise))
    return settings


def of_class(prepared: Prepared, name: str) -> Settings:
    """The settings that a class opens with on a drawing."""
    settings, _ = decode(prepared.texts, defaults(name))
    return settings


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

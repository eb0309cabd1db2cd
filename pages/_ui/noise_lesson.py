"""What the sensor's errors do to a map without a drawing and to one with it."""

import streamlit as st

from occsim import MappingRun, MapSettings, Prior
from occsim.building import Building
from occsim.run import NoiseEffect, noise_effect
from pages._ui import compute, state, words
from pages._ui.settings import Settings, with_changes
from pages._ui.shared import shared

N_SEEDS = 10
"""Errors are drawn at random: one draw would say little."""
LESSON = {"sigma_0_m": 0.05}
"""Range noise of 5 cm, where the student has chosen no errors."""
TRIED = "noise_tried"
FINDING = (
    "Range noise of 5 cm lowers F2 of the map with the drawing on all five reference "
    "drawings as they open, by 2 to 7 points. The map without a drawing loses on a, b "
    "and d, and gains on c and e. With the errors the map with the drawing is still "
    "the better one on all five; but it does not lose less everywhere, so a drawing is "
    "no remedy for noise."
)
MAPS = {"Without a drawing": Prior.uninformative(), "With the drawing, once": Prior()}


def section() -> None:
    """Draw the finding, and a button that computes it for what is chosen here."""
    with st.expander("What do the sensor's errors do?"):
        st.markdown(FINDING)
        settings = chosen(state.settings())
        building = state.building()
        key = repr((building.digest, settings.mapping))
        if st.button(f"Compute it here, with {N_SEEDS} seeds"):
            state.set_view(TRIED, key)
        if state.view(TRIED, None) == key:
            st.markdown(table(effects(building, settings)))
            st.caption(
                f"F2 of the cells looked at after the last reading, cells of "
                f"{settings.cell_px} px, {settings.scan.n_beams} beams; "
                f"{_errors(settings)}. Mean and its 95 % interval "
                f"(Student's t) over {N_SEEDS} seeds; the prior is (0.2, 0.9)."
            )


def chosen(settings: Settings) -> Settings:
    """The student's settings; with the lesson's errors where they have none."""
    return settings if settings.noise else with_changes(settings, LESSON)


def _errors(settings: Settings) -> str:
    default = with_changes(settings, LESSON).noise == settings.noise
    return "range noise of 5 cm" if default else "the errors chosen above"


def effects(building: Building, settings: Settings) -> list[NoiseEffect]:
    """What the errors of some settings do to each of the maps."""
    compute.mapped(building, settings.mapping)  # refuses what would take too long
    anonymous = compute.anonymous(building)
    return _effects(building.digest, settings.mapping, anonymous)


@shared("Drawing errors with ten seeds")
def _effects(
    digest: str, settings: MapSettings, _building: Building
) -> list[NoiseEffect]:
    with compute.core():
        run = MappingRun(_building, settings)
        return noise_effect(run, list(MAPS.values()), n_seeds=N_SEEDS)


def table(found: list[NoiseEffect]) -> str:
    """The effects as a table of Markdown."""
    head = (
        "| map | F2 without errors | with them | change, points |\n|---|--:|--:|--:|\n"
    )
    return head + "".join(
        f"| {name} | {words.percent(one.exact)} | {words.percent(one.mean)} | "
        f"{words.number(100 * one.change, '+.1f')} ± "
        f"{words.number(100 * one.half_width, '.1f')} |\n"
        for name, one in zip(MAPS, found, strict=True)
    )

"""The parts of the home page: what its maps come to, the path of lessons, the plans."""

from dataclasses import replace

import streamlit as st

from occsim import Prior, UpdateRule
from occsim.building import Building
from pages._ui import compute, shell, state, words
from pages._ui.columns import HOME_COLUMNS, Column
from pages._ui.components.player import PlayerDocument
from pages._ui.settings import Settings

TWO_MAPS = "pages/3_Two_maps.py"
YOUR_BUILDING = "pages/2_Your_building.py"
OWN, WRONG = HOME_COLUMNS[1:]
FINDING = (
    "The wrong drawing now beats the right one. Find out why: Two maps, one clock."
)
PLAN = (
    (5, "app.py", "watch the maps above, and vote"),
    (
        8,
        "pages/0_What_the_sensor_says.py",
        "one reading of one cell, in pairs (exercise 1)",
    ),
    (
        7,
        "pages/0_What_the_sensor_says.py",
        "how readings add up, at the board (exercise 4)",
    ),
    (10, TWO_MAPS, "with a drawing or without one (exercises 9 and 10)"),
    (12, TWO_MAPS, "each third of the class tries one drawing (exercise 16)"),
    (3, "app.py", "switch the rule, and vote again"),
)
"""A lesson of 45 minutes: minutes, page, what to do there."""


# --- What the maps come to ------------------------------------------------------------


def final_f2(building: Building, settings: Settings, column: Column) -> float:
    """F2 of the cells looked at after the last reading of one of the maps."""
    drawn = compute.fitting(building, column.prior_drawing, settings.flaws)
    run = compute.mapped(building, settings.mapping_of(column)).with_prior_mask(
        compute.drawn_mask(building, drawn)
    )
    pair = Prior(p_wall=column.p_wall, p_space=column.p_space)
    return run.scores(pair, column.rule).f2


def wrong_beats_right(building: Building, settings: Settings) -> bool:
    """Whether the wrong drawing gives the better map only where it is counted again."""
    once, again = (
        [
            final_f2(building, settings, replace(column, rule=rule))
            for column in (OWN, WRONG)
        ]
        for rule in UpdateRule
    )
    return once[0] > once[1] and again[1] > again[0]


def finding(document: PlayerDocument, building: Building, settings: Settings) -> None:
    """Say what the switch of rules did, once it was switched and if it is so."""
    with st.container(key="home_finding"):
        is_over = document.step == len(building.trajectory)
        is_again = document.columns[0].rule is UpdateRule.SUBTRACT_PRIOR
        if is_over and is_again and wrong_beats_right(building, settings):
            st.page_link(TWO_MAPS, label=f"**{FINDING}**")


# --- The lessons, and how to go through them ------------------------------------------


def path() -> None:
    """The pages in order, one question each; those that were visited are marked."""
    visited = state.visited()
    st.subheader("The lessons", anchor=False)
    for number, lesson in enumerate(shell.LESSONS):
        is_done = lesson.path in visited
        st.page_link(
            lesson.path,
            label=f"{number}. **{lesson.label}.** {lesson.question}"
            + (" :small[(visited)]" if is_done else ""),
            icon=":material/check_circle:"
            if is_done
            else ":material/radio_button_unchecked:",
        )


def plans() -> None:
    """Three ways through the app, by the time that one has."""
    st.subheader("I have", anchor=False)
    st.markdown("**2 minutes.** Watch the maps above, then compare two of them.")
    st.page_link(TWO_MAPS, label="Two maps, one clock", icon=":material/arrow_forward:")
    labels = {lesson.path: lesson.label for lesson in shell.LESSONS}
    with st.expander("**45 minutes.** One lesson for a class"):
        for number, (minutes, path, what) in enumerate(PLAN, start=1):
            st.page_link(
                path, label=f"{number}. {minutes} min: **{labels[path]}**, {what}"
            )
    st.markdown("**My own plan.** Begin with a drawing of your own.")
    st.page_link(YOUR_BUILDING, label="Your building", icon=":material/arrow_forward:")


def terms() -> None:
    """What is seen on the maps, each term explained where it is pointed at."""
    term = words.term
    st.markdown(
        f"<small>White is free, black is occupied; a hatched {term('cell')} is "
        f"{term('not looked at')} and shows what the {term('map')} started from. "
        f"{term('F2')} is one number from {term('precision')} and {term('recall')}. "
        f"Poses are known exactly, no {term('reading')} has noise, the world is flat."
        "</small>",
        unsafe_allow_html=True,
    )

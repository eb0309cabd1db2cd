"""The parts of the home page: what its maps come to, the path of lessons, the plans."""

from dataclasses import replace

import streamlit as st

from occsim import UpdateRule
from occsim.building import Building
from pages._ui import lessons, navigation, outcomes, state, teaching, words
from pages._ui.classroom import voting
from pages._ui.columns import HOME_COLUMNS
from pages._ui.components.player import PlayerDocument
from pages._ui.course import COURSE
from pages._ui.settings import Settings

TWO_MAPS = "pages/3_Two_maps.py"
YOUR_BUILDING = "pages/2_Your_building.py"
OWN, WRONG = HOME_COLUMNS[1:]
FINDING = "The wrong drawing now beats the right one. Find out why: lesson 5."
ARROW = ":material/arrow_forward:"
LABELS = {page.path: page.label for page in navigation.PAGES}


# --- What the maps come to ------------------------------------------------------------


def wrong_beats_right(building: Building, settings: Settings) -> bool:
    """Whether the wrong drawing gives the better map only where it is counted again."""
    once, again = (
        [
            outcomes.final_f2(building, settings, replace(column, rule=rule))
            for column in (OWN, WRONG)
        ]
        for rule in UpdateRule
    )
    return once[0] > once[1] and again[1] > again[0]


def keep_vote(document: PlayerDocument) -> None:
    """Store the first answer to the question of the maps; lesson 5 shows it again."""
    state.visit(COURSE[0])
    if document.predicted is not None:
        state.keep_prediction(0, list(COURSE[0].options)[document.predicted])


def finding(document: PlayerDocument, building: Building, settings: Settings) -> None:
    """Say what the switch of rules did, once it was switched and if it is so."""
    with st.container(key="home_finding"):
        is_over = document.step == len(building.trajectory)
        is_again = document.columns[0].rule is UpdateRule.SUBTRACT_PRIOR
        if is_over and is_again and wrong_beats_right(building, settings):
            asked = lessons.query(COURSE[5])
            st.page_link(TWO_MAPS, label=f"**{FINDING}**", query_params=asked)


# --- How to go through the lessons ----------------------------------------------------


def plans() -> None:
    """Ways through the lessons, by the time that one has."""
    st.header("I have", anchor=False)
    st.markdown("**2 minutes.** Watch the maps above, then compare two of them.")
    st.page_link(TWO_MAPS, label="Two maps", icon=ARROW)
    for minutes in teaching.PLANS:
        with st.expander(f"**{minutes} minutes.** A lesson for a class"):
            _plan(minutes)
    st.markdown("**My own plan.** Begin with a drawing of your own.")
    st.page_link(YOUR_BUILDING, label="Your building", icon=ARROW)
    class_code()


def class_code() -> None:
    """The way into a class: a code that the teacher has shown."""
    entered = state.class_now()
    if entered is not None and entered.page in LABELS:
        st.markdown("**You are in a class.**")
        st.page_link(entered.page, label=LABELS[entered.page], icon=ARROW)
        return
    with st.form("class_code", border=False):
        code = st.text_input(
            "I have a class code", max_chars=40, placeholder="from your teacher"
        )
        if st.form_submit_button("Go"):
            _enter(code)


def _enter(code: str) -> None:
    """Go into the room or the class of a code."""
    if voting.is_room(code):
        state.enter_room(code)
        st.switch_page(state.CLASS_PATH)
    prepared = state.open_class(code)
    if prepared is None:
        st.warning(state.NO_CLASS)
    elif prepared.page in LABELS:
        st.switch_page(prepared.page)


def _plan(minutes: int) -> None:
    for step in teaching.steps(minutes):
        lesson = COURSE[step.lesson]
        st.page_link(
            lesson.path,
            label=f"{step.minutes} min: **{lesson.title}**, {step.what}",
            query_params=lessons.query(lesson),
        )
    with st.container(horizontal=True):
        st.download_button(
            "Worksheet to print",
            teaching.worksheet(minutes),
            file_name=f"worksheet_{minutes}.html",
            mime="text/html",
            on_click="ignore",
        )
        with st.popover("For the teacher"):
            st.markdown(teaching.plan(minutes).partition("\n")[2])


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

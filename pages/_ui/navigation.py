"""The pages, and the row of links to them that stands on top of each."""

import contextlib
from dataclasses import dataclass

import streamlit as st
from streamlit.errors import StreamlitPageNotFoundError

from pages._ui import state
from pages._ui.course import COURSE


@dataclass(frozen=True, slots=True)
class Page:
    """One page; the table below has them in the order of the navigation."""

    path: str
    label: str
    purpose: str


LEARNING = (
    Page(
        "app.py",
        "Home",
        "What this is, and where to begin.",
    ),
    Page(
        "pages/0_What_the_sensor_says.py",
        "What the sensor says",
        "One reading, pixel by pixel: what it says of a cell, and how readings add up.",
    ),
    Page(
        "pages/1_Build_a_map.py",
        "Build a map",
        "A robot drives through a building and maps it, reading by reading; the map "
        "starts from the architect's drawing.",
    ),
    Page(
        "pages/3_Two_maps.py",
        "Two maps",
        "The same readings, two or three maps: click a word of a header to change the "
        "drawing, the prior or the rule of one of them.",
    ),
    Page(
        "pages/4_What_is_a_good_map.py",
        "What is a good map?",
        "Four counts of cells, and precision and recall as two shares of them.",
    ),
    Page(
        "pages/5_Sweep_the_priors.py",
        "Sweep the priors",
        "Every pair of prior values gives a map, and every map has a precision and a "
        "recall: here they are, all at once.",
    ),
    Page(
        "pages/6_Pareto_explorer.py",
        "Pareto explorer",
        "Precision and recall of a map often conflict: these are the best compromises "
        "of the two, and the map that each of them gives.",
    ),
    Page(
        "pages/7_Best_prior.py",
        "Best prior",
        "All steps for one drawing: from its walls to the best prior map, to download.",
    ),
    Page(
        "pages/8_Study.py",
        "Study",
        "All reference drawings at the source's three cell sizes, beside what the "
        "source published.",
    ),
)
OWN_DATA = (
    Page(
        "pages/2_Your_building.py",
        "Your building",
        "Upload a drawing: detect its walls, correct them by hand, set the ground "
        "truth, and sketch the robot's path.",
    ),
    Page(
        "pages/4_Robot_data.py",
        "Robot data",
        "A robot's own log of scans as a map in metres; maps of ROS in and out.",
    ),
)
CLASSROOM = (
    Page(
        "pages/9_Exercises.py",
        "Exercises",
        "Find out for yourself: each exercise opens a page with everything set, and is "
        "judged by what you set there.",
    ),
    Page(
        state.CLASS_PATH,
        "Class",
        "For teachers: prepare a page for your students, let them vote, collect what "
        "they hand in. No accounts, no names.",
    ),
)
GROUPS = (LEARNING, OWN_DATA, CLASSROOM)
"""A line parts them in the navigation."""
PAGES = LEARNING + OWN_DATA + CLASSROOM


def draw(path: str) -> None:
    """Draw the links to all pages; the page that one is on is marked."""
    # A page that is run by itself, as a test may do, has no other pages to go to.
    with contextlib.suppress(StreamlitPageNotFoundError):
        if not state.projector():
            _pages(path)
            return
        with st.container(horizontal=True, key="navigation"):
            _lesson_keys()
            _pages(path)


def _pages(path: str) -> None:
    with st.container(horizontal=True, key="lessons"):
        for group in GROUPS:
            if group is not GROUPS[0]:
                st.html('<span class="occsim-group"></span>', width="content")
            for item in group:
                _link(item, is_current=item.path == path)


def _link(item: Page, is_current: bool) -> None:
    # A key of its own: a lost connection disables all links alike.
    key = "current_page" if is_current else None
    with st.container(key=key, width="content"):
        st.page_link(item.path, label=item.label, disabled=is_current)


def _lesson_keys() -> None:
    """The lessons by their numbers, which are the keys that open them."""
    with st.container(horizontal=True, key="lesson_keys", width="content"):
        for lesson in COURSE[1:]:
            st.page_link(
                lesson.path,
                label=str(lesson.number),
                query_params={"lesson": str(lesson.number)},
            )

"""The frame of every page: set-up, lessons and state before it, the link after it."""

import contextlib
import functools
import importlib
import logging
from collections.abc import Callable, Iterator
from pathlib import Path

import streamlit as st

from occsim import OccsimError
from pages._ui import exercising, lessons, memory, navigation, state, words
from pages._ui.components.address import address
from pages._ui.navigation import PAGES, Page
from pages._ui.qr import qr_popover
from pages._ui.state import boards

LOG = logging.getLogger(__name__)

# Streamlit imports pandas when it is first needed, and plotly looks for it without
# waiting: a chart that is drawn meanwhile finds half of it. Here it is whole first.
importlib.import_module("pandas")

memory.use_few_arenas()

ICON = Path(__file__).resolve().parents[2] / "assets" / "icon.svg"


# Of a lesson only the question stands above its maps, all else below them: what is done
# and what comes of it are on one screen.
QUESTION_FIRST = """
    ON :is(:has(> .st-key-lesson), .st-key-lesson, .st-key-lesson > :first-child,
        .st-key-lesson > :first-child > *) { display: contents; }
    ON :is(.st-key-lesson > :first-child > * > *, .st-key-lesson > :last-child) {
        flex: none; width: 100%; }
    ON :is(.st-key-lesson > :first-child > * > :last-child,
        .st-key-lesson > :last-child) { order: 1; }
"""
MAPS = ":has(> :is(.st-key-lens, .st-key-map_player, .st-key-two_maps))"
"""What holds a lesson whose maps take a telephone's whole width."""


# Streamlit leaves 6 rem above the first line and wide gaps between blocks; the first
# screen must show map and controls at 1280 x 720.
CSS = """
<style>
.stMainBlockContainer { padding: 0.75rem 2rem 2rem; max-width: 2200px; }
[data-testid="stHeader"] { display: none; }
[data-testid="stVerticalBlock"] { gap: 0.5rem; }
.stMainBlockContainer h1 { font-size: 1.5rem; line-height: 1.2; padding: 0 0 0.4rem; }
/* As high as a select box, so that neighbours and their labels stand level. */
[data-testid="stButtonGroup"] > div button { min-height: 2.5rem; }
/* Captions are read, not skipped: Streamlit's 0.6 is a contrast of 3.9. */
[data-testid="stCaptionContainer"] { opacity: 0.8; }
/* The theme's colour carries white letters; as a letter it is too dim in the dark. */
[data-testid="stButtonGroup"] [data-selected="true"] p,
[data-testid="stSliderThumbValue"] p { color: color-mix(in srgb, currentColor 65%,
    CanvasText); }
/* As high as a link while it is loaded: what is below must not move. */
.st-key-lessons > div { height: 1.25rem; }
.st-key-lessons { column-gap: 0.25rem; }
.st-key-lessons a { padding-inline: 0.4rem; }
.occsim-group { display: block; width: 1px; height: 1.25rem; margin: auto;
    background: currentColor; opacity: 0.3; }
/* A lesson stands above its maps: it takes as little height as it can. */
.st-key-lesson, .st-key-exercise { padding: 0.5rem 1rem; gap: 0.25rem;
    margin-top: 0.375rem; }
/* What leads on stands apart from what is answered. */
.st-key-lesson_ways { margin-top: 0.25rem; padding-top: 0.5rem;
    border-top: 1px solid color-mix(in srgb, currentColor 20%, transparent); }
.st-key-lesson [data-testid="stMarkdownContainer"] { margin-bottom: 0; }
.st-key-lesson [data-testid="stMarkdownContainer"] p { font-size: 0.9375rem;
    line-height: 1.4; margin-bottom: 0.25rem; }
.st-key-lesson button, .st-key-lesson_ways a { min-height: 2rem; padding-block: 0; }
/* The whole list on one screen: columns from 480 px on. */
.st-key-exercises { display: block; columns: 480px; }
.st-key-exercises > div { break-inside: avoid; margin-bottom: 0.5rem; }
.st-key-exercises > div > div { flex-wrap: nowrap; }
.st-key-exercises > div > div > :first-child { flex: none; }
.st-key-exercises button { min-width: 6.25rem; }
/* The page one is on is the clearest item, not the dimmest. */
.st-key-current_page a, .st-key-current_page a * {
    color: inherit; opacity: 1; font-weight: 700;
}
.st-key-current_page a { box-shadow: inset 0 -2px currentColor; }
[data-testid="stPageLink"] a:focus-visible { outline: 2px solid currentColor; }
/* A wide table is swiped by itself; the page stays as wide as the screen. */
[data-testid="stMarkdownContainer"] table { display: block; overflow-x: auto;
    width: max-content; max-width: 100%; }
/* A white picture ends somewhere. */
[data-testid="stImage"] img { outline: 1px solid rgb(128 128 128 / 30%);
    outline-offset: -1px; }
/* A number stays in one piece. */
[data-testid="stMarkdownContainer"] td[style*="right"] { white-space: nowrap; }
/* A term of the glossary: its meaning also shows when Tab or a finger is on it. */
abbr[title] { cursor: help; text-decoration: underline dotted; }
abbr[title]:focus::after { content: attr(title); position: fixed; z-index: 999;
    left: 1rem; bottom: 1rem; max-width: calc(100vw - 2rem); padding: 0.5rem 0.75rem;
    border-radius: 0.5rem; background: #31333f; color: #fff; font-size: 0.9rem;
    font-weight: 400; text-align: left; white-space: normal; }
/* The height that the home page's maps will have: nothing moves when they come. */
.st-key-home_maps { min-height: calc(min(clamp(150px, 100vh - 400px, 700px),
    (100vw - 96px) * 0.2667) + 212px); }
.st-key-home_finding { min-height: 2rem; align-items: center; }
.st-key-home_finding a { text-decoration: underline; }
/* Read from the back of a room. */
.occsim-qr { display: block; width: min(52vh, 80vw); margin: auto;
    image-rendering: pixelated; }
.st-key-home_ways [data-testid="stPageLink"] a * { white-space: normal; }
/* A row of the class: the control's name, then what becomes of it. */
.st-key-class_controls [data-testid="stVerticalBlock"] { gap: 0.2rem; }
.st-key-class_controls [data-testid="stButtonGroup"] { display: flex;
    align-items: center; justify-content: space-between; gap: 0.5rem; }
.st-key-class_controls [data-testid="stButtonGroup"] > label { flex: 1; min-height: 0;
    margin: 0; }
.st-key-class_controls [data-testid="stButtonGroup"] > div { flex: none;
    flex-wrap: nowrap; width: auto; }
.st-key-class_controls [data-testid="stButtonGroup"] > div button {
    min-height: 1.9rem; padding: 0 0.6rem; }
.st-key-class_made .occsim-qr { width: min(34vh, 70vw); }
.stMainBlockContainer h2 { padding: 0.5rem 0; font-size: 1.4rem; }
.stMainBlockContainer .st-key-home_ways h2 { padding: 0.5rem 0 1rem;
    font-size: 1.15rem; }
@media (max-width: 640px) {
    .st-key-lesson [data-testid="stHorizontalBlock"] { gap: 0.5rem; }
    .st-key-lesson button { min-height: 2.75rem; }
    QUESTION_FIRST
    .st-key-lesson [class*="st-key-predict_"] { margin-top: 0.375rem; }
    .st-key-exercise { padding: 0.5rem 1rem; gap: 0.25rem; }
    .st-key-exercise [data-testid="stHorizontalBlock"] { gap: 0.5rem; }
    .stMainBlockContainer { padding: 0.5rem 0.75rem 2rem; }
    /* Columns stand below each other: as far apart as other blocks. */
    [data-testid="stHorizontalBlock"] { row-gap: 0.75rem; }
    /* A value on one line: the table is swiped. */
    [data-testid="stMarkdownContainer"] td + td { white-space: nowrap; }
    .st-key-ending { gap: 0.25rem; }
    .st-key-ending button { padding-inline: 0.5rem; }
    /* Choices that do not fit side by side stand in rows: none may hide. */
    [data-testid="stButtonGroup"] > div { flex-wrap: wrap; }
    .st-key-home_maps { min-height: calc(3 * clamp(100px, (100vh - 430px) / 3, 150px)
        + 274px); }
    /* One row to swipe, not three rows to scroll past. */
    .st-key-lessons { flex-wrap: nowrap; overflow-x: auto; padding-bottom: 4px;
        scrollbar-width: none; }
    .st-key-lessons [data-testid="stPageLink"] { flex: none; white-space: nowrap; }
    .st-key-lessons > div { flex: none; }
    /* The sensor's settings in one row to swipe, right above the map that they change;
       the maps of a lesson, of which there are several, leave no room for it. */
    .st-key-map_controls { flex-wrap: nowrap; overflow-x: auto; padding-bottom: 4px;
        scrollbar-width: none; }
    .st-key-map_controls > * { flex: none; }
    .st-key-map_controls > :first-child { max-width: 11rem; }
    :has(> .st-key-two_maps):has(.st-key-lesson) > :has(> .st-key-map_controls) {
        order: 1; }
    :has(> .st-key-map_words) { order: 2; }
    :has(> .st-key-ending) { order: 3; }
}
</style>
""".replace("QUESTION_FIRST", QUESTION_FIRST.replace("ON", MAPS))


# Read from the back of a room: text 1.4 times as large, thicker marks, no captions. Map
# and transport stay on one screen of 1280 x 720.
PROJECTOR_CSS = """
<style>
:root { --occsim-text: 1.4; --occsim-words: none; font-size: 22.4px !important;
    --occsim-canvas-height: clamp(220px, 100vh - 244px, 900px);
    --occsim-canvas-height-several: clamp(180px, 100vh - 404px, 800px); }
/* A question stands above the maps. */
:root:has(.st-key-lesson) {
    --occsim-canvas-height-several: clamp(180px, 100vh - 460px, 800px); }
[data-testid="stCaptionContainer"], .st-key-map_words, .st-key-home_ways {
    display: none; }
.stMainBlockContainer h1 { font-size: 1.3rem; padding: 0 0 0.3rem; }
[data-testid="stHeading"] [data-testid="stMarkdownContainer"] {
    margin-bottom: -0.4rem; }
.stMainBlockContainer { padding: 0.3rem 1rem 1rem; }
.st-key-lessons { flex-wrap: nowrap; overflow-x: auto; gap: 0.25rem;
    padding-bottom: 4px; scrollbar-width: none; }
/* The numbers of the lessons stay while the pages beside them are swiped. */
.st-key-navigation { flex-wrap: nowrap; gap: 0.5rem; }
.st-key-navigation > :first-child { flex: none; }
.st-key-navigation > :last-child { flex: 1; min-width: 0; }
.st-key-lesson_keys { gap: 0; flex-wrap: nowrap; }
.st-key-lessons > div, .st-key-lessons [data-testid="stPageLink"] { flex: none;
    white-space: nowrap; }
/* The map comes first, what is to be done and the sensor's settings below it. */
:has(> .st-key-map_controls), :has(> .st-key-exercise) { order: 1; }
QUESTION_FIRST
.st-key-lesson [class*="st-key-predict_"] { flex-flow: row wrap; align-items: center;
    gap: 0.25rem 1rem; }
.st-key-lesson [class*="st-key-predict_"] > * { flex: 0 1 auto; width: auto; }
:has(> .st-key-ending) { order: 3; }
[data-testid="stProgress"] [role="progressbar"] > div,
[data-testid="stProgress"] [role="progressbar"] > div > div { height: 1rem; }
</style>
""".replace("QUESTION_FIRST", QUESTION_FIRST.replace("ON ", ""))


@contextlib.contextmanager
def page(path: str) -> Iterator[Page]:
    """Draw what every page has around its own part.

    The set-up, the navigation and notices come before it, the link and the reset after
    it. An error in between leaves both, and the student's work.
    """
    here = next(item for item in PAGES if item.path == path)
    st.set_page_config(
        page_title=f"{here.label} · Occupancy grid mapping",
        page_icon=str(ICON),
        layout="wide",
        initial_sidebar_state="collapsed",
    )
    st.html(CSS)
    state.prepare(path)
    if state.projector():
        st.html(PROJECTOR_CSS)
    state.finish()
    boards.take_commits()
    state.take_kept()
    state.follow_link(path)
    navigation.draw(path)
    if state.link_notice(path):
        st.warning(state.link_notice(path))
    with _last_resort(path):
        exercising.panel()
        told = st.container()
        yield here
        with told:
            _tell_limits()
    _ending()
    memory.return_freed()


@contextlib.contextmanager
def _last_resort(path: str) -> Iterator[None]:
    """Turn any failure into a sentence; log it unless it is a refusal."""
    try:
        yield
    except OccsimError as error:
        say_error(str(error))
    except Exception:
        LOG.exception("page %s failed", path)
        say_error(
            "This page failed: an error in this program, which has been logged. Your "
            "work is kept. Undo the last change, or reset all settings below."
        )
        if state.can_undo():
            st.button("Undo the last change", on_click=state.undo)


def _tell_limits() -> None:
    """Say what is not on this page, which is known once it is drawn."""
    hidden, held = len(state.not_drawn()), state.limits()
    if hidden:
        what = "1 control is" if hidden == 1 else f"{hidden} controls are"
        st.caption(f"{what} hidden by {held.by}.")


def fragment(part: Callable[..., None]) -> Callable[..., None]:
    """Make a part of a page run by itself, with errors handled as on the whole page."""

    @st.fragment
    @functools.wraps(part)
    def run(*args: object) -> None:
        with _last_resort(part.__module__):
            part(*args)
        address(state.query(), has_button=False, key=f"address {part.__name__}")

    return run


def say_error(text: str) -> None:
    """Show a sentence on what went wrong; a user's text stays plain text."""
    st.error(words.plain(text))


def truth_notice() -> None:
    """Say where the scores compare a drawing with its own walls."""
    building = state.building()
    if building.truth is None and building.world.occupied.any():
        st.info(
            "No ground truth was given: the walls detected in the drawing serve as "
            "the world, so without errors the drawing is right everywhere."
        )


def _ending() -> None:
    own = state.OWN in state.choices() or not state.robot().is_empty
    kept = not own or state.work_key() is not None
    note = "It opens this page with this drawing and these settings."
    if own:
        note += (
            " Your own building or log opens from this server only and for a day; the "
            "project file lasts longer (Your building, 7 Keep)."
        )
    # The link to a room that one has opened holds its key.
    may_be_shared = "key" not in state.query()
    with st.container(
        horizontal=True,
        horizontal_alignment="right",
        vertical_alignment="center",
        key="ending",
    ):
        address(
            state.query(),
            note=note,
            unsaved=not kept,
            progress=state.progress(),
            session=state.drawn_word(),
            cleared=state.is_cleared(),
            voter=state.voter() if state.room()[0] else "",
            projector=state.projector(),
            has_button=may_be_shared,
            key="address",
        )
        if may_be_shared:
            qr_popover(state.query())
        st.button(
            "Leave the projector" if state.projector() else "Projector",
            on_click=state.set_projector,
            args=(not state.projector(),),
            help="Larger text and thicker marks; the keys 1 to 9 open the lessons, "
            "space plays.",
        )
        st.button("Reset all", on_click=state.reset_all)


def heading(here: Page) -> None:
    """Draw a page's title and purpose, unless an exercise or a lesson is open."""
    if not exercising.is_here() and not lessons.heading():
        st.title(here.label, anchor=False)
        st.caption(here.purpose)

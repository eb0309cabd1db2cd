"""A drawing for a log: registered by two pairs of points, or traced on the map."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import streamlit as st

from occsim import Agreement, Registration
from pages._ui import controls, limits, logs, shell, state, uploads, words
from pages._ui.choices import CellModel, PriorDrawing
from pages._ui.columns import DRAWN_COLUMNS, Column
from pages._ui.components.board import BoardDocument, BoardMode
from pages._ui.components.player import map_player
from pages._ui.logs import LogFile
from pages._ui.robot_data import registered
from pages._ui.robot_data.played import PlayedLog
from pages._ui.robot_data.registered import Registrations, Walls
from pages._ui.robot_data.scans import given_log, mapped
from pages._ui.robot_data.work import Traced
from pages._ui.your_building import drawn
from pages._ui.your_building.drawn import Paper

OPENED, STEP = "registration_opened", "registration_step"
"""Where the registration of a simulated log opens."""
STEPS = ("Register a drawing", "Or trace walls", "Map with it")
DRAWING_KEY, MAP_KEY, TRACE_KEY = "board_drawing", "board_map", "board_trace"
WHICH = "registration_which"
REGISTERED, TRACED = "The registered drawing", "The traced walls"
HEIGHT_PX = 400
BITS = (
    "Bits: by how much more probable the readings are with these walls in this "
    "place than with none, as a binary logarithm. Below 0 they speak against the walls."
)
MAX_STEPS = 50


def show() -> None:
    """Draw the section."""
    log = given_log()
    made = mapped(log)
    if made is None:
        return
    with st.container(horizontal=True, vertical_alignment="center"):
        step = st.segmented_control(
            "Step",
            STEPS,
            required=True,
            label_visibility="collapsed",
            **state.bind_view(STEP, STEPS[0]),
        )
        if step == STEPS[0]:
            _refining(log, made)
        if step != STEPS[-1]:
            _history()
        if step == STEPS[0]:
            _choose_drawing(log)
    if state.message():
        shell.say_error(state.message())
    (_register, _trace, _map)[STEPS.index(step)](log, made)


def _refining(log: LogFile, made: PlayedLog) -> None:
    so_far = _registrations(log, made)
    st.button(
        "Refine by what the robot saw",
        on_click=state.edit,
        args=(partial(_refine, so_far, made),),
        disabled=so_far.now is None,
        type="primary",
    )


def _history() -> None:
    with st.container(horizontal=True, width="content"):
        st.button("Undo", on_click=state.undo, disabled=not state.can_undo())
        st.button("Redo", on_click=state.redo, disabled=not state.can_redo())


def _key(log: LogFile) -> str:
    """What tells a map from others."""
    return logs.map_id(log, state.settings())


def _registrations(log: LogFile, made: PlayedLog) -> Registrations:
    building = state.building()
    about = registered.about(_key(log), building)
    for kept in (state.robot().registrations, state.view(OPENED, None)):
        if kept is not None and kept.about == about:
            return kept  # type: ignore[no-any-return]
    opened = Registrations(about)
    if log.is_simulated:
        opened = registered.opening(about, building, made)
    state.set_view(OPENED, opened)
    return opened


def _register(log: LogFile, made: PlayedLog) -> None:
    so_far = _registrations(log, made)
    _numbers(so_far, made)
    on_drawing, on_map = st.columns(2)
    with on_drawing:
        st.markdown("**1. Two places on the drawing**")
        paper = replace(drawn.drawing_paper(), height_px=HEIGHT_PX)
        _board(DRAWING_KEY, "drawing_points", so_far, drawn.document, paper)
    with on_map:
        st.markdown("**2. The same places on the map**, in the same order")
        _board(
            MAP_KEY,
            "map_points",
            so_far,
            partial(_map_document, made, so_far),
            _map_paper(log, made),
        )
    _words(is_simulated=log.is_simulated)


def _board(
    key: str,
    field: str,
    so_far: Registrations,
    make: Callable[..., BoardDocument],
    paper: Paper,
) -> None:
    """Show a board with two points."""

    def latest() -> Registrations:
        # Both boards may have been drawn upon in one run.
        kept = state.robot().registrations
        return kept if kept is not None and kept.about == so_far.about else so_far

    def source() -> tuple[object, ...]:
        # The registration as it was drawn: a new one is shown by a new document.
        shown = so_far.now if key == MAP_KEY else None
        return (so_far.about, getattr(latest(), field), shown)

    def take(new: BoardDocument) -> None:
        now = replace(latest(), **{field: new.points})
        if len(now.drawing_points) == len(now.map_points) == 2:
            found = registered.by_points(now.drawing_points, now.map_points)
            now = replace(now, steps=(*now.steps, found)[-MAX_STEPS:])
        state.edit_robot(registrations=now)

    drawn.board(
        key,
        BoardMode.MEASURE,
        source,
        lambda: make(points=getattr(so_far, field)),
        take,
        paper=paper,
    )


def _map_document(
    made: PlayedLog, so_far: Registrations, **contents: object
) -> BoardDocument:
    base = b""
    if so_far.now is not None:
        base = registered.walls_on_map(
            state.building().wall_mask, so_far.now, made
        ).packed
    grid = made.grid
    return BoardDocument(
        height_px=grid.height_px, width_px=grid.width_px, base=base, **contents
    )


def _map_paper(log: LogFile, made: PlayedLog, height_px: int = HEIGHT_PX) -> Paper:
    scale = made.scans.frame.metres_per_px
    return Paper(logs.picture(log, state.settings()), scale, height_px)


def _numbers(so_far: Registrations, made: PlayedLog) -> None:
    """Say how the drawing is registered and how well it agrees."""
    now = so_far.now
    if now is None:
        st.caption("Two points on each picture register the drawing on the map.")
        return
    walls = state.building().wall_mask
    steps = so_far.steps[-2:]
    agreed = [registered.agrees(walls, step, made) for step in steps]
    shown = [agreement_words(one) for one in agreed]
    before = f" Before: {shown[0]}." if len(shown) == 2 else ""
    st.markdown(f"**{shown[-1]}.**{before}", help=BITS)
    st.caption(where(now, made))


def agreement_words(found: Agreement) -> str:
    """How well a registered drawing agrees, without a full stop."""
    bits = f"{words.number(round(found.bits), '+,')} bits"
    if not found.n_walls_seen:
        return f"The robot looked at none of the drawn walls, {bits}"
    return (
        f"{words.percent(found.share_found)} of the drawn walls that the robot looked "
        f"at are walls in its map, {bits}"
    )


def where(registration: Registration, made: PlayedLog) -> str:
    """A registration in words."""
    scale = made.scans.frame.metres_per_px
    turn = math.degrees(registration.rotation_rad)
    side = "clockwise" if turn >= 0 else "anticlockwise"
    x, y = (
        scale * shift for shift in (registration.shift_x_px, registration.shift_y_px)
    )
    return (
        f"A pixel of the drawing is {1000 * scale * registration.scale:.1f} mm; turned "
        f"{abs(turn):.1f}° {side}; its upper left corner is at x = "
        f"{words.number(x, '.2f')} m, y = {words.number(y, '.2f')} m from the map's, y "
        "down."
    )


def _refine(so_far: Registrations, made: PlayedLog) -> None:
    if so_far.now is None:
        return
    found = registered.refined(state.building().wall_mask, so_far.now, made)
    steps = (*so_far.steps, found)[-MAX_STEPS:]
    state.edit_robot(registrations=replace(so_far, steps=steps))


def _choose_drawing(log: LogFile) -> None:
    with st.popover("Another drawing"):
        if log.is_simulated:
            st.caption("A simulated log is driven through the drawing that is chosen.")
        controls.drawing_choice()
        uploads.drawing("registered_drawing")
        st.caption("Its walls can be corrected on the page Your building.")


def _trace(log: LogFile, made: PlayedLog) -> None:
    """Draw walls on the map itself."""
    grid, key = made.grid, _key(log)

    def make() -> BoardDocument:
        size = {"height_px": grid.height_px, "width_px": grid.width_px}
        traced = _traced(log, made)
        return BoardDocument(**size, overlay=traced and traced.strokes)

    def take(new: BoardDocument) -> None:
        state.edit_robot(traced=Traced(key, new.corrections))

    st.markdown(
        "No drawing? **Trace** the walls that you believe in over the map: they become "
        "a drawing. Walls that the robot never saw may be drawn, too."
    )
    drawn.board(
        TRACE_KEY,
        BoardMode.WALLS,
        lambda: (made, _traced(log, made)),
        make,
        take,
        paper=_map_paper(log, made, drawn.HEIGHT_PX),
    )


def _traced(log: LogFile, made: PlayedLog) -> Traced | None:
    """The walls traced on this map; None where there are none."""
    traced = state.robot().traced
    if traced is None or traced.about != _key(log):
        return None
    # A project file may say anything.
    size = made.grid.height_px, made.grid.width_px
    return traced if traced.strokes.shape == size else None


def _walls(log: LogFile, made: PlayedLog) -> Walls | None:
    """The walls of the prior: registered, or traced."""
    so_far = _registrations(log, made)
    traced = _traced(log, made)
    has_traced = traced is not None and not traced.strokes.is_empty
    options = [REGISTERED] * (so_far.now is not None) + [TRACED] * has_traced
    if not options:
        return None
    which = options[0]
    if len(options) > 1:
        which = st.radio(
            "Drawing",
            options,
            horizontal=True,
            label_visibility="collapsed",
            **state.bind_view(WHICH, options[0]),
        )
    if which == TRACED and traced is not None:
        nothing = registered.traced(b"", made)
        return Walls(traced.strokes.apply(nothing.mask))
    return registered.walls_on_map(state.building().wall_mask, so_far.now, made)


def _map(log: LogFile, made: PlayedLog) -> None:
    """Map the log without and with the drawing."""
    walls = _walls(log, made)
    if walls is None:
        st.info("Register a drawing on the map first, or trace walls.")
        return
    key, settings = state.ROBOT_KEY, state.settings()
    state.open_log_player(_key(log), len(made.trajectory) // 2, DRAWN_COLUMNS)
    columns = state.take_from_player(key).columns
    plain = logs.replay(log, settings, columns)
    parts = [part for part in plain.parts if part.kind != "walls"]
    map_player(
        replace(
            plain,
            base=f"{plain.base} {walls.digest}",
            parts=(*parts, *registered.parts(walls, columns)),
            drawings=(PriorDrawing.OWN,),
            has_prior=True,
        ),
        state.player_document(key),
        key=key,
        held=state.parts_held(key),
        fixed=logs.fixed(settings),
        limits=state.limits_of(limits.OF_LOG),
    )
    _bits(_key(log), made, walls, columns)


def _bits(
    log_key: str, made: PlayedLog, walls: Walls, columns: tuple[Column, ...]
) -> None:
    rows = ["| Map | Bits per cell, on scans held out |", "|---|---|"]
    for letter, column in zip("ABC", columns, strict=False):
        bits = registered.held_out(log_key, made, walls, column)
        rows.append(f"| **{letter}** {_said(column)} | {words.number(bits, '.3f')} |")
    table, about = st.columns([2, 3])
    with table, st.container(key="held_out_bits"):
        st.markdown("\n".join(rows))
    with about:
        st.caption(
            "There is no ground truth, so scans are held out: the log is divided "
            f"into {registered.N_FOLDS} blocks; each is predicted by the map from the "
            "other blocks. A cell counts where the held-out scans speak clearly. 0 is "
            "certainty that proved right; a cell of which nothing is known costs 1 "
            "bit. An error that all scans share is not seen."
        )


def _said(column: Column) -> str:
    if column.model is CellModel.HITS_VISITS:
        return "gmapping's, no probabilities"
    if column.uninformative:
        return "no drawing"
    once = column.rule.value == "prior_once"
    return "drawing, counted once" if once else "drawing, taken off at every reading"


def _words(*, is_simulated: bool) -> None:
    with st.container(key="map_words"):
        see, predict, why = st.columns(3, gap="large")
    with see:
        st.markdown(
            "**See.** The drawing's walls are shown over the robot's map. Two "
            "pairs of points give the scale, the turn and the shift."
        )
    with predict:
        missed = "Set the points half a metre off, on purpose."
        if is_simulated:
            missed = "The points are off by half a metre, on purpose."
        st.markdown(
            f"**Predict.** {missed} Will *Refine* find the place? And what if you set "
            "them two metres off?"
        )
        with st.expander("And then?"):
            st.markdown(
                "From where it opens with a simulated log, 1.1 m off at the worst "
                "corner, it comes to within 10 cm at all corners of all five reference "
                "drawings, and the drawing then predicts held-out scans better on all "
                "five (*Map with it*). From far away it may settle where other walls "
                "happen to match."
            )
    with why:
        st.markdown(
            "**Why.** First the drawn walls are moved to the nearest walls of the map, "
            "from far to near; then what counts is how much more probable the readings "
            "are with these walls than without."
        )

"""Section 6: the trajectory, sketched, planned, edited or from a file."""

from functools import partial

import streamlit as st

from occsim import HeadingMode, Trajectory, TrajectoryFormat, dump_trajectory
from occsim.building import TOUR_READINGS, random_trajectory, sketched_trajectory
from occsim.corrections import pack_mask
from occsim.io.trajectories.pose_table import pose_columns, trajectory_from_columns
from occsim.tour import MAX_READINGS, default_tour
from pages._ui import controls, state, uploads
from pages._ui.components.board import BoardDocument, BoardMode, BoardPoint
from pages._ui.state import boards as kept
from pages._ui.your_building import drawn, lengths
from pages._ui.your_building.poses import poses_figure

KEY = "board_path"
WAYS = ("Sketch", "Plan", "Table", "Files")
HEADINGS = {
    HeadingMode.ALONG: "Along the way",
    HeadingMode.CARDINAL: "Nearest of four",
    HeadingMode.FOUR: "All four",
}
UNITS = {True: "Degrees", False: "Radians"}
Sketch = tuple[tuple[float, float, bool], ...]


def show() -> None:
    """Show the chosen way to make a trajectory."""
    left, right = st.columns([3, 1])
    with right:
        way = st.segmented_control(
            "Trajectory by",
            WAYS,
            required=True,
            label_visibility="collapsed",
            **state.bind_view("way", WAYS[0]),
        )
        {"Sketch": _sketch, "Plan": _plan, "Table": _table, "Files": _files}[way]()
    with left:
        if way == "Sketch" and not state.view("show_poses", False):
            _board()
        else:
            st.plotly_chart(
                poses_figure(state.building(), drawn.HEIGHT_PX),
                config=controls.chart("poses"),
                key="poses",
            )
    with right:
        # After the board, so that it counts the path just drawn.
        _facts()


def _facts() -> None:
    building = state.building()
    st.caption(
        f"{lengths.count(len(building.trajectory), 'pose')} in the trajectory; "
        f"drawing {lengths.size()}."
    )


# --- Sketch ---------------------------------------------------------------------------


def _sketch() -> None:
    st.caption(
        "Set waypoints with clicks or draw a free line; the robot follows it and "
        "takes readings at equal steps."
    )
    st.slider("Step (px)", 1, 100, help="Between readings.", **_bound("step_px", 10))
    st.selectbox(
        "Headings",
        list(HeadingMode),
        format_func=HEADINGS.__getitem__,
        **_bound("heading_mode", HeadingMode.ALONG),
    )
    st.toggle(
        "Turn on the spot at waypoints",
        help="Look in all four directions at each waypoint that was clicked.",
        **_bound("turn", False),
    )
    st.toggle("Show the poses", **state.bind_view("show_poses", False))


def _bound(name: str, default: object) -> dict[str, object]:
    return state.bind_view(name, default, _follow_again)


def _follow_again() -> None:
    if state.building().sketch:
        _follow(state.building().sketch)


def _board() -> None:
    """Show the board; the robot follows what is drawn on it."""
    drawn.board(KEY, BoardMode.TRAJECTORY, _shown, _sketched, _take_sketch)


def _shown() -> kept.Source:
    """The parts that make the world, and the sketch."""
    building = state.building()
    found, corrections = building.walls_found, building.corrections
    return found, corrections, building.truth, building.sketch


def _sketched() -> BoardDocument:
    building = state.building()
    points = (
        BoardPoint(x_px=x, y_px=y, is_waypoint=is_waypoint)
        for x, y, is_waypoint in building.sketch
    )
    mask = pack_mask(building.world.occupied)
    return drawn.document(base=mask, points=tuple(points))


def _take_sketch(document: BoardDocument) -> None:
    _follow(tuple((p.x_px, p.y_px, p.is_waypoint) for p in document.points))


def _follow(sketch: Sketch) -> None:
    """Use a sketch and the poses along it; an empty sketch leaves the trajectory."""
    changes: dict[str, object] = {"sketch": sketch}
    if sketch:
        changes["trajectory"] = sketched_trajectory(
            sketch,
            state.view("step_px", 10),
            state.view("heading_mode", HeadingMode.ALONG),
            state.view("turn", False),
        )
    state.edit_building(**changes)


# --- Plan -----------------------------------------------------------------------------


def _plan() -> None:
    st.slider(
        "Readings at most",
        20,
        MAX_READINGS,
        step=20,
        help="A tour has as many readings as this sensor needs to see the inside of "
        "the building. If that is more than this limit, the tour keeps the readings "
        "that show most.",
        **state.bind_view("max_readings", TOUR_READINGS),
    )
    _plan_button("Plan a tour for this sensor", _tour)
    st.number_input("Random poses", 1, 5000, **state.bind_view("n_random", 300))
    st.number_input("Seed", 0, 9999, **state.bind_view("pose_seed", 1))
    _plan_button("Draw random poses", _random)


def _plan_button(label: str, make: object) -> None:
    st.button(label, on_click=state.edit, args=(make,), width="stretch")


def _tour() -> None:
    tour = default_tour(
        state.building().world,
        state.settings().sensor,
        max_readings=int(state.view("max_readings", TOUR_READINGS)),
    )
    state.edit_building(trajectory=tour)


def _random() -> None:
    n, seed = state.view("n_random", 300), state.view("pose_seed", 1)
    state.edit_building(
        trajectory=random_trajectory(state.building().world, int(n), int(seed))
    )


# --- Table ----------------------------------------------------------------------------


def _table() -> None:
    table = kept.table(pose_columns)
    # Its toolbar covers what stands above the table: two lines that need no click.
    st.caption(
        "One row a pose. Edit a value, add a row at the end, or select rows to delete "
        "them."
    )
    edited = st.data_editor(
        table.given,
        num_rows="dynamic",
        height=380,
        key=table.key,
        column_config={
            "x_px": st.column_config.NumberColumn("x (px)", format="%.2f"),
            "y_px": st.column_config.NumberColumn("y (px)", format="%.2f"),
            "theta_deg": st.column_config.NumberColumn("heading (°)", format="%.1f"),
        },
    )
    if kept.table_is_new(edited):
        state.edit(partial(_take_table, edited), tag="table")
        kept.note_table(edited)


def _take_table(edited: kept.Columns) -> None:
    kept.take_table(trajectory_from_columns(edited))


# --- Files ----------------------------------------------------------------------------


def _files() -> None:
    uploads.trajectory("workshop_trajectory")
    file_format = st.selectbox(
        "Format",
        list(TrajectoryFormat),
        format_func=lambda item: item.value.upper(),
        **state.bind_view("pose_format", TrajectoryFormat.CSV),
    )
    degrees = st.radio(
        "Headings in",
        list(UNITS),
        format_func=UNITS.__getitem__,
        horizontal=True,
        disabled=file_format is TrajectoryFormat.TUM,
        help="An NPY file does not state the unit, so choose it when the file is "
        "read; a TUM file holds quaternions.",
        **state.bind_view("pose_degrees", False),
    )
    trajectory: Trajectory = state.building().trajectory
    st.download_button(
        "Download the trajectory",
        lambda: dump_trajectory(trajectory, file_format, degrees=degrees),
        file_name=f"trajectory.{file_format.value}",
        on_click="ignore",
        width="stretch",
    )

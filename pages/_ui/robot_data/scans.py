"""A log of scans, uploaded or simulated, and the map that it gives."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import streamlit as st

from occsim import OccsimError, RobotFileError
from occsim.io import bags
from occsim.io.timed import TimedScans, is_timed_scans, read_trajectory
from pages._ui import controls, limits, logs, shell, state, uploads, words
from pages._ui.choices import CellModel
from pages._ui.columns import LOG_COLUMNS, Column
from pages._ui.components.player import map_player
from pages._ui.logs import LogFile
from pages._ui.robot_data import downloads
from pages._ui.robot_data.played import PlayedLog

SHOWN, ONE, BESIDE = "robot_maps", "One", "Beside gmapping's"
COUNTS = replace(LOG_COLUMNS[0], model=CellModel.HITS_VISITS)
MAPS = {ONE: LOG_COLUMNS, BESIDE: (*LOG_COLUMNS, COUNTS)}
"""The maps of a log that can be shown."""
SEE = {
    ONE: "Where beams ended, all scans together, and the map. A cell turns "
    "white where beams pass and black where they end; a hatched one was never looked "
    "at.",
    BESIDE: "A adds up what scans say of a cell; B is the share of beams that end in "
    "it, of those that reach it. A beam fills its sector in A; in B it has no width.",
}
NO_TRUTH = "There is no ground truth, so no score."
POSES, TAKEN = "robot_log_poses", "robot_logs_taken"
ABOUT = (
    "A log in CARMEN format (FLASER or ROBOTLASER1 lines; .log, .gfs.log)"
    + (
        ", a bag of ROS 1 or 2 (.bag, .mcap, .db3; of a bag's folder its files "
        "together, or a zip of it)"
        if bags.is_readable()
        else ""
    )
    + ", or scans as NPZ; timed scans (CSV, NPZ) together with their trajectory. Its "
    "poses are taken as they are."
)


def show() -> None:
    """Map a log and play it."""
    _controls()
    if state.message():
        shell.say_error(state.message())
    log = given_log()
    made = mapped(log)
    if made is None:
        return
    st.caption(facts(log, made))
    key = state.ROBOT_KEY
    settings = state.settings()
    identity = f"{log.digest} {logs.options(settings)}"
    state.open_log_player(identity, len(made.trajectory) // 2, _columns())
    columns = state.take_from_player(key).columns
    map_player(
        logs.replay(log, settings, columns),
        state.player_document(key),
        key=key,
        held=state.parts_held(key),
        fixed=logs.fixed(settings),
        limits=state.limits_of(limits.OF_LOG),
    )
    downloads.popover(made)
    _words()


def given_log() -> LogFile:
    """The log that was uploaded; else one simulated in the chosen building."""
    uploaded = state.robot().log
    return logs.simulated(state.building()) if uploaded is None else uploaded


def _controls() -> None:
    with st.container(horizontal=True, vertical_alignment="bottom", key="map_controls"):
        if state.robot().log is None:
            controls.drawing_choice()
        else:
            st.button("Back to the simulated log", on_click=state.edit, args=(_forget,))
        for name in ("log_cell_m", "usable_range_m"):
            controls.slider(name, width=controls.NARROW_PX)
        if controls.shown("log_maps"):
            _choose_maps()
        with st.popover("More settings"):
            controls.radio("log_behind_hit")
            controls.toggle("log_clear_no_hit")
            controls.slider("log_max_range_m")
        if not state.limits().drawing:
            with st.popover("Upload a log"):
                _uploads()


def _choose_maps() -> None:
    st.segmented_control(
        "Maps",
        list(MAPS),
        required=True,
        help="gmapping, a mapper that many robots use, counts in each cell how "
        "many beams end there, of those that end there or pass. More than a "
        "quarter, and the cell is published as occupied.",
        disabled="log_maps" in state.limits().held,
        **state.bind_view(SHOWN, ONE),
    )


def _uploads() -> None:
    key = f"own_log_{state.view(TAKEN, 0)}"
    uploads.uploader("Log of scans", key, _use_log, ABOUT, several=True)
    st.caption(ABOUT)
    uploads.uploader(
        "Trajectory (TUM), before timed scans",
        f"own_poses_{state.view(TAKEN, 0)}",
        _keep_trajectory,
        "Lines of t x y z qx qy qz qw. Each scan is placed by its time.",
    )


def _columns() -> tuple[Column, ...]:
    """The maps that are shown: one, or gmapping's beside it."""
    return MAPS[state.view(SHOWN, ONE)]


def _use_log(given: Any) -> None:
    _renew_upload()  # else the next log would be given together with this one
    log = _log_of({file.name: file.getvalue() for file in given})
    logs.played(log, state.settings())  # refused here, or not at all
    state.edit_robot(log=log)


def _log_of(files: dict[str, bytes]) -> LogFile:
    """One log of the files that were given together."""
    timed_scans = [name for name, data in files.items() if is_timed_scans(data)]
    if len(files) == 1:
        [(name, data)] = files.items()
        poses = state.view(POSES, None) if timed_scans else None
        if timed_scans and poses is None:
            raise RobotFileError(
                "timed scans need a TUM trajectory: upload both together"
            )
        return LogFile(name, data, trajectory=poses)
    if len(files) == 2 and len(timed_scans) == 1:
        scans = files.pop(timed_scans[0])
        [poses] = files.values()
        return LogFile(timed_scans[0], scans, trajectory=poses)
    if any(bags.is_bag(data) for data in files.values()):
        return LogFile(min(files), bags.join(files))
    raise RobotFileError(
        "one log is mapped at a time. Only the files of one bag, or timed scans and "
        f"their trajectory, are given together; got {len(files)} files"
    )


def _keep_trajectory(file: Any) -> None:
    data = file.getvalue()
    read_trajectory(data)  # refused here, or not at all
    state.set_view(POSES, data)


def _forget() -> None:
    state.edit_robot(log=None)


def _renew_upload() -> None:
    state.set_view(TAKEN, state.view(TAKEN, 0) + 1)


def mapped(log: LogFile) -> PlayedLog | None:
    """The log on its map; None where these settings cannot map it."""
    try:
        return logs.played(log, state.settings())
    except OccsimError as error:
        shell.say_error(str(error))
        return None


def facts(log: LogFile, made: PlayedLog) -> str:
    """What was mapped, and what was left out."""
    scan_log, grid = made.scans.scan_log, made.grid
    scale = made.scans.frame.metres_per_px
    name = f"{words.plain(log.name)}: "
    if log.is_simulated:
        name = "Simulated on the tour of this building, with the errors of a small "
        name += "laser scanner (Hokuyo URG-04LX): "
    kept = (
        ""
        if not state.robot().is_log_too_large
        else (" The log is too large to be kept: after a reload, upload it again.")
    )
    said = (
        f"{name}{made.n_scans:,} scan{'s' * (made.n_scans != 1)} of "
        f"{scan_log.n_beams} beam{'s' * (scan_log.n_beams != 1)}; map "
        f"{grid.width_px * scale:.1f} m × {grid.height_px * scale:.1f} m in cells of "
        f"{100 * scale:.0f} cm.{kept}"
    )
    return " ".join([said, *_left_out(made)])


def _left_out(made: PlayedLog) -> Iterator[str]:
    """Sentences on what the map does not show."""
    found = made.scans
    if isinstance(found, TimedScans | bags.BagLog) and found.n_left_out:
        yield (
            f"Left out: {found.n_left_out:,} more, without a pose at their time or "
            "with other beams."
        )
    if made.every > 1:
        yield (
            f"Of the scans, every {words.ordinal(made.every)} was used: all of them "
            "would be more than can be played. Larger cells or a shorter usable range "
            "leave room for more."
        )
    if not found.scan_log.is_hit.any():
        yield "No beam met anything within its reach: are the ranges in metres?"


def _words() -> None:
    with st.container(key="map_words"):
        see, predict, why = st.columns(3, gap="large")
    with see:
        st.markdown(f"**See.** {SEE[state.view(SHOWN, ONE)]} {NO_TRUTH}")
    with predict:
        st.markdown(
            "**Predict.** Under *More settings*, let a scan say that all behind the "
            "end of a beam is occupied. Will the map have more wall or less?"
        )
        with st.expander("And then?"):
            st.markdown(
                "More, on the logs of all five reference drawings: what is hidden "
                "behind a wall is called occupied until another scan looks at it."
            )
    with why:
        st.markdown(
            "**Why.** A range finder says where a beam ended, not how thick the wall "
            "is. Real mappers therefore say nothing of what lies behind; the source's "
            "Eq. 4.22, as printed, does."
        )

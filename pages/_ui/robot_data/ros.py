"""Maps of ROS: a robot's map in, as drawing, ground truth or prior; our maps out."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import streamlit as st

from occsim import Corrections
from occsim._files import printable
from occsim.building import Building, mask_of_size
from occsim.io.images import drawing_png
from occsim.io.metric import MetricFrame
from occsim.io.ros_map import RosMap, load_files, map_drawing, map_names
from pages._ui import compute, shell, state, uploads, words
from pages._ui.robot_data import files
from pages._ui.robot_data.work import Placed

KEPT, KEEP_UNKNOWN = "ros_map", "ros_keep_unknown"
SEVERAL, WHICH = "ros_maps", "ros_which"
"""The files of several maps, and the one that is shown."""
UNKNOWN_BELOW = 0.196
"""The level that map servers write for unknown is 205: 0.196 of black."""
ABOUT = (
    "The .yaml and the image (.pgm or .png) together, or both in one .zip; of several "
    "maps you choose one."
)
TRAP = (
    "This file's free_thresh calls free what map servers write as unknown (level 205). "
    "nav2 reads it so. Switched on, such pixels stay unknown."
)


@dataclass(frozen=True, eq=False)
class MapFile:
    """A ROS map as its files say, and with the level of unknown kept unknown."""

    name: str
    as_read: RosMap
    with_unknown: RosMap

    @property
    def has_trap(self) -> bool:
        """Whether the two differ."""
        return bool((self.as_read.is_unknown != self.with_unknown.is_unknown).any())

    @property
    def ros_map(self) -> RosMap:
        """The one that the student wants."""
        keeps = self.has_trap and state.view(KEEP_UNKNOWN, False)
        return self.with_unknown if keeps else self.as_read


def show() -> None:
    """Draw the section: a map in, this building's maps out."""
    if state.message():
        shell.say_error(state.message())
    given, ours = st.columns(2, gap="large")
    with given:
        st.markdown("**A robot's map, in**")
        panel()
    with ours:
        st.markdown("**Maps of this app, out**")
        _out()


def panel() -> None:
    """Draw the upload of a map, what it is, and what it can be used as."""
    uploads.uploader("ROS map", "own_ros_map", _take, ABOUT, several=True)
    _choose()
    kept = state.view(KEPT, None)
    if kept is None:
        st.caption(
            "A map of ROS map_server or nav2. Its occupied pixels are its walls; wall "
            "detection is not run."
        )
        return
    if kept.has_trap:
        st.toggle(
            "Keep unknown what is drawn as unknown",
            help=TRAP,
            **state.bind_view(KEEP_UNKNOWN, False),
        )
    ros_map = kept.ros_map
    st.image(
        drawing_png(map_drawing(ros_map)),
        width="stretch",
        alt="The map: black is occupied, white free, grey unknown",
    )
    st.caption(facts(kept.name, ros_map))
    _uses(kept.name, ros_map)


def facts(name: str, ros_map: RosMap) -> str:
    """What a map is, in a sentence."""
    height, width = ros_map.values.shape
    scale = ros_map.resolution_m
    return (
        f"{words.plain(name)}: {width} × {height} px of {scale:g} m, "
        f"{width * scale:.1f} m × {height * scale:.1f} m; lower left corner at "
        f"{_place(ros_map.frame)}. Occupied "
        f"{words.percent(float(ros_map.is_occupied.mean()))}, unknown (grey) "
        f"{words.percent(float(ros_map.is_unknown.mean()))}."
    )


def _place(frame: MetricFrame) -> str:
    return (
        f"x = {words.number(frame.origin_x_m, 'g')} m, y = "
        f"{words.number(frame.origin_y_m, 'g')} m, turned by "
        f"{words.number(frame.origin_yaw_rad, 'g')} rad"
    )


def _take(given: Any) -> None:
    contents = {file.name: file.getvalue() for file in given}
    names = map_names(contents)
    which = names[0] if len(names) > 1 else None
    state.set_view(KEPT, _read(contents, which))
    state.set_view(SEVERAL, contents if which else None)
    state.set_view(WHICH, which)


def _read(contents: dict[str, bytes], which: str | None) -> MapFile:
    images = (n for n in contents if not n.lower().endswith((".yaml", ".yml")))
    return MapFile(
        which or next(images, "map"),
        load_files(contents, which=which),
        load_files(contents, which=which, free_thresh=UNKNOWN_BELOW),
    )


def _choose() -> None:
    """Let one of several maps be chosen."""
    contents = state.view(SEVERAL, None)
    if contents is None:
        return
    names = map_names(contents)
    st.selectbox(
        f"One of {len(names)} maps",
        names,
        format_func=printable,  # options are no Markdown
        **state.bind_view(WHICH, names[0], _show_chosen),
    )


def _show_chosen() -> None:
    contents, which = state.view(SEVERAL, None), state.view(WHICH, None)
    if contents is not None:
        state.set_view(KEPT, _read(contents, which))


def _uses(name: str, ros_map: RosMap) -> None:
    with st.container(horizontal=True):
        uses: tuple[tuple[str, Callable[..., None], str], ...] = (
            (
                "Use as drawing",
                _as_drawing,
                "A new building. The occupied pixels become its drawing and its world, "
                "the scale is known, and a tour of the free space is planned. Unknown "
                "pixels are not walls, and the tour avoids them; a prior made of this "
                "drawing is one half there.",
            ),
            (
                "Use as ground truth",
                _as_truth,
                "The ground truth of the open drawing, which must have the same size. "
                "Occupied pixels are walls; free and unknown pixels are not.",
            ),
            (
                "Use as prior",
                _as_prior,
                "The walls of the prior, instead of those found in the open drawing, "
                "which must have the same size. Cells that are unknown for the half or "
                "more stay unknown: they start from one half, whatever p_space is.",
            ),
        )
        for label, use, about in uses:
            st.button(
                label,
                on_click=state.edit,
                args=(partial(use, name, ros_map),),
                help=words.maths(about),
            )
    st.page_link(
        "pages/1_Build_a_map.py",
        label=f"Open now: {words.plain(state.drawing_title(state.choice()))}",
        icon=":material/arrow_forward:",
    )


def _as_drawing(name: str, ros_map: RosMap) -> None:
    building = compute.building_of_map(ros_map, name, uploads.working_px())
    state.open_own(building)
    state.edit_robot(placed=Placed(building.drawing.digest, ros_map.frame))


def _as_truth(name: str, ros_map: RosMap) -> None:
    shape = state.building().drawing.shape
    state.edit_building(truth=mask_of_size(ros_map.is_occupied, shape))


def _as_prior(name: str, ros_map: RosMap) -> None:
    shape = state.building().drawing.shape
    walls = mask_of_size(ros_map.is_occupied, shape)
    unknown = (
        mask_of_size(ros_map.is_unknown, shape) if ros_map.is_unknown.any() else None
    )
    nothing = Corrections.none(shape)
    state.edit_building(found=walls, unknown=unknown, corrections=nothing)


def _frame(building: Building, metres_per_px: float) -> MetricFrame:
    """Where the maps of a building lie: where its map of ROS lay, if it is of one."""
    height_px, _ = building.drawing.shape
    frame = MetricFrame(height_px=height_px, metres_per_px=metres_per_px)
    placed = state.robot().placed
    if placed is None or placed.digest != building.drawing.digest:
        return frame
    return replace(placed.frame, height_px=height_px, metres_per_px=metres_per_px)


def _out() -> None:
    building, settings = state.building(), state.settings()
    if building.metres_per_px is None:
        st.info(
            "A ROS map is in metres, and the scale of this drawing is not known: "
            "measure a door on the page Your building, 2 Scale."
        )
        return
    run = compute.run(building, settings)
    frame = _frame(building, building.metres_per_px)
    st.markdown(
        f"**{words.plain(state.drawing_title(state.choice()))}**, with the settings of "
        f"*Build a map*. The drawing's lower left corner lies at {_place(frame)}."
    )
    occupancy_map, prior_map = run.map(settings.prior), run.prior_map(settings.prior)
    st.image(
        files.picture(occupancy_map, frame),
        width="stretch",
        alt="The map after the last reading",
    )
    for label, ros_map, name in (
        ("Map", RosMap.of_map(occupancy_map, frame), "map"),
        ("Prior", RosMap.of_prior(prior_map, frame, run.mapped.unknown_cells), "prior"),
    ):
        _downloads(label, ros_map, name)
    st.caption(
        "*Percentages* keeps every value (mode raw) and is read back as it was. "
        "*Trinary*, which every program reads, keeps occupied, free and unknown: "
        "values between 20 % and 65 % become unknown, and so do most cells of a prior."
    )


def _downloads(label: str, ros_map: RosMap, name: str) -> None:
    with st.container(horizontal=True):
        for words_of_mode, mode in files.MODES.items():
            st.download_button(
                f"{label}: {words_of_mode} (zip)",
                partial(files.zipped, ros_map, name, mode),
                file_name=f"{name}_{mode.value}.zip",
                mime="application/zip",
                on_click="ignore",
            )

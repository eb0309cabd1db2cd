"""The map of a log, to download."""

from functools import partial

import streamlit as st

from pages._ui.robot_data import files
from pages._ui.robot_data.played import PlayedLog

FILES = (
    ("ROS map: yaml and pgm (zip)", files.ros_trinary, "map.zip", "application/zip"),
    ("The same with percentages", files.ros_raw, "map_raw.zip", "application/zip"),
    ("Picture (PNG)", files.picture, "map.png", "image/png"),
    ("Arrays (NPZ)", files.arrays, "map.npz", "application/octet-stream"),
)


def popover(made: PlayedLog) -> None:
    """Draw the downloads of the final map."""
    with st.popover("Download the map"):
        st.caption(
            "The map after the last scan, without a drawing. The ROS map has its place "
            "in the log's metres; cells that no scan looked at are unknown."
        )
        for label, make, name, mime in FILES:
            st.download_button(
                label,
                partial(make, made.blank_map, made.scans.frame),
                file_name=name,
                mime=mime,
                on_click="ignore",
                width="stretch",
            )

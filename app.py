"""Home: what this is, a replay that moves, and the way to the lessons."""

import streamlit as st

from pages._ui import compute, replays, shell, state, words
from pages._ui.components.player import PlayerDocument, map_player

HOME_SAMPLE = "a"
HOME_REPLAY = PlayerDocument(rev=1, compact=True)

with shell.page("app.py"):
    st.title("Occupancy grid mapping with informative priors", anchor=False)
    st.markdown(
        "A robot with a range sensor drives through a building and records, cell by "
        "cell, how probable it is that the cell is free. If the architect's drawing is "
        "known, the map can start from its walls: they are its *prior*. Here you "
        "can watch such maps grow, change the prior while they do, and find out "
        "which priors help and which mislead."
    )
    with st.container(key="home"):
        links, picture = st.columns([2, 3], gap="large")
    with links:
        for lesson in shell.LESSONS[1:]:
            st.page_link(
                lesson.path,
                label=f"**{lesson.label}**",
                icon=":material/arrow_forward:",
            )
            st.caption(lesson.purpose)
    with picture:
        sample = compute.sample(HOME_SAMPLE)
        settings = state.defaults(HOME_SAMPLE)
        map_player(replays.replay(sample, settings), HOME_REPLAY, key="home_player")
        st.caption(
            f"The robot maps “{sample.title}”. White is free, black is occupied. "
            "Cells that it has not seen yet are hatched and show the drawing: light "
            "grey for space, dark grey for walls. Poses are known exactly, the sensor "
            "has no noise, and the world is flat."
        )
    st.caption(words.SOURCE)

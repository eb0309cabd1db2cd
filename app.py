"""Home: three maps that differ in what they start from, and the way to the lessons."""

import streamlit as st

from pages._ui import compute, home, lessons, replays, shell, state, words
from pages._ui.columns import HOME_COLUMNS, HOME_SAMPLE
from pages._ui.components.player import map_player

with shell.page("app.py"):
    building, settings = compute.sample(HOME_SAMPLE), state.defaults(HOME_SAMPLE)
    st.title("Hand the robot a drawing. Then hand it the wrong one.", anchor=False)
    st.markdown(
        f"One robot, one building, the same {len(building.trajectory)} readings. The "
        "three maps differ only in what they start from."
    )
    key = state.HOME_KEY
    played = state.take_from_player(key)
    home.keep_vote(played)
    with st.container(key="home_maps"):
        map_player(
            replays.replay_of(building, settings, HOME_COLUMNS),
            state.player_document(key),
            key=key,
            held=state.parts_held(key),
        )
    home.finding(played, building, settings)
    home.terms()
    with st.container(key="home_ways"):
        path, plans = st.columns([3, 2], gap="large")
    with path:
        st.header("The lessons", anchor=False)
        lessons.path()
    with plans:
        home.plans()
    st.caption(words.SOURCE)

"""What the sensor says: one reading at pixel level, and how readings add up."""

import streamlit as st

from pages._ui import lessons, limits, shell, state, words
from pages._ui.components.lens import lens

with shell.page(state.LENS_PATH) as here:
    shell.heading(here)
    state.take_from_lens()
    held = state.limits_of(limits.OF_LENS)
    lens(state.lens_document(), key=state.LENS_KEY, limits=held)
    with st.container(key="map_words"):
        lessons.beside(state.LENS_PATH)
        st.caption(words.SOURCE)

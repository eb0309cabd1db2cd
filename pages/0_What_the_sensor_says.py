"""What the sensor says: one reading at pixel level, and how readings add up."""

import streamlit as st

from pages._ui import limits, shell, state, words
from pages._ui.components.lens import lens

with shell.page(state.LENS_PATH) as lesson:
    shell.heading(lesson)
    state.take_from_lens()
    held = state.limits_of(limits.OF_LENS)
    lens(state.lens_document(), key=state.LENS_KEY, limits=held)
    st.caption(words.SOURCE)

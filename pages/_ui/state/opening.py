"""The settings that a drawing of a session and its class open with."""

import streamlit as st

from occsim import load_sample
from pages._ui import openings
from pages._ui.classroom.prepared import Prepared
from pages._ui.settings import Settings, decode

OWN = "own"


def defaults(name: str) -> Settings:
    """The settings that a drawing opens with."""
    return openings.of_building(
        st.session_state.own if name == OWN else load_sample(name)
    )


def of_class(prepared: Prepared, name: str) -> Settings:
    """The settings that a class opens with on a drawing."""
    settings, _ = decode(prepared.texts, defaults(name))
    return settings

"""Widgets tied to settings: one declared table gives bounds, words and units."""

from enum import Enum
from typing import Literal

import streamlit as st

from pages._ui import state, words
from pages._ui.choices import CHOICES
from pages._ui.settings import TABLE

CHART_CONFIG = {"displayModeBar": False, "scrollZoom": False}
"""Plotly options of every chart: a click selects, and the wheel scrolls the page."""
NARROW_PX = 165
"""Two sliders of this width stand side by side on a telephone of 390 px."""
DRAWING_PX = 290


def slider(name: str, width: int | Literal["stretch"] = "stretch") -> None:
    """Draw the slider of a numeric setting."""
    setting = TABLE[name]
    whole = isinstance(getattr(state.settings(), name), int)
    number = int if whole else float
    st.slider(
        words.maths(setting.label) + _unit(name),
        number(setting.low),
        number(setting.high),
        step=number(setting.step),
        help=words.maths(setting.help),
        width=width,
        **state.bind(name),
    )


def _unit(name: str) -> str:
    """The unit of a setting; of a length, metres as well where the scale is known."""
    unit = TABLE[name].unit
    metres_per_px = state.building().metres_per_px
    if unit == "px" and metres_per_px is not None:
        return f" (px; {getattr(state.settings(), name) * metres_per_px:.2f} m)"
    return f" ({unit})" if unit else ""


def toggle(name: str) -> None:
    """Draw the switch of a setting that is on or off."""
    st.toggle(
        TABLE[name].label,
        help=words.maths(TABLE[name].help),
        **state.bind(name),
    )


def radio(name: str) -> None:
    """Draw the options of a setting that is a choice."""
    options: list[Enum] = list(type(getattr(state.settings(), name)))
    st.radio(
        TABLE[name].label,
        options,
        format_func=CHOICES.__getitem__,
        help=words.maths(TABLE[name].help),
        **state.bind(name),
    )


def segments(name: str) -> None:
    """Draw the options of a setting that is a choice, side by side."""
    options: list[Enum] = list(type(getattr(state.settings(), name)))
    st.segmented_control(
        TABLE[name].label,
        options,
        format_func=CHOICES.__getitem__,
        help=words.maths(TABLE[name].help),
        required=True,
        **state.bind(name),
    )


def select(name: str, width: int | Literal["stretch"] = "stretch") -> None:
    """Draw the options of a setting that is a choice, in a list that opens."""
    options: list[Enum] = list(type(getattr(state.settings(), name)))
    st.selectbox(
        TABLE[name].label,
        options,
        format_func=CHOICES.__getitem__,
        help=words.maths(TABLE[name].help),
        width=width,
        **state.bind(name),
    )


def number(name: str, width: int | Literal["stretch"] = "stretch") -> None:
    """Draw the box of a whole number."""
    setting = TABLE[name]
    st.number_input(
        words.maths(setting.label),
        int(setting.low),
        int(setting.high),
        step=int(setting.step),
        help=words.maths(setting.help),
        width=width,
        **state.bind(name),
    )


def drawing_choice() -> None:
    """Draw the choice between the reference drawings and the student's own."""
    titles = {name: state.drawing_title(name) for name in state.choices()}
    st.selectbox(
        "Drawing",
        list(titles),
        format_func=titles.__getitem__,
        help="Five reference drawings, and your own once you have uploaded one.",
        width=DRAWING_PX,
        **state.bind_choice(),
    )

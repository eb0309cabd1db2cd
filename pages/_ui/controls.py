"""Widgets tied to settings: one declared table gives bounds, words and units."""

import functools
import math
from collections.abc import Callable
from enum import Enum
from typing import Any, Literal

import streamlit as st

from occsim.building import Building
from pages._ui import compute, state, words
from pages._ui import presets as named
from pages._ui.choices import CHOICES, Flaw, Preset
from pages._ui.settings import TABLE, Settings

NARROW_PX = 165
"""Two sliders of this width stand side by side on a telephone of 390 px."""
DRAWING_PX = 250
MANY = 4
"""So many options stand in a list that opens."""


def chart(name: str) -> dict[str, Any]:
    """Plotly options of a chart: a click selects, the wheel scrolls the page, and a
    button saves the chart under the name as SVG, for slides and reports."""
    return {
        "scrollZoom": False,
        "displaylogo": False,
        "modeBarButtons": [["toImage"]],
        "toImageButtonOptions": {"format": "svg", "filename": name},
    }


def shown(name: str) -> bool:
    """Whether a control is on the page; one that is hidden is noted, to be told."""
    if not state.limits().hides(name):
        return True
    state.note_hidden(name)
    return False


def _may_be_hidden(draw: Callable[..., None]) -> Callable[..., None]:
    """Draw the control of a setting only where nobody has hidden it."""

    @functools.wraps(draw)
    def draw_shown(name: str, *args: Any, **options: Any) -> None:
        if shown(name):
            draw(name, *args, **options)

    return draw_shown


@_may_be_hidden
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
        format=None if whole else f"%.{_decimals(setting.step)}f",
        help=words.maths(setting.help),
        width=width,
        **state.bind(name),
    )


def _decimals(step: float) -> int:
    """How many show every step of a slider; two at least."""
    return max(2, -math.floor(math.log10(step)))


def _unit(name: str) -> str:
    """The unit of a setting; of a length, metres as well where the scale is known."""
    unit = TABLE[name].unit
    metres_per_px = state.building().metres_per_px
    if unit == "px" and metres_per_px is not None:
        length = getattr(state.settings(), name) * metres_per_px
        return f" (px;\u00a0{length:.2f}\u00a0m)"
    return f" ({unit})" if unit else ""


@_may_be_hidden
def toggle(name: str) -> None:
    """Draw the switch of a setting that is on or off."""
    st.toggle(
        TABLE[name].label,
        help=words.maths(TABLE[name].help),
        **state.bind(name),
    )


@_may_be_hidden
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


@_may_be_hidden
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


@_may_be_hidden
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


@_may_be_hidden
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


def more(*names: str, also: Callable[[], None] | None = None) -> None:
    """Draw the settings that few move, behind a button; without any, not even that.

    `also` draws more of them below.
    """
    if not [name for name in names if shown(name)]:
        return
    with st.popover("More settings"):
        for name in names:
            if name == "presets":
                presets()
            else:
                _kind(getattr(state.settings(), name))(name)
        if also is not None:
            also()


def _kind(value: object) -> Callable[[str], None]:
    """The kind of control that a setting has where nothing else is said."""
    if isinstance(value, bool):
        return toggle
    if isinstance(value, Enum):
        return select if len(type(value)) >= MANY else radio
    return slider


def presets() -> None:
    """Draw the named sets of conditions, and say what departs from the nearest one."""
    if not shown("presets"):
        return
    settings = state.settings()
    with st.container(width="content"):
        st.segmented_control(
            "Conditions",
            list(Preset),
            format_func=CHOICES.__getitem__,
            help="Each sets the update rule, what is said behind a hit, the cells that "
            "are scored and the thickness of the drawing's walls. The source prints "
            "neither its rule nor its walls: *As in the source* is our reconstruction.",
            **state.bind_preset(),
        )
        nearest = named.nearest(settings)
        left = named.departures(settings, nearest)
        if left:
            st.caption(f"{CHOICES[nearest]}, but changed: {', '.join(left)}.")


ERRORS_LEGEND = (
    "Black: a wall that the drawing keeps. Blue: a wall that it leaves out. Orange: a "
    "wall that it invents."
)
ERRORS = (
    "thickness_px",
    "shift_x_px",
    "shift_y_px",
    "rotation_deg",
    "drawing_scale",
    "missing_share",
    "false_share",
)


def errors_words(settings: Settings) -> str:
    """What a single map's drawing gets wrong, as its figure says it."""
    wrong = [name for name in ERRORS if getattr(settings, name) != NO_ERRORS[name]]
    texts = (f"{TABLE[one].label.lower()} {_with_unit(settings, one)}" for one in wrong)
    return ", ".join(texts) or CHOICES[Flaw.FOUND]


def _with_unit(settings: Settings, name: str) -> str:
    return f"{getattr(settings, name):g} {TABLE[name].unit}".strip()


NO_ERRORS = {name: getattr(Settings(), name) for name in (*ERRORS, "prior_drawing")}


def drawing_errors() -> None:
    """Draw the group in which the drawing that the prior is made from gets errors."""
    if not [name for name in (*ERRORS, "prior_drawing") if shown(name)]:
        return
    building, settings = state.building(), state.settings()
    has_errors = compute.prior_mask(building, settings) is not None
    with st.popover(f"Drawing's errors{': on' if has_errors else ''}"):
        st.caption(
            "What the drawing gets wrong. It changes only the prior; the building that "
            "the robot drives through stays the same."
        )
        left, right = st.columns(2, gap="medium")
        with left:
            _prior_drawing("prior_drawing", building)
            st.image(
                compute.errors_picture(building, settings),
                width="stretch",
                alt="The walls of the prior over those found in the drawing",
            )
            st.caption(ERRORS_LEGEND)
            st.button(
                "No errors",
                on_click=state.change,
                kwargs=NO_ERRORS,
                disabled=not has_errors or "thickness_px" in state.limits().held,
            )
        with right:
            for name in ERRORS:
                slider(name)
            if settings.missing_share or settings.false_share:
                number("flaw_seed")


THINNED = {"thickness_px": -2}
"""What the source's detector may have done to its walls: a hypothesis."""
AS_IT_IS, THIN = "Drawing as it is", "Thin walls by 2 px"


def thin_walls(has_errors: bool) -> str:
    """Which button thins the walls; with errors it first takes these off."""
    return f"*{AS_IT_IS}* and then *{THIN}*" if has_errors else f"*{THIN}*"


def thinning() -> None:
    """Draw a button that thins the drawn walls by 2 px, or takes all errors off."""
    if not shown("thickness_px"):
        return
    has_errors = compute.prior_mask(state.building(), state.settings()) is not None
    st.button(
        AS_IT_IS if has_errors else THIN,
        on_click=state.change,
        kwargs=NO_ERRORS if has_errors else THINNED,
        disabled="thickness_px" in state.limits().held,
        help="Walls thinner than the building's: a hypothesis on how the source found "
        "its own.",
    )


@_may_be_hidden
def _prior_drawing(name: str, building: Building) -> None:
    setting = TABLE[name]
    options = compute.prior_drawings(building)
    bound = state.bind(name, options)
    st.selectbox(
        setting.label,
        options,
        format_func=CHOICES.__getitem__,
        help=setting.help,
        **bound,
    )


def drawing_choice() -> None:
    """Draw the choice between the reference drawings and the student's own."""
    if not shown("drawing"):
        return
    titles = {name: state.drawing_title(name) for name in state.choices()}
    st.selectbox(
        "Drawing",
        list(titles),
        format_func=titles.__getitem__,
        help="Five reference drawings, and your own once you have uploaded one.",
        width=DRAWING_PX,
        **state.bind_choice(),
    )

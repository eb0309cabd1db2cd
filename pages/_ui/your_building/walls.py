"""Section 3: wall detection, stage by stage."""

from dataclasses import replace
from functools import partial

import streamlit as st

from occsim.walls import WallParams
from pages._ui import state, words
from pages._ui.state import boards as kept
from pages._ui.your_building import detecting, lengths, masks
from pages._ui.your_building.stages import STAGE_NOTES, Slider

COLUMNS = 5
"""Height of the pictures: two rows, large enough to see a door leaf removed."""


def show() -> None:
    """Show every stage with its sentence and its sliders, and where the mask errs."""
    building = state.building()
    st.markdown(_how_sure())
    stages = detecting.stage_pictures(building.drawing, building.wall_params)
    cells = [partial(_stage, title, image) for title, image in stages]
    cells += [_errors, _all_stages]
    for start in range(0, len(cells), COLUMNS):
        columns = st.columns(COLUMNS)
        for column, cell in zip(columns, cells[start : start + COLUMNS], strict=False):
            with column:
                cell()


def _how_sure() -> str:
    """How sure the detection is, in a line, and what to look at first."""
    building = state.building()
    sure = detecting.detection(building.drawing, building.wall_params).certainty
    if not building.walls_found.any():
        return (
            "**No walls were found.** Three things to try: crop to the plan "
            "(1 Drawing), lower the darkness of ink or the thinnest wall below, or "
            "draw the walls by hand (4 Corrections)."
        )
    facts = [
        f"**Certainty {sure.confidence:.2f}** on a scale from 0 to 1 that ranks "
        "drawings; it is no share of right walls. Most walls are about "
        f"{lengths.length(sure.wall_px)} thick",
        f"{words.percent(sure.removed_share)} of the ink was left out",
    ]
    if sure.dropped:
        facts.append(f"{lengths.count(sure.dropped, 'piece')} dropped")
    if sure.doubtful:
        pieces = lengths.count(sure.doubtful, "doubtful piece")
        facts.append(f"{pieces} to accept or remove in 4 Corrections")
    return " ".join(["; ".join(facts) + ".", *sure.notes])


def _stage(title: str, image: bytes) -> None:
    note = STAGE_NOTES[title]
    st.image(image, width="stretch", alt=f"Wall detection: {title}")
    st.markdown(f"**{title}**")
    st.caption(note.sentence)
    for slider in note.sliders:
        _slider(slider)


def _slider(slider: Slider) -> None:
    st.slider(
        slider.label,
        float(slider.low),
        float(slider.high),
        step=float(slider.step),
        format="%g",
        **kept.bind_wall(slider.field, _change),
    )


def _errors() -> None:
    st.image(
        masks.error_picture(),
        width="stretch",
        alt="The wall mask compared with the ground truth",
    )
    if state.building().truth is None:
        st.markdown("**Wall mask**")
    else:
        st.markdown("**Against the ground truth**")
        st.caption("Black: found. Orange: false wall. Blue: missed wall.")
    masks.agreement()


def _all_stages() -> None:
    st.button(
        "Automatic settings",
        on_click=state.edit,
        args=(partial(_detect, WallParams()),),
        disabled=state.building().wall_params == WallParams(),
        width="stretch",
    )
    st.toggle(
        "Straighten first",
        help="Turn a tilted drawing upright while its walls are detected.",
        **kept.bind_wall("straighten", _change),
    )
    st.caption(
        "All lengths are estimated from the drawing's own lines. What still errs is "
        "corrected by hand in the next section."
    )


def _detect(params: WallParams) -> None:
    found = detecting.detection(state.building().drawing, params)
    state.edit_building(found=found.mask, wall_params=params)


def _change(field: str, value: float | bool) -> None:
    """Find the walls again with one parameter changed; corrections stay."""
    _detect(replace(state.building().wall_params, **{field: value}))

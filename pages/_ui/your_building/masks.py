"""Sections 4 and 5: walls corrected by hand, and the ground truth."""

from functools import partial
from typing import Any

import streamlit as st

from occsim import Corrections
from occsim.corrections import unpack_mask
from occsim.io.images import class_png, mask_png
from occsim.walls import MaskError
from pages._ui import palette, state, uploads, words
from pages._ui.your_building import detecting, drawn

PICTURE_PX = drawn.HEIGHT_PX - 80
"""Height of a picture with its caption in a frame as high as the board."""

ERROR_COLOURS = {
    MaskError.FREE: palette.FREE,
    MaskError.HIT: palette.HIT,
    MaskError.FALSE_WALL: palette.FALSE_WALL,
    MaskError.MISSED_WALL: palette.MISSED_WALL,
}


def correct() -> None:
    """Correct the wall mask with brush, line, rectangle and eraser."""
    left, right = st.columns([4, 1])
    with left:
        drawn.walls_board("board_walls")
    with right:
        st.markdown(
            "**See** the detected walls, tinted; striped pieces are doubtful. **Try** "
            "to accept or remove these, to erase what is not wall and to close gaps. "
            "**Why:** the prior is made from this mask alone."
        )
        building = state.building()
        st.caption(f"{building.n_added:,} px added, {building.n_erased:,} px erased")
        st.button(
            "Discard all corrections",
            on_click=state.edit,
            args=(_discard,),
            disabled=building.corrections.is_empty,
            width="stretch",
        )
        _unknown()
        agreement()
        with st.expander("Leave a false wall in: will the map show it?"):
            st.markdown(
                r"Not where the robot looks: at $p_\text{wall} = 0.2$ one clear "
                "reading outweighs the prior. Where it never looks, the error stays."
            )
        _download(building.wall_mask, "walls.png", "Wall mask (PNG)")


def _unknown() -> None:
    """Say of how much the drawing, a robot's map, says nothing; let it be forgotten."""
    unknown = state.building().unknown
    if unknown is None:
        return
    st.caption(
        f"The robot's map is unknown in {words.percent(float(unknown.mean()))} of the "
        "pixels. The prior is one half there, unless you draw a wall."
    )
    st.button(
        "Take unknown for free space",
        on_click=state.edit,
        args=(partial(state.edit_building, unknown=None),),
        width="stretch",
    )


def _discard() -> None:
    nothing = Corrections.none(state.building().drawing.shape)
    state.edit_building(corrections=nothing)


def agreement() -> None:
    """Show the scores of the wall mask against the ground truth."""
    building = state.building()
    if building.truth is None:
        st.caption("No ground truth yet, so there is nothing to compare with.")
        return
    compared = detecting.comparison(building)
    st.markdown(
        f"Precision **{words.percent(compared.precision)}**  \n"
        f"Recall **{words.percent(compared.recall)}**  \n"
        f"IoU **{words.percent(compared.iou)}**"
    )
    st.caption("Pixels of the mask against the ground truth, within 2 px.")


def error_picture() -> bytes:
    """Where the wall mask errs."""
    return class_png(
        detecting.comparison(state.building()).errors,
        [ERROR_COLOURS[error] for error in sorted(MaskError)],
    )


def truth() -> None:
    """Make the ground truth from the mask or from an empty one, or upload an image."""
    left, right = st.columns([4, 1])
    has_truth = state.building().truth is not None
    with left:
        if has_truth:
            drawn.truth_board("board_truth")
        else:
            _world_picture()
    with right:
        _words_of_truth(has_truth)
        for label, make in (
            ("Start from the wall mask", _from_walls),
            ("Start from an empty mask", _from_nothing),
        ):
            st.button(label, on_click=state.edit, args=(make,), width="stretch")
        if has_truth:
            st.button(
                "Map without ground truth",
                on_click=state.edit,
                args=(_without,),
                width="stretch",
            )
        uploads.truth("workshop_truth")
        if has_truth:
            _download(state.building().truth, "ground_truth.png", "Ground truth (PNG)")


def _world_picture() -> None:
    """Show the wall mask that serves as the world, as large as the board would be."""
    height, width = state.building().drawing.shape
    shown_px = min(900, PICTURE_PX * width // height)
    with st.container(
        height=drawn.HEIGHT_PX, border=True, horizontal_alignment="center"
    ):
        st.image(
            mask_png(state.building().wall_mask),
            caption="Without a ground truth the wall mask serves as the world.",
            width=shown_px,
            alt="The wall mask",
        )


def _words_of_truth(has_truth: bool) -> None:
    if has_truth:
        st.markdown(
            "The robot sees **these** walls, whatever the drawing says. Structure "
            "only: no furniture, no text, doors open."
        )
    else:
        st.markdown(
            "The sensor sees the wall mask itself, so the prior is right everywhere "
            "and the map has nothing to correct."
        )


def _from_walls() -> None:
    state.edit_building(truth=state.building().wall_mask)


def _from_nothing() -> None:
    state.edit_building(truth=unpack_mask(b"", state.building().drawing.shape))


def _without() -> None:
    state.edit_building(truth=None)


def _download(mask: Any, name: str, label: str) -> None:
    st.download_button(
        label,
        lambda: mask_png(mask),
        file_name=name,
        mime="image/png",
        on_click="ignore",
        width="stretch",
    )

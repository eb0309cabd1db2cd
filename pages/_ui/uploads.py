"""Uploads by a student: a drawing, a ground truth, a trajectory.

Every upload is checked before anything is kept; a refused one changes nothing.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import streamlit as st

from occsim import OccsimError, load_drawing
from occsim._files import printable
from occsim.building import truth_from_image
from occsim.imaging import Drawing, is_pdf, load_pdf_page, pdf_page_count
from pages._ui import compute, pose_files, state

MAX_UPLOAD_MB = 40
WORKING, WORKING_PX = "working_px", 1500
# Larger scans are reduced while they are decoded: 48 MB at most are kept of a file.
DECODED_PX = 4000
PAGE, PDF = "pdf_page", "pdf"
DRAWINGS = "drawings_taken"


def panel() -> None:
    """Draw the three uploads and their options."""
    drawing("own_drawing")
    st.caption(
        "Walls are detected and a tour of the free space is planned, so that the "
        "drawing can be mapped at once."
    )
    truth("own_truth")
    trajectory("own_trajectory")


def drawing(key: str) -> None:
    """Draw the upload of a drawing."""
    compute.expect_drawings()
    uploader("Drawing", key, _map_drawing, "Image or PDF; scans of any size.")
    pdf = state.view(PDF, None)
    if pdf is not None and pdf.is_shown:
        st.number_input(
            f"Page (of {pdf.n_pages})",
            1,
            pdf.n_pages,
            **state.bind_view(PAGE, 1, _map_page),
        )


def truth(key: str) -> None:
    """Draw the upload of a ground truth."""
    uploader(
        "Ground truth",
        _of_this_drawing(key),
        _use_truth,
        "An image of the drawing's size: black is wall, white is free. Without one the "
        "wall mask serves as the world.",
    )


def trajectory(key: str) -> None:
    """Draw the upload of a trajectory, and ask for what its file does not say."""
    uploader(
        "Trajectory",
        _of_this_drawing(key),
        pose_files.take,
        "CSV, text, NPY, MAT, JSON or TUM: x, y, theta in each row, x and y in pixels "
        "or in metres.",
    )
    pose_files.ask()


def _of_this_drawing(key: str) -> str:
    """A key that is new with each drawing: no file for another one is shown or read."""
    return f"{key}_{state.choice()}_{state.view(DRAWINGS, 0)}"


def uploader(
    label: str,
    key: str,
    use: Callable[[Any], None],
    about: str,
    *,
    several: bool = False,
) -> None:
    """Draw an upload; `use` gets the file, or the list of `several`.

    A refusal names the file and changes nothing.
    """
    # Of any type: the browser would refuse others without saying what they are, and
    # what to do with them.
    st.file_uploader(
        label,
        key=key,
        help=about,
        on_change=_take,
        args=(key, use),
        max_upload_size=MAX_UPLOAD_MB,
        accept_multiple_files=several,
    )


def _take(key: str, use: Callable[[Any], None]) -> None:
    """Use what was put into an uploader, if anything is there."""
    given = state.value(key)
    if given:
        state.edit(partial(_use, given, use))


def _use(given: Any, use: Callable[[Any], None]) -> None:
    """Use one file or several; a refusal names the first."""
    try:
        use(given)
    except OccsimError as error:
        first = given[0] if isinstance(given, list) else given
        name = printable(first.name)
        if name in str(error):
            raise
        raise type(error)(f"{name} cannot be used: {error}") from None


@dataclass(frozen=True, eq=False)
class Pdf:
    """A PDF of several pages, and the drawing that one of them was made into."""

    name: str
    data: bytes
    n_pages: int
    drawing_digest: str

    @property
    def is_shown(self) -> bool:
        """Whether the building on the page was made from this file."""
        return (
            self.n_pages > 1
            and state.choice() == state.OWN
            and state.building().drawing.digest == self.drawing_digest
        )


def _map_drawing(file: Any) -> None:
    data = file.getvalue()
    n_pages = pdf_page_count(data) if is_pdf(data) else 0
    side_px = working_px() if n_pages else DECODED_PX
    _map(load_drawing(data, name=file.name, max_side_px=side_px))
    state.set_view(PAGE, 1)
    digest = state.building().drawing.digest
    state.set_view(PDF, Pdf(file.name, data, n_pages, digest) if n_pages > 1 else None)


def _map_page() -> None:
    pdf = state.view(PDF, None)
    if pdf is not None and pdf.is_shown:
        page, side_px = int(state.view(PAGE, 1)), working_px()
        _map(load_pdf_page(pdf.data, page, long_side_px=side_px, name=pdf.name))
        digest = state.building().drawing.digest
        state.set_view(PDF, replace(pdf, drawing_digest=digest))


def _map(loaded: Drawing) -> None:
    state.open_own(compute.own_building(loaded, working_px()))
    state.set_view(DRAWINGS, state.view(DRAWINGS, 0) + 1)


def working_px() -> int:
    """Longer side to which larger drawings are scaled down, px."""
    return int(state.view(WORKING, WORKING_PX))


def _use_truth(file: Any) -> None:
    image = load_drawing(
        file.getvalue(), name=file.name, max_side_px=DECODED_PX, keep_dark=True
    )
    shape = state.building().drawing.shape
    state.edit_building(truth=truth_from_image(image, shape))


def pose_notice() -> None:
    """Say how many poses are in walls or outside, and offer to drop them."""
    building = state.building()
    found = (
        (building.n_outside, "outside the drawing"),
        (building.n_inside_walls, "in walls"),
    )
    bad = [f"{n} {where}" for n, where in found if n]
    if not bad:
        return
    with st.container(horizontal=True, vertical_alignment="center"):
        st.warning(f"Of {len(building.trajectory)} poses, {' and '.join(bad)}.")
        st.button("Drop them", on_click=state.edit, args=(_drop_poses,))


def _drop_poses() -> None:
    state.edit_building(trajectory=state.building().valid_trajectory())

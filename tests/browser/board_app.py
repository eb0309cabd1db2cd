"""A small app with one drawing board, for its tests: `?mode=walls` and so on.

It keeps the two documents as `drawing_board` requires, and shows Python's state below
the board. A checkbox takes the board off the screen.
"""

import hashlib
import json
from dataclasses import replace

import cv2
import numpy as np
import streamlit as st

from occsim.corrections import pack_mask
from pages._ui.components.board import BoardDocument, BoardMode, drawing_board

SIZES = {"small": (240, 360), "large": (1000, 1500)}


def first_document(mode):
    wall = np.zeros((HEIGHT_PX, WIDTH_PX), dtype=bool)
    wall[100:110, 20:340] = True
    base = b"" if mode in (BoardMode.MEASURE, BoardMode.CROP) else pack_mask(wall)
    doubtful = np.zeros_like(wall)
    if "doubtful" in st.query_params:
        # A piece of the wall, and one beside it.
        doubtful[100:110, 20:60] = doubtful[140:150, 200:260] = True
    return BoardDocument(
        height_px=HEIGHT_PX,
        width_px=WIDTH_PX,
        base=base,
        doubtful=pack_mask(doubtful) if doubtful.any() else b"",
    )


def paper():
    image = np.full((HEIGHT_PX, WIDTH_PX, 3), 255, dtype=np.uint8)
    cv2.putText(image, "Plan", (30, 60), cv2.FONT_HERSHEY_SIMPLEX, 1.2, (90, 90, 90), 2)
    return cv2.imencode(".png", image)[1].tobytes()


def box_of(mask):
    """First and last row and column, half-open, that hold anything."""
    if not mask.any():
        return None
    rows, cols = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return [int(n) for n in (rows[0], rows[-1] + 1, cols[0], cols[-1] + 1)]


def report(current):
    mask = current.mask()
    added, erased = current.corrections.planes
    commit = state.get("board", {}).get("committed") or {}
    facts = {
        "points": [[p.x_px, p.y_px, p.is_waypoint] for p in current.points],
        "added": int(added.sum()),
        "erased": int(erased.sum()),
        "box": box_of(added | erased),
        "commit_bytes": len(json.dumps(commit)),
        "mask": hashlib.sha1(mask.tobytes()).hexdigest(),
        "rev": current.rev,
    }
    st.text(json.dumps(facts))


st.set_page_config(layout="wide")
mode = BoardMode(st.query_params.get("mode", "walls"))
HEIGHT_PX, WIDTH_PX = SIZES[st.query_params.get("size", "small")]
state = st.session_state
if "current" not in state:
    state.current = state.imposed = first_document(mode)
if st.button("Reset"):
    state.current = state.imposed = replace(
        first_document(mode), token=state.current.token, rev=state.current.rev + 1
    )
is_shown = st.checkbox("Show", value=True)
if is_shown:
    if "board" not in state:
        state.imposed = replace(state.current, rev=state.current.rev + 1)
        state.current = state.imposed
    drawn = drawing_board(
        paper(), state.imposed, mode=mode, key="board", metres_per_px=0.02
    )
    if drawn is not None:
        state.current = drawn
report(state.current)

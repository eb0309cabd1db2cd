"""Corrections of a wall mask by hand: vector strokes and the pixels they cover.

A stroke is kept as it was drawn, not as the pixels it changed, so that it can be
undone, sent in a few bytes and drawn again.
"""

from occsim.strokes.packing import pack_mask, unpack_mask
from occsim.strokes.raster import TEST_POINT, apply_strokes
from occsim.strokes.stroke import (
    LATTICE,
    MAX_POINTS,
    MAX_STROKES,
    MAX_WIDTH_PX,
    Stroke,
    StrokeKind,
    decode_strokes,
    encode_strokes,
)

__all__ = [
    "LATTICE",
    "MAX_POINTS",
    "MAX_STROKES",
    "MAX_WIDTH_PX",
    "TEST_POINT",
    "Stroke",
    "StrokeKind",
    "apply_strokes",
    "decode_strokes",
    "encode_strokes",
    "pack_mask",
    "unpack_mask",
]

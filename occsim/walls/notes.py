"""What each stage of wall detection does, in words, and what steers it."""

from occsim.walls.params import Slider, StageNote

_INK = Slider(
    "ink_level", "Darkness of ink (share of black; 0: automatic)", 0, 0.9, 0.05
)
_SHADOW = Slider(
    "shadow_window_px", "Window for shadows (px; 0: automatic)", 0, 400, 10
)
_FILL = Slider(
    "fill_level", "Darkness of fills (share of black; 0: automatic)", 0, 0.9, 0.02
)
_SYMBOL = Slider(
    "max_symbol_px", "Longest letter or symbol (px; 0: automatic)", 0, 100, 1
)
_DOOR = Slider(
    "door_fit", "Allowed stray of a swing (share of its radius)", 0, 0.2, 0.01
)
_THIN = Slider("min_wall_px", "Thinnest wall (px; 0: automatic)", 0, 40, 0.5)
_THICK = Slider("max_wall_px", "Thickest wall (px; 0: automatic)", 0, 200, 1)
_GAP = Slider(
    "max_gap_px", "Widest gap of a hollow wall (px; 0: automatic)", 0, 60, 0.5
)
_SLENDER = Slider("min_slenderness", "Least length over width of a gap", 1, 20, 0.5)
_PIECE = Slider(
    "min_piece_px", "Shortest group of walls kept (px; 0: automatic)", 0, 400, 5
)

STAGE_NOTES: dict[str, StageNote] = {
    "Darkness": StageNote(
        "How dark each pixel is beside the paper around it, so that shadows and tinted "
        "paper vanish and red or grey ink counts like black.",
        (_SHADOW,),
    ),
    "Ink": StageNote(
        "Darkness cut in two: ink or paper, at a threshold found from the histogram "
        "(Otsu's method, a little lower so that thin lines survive).",
        (_INK,),
    ),
    "Text and symbols removed": StageNote(
        "Connected ink that is small, or has no long straight stroke, is lettering "
        "or a symbol.",
        (_SYMBOL,),
    ),
    "Doors removed": StageNote(
        "Quarter circles are door swings: the leaf is taken away and the doorway, in "
        "grey, is kept open.",
        (_DOOR,),
    ),
    "Solid walls": StageNote(
        "Ink that stays when strokes thinner than walls are worn away (morphological "
        "opening).",
        (_THIN,),
    ),
    "Filled and hatched walls": StageNote(
        "Bands of grey, colour or hatching count as walls, in black, if they are as "
        "thick as walls all along and do not lie along one.",
        (_FILL, _THICK),
    ),
    "Hollow walls and windows": StageNote(
        "Gaps between lines, in grey, are hollow walls or windows, in black, if they "
        "are long, even and no tread of a stair, and go on from end to end.",
        (_GAP, _SLENDER),
    ),
    "Connected walls": StageNote(
        "Walls that touch, or face each other across a doorway, make a building; stray "
        "pieces, in grey, are dropped.",
        (_PIECE,),
    ),
}
"""A note for every stage, by its title, in order."""

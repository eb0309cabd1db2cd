"""What each stage of wall detection does, in words, and what steers it."""

from typing import NamedTuple

from occsim.walls import WallParams


class Slider(NamedTuple):
    """A parameter that steers a stage: field of `WallParams`, and its words."""

    field: str
    label: str

    @property
    def low(self) -> float:
        """Least value."""
        return WallParams.bounds(self.field).low

    @property
    def high(self) -> float:
        """Largest value."""
        return WallParams.bounds(self.field).high

    @property
    def step(self) -> float:
        """Step of the slider."""
        return WallParams.bounds(self.field).step


class StageNote(NamedTuple):
    """A sentence for students about a stage, and the parameters that steer it."""

    sentence: str
    sliders: tuple[Slider, ...]


STAGE_NOTES: dict[str, StageNote] = {
    "Darkness": StageNote(
        "How dark each pixel is beside the paper around it, so that shadows, tinted "
        "paper and the colour of a room are paper.",
        (Slider("shadow_window_px", "Window for the paper (px; 0: automatic)"),),
    ),
    "Ink": StageNote(
        "Darkness cut in two: ink or paper, at a threshold found from the histogram "
        "(Otsu's method).",
        (Slider("ink_level", "Darkness of ink (share of black; 0: automatic)"),),
    ),
    "Doors removed": StageNote(
        "Quarter circles are door swings: the leaf is taken away, and the doorway, in "
        "grey, stays open.",
        (Slider("door_fit", "Allowed stray of a swing (share of its radius)"),),
    ),
    "Solid walls": StageNote(
        "Ink that stays when strokes thinner than walls are worn away (morphological "
        "opening). How thick walls are is read from the drawing's own strokes.",
        (Slider("min_wall_px", "Thinnest solid wall (px; 0: automatic)"),),
    ),
    "Hollow walls and windows": StageNote(
        "Two long lines beside each other at a distance that is common in the drawing "
        "are a hollow or hatched wall; with panes between them, a window.",
        (Slider("max_gap_px", "Widest gap of a hollow wall (px; 0: automatic)"),),
    ),
    "Connected walls": StageNote(
        "Walls that touch, or face each other across a doorway, make a building. "
        "Hollow pieces that belong to none are dropped and shown in grey.",
        (Slider("min_piece_px", "Shortest group of walls kept (px; 0: automatic)"),),
    ),
}
"""A note for every stage, by its title, in order."""

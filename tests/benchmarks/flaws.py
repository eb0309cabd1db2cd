"""Putting errors into the mask of a large drawing."""

from collections.abc import Iterator

import numpy as np

from occsim import DrawingFlaws, flawed_mask, load_sample
from tests.benchmarks.table import Row, median_ms, timed_row

SHAPE = (1000, 1500)
CASES = {
    "thinned by 2 px": DrawingFlaws(thickness_px=-2),
    "thickened by 5 px": DrawingFlaws(thickness_px=5),
    "turned, scaled and shifted": DrawingFlaws(
        rotation_rad=0.05, scale=1.05, shift_x_px=6
    ),
    "30 % missing": DrawingFlaws(missing_share=0.3),
    "30 % false": DrawingFlaws(false_share=0.3),
    "all of these, thinned": DrawingFlaws(
        thickness_px=-2,
        rotation_rad=0.05,
        scale=1.05,
        shift_x_px=6,
        missing_share=0.3,
        false_share=0.3,
    ),
}


def sheet() -> np.ndarray:
    """The walls of sample b side by side, (1000, 1500)."""
    mask = load_sample("b").wall_mask
    height, width = SHAPE
    tiles = -(-height // mask.shape[0]), -(-width // mask.shape[1])
    return np.ascontiguousarray(np.tile(mask, tiles)[:height, :width])


def rows() -> Iterator[Row]:
    mask = sheet()
    for what, flaws in CASES.items():
        ms = median_ms(lambda flaws=flaws: flawed_mask(mask, flaws))
        yield timed_row(f"walls of 1500 x 1000 px {what}", ms, 30.0)

"""The lengths that wall detection works with, estimated where they are not given."""

import math
from dataclasses import dataclass

import numpy as np

from occsim._types import ByteArray
from occsim.walls.params import WallParams
from occsim.walls.runs import line_thickness

LINE_SHARE = 0.009
"""Thickest line, as a share of the drawing's shorter side; walls are thicker."""

SYMBOL_SHARE = 0.035
"""Height of large letters, as a share of the shorter side."""

SYMBOL_PX = 12
"""The same in px of the drawing: smaller letters cannot be read."""

MASS_LINES = 2.2
"""Thickness, in lines, from which ink is a mass: two lines touching are not."""

WALL_SHARE = 0.06
"""Thickest wall of lines or hatching, as a share of the shorter side."""

SEED_SHARE = 0.04
"""Shortest wall that is one by itself, as a share of the shorter side."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Measures:
    """Lengths in px of the working frame.

    Parameters
    ----------
    scale : float
        Working pixels along a pixel of the drawing.
    extent : float
        Shorter side of the drawing.
    line : int
        Thickness of lines.
    symbol : float
        Longest side of letters and symbols.
    thin, thick : float
        Thinnest and thickest wall.
    seed : float
        Shortest wall that needs no neighbour to be one.
    """

    scale: float
    extent: float
    line: int
    symbol: float
    thin: float
    thick: float
    seed: float

    @property
    def radius(self) -> tuple[float, float]:
        """Shortest and longest door leaf."""
        return max(0.04 * self.extent, 8.0 * self.scale), 0.3 * self.extent


def measure(ink: ByteArray, params: WallParams, scale: float) -> Measures:
    """Return the lengths for a drawing's ink.

    Parameters
    ----------
    ink : ndarray of uint8, shape (h, w)
        Ink in the working frame.
    params : WallParams
        Lengths given, px of the drawing; zero for estimated.
    scale : float
        Working pixels along a pixel of the drawing.
    """
    extent = _extent(ink)
    thickest_line = max(1.5 * scale, LINE_SHARE * extent)
    line = max(line_thickness(ink, thickest_line), round(scale))
    symbol = max(SYMBOL_PX * scale, SYMBOL_SHARE * extent)
    # Enlarged lines come out thicker than they were drawn.
    thin = math.floor(MASS_LINES * line) if scale > 1 else math.ceil(MASS_LINES * line)
    return Measures(
        scale=scale,
        extent=extent,
        line=line,
        symbol=scale * params.max_symbol_px or symbol,
        thin=scale * params.min_wall_px or max(thin, 3.0),
        thick=scale * params.max_wall_px or WALL_SHARE * extent,
        seed=SEED_SHARE * extent,
    )


def _extent(ink: ByteArray) -> float:
    """Return the shorter side of the box around the ink, px; margins say nothing."""
    rows, cols = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    if len(rows) == 0:
        return float(min(ink.shape))
    return float(min(np.ptp(rows), np.ptp(cols)) + 1)

"""Hatched and filled walls: bands as thick as walls and much longer than thick."""

import numpy as np

from occsim._types import ByteArray, FloatArray
from occsim.walls.measures import Measures
from occsim.walls.raster import (
    Components,
    box,
    closed,
    components,
    depth,
    dilated,
    opened,
)
from occsim.walls.runs import steadiness

FINE = 1.5
"""Widest gap between the lines of a hatching, in lines."""

THINNEST = 3.5
"""Thinnest hatched wall, in lines: two faces and a hatching between them."""

STEADY = 0.8
"""Share of a band's area that must be of one thickness, or of two."""

NETWORK_STEADY = 0.45
"""The same for a network of walls, which has more furniture hanging on it."""

NETWORK = 20.0
"""Length over thickness from which a band is a network."""

SEED = 8.0
"""Length over thickness from which a band is a wall by itself."""

SPAN = 0.9
"""Share of a band's length between walls at its ends from which it is a window."""

BESIDE_SHARE = 0.35
"""Share of its length that a band may lie along other walls, besides its two ends."""


def textured(ink: ByteArray, line_px: int) -> ByteArray:
    """Return the areas of fine hatching, with the lines that bound them."""
    return opened(closed(ink, box(FINE * line_px + 1)), box(THINNEST * line_px))


def wall_bands(areas: ByteArray, walls: ByteArray, m: Measures) -> ByteArray:
    """Return those of the hatched and filled areas that are walls.

    Parameters
    ----------
    areas : ndarray of uint8, shape (h, w)
        Hatched and filled areas.
    walls : ndarray of uint8, shape (h, w)
        Walls already found; a band along one of them is furniture, a band between two
        is a window.
    m : Measures
        Lengths of the drawing.
    """
    bands = components(areas)
    width = np.maximum(4 * bands.total(depth(areas)) / bands.area - 2, 1.0)
    length = bands.area / width
    steady = steadiness(areas, bands, m.thick)
    likely = (width >= m.thin - 1) & (width <= m.thick)
    likely &= steady >= np.where(length >= NETWORK * width, NETWORK_STEADY, STEADY)
    reach = box(2 * m.line + 1)
    contact = areas & dilated(walls, reach)
    beside = bands.total(contact) / m.line
    likely &= beside <= BESIDE_SHARE * length + 2 * width
    chosen = likely & (length >= SEED * width) & (length >= m.seed)
    chosen |= likely & (_spanned(bands, contact) >= SPAN) & (length >= 2 * width)
    for _ in range(5):  # piers between windows, each one further along
        touch = bands.total(areas & dilated(bands.chosen(chosen), reach))
        chosen |= likely & (touch > 0) & (length >= width)
    return bands.chosen(chosen)


def _spanned(bands: Components, contact: ByteArray) -> FloatArray:
    """Return the share of each band's longer side that lies between contacts."""
    rows, cols = np.nonzero(contact)
    labels = bands.labels[rows, cols]
    order = np.argsort(labels, kind="stable")
    labels, rows, cols = labels[order], rows[order], cols[order]
    first = np.flatnonzero(np.diff(labels, prepend=-1))
    span = np.zeros(bands.count)
    if len(labels):
        sides = [
            np.maximum.reduceat(at, first) - np.minimum.reduceat(at, first) + 1
            for at in (rows, cols)
        ]
        index = labels[first]
        upright = bands.height[index] > bands.width[index]
        span[index] = np.where(upright, *sides) / bands.longest[index]
    return span

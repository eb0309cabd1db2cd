"""Lettering: rows of small shapes of one height, as no walls stand."""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from occsim._types import ByteArray, IntArray
from occsim.walls.groups import FULL
from occsim.walls.raster import Components, components, flipped

LETTER_PX = 6
"""Least height of a letter, px of the sheet: what is smaller is thinner than a wall."""

LARGEST = 1 / 8
"""Greatest height of a letter, share of the sheet's shorter side."""

WIDEST = 2.5
"""Width of the widest letter, or of two that touch, in its height."""

ALIKE = 0.7
"""Height of one letter over that of the next: capitals, digits and small letters."""

GAP = 0.7
"""Widest gap between letters, in their height."""

WORD = 3
"""Fewest letters of a word."""

LEVEL = 0.35
"""Farthest that the feet or the middles of two letters are from a line, in heights."""


def lettering(ink: ByteArray) -> ByteArray:
    """Return the ink that is lettering along rows or along columns."""
    return _rows(ink) | flipped(_rows(flipped(ink)))


def _rows(ink: ByteArray) -> ByteArray:
    """Return the words along rows; a row of piers is none."""
    groups = components(ink)
    height, width = groups.height, groups.width
    letters = np.flatnonzero(
        (height >= LETTER_PX)
        & (height <= LARGEST * min(ink.shape))
        & (width <= WIDEST * height)
    )
    if len(letters) < WORD:
        return np.zeros_like(ink)
    one, other = _beside(groups, letters)
    n = len(letters)
    _, word = connected_components(coo_array((np.ones(len(one)), (one, other)), (n, n)))
    size = np.bincount(word)
    box = (groups.width * groups.height)[letters]
    full = groups.area[letters] >= FULL * box
    piers = np.bincount(word, weights=full)
    which = np.zeros(len(groups.area), bool)
    which[letters] = ((size >= WORD) & (2 * piers < size))[word]
    return groups.chosen(which)


def _beside(groups: Components, letters: IntArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of letters that stand beside each other on a line."""
    left, top, width, height = (
        side[letters].astype(np.float64)
        for side in (groups.left, groups.top, groups.width, groups.height)
    )
    place = np.stack([left + width / 2, top + height / 2], axis=1)
    pairs: list[IntArray] = []
    low = float(LETTER_PX)
    while low <= height.max():
        these = np.flatnonzero((height >= low) & (height <= 2 * low))
        tree = cKDTree(place[these])
        near = tree.query_pairs((WIDEST + GAP) * low, output_type="ndarray")
        pairs.append(these[near])
        low *= np.sqrt(2)
    one, other = np.concatenate(pairs).T
    taller = np.maximum(height[one], height[other])
    bottom = top + height
    level = np.minimum(
        np.abs(bottom[one] - bottom[other]), np.abs(place[one, 1] - place[other, 1])
    )
    gap = np.maximum(left[one], left[other]) - np.minimum(
        (left + width)[one], (left + width)[other]
    )
    fits = (
        (np.minimum(height[one], height[other]) >= ALIKE * taller)
        & (level <= LEVEL * taller)
        & (gap <= GAP * taller)
        & (gap > -0.3 * taller)
    )
    return one[fits], other[fits]

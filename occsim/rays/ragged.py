"""Whole numbers: lists of unequal length laid end to end, and rounding into bounds."""

import numpy as np

from occsim._types import FloatArray, IntArray


def ragged_ranges(first: IntArray, stop: IntArray) -> tuple[IntArray, IntArray]:
    """Return the whole numbers of many half-open ranges.

    Parameters
    ----------
    first, stop : ndarray of int64, shape (N,)
        Range n holds ``first[n]`` to ``stop[n] - 1``; none where stop <= first.

    Returns
    -------
    owner : ndarray of int64, shape (T,)
        Range n of each number, ascending.
    value : ndarray of int64, shape (T,)
        The number.
    """
    sizes = np.maximum(stop - first, 0)
    owner = np.arange(first.size).repeat(sizes)
    value = np.arange(owner.size)
    value += (first + sizes - sizes.cumsum())[owner]
    return owner, value


def whole_within(values: FloatArray, most: float | FloatArray) -> IntArray:
    """Return whole numbers, of any size, cut to 0 to `most` and as integers."""
    return np.minimum(np.maximum(values, 0.0), most).astype(np.int64)

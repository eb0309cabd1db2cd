"""The pixels that strokes cover.

They are defined exactly, so that whoever draws a stroke (this module, or a browser by
the same rule) finds the same ones:

* A pixel belongs to a brush stroke, a straight line or an eraser stroke if its *test
  point* lies within half the width of the line through the stroke's points, or if one
  of those points lies in it (so that the thinnest dot is not lost).
* It belongs to a rectangle if its test point lies in the rectangle, and to an outline
  if it lies within half the width of the rectangle's sides, with square corners.
* The test point is the pixel's centre moved by 1/64 px to the right and down: an edge
  along the pixels, on the lattice of quarters, never passes through one, so a line of
  width 2 covers two rows of pixels, not one or three.
"""

from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError
from occsim.strokes.stroke import BOXES, FILLED, Stroke

TEST_POINT = 0.5 + 1 / 64
"""Where in a pixel it is asked whether a stroke covers it."""

SEGMENTS_AT_ONCE = 256
"""Bounds the memory of one step: rows of this many segments are held together."""


def apply_strokes(
    mask: npt.NDArray[np.generic], strokes: Iterable[Stroke]
) -> BoolArray:
    """Return the mask with the strokes applied, in their order.

    Parameters
    ----------
    mask : ndarray of bool, shape (H, W)
        True on wall pixels; not written to.
    strokes : iterable of Stroke
        Parts outside the image have no effect.

    Returns
    -------
    ndarray of bool, shape (H, W)

    Raises
    ------
    ParameterError
        Where the mask is not two-dimensional.
    """
    if mask.ndim != 2:
        raise ParameterError(f"mask must have shape (H, W); got {mask.shape}")
    out = np.array(mask, dtype=bool, order="C")
    for stroke in strokes:
        if stroke.kind in BOXES:
            for box in _boxes(stroke):
                out[_slices(box)] = not stroke.erases
        else:
            flat = out.reshape(-1)
            for pixels in _covered_pixels(stroke, mask.shape):
                flat[pixels] = not stroke.erases
    return out


def _boxes(stroke: Stroke) -> list[tuple[float, float, float, float]]:
    """Return x0, y0, x1, y1 of the boxes that make up a rectangle or an outline."""
    (xa, ya), (xb, yb) = stroke.points
    x0, x1, y0, y1 = min(xa, xb), max(xa, xb), min(ya, yb), max(ya, yb)
    if stroke.kind in FILLED:
        return [(x0, y0, x1, y1)]
    r = stroke.width_px / 2
    return [
        (x0 - r, y0 - r, x1 + r, y0 + r),
        (x0 - r, y1 - r, x1 + r, y1 + r),
        (x0 - r, y0 - r, x0 + r, y1 + r),
        (x1 - r, y0 - r, x1 + r, y1 + r),
    ]


def _slices(box: tuple[float, float, float, float]) -> tuple[slice, slice]:
    """Return the rows and columns whose test points lie in a box."""
    x0, y0, x1, y1 = (max(0, int(np.ceil(edge - TEST_POINT))) for edge in box)
    return slice(y0, y1), slice(x0, x1)


def _covered_pixels(stroke: Stroke, shape: tuple[int, ...]) -> Iterator[IntArray]:
    """Yield flat indices of the pixels that a line of some width covers."""
    points = np.array(stroke.points, dtype=np.float64)
    yield _expanded(*_pixels_of_points(points, shape))
    starts, ends = (points[:-1], points[1:]) if len(points) > 1 else (points, points)
    for k in range(0, len(starts), SEGMENTS_AT_ONCE):
        chunk = slice(k, k + SEGMENTS_AT_ONCE)
        yield _expanded(
            *_capsule_runs(starts[chunk], ends[chunk], stroke.width_px / 2, shape)
        )


def _pixels_of_points(
    points: FloatArray, shape: tuple[int, ...]
) -> tuple[IntArray, IntArray]:
    """Return runs of one pixel each: the pixels that hold the points."""
    cols, rows = np.floor(points).astype(np.int64).T
    inside = (rows >= 0) & (rows < shape[0]) & (cols >= 0) & (cols < shape[1])
    first = (rows * shape[1] + cols)[inside]
    return first, first + 1


def _capsule_runs(
    a: FloatArray, b: FloatArray, radius_px: float, shape: tuple[int, ...]
) -> tuple[IntArray, IntArray]:
    """Return the runs of pixels within a radius of any of some segments.

    A capsule is convex: it meets each row of test points in one interval.

    Parameters
    ----------
    a, b : ndarray of shape (N, 2)
        Ends of the segments, x and y, px.
    radius_px : float
        Half the width.
    shape : tuple of int
        Height and width of the image.

    Returns
    -------
    first, last : ndarray of int64, shape (M,)
        Flat indices; the run is half-open. Runs may overlap.
    """
    height, width = shape
    low = np.minimum(a[:, 1], b[:, 1]) - radius_px - TEST_POINT
    high = np.maximum(a[:, 1], b[:, 1]) + radius_px - TEST_POINT
    row0 = np.clip(np.ceil(low), 0, height).astype(np.int64)
    row1 = np.clip(np.floor(high) + 1, 0, height).astype(np.int64)
    n_rows = np.maximum(row1 - row0, 0)
    segment = np.repeat(np.arange(len(a)), n_rows)
    row = np.arange(n_rows.sum()) - np.repeat(np.cumsum(n_rows) - n_rows - row0, n_rows)
    left, right = _row_interval(
        (b - a)[segment], row + TEST_POINT - a[segment, 1], radius_px
    )
    x = a[segment, 0] - TEST_POINT
    # The ends of an empty interval are infinite; clipping makes it an empty run.
    col0 = np.clip(np.ceil(x + left), 0, width).astype(np.int64)
    col1 = np.clip(np.floor(x + right) + 1, 0, width).astype(np.int64)
    some = col1 > col0
    start = row[some] * width
    return start + col0[some], start + col1[some]


def _row_interval(
    d: FloatArray, y: FloatArray, radius_px: float
) -> tuple[FloatArray, FloatArray]:
    """Return where rows cross capsules, in x from the segment's first end.

    Parameters
    ----------
    d : ndarray of shape (M, 2)
        From the first end of the segment to the second, px.
    y : ndarray of shape (M,)
        Height of the row above the first end, px.
    radius_px : float
        Half the width.

    Returns
    -------
    left, right : ndarray of shape (M,)
        ``inf`` and ``-inf`` where the row misses the capsule.
    """
    dx, dy = d.T
    squared = dx * dx + dy * dy
    reach = radius_px * np.sqrt(squared)
    # The straight part: between the two ends, and within the radius of the axis.
    between = _solved(dx, -y * dy, squared - y * dy)
    beside = _solved(dy, y * dx - reach, y * dx + reach)
    left = np.maximum(between[0], beside[0])
    right = np.minimum(between[1], beside[1])
    missed = (left > right) | (squared == 0)
    left, right = np.where(missed, np.inf, left), np.where(missed, -np.inf, right)
    for shift, height in ((0.0, y), (dx, y - dy)):
        half = radius_px * radius_px - height * height
        root = np.sqrt(np.maximum(half, 0.0))
        left = np.minimum(left, np.where(half >= 0, shift - root, np.inf))
        right = np.maximum(right, np.where(half >= 0, shift + root, -np.inf))
    return left, right


def _solved(
    factor: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the interval of x with ``low <= factor * x <= high``."""
    flat = factor == 0
    divisor = np.where(flat, 1.0, factor)
    p, q = low / divisor, high / divisor
    never = (low > 0) | (high < 0)
    left = np.where(flat, np.where(never, np.inf, -np.inf), np.minimum(p, q))
    right = np.where(flat, np.where(never, -np.inf, np.inf), np.maximum(p, q))
    return left, right


def _expanded(first: IntArray, last: IntArray) -> IntArray:
    """Return every index in the union of half-open runs, once."""
    order = np.argsort(first)
    first, reached = first[order], np.maximum.accumulate(last[order])
    # What an earlier run holds already is cut off, so the runs become disjoint.
    first = np.maximum(first, np.concatenate(([0], reached[:-1])))
    length = np.maximum(reached - first, 0)
    before = np.cumsum(length) - length
    return np.repeat(first - before, length) + np.arange(length.sum())

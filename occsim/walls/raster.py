"""Small operations on binary pictures: uint8, one where the thing is, else zero."""

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray


def as_bytes(mask: BoolArray | ByteArray) -> ByteArray:
    """Return a mask as contiguous uint8 of zeros and ones (OpenCV refuses bool)."""
    return np.ascontiguousarray(mask, dtype=np.uint8)


def box(width_px: float, height_px: float | None = None) -> ByteArray:
    """Return a rectangular kernel, at least one pixel each way."""
    height_px = width_px if height_px is None else height_px
    return np.ones((max(round(height_px), 1), max(round(width_px), 1)), np.uint8)


def opened(mask: ByteArray, kernel: ByteArray) -> ByteArray:
    """Return the pixels that a kernel inside the mask can cover.

    The border counts as more of the same, so that walls may run off the sheet.
    """
    there, back = _anchors(kernel)
    shrunk = cv2.erode(mask, kernel, anchor=there)
    return _bytes(cv2.dilate(shrunk, kernel, anchor=back))


def closed(mask: ByteArray, kernel: ByteArray) -> ByteArray:
    """Return the mask with what the kernel cannot enter filled in."""
    there, back = _anchors(kernel)
    grown = cv2.dilate(mask, kernel, anchor=there)
    return _bytes(cv2.erode(grown, kernel, anchor=back))


def _anchors(kernel: ByteArray) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return anchors for the two steps; even kernels would shift the picture."""
    height, width = kernel.shape
    there = width // 2, height // 2
    return there, (width - 1 - there[0], height - 1 - there[1])


def dilated(mask: ByteArray, kernel: ByteArray) -> ByteArray:
    """Return the pixels that the kernel, moved over the mask, covers."""
    return _bytes(cv2.dilate(mask, kernel))


def _bytes(image: object) -> ByteArray:
    return np.asarray(image, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Components:
    """Connected components of a mask; number 0 is what lies outside the mask.

    Everything is counted over the mask's own pixels, of which drawings have few.

    Parameters
    ----------
    labels : ndarray of int32, shape (H, W)
        Number of the component of each pixel.
    places : ndarray of int64, shape (P,)
        Flat places of the mask's pixels, ascending.
    numbers : ndarray of int32, shape (P,)
        Component of each of these pixels.
    count : int
        Number of components N, with what lies outside the mask.
    """

    labels: IntArray
    places: IntArray
    numbers: IntArray
    count: int

    @cached_property
    def area(self) -> IntArray:
        """Pixels of each component, shape (N,); 1 for number 0, never divided by 0."""
        area = np.bincount(self.numbers, minlength=self.count)
        area[0] = 1
        return np.asarray(area, dtype=np.int64)

    @cached_property
    def boxes(self) -> IntArray:
        """Left, top, width and height of each component, px, shape (4, N)."""
        boxes = np.zeros((4, self.count), dtype=np.int64)
        if self.count > 1:
            order = np.argsort(self.numbers, kind="stable")
            rows, cols = np.divmod(self.places[order], self.labels.shape[1])
            first = np.concatenate([[0], np.cumsum(self.area[1:-1])])
            left, top = (np.minimum.reduceat(at, first) for at in (cols, rows))
            right, bottom = (np.maximum.reduceat(at, first) for at in (cols, rows))
            boxes[:, 1:] = left, top, right - left + 1, bottom - top + 1
        return boxes

    @property
    def left(self) -> IntArray:
        """First column of each component."""
        side: IntArray = self.boxes[0]
        return side

    @property
    def top(self) -> IntArray:
        """First row of each component."""
        side: IntArray = self.boxes[1]
        return side

    @property
    def width(self) -> IntArray:
        """Number of columns from each component's first to its last."""
        side: IntArray = self.boxes[2]
        return side

    @property
    def height(self) -> IntArray:
        """Number of rows from each component's first to its last."""
        side: IntArray = self.boxes[3]
        return side

    @property
    def longest(self) -> IntArray:
        """Longer side of each bounding box, px."""
        return np.maximum(self.width, self.height)

    def total(self, image: ByteArray | FloatArray) -> FloatArray:
        """Return the sum of an image over each component, shape (N,)."""
        sums = np.bincount(self.numbers, image.ravel()[self.places], self.count)
        return np.asarray(sums, dtype=np.float64)

    def chosen(self, which: BoolArray) -> ByteArray:
        """Return the mask of the components for which `which` is true."""
        mask = np.zeros(self.labels.shape, dtype=np.uint8)
        mask.ravel()[self.places] = which[self.numbers]
        return mask


def components(mask: ByteArray, connectivity: int = 8) -> Components:
    """Return the connected components of a mask."""
    count, labels = cv2.connectedComponents(mask, connectivity=connectivity)
    places = np.flatnonzero(mask.view(bool))
    numbered: IntArray = np.asarray(labels)  # int32, as OpenCV counts
    return Components(numbered, places, numbered.ravel()[places], count)


def depth(mask: ByteArray) -> FloatArray:
    """Return the distance of each pixel of a mask to the nearest one outside it, px.

    The border of the picture counts as more of the same.
    """
    padded = cv2.copyMakeBorder(mask, 1, 1, 1, 1, cv2.BORDER_REPLICATE)
    distance = cv2.distanceTransform(padded, cv2.DIST_L2, 5)
    return np.asarray(distance[1:-1, 1:-1], dtype=np.float64)


def narrow_places(free: ByteArray, gap_px: float) -> tuple[ByteArray, FloatArray]:
    """Return the free pixels that no disc wider than a gap can cover.

    Parameters
    ----------
    free : ndarray of uint8, shape (H, W)
        Free pixels.
    gap_px : float
        Diameter of the widest disc that does not count, px.

    Returns
    -------
    narrow : ndarray of uint8, shape (H, W)
        Free pixels in places at most `gap_px` wide.
    depth_px : ndarray of float, shape (H, W)
        Distance to the nearest pixel that is not free.
    """
    depth_px = depth(free)
    # In the middle of a gap of n pixels the depth is (n + 1) / 2.
    reach = (gap_px + 1) / 2 + 0.5
    core = as_bytes(depth_px < reach)
    return free & as_bytes(depth(core) >= reach), depth_px

"""Small operations on binary pictures: uint8, one where the thing is, else zero."""

from dataclasses import dataclass

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

    Parameters
    ----------
    labels : ndarray of int32, shape (H, W)
        Number of the component of each pixel.
    left, top, width, height, area : ndarray of int64, shape (N,)
        Bounding boxes and pixels of each, px; 0 for number 0.
    """

    labels: IntArray
    left: IntArray
    top: IntArray
    width: IntArray
    height: IntArray
    area: IntArray

    @property
    def longest(self) -> IntArray:
        """Longer side of each bounding box, px."""
        return np.maximum(self.width, self.height)

    def total(self, mask: ByteArray) -> FloatArray:
        """Return how many pixels of a mask each component has, shape (N,)."""
        at = self.labels[mask.view(bool)]
        return np.bincount(at, minlength=len(self.area)).astype(np.float64)

    def chosen(self, which: BoolArray) -> ByteArray:
        """Return the mask of the components for which `which` is true."""
        chosen = which.astype(np.uint8)
        chosen[0] = 0
        return _bytes(chosen[self.labels])


def components(mask: ByteArray, connectivity: int = 8) -> Components:
    """Return the connected components of a mask."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(
        mask, connectivity=connectivity
    )
    sides = stats.astype(np.int64)
    sides[0] = 0
    return Components(np.asarray(labels), *sides.T)


def flipped(mask: ByteArray) -> ByteArray:
    """Return a mask with rows and columns exchanged."""
    return np.ascontiguousarray(mask.T)


def filled(
    shape: tuple[int, ...], top: IntArray, bottom: IntArray, column: IntArray
) -> ByteArray:
    """Return a mask of the given spans down its columns."""
    mask = np.zeros(shape, dtype=np.uint8)
    count = bottom - top
    step = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    mask[np.repeat(top, count) + step, np.repeat(column, count)] = 1
    return mask

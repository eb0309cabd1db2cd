"""How far a wall mask agrees with the ground truth."""

from dataclasses import dataclass
from enum import IntEnum

import cv2
import numpy as np

from occsim._types import BoolArray, ByteArray
from occsim.errors import ParameterError

MAX_TOLERANCE_PX = 50
"""Largest tolerance, px; beyond it agreement means nothing."""


class MaskError(IntEnum):
    """Class of a pixel in the error picture."""

    FREE = 0
    HIT = 1
    FALSE_WALL = 2
    MISSED_WALL = 3


@dataclass(frozen=True, eq=False)
class MaskComparison:
    """A wall mask beside the ground truth, with a tolerance.

    A pixel of the mask is right if a true wall pixel lies within the tolerance; a true
    wall pixel is found if a pixel of the mask does.

    Parameters
    ----------
    errors : ndarray of uint8, shape (H, W)
        One `MaskError` a pixel: hit, false wall (not right), missed wall (not found).
    n_right, n_false, n_found, n_missed : int
        Pixels of the mask that are right and not, true ones that are found and not.
    """

    errors: ByteArray
    n_right: int
    n_false: int
    n_found: int
    n_missed: int

    @property
    def precision(self) -> float:
        """Share of the mask that is right; NaN for an empty mask."""
        return _share(self.n_right, self.n_right + self.n_false)

    @property
    def recall(self) -> float:
        """Share of the true walls that are found; NaN where there are none."""
        return _share(self.n_found, self.n_found + self.n_missed)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall; NaN where either is undefined."""
        p, r = self.precision, self.recall
        return 0.0 if p == r == 0.0 else 2 * p * r / (p + r)

    @property
    def iou(self) -> float:
        """Intersection over union that goes with `f1`: F1 / (2 - F1)."""
        return self.f1 / (2 - self.f1)


def compare_masks(
    mask: BoolArray, truth: BoolArray, tolerance_px: int = 2
) -> MaskComparison:
    """Compare a wall mask with the ground truth.

    Parameters
    ----------
    mask, truth : ndarray of bool, shape (H, W)
        Wall pixels.
    tolerance_px : int, default 2
        Distance between pixel centres that still counts as agreement, px, in [0, 50].

    Returns
    -------
    MaskComparison

    Raises
    ------
    ParameterError
        Where shapes differ or the tolerance lies outside its domain.
    """
    found = np.asarray(mask, dtype=bool)
    true = np.asarray(truth, dtype=bool)
    if found.shape != true.shape or found.ndim != 2:
        raise ParameterError(
            "mask and truth must have one shape (H, W); "
            f"got {found.shape} and {true.shape}"
        )
    if not 0 <= tolerance_px <= MAX_TOLERANCE_PX:
        raise ParameterError(
            f"tolerance_px must lie in [0, {MAX_TOLERANCE_PX}]; got {tolerance_px!r}"
        )
    right = found & _dilated(true, int(tolerance_px))
    missed = true & ~_dilated(found, int(tolerance_px))
    false = found & ~right
    errors = np.full(true.shape, MaskError.FREE, dtype=np.uint8)
    errors[found | true] = MaskError.HIT
    errors[false] = MaskError.FALSE_WALL
    errors[missed] = MaskError.MISSED_WALL
    return MaskComparison(
        errors=errors,
        n_right=int(right.sum()),
        n_false=int(false.sum()),
        n_found=int(true.sum() - missed.sum()),
        n_missed=int(missed.sum()),
    )


def _dilated(mask: BoolArray, radius_px: int) -> BoolArray:
    """Return the pixels within a Euclidean distance of the mask's pixels."""
    steps = np.arange(-radius_px, radius_px + 1)
    disc = (steps[:, None] ** 2 + steps**2 <= radius_px**2).astype(np.uint8)
    return cv2.dilate(mask.astype(np.uint8), disc) > 0


def _share(part: int, whole: int) -> float:
    return part / whole if whole else float("nan")

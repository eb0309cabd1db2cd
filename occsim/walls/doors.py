"""Door leaves, and the doorways that they close."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, IntArray
from occsim.walls.arcs import Swing
from occsim.walls.measures import Measures
from occsim.walls.raster import box, opened

SNAP_QUARTERS = 0.25
"""How close to a multiple of a right angle a leaf's bearing is taken for one."""

DOOR_REACH = 1.6
"""Widest doorway, in usual leaves: two leaves, or a leaf and its frame."""

DOOR_SHARE = 0.15
"""Widest doorway where no leaf is found, as a share of the shorter side."""

LEAF_COVER = 0.8
"""Share of a leaf's length along which there must be ink."""


@dataclass(frozen=True, eq=False)
class Doors:
    """Doors of a drawing.

    Parameters
    ----------
    leaves, openings : ndarray of uint8, shape (h, w)
        Where leaves stand open, and where they would stand shut.
    reach_px : float
        Widest doorway, px.
    """

    leaves: ByteArray
    openings: ByteArray
    reach_px: float


def find_doors(swings: tuple[Swing, ...], ink: ByteArray, m: Measures) -> Doors:
    """Return the doors that swings belong to.

    Of an arc's two ends, the leaf stands at the one that ink joins to the hinge; the
    opening lies towards the other.

    Parameters
    ----------
    swings : tuple of Swing
        Swings found among the strokes.
    ink : ndarray of uint8, shape (h, w)
        Ink.
    m : Measures
        Lengths of the drawing.
    """
    leaves, openings = np.zeros_like(ink), np.zeros_like(ink)
    for swing in swings:
        ends = [_snapped(b) for b in (swing.start_rad, swing.end_rad)]
        thick = 0.1 * swing.radius_px + m.line
        slack = max(1.5 * m.line, 0.04 * swing.radius_px)
        # A leaf's thickness lies on the side of the opening that it closes.
        bands = [
            _band(ink.shape, swing, ends[0], (0.06, 1.06), (-slack, thick)),
            _band(ink.shape, swing, ends[1], (0.06, 1.06), (-thick, slack)),
        ]
        cover = [_cover(ink, band) for band in bands]
        best = int(np.argmax(cover))
        if cover[best] < LEAF_COVER:
            continue
        bands[best].mark(leaves)
        wide = (-2 * thick, 2 * thick)
        _band(ink.shape, swing, ends[1 - best], (0.1, 0.9), wide).mark(openings)
    # A leaf shut against a wall must not take the wall along.
    leaves &= ~opened(ink, box(1.5 * m.thin))
    radii = [swing.radius_px for swing in swings]
    reach = DOOR_REACH * float(np.median(radii)) if radii else DOOR_SHARE * m.extent
    return Doors(leaves, openings, reach)


def _snapped(bearing: float) -> float:
    """Return the bearing, or the right angle that it lies close to."""
    quarters = bearing / (np.pi / 2)
    whole = float(np.round(quarters))
    return whole * np.pi / 2 if abs(quarters - whole) < SNAP_QUARTERS else bearing


@dataclass(frozen=True, eq=False)
class _Band:
    """Pixels of a band along a radius: rows from the hinge on, columns across it."""

    rows: IntArray
    cols: IntArray
    inside: BoolArray

    def mark(self, mask: ByteArray) -> None:
        """Set the band's pixels in a mask that the caller has just made."""
        mask[self.rows[self.inside], self.cols[self.inside]] = 1


def _band(
    shape: tuple[int, ...],
    swing: Swing,
    bearing: float,
    reach: tuple[float, float],
    side_px: tuple[float, float],
) -> _Band:
    """Return a band along a radius: from and to as shares of it, and to its sides.

    Sides are positive towards growing bearings.
    """
    along = np.arange(reach[0] * swing.radius_px, reach[1] * swing.radius_px, 0.5)
    across = np.arange(side_px[0], side_px[1] + 0.5, 0.5)
    cos, sin = np.cos(bearing), np.sin(bearing)
    x = swing.x_px + along[:, None] * cos - across * sin
    y = swing.y_px + along[:, None] * sin + across * cos
    rows, cols = np.rint(y).astype(np.int64), np.rint(x).astype(np.int64)
    inside = (rows >= 0) & (rows < shape[0]) & (cols >= 0) & (cols < shape[1])
    rows, cols = np.clip(rows, 0, shape[0] - 1), np.clip(cols, 0, shape[1] - 1)
    return _Band(rows, cols, inside)


def _cover(ink: ByteArray, band: _Band) -> float:
    """Return the share of a band's length in which there is ink."""
    on_ink = (ink[band.rows, band.cols] > 0) & band.inside
    hit = np.any(on_ink, axis=1)
    clear_of_wall = slice(len(hit) // 6, -(len(hit) // 12) or None)
    return float(np.mean(hit[clear_of_wall]))

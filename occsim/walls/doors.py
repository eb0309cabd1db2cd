"""Door leaves, and the doorways that they close."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.arcs import Swing
from occsim.walls.measures import Measures
from occsim.walls.raster import box, opened

SNAP_QUARTERS = 0.25
"""How close to a multiple of a right angle a leaf's bearing is taken for one."""

DOOR_REACH = 1.6
"""Widest doorway, in usual leaves: two leaves, or a leaf and its frame."""

DOOR_SHARE = 0.15
"""Widest doorway where no leaf is found, as a share of the shorter side."""

LEAF_SHARE = 0.1
"""Thickness of a leaf as drawn, as a share of its length; what is thicker is wall."""

LEAF_COVER = 0.8
"""Share of a leaf's length along which there must be ink."""


@dataclass(frozen=True, eq=False)
class Doors:
    """Doors of a drawing.

    Parameters
    ----------
    leaves, openings, swings : ndarray of uint8, shape (h, w)
        Where leaves stand open, where they would stand shut, and the arcs between.
    reach_px : float
        Widest doorway, px.
    """

    leaves: ByteArray
    openings: ByteArray
    swings: ByteArray
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
    leaves, openings, arcs = (np.zeros_like(ink) for _ in range(3))
    for swing in swings:
        _mark_arc(arcs, swing, 1.5 * m.line)
        ends = [_snapped(b) for b in (swing.start_rad, swing.end_rad)]
        thick = LEAF_SHARE * swing.radius_px + m.line
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
    if not swings:
        return Doors(leaves, openings, arcs, DOOR_SHARE * m.extent)
    usual = float(np.median([swing.radius_px for swing in swings]))
    # A leaf shut against a wall must not take the wall along.
    leaves &= ~opened(ink, box(max(1.5 * m.thin, LEAF_SHARE * usual + m.line)))
    reach = DOOR_REACH * usual
    return Doors(leaves, openings, arcs, reach)


def _mark_arc(mask: ByteArray, swing: Swing, half_px: float) -> None:
    """Set the pixels along a swing in a mask that the caller has just made."""
    step = 0.5 / swing.radius_px
    slack = 4 * half_px / swing.radius_px  # the ends that were left out of the fit
    bearing = np.arange(swing.start_rad - slack, swing.end_rad + slack, step)
    radius = swing.radius_px + np.arange(-half_px, half_px + 0.5, 0.5)[:, None]
    x = swing.x_px + radius * np.cos(bearing)
    y = swing.y_px + radius * np.sin(bearing)
    _on_sheet(mask.shape, x, y).mark(mask)


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
    return _on_sheet(shape, x, y)


def _on_sheet(shape: tuple[int, ...], x: FloatArray, y: FloatArray) -> _Band:
    """Return the pixels of points, and which of them lie on the sheet."""
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

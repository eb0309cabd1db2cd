"""Hollow walls: long gaps between two parallel lines; and windows."""

from dataclasses import dataclass

import numpy as np

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.walls.gaps import Gaps
from occsim.walls.measures import Measures
from occsim.walls.params import WallParams

USUAL_SHARE = 0.08
"""Share of all votes from which a width of gap is one that the drawing uses."""

STACK = 4
"""Gaps side by side from which they are treads, ribs or tiles; a window has three."""

TREAD_SLENDERNESS = 1.2
"""Length over width from which a gap may be a tread, or the half of one."""

SEED_SLENDERNESS = 8.0
"""Length over width from which a gap is a wall's by itself."""

STEADY = 0.85
"""Share of a gap's area that must be of one width; letters and leaves are not."""

STRAIGHT = 0.8
"""Least straightness of a short gap that goes on from a wall."""

BESIDE_SHARE = 0.35
"""Share of a gap's length beside a wall from which it is furniture along the wall."""

ENCLOSED = 0.8
"""Share of a gap's boundary that walls must hold for it to lie inside one."""


@dataclass(frozen=True, kw_only=True, slots=True)
class GapLimits:
    """What gaps may be a hollow wall's or a window's.

    Parameters
    ----------
    low_px, high_px : float
        Clear width of hollow walls, px; none where low exceeds high.
    window_px : float
        Widest gap of a window, px.
    slenderness : float
        Least length over width.
    seed_px : float
        Least length of a gap that is a wall's by itself, px.
    """

    low_px: float
    high_px: float
    window_px: float
    slenderness: float
    seed_px: float

    @property
    def hollow(self) -> bool:
        """Whether the drawing has hollow walls."""
        return self.low_px <= self.high_px

    @property
    def widest_px(self) -> float:
        """Widest gap to look for, px; where walls meet, gaps are wider."""
        return max(1.3 * self.high_px, self.window_px, 1.0)


def gap_limits(
    gap_votes: FloatArray, area_votes: FloatArray, params: WallParams, m: Measures
) -> GapLimits:
    """Return the limits for a drawing.

    Parameters
    ----------
    gap_votes, area_votes : ndarray of float64
        How much of hollow walls and of solid ones there is, by thickness in px.
    params : WallParams
        Settings.
    m : Measures
        Lengths of the drawing.
    """
    usual = _usual(gap_votes)
    common = _usual(area_votes)
    low, high = (0.6 * usual.min(), usual.max() + 1.5) if len(usual) else (1.0, 0.0)
    if params.max_gap_px:
        low, high = min(low, 1.0 * m.line), m.scale * params.max_gap_px
    return GapLimits(
        low_px=float(low),
        high_px=float(high),
        window_px=float(max(high - 1.5, common.max() if len(common) else 0.0)),
        slenderness=params.min_slenderness,
        seed_px=m.seed,
    )


def _usual(votes: FloatArray) -> IntArray:
    """Return the thicknesses that hold, with their neighbours, many of the votes."""
    padded = np.pad(votes, 1)
    near = padded[:-2] + padded[1:-1] + padded[2:]
    common = (near > USUAL_SHARE * votes.sum()) & (votes > near / 4)
    return np.flatnonzero(common)


def hollow_walls(gaps: Gaps, doorways: ByteArray, limits: GapLimits) -> BoolArray:
    """Return which gaps belong to hollow walls or windows, shape (N,).

    Parameters
    ----------
    gaps : Gaps
        Narrow places between ink.
    doorways : ndarray of uint8, shape (h, w)
        Openings that door leaves close; they stay open.
    limits : GapLimits
        What gaps to take.
    """
    slender, stack = _candidates(gaps, doorways, limits)
    wall_like = slender & (gaps.width >= limits.low_px) & (gaps.width <= limits.high_px)
    seeds = wall_like & (gaps.slenderness >= SEED_SLENDERNESS)
    walls = _longest_first(gaps, seeds & (gaps.length >= limits.seed_px))
    walls = slender & np.isin(stack, stack[walls])
    straight = (gaps.straightness > STRAIGHT) & (gaps.straightness < 1 / STRAIGHT)
    walls = _grown(gaps, walls, wall_like & straight, 0.5)
    # A window's gaps are narrower than the wall's: side by side, or from wall to wall.
    panes = slender & straight & (gaps.width <= limits.window_px)
    side_by_side = np.bincount(stack)[stack] > 1
    walls = _grown(gaps, walls, panes & side_by_side, 0.5)
    walls = _grown(gaps, walls, panes, 1.4)
    return _filled(gaps, walls, limits.slenderness)


def _candidates(
    gaps: Gaps, doorways: ByteArray, limits: GapLimits
) -> tuple[BoolArray, IntArray]:
    """Which gaps are shaped like a wall's, and the number of each gap's stack."""
    shaped = (gaps.steady >= STEADY) & (gaps.slenderness >= TREAD_SLENDERNESS)
    # Open at its ends at most, or at a few of a network's.
    shaped &= gaps.ajar <= np.maximum(3 * gaps.width + 2, 0.1 * gaps.length)
    shaped[0] = False
    stack = gaps.stacks(shaped)
    treads = shaped & (np.bincount(stack)[stack] >= STACK)
    slender = shaped & ~treads & (gaps.slenderness >= limits.slenderness)
    slender &= gaps.mass <= 2 * BESIDE_SHARE * gaps.length
    slender &= gaps.parts.total(doorways) < 0.5 * gaps.parts.area
    return slender, stack


def _longest_first(gaps: Gaps, seeds: BoolArray) -> BoolArray:
    """Accept gaps from the longest on, but none along one already accepted."""
    walls = np.zeros_like(seeds)
    order = np.flatnonzero(seeds)
    for index in order[np.argsort(-gaps.length[order], kind="stable")]:
        others, shared = gaps.neighbours(index)
        beside = shared[walls[others]].sum()
        walls[index] = beside <= BESIDE_SHARE * gaps.length[index]
    return walls


def _grown(gaps: Gaps, walls: BoolArray, likely: BoolArray, least: float) -> BoolArray:
    """Add gaps that touch walls end-on, over at least `least` of their width."""
    for _ in range(20):
        touch = gaps.shared(walls) + gaps.mass
        end_on = (touch >= least * gaps.width) & (touch <= 3 * gaps.width + 2)
        more = likely & end_on & ~walls & (touch <= 0.7 * gaps.length)
        if not more.any():
            break
        walls = walls | more
    return walls


def _filled(gaps: Gaps, walls: BoolArray, slender: float) -> BoolArray:
    """Add short bits of gap that lie inside walls."""
    held = gaps.shared(walls) + gaps.mass
    inside = (held >= ENCLOSED * gaps.boundary) & (gaps.slenderness < slender)
    inside[0] = False
    return walls | inside

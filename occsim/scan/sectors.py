"""The sectors that beams stand for, and the outlines that their ranges give."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.grid import Grid
from occsim.rays.outline import SLIVER_RAD, cardinal_cuts, run_ends, unit_vectors
from occsim.rays.reach import REACH_MAX_PX, View
from occsim.rays.scan import (
    OWN_RADIUS_PX,
    Polygons,
    Windows,
    closed_polygons,
    windows_between,
)
from occsim.sensor import EDGE_EPS, SURFACE_DEPTH_PX, BehindHit, Sensor

WRAP_SLACK = 1.01
"""A gap between the last beam and the first that is at most this many times the usual
one is closed: bearings in single precision miss a full turn by a little."""


@dataclass(frozen=True, eq=False)
class Sectors:
    """The sector of each beam, from half-way to one neighbour to half-way to the other.

    A sector at the edge of a scan reaches as far outwards as inwards; beams that go all
    round have no edge. A pixel centre half-way between two beams, within EDGE_EPS,
    belongs to the clockwise one; the edges belong to the scan.

    Parameters
    ----------
    order : ndarray of int64, shape (B,)
        The beams by ascending bearing.
    middle : float
        Bearing half-way between the two edges, rad.
    half : float
        From there to either edge, rad, at most pi.
    bounds : ndarray of float64, shape (B + 1,)
        Where the sectors begin, in that order, and the last one ends, relative to the
        middle, rad.
    """

    order: IntArray
    middle: float
    half: float
    bounds: FloatArray

    @classmethod
    def of(cls, bearings_rad: FloatArray, fov_rad: float) -> Self:
        """Return the sectors of beams; one beam alone stands for `fov_rad`."""
        order = bearings_rad.argsort()
        bearing = bearings_rad[order]
        between = 0.5 * (bearing[1:] + bearing[:-1])
        first, last = 0.5 * fov_rad, 0.5 * fov_rad
        if bearing.size > 1:
            first, last = between[0] - bearing[0], bearing[-1] - between[-1]
        begin, end = bearing[0] - first, bearing[-1] + last
        gap = bearing[0] + 2.0 * np.pi - bearing[-1]
        if gap <= (first + last) * WRAP_SLACK:
            begin = 0.5 * (bearing[-1] - 2.0 * np.pi + bearing[0])
            end = begin + 2.0 * np.pi
        middle = 0.5 * (begin + end)
        half = min(0.5 * (end - begin) + EDGE_EPS, np.pi)
        is_full = half == np.pi
        # Half-way bearings move by the tolerance, so that they belong to one sector.
        # All round, so does the seam, and the two ends of it stay one bearing.
        middle -= EDGE_EPS * is_full
        inner = between - EDGE_EPS - middle
        return cls(order, middle, half, np.array([-half, *inner, half]))


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces of bearing, each within one sector and one quadrant.

    Parameters
    ----------
    reading : ndarray of int64, shape (P,)
        Scan of the batch, ascending; within one, bearings ascend without a gap.
    beam : ndarray of int64, shape (P,)
        Beam of the piece, counted through all scans: 0 to N * B - 1.
    turns : ndarray of int64, shape (P,)
        Cardinal bearings passed since the first piece.
    start, end : ndarray of float64, shape (2, P)
        Unit vectors (x, y) of the bearings at which the piece starts and ends.
    """

    reading: IntArray
    beam: IntArray
    turns: IntArray
    start: FloatArray
    end: FloatArray


def scan_view(
    poses: FloatArray, sectors: Sectors, sensor: Sensor, max_range_px: float
) -> View:
    """Return the view of scans at poses of shape (N, 3).

    It looks along the middle of the sectors, as far as both the sensor's parameters
    and the range finder itself reach.
    """
    x, y, theta = np.ascontiguousarray(poses.T)
    reach = min(sensor.range_px, max_range_px, REACH_MAX_PX) + EDGE_EPS
    # Bearings are small beside no heading: what they add to 1e16 rad would be lost.
    return View(x, y, wrap_angle(theta) + sectors.middle, reach, sectors.half)


def cut_pieces(sectors: Sectors, view: View) -> Pieces:
    """Return the sectors of each scan, cut at the cardinal bearings.

    Parameters
    ----------
    sectors : Sectors
        Those of B beams.
    view : View
        N scans.

    Returns
    -------
    Pieces
    """
    n_bounds = sectors.bounds.size
    cuts = np.empty((view.size, n_bounds + 4))
    cuts[:, :n_bounds], cuts[:, n_bounds:] = sectors.bounds, cardinal_cuts(view).T
    order = cuts.argsort(axis=1, kind="stable")
    cuts = np.take_along_axis(cuts, order, axis=1)
    begins = (order < n_bounds).cumsum(axis=1)
    corner = unit_vectors(cuts, view.theta[:, None]).reshape(2, -1)
    reading, place = np.nonzero(cuts[:, 1:] - cuts[:, :-1] > SLIVER_RAD)
    cut = reading * (n_bounds + 4) + place
    begins = begins.ravel()[cut]
    return Pieces(
        reading=reading,
        beam=reading * (n_bounds - 1) + begins - 1,
        turns=place + 1 - begins,
        start=corner.take(cut, axis=1),
        end=corner.take(cut + 1, axis=1),
    )


def empty_radii(ranges_px: FloatArray, sensor: Sensor, view: View) -> FloatArray:
    """Return how far each sector is empty.

    Parameters
    ----------
    ranges_px : ndarray of float64, shape (N, B)
        Ranges of the beams; infinity is no return, NaN invalid.
    sensor : Sensor
        Whether beams without return clear.
    view : View
        N scans.

    Returns
    -------
    ndarray of float64, shape (N, B)
        px; OWN_RADIUS_PX where nothing is empty.
    """
    nothing = view.reach if sensor.clear_no_hit else OWN_RADIUS_PX
    # "At the location of the detected object" is object, also where rounding says not.
    hit = np.maximum(ranges_px - EDGE_EPS, OWN_RADIUS_PX)
    return _by_kind(ranges_px, view, hit, nothing)


def view_radii(ranges_px: FloatArray, sensor: Sensor, view: View) -> FloatArray:
    """Return how far anything is said of each sector.

    Parameters
    ----------
    ranges_px, sensor, view
        As in `empty_radii`.

    Returns
    -------
    ndarray of float64, shape (N, B)
        px; OWN_RADIUS_PX where nothing is said.
    """
    nothing = view.reach if sensor.clear_no_hit else OWN_RADIUS_PX
    hit = np.full_like(ranges_px, view.reach)
    if sensor.behind_hit is BehindHit.UNSEEN:
        surface = ranges_px + (SURFACE_DEPTH_PX + EDGE_EPS)
        hit = np.minimum(surface, view.reach)
    return _by_kind(ranges_px, view, hit, nothing)


def _by_kind(
    ranges_px: FloatArray, view: View, hit: FloatArray, nothing: float
) -> FloatArray:
    radii = np.where(ranges_px <= view.reach, hit, view.reach)
    radii[ranges_px == np.inf] = nothing
    radii[np.isnan(ranges_px)] = OWN_RADIUS_PX
    return radii


def polygons(pieces: Pieces, radii: FloatArray, view: View) -> Polygons:
    """Return the closed outlines of sectors that reach to the given radii.

    Parameters
    ----------
    pieces : Pieces
        Of N scans.
    radii : ndarray of float64, shape (N, B)
        Radius of each sector, by ascending bearing, px.
    view : View
        The scans.

    Returns
    -------
    Polygons
    """
    radius = radii.ravel()[pieces.beam]
    first, last = run_ends(_differs(pieces, radius))
    radius = radius[first]
    return closed_polygons(
        pieces.reading[first],
        pieces.start.take(first, axis=1) * radius,
        pieces.end.take(last, axis=1) * radius,
        radius > OWN_RADIUS_PX,
        radius,
        view,
    )


def windows_of(pieces: Pieces, radii: FloatArray, view: View, grid: Grid) -> Windows:
    """Return windows of cells that hold sectors that reach to the given radii.

    Parameters
    ----------
    pieces, radii, view
        As in `polygons`.
    grid : Grid
        All cells.

    Returns
    -------
    Windows
    """
    first, _ = run_ends(pieces.reading[1:] != pieces.reading[:-1])
    radius = radii.ravel()[pieces.beam]
    # Of an arc within a quadrant, the ends lie farthest along either axis.
    start, end = pieces.start * radius, pieces.end * radius
    robot = np.array([view.x, view.y])
    low, high = (
        robot + beyond(beyond.reduceat(beyond(start, end), first, axis=1), 0.0)
        for beyond in (np.minimum, np.maximum)
    )
    return windows_between(low, high, grid)


def _differs(pieces: Pieces, radius: FloatArray) -> BoolArray:
    """Return which pieces but the first cannot be joined to the one before."""
    differs = radius[1:] != radius[:-1]
    for key in (pieces.reading, pieces.turns):
        differs |= key[1:] != key[:-1]
    return np.asarray(differs)

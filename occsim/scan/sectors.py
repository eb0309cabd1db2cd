"""The sectors that beams stand for, and the outlines that their ranges give."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from occsim._types import FloatArray, IntArray
from occsim.geometry import wrap_angle
from occsim.rays.outline import SLIVER_RAD, cardinal_cuts, run_ends, unit_vectors
from occsim.rays.reach import REACH_MAX_PX, View
from occsim.rays.scan import (
    OWN_RADIUS_PX,
    Polygons,
    closed_polygons,
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
    ends : ndarray of float64, shape (2, 2, P)
        x and y of unit vectors along the bearings at which the piece starts and ends.
    """

    reading: IntArray
    beam: IntArray
    turns: IntArray
    ends: FloatArray


def scan_view(
    poses: FloatArray, sectors: Sectors, sensor: Sensor, max_range_px: float
) -> View:
    """Return the view of scans at poses of shape (N, 3).

    It looks along the middle of the sectors, as far as both the sensor's parameters
    and the range finder itself reach.
    """
    coordinates = np.ascontiguousarray(poses.T)
    reach = min(sensor.range_px, max_range_px, REACH_MAX_PX) + EDGE_EPS
    # Bearings are small beside no heading: what they add to 1e16 rad would be lost.
    theta = wrap_angle(coordinates[2]) + sectors.middle
    return View(coordinates[:2], theta, reach, sectors.half)


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
    cuts = cuts.ravel()[order + np.arange(0, cuts.size, n_bounds + 4)[:, None]]
    begins = (order < n_bounds).cumsum(axis=1)
    corner = unit_vectors(cuts, view.theta[:, None]).reshape(2, -1)
    reading, place = np.nonzero(cuts[:, 1:] - cuts[:, :-1] > SLIVER_RAD)
    cut = reading * (n_bounds + 4) + place
    begins = begins.ravel()[cut]
    return Pieces(
        reading=reading,
        beam=reading * (n_bounds - 1) + begins - 1,
        turns=place + 1 - begins,
        ends=corner.take(np.array([cut, cut + 1]), axis=1),
    )


def sector_radii(ranges_px: FloatArray, sensor: Sensor, view: View) -> FloatArray:
    """Return how far each sector is empty, and how far anything is said of it.

    Parameters
    ----------
    ranges_px : ndarray of float64, shape (N, B)
        Ranges of the beams; infinity is no return, NaN invalid.
    sensor : Sensor
        Whether beams without return clear, and what is said behind a hit.
    view : View
        N scans.

    Returns
    -------
    ndarray of float64, shape (2, N, B)
        px; OWN_RADIUS_PX where nothing is empty, or said.
    """
    radii = np.full((2, *ranges_px.shape), view.reach)
    empty, said = radii
    hit = ranges_px <= view.reach
    # "At the location of the detected object" is object, also where rounding says not.
    np.copyto(empty, np.maximum(ranges_px - EDGE_EPS, OWN_RADIUS_PX), where=hit)
    if sensor.behind_hit is BehindHit.UNSEEN:
        surface = ranges_px + (SURFACE_DEPTH_PX + EDGE_EPS)
        np.copyto(said, np.minimum(surface, view.reach), where=hit)
    if not sensor.clear_no_hit:
        radii[:, ranges_px == np.inf] = OWN_RADIUS_PX
    radii[:, np.isnan(ranges_px)] = OWN_RADIUS_PX
    return radii


def sector_polygons(
    pieces: Pieces, points: FloatArray, radius: FloatArray, view: View
) -> Polygons:
    """Return the closed outlines of sectors, those of each reading once or twice.

    Parameters
    ----------
    pieces : Pieces
        Of N scans.
    points : ndarray of float64, shape (2, 2, K, P)
        x and y from the robot, px, of the start and the end of each piece, for K = 1 or
        2 outlines of each scan.
    radius : ndarray of float64, shape (K, P)
        Radius of each piece, px.
    view : View
        The scans.

    Returns
    -------
    Polygons
    """
    differs = np.ones(radius.shape, dtype=np.bool_)
    np.not_equal(radius[:, 1:], radius[:, :-1], out=differs[:, 1:])
    for key in (pieces.reading, pieces.turns):
        differs[:, 1:] |= key[1:] != key[:-1]
    # Pieces that do not differ are joined to the one before.
    first, last = run_ends(differs.ravel()[1:])
    owner = np.concatenate([pieces.reading, pieces.reading + view.size])[first]
    corner = np.array([first, last + radius.size])
    ends = points.reshape(2, -1).take(corner, axis=1)
    arc = radius.ravel()[first]
    return closed_polygons(owner, ends, arc > OWN_RADIUS_PX, arc, view)

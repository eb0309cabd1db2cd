"""From scans to evidence: Eq. 4.22 for the sectors of beams."""

from collections.abc import Iterator

import numpy as np

from occsim._types import BoolArray, FloatArray, Progress
from occsim.errors import expect
from occsim.evidence import (
    COUNTERS_AT_ONCE,
    READINGS_AT_ONCE,
    PixelCounts,
    joined,
    logged,
    most_counters,
)
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.rays.reach import View
from occsim.rays.scan import count_pixels, windows_of
from occsim.rays.surface import robots_on_centres
from occsim.scan.log import ScanLog
from occsim.scan.sectors import (
    Sectors,
    cut_pieces,
    scan_view,
    sector_polygons,
    sector_radii,
)
from occsim.sensor import OWN_PIXEL_EPS_PX, Sensor

CROSSINGS_AT_ONCE = 1 << 18
"""Most rows of pixels that each outline of a batch crosses, save a single scan's:
bounds memory."""


def evidence_from_scans(
    scan_log: ScanLog,
    sensor: Sensor,
    grid: Grid,
    on_progress: Progress | None = None,
) -> EvidenceLog:
    """Return what scans say of every cell (Eq. 4.22): one reading for each scan.

    Each beam stands for the sector half-way to its neighbours, at the edges of the scan
    as far outwards as inwards; beams that go all round have no edge. A pixel's z is the
    range of the beam in whose sector its centre lies.

    Parameters
    ----------
    scan_log : ScanLog
        S scans and the poses at which they enter the map.
    sensor : Sensor
        `range_px` is the usable range: nothing is said beyond it, and a hit beyond it
        clears as far as it. `behind_hit` and `clear_no_hit` as in `collect_evidence`.
        Where the beams look, the scans say themselves: `fov_rad` counts only for a
        scan of one beam, which stands for all of it.
    grid : Grid
        The cells. Pixels outside its image do not count, robots may stand there.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` from time to time.

    Returns
    -------
    EvidenceLog

    Raises
    ------
    TypeError
        Where an argument is of another type.

    See Also
    --------
    collect_evidence : exact for every pixel, where the world is known.

    Notes
    -----
    - Beams without return clear their sector as far as the range (`clear_no_hit`), or
      say nothing. Invalid beams say nothing.
    - With `BehindHit.UNSEEN`, pixels whose centre lies at most `SURFACE_DEPTH_PX`
      beyond the range are object: a scan does not say how thick a wall is. Behind
      walls thinner than that this is more than `collect_evidence` says.
    - The pixel whose centre is the robot is empty, or object where all beams that say
      something measured 0.
    - As the number of simulated beams grows, the log converges to that of
      `collect_evidence`.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, ScanLog, Sensor, evidence_from_scans
    >>> grid = Grid(height_px=1, width_px=6, cell_px=1)
    >>> log = ScanLog([[0.5, 0.5, 0.0]], [-0.1, 0.0, 0.1], [[3.5, 3.5, 3.5]], 20.0)
    >>> evidence_from_scans(log, Sensor(), grid).log_odds.round(2)
    array([ 2.2,  2.2,  2.2,  2.2, -2.2, -2.2])
    """
    expect("scan_log", scan_log, ScanLog)
    expect("sensor", sensor, Sensor)
    expect("grid", grid, Grid)
    batches = scan_counts(scan_log, sensor, grid)
    return joined(logged(batches, scan_log.n_scans, on_progress))


def scan_counts(scan_log: ScanLog, sensor: Sensor, grid: Grid) -> Iterator[PixelCounts]:
    """Yield what scans see, counted in pixels, one batch after another.

    Parameters
    ----------
    scan_log, sensor, grid
        As in `evidence_from_scans`.

    Yields
    ------
    PixelCounts
    """
    sectors = Sectors.of(scan_log.bearings_rad, sensor.fov_rad)
    view = scan_view(scan_log.poses, sectors, sensor, scan_log.max_range_px)
    start = 0
    for stop in _ends_of_batches(scan_log.ranges_px, view.reach, grid):
        part = slice(start, stop)
        ranges = scan_log.ranges_px[part][:, sectors.order]
        batch = view._replace(places=view.places[:, part], theta=view.theta[part])
        yield count_scans(ranges, sectors, batch, sensor, grid, stop)
        start = stop


def count_scans(
    ranges_px: FloatArray,
    sectors: Sectors,
    view: View,
    sensor: Sensor,
    grid: Grid,
    done: int,
) -> PixelCounts:
    """Return what a batch of scans sees.

    Parameters
    ----------
    ranges_px : ndarray of float64, shape (N, B)
        Ranges, by ascending bearing.
    sectors : Sectors
        Those of the beams.
    view : View
        The N scans.
    sensor, grid
        As in `evidence_from_scans`.
    done : int
        Scans up to the end of this batch.

    Returns
    -------
    PixelCounts
    """
    pieces = cut_pieces(sectors, view)
    radius = sector_radii(ranges_px, sensor, view).reshape(2, -1)[:, pieces.beam]
    points = pieces.ends[:, :, None] * radius
    windows = windows_of(pieces.reading, points[:, :, 1], view, grid)
    polygons = sector_polygons(pieces, points, radius, view)
    n_empty, in_view = count_pixels(polygons, windows, view)
    n_object = np.subtract(in_view, n_empty, out=in_view)
    reading, row, col = robots_on_centres(grid, view)
    if reading.size:
        counter = windows.pixel_counters(reading, row, col)
        is_empty, is_object = _own_pixels(ranges_px[reading])
        n_empty[counter] += is_empty
        n_object[counter] += is_object
    return PixelCounts(done, windows, n_empty, n_object)


def _own_pixels(ranges_px: FloatArray) -> tuple[BoolArray, BoolArray]:
    """Return whether the pixels on whose centre robots stand are empty, and object."""
    says = ~np.isnan(ranges_px)
    says_far = np.asarray((ranges_px > OWN_PIXEL_EPS_PX).any(axis=1))
    return says_far, np.asarray(says.any(axis=1) & ~says_far)


def _ends_of_batches(
    ranges_px: FloatArray, reach_px: float, grid: Grid
) -> Iterator[int]:
    """Yield where batches of scans end that stay within bounds of memory."""
    n_counters = most_counters(reach_px, grid)
    most = max(min(COUNTERS_AT_ONCE // n_counters, READINGS_AT_ONCE), 1)
    n_scans, n_beams = ranges_px.shape
    # An edge between two sectors crosses at most as many rows as their ranges differ,
    # a piece of the rim few in all; each piece also weighs as such.
    height = min(reach_px, grid.height_px)
    start = 0
    while start < n_scans:
        radius = np.minimum(ranges_px[start : start + most], reach_px)
        step = np.abs(np.diff(np.nan_to_num(radius), axis=1)).clip(max=height)
        weight = (step.sum(axis=1) + 2.0 * n_beams + 8.0 * height).cumsum()
        start += max(int(weight.searchsorted(CROSSINGS_AT_ONCE)), 1)
        start = min(start, n_scans)
        yield start

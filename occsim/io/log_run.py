"""A robot's log opened and mapped, in bounded time and memory."""

from dataclasses import dataclass, replace
from math import ceil
from pathlib import Path
from typing import TypedDict

import numpy as np

from occsim._files import printable, read_source
from occsim._types import ShortRepr
from occsim.building import Building
from occsim.errors import ParameterError, RobotFileError, expect, whole_number
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.imaging import Drawing, FileKind, kind_of_file
from occsim.io import bags, carmen, timed
from occsim.io import scans as scan_files
from occsim.io.log_advice import about_other_file
from occsim.io.metric import MetricFrame
from occsim.io.scans import MetricScans
from occsim.scan import RangeFinder, evidence_from_scans, simulate_scans
from occsim.sensor import BehindHit, Sensor

MAX_ENTRIES = 8_000_000
"""Most cell updates of a map that is played: about 250 MB in a browser."""

MAX_SCANS = 5_000
"""Most scans that are played."""

MAX_CELLS = 4_000_000
"""Most cells of a map that is played: 100 m x 100 m at 5 cm."""

MAX_PIXELS_READ = 600_000_000
"""Most pixels in the windows around all scans: some seconds of computing."""

SAMPLED = 32
"""Scans from which the cell updates of all are estimated."""

HIT_LEVEL = 110
"""Brightness of a hit in a picture of them."""

NEEDED = "a log in CARMEN format, a bag of ROS, or scans as NPZ"


@dataclass(frozen=True, eq=False, repr=False)
class LogRun(ShortRepr):
    """What the scans of a log say of the cells of its map.

    Parameters
    ----------
    scans : MetricScans
        The scans that were used.
    sensor : Sensor
        How they were read.
    every : int
        Every n-th scan of the log was used.
    n_scans : int
        Scans of the log.
    evidence : EvidenceLog
        One reading for each scan used.
    """

    scans: MetricScans
    sensor: Sensor
    every: int
    n_scans: int
    evidence: EvidenceLog


class _Options(TypedDict):
    metres_per_px: float
    max_range_m: float | None
    usable_range_m: float | None


def open_log(
    source: bytes | str | Path,
    *,
    trajectory: bytes | str | Path | None = None,
    metres_per_px: float = 0.05,
    max_range_m: float | None = None,
    usable_range_m: float | None = None,
) -> MetricScans:
    """Return the scans of a log, whatever its format.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is: CARMEN, a bag of ROS, a zip file of the
        folder of one, or NPZ as `occsim.io.scans.dump` writes.
    trajectory : bytes, str or Path, optional
        A TUM file that says where the scans were taken; then the source is timed scans,
        NPZ or CSV, as `occsim.io.timed.load` takes them.
    metres_per_px, max_range_m, usable_range_m
        As in `occsim.io.carmen.load`.

    Returns
    -------
    MetricScans

    Raises
    ------
    RobotFileError
        Where the file is missing, too large, damaged, or no log.
    ParameterError
        Where a parameter lies outside its domain.

    Examples
    --------
    >>> from occsim.io.log_run import open_log
    >>> open_log(b"FLASER 3 1.0 2.0 81.83 4 5 0 4 5 0 7.5 host 7.5").scan_log.n_beams
    3
    """
    options: _Options = {
        "metres_per_px": metres_per_px,
        "max_range_m": max_range_m,
        "usable_range_m": usable_range_m,
    }
    if trajectory is not None:
        return timed.load(trajectory, source, **options)
    data, name = read_source(
        source,
        what="the log",
        needed=NEEDED,
        max_bytes=bags.MAX_FILE_BYTES,
        error=RobotFileError,
    )
    if bags.is_bag(data):
        try:
            return bags.load(data, **options)
        except ImportError as error:
            raise RobotFileError(str(error)) from None
    kind = kind_of_file(data, name)
    other = about_other_file(data, kind)
    if other:
        raise RobotFileError(f"{printable(name)} is {other}")
    if kind is FileKind.ZIP:
        return scan_files.load(data, **options)
    if kind not in (FileKind.CARMEN_LOG, FileKind.TEXT):
        raise RobotFileError(f"{name} is {kind.about}; {NEEDED} is needed")
    return carmen.load(data, **options)


def map_log(
    scans: MetricScans,
    *,
    cell_px: int = 1,
    behind_hit: BehindHit = BehindHit.UNSEEN,
    clear_no_hit: bool = False,
    max_entries: int = MAX_ENTRIES,
) -> LogRun:
    """Return what the scans of a log say of the cells of its map.

    Parameters
    ----------
    scans : MetricScans
        The log.
    cell_px : int, default 1
        Side of a cell, px of the map.
    behind_hit : BehindHit, default BehindHit.UNSEEN
        What is said behind a hit.
    clear_no_hit : bool, default False
        Whether a beam without return clears its sector.
    max_entries : int, default MAX_ENTRIES
        About how many updates of cells are wanted at most.

    Returns
    -------
    LogRun
        Of all scans, or of every n-th one where all would be more than `MAX_SCANS`,
        `MAX_PIXELS_READ` or `max_entries`.

    Raises
    ------
    TypeError, ParameterError
        Where an argument is of another type or outside its domain, or the map has more
        than `MAX_CELLS`.

    Examples
    --------
    >>> from occsim.io.log_run import map_log, open_log
    >>> run = map_log(open_log(b"FLASER 3 1.0 2.0 81.83 4 5 0 4 5 0 7.5 host 7.5"))
    >>> run.n_scans, run.every, run.evidence.n_readings
    (1, 1, 1)
    """
    expect("scans", scans, MetricScans)
    grid = scans.grid(cell_px)
    if grid.n_cells > MAX_CELLS:
        raise ParameterError(
            f"the map has {grid.n_cells:,} cells; at most {MAX_CELLS:,} are mapped "
            "here: choose larger cells or a shorter usable range"
        )
    sensor = replace(scans.sensor(behind_hit), clear_no_hit=clear_no_hit)
    most = whole_number("max_entries", max_entries, 1, MAX_ENTRIES)
    every = _every(scans, sensor, grid, most)
    used = replace(scans, scan_log=scans.scan_log.every_nth(every))
    evidence = evidence_from_scans(used.scan_log, sensor, grid)
    return LogRun(used, sensor, every, scans.scan_log.n_scans, evidence)


def hits_drawing(scans: MetricScans) -> Drawing:
    """Return a picture of where the beams of a log ended, one grey dot a hit.

    Parameters
    ----------
    scans : MetricScans
        The log.

    Returns
    -------
    Drawing
        Of the map's size; hits beyond the usable range are left out.
    """
    scan_log, grid = scans.scan_log, scans.grid()
    usable_px = scans.usable_range_m / scans.frame.metres_per_px
    ranges = np.where(scan_log.ranges_px <= usable_px, scan_log.ranges_px, np.nan)
    shown = replace(scan_log, ranges_px=ranges)
    col, row = np.floor(shown.hit_points_px()).astype(np.int64).T
    rgb = np.full((grid.height_px, grid.width_px, 3), 255, dtype=np.uint8)
    inside = (row >= 0) & (col >= 0) & (row < grid.height_px) & (col < grid.width_px)
    rgb[row[inside], col[inside]] = HIT_LEVEL
    return Drawing(rgb=rgb, name="hits")


def tour_log(building: Building, range_finder: RangeFinder, seed: int) -> bytes:
    """Return the log of a robot that drives along a building's trajectory.

    Parameters
    ----------
    building : Building
        Its world, its trajectory and its likely scale.
    range_finder : RangeFinder
        What the robot carries, with its errors.
    seed : int
        Of the errors.

    Returns
    -------
    bytes
        An NPZ file as `occsim.io.scans.dump` writes; the poses are exact.
    """
    scale = building.likely_metres_per_px
    scan_log = simulate_scans(
        building.world,
        building.trajectory,
        range_finder.sensor(scale),
        range_finder.n_beams,
        range_finder.noise(scale),
        np.random.default_rng(seed),
    )
    height_px, _ = building.world.shape
    frame = MetricFrame(height_px=height_px, metres_per_px=scale)
    return scan_files.dump(scan_log, frame)


def _every(scans: MetricScans, sensor: Sensor, grid: Grid, max_entries: int) -> int:
    """Return the least n such that every n-th scan stays within the bounds."""
    scan_log = scans.scan_log
    n = scan_log.n_scans
    side_px = 2.0 * min(sensor.range_px, scan_log.max_range_px) + 1.0
    window = min(side_px, grid.height_px) * min(side_px, grid.width_px)
    sample = scan_log.every_nth(-(-n // SAMPLED))
    found = evidence_from_scans(sample, sensor, grid)
    entries = found.cell.size / sample.n_scans
    bounds = (
        n / MAX_SCANS,
        n * window / MAX_PIXELS_READ,
        n * entries / max_entries,
    )
    return ceil(max(1.0, *bounds))

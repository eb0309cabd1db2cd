"""Logs of CARMEN: scans of laser range finders, and where they were taken.

Lines of the kinds ``FLASER`` (``FLASER n r_1 .. r_n x y theta odom_x odom_y odom_theta
time ..``), ``ROBOTLASER1`` and ``ODOM`` are read, all others passed over. In logs with
corrected poses, as gmapping's ``gfs2log`` writes them, x, y and theta are corrected.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import numpy as np

from occsim._files import printable, read_source
from occsim._types import FloatArray
from occsim.errors import OccsimError, RobotFileError, choice
from occsim.io.scans import MAX_RANGES, MetricScans, check_lengths, metric_scans

MAX_FILE_BYTES = 100_000_000
MAX_LINE_BYTES = 200_000
MAX_BEAMS = 5_000
MAX_SCANS = 200_000
LMS_RANGE_M = 80.0
"""A FLASER line does not say how far its range finder reaches. CARMEN's was a SICK
LMS200, which reads 81.83 m and more where nothing returns; gmapping, too, takes 80."""

SICK_LMS = 0
"""Its number among CARMEN's range finders."""

STEPS_DEG = {
    400: 0.25,
    401: 0.25,
    540: 0.5,
    541: 0.5,
    682: 360.0 / 1024.0,
    683: 360.0 / 1024.0,
    769: 360.0 / 1024.0,
    1080: 0.25,
    1081: 0.25,
}
"""Between the beams of a FLASER line, by their number, where that tells a range finder
that looks along more or less than half a turn: the LMS200 at 100 degrees, the S300, and
three of Hokuyo."""

_BOM = b"\xef\xbb\xbf"
_FIRST_WORD = re.compile(rb"(?m)^[ \t]*([A-Z][A-Z0-9_]+)[ \t]")
_SCANS = {
    kind: re.compile(rb"(?m)^[ \t]*" + kind + rb"[ \t]")
    for kind in (b"FLASER", b"ROBOTLASER1")
}

_SHOWN_BYTES = 1_000_000
"""So much of a log without scans is searched for the lines that it has instead."""


class PoseSource(Enum):
    """Which of a scan's two poses is taken.

    Examples
    --------
    >>> from occsim.io import carmen
    >>> line = b"FLASER 3 1.0 2.0 81.83 4 5 0 1 1 0 7.5 host 7.5"
    >>> by_odometry = carmen.load(line, poses=carmen.PoseSource.ODOMETRY)
    >>> by_odometry.frame.origin_x_m < carmen.load(line).frame.origin_x_m
    True
    """

    LASER = "laser"
    """The range finder's own, corrected where the log is."""
    ODOMETRY = "odometry"
    """FLASER: what the odometry counted; ROBOTLASER1: the robot's."""


@dataclass(frozen=True, eq=False, repr=False)
class CarmenLog(MetricScans):
    """The scans of a log on a map of their own.

    Parameters
    ----------
    scan_log, frame, width_px, usable_range_m
        As in `MetricScans`.
    times_s : ndarray of float64, shape (S,)
        When each scan was taken, NaN where the log does not say.
    odometry_m : ndarray of float64, shape (K, 3)
        x, y, m, and heading, rad, of the ODOM lines.

    Examples
    --------
    >>> from occsim.io import carmen
    >>> log = carmen.load(b"FLASER 3 1.0 2.0 81.83 4 5 0 4 5 0 7.5 host 7.5")
    >>> log.scan_log.n_scans, log.times_s
    (1, array([7.5]))
    """

    times_s: FloatArray
    odometry_m: FloatArray


@dataclass(frozen=True, eq=False)
class _Laser:
    """How the beams of a line point and reach; bearings to the left, rad."""

    n_beams: int
    first_rad: float
    step_rad: float
    max_range_m: float

    def bearings_rad(self) -> FloatArray:
        beam = np.arange(self.n_beams, dtype=np.float64)
        return self.first_rad + self.step_rad * beam


@dataclass(frozen=True, eq=False)
class _Line:
    """A scan as its line gives it."""

    laser: _Laser
    ranges_m: FloatArray
    pose: FloatArray
    odometry: FloatArray
    time_s: float


def load(
    log: bytes | str | Path,
    *,
    metres_per_px: float = 0.05,
    max_range_m: float | None = None,
    usable_range_m: float | None = None,
    poses: PoseSource = PoseSource.LASER,
) -> CarmenLog:
    """Return the scans of a CARMEN log.

    Parameters
    ----------
    log : bytes, str or Path
        The file's content, or where it is.
    metres_per_px : float, default 0.05
        Scale of the map, above 0.
    max_range_m : float, optional
        A reading at or beyond it is no return. By default what ROBOTLASER1 says, and
        `LMS_RANGE_M` for FLASER and where a SICK LMS says more.
    usable_range_m : float, optional
        Beyond it nothing is mapped; by default `max_range_m`. Hits beyond it count as
        far as it, and do not enlarge the map.
    poses : PoseSource, default PoseSource.LASER
        Which of a scan's two poses is taken.

    Returns
    -------
    CarmenLog
        A reading of 0 or NaN is invalid.

    Raises
    ------
    RobotFileError
        Where the file is missing, too large or without scans; where a line is damaged,
        which it names; where the map would be too large.
    ParameterError
        Where a parameter lies outside its domain.

    Notes
    -----
    Where a log has both kinds of scans, FLASER is read. FLASER lines do not say where
    their beams point: half a turn, from the right to the left, in steps of 180 degrees
    by n (n even) or n - 1 (odd); for some n in those of `STEPS_DEG`.

    A SICK LMS says that it reaches farther than 80 m, and gives 81.83 m and more where
    nothing returns: by default its reach is `LMS_RANGE_M`.

    References
    ----------
    .. [1] CARMEN, the Carnegie Mellon robot navigation toolkit, log file format.

    Examples
    --------
    >>> from occsim.io import carmen
    >>> log = carmen.load(b"FLASER 3 1.0 2.0 81.83 4 5 0 4 5 0 7.5 host 7.5")
    >>> log.scan_log.ranges_px.round(1), log.frame.metres_per_px
    (array([[inf, 40., 20.]]), 0.05)
    """
    source = choice("poses", poses, PoseSource)
    check_lengths(
        metres_per_px=metres_per_px,
        max_range_m=max_range_m,
        usable_range_m=usable_range_m,
    )
    data, name = read_source(
        log,
        what="the log",
        needed="a log in CARMEN format",
        max_bytes=MAX_FILE_BYTES,
        error=RobotFileError,
    )
    lines, odometry = _parse(data, name)
    laser = lines[0].laser
    most = laser.max_range_m if max_range_m is None else float(max_range_m)
    ranges = np.array([line.ranges_m for line in lines])
    ranges[ranges >= most] = np.inf
    ranges[ranges == 0.0] = np.nan
    own = source is PoseSource.LASER
    try:
        found = metric_scans(
            [line.pose if own else line.odometry for line in lines],
            laser.bearings_rad(),
            ranges,
            most,
            metres_per_px=metres_per_px,
            usable_range_m=usable_range_m,
        )
    except OccsimError as error:
        raise RobotFileError(f"{printable(name)}: {error}") from None
    times = np.array([line.time_s for line in lines])
    return CarmenLog(**vars(found), times_s=times, odometry_m=odometry)


def _parse(data: bytes, name: str) -> tuple[list[_Line], FloatArray]:
    """Return the scans of one kind, and the poses of the odometry."""
    data = data.removeprefix(_BOM)
    present = [word for word in _SCANS if word in data and _SCANS[word].search(data)]
    kind = present[0] if present else None
    if kind is None:
        found = set(_FIRST_WORD.findall(data[:_SHOWN_BYTES]))
        raise RobotFileError(_without_scans(found, printable(name)))
    read = _flaser if kind == b"FLASER" else _robotlaser
    scans, odometry, n_ranges = list[_Line](), list[FloatArray](), 0
    for number, line in _lines(data):
        first, where = line[:99].split(None, 1)[:1], f"{name}, line {number}"
        if first == [b"ODOM"]:
            odometry.append(_Words(line, where).numbers(3, "of the pose"))
        elif first == [kind]:
            scans.append(read(_Words(line, where)))
            n_ranges += scans[-1].laser.n_beams
            _check_alike(scans, n_ranges, where)
    return scans, np.array(odometry).reshape(-1, 3)


def _without_scans(found: set[bytes], name: str) -> str:
    kinds = ", ".join(sorted(kind.decode()[:20] for kind in found)[:8])
    if not kinds:
        return (
            f"{name} has no line FLASER or ROBOTLASER1; a log in CARMEN format is "
            "needed"
        )
    return (
        f"{name} has no line FLASER or ROBOTLASER1, which say what was seen and from "
        f"where; its lines are {kinds}"
    )


def _lines(data: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield lines with their numbers, without a list of all of them."""
    start, number = 0, 1
    while start < len(data):
        end = data.find(b"\n", start)
        end = len(data) if end < 0 else end
        yield number, data[start : min(end, start + MAX_LINE_BYTES + 1)]
        start, number = end + 1, number + 1


def _check_alike(scans: list[_Line], n_ranges: int, where: str) -> None:
    first, last = scans[0].laser, scans[-1].laser
    if vars(first) != vars(last):
        raise RobotFileError(
            f"{where}: all scans must come from one range finder; the first has "
            f"{first.n_beams} beams, this one {last.n_beams}, or they point or reach "
            "elsewhere"
        )
    if len(scans) > MAX_SCANS or n_ranges > MAX_RANGES:
        raise RobotFileError(
            f"{where}: a log may have {MAX_SCANS:,} scans and {MAX_RANGES:,} ranges"
        )


class _Words:
    """The words of a line, read from left to right."""

    def __init__(self, line: bytes, where: str) -> None:
        if len(line) > MAX_LINE_BYTES:
            raise RobotFileError(
                f"{where}: a line may have {MAX_LINE_BYTES:,} bytes; this one has more"
            )
        self._words, self._next, self.where = line.split(), 1, where

    def numbers(self, count: int, what: str, *, pose: bool = True) -> FloatArray:
        """Return the next numbers; those of a pose must be finite."""
        words = self._words[self._next : self._next + count]
        self._next += count
        if len(words) < count:
            raise RobotFileError(
                f"{self.where} is cut short: {count} numbers {what} are needed; got "
                f"{len(words)}"
            )
        try:
            values = np.array([float(word) for word in words])
        except ValueError:
            raise RobotFileError(
                f"{self.where} is damaged: the numbers {what} include a word"
            ) from None
        if pose and not np.isfinite(values).all():
            raise RobotFileError(f"{self.where}: the numbers {what} must be finite")
        return values

    def count(self, what: str, least: int = 0) -> int:
        """Return the next number, which counts something."""
        value = self.numbers(1, what)[0]
        if value != int(value) or not least <= value <= MAX_BEAMS:
            raise RobotFileError(
                f"{self.where}: the number {what} must be whole, {least} to "
                f"{MAX_BEAMS:,}; got {value:g}"
            )
        return int(value)

    def ranges(self, count: int) -> FloatArray:
        """Return the next ranges: NaN and infinity are allowed, less than 0 is not."""
        ranges = self.numbers(count, "of ranges", pose=False)
        if (ranges < 0.0).any():
            raise RobotFileError(f"{self.where}: a range must not be negative")
        return ranges

    def time_s(self) -> float:
        """Return the next number, or NaN where there is none."""
        try:
            return float(self._words[self._next])
        except (IndexError, ValueError):
            return np.nan


def _flaser(words: _Words) -> _Line:
    n = words.count("of beams", 1)
    ranges = words.ranges(n)
    pose, odometry = (words.numbers(3, what) for what in ("of the pose", "of odometry"))
    half_turn_by = n if n % 2 == 0 else max(n - 1, 1)
    step = float(np.radians(STEPS_DEG.get(n, 180.0 / half_turn_by)))
    # Of an even number, the last beam to the left is left out.
    laser = _Laser(n, -(n // 2) * step, step, LMS_RANGE_M)
    return _Line(laser, ranges, pose, odometry, words.time_s())


def _robotlaser(words: _Words) -> _Line:
    # Type, start, field of view, step, reach, accuracy, kind of remission.
    kind, first, _, step, most, _, _ = words.numbers(7, "of the range finder")
    n = words.count("of beams", 1)
    ranges = words.ranges(n)
    words.numbers(words.count("of remissions"), "of remissions", pose=False)
    pose, robot = (words.numbers(3, what) for what in ("of the laser", "of the robot"))
    words.numbers(5, "of the robot's motion", pose=False)
    if not (step > 0.0 and step * (n - 1) <= 2.0 * np.pi and 0.0 < most < 1e4):
        raise RobotFileError(
            f"{words.where}: beams must lie within one turn and reach more than 0 m; "
            f"got steps of {step:g} rad and {most:g} m"
        )
    if kind == SICK_LMS:
        most = min(most, LMS_RANGE_M)
    laser = _Laser(n, float(first), float(step), float(most))
    return _Line(laser, ranges, pose, robot, words.time_s())

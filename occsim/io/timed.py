"""Scans that know when they were taken, and a trajectory that does, as TUM files.

A TUM file has a line for each pose, ``t x y z qx qy qz qw``, in s and m. Where a scan
was taken is interpolated between the poses before and after it.
"""

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from occsim._archives import names_in
from occsim._files import printable, read_source
from occsim._npz import unpacked
from occsim._types import FloatArray
from occsim.errors import OccsimError, RobotFileError
from occsim.io.rigid import covered, in_plane, poses_at
from occsim.io.scans import MAX_RANGES, MetricScans, check_lengths, metric_scans

MAX_POSE_BYTES = 100_000_000
MAX_SCAN_BYTES = 200_000_000
MAX_POSES = 1_000_000
MAX_SCANS = 200_000
MAX_HEADER_BYTES = 1_000_000

_ARRAYS = dict.fromkeys(
    ("times_s", "bearings_rad", "ranges_m", "max_range_m"), np.float64
)
_ZIP, _BOM = b"PK\x03\x04", b"\xef\xbb\xbf"


@dataclass(frozen=True, eq=False, repr=False)
class TimedScans(MetricScans):
    r"""Scans that were placed by their times, on a map of their own.

    Parameters
    ----------
    scan_log, frame, width_px, usable_range_m
        As in `MetricScans`.
    times_s : ndarray of float64, shape (S,)
        When each scan was taken.
    n_left_out : int
        Scans before the first pose or after the last.

    Examples
    --------
    >>> from occsim.io import timed
    >>> poses = b"0 0 0 0 0 0 0 1\n10 5 0 0 0 0 0 1\n"
    >>> timed.load(poses, b"time_s,-0.1,0.1\n4,3.0,inf\n99,3.0,inf\n").n_left_out
    1
    """

    times_s: FloatArray
    n_left_out: int


def load(
    trajectory: bytes | str | Path,
    scans: bytes | str | Path,
    *,
    metres_per_px: float = 0.05,
    max_range_m: float | None = None,
    usable_range_m: float | None = None,
) -> TimedScans:
    r"""Return scans at the poses that a TUM trajectory gives for their times.

    Parameters
    ----------
    trajectory : bytes, str or Path
        A TUM file's content, or where it is.
    scans : bytes, str or Path
        NPZ with the arrays ``times_s`` (S,), ``bearings_rad`` (B,), ``ranges_m``
        (S, B) and ``max_range_m``, real numbers; or CSV, a first line ``time_s`` and
        the B bearings in rad, then a line for each scan, its time in s and its ranges
        in m. Bearings to the left of the heading; ``inf`` is no return, ``nan``
        invalid.
    metres_per_px, usable_range_m
        As in `occsim.io.scans.metric_scans`.
    max_range_m : float, optional
        A reading at or beyond it is no return; by default what the NPZ says, and the
        greatest range of a CSV file.

    Returns
    -------
    TimedScans

    Raises
    ------
    RobotFileError
        Where a file is missing, damaged or too large; where the two share no time.
    ParameterError
        Where a parameter lies outside its domain.

    References
    ----------
    .. [1] J. Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems",
       IROS 2012: the format of trajectories.

    Examples
    --------
    >>> from occsim.io import timed
    >>> poses = b"0 0 0 0 0 0 0 1\n10 5 0 0 0 0 0 1\n"
    >>> found = timed.load(poses, b"time_s,-0.1,0.1\n4,3.0,inf\n")
    >>> found.times_s, found.scan_log.ranges_px.round(1)
    (array([4.]), array([[inf, 60.]]))
    """
    check_lengths(
        metres_per_px=metres_per_px,
        max_range_m=max_range_m,
        usable_range_m=usable_range_m,
    )
    samples = read_trajectory(trajectory)
    times, bearings, ranges, own_most = _scans(scans)
    most = own_most if max_range_m is None else float(max_range_m)
    if max_range_m is not None:
        ranges = np.where(ranges >= most, np.inf, ranges)
    try:
        return placed_scans(
            times,
            samples,
            bearings,
            ranges,
            most,
            metres_per_px=metres_per_px,
            usable_range_m=usable_range_m,
        )
    except OccsimError as error:
        raise RobotFileError(str(error)) from None


def is_timed_scans(data: bytes) -> bool:
    """Return whether a file is one of timed scans, NPZ or CSV, by its first look.

    Examples
    --------
    >>> from occsim.io.timed import is_timed_scans
    >>> is_timed_scans(b"time_s,-0.1,0.1"), is_timed_scans(b"0 0 0 0 0 0 0 1")
    (True, False)
    """
    if not data.startswith(_ZIP):
        return data.removeprefix(_BOM).lstrip(b'"').startswith(b"time_s")
    try:
        return "times_s.npy" in names_in(data, what="timed scans", needed="NPZ")
    except OccsimError:
        return False


def placed_scans(
    times_s: FloatArray,
    samples: FloatArray,
    bearings_rad: FloatArray,
    ranges_m: FloatArray,
    max_range_m: float,
    *,
    metres_per_px: float,
    usable_range_m: float | None,
) -> TimedScans:
    """Return scans at the poses that samples give for their times.

    Parameters
    ----------
    times_s : ndarray of float64, shape (S,)
        Of the scans.
    samples : ndarray of float64, shape (K, 8)
        As in `occsim.io.rigid.poses_at`.
    bearings_rad, ranges_m, max_range_m, metres_per_px, usable_range_m
        As in `occsim.io.scans.metric_scans`.

    Raises
    ------
    TypeError, OccsimError
        As there, and where samples and scans share no time.
    """
    within = covered(times_s, samples)
    if not within.any():
        raise RobotFileError(
            "the poses must cover the scans' times; poses "
            f"{samples[:, 0].min():.9g} to {samples[:, 0].max():.9g} s, scans "
            f"{times_s.min():.9g} to {times_s.max():.9g} s"
        )
    poses, _ = in_plane(poses_at(times_s[within], samples))
    found = metric_scans(
        poses,
        bearings_rad,
        ranges_m[within],
        max_range_m,
        metres_per_px=metres_per_px,
        usable_range_m=usable_range_m,
    )
    return TimedScans(
        **vars(found), times_s=times_s[within], n_left_out=int((~within).sum())
    )


def read_trajectory(source: bytes | str | Path) -> FloatArray:
    r"""Return the rows of a TUM trajectory.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.

    Returns
    -------
    ndarray of float64, shape (N, 8)
        t, s; x, y, z, m; qx, qy, qz, qw.

    Raises
    ------
    RobotFileError
        Where it is missing, too large, or no such trajectory.

    Examples
    --------
    >>> from occsim.io.timed import read_trajectory
    >>> read_trajectory(b"0 0 0 0 0 0 0 1\n10 5 0 0 0 0 0 1\n").shape
    (2, 8)
    """
    data, name = read_source(
        source,
        what="the trajectory",
        needed="a TUM trajectory, t x y z qx qy qz qw",
        max_bytes=MAX_POSE_BYTES,
        error=RobotFileError,
    )
    samples = _table(data, printable(name), None, MAX_POSES)
    if samples.shape[1] != 8:
        raise RobotFileError(
            f"{printable(name)} must have the 8 columns of a TUM trajectory, t x y z "
            f"qx qy qz qw; got {samples.shape[1]}"
        )
    return samples


def _scans(
    source: bytes | str | Path,
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return times, bearings, ranges and the greatest range of a file of scans."""
    data, name = read_source(
        source,
        what="the scans",
        needed="scans as NPZ or CSV",
        max_bytes=MAX_SCAN_BYTES,
        error=RobotFileError,
    )
    read = _from_npz if data.startswith(_ZIP) else _from_csv
    times, bearings, ranges, most = read(data, printable(name))
    if times.ndim != 1 or not times.size or not np.isfinite(times).all():
        raise RobotFileError("times_s must be finite, one for each scan, at least one")
    if ranges.shape != (times.size, bearings.size):
        raise RobotFileError(
            f"ranges_m must have shape {(times.size, bearings.size)}, one for each "
            f"scan and beam; got {ranges.shape}"
        )
    return times, bearings, ranges, most


def _from_npz(
    data: bytes, name: str
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    arrays = unpacked(
        data,
        _ARRAYS,
        what="timed scans",
        max_values=MAX_RANGES,
        error=RobotFileError,
        any_real=True,
    )
    if arrays["max_range_m"].size != 1:
        raise RobotFileError(f"max_range_m of {name} must be one number")
    times, bearings, ranges = (
        np.asarray(arrays[key], dtype=np.float64)
        for key in ("times_s", "bearings_rad", "ranges_m")
    )
    return times, bearings, ranges, float(arrays["max_range_m"].item())


def _from_csv(
    data: bytes, name: str
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    header, _, rest = data.removeprefix(_BOM).partition(b"\n")
    header = header.replace(b'"', b"")  # tables are often written with quoted titles
    titles = header[:MAX_HEADER_BYTES].split(b",")
    if titles[0].strip() != b"time_s" or len(titles) < 2:
        raise RobotFileError(
            f"the first line of {name} must be time_s and the beams' bearings in rad, "
            "between commas"
        )
    bearings = _table(b",".join(titles[1:]), f"the first line of {name}", ",", 1)[0]
    rows = _table(rest, name, ",", MAX_SCANS, first_line=2)
    if rows.shape[1] != len(titles):
        raise RobotFileError(
            f"each line of {name} must have {len(titles)} numbers; got {rows.shape[1]}"
        )
    ranges = rows[:, 1:]
    hits = ranges[np.isfinite(ranges)]
    if not hits.size or not hits.max() > 0.0:
        raise RobotFileError(f"at least one range of {name} must be above 0")
    return rows[:, 0], bearings, ranges, float(hits.max())


def _table(
    data: bytes, name: str, delimiter: str | None, most: int, *, first_line: int = 1
) -> FloatArray:
    """Return the numbers of a text file with as many on each line."""
    data = data.removeprefix(_BOM)
    n_lines = data.count(b"\n") + 1
    if n_lines > 2 * most + 1000:
        raise RobotFileError(f"{name} may have {most:,} lines; got {n_lines:,}")
    if delimiter and data.count(delimiter.encode()) > MAX_RANGES:
        raise RobotFileError(f"{name} may have {MAX_RANGES:,} ranges; it has more")
    if not any(line.strip() and line[:1] != b"#" for line in io.BytesIO(data)):
        raise RobotFileError(f"numbers are needed in {name}")  # NumPy would warn
    try:
        table: npt.NDArray[np.float64] = np.loadtxt(
            io.StringIO(data.decode("ascii", "replace")),  # comments may be anything
            comments="#",
            delimiter=delimiter,
            ndmin=2,
        )
    except ValueError:
        damage = _damage(data, delimiter, first_line)
        raise RobotFileError(f"{damage} of {name}") from None
    if len(table) > most:
        raise RobotFileError(f"{name} may have {most:,} lines of numbers")
    return table


def _damage(data: bytes, delimiter: str | None, first_line: int) -> str:
    """Return what is wrong with which line of a table that NumPy refused."""
    sep, count = delimiter.encode() if delimiter else None, 0
    for number, line in enumerate(io.BytesIO(data), first_line):
        words = line.partition(b"#")[0].strip()
        parts = words.split(sep) if words else []
        if not parts:
            continue
        for part in parts:
            try:
                float(part)
            except ValueError:
                got = printable(part.decode("ascii", "replace").strip()[:40])
                return f'numbers are needed; got "{got}" in line {number}'
        count = count or len(parts)
        if len(parts) != count:
            return (
                f"{count} numbers a line are needed; got {len(parts)} in line {number}"
            )
    return "a table of numbers is needed; got another text instead"

"""Scans in metres with y up, on a map of their own; and as NPZ files."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from occsim._files import read_source
from occsim._npz import packed, unpacked
from occsim._types import FloatArray, ShortRepr
from occsim.errors import (
    OccsimError,
    ParameterError,
    RobotFileError,
    expect,
    real_number,
)
from occsim.grid import Grid
from occsim.io.metric import (
    MAX_MAP_PIXELS,
    MetricFrame,
    poses_to_image,
    poses_to_metric,
)
from occsim.scan import ScanLog
from occsim.sensor import BehindHit, Sensor

MAX_RANGES = 20_000_000
"""Most ranges of all scans together: 160 MB."""

MAX_FILE_BYTES = 200_000_000

MARGIN_M = 0.5
"""Left free around all poses and hits."""

_ARRAYS = dict.fromkeys(
    ("poses_m", "bearings_rad", "ranges_m", "max_range_m"), np.float64
)


@dataclass(frozen=True, eq=False, repr=False)
class MetricScans(ShortRepr):
    """Scans on a map of their own.

    Parameters
    ----------
    scan_log : ScanLog
        S scans, in px of the map.
    frame : MetricFrame
        Where the map lies, in metres with y up.
    width_px : int
        Width of the map; its height is that of the frame.
    usable_range_m : float
        Range beyond which nothing is mapped, m.

    Examples
    --------
    >>> from occsim import evidence_from_scans
    >>> from occsim.io.scans import metric_scans
    >>> found = metric_scans([[4, 5, 0]], [-0.5, 0.0, 0.5], [[1, 2, 1]], 30)
    >>> log = evidence_from_scans(found.scan_log, found.sensor(), found.grid())
    >>> log.n_readings
    1
    """

    scan_log: ScanLog
    frame: MetricFrame
    width_px: int
    usable_range_m: float

    def grid(self, cell_px: int = 1) -> Grid:
        """Return the map's cells."""
        return Grid(
            height_px=self.frame.height_px, width_px=self.width_px, cell_px=cell_px
        )

    def sensor(self, behind_hit: BehindHit = BehindHit.UNSEEN) -> Sensor:
        """Return how real scans are read, with gmapping's policies.

        Parameters
        ----------
        behind_hit : BehindHit, default BehindHit.UNSEEN
            What is said behind a hit.

        Returns
        -------
        Sensor
            Its range is the usable range; a beam without return says nothing: black
            surfaces and mirrors give none either.
        """
        return Sensor(
            range_px=self.usable_range_m / self.frame.metres_per_px,
            behind_hit=behind_hit,
            clear_no_hit=False,
        )


def metric_scans(
    poses_m: npt.ArrayLike,
    bearings_rad: npt.ArrayLike,
    ranges_m: npt.ArrayLike,
    max_range_m: float,
    *,
    metres_per_px: float = 0.05,
    usable_range_m: float | None = None,
) -> MetricScans:
    """Return scans in metres on a map that holds all their poses and hits.

    Parameters
    ----------
    poses_m : array_like of shape (S, 3)
        x, y, m, and heading, rad, to the left.
    bearings_rad : array_like of shape (B,)
        Where the beams point, to the left of the heading, rad.
    ranges_m : array_like of shape (S, B)
        Ranges, m; infinity is no return, NaN invalid.
    max_range_m : float
        How far the range finder reaches, m.
    metres_per_px : float, default 0.05
        Scale of the map, above 0.
    usable_range_m : float, optional
        Beyond it nothing is mapped; by default `max_range_m`. Hits beyond it count as
        far as it, and do not enlarge the map.

    Returns
    -------
    MetricScans

    Raises
    ------
    TypeError, OccsimError
        As `ScanLog`, where a scale or a range lies outside its domain, or the map would
        have more than `MAX_MAP_PIXELS`.

    Examples
    --------
    >>> from occsim.io.scans import metric_scans
    >>> found = metric_scans([[4, 5, 0]], [-0.5, 0.0, 0.5], [[1, 2, float("inf")]], 30)
    >>> found.scan_log.ranges_px.round(1), found.frame.metres_per_px
    (array([[inf, 40., 20.]]), 0.05)
    """
    scale = checked_length("metres_per_px", metres_per_px)
    # A log of scans in metres: what is wrong is refused before a map is made.
    poses, bearings, ranges = map(np.asarray, (poses_m, bearings_rad, ranges_m))
    try:
        metric = ScanLog(poses, bearings, ranges, max_range_m)
    except OccsimError as error:  # it names arrays in px, these are in metres
        raise type(error)(str(error).replace("_px", "_m")) from None
    most = usable = metric.max_range_px
    if usable_range_m is not None:
        usable = min(checked_length("usable_range_m", usable_range_m), most)
    frame, width_px = _map_around(_corners(metric, usable), scale)
    # y down: bearings change their sign, and their order.
    scan_log = ScanLog(
        poses_to_image(metric.poses, frame).poses,
        -metric.bearings_rad[::-1],
        metric.ranges_px[:, ::-1] / scale,
        most / scale,
    )
    return MetricScans(scan_log, frame, width_px, usable)


def dump(scan_log: ScanLog, frame: MetricFrame) -> bytes:
    """Return scans as an NPZ file in metres.

    Parameters
    ----------
    scan_log : ScanLog
        Scans in px.
    frame : MetricFrame
        Where the drawing lies.

    Returns
    -------
    bytes
        Arrays ``poses_m`` (S, 3), ``bearings_rad`` (B,), ``ranges_m`` (S, B) and
        ``max_range_m``, as `metric_scans` takes them; no pickled objects.

    Raises
    ------
    TypeError
        Where an argument is of another type.

    Examples
    --------
    >>> from occsim.io.scans import dump, load, metric_scans
    >>> found = metric_scans([[4, 5, 0]], [-0.5, 0.0, 0.5], [[1, 2, 1]], 30)
    >>> again = load(dump(found.scan_log, found.frame))
    >>> again.scan_log.ranges_px.round(6)
    array([[20., 40., 20.]])
    """
    expect("scan_log", scan_log, ScanLog)
    expect("frame", frame, MetricFrame)
    scale = frame.metres_per_px
    return packed(
        {
            "poses_m": poses_to_metric(scan_log.trajectory, frame),
            "bearings_rad": -scan_log.bearings_rad[::-1],
            "ranges_m": np.ascontiguousarray(scan_log.ranges_px[:, ::-1] * scale),
            "max_range_m": np.array(scan_log.max_range_px * scale),
        }
    )


def load(
    source: bytes | str | Path,
    *,
    metres_per_px: float = 0.05,
    max_range_m: float | None = None,
    usable_range_m: float | None = None,
) -> MetricScans:
    """Return the scans of an NPZ file in metres.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is: the arrays that `dump` writes, of real
        numbers.
    metres_per_px, usable_range_m
        As in `metric_scans`.
    max_range_m : float, optional
        A reading at or beyond it is no return; by default the file's own maximum is
        how far the range finder reaches.

    Returns
    -------
    MetricScans

    Raises
    ------
    RobotFileError
        Where the file is missing, damaged or too large, or its arrays are no scans.
    ParameterError
        Where a parameter lies outside its domain.

    Examples
    --------
    >>> from occsim.io.scans import dump, load, metric_scans
    >>> found = metric_scans([[4, 5, 0]], [-0.5, 0.0, 0.5], [[1, 2, 1]], 30)
    >>> coarse = load(dump(found.scan_log, found.frame), metres_per_px=0.1)
    >>> coarse.scan_log.ranges_px.round(6)
    array([[10., 20., 10.]])
    """
    checked_length("metres_per_px", metres_per_px)
    check_lengths(max_range_m=max_range_m, usable_range_m=usable_range_m)
    data, _ = read_source(
        source,
        what="the scans",
        needed="scans as NPZ",
        max_bytes=MAX_FILE_BYTES,
        error=RobotFileError,
    )
    arrays = unpacked(
        data,
        _ARRAYS,
        what="scans",
        max_values=MAX_RANGES,
        error=RobotFileError,
        any_real=True,
    )
    if arrays["max_range_m"].size != 1:
        raise RobotFileError("max_range_m must be one number")
    most = arrays.pop("max_range_m").item()
    if max_range_m is not None and max_range_m < most:
        most = float(max_range_m)
        ranges = np.asarray(arrays["ranges_m"], dtype=np.float64)
        arrays["ranges_m"] = np.where(ranges >= most, np.inf, ranges)
    try:
        return metric_scans(
            arrays["poses_m"],
            arrays["bearings_rad"],
            arrays["ranges_m"],
            most,
            metres_per_px=metres_per_px,
            usable_range_m=usable_range_m,
        )
    except OccsimError as error:
        raise RobotFileError(str(error)) from None


def check_lengths(**given: float | None) -> None:
    """Refuse an option that is not a length in metres; one that is not given is none.

    Done first, so that a wrong option is named before a long file is read.
    """
    for name, value in given.items():
        if value is not None:
            checked_length(name, value)


def checked_length(name: str, value: object) -> float:
    """Return a length or a scale: above 0 and finite, else a `ParameterError`."""
    length = real_number(name, value)
    if not 0.0 < length < np.inf:
        raise ParameterError(f"{name} must be above 0 and finite; got {length}")
    return length


def _corners(metric: ScanLog, usable_m: float) -> FloatArray:
    """Return the least and the greatest x and y of poses and hits, (2, 2), m."""
    x, y, yaw = metric.poses.T[:, :, None]
    z = np.where(metric.is_hit, np.minimum(metric.ranges_px, usable_m), 0.0)
    bearing = yaw + metric.bearings_rad
    ends = [x + z * np.cos(bearing), y + z * np.sin(bearing)]
    return np.array(
        [[end.min() - MARGIN_M for end in ends], [end.max() + MARGIN_M for end in ends]]
    )


def _map_around(corners: FloatArray, scale: float) -> tuple[MetricFrame, int]:
    """Return the frame of a map from corner to corner, and its width, px."""
    # On whole pixels of the frame, so that two logs of a building fit.
    with np.errstate(over="ignore", invalid="ignore"):  # too large, refused below
        low, high = np.floor(corners[0] / scale), np.ceil(corners[1] / scale)
        width, height = (high - low).tolist()
        width_m, height_m = corners[1] - corners[0]
    if not width * height <= MAX_MAP_PIXELS:
        raise ParameterError(
            f"the map would span {width_m:.4g} m x {height_m:.4g} m; at {scale:g} m a "
            f"px, {MAX_MAP_PIXELS:,} px are allowed"
        )
    x_m, y_m = (round(end * scale, 9) for end in low.tolist())
    frame = MetricFrame(
        height_px=int(height), metres_per_px=scale, origin_x_m=x_m, origin_y_m=y_m
    )
    return frame, int(width)

"""What a range finder gives: bearings, and a range for each; one scan, or many."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, ShortRepr
from occsim.errors import ParameterError, real_array, real_number, whole_number
from occsim.trajectory import Trajectory

FULL_TURN_EPS = 1e-6
"""How far bearings may span more than a full turn, rad: drivers compute them in single
precision."""


@dataclass(frozen=True, eq=False, repr=False)
class Scan(ShortRepr):
    """One range for each of B beams.

    Parameters
    ----------
    bearings_rad : array_like of shape (B,)
        Where each beam points, from the robot's heading on, clockwise on the screen
        (from +x towards +y), rad. In any order, no two alike, within one turn.
    ranges_px : array_like of shape (B,)
        Distance at which each beam met something, px. Infinity is no return: the beam
        met nothing within `max_range_px`. NaN is invalid: the beam says nothing.
    max_range_px : float
        How far the range finder reaches, px, above 0 and finite.

    Raises
    ------
    TypeError
        Where the arrays do not hold real numbers.
    ParameterError
        Where their shapes do not fit, bearings are not finite, equal, or span more
        than a turn, or a range is negative or beyond the maximum.

    Examples
    --------
    >>> from occsim import Scan
    >>> Scan([-0.1, 0.0, 0.1], [30.0, float("inf"), float("nan")], 80.0)
    Scan(bearings_rad=float64[3], ranges_px=float64[3], max_range_px=80.0)
    """

    bearings_rad: FloatArray
    ranges_px: FloatArray
    max_range_px: float

    def __post_init__(self) -> None:
        bearings = _bearings(self.bearings_rad)
        ranges, most = _ranges(self.ranges_px, (bearings.size,), self.max_range_px)
        _keep(self, bearings_rad=bearings, ranges_px=ranges, max_range_px=most)

    def __len__(self) -> int:
        return self.bearings_rad.size


@dataclass(frozen=True, eq=False, repr=False)
class ScanLog(ShortRepr):
    """S scans of the same B beams, and where each was taken.

    Parameters
    ----------
    poses : array_like of shape (S, 3)
        x_px, y_px, theta_rad of each scan, S at least 1; any sub-pixel position and any
        heading. These are the poses at which the scans enter the map.
    bearings_rad : array_like of shape (B,)
        As in `Scan`.
    ranges_px : array_like of shape (S, B)
        As in `Scan`: infinity is no return, NaN invalid.
    max_range_px : float
        How far the range finder reaches, px, above 0 and finite.

    Raises
    ------
    TypeError, ParameterError
        As in `Scan`.
    TrajectoryError
        Where the poses are not finite rows of three.

    Notes
    -----
    Private copies are kept, never written to. Everything is in the image frame (y
    down); :mod:`occsim.io.carmen` converts logs in metres with y up.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import ScanLog
    >>> log = ScanLog([[50, 40, 0.0]], np.radians([-45, 0, 45]), [[9, 12, np.inf]], 80)
    >>> log.n_scans, log.n_beams
    (1, 3)
    >>> log.hit_points_px()[1]  # straight ahead
    array([62., 40.])
    """

    poses: FloatArray
    bearings_rad: FloatArray
    ranges_px: FloatArray
    max_range_px: float

    def __post_init__(self) -> None:
        poses = Trajectory(self.poses).poses
        bearings = _bearings(self.bearings_rad)
        shape = len(poses), bearings.size
        ranges, most = _ranges(self.ranges_px, shape, self.max_range_px)
        _keep(
            self,
            poses=poses,
            bearings_rad=bearings,
            ranges_px=ranges,
            max_range_px=most,
        )

    @property
    def n_scans(self) -> int:
        """Number S of scans."""
        return len(self.poses)

    @property
    def n_beams(self) -> int:
        """Number B of beams of each scan."""
        return self.bearings_rad.size

    @property
    def trajectory(self) -> Trajectory:
        """Poses of the scans."""
        return Trajectory(self.poses)

    @property
    def is_hit(self) -> BoolArray:
        """Which beams met something, ndarray of bool of shape (S, B)."""
        return np.isfinite(self.ranges_px)

    def scan(self, index: int) -> Scan:
        """Return one scan, 0 to S - 1, without its pose.

        Raises
        ------
        ParameterError
            Where there are not that many.
        """
        index = whole_number("index", index, 0, self.n_scans - 1)
        return Scan(self.bearings_rad, self.ranges_px[index], self.max_range_px)

    def every_nth(self, n: int) -> "ScanLog":
        """Return the first scan and every n-th one after it.

        Raises
        ------
        ParameterError
            Where n is not 1 or more.
        """
        n = whole_number("n", n, 1, 10**9)
        if n == 1:
            return self
        return ScanLog(
            self.poses[::n], self.bearings_rad, self.ranges_px[::n], self.max_range_px
        )

    def hit_points_px(self) -> FloatArray:
        """Return where beams met something, scan by scan.

        Returns
        -------
        ndarray of float64, shape (K, 2)
            x, y of each hit, px.
        """
        scan, beam = np.nonzero(self.is_hit)
        x, y, theta = self.poses[scan].T
        bearing, z = theta + self.bearings_rad[beam], self.ranges_px[scan, beam]
        return np.stack([x + z * np.cos(bearing), y + z * np.sin(bearing)], axis=1)


def _bearings(values: npt.ArrayLike) -> FloatArray:
    bearings = np.array(real_array("bearings_rad", values), order="C")
    if bearings.ndim != 1 or not bearings.size or not np.isfinite(bearings).all():
        raise ParameterError(
            "bearings_rad must be finite, of shape (B,) with at least one; "
            f"got shape {bearings.shape}"
        )
    ascending = np.sort(bearings)
    if (ascending[1:] == ascending[:-1]).any():
        raise ParameterError(
            "bearings_rad must differ from beam to beam; two are alike"
        )
    span = ascending[-1] - ascending[0]
    if span > 2.0 * np.pi + FULL_TURN_EPS:
        raise ParameterError(
            f"bearings_rad must lie within one turn, 2 pi; they span {span:.4g} rad"
        )
    return bearings


def _ranges(
    values: npt.ArrayLike, shape: tuple[int, ...], max_range_px: object
) -> tuple[FloatArray, float]:
    most = real_number("max_range_px", max_range_px)
    if not 0.0 < most < np.inf:
        raise ParameterError(f"max_range_px must be above 0 and finite; got {most!r}")
    ranges = np.array(real_array("ranges_px", values), order="C")
    if ranges.shape != shape:
        raise ParameterError(
            f"ranges_px must have shape {shape}, one for each beam; got {ranges.shape}"
        )
    wrong = (ranges < 0.0) | ((ranges > most) & (ranges < np.inf))
    if wrong.any():
        raise ParameterError(
            f"ranges_px must lie in 0 to max_range_px {most:g}, or be infinite (no "
            f"return) or NaN (invalid); got {ranges[wrong][0]:g}"
        )
    return ranges, most


def _keep(owner: object, **values: object) -> None:
    for name, value in values.items():
        if isinstance(value, np.ndarray):
            value.setflags(write=False)
        object.__setattr__(owner, name, value)

"""A map that grows scan by scan, as on a robot."""

import json
from pathlib import Path
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from occsim._files import read_source
from occsim._npz import packed, unpacked
from occsim._plain import plain
from occsim._types import FloatArray
from occsim.errors import (
    OccsimError,
    ParameterError,
    RobotFileError,
    choice,
    expect,
    real_array,
    real_number,
    shared_shape,
)
from occsim.evidence import PixelCounts
from occsim.grid import Grid, same_grid
from occsim.logodds import EXACT_BELOW_NATS, logit, p_free_from_log_odds
from occsim.mapping import OccupancyMap, UpdateRule
from occsim.prior import PriorMap
from occsim.scan.evidence import count_scans
from occsim.scan.log import Scan
from occsim.scan.sectors import Sectors, scan_view
from occsim.sensor import LOG_ODDS_MAX, Sensor, inverse_sensor_model
from occsim.trajectory import Trajectory

MAX_CELLS = 20_000_000
"""Most cells of a map that is loaded: one of 220 m x 220 m at 5 cm."""

MAX_FILE_BYTES = 500_000_000

_FORMAT, _VERSION = "occsim mapper", 1
_ARRAYS = {
    "about": np.uint8,
    "is_wall": np.bool_,
    "prior_p_free": np.float64,
    "log_odds": np.float64,
    "n_updates": np.int32,
}


class Mapper:
    """A map into which scans are entered one at a time.

    After any number of updates the map is, to the last bit, the one that `fuse` makes
    of `evidence_from_scans`.

    Parameters
    ----------
    grid : Grid
        The cells.
    prior_map : PriorMap
        The prior, on this grid: a drawing's, or one half for a blank map.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    sensor : Sensor, optional
        As in `evidence_from_scans`. By default all that each scan says, as far as its
        range finder reaches, with the other defaults of `Sensor`.
    saturation : float, optional
        Bound of p_free in (0.5, 1): a cell that is updated is kept within
        ``1 - saturation`` and `saturation`, so that it changes its mind sooner where
        the building changes. None, the default, is no bound. With it, the order of
        scans counts, and the map is no longer that of `fuse`.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where the prior lies on another grid, or a value outside its domain.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, Mapper, Prior, Scan, build_prior
    >>> grid = Grid(height_px=1, width_px=6, cell_px=1)
    >>> blank = build_prior(np.zeros((1, 6), bool), grid, Prior.uninformative())
    >>> mapper = Mapper(grid, blank)
    >>> scan = Scan([-0.1, 0.0, 0.1], [3.5, 3.5, 3.5], 20.0)
    >>> mapper.update((0.5, 0.5, 0.0), scan)
    >>> mapper.p_free_at([1.5, 4.5, 99.0], 0.5).round(2)
    array([0.9, 0.1, nan])
    """

    def __init__(
        self,
        grid: Grid,
        prior_map: PriorMap,
        rule: UpdateRule = UpdateRule.PRIOR_ONCE,
        *,
        sensor: Sensor | None = None,
        saturation: float | None = None,
    ) -> None:
        expect("grid", grid, Grid)
        expect("prior_map", prior_map, PriorMap)
        expect("sensor", sensor, Sensor, type(None))
        self._grid = same_grid(grid=grid, prior_map=prior_map.grid)
        self._prior_map = prior_map
        self._rule = choice("rule", rule, UpdateRule)
        self._sensor = sensor
        self._saturation = _checked_saturation(saturation)
        self._prior = prior_map.log_odds
        self._log_odds = self._prior.copy()
        self._n_updates = np.zeros(grid.shape, dtype=np.int32)
        self._known: tuple[FloatArray, float, Sectors] | None = None

    @property
    def grid(self) -> Grid:
        """The cells."""
        return self._grid

    @property
    def prior_map(self) -> PriorMap:
        """The prior."""
        return self._prior_map

    @property
    def rule(self) -> UpdateRule:
        """How a reading enters the map."""
        return self._rule

    @property
    def sensor(self) -> Sensor | None:
        """What is read from a scan, or None for all that it says."""
        return self._sensor

    @property
    def saturation(self) -> float | None:
        """Bound of p_free, or None."""
        return self._saturation

    @property
    def map(self) -> OccupancyMap:
        """The map as it stands, an `OccupancyMap` of its own."""
        return OccupancyMap(
            self._grid, self._log_odds.copy(), self._n_updates.astype(np.int64)
        )

    def update(self, pose: npt.ArrayLike, scan: Scan) -> None:
        """Enter one scan.

        Parameters
        ----------
        pose : array_like of shape (3,)
            x_px, y_px, theta_rad.
        scan : Scan
            Ranges of the beams.

        Raises
        ------
        TypeError
            Where `scan` is no `Scan`.
        TrajectoryError
            Where the pose is not three finite numbers.
        """
        expect("scan", scan, Scan)
        sensor = self._sensor or Sensor(range_px=scan.max_range_px)
        sectors = self._sectors(scan.bearings_rad, sensor.fov_rad)
        poses = Trajectory(np.reshape(real_array("pose", pose), (1, -1))).poses
        view = scan_view(poses, sectors, sensor, scan.max_range_px)
        ranges = scan.ranges_px[sectors.order][None]
        self._add(count_scans(ranges, sectors, view, sensor, self._grid, 1))

    def p_free_at(self, x_px: npt.ArrayLike, y_px: npt.ArrayLike) -> FloatArray:
        """Return the probability of free at points.

        Parameters
        ----------
        x_px, y_px : array_like
            Points in the image frame, px.

        Returns
        -------
        ndarray of float64, of the shape to which they broadcast
            NaN outside the image.
        """
        x, y = real_array("x_px", x_px), real_array("y_px", y_px)
        shared_shape(x_px=x, y_px=y)
        cell = self._grid.cell_index(x, y)
        log_odds = self._log_odds.ravel()[np.maximum(cell, 0)]
        return p_free_from_log_odds(np.where(cell < 0, np.nan, log_odds))

    def save(self, path: str | Path) -> None:
        """Write map, prior and settings into an NPZ file, without pickled objects.

        Parameters
        ----------
        path : str or Path
            The file; replaced if it is there.
        """
        about = {
            "format": _FORMAT,
            "version": _VERSION,
            "grid": plain(self._grid),
            "rule": self._rule.value,
            "sensor": None if self._sensor is None else plain(self._sensor),
            "saturation": self._saturation,
        }
        arrays = {
            "about": np.frombuffer(json.dumps(about).encode(), dtype=np.uint8),
            "is_wall": np.ascontiguousarray(self._prior_map.is_wall),
            "prior_p_free": np.ascontiguousarray(self._prior_map.p_free),
            "log_odds": self._log_odds,
            "n_updates": self._n_updates,
        }
        Path(path).write_bytes(packed(arrays))

    @classmethod
    def load(cls, source: bytes | str | Path) -> Self:
        """Return a mapper as it was saved; updates may go on.

        Parameters
        ----------
        source : bytes, str or Path
            The file's content, or where it is.

        Returns
        -------
        Mapper

        Raises
        ------
        RobotFileError
            Where the file is missing, damaged, larger than `MAX_CELLS` cells, or not
            written by `save`.
        """
        data, _ = read_source(
            source,
            what="map",
            needed="a map saved by Mapper.save",
            max_bytes=MAX_FILE_BYTES,
            error=RobotFileError,
        )
        arrays: dict[str, Any] = unpacked(
            data,
            _ARRAYS,
            what="a map saved by Mapper.save",
            max_values=MAX_CELLS,
            error=RobotFileError,
        )
        try:
            mapper = cls._restored(arrays)
        except (OccsimError, TypeError, ValueError, KeyError, RecursionError):
            raise RobotFileError(
                "the file's parts do not fit one another; a map saved by Mapper.save "
                "is needed"
            ) from None
        return mapper

    @classmethod
    def _restored(cls, arrays: dict[str, Any]) -> Self:
        about = json.loads(bytes(arrays["about"][:10_000]))
        if (about["format"], about["version"]) != (_FORMAT, _VERSION):
            raise ValueError("another format")
        grid = Grid(**about["grid"])
        prior_map = PriorMap(grid, arrays["is_wall"], arrays["prior_p_free"])
        sensor = None if about["sensor"] is None else Sensor(**about["sensor"])
        mapper = cls(
            grid,
            prior_map,
            about["rule"],
            sensor=sensor,
            saturation=about["saturation"],
        )
        log_odds, n_updates = arrays["log_odds"], arrays["n_updates"]
        if not log_odds.shape == n_updates.shape == grid.shape or n_updates.min() < 0:
            raise ValueError("another shape, or counts below zero")
        if not (np.abs(log_odds) < EXACT_BELOW_NATS).all():
            raise ValueError("log-odds out of bounds")
        mapper._log_odds, mapper._n_updates = log_odds.copy(), n_updates.copy()
        return mapper

    def _sectors(self, bearings_rad: FloatArray, fov_rad: float) -> Sectors:
        # A robot's beams are the same in every scan.
        known = self._known
        if known is None or known[1] != fov_rad or not _same(known[0], bearings_rad):
            sectors = Sectors.of(bearings_rad, fov_rad)
            self._known = known = bearings_rad, fov_rad, sectors
        return known[2]

    def _add(self, counts: PixelCounts) -> None:
        windows = counts.windows
        n_empty, n_object = counts.n_empty, counts.n_object
        if self._grid.cell_px == 1:
            # One pixel a cell: Eq. 4.22 has no mixed case, and its ends are opposite.
            in_view = n_empty | n_object
            reading = (n_empty - n_object) * LOG_ODDS_MAX
        else:
            in_view = ((n_empty | n_object) != 0).astype(np.int32)
            reading = inverse_sensor_model(n_empty, n_object) * in_view
        # Each window has a spare column on the right.
        height, width = shape = windows.n_rows, windows.n_cols
        in_view = in_view.reshape(shape)[:, :-1]
        row, col = int(windows.first_row[0]), int(windows.first_col[0])
        place = np.s_[row : row + height, col : col + width - 1]
        self._n_updates[place] += in_view
        cells = self._log_odds[place]
        cells += reading.reshape(shape)[:, :-1]
        if self._rule is UpdateRule.SUBTRACT_PRIOR:
            cells -= self._prior[place] * in_view
        if self._saturation is not None:
            bound = logit(self._saturation)
            np.copyto(cells, np.clip(cells, -bound, bound), where=in_view != 0)


def _same(ours: FloatArray, theirs: FloatArray) -> bool:
    return ours is theirs or np.array_equal(ours, theirs)


def _checked_saturation(value: object) -> float | None:
    if value is None:
        return None
    bound = real_number("saturation", value)
    if not 0.5 < bound < 1.0:
        raise ParameterError(f"saturation must lie in (0.5, 1); got {bound}")
    return bound

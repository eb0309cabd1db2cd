"""The content of a trajectory file: numbers, and what is known about their units."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.io.metric import MetricFrame, poses_to_image
from occsim.trajectory import Trajectory

MAX_FILE_BYTES = 20_000_000
"""Largest file, bytes."""

MAX_POSES = 50_000
"""Most poses in a file: ten times the longest tour that maps at interactive speed."""

MAX_POSITION = 1e9
"""Largest coordinate, in px or m; sums and squares of it are still exact enough."""

MAX_HEADING = 1e6
"""Largest heading, in radians or degrees: floats beyond it do not resolve a turn."""

# A heading may be written as a full turn; text rounds it.
_FULL_TURN_RAD = 2.0 * np.pi + 1e-3


@dataclass(frozen=True, eq=False, kw_only=True)
class TrajectoryTable:
    """The poses of a file, unconverted.

    Parameters
    ----------
    values : ndarray of float64, shape (S, 3)
        Columns x, y, theta, in the units of the file.
    degrees : bool or None
        Whether the file says that headings are in degrees (True) or radians
        (False); None where it does not say.
    metres : bool
        Whether the file says that positions are in metres, y up.
    pixels : bool
        Whether it says that they are in px; where it says neither, px are assumed,
        unless a frame is given.
    name : str
        What to call the file.

    Examples
    --------
    >>> from occsim import Trajectory, TrajectoryFormat, dump_trajectory
    >>> from occsim.io.trajectories import read_trajectory_table
    >>> data = dump_trajectory(Trajectory([(1.0, 2.0, 0.5)]), TrajectoryFormat.CSV)
    >>> table = read_trajectory_table(data)
    >>> table.values, table.degrees
    (array([[1. , 2. , 0.5]]), False)
    """

    values: FloatArray
    degrees: bool | None = None
    metres: bool = False
    pixels: bool = False
    name: str = "trajectory"

    @property
    def needs_angle_unit(self) -> bool:
        """Whether the user must be asked for the unit of the headings."""
        return self.degrees is None

    def to_trajectory(
        self, degrees: bool | None = None, frame: MetricFrame | None = None
    ) -> Trajectory:
        """Return the trajectory, once the units are known.

        Parameters
        ----------
        degrees : bool, optional
            Whether headings are in degrees; overrides what the file says.
            By default what the file says; where it says nothing, radians, as long
            as every heading lies within one turn either way.
        frame : MetricFrame, optional
            Where the drawing lies, for positions in metres with y up.

        Returns
        -------
        Trajectory
            Positions in px, y down; headings in radians.

        Raises
        ------
        TrajectoryError
            Where positions are in metres and no frame is given, or in px and one is;
            where the headings reach beyond one turn in radians and neither the file
            nor the caller gives their unit.
        """
        self._check_frame(frame)
        unit = self.degrees if degrees is None else degrees
        poses = self.values.copy()
        if unit is None:
            self._require_within_a_turn()
        elif unit:
            poses[:, 2] = np.radians(poses[:, 2])
        return (
            Trajectory(poses=poses) if frame is None else poses_to_image(poses, frame)
        )

    def _check_frame(self, frame: MetricFrame | None) -> None:
        if frame is not None and not isinstance(frame, MetricFrame):
            raise TypeError(f"frame must be a MetricFrame; got {type(frame).__name__}")
        if self.metres and frame is None:
            raise TrajectoryError(
                f"positions in {self.name} are in metres; px in the drawing are needed "
                "(columns x_px, y_px), or its scale, metres per px, and where its "
                "lower left corner lies (a MetricFrame)"
            )
        if self.pixels and frame is not None:
            raise TrajectoryError(
                f"positions in {self.name} are in px; a frame is for metres"
            )

    def _require_within_a_turn(self) -> None:
        row = int(np.argmax(np.abs(self.values[:, 2])))
        theta = float(self.values[row, 2])
        if abs(theta) > _FULL_TURN_RAD:
            raise TrajectoryError(
                f"{self.name} does not say whether headings are in degrees or "
                f"radians, and pose {row + 1} has {theta:g}, beyond one turn in "
                "radians; name the column theta_deg or theta_rad, or choose the unit"
            )


def table_from(values: FloatArray, units: dict[str, str], name: str) -> TrajectoryTable:
    """Return the table of some values whose units are known by axis.

    Parameters
    ----------
    values : ndarray of float64, shape (S, 3)
        Columns x, y, theta.
    units : dict of str
        By axis, as `PoseColumns.units` gives them; may be empty.
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
        Where there is no pose, too many, or one is not finite or far too large.
    """
    check_count(len(values), name)
    limits = [MAX_POSITION, MAX_POSITION, MAX_HEADING]
    good = (np.abs(values) <= limits).all(axis=1)  # also false for NaN
    if not good.all():
        row = int(np.argmin(good))
        raise TrajectoryError(
            f"{name}, pose {row + 1}: every number must be finite, positions at most "
            f"{MAX_POSITION:g} and headings {MAX_HEADING:g}; "
            f"got {', '.join(f'{value:g}' for value in values[row])}"
        )
    lengths = units.get("x"), units.get("y")
    return TrajectoryTable(
        values=values,
        degrees={"deg": True, "rad": False}.get(units.get("theta", "")),
        metres="m" in lengths,
        pixels="px" in lengths,
        name=name,
    )


def check_count(n_poses: int, name: str) -> None:
    """Refuse a file with no pose, or with too many.

    Parameters
    ----------
    n_poses : int
        Poses in the file.
    name : str
        What to call the file.

    Raises
    ------
    TrajectoryError
    """
    if n_poses < 1:
        raise TrajectoryError(
            f"{name} has no poses; at least one row of x, y, theta is needed"
        )
    if n_poses > MAX_POSES:
        raise TrajectoryError(
            f"{name} has {n_poses:,} poses; at most {MAX_POSES:,} are allowed"
        )


def check_array(shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> None:
    """Refuse an array whose header shows that it is not a table of poses.

    Parameters
    ----------
    shape : tuple of int
        The array's.
    dtype : numpy.dtype
        Of its elements.
    name : str
        What to call the file.

    Raises
    ------
    TrajectoryError
    """
    # NumPy's header accepts True as a number of rows.
    if len(shape) != 2 or shape[1] != 3 or isinstance(shape[0], bool):
        raise TrajectoryError(
            f"the array in {name} must have shape (S, 3), rows of x, y, theta; "
            f"got {tuple(shape)}"
        )
    if dtype.kind not in "iuf":
        raise TrajectoryError(
            f"the array in {name} must hold real numbers; got {dtype}"
        )
    check_count(shape[0], name)

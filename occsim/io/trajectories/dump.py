"""A trajectory as the content of a file."""

import io
import json
from collections.abc import Callable
from enum import Enum

import numpy as np

from occsim._types import FloatArray
from occsim.errors import choice
from occsim.trajectory import Trajectory


class TrajectoryFormat(Enum):
    """Formats of trajectory files; the value is the suffix.

    Examples
    --------
    >>> from occsim import Trajectory, TrajectoryFormat, dump_trajectory
    >>> one = Trajectory([(1.0, 2.0, 0.0)])
    >>> dump_trajectory(one, TrajectoryFormat.CSV).decode().split()
    ['x_px,y_px,theta_rad', '1.0,2.0,0.0']
    """

    CSV = "csv"
    """Comma-separated, with a header that names the columns and their units."""
    TXT = "txt"
    """Separated by spaces, the header as a comment."""
    NPY = "npy"
    """A NumPy array of shape (S, 3); it does not state units."""
    MAT = "mat"
    """MATLAB 5: an array of shape (S, 3), ``trajectory_rad`` or ``trajectory_deg``."""
    JSON = "json"
    """An object of column titles and poses."""
    TUM = "tum"
    """timestamp tx_px ty_px tz_px qx qy qz qw, the reading's number for the time."""


def dump_trajectory(
    trajectory: Trajectory, file_format: TrajectoryFormat, *, degrees: bool = False
) -> bytes:
    """Return the content of a trajectory file.

    Parameters
    ----------
    trajectory : Trajectory
        S poses.
    file_format : TrajectoryFormat
        Which kind of file.
    degrees : bool, default False
        Whether headings are written in degrees. TUM has quaternions instead.

    Returns
    -------
    bytes
        What `load_trajectory` reads back: positions exactly; headings exactly in
        radians, to rounding in degrees, and modulo a turn from TUM.

    Raises
    ------
    ParameterError
        Where `file_format` is no `TrajectoryFormat`.

    Examples
    --------
    >>> from occsim import Trajectory, TrajectoryFormat
    >>> from occsim import dump_trajectory, load_trajectory
    >>> one = Trajectory([(1.0, 2.0, 0.5)])
    >>> data = dump_trajectory(one, TrajectoryFormat.CSV)
    >>> load_trajectory(data, name="one.csv").poses
    array([[1. , 2. , 0.5]])
    """
    file_format = choice("file_format", file_format, TrajectoryFormat)
    table = np.array(trajectory.poses)
    if degrees and file_format is not TrajectoryFormat.TUM:
        table[:, 2] = np.degrees(table[:, 2])
    return _WRITERS[file_format](table, "theta_deg" if degrees else "theta_rad")


def _csv(table: FloatArray, angle: str) -> bytes:
    return _lines(["x_px,y_px," + angle], table, ",")


def _txt(table: FloatArray, angle: str) -> bytes:
    return _lines([f"# x_px y_px {angle}"], table, " ")


def _tum(table: FloatArray, _angle: str) -> bytes:
    x, y, theta = table.T
    zero = np.zeros(len(table))
    half = 0.5 * theta
    time_s = np.arange(len(table), dtype=np.float64)
    columns = [time_s, x, y, zero, zero, zero, np.sin(half), np.cos(half)]
    # Without units, readers assume metres; so does this library's.
    header = "# timestamp tx_px ty_px tz_px qx qy qz qw"
    return _lines([header], np.stack(columns, axis=1), " ")


def _lines(header: list[str], table: FloatArray, delimiter: str) -> bytes:
    # repr is the shortest text that reads back as the same number.
    rows = [delimiter.join(map(repr, row)) for row in table.tolist()]
    return ("\n".join(header + rows) + "\n").encode("ascii")


def _json(table: FloatArray, angle: str) -> bytes:
    content = {"columns": ["x_px", "y_px", angle], "poses": table.tolist()}
    return json.dumps(content).encode("ascii")


def _npy(table: FloatArray, _angle: str) -> bytes:
    out = io.BytesIO()
    np.save(out, table, allow_pickle=False)
    return out.getvalue()


def _mat(table: FloatArray, angle: str) -> bytes:
    import scipy.io  # here, because few trajectories become MAT files

    out = io.BytesIO()
    variable = angle.replace("theta", "trajectory")
    scipy.io.savemat(out, {variable: table}, do_compression=True)
    return out.getvalue()


_WRITERS: dict[TrajectoryFormat, Callable[[FloatArray, str], bytes]] = {
    TrajectoryFormat.CSV: _csv,
    TrajectoryFormat.TXT: _txt,
    TrajectoryFormat.NPY: _npy,
    TrajectoryFormat.MAT: _mat,
    TrajectoryFormat.JSON: _json,
    TrajectoryFormat.TUM: _tum,
}

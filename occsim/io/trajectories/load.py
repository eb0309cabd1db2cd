"""A trajectory from a file of any of the formats."""

from pathlib import Path

from occsim._files import printable, read_source
from occsim.errors import TrajectoryError
from occsim.imaging import FileKind, kind_of_file
from occsim.io.metric import MetricFrame
from occsim.io.trajectories.arrays import NPY_MARK, parse_json, parse_npy
from occsim.io.trajectories.mat import (
    HDF5_MARK,
    MATLAB_5_MARK,
    MATLAB_73_MARK,
    parse_mat,
)
from occsim.io.trajectories.table import MAX_FILE_BYTES, TrajectoryTable
from occsim.io.trajectories.text import parse_text
from occsim.trajectory import Trajectory


def load_trajectory(
    source: bytes | str | Path,
    *,
    name: str | None = None,
    degrees: bool | None = None,
    frame: MetricFrame | None = None,
) -> Trajectory:
    r"""Return the trajectory in a CSV, plain text, NPY, MAT, JSON, TUM or KITTI file.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        The file's name, for messages and to tell MAT 4 and TUM files by their
        suffix.
    degrees : bool, optional
        Whether headings are in degrees; overrides what the file says. By default
        what the file says (``theta_deg``, ``theta [rad]``); where it says nothing,
        radians, as long as every heading lies within one turn either way.
    frame : MetricFrame, optional
        Where the drawing lies, for a file in metres with y up.

    Returns
    -------
    Trajectory
        Positions in px, headings in radians.

    Raises
    ------
    TrajectoryError
        Where the file is missing, empty, over 20 MB or 50,000 poses, damaged or of
        another format; where a row has too few columns, a word, NaN or an infinite
        number; where positions are in metres and no frame is given; where the unit of
        the headings is unknown.

    Notes
    -----
    A file with a header is read by its titles, in any order; without units, positions
    are px. Quaternions are robots' and mean metres, in TUM, EuRoC and KITTI files too,
    unless the titles say px, as those that `dump_trajectory` writes do.

    Examples
    --------
    >>> load_trajectory(b"theta_deg,y,x\n90,20,10\n").poses[0, :2]
    array([10., 20.])
    >>> frame = MetricFrame(height_px=100, metres_per_px=0.05)
    >>> load_trajectory(b"x_m,y_m,yaw_rad\n1,2,0\n", frame=frame).poses[0]
    array([20., 60.,  0.])
    """
    return read_trajectory_table(source, name=name).to_trajectory(degrees, frame)


def read_trajectory_table(
    source: bytes | str | Path, *, name: str | None = None
) -> TrajectoryTable:
    """Return the numbers of a trajectory file, and the units that it states.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        As in `load_trajectory`.

    Returns
    -------
    TrajectoryTable
        Its `needs_angle_unit` says whether the user must be asked for the unit.

    Raises
    ------
    TrajectoryError
        As in `load_trajectory`.

    Examples
    --------
    >>> from occsim.io.trajectories import read_trajectory_table
    >>> read_trajectory_table(b"1 2 90").needs_angle_unit
    True
    """
    data, file_name = read_source(
        source,
        what=printable(name or "trajectory"),
        needed="a table of x, y, theta",
        max_bytes=MAX_FILE_BYTES,
        error=TrajectoryError,
    )
    name = printable(name or file_name)
    if data.startswith(NPY_MARK):
        return parse_npy(data, name)
    marks = (MATLAB_5_MARK, MATLAB_73_MARK, HDF5_MARK)
    if data.startswith(marks) or name.lower().endswith(".mat"):
        return parse_mat(data, name)
    kind = kind_of_file(data, name)
    if kind not in (FileKind.TEXT, FileKind.UNKNOWN):
        raise TrajectoryError(
            f"{name} is {kind.about}, not a trajectory; {kind.advice}"
        )
    start = data[:200].removeprefix(b"\xef\xbb\xbf").lstrip()
    if start.startswith((b"[", b"{")) or name.lower().endswith(".json"):
        return parse_json(data, name)
    return parse_text(data, name)

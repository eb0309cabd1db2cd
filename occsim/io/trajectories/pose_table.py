"""A trajectory as columns of numbers, as a person edits it in a table."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from occsim.errors import TrajectoryError
from occsim.trajectory import Trajectory

COLUMNS = ("x_px", "y_px", "theta_deg")


def pose_columns(trajectory: Trajectory) -> dict[str, list[float]]:
    """Return the columns of a table of poses.

    Parameters
    ----------
    trajectory : Trajectory
        S poses.

    Returns
    -------
    dict of list of float
        S values each of ``x_px``, ``y_px`` and ``theta_deg``.
    """
    x, y, theta = trajectory.poses.T
    return dict(
        zip(COLUMNS, (x.tolist(), y.tolist(), np.degrees(theta).tolist()), strict=True)
    )


def trajectory_from_columns(
    columns: Mapping[str, Sequence[float | None]],
) -> Trajectory:
    """Return the trajectory of an edited table.

    Parameters
    ----------
    columns : mapping of str to sequence of float or None
        As `pose_columns` gives them; None or NaN where a value is missing. Rows
        without any value, as an editor leaves them at the end, are left out.

    Returns
    -------
    Trajectory

    Raises
    ------
    TrajectoryError
        Where a row has some of its values only, or no row is left.
    """
    rows = list(zip(*(columns[name] for name in COLUMNS), strict=True))
    kept: list[list[float]] = []
    for number, row in enumerate(rows, start=1):
        values = [value for value in row if value is not None and not math.isnan(value)]
        if values and len(values) < len(COLUMNS):
            raise TrajectoryError(
                f"row {number} needs x, y and a heading; "
                f"got {len(values)} of the three values"
            )
        if values:
            kept.append([values[0], values[1], math.radians(values[2])])
    if not kept:
        raise TrajectoryError(
            "a trajectory needs at least one pose; got an empty table"
        )
    return Trajectory(poses=np.array(kept))

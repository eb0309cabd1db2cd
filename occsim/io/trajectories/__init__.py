"""Trajectory files: CSV and plain text, NPY, MAT, JSON and TUM, each way.

Positions in a file are px in the image frame, headings degrees or radians as the file
says. Metric frames with y up are for :mod:`occsim.io.metric`. Files are not trusted,
and every failure is a `TrajectoryError` of one sentence.
"""

from occsim.io.trajectories.dump import TrajectoryFormat, dump_trajectory
from occsim.io.trajectories.load import load_trajectory, read_trajectory_table
from occsim.io.trajectories.table import (
    MAX_FILE_BYTES,
    MAX_POSES,
    TrajectoryTable,
)

__all__ = [
    "MAX_FILE_BYTES",
    "MAX_POSES",
    "TrajectoryFormat",
    "TrajectoryTable",
    "dump_trajectory",
    "load_trajectory",
    "read_trajectory_table",
]

"""What a bag may hold, and what is asked of it; imports little, for its process."""

from enum import Enum

import numpy as np

MAX_FILE_BYTES = 200_000_000
MAX_SECONDS = 60.0
"""Longest that a bag may take to read, s; 3.6 million ranges take 5."""

MAX_MEMORY_BYTES = 1_500_000_000
"""Address space of the process: the program takes half a GB, ranges and what holds them
the rest."""

MAX_SCANS = 200_000
MAX_BEAMS = 20_000
MAX_TRANSFORMS = 2_000_000
MAX_FRAMES = 1_000

ARRAYS = {
    "times_s": np.float64,
    "poses_m": np.float64,
    "bearings_rad": np.float64,
    "ranges_m": np.float32,
    "max_range_m": np.float64,
}
"""What the process that reads a bag hands over."""


class PoseSource(Enum):
    """What says where the scans of a bag were taken.

    Examples
    --------
    >>> from occsim.io.bags import PoseSource
    >>> PoseSource("odometry")
    <PoseSource.ODOMETRY: 'odometry'>
    """

    AUTO = "auto"
    """Transforms where they lead to the range finder and any of them moves, else
    odometry."""
    TRANSFORMS = "transforms"
    """Topics tf and tf_static, from their uppermost frame to the range finder's."""
    ODOMETRY = "odometry"
    """nav_msgs/Odometry, and tf_static for where the range finder sits, if known."""

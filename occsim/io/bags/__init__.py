"""Bags of ROS 1 and ROS 2: scans of laser range finders, and where they were taken.

Needs `rosbags`, the extra ``ros``, and no ROS. Bags are not trusted: they are read in a
process of their own, with bounds of time and memory.
"""

from occsim.io.bags.limits import MAX_FILE_BYTES, PoseSource
from occsim.io.bags.load import BagLog, is_readable, load
from occsim.io.bags.parts import is_bag, join

__all__ = [
    "MAX_FILE_BYTES",
    "BagLog",
    "PoseSource",
    "is_bag",
    "is_readable",
    "join",
    "load",
]

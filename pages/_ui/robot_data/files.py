"""The contents of files to download."""

from occsim import OccupancyMap
from occsim.io import ros_map
from occsim.io.images import png
from occsim.io.map_arrays import map_npz
from occsim.io.map_pictures import belief_picture
from occsim.io.metric import MetricFrame
from occsim.io.ros_map import MapMode, RosMap

MODES = {"trinary": MapMode.TRINARY, "percentages": MapMode.RAW}
"""How the values of a map are written, by the word on the screen."""


def zipped(of: RosMap, name: str, mode: MapMode) -> bytes:
    """A ROS map as one file: its yaml and its image."""
    return ros_map.pack(of, name, mode=mode)


def ros_trinary(occupancy_map: OccupancyMap, frame: MetricFrame) -> bytes:
    """The map as ROS programs read it: occupied, free, unknown."""
    return zipped(RosMap.of_map(occupancy_map, frame), "map", MapMode.TRINARY)


def ros_raw(occupancy_map: OccupancyMap, frame: MetricFrame) -> bytes:
    """The map with its percentages."""
    return zipped(RosMap.of_map(occupancy_map, frame), "map", MapMode.RAW)


def picture(occupancy_map: OccupancyMap, frame: MetricFrame) -> bytes:
    """The map in grey."""
    return png(belief_picture(occupancy_map.p_free, occupancy_map.grid))


def arrays(occupancy_map: OccupancyMap, frame: MetricFrame) -> bytes:
    """The map's numbers, exact, and where it lies."""
    return map_npz(occupancy_map, frame)

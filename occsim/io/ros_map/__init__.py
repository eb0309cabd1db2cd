"""Maps of ROS map_server, a ``.yaml`` and an image, each way; no ROS is needed."""

from occsim.io.ros_map.building import building_from_map, map_drawing
from occsim.io.ros_map.files import dump, load, save
from occsim.io.ros_map.meta import MapMode
from occsim.io.ros_map.packing import load_files, map_names, pack
from occsim.io.ros_map.ros_map import RosMap

__all__ = [
    "MapMode",
    "RosMap",
    "building_from_map",
    "dump",
    "load",
    "load_files",
    "map_drawing",
    "map_names",
    "pack",
    "save",
]

"""A ROS map as a building: its own walls, its scale, and a tour of its free space."""

import numpy as np

from occsim.building import (
    TOUR_READINGS,
    Building,
)
from occsim.errors import expect
from occsim.imaging import MAX_SIDE_PX, Drawing
from occsim.imaging.transform import Transform
from occsim.io.ros_map.files import LEVEL_FREE, LEVEL_UNKNOWN
from occsim.io.ros_map.ros_map import OCCUPIED, RosMap
from occsim.sensor import Sensor
from occsim.tour import default_tour
from occsim.world import World

RANGE_M = 4.0
"""Reach of the sensor that is proposed, m: a usual small range finder's."""


def building_from_map(
    ros_map: RosMap, name: str = "map", *, working_px: int = MAX_SIDE_PX
) -> Building:
    """Return a ROS map as a drawing that can be mapped.

    Parameters
    ----------
    ros_map : RosMap
        What is rather occupied than free is wall; no walls are looked for.
    name : str, default "map"
        What to call it on screen.
    working_px : int, optional
        Longer side to which a larger map is scaled down, px; by default it is not.

    Returns
    -------
    Building
        With the map's scale, and with what it does not know. The tour keeps out of
        that; the sensor sees through it, for nothing is known to stand there.

    Raises
    ------
    TypeError
        Where `ros_map` is of another type.
    TrajectoryError
        Where the map has no free space to drive in.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim.io.ros_map import RosMap, building_from_map
    >>> values = np.zeros((60, 80), dtype=int)
    >>> values[:, [0, -1]] = values[[0, -1], :] = 100
    >>> building_from_map(RosMap(values, 0.05)).metres_per_px
    0.05
    """
    expect("ros_map", ros_map, RosMap)
    fit = Transform.fit(ros_map.values.shape, working_px)
    walls = fit.mask(ros_map.is_occupied)
    unknown = fit.mask(ros_map.is_unknown)
    scale = ros_map.resolution_m / fit.scale
    sensor = Sensor(range_px=RANGE_M / scale)
    tour = default_tour(World(walls | unknown), sensor, max_readings=TOUR_READINGS)
    return Building(
        drawing=fit.drawing(map_drawing(ros_map, name)),
        found=walls,
        unknown=unknown if unknown.any() else None,
        trajectory=tour,
        sensor=sensor,
        metres_per_px=scale,
        title=name,
        about=f"A robot's map, {ros_map.resolution_m:g} m a pixel.",
    )


def map_drawing(ros_map: RosMap, name: str = "map") -> Drawing:
    """Return a map as map_server draws it: black walls, white space, grey unknown."""
    shades = np.rint(LEVEL_FREE * (1.0 - np.maximum(ros_map.values, 0) / OCCUPIED))
    grey = np.where(ros_map.is_unknown, LEVEL_UNKNOWN, shades).astype(np.uint8)
    return Drawing(rgb=np.dstack([grey, grey, grey]), name=name)

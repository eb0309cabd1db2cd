"""The small world in which one reading is looked at pixel by pixel."""

from functools import lru_cache

import numpy as np

from occsim.world import World

CELL_PX = 4
RANGE_PX = 36.0


@lru_cache(maxsize=1)
def lens_world() -> World:
    """Return the world of the lens: 48 x 32 px.

    Returns
    -------
    World
        A wall with a door, off the lines of the cells; a partition; a pillar.

    Examples
    --------
    >>> lens_world().shape
    (32, 48)
    """
    occupied = np.zeros((32, 48), dtype=np.bool_)
    occupied[:, 38:41] = True
    occupied[12:20, 38:41] = False
    occupied[22:24, :38] = True
    occupied[5:8, 22:25] = True
    return World(occupied=occupied)

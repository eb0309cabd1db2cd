"""A small world for one reading at pixel level."""

from functools import lru_cache

import numpy as np

from occsim.world import World

SHAPE_PX = 32, 48


@lru_cache(maxsize=1)
def lens_world() -> World:
    """Return the world in which one reading is looked at pixel by pixel.

    Returns
    -------
    World
        32 rows and 48 columns of pixels: a wall in columns 38 to 40, off the lines of
        cells of 4 px, with a door in rows 12 to 19; a partition in rows 22 and 23,
        columns 12 to 37; a pillar in rows 5 to 7, columns 22 to 24.

    Examples
    --------
    >>> from occsim import lens_world
    >>> world = lens_world()
    >>> world.shape, int(world.occupied.sum())  # 3 * 24 + 2 * 26 + 3 * 3
    ((32, 48), 133)
    """
    occupied = np.zeros(SHAPE_PX, dtype=np.bool_)
    occupied[:, 38:41] = True
    occupied[12:20, 38:41] = False
    occupied[22:24, 12:38] = True
    occupied[5:8, 22:25] = True
    return World(occupied=occupied)

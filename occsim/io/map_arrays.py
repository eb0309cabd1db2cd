"""A map as arrays, with where it lies: for other programs."""

import numpy as np

from occsim._npz import packed
from occsim.errors import expect
from occsim.io.metric import MetricFrame
from occsim.mapping import OccupancyMap


def map_npz(occupancy_map: OccupancyMap, frame: MetricFrame) -> bytes:
    """Return a map as an NPZ file; it holds no pickled objects.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.
    frame : MetricFrame
        Where its drawing lies.

    Returns
    -------
    bytes
        ``log_odds`` of free, nats, ``p_free`` and ``n_updates``, each (R, C), the top
        row first; ``cell_m``, the side of a cell, m; ``origin_m_rad`` (3,), x, y and
        turn of the lower left corner of the drawing.

    Raises
    ------
    TypeError
        Where an argument is of another type.

    Examples
    --------
    >>> import io
    >>> import numpy as np
    >>> from occsim import Grid
    >>> from occsim.io.map_arrays import map_npz
    >>> from occsim.io.metric import MetricFrame
    >>> from occsim.mapping import OccupancyMap
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> one = OccupancyMap(grid, np.zeros((1, 2)), np.zeros((1, 2), dtype=np.int64))
    >>> data = map_npz(one, MetricFrame(height_px=1, metres_per_px=0.05))
    >>> np.load(io.BytesIO(data))["p_free"]
    array([[0.5, 0.5]])
    """
    expect("occupancy_map", occupancy_map, OccupancyMap)
    expect("frame", frame, MetricFrame)
    origin = frame.origin_x_m, frame.origin_y_m, frame.origin_yaw_rad
    return packed(
        {
            "log_odds": occupancy_map.log_odds,
            "p_free": occupancy_map.p_free,
            "n_updates": occupancy_map.n_updates,
            "cell_m": np.array(occupancy_map.grid.cell_px * frame.metres_per_px),
            "origin_m_rad": np.array(origin),
        }
    )

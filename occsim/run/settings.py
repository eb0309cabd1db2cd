"""How a building is mapped."""

from dataclasses import dataclass

from occsim.errors import ParameterError
from occsim.grid import Grid
from occsim.sensor import Sensor


@dataclass(frozen=True, kw_only=True, slots=True)
class MapSettings:
    """Settings of a mapping run.

    Parameters
    ----------
    cell_px : int, default 3
        Side of a cell, px.
    sensor : Sensor
        Range, field of view, and what is said of pixels behind a hit.
    wall_share, truth_share : float, default 0
        Share of wall pixels that a cell of the drawing, and of the ground truth, must
        exceed to be a wall cell, in [0, 1).

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    Examples
    --------
    >>> from occsim import MapSettings, Sensor
    >>> MapSettings(cell_px=5, sensor=Sensor(range_px=40.0)).sensor.range_px
    40.0
    """

    cell_px: int = 3
    sensor: Sensor = Sensor()
    wall_share: float = 0.0
    truth_share: float = 0.0

    def __post_init__(self) -> None:
        Grid(height_px=1, width_px=1, cell_px=self.cell_px)
        for name in ("wall_share", "truth_share"):
            value = getattr(self, name)
            if not 0.0 <= value < 1.0:
                raise ParameterError(f"{name} must lie in [0, 1); got {value!r}")

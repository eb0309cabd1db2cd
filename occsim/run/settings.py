"""How a building is mapped."""

from dataclasses import dataclass

from occsim.errors import ParameterError, expect, whole_number
from occsim.grid import Grid
from occsim.scan import ScanNoise
from occsim.scan.simulate import MAX_BEAMS
from occsim.sensor import Sensor

MAX_SEED = 2**32 - 1


@dataclass(frozen=True, kw_only=True, slots=True)
class ScanSettings:
    """How a range finder takes the readings of a run, beam by beam.

    Parameters
    ----------
    n_beams : int
        Beams of a scan, 1 to 100,000, spread over the sensor's field of view.
    noise : ScanNoise, optional
        Errors; none by default. A run takes its scale from the building.
    seed : int, default 0
        Of the errors.

    Raises
    ------
    TypeError, ParameterError
        Where a value is of another type or outside its domain.

    Examples
    --------
    >>> from occsim import MapSettings, ScanNoise, ScanSettings
    >>> noise = ScanNoise(metres_per_px=0.05, dropout_share=0.1)
    >>> MapSettings(scan=ScanSettings(n_beams=180, noise=noise)).scan.seed
    0
    """

    n_beams: int
    noise: ScanNoise | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        whole_number("n_beams", self.n_beams, 1, MAX_BEAMS)
        expect("noise", self.noise, ScanNoise, type(None))
        whole_number("seed", self.seed, 0, MAX_SEED)


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
    scan : ScanSettings, optional
        Readings beam by beam, with errors. By default they are exact for every pixel.

    Raises
    ------
    TypeError, ParameterError
        Where a value is of another type or lies outside its domain.

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
    scan: ScanSettings | None = None

    def __post_init__(self) -> None:
        expect("scan", self.scan, ScanSettings, type(None))
        Grid(height_px=1, width_px=1, cell_px=self.cell_px)
        for name in ("wall_share", "truth_share"):
            value = getattr(self, name)
            if not 0.0 <= value < 1.0:
                raise ParameterError(f"{name} must lie in [0, 1); got {value!r}")

"""The settings of the cells, the sensor and its errors."""

import math
from dataclasses import dataclass

from occsim import BehindHit, ScanNoise, ScanSettings, Sensor
from occsim.scan import RANGE_FINDERS
from pages._ui.settings.declared import error, setting

NO_NOISE = ScanNoise(metres_per_px=1.0)
MOST_BEAMS = max(one.n_beams for one in RANGE_FINDERS.values())


@dataclass(frozen=True, kw_only=True)
class ReadingSettings:
    """How the robot takes its readings."""

    cell_px: int = setting(
        3,
        label="Cell size",
        unit="px",
        low=1,
        high=20,
        help="Side of one map cell in pixels of the drawing. Small cells show more "
        "detail; large ones gather more readings each.",
    )
    range_px: int = setting(
        40,
        label="Range",
        unit="px",
        low=5,
        high=300,
        help="How far the sensor reaches, in pixels of the drawing. The source sets it "
        "to the length of a door.",
    )
    fov_deg: int = setting(
        30,
        label="Field of view",
        unit="degrees",
        low=5,
        high=360,
        help="Full opening angle of the sensor's cone. The source's camera has 30 "
        "degrees; a turning laser scanner has 360.",
    )
    behind_hit: BehindHit = setting(
        BehindHit.OCCUPIED,
        label="Behind a hit",
        help="What a reading says of the pixels behind the wall that it meets.",
    )
    clear_no_hit: bool = setting(
        True,
        label="A ray that meets nothing clears its pixels",
        help="On, a ray that meets no wall within range counts all of its pixels as "
        "empty. Off, it says nothing, as many real range finders do.",
    )
    beams: int = setting(
        0,
        label="Beams of a scan",
        high=MOST_BEAMS,
        help="A real range finder measures along single beams. 0: every pixel is "
        "looked at, exactly.",
    )
    sigma_0_m: float = error(
        "sigma_0_m",
        label="Range noise",
        unit="m",
        help="Standard deviation of a measured range.",
    )
    sigma_2_per_m: float = error(
        "sigma_2_per_m",
        label="Its growth",
        unit="per m",
        help="What the square of the range adds to that standard deviation.",
    )
    sigma_from_m: float = error(
        "sigma_from_m",
        label="Growth begins at",
        unit="m",
        help="Nearer than this the range noise does not grow.",
    )
    dropout_share: float = error(
        "dropout_share",
        label="Dropped returns",
        help="Share of hits that give no return: black or shiny surfaces.",
    )
    short_share: float = error(
        "short_share",
        label="Short returns",
        help="Share of beams that end before the wall: someone walks past.",
    )
    glass_share: float = error(
        "glass_share",
        label="Glass",
        help="Share of the walls that the range finder looks through, in panes of 1 m.",
    )
    position_sigma_m: float = error(
        "position_sigma_m",
        label="Position error",
        unit="m",
        help="Standard deviation of each believed position, along x and along y. "
        "Readings are taken at the true pose and entered at the believed one.",
    )
    heading_sigma_deg: float = setting(
        0.0,
        label="Heading error",
        unit="degrees",
        high=round(math.degrees(ScanNoise.bounds("heading_sigma_rad").high)),
        step=0.5,
        help="Standard deviation of each believed heading.",
    )
    odometry_drift: float = error(
        "alpha_1",
        label="Odometry drift",
        help="The robot counts its own turns and steps: alpha_1 to alpha_4 of "
        "Probabilistic Robotics, Table 5.6, all four set to this. It adds up on the "
        "way.",
    )
    noise_seed: int = setting(
        0,
        label="Seed of the sensor's errors",
        high=9999,
        help="Another seed draws other errors of the same size.",
    )

    @property
    def sensor(self) -> Sensor:
        """The simulated sensor of these settings."""
        return Sensor(
            range_px=float(self.range_px),
            fov_rad=math.radians(self.fov_deg),
            behind_hit=self.behind_hit,
            clear_no_hit=self.clear_no_hit,
        )

    @property
    def noise(self) -> ScanNoise | None:
        """What the range finder and the odometry get wrong; None where nothing is.

        A run takes the scale from its building.
        """
        noise = ScanNoise(
            metres_per_px=1.0,
            sigma_0_m=self.sigma_0_m,
            sigma_2_per_m=self.sigma_2_per_m,
            sigma_from_m=self.sigma_from_m,
            dropout_share=self.dropout_share,
            short_share=self.short_share,
            glass_share=self.glass_share,
            position_sigma_m=self.position_sigma_m,
            heading_sigma_rad=math.radians(self.heading_sigma_deg),
            **{f"alpha_{i}": self.odometry_drift for i in (1, 2, 3, 4)},
        )
        return None if noise == NO_NOISE else noise

    @property
    def dense_beams(self) -> int:
        """As many beams as neighbours are at most one pixel apart at full range."""
        across_px = math.ceil(self.range_px * math.radians(self.fov_deg))
        return min(max(across_px, 1), MOST_BEAMS)

    @property
    def scan(self) -> ScanSettings | None:
        """How the readings are taken beam by beam; None where they are exact."""
        noise = self.noise
        if not self.beams and noise is None:
            return None
        return ScanSettings(
            n_beams=self.beams or self.dense_beams, noise=noise, seed=self.noise_seed
        )

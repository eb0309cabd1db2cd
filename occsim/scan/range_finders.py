"""Range finders that robots carry, with the figures of their sheets."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from occsim.errors import ParameterError, real_number
from occsim.scan.noise import ScanNoise
from occsim.sensor import BehindHit, Sensor


@dataclass(frozen=True, kw_only=True, slots=True)
class RangeFinder:
    """What a sheet says of a range finder.

    Parameters
    ----------
    title : str
        Maker and name.
    min_range_m, max_range_m : float
        Least and greatest distance that it measures, m.
    fov_rad : float
        Field of view, rad: `n_beams` steps.
    n_beams : int
        Beams of a scan.
    sigma_0_m, sigma_2_per_m, sigma_from_m : float
        Standard deviation of a range, as in `ScanNoise`.
    source : str
        Where the figures stand, and how they were taken.
    not_stated : tuple of str
        Names of the figures that the source does not state: a least distance, taken as
        0, or a standard deviation, for which an accuracy or a resolution is taken.

    Examples
    --------
    >>> from occsim.scan import RANGE_FINDERS
    >>> lidar = RANGE_FINDERS["rplidar-a1"]
    >>> lidar.sensor(metres_per_px=0.05).range_px, lidar.n_beams
    (240.0, 360)
    >>> lidar.not_stated
    ('sigma_0_m', 'sigma_2_per_m')
    """

    title: str
    min_range_m: float
    max_range_m: float
    fov_rad: float
    n_beams: int
    sigma_0_m: float
    sigma_2_per_m: float
    sigma_from_m: float
    source: str
    not_stated: tuple[str, ...] = ()

    def sensor(
        self, metres_per_px: float, behind_hit: BehindHit = BehindHit.UNSEEN
    ) -> Sensor:
        """Return its reach and field of view.

        Parameters
        ----------
        metres_per_px : float
            Scale of the world, above 0.
        behind_hit : BehindHit, default BehindHit.UNSEEN
            What is said behind a hit.

        Returns
        -------
        Sensor

        Raises
        ------
        ParameterError
            Where the scale is not above 0.
        """
        scale = real_number("metres_per_px", metres_per_px)
        if not 0.0 < scale < np.inf:
            raise ParameterError(f"metres_per_px must be above 0; got {scale}")
        return Sensor(
            range_px=self.max_range_m / scale,
            fov_rad=self.fov_rad,
            behind_hit=behind_hit,
        )

    def noise(self, metres_per_px: float) -> ScanNoise:
        """Return its errors of ranges at a scale, m a px."""
        return ScanNoise(
            metres_per_px=metres_per_px,
            sigma_0_m=self.sigma_0_m,
            sigma_2_per_m=self.sigma_2_per_m,
            sigma_from_m=self.sigma_from_m,
        )


_SIGMA = ("sigma_0_m", "sigma_2_per_m")


def _degrees(angle: float) -> float:
    return float(np.radians(angle))


RANGE_FINDERS: Mapping[str, RangeFinder] = MappingProxyType(
    {
        "kinect": RangeFinder(
            title="Microsoft Kinect for Xbox 360",
            min_range_m=0.8,
            max_range_m=4.0,
            fov_rad=_degrees(57.0),
            n_beams=640,
            sigma_0_m=0.0012,
            sigma_2_per_m=0.0019,
            sigma_from_m=0.4,
            source="Microsoft, Kinect for Windows SDK 1.8, 'Sensor Components and "
            "Specifications' (57 degrees) and 'DepthRange Enumeration' (default range, "
            "0.8 to 4 m); 640 columns; sigma: Nguyen, Izadi and Lovell, 'Modeling "
            "Kinect Sensor Noise for Improved 3D Reconstruction and Tracking', "
            "3DIMPVT 2012",
        ),
        "urg-04lx": RangeFinder(
            title="Hokuyo URG-04LX",
            min_range_m=0.06,
            max_range_m=4.095,
            fov_rad=_degrees(682 * 360.0 / 1024.0),
            n_beams=682,
            sigma_0_m=0.010,
            sigma_2_per_m=0.0032,
            sigma_from_m=1.0,
            source="Hokuyo, 'Communication Protocol Specification for SCIP 2.0', "
            "C-42-03320B, table 2: steps 44 to 725 of 1024; 'Scanning Laser Range "
            "Finder URG-04LX Specifications': 60 to 4095 mm, accuracy 10 mm to 1 m and "
            "1 % beyond, taken as sigma",
            not_stated=_SIGMA,
        ),
        "utm-30lx": RangeFinder(
            title="Hokuyo UTM-30LX",
            min_range_m=0.1,
            max_range_m=30.0,
            fov_rad=_degrees(1081 * 0.25),
            n_beams=1081,
            sigma_0_m=0.010,
            sigma_2_per_m=0.00005,
            sigma_from_m=10.0,
            source="Hokuyo, 'Communication Protocol Specification for SCIP 2.0', "
            "C-42-03320B, table 2: steps 0 to 1080 of 1440; 'Scanning Laser Range "
            "Finder UTM-30LX Specification': 0.1 to 30 m; sigma below 10 mm to 10 m "
            "and below 30 mm to 30 m, as the documentation of the robot Cacic quotes "
            "RobotShop's sheet, these bounds taken as sigma",
        ),
        "lms200": RangeFinder(
            title="SICK LMS200",
            min_range_m=0.0,
            max_range_m=80.0,
            fov_rad=_degrees(361 * 0.5),
            n_beams=361,
            sigma_0_m=0.005,
            sigma_2_per_m=0.0,
            sigma_from_m=0.0,
            source="SICK, 'Technical Description LMS200, LMS211, LMS221, LMS291': 180 "
            "degrees in steps of 0.5, at most 80 m (8 m in steps of 1 mm); statistical "
            "error 5 mm, one sigma, from 1 to 8 m, here taken at any distance",
            not_stated=("min_range_m",),
        ),
        "rplidar-a1": RangeFinder(
            title="Slamtec RPLIDAR A1",
            min_range_m=0.15,
            max_range_m=12.0,
            fov_rad=2.0 * np.pi,
            n_beams=360,
            sigma_0_m=0.0005,
            sigma_2_per_m=0.00083,
            sigma_from_m=0.0,
            source="Slamtec, 'RPLIDAR A1 Introduction and Datasheet, Model A1M8', rev. "
            "1.0, 2016: 0.15 to 12 m, 360 samples a scan at 5.5 Hz; no accuracy; the "
            "resolution, 0.5 mm below 1.5 m and 1 % of any distance, is taken as "
            "sigma, 0.5 mm near and 1 % at 12 m",
            not_stated=_SIGMA,
        ),
        "hc-sr04": RangeFinder(
            title="HC-SR04 sonar",
            min_range_m=0.02,
            max_range_m=4.0,
            fov_rad=_degrees(15.0),
            n_beams=1,
            sigma_0_m=0.003,
            sigma_2_per_m=0.0,
            sigma_from_m=0.0,
            source="ElecFreaks, 'Ultrasonic Ranging Module HC-SR04': measuring angle "
            "15 degrees, 2 cm to 4 m; the accuracy 'can reach' 3 mm, taken as sigma",
            not_stated=_SIGMA,
        ),
    }
)
"""By a short name. Sheets state an accuracy more often than a standard deviation; it
is taken as one, and `not_stated` says so.

Examples
--------
>>> from occsim import RANGE_FINDERS
>>> [name for name, one in RANGE_FINDERS.items() if one.max_range_m >= 30.0]
['utm-30lx', 'lms200']
"""

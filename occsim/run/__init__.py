"""A mapping run: a building under some settings, and all results."""

from occsim.run.noise_effect import NoiseEffect, noise_effect
from occsim.run.run import MappingRun
from occsim.run.settings import MapSettings, ScanSettings

__all__ = [
    "MapSettings",
    "MappingRun",
    "NoiseEffect",
    "ScanSettings",
    "noise_effect",
]

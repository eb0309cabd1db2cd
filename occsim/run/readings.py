"""How the readings of a run are taken: exactly, or beam by beam as scans."""

from dataclasses import replace

import numpy as np

from occsim.building import Building
from occsim.evidence import collect_evidence
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.run.settings import MapSettings
from occsim.scan import ScanLog, evidence_from_scans, simulate_scans


def simulated_scans(building: Building, settings: MapSettings) -> ScanLog | None:
    """Return the scans of a run; None where its readings are exact."""
    scan = settings.scan
    if scan is None:
        return None
    scale, noise = building.likely_metres_per_px, scan.noise
    return simulate_scans(
        building.world,
        building.trajectory,
        settings.sensor,
        scan.n_beams,
        noise and replace(noise, metres_per_px=scale),
        np.random.default_rng(scan.seed),
    )


def simulated_readings(
    building: Building, settings: MapSettings, scans: ScanLog | None, grid: Grid
) -> EvidenceLog:
    """Return what the readings say of the cells, from the scans where there are any."""
    if scans is not None:
        return evidence_from_scans(scans, settings.sensor, grid)
    return collect_evidence(building.world, building.trajectory, settings.sensor, grid)

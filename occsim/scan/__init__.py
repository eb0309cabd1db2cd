"""Scans: what a real range finder gives, simulated or recorded, beam by beam.

One path for both: a `ScanLog` becomes evidence as the exact readings of
`occsim.collect_evidence` do, with one range for each sector between beams in place of
one for each pixel.
"""

from occsim.scan.cell_model import BeamCounts, HitsVisits, beam_counts, hits_visits
from occsim.scan.convergence import beam_distances
from occsim.scan.evidence import evidence_from_scans
from occsim.scan.log import Scan, ScanLog
from occsim.scan.mapper import Mapper
from occsim.scan.noise import ScanNoise
from occsim.scan.range_finders import RANGE_FINDERS, RangeFinder
from occsim.scan.simulate import simulate_scans

__all__ = [
    "RANGE_FINDERS",
    "BeamCounts",
    "HitsVisits",
    "Mapper",
    "RangeFinder",
    "Scan",
    "ScanLog",
    "ScanNoise",
    "beam_counts",
    "beam_distances",
    "evidence_from_scans",
    "hits_visits",
    "simulate_scans",
]

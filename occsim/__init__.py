"""Occupancy grid mapping with informative priors.

A robot with a range sensor drives through a building at known poses. The building's
architectural drawing, if known, is the map's prior. This library computes what the
sensor says (once, free of any prior), the map that any prior then gives, how good the
map is, and which priors are best.
"""

from occsim._version import __version__ as __version__
from occsim.building import Building
from occsim.corrections import Corrections
from occsim.errors import (
    DrawingError,
    OccsimError,
    ParameterError,
    RobotFileError,
    TrajectoryError,
)
from occsim.evidence import collect_evidence, collect_totals, stream_evidence
from occsim.evidence_log import EvidenceLog, EvidenceTotals
from occsim.flaws import DrawingFlaws, flawed_mask
from occsim.grid import Grid
from occsim.imaging import Drawing, load_drawing
from occsim.io.trajectories import TrajectoryFormat, dump_trajectory, load_trajectory
from occsim.logodds import logit, p_free_from_log_odds
from occsim.mapping import OccupancyMap, UpdateRule, fuse
from occsim.metrics import (
    Measure,
    Region,
    Reliability,
    ScoreCurves,
    Scores,
    brier,
    coverage,
    log_loss,
    mean_entropy_bits,
    reliability,
    score,
    scores_by_reading,
    worth_in_readings,
)
from occsim.prior import (
    Prior,
    PriorMap,
    build_prior,
    calibrated_prior,
    estimated_prior,
)
from occsim.priors import (
    Elitism,
    Generation,
    LossSurface,
    Objective,
    ParetoFront,
    PriorSurface,
    PriorSweep,
    best_log_loss_pair,
    dominates,
    exact_front,
    exact_objective,
    good_region,
    hypervolume,
    interpolate,
    interpolated_objective,
    loss_surface,
    maxima,
    near_front,
    non_dominated,
    nsga2_front,
    nsga2_generations,
    prior_surface,
    recommend,
    rectangles_at,
    reference_point,
    set_c,
    surface_front,
    sweep_priors,
)
from occsim.reading import Reading, one_reading
from occsim.run import MappingRun, MapSettings
from occsim.samples import Sample, load_sample, prior_drawing, sample_names
from occsim.samples.lens import lens_world
from occsim.scan import (
    RANGE_FINDERS,
    HitsVisits,
    Mapper,
    RangeFinder,
    Scan,
    ScanLog,
    ScanNoise,
    evidence_from_scans,
    hits_visits,
    simulate_scans,
)
from occsim.sensor import BehindHit, Sensor
from occsim.tour import default_tour
from occsim.trajectory import HeadingMode, Trajectory, resample
from occsim.walls import WallDetection, WallParams, detect_walls
from occsim.world import World, truth_cells

__all__ = [
    "RANGE_FINDERS",
    "BehindHit",
    "Building",
    "Corrections",
    "Drawing",
    "DrawingError",
    "DrawingFlaws",
    "Elitism",
    "EvidenceLog",
    "EvidenceTotals",
    "Generation",
    "Grid",
    "HeadingMode",
    "HitsVisits",
    "LossSurface",
    "MapSettings",
    "Mapper",
    "MappingRun",
    "Measure",
    "Objective",
    "OccsimError",
    "OccupancyMap",
    "ParameterError",
    "ParetoFront",
    "Prior",
    "PriorMap",
    "PriorSurface",
    "PriorSweep",
    "RangeFinder",
    "Reading",
    "Region",
    "Reliability",
    "RobotFileError",
    "Sample",
    "Scan",
    "ScanLog",
    "ScanNoise",
    "ScoreCurves",
    "Scores",
    "Sensor",
    "Trajectory",
    "TrajectoryError",
    "TrajectoryFormat",
    "UpdateRule",
    "WallDetection",
    "WallParams",
    "World",
    "best_log_loss_pair",
    "brier",
    "build_prior",
    "calibrated_prior",
    "collect_evidence",
    "collect_totals",
    "coverage",
    "default_tour",
    "detect_walls",
    "dominates",
    "dump_trajectory",
    "estimated_prior",
    "evidence_from_scans",
    "exact_front",
    "exact_objective",
    "flawed_mask",
    "fuse",
    "good_region",
    "hits_visits",
    "hypervolume",
    "interpolate",
    "interpolated_objective",
    "lens_world",
    "load_drawing",
    "load_sample",
    "load_trajectory",
    "log_loss",
    "logit",
    "loss_surface",
    "maxima",
    "mean_entropy_bits",
    "near_front",
    "non_dominated",
    "nsga2_front",
    "nsga2_generations",
    "one_reading",
    "p_free_from_log_odds",
    "prior_drawing",
    "prior_surface",
    "recommend",
    "rectangles_at",
    "reference_point",
    "reliability",
    "resample",
    "sample_names",
    "score",
    "scores_by_reading",
    "set_c",
    "simulate_scans",
    "stream_evidence",
    "surface_front",
    "sweep_priors",
    "truth_cells",
    "worth_in_readings",
]

"""How good a map is, at its end and after every reading."""

from occsim.metrics.counts import (
    Region,
    Scores,
    coverage,
    f_beta_of,
    mean_entropy_bits,
    precision_of,
    recall_of,
    score,
)
from occsim.metrics.curves import ScoreCurves, scores_by_reading
from occsim.metrics.held_out import HeldOut, held_out_bits
from occsim.metrics.proper import Reliability, brier, log_loss, reliability
from occsim.metrics.worth import Measure, worth_in_readings

__all__ = [
    "HeldOut",
    "Measure",
    "Region",
    "Reliability",
    "ScoreCurves",
    "Scores",
    "brier",
    "coverage",
    "f_beta_of",
    "held_out_bits",
    "log_loss",
    "mean_entropy_bits",
    "precision_of",
    "recall_of",
    "reliability",
    "score",
    "scores_by_reading",
    "worth_in_readings",
]

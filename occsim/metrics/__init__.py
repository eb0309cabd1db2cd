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

__all__ = [
    "Region",
    "ScoreCurves",
    "Scores",
    "coverage",
    "f_beta_of",
    "mean_entropy_bits",
    "precision_of",
    "recall_of",
    "score",
    "scores_by_reading",
]

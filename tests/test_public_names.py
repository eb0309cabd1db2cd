"""What the library promises to those who import from `occsim` itself."""

import contextlib
import io
import re
from pathlib import Path

import pytest

import occsim

README = Path(__file__).resolve().parents[1] / "README.md"

# The names that outside code builds on: none of them may go missing.
PROMISED = {
    "BehindHit",
    "Drawing",
    "DrawingError",
    "EvidenceLog",
    "Grid",
    "OccsimError",
    "OccupancyMap",
    "ParameterError",
    "ParetoFront",
    "Prior",
    "PriorMap",
    "PriorSweep",
    "Region",
    "Sample",
    "Scores",
    "Sensor",
    "Trajectory",
    "TrajectoryError",
    "UpdateRule",
    "WallDetection",
    "WallParams",
    "World",
    "build_prior",
    "collect_evidence",
    "detect_walls",
    "exact_front",
    "fuse",
    "load_drawing",
    "load_sample",
    "load_trajectory",
    "nsga2_front",
    "sample_names",
    "score",
    "sweep_priors",
    "truth_cells",
}


def test_every_promised_name_is_exported():
    assert set(occsim.__all__) >= PROMISED


def test_every_exported_name_is_there():
    missing = [name for name in occsim.__all__ if not hasattr(occsim, name)]
    assert not missing


def readme_examples():
    return re.findall(r"```python\n(.*?)```", README.read_text("utf-8"), re.DOTALL)


@pytest.mark.parametrize("example", readme_examples(), ids=["run", "single steps"])
def test_an_example_of_the_readme_runs_as_it_stands(example):
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(example, str(README), "exec"), {})
    scores = re.findall(r"\d\.\d+", printed.getvalue())
    assert scores
    assert all(0.0 < float(score) <= 1.0 for score in scores)


def test_every_file_that_the_readme_links_to_is_there():
    links = re.findall(r"\]\(([^)]+)\)", README.read_text(encoding="utf-8"))
    files = [link for link in links if "://" not in link]
    assert files
    assert [link for link in files if not (README.parent / link).is_file()] == []

"""Fusing one prior with an evidence log of 100 x 100 cells."""

from collections.abc import Iterator

from occsim import Prior, build_prior, collect_evidence, fuse
from tests.benchmarks.table import Row, median_ms, timed_row
from tests.benchmarks.worlds import workload


def rows() -> Iterator[Row]:
    work = workload("A")
    grid = work.world.grid(work.cell_px)
    evidence = collect_evidence(work.world, work.trajectory, work.sensor, grid)
    prior = build_prior(work.world.occupied, grid, Prior())
    ms = median_ms(lambda: fuse(evidence, prior), repeats=200)
    yield timed_row("fuse one prior, 100 x 100 cells, every reading", ms, 0.3)
    half = evidence.n_readings // 2
    ms = median_ms(lambda: fuse(evidence, prior, n_readings=half), repeats=200)
    yield timed_row("the same after half of the readings", ms, 0.3)

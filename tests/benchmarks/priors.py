"""Sweeping the priors, the exact front, the search for it, and a whole study."""

from collections.abc import Iterator

import numpy as np

from occsim import collect_evidence, load_sample, sample_names
from occsim.mapping import UpdateRule
from occsim.priors import (
    best_log_loss_pair,
    exact_front,
    exact_objective,
    loss_surface,
    nsga2_front,
    reference_point,
    sweep_priors,
)
from occsim.study import run_case
from occsim.study.published import SOURCE_CELLS_PX
from occsim.world import truth_cells, wall_cells
from tests.benchmarks.table import Row, median_ms, timed_row

CELL_PX = 3
TENTHS = np.arange(1, 11) / 10
HUNDRED = np.linspace(0.1, 1.0, 100)
HUNDREDTHS = np.linspace(0.001, 0.999, 100)
MIN_SHARE = 0.995


def sample_cells(name):
    """Evidence, wall cells and truth of a sample, its walls as detected."""
    building = load_sample(name)
    grid = building.world.grid(CELL_PX)
    evidence = collect_evidence(
        building.world, building.trajectory, building.sensor, grid
    )
    is_wall = wall_cells(building.wall_mask, grid)
    return evidence, is_wall, truth_cells(building.world, grid)


def slowest(call, cases) -> float:
    return max(median_ms(lambda case=case: call(case)) for case in cases)


def rows() -> Iterator[Row]:
    cases = [sample_cells(name) for name in sample_names()]
    where = f"slowest sample, {CELL_PX} px"
    ms = slowest(lambda case: sweep_priors(*case, TENTHS, TENTHS), cases)
    yield timed_row("sweep of 10 x 10 priors", ms, 2.0, where)
    ms = slowest(lambda case: sweep_priors(*case, HUNDRED, HUNDRED), cases)
    yield timed_row("sweep of 100 x 100 priors", ms, 15.0, where)
    for rule in UpdateRule:
        ms = slowest(lambda case, rule=rule: exact_front(*case, rule), cases)
        yield timed_row(f"exact front, {rule.value}", ms, 5.0, where)
    for rule in UpdateRule:
        ms = slowest(lambda case, rule=rule: best_log_loss_pair(*case, rule), cases)
        yield timed_row(f"pair of least log loss, {rule.value}", ms, 2.0, where)
    ms = slowest(lambda case: loss_surface(*case).bits(HUNDREDTHS, HUNDREDTHS), cases)
    yield timed_row("log loss of 100 x 100 pairs", ms, 5.0, where)
    objective = exact_objective(*cases[0])
    ms = median_ms(lambda: nsga2_front(objective, seed=1), repeats=3)
    yield timed_row("NSGA-II 100 x 100, exact objective", ms, 1200.0, "sample a")
    yield from share_rows(cases)
    ms = median_ms(study_of_samples, repeats=1)
    yield timed_row("study of 5 samples x 3 cell sizes, walls known", ms, 5000.0)


def study_of_samples() -> None:
    """All cases of the command ``occsim study``; the samples' walls are known."""
    for name in sample_names():
        for cell_px in SOURCE_CELLS_PX:
            run_case(load_sample(name), cell_px)


def share_rows(cases) -> Iterator[Row]:
    """How much of the exact hypervolume the search finds, at worst over samples."""
    for rule in UpdateRule:
        shares = []
        for case in cases:
            exact = exact_front(*case, rule)
            ref = reference_point(exact)
            found = nsga2_front(exact_objective(*case, rule), seed=1)
            shares.append(found.hypervolume(ref) / exact.hypervolume(ref))
        worst = min(shares)
        yield Row(
            f"NSGA-II's share of the exact hypervolume, {rule.value}",
            f"{worst:.4f}",
            f">= {MIN_SHARE}",
            f"worst sample, {CELL_PX} px; best {max(shares):.4f}",
            worst >= MIN_SHARE and max(shares) <= 1.0 + 1e-12,
        )

"""Scans of 361 beams, entered one by one and all at once."""

from collections.abc import Iterator

import numpy as np

from occsim import (
    Mapper,
    Prior,
    Sensor,
    build_prior,
    evidence_from_scans,
    simulate_scans,
)
from tests.benchmarks.table import Row, median_ms, timed_row
from tests.benchmarks.worlds import workload

N_BEAMS = 361
VIEWS = {"180 deg": np.pi, "360 deg": 2.0 * np.pi}
# A pixel of 5 cm: 200 px are 10 m.
CELLS_CM = {1: 5, 5: 25}


def rows() -> Iterator[Row]:
    work = workload("D", 300)
    for view, fov_rad in VIEWS.items():
        sensor = Sensor(range_px=200.0, fov_rad=fov_rad)
        log = simulate_scans(work.world, work.trajectory, sensor, N_BEAMS)
        scans = [log.scan(index) for index in range(log.n_scans)]
        for cell_px, cell_cm in CELLS_CM.items():
            grid = work.world.grid(cell_px)
            blank = build_prior(
                np.zeros(work.world.shape, bool), grid, Prior.uninformative()
            )
            mapper = Mapper(grid, blank, sensor=sensor)

            def enter(mapper=mapper, scans=scans, log=log):
                for pose, scan in zip(log.poses, scans, strict=True):
                    mapper.update(pose, scan)

            what = f"{N_BEAMS} beams, {view}, 10 m, {cell_cm} cm cells"
            yield timed_row(f"Mapper.update: {what}", median_ms(enter, 5) / 300, 1.0)

            def at_once(log=log, sensor=sensor, grid=grid):
                evidence_from_scans(log, sensor, grid)

            ms = median_ms(at_once, 3)
            yield timed_row(f"evidence of 300 scans: {what}", ms, 600.0)

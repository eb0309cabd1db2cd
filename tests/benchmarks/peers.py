"""Scans of workloads A to D, and of 361 beams, beside what others map them with.

pyoctomap is no requirement, because it has wheels for few platforms: where it is not
installed (``pip install pyoctomap``) it is reported as absent. Each peer gets the scans
in the form that suits it, made beforehand: pyoctomap clouds of points, the line-walker
cells. Times are of all readings, entered into an empty map. They are processor times,
which depend least on what else the machine does.
"""

import importlib
import importlib.util
import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from occsim import (
    BehindHit,
    Grid,
    Mapper,
    Prior,
    ScanLog,
    Sensor,
    build_prior,
    collect_evidence,
    evidence_from_scans,
    simulate_scans,
)
from tests.benchmarks.table import Row, median_ms
from tests.benchmarks.worlds import Workload, workload
from tests.benchmarks.yardsticks import compile_line_walker

N_READINGS = 300
METRES_PER_PX = 0.05
BEAMS_PER_CELL = 2
"""At the end of the range: a peer that walks beams then leaves no cell out."""

NAIVE_READINGS = 30
"""Readings that the slow peer enters; its time is scaled to all."""

FULL_TURN_FACTOR, CONE_FACTOR = 2.0, 1.0
"""Times faster than pyoctomap that scans are to be: 360 degrees, and less."""


@dataclass(frozen=True)
class Scans:
    """The same scans for everyone."""

    name: str
    log: ScanLog
    sensor: Sensor
    grid: Grid

    @property
    def is_full_turn(self) -> bool:
        return self.sensor.fov_rad > 6.0


def cpu_ms(call: Callable[[], object], repeats: int) -> float:
    """Return the median processor time of a call, ms."""
    return median_ms(call, repeats, time.process_time)


def recorded(name: str, work: Workload, sensor: Sensor, n_beams: int, cell_px: int):
    """Return scans of a workload; peers say nothing behind a hit, so we do not."""
    sensor = replace(sensor, behind_hit=BehindHit.UNSEEN)
    log = simulate_scans(work.world, work.trajectory, sensor, n_beams)
    return Scans(f"{name}, {n_beams} beams", log, sensor, work.world.grid(cell_px))


def beams_of(work: Workload) -> int:
    """Return the beams that put two into each cell at the end of the range."""
    rim = work.sensor.fov_rad * work.sensor.range_px / work.cell_px
    return round(BEAMS_PER_CELL * rim)


def ends_px(scans: Scans) -> np.ndarray:
    """Return where beams end, (S, B, 2); those without return, beyond the range."""
    ranges = np.minimum(scans.log.ranges_px, 2.0 * scans.sensor.range_px)
    x, y, theta = scans.log.poses.T[:, :, None]
    bearing = theta + scans.log.bearings_rad
    return np.stack([x + ranges * np.cos(bearing), y + ranges * np.sin(bearing)], -1)


def octomap(scans: Scans) -> Callable[[], object] | None:
    """Return OctoMap's insertion of the clouds, one layer of cells."""
    if importlib.util.find_spec("pyoctomap") is None:
        return None
    pyoctomap = importlib.import_module("pyoctomap")
    height = np.zeros((*scans.log.ranges_px.shape, 1))
    clouds = METRES_PER_PX * np.concatenate([ends_px(scans), height], axis=-1)
    origins = METRES_PER_PX * np.pad(scans.log.poses[:, :2], ((0, 0), (0, 1)))
    reach_m = METRES_PER_PX * scans.sensor.range_px
    cell_m = METRES_PER_PX * scans.grid.cell_px

    def run():
        tree = pyoctomap.OcTree(cell_m)
        for cloud, origin in zip(clouds, origins, strict=True):
            tree.insertPointCloud(cloud, origin, max_range=reach_m)

    return run


def ray_casting(scans: Scans, n_readings: int) -> Callable[[], object]:
    """Return what PythonRobotics' lidar_to_grid_map does, written for this comparison.

    One Bresenham line in Python from the robot's cell to that of each hit: cells before
    it are free, the hit and its neighbours right and below are occupied, in a map of
    this scan alone. Beams without return clear as far as the range.
    """
    ranges = scans.log.ranges_px[:n_readings]
    reach = scans.sensor.range_px
    origins = scans.log.poses[:n_readings, None, :2]
    ends = ends_px(scans)[:n_readings]
    # Beams without return end beyond the range: cut there.
    factor = np.minimum(reach / np.minimum(ranges, 2.0 * reach), 1.0)
    ends = origins + (ends - origins) * factor[..., None]
    cells = np.floor(ends / scans.grid.cell_px).astype(int).tolist()
    starts = np.floor(origins[:, 0] / scans.grid.cell_px).astype(int).tolist()
    hits = (ranges <= reach).tolist()

    def run():
        for start, beams, are_hits in zip(starts, cells, hits, strict=True):
            occupancy = np.full((scans.grid.n_rows + 2, scans.grid.n_cols + 2), 0.5)
            for end, is_hit in zip(beams, are_hits, strict=True):
                for x, y in bresenham(*start, *end):
                    occupancy[y, x] = 0.0
                if is_hit:
                    x, y = end
                    occupancy[y : y + 2, x : x + 2] = 1.0

    return run


def bresenham(x0: int, y0: int, x1: int, y1: int) -> list[tuple[int, int]]:
    """Return the cells of a line but the last."""
    across, down = abs(x1 - x0), -abs(y1 - y0)
    step_x, step_y = (1 if x1 > x0 else -1), (1 if y1 > y0 else -1)
    error, cells = across + down, []
    while (x0, y0) != (x1, y1):
        cells.append((x0, y0))
        twice = 2 * error
        if twice >= down:
            error += down
            x0 += step_x
        if twice <= across:
            error += across
            y0 += step_y
    return cells


def entered(scans: Scans) -> Callable[[], object]:
    """Return a Mapper's updates, scan by scan."""
    blank = build_prior(
        np.zeros((scans.grid.height_px, scans.grid.width_px), bool),
        scans.grid,
        Prior.uninformative(),
    )
    each = [scans.log.scan(index) for index in range(scans.log.n_scans)]

    def run():
        mapper = Mapper(scans.grid, blank, sensor=scans.sensor)
        for pose, scan in zip(scans.log.poses, each, strict=True):
            mapper.update(pose, scan)

    return run


def compared(what: str, ms: float, peers: dict[str, float], aim: float) -> Row:
    """Return a row: our time, those of the peers, and how many times ours they are."""
    beside = [
        f"{name} {took:,.0f} ms, {took / ms:.2f}x" for name, took in peers.items()
    ]
    if "pyoctomap" not in peers:
        beside.append("pyoctomap absent")
    reached = peers.get("pyoctomap", math.inf) >= aim * ms
    wanted = f"pyoctomap > {aim:g}x"
    return Row(what, f"{ms:.1f} ms", wanted, "; ".join(beside), reached)


def scan_rows(scans: Scans) -> Iterator[Row]:
    peers = {}
    insert = octomap(scans)
    if insert is not None:
        peers["pyoctomap"] = cpu_ms(insert, 5)
    scale = N_READINGS / NAIVE_READINGS
    naive = cpu_ms(ray_casting(scans, NAIVE_READINGS), 1)
    peers["PythonRobotics' way (scaled)"] = scale * naive
    aim = FULL_TURN_FACTOR if scans.is_full_turn else CONE_FACTOR

    def at_once():
        evidence_from_scans(scans.log, scans.sensor, scans.grid)

    yield compared(f"evidence_from_scans {scans.name}", cpu_ms(at_once, 5), peers, aim)
    one_by_one = cpu_ms(entered(scans), 5)
    yield compared(f"Mapper.update {scans.name}", one_by_one, peers, aim)


def rows() -> Iterator[Row]:
    walk_in_c = compile_line_walker()
    for name in "ABCD":
        work = workload(name, N_READINGS)
        if walk_in_c is not None:
            grid = work.world.grid(work.cell_px)

            def exact(work=work, grid=grid):
                collect_evidence(work.world, work.trajectory, work.sensor, grid)

            ms, c_ms = cpu_ms(exact, 5), cpu_ms(lambda w=work: walk_in_c(w), 5)
            beside = f"C line-walker {c_ms:,.0f} ms, {c_ms / ms:.2f}x"
            yield Row(f"collect_evidence {name}", f"{ms:.1f} ms", "", beside)
        yield from scan_rows(
            recorded(name, work, work.sensor, beams_of(work), work.cell_px)
        )
    work = workload("D", N_READINGS)
    for degrees in (30, 180, 360):
        sensor = replace(work.sensor, fov_rad=np.radians(degrees))
        name = f"D at {degrees} deg, 5 cm cells"
        yield from scan_rows(recorded(name, work, sensor, 361, 1))

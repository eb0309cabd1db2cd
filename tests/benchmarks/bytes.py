"""The bytes sent to the player for a run, compared with the log in memory."""

from collections.abc import Iterator

from occsim import collect_evidence, load_sample, sample_names, truth_cells
from occsim.io.replay import pack_log, pack_scene, pack_walls
from occsim.world import wall_cells
from tests.benchmarks.table import Row

AIM_KB = 200


def rows() -> Iterator[Row]:
    for name in sample_names():
        building = load_sample(name)
        sensor = building.sensor
        grid = building.world.grid(3)
        log = collect_evidence(building.world, building.trajectory, sensor, grid)
        trajectory = building.trajectory
        parts = (
            pack_scene(
                building.world,
                trajectory=trajectory,
                sensor=sensor,
                drawing=building.drawing,
            ),
            pack_log(
                log, truth=truth_cells(building.world, grid), trajectory=trajectory
            ),
            pack_walls(wall_cells(building.wall_mask, grid)),
        )
        kb = sum(map(len, parts)) / 1000
        raw_kb = (log.cell.nbytes + log.log_odds.nbytes + log.indptr.nbytes) / 1000
        yield Row(
            f"replay of {name}, {log.n_readings} readings",
            f"{kb:.0f} kB",
            f"< {AIM_KB} kB",
            f"log in memory {raw_kb:.0f} kB, {raw_kb / kb:.0f} times as much",
            kb < AIM_KB,
        )

"""The same readings by a plain line-walker, in C and in Python, to compare with."""

import ctypes
import math
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from tests.benchmarks.worlds import Workload

SOURCE = Path(__file__).with_name("line_walker.c")


def compile_line_walker() -> Callable[[Workload], int] | None:
    """Return the C line-walker, or None where there is no compiler."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        return None
    library = Path(tempfile.mkdtemp()) / "line_walker.so"
    command = [compiler, "-O3", "-shared", "-fPIC", "-o", library, SOURCE, "-lm"]
    subprocess.run(command, check=True)
    collect = ctypes.CDLL(str(library)).collect
    collect.restype = ctypes.c_long

    def run(work: Workload) -> int:
        wall = work.world.occupied.view(np.uint8)
        poses = np.ascontiguousarray(work.trajectory.poses)
        most = len(poses) * work.world.grid(work.cell_px).n_cells
        cells, values = np.empty(most, np.int32), np.empty(most)
        return collect(
            ctypes.c_void_p(wall.ctypes.data),
            *(ctypes.c_int(side) for side in wall.shape),
            ctypes.c_void_p(poses.ctypes.data),
            ctypes.c_int(len(poses)),
            ctypes.c_double(work.sensor.range_px),
            ctypes.c_double(work.sensor.fov_rad),
            ctypes.c_int(work.cell_px),
            ctypes.c_void_p(cells.ctypes.data),
            ctypes.c_void_p(values.ctypes.data),
        )

    return run


def naive_python(work: Workload) -> int:
    """Walk the lines in Python, pixel by pixel; returns the number of entries."""
    wall = work.world.occupied.tolist()
    reach, half = work.sensor.range_px, work.sensor.fov_rad / 2
    rim = math.ceil(reach)
    ring = [(k, -rim) for k in range(-rim, rim)] + [(rim, k) for k in range(-rim, rim)]
    ring += [(-dx, -dy) for dx, dy in ring]
    entries = 0
    for x, y, theta in work.trajectory.poses.tolist():
        marks: dict[tuple[int, int], bool] = {}
        for dx, dy in ring:
            off = (math.atan2(dy, dx) - theta + math.pi) % (2 * math.pi) - math.pi
            if abs(off) <= half:
                _walk(wall, math.floor(x), math.floor(y), dx, dy, reach, marks)
        entries += len(_log_odds(marks, work.cell_px))
    return entries


def _walk(wall, x0, y0, dx, dy, reach, marks):
    x, y, hit = x0, y0, False
    step_x, step_y = (1 if dx > 0 else -1), (1 if dy > 0 else -1)
    across, down = abs(dx), -abs(dy)
    error = across + down
    while math.hypot(x - x0, y - y0) <= reach:
        if not (0 <= y < len(wall) and 0 <= x < len(wall[0])):
            return
        hit = hit or wall[y][x]
        marks.setdefault((x, y), hit)
        twice = 2 * error
        if twice >= down:
            error += down
            x += step_x
        if twice <= across:
            error += across
            y += step_y


def _log_odds(marks, cell_px):
    counts: dict[tuple[int, int], list[int]] = {}
    for (x, y), hit in marks.items():
        counts.setdefault((y // cell_px, x // cell_px), [0, 0])[hit] += 1
    values = {}
    for cell, (n_empty, n_object) in counts.items():
        p_free = min(max(n_empty / (n_empty + n_object), 0.1), 0.9)
        values[cell] = math.log(p_free / (1 - p_free))
    return values

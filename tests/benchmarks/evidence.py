"""Evidence of 300 readings on the four workloads, beside plain line-walkers."""

from collections.abc import Iterator

from occsim import Trajectory, collect_evidence
from tests.benchmarks.table import Row, median_ms, timed_row
from tests.benchmarks.worlds import workload
from tests.benchmarks.yardsticks import compile_line_walker, naive_python

AIMS_MS = {"A": 10.0, "B": 120.0, "C": 10.0, "D": 220.0}
RATIOS = {"A": 14.0, "B": 2.0, "C": 14.0, "D": 1.6}
NAIVE_READINGS = {"A": 60, "B": 2, "C": 60, "D": 2}
N_READINGS = 300
ONE_POSE_MS = 0.3


def rows() -> Iterator[Row]:
    walk_in_c = compile_line_walker()
    for name, aim_ms in AIMS_MS.items():
        work = workload(name, N_READINGS)
        grid = work.world.grid(work.cell_px)

        def ours(work=work, grid=grid):
            collect_evidence(work.world, work.trajectory, work.sensor, grid)

        ms = median_ms(ours)
        few = workload(name, NAIVE_READINGS[name])
        scale = N_READINGS / NAIVE_READINGS[name]
        naive_ms = scale * median_ms(lambda few=few: naive_python(few), repeats=1)
        beside = f"naive Python {naive_ms:,.0f} ms (scaled), {naive_ms / ms:,.0f}x ours"
        row = timed_row(f"evidence {name}: {work.about}", ms, aim_ms, beside)
        yield row
        if walk_in_c is not None:
            c_ms = median_ms(lambda work=work: walk_in_c(work))
            ratio, most = ms / c_ms, RATIOS[name]
            yield Row(
                f"evidence {name}, times C",
                f"{ratio:.2f}",
                f"< {most:g}",
                f"C line-walker {c_ms:.1f} ms",
                ratio < most,
            )
    for name in "AC":
        yield one_pose_row(name)


def one_pose_row(name: str) -> Row:
    """Return what one reading takes, each in a call of its own."""
    work = workload(name, N_READINGS)
    grid = work.world.grid(work.cell_px)
    poses = [Trajectory(pose[None]) for pose in work.trajectory.poses]

    def ours():
        for pose in poses:
            collect_evidence(work.world, pose, work.sensor, grid)

    ms = median_ms(ours) / N_READINGS
    return timed_row(f"evidence {name}, one pose a call", ms, ONE_POSE_MS)

"""The four workloads: plans of rooms, and readings at random free places in them."""

from dataclasses import dataclass

import numpy as np

from occsim import Sensor, Trajectory, World
from occsim.geometry import CARDINAL_HEADINGS_RAD

DOOR_PX = 20
ROOM_MIN_PX = 50


@dataclass(frozen=True)
class Workload:
    """Everything that `collect_evidence` needs, by the name of the design's table."""

    name: str
    world: World
    trajectory: Trajectory
    sensor: Sensor
    cell_px: int
    about: str


def rooms(side_px: int, wall_px: int, *, rng: np.random.Generator) -> np.ndarray:
    """Return a square plan of rooms: recursive splits, one door in each wall."""
    plan = np.zeros((side_px, side_px), dtype=bool)
    plan[:wall_px] = plan[-wall_px:] = True
    plan[:, :wall_px] = plan[:, -wall_px:] = True
    pending = [(wall_px, wall_px, side_px - wall_px, side_px - wall_px)]
    while pending:
        top, left, bottom, right = pending.pop()
        if max(bottom - top, right - left) < 2 * ROOM_MIN_PX + wall_px:
            continue
        across = bottom - top > right - left
        low, high = (top, bottom) if across else (left, right)
        at = int(rng.integers(low + ROOM_MIN_PX, high - ROOM_MIN_PX - wall_px + 1))
        along = (left, right) if across else (top, bottom)
        door = int(rng.integers(along[0] + 2, along[1] - DOOR_PX - 2))
        # Splits are drawn transposed where the wall stands upright.
        view = plan if across else plan.T
        view[at : at + wall_px, along[0] : along[1]] = True
        view[at : at + wall_px, door : door + DOOR_PX] = False
        if across:
            pending += [(top, left, at, right), (at + wall_px, left, bottom, right)]
        else:
            pending += [(top, left, bottom, at), (top, at + wall_px, bottom, right)]
    return plan


def free_poses(
    occupied: np.ndarray, n_poses: int, *, rng: np.random.Generator
) -> np.ndarray:
    """Return random free places, anywhere in their pixel, with the four headings."""
    rows, cols = np.nonzero(~occupied)
    picked = rng.integers(0, rows.size, n_poses)
    x = cols[picked] + rng.random(n_poses)
    y = rows[picked] + rng.random(n_poses)
    return np.stack([x, y, rng.choice(CARDINAL_HEADINGS_RAD, n_poses)], axis=1)


def workload(name: str, n_readings: int = 300) -> Workload:
    """Return workload A, B, C or D."""
    small, wide = name in "AB", name in "BD"
    side_px, wall_px, cell_px = (300, 3, 3) if small else (1000, 5, 5)
    degrees, range_px = (360, 200.0) if wide else (30, 40.0)
    rng = np.random.default_rng(20 + small)
    occupied = rooms(side_px, wall_px, rng=rng)
    return Workload(
        name=name,
        world=World(occupied=occupied),
        trajectory=Trajectory(poses=free_poses(occupied, n_readings, rng=rng)),
        sensor=Sensor(range_px=range_px, fov_rad=np.radians(degrees)),
        cell_px=cell_px,
        about=f"{side_px} px, {cell_px} px cells, {degrees} deg, {range_px:.0f} px",
    )

"""A tour that shows a sensor the inside of a building, and random poses."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, TrajectoryError
from occsim.geometry import CARDINAL_HEADINGS_RAD, snap_heading, wrap_angle
from occsim.sensor import Sensor
from occsim.tour.lattice import Lattice, build_lattice
from occsim.tour.space import clearance_map, free_space, inside_building
from occsim.tour.views import best_views, cell_worth, views_from
from occsim.tour.walk import corners, shortest_walk
from occsim.trajectory import Trajectory
from occsim.world import World

MAX_READINGS = 3000
"""Most readings of a tour, unless another number is asked for."""

# More nodes find narrower passages, more positions better views; both take longer.
_MAX_NODES = 30_000
_MAX_POSITIONS = 6_000
# So far from walls a line sampled every half pixel cannot touch one in between.
_LEAST_CLEARANCE_PX = 1.0
# A robot as wide as two fifths of a door, where the range is a door's length.
_CLEARANCE_SHARE = 0.2
_CLEARANCE_LIMITS_PX = (2.0, 8.0)
# A pixel of way close to walls costs as much as so many others.
_CLOSE_COST = 3.0
# Of the inside: parts to which no way leads from the others are left out below this.
_LEAST_PART = 0.02
# Of the range: between positions to look from, and the side of the cells that are seen.
_SPACING_SHARE = 0.15
_CELL_SHARE = 0.1
_CELL_LIMIT_PX = 5
# Of the readings allowed: the others are for corners of the way, about so many.
_LOOK_SHARE = 0.96
# Where they are more, looks are cut by their share of the tour, and a little more.
_LESS = 0.99
# Where the cone opens wider than this, one reading sees all around.
_ALL_AROUND_RAD = 1.5 * np.pi


@dataclass(frozen=True, eq=False)
class _Ground:
    """Where a robot may be: all of shape (H, W)."""

    inside: BoolArray
    clear: BoolArray  # a straight line of these touches no wall
    clearance: FloatArray  # px, no more than is comfortable
    roomy: BoolArray  # where steps should stay

    @classmethod
    def of(cls, world: World, sensor: Sensor) -> Self:
        inside, clearance = inside_building(world), clearance_map(world)
        clear = clearance >= _LEAST_CLEARANCE_PX
        share = _CLEARANCE_SHARE * sensor.range_px
        comfort_px = float(np.clip(share, *_CLEARANCE_LIMITS_PX))
        roomy = inside & (clearance >= comfort_px)
        return cls(inside, clear & inside, np.minimum(clearance, comfort_px), roomy)


def default_tour(
    world: World, sensor: Sensor, *, max_readings: int = MAX_READINGS
) -> Trajectory:
    """Return a tour that shows the sensor the inside of a building.

    Parameters
    ----------
    world : World
        Ground truth, or the wall mask that serves as one.
    sensor : Sensor
        Its range, field of view and rule behind a wall say what a reading shows.
    max_readings : int, default MAX_READINGS
        Most poses, 1 or more.

    Returns
    -------
    Trajectory
        One walk: each step is a straight line inside that touches no wall. At each
        position the robot looks where it sees most that is new, in one or more of the
        four cardinal headings; at a corner of the way it looks along it. The tour ends
        when nearly all is seen that can be seen from where the robot gets. Where
        `max_readings` ends it before, the readings that show most are taken.
        Storeys on one sheet, and rooms without an open door, have a walk each, the
        largest first; from one to the next the robot is carried.

    Raises
    ------
    TrajectoryError
        Where the world has no free pixel.
    ParameterError
        Where `max_readings` is below 1.

    Notes
    -----
    Deterministic. Readings are chosen greedily. What is inside is a guess, see
    `inside_building`; the whole drawing, where nothing is. Closed parts of less than
    a fiftieth of the inside are left out, and the robot is never outside.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Sensor, World, default_tour
    >>> walls = np.ones((60, 80), bool)
    >>> walls[5:55, 5:75] = False
    >>> tour = default_tour(World(occupied=walls), Sensor(range_px=20), max_readings=30)
    >>> len(tour) <= 30
    True
    """
    if max_readings < 1:
        raise ParameterError(f"max_readings must be 1 or more; got {max_readings!r}")
    if world.occupied.all():
        raise _no_free_space(0.0)
    ground = _Ground.of(world, sensor)
    lattice = _lattice(ground)
    place, heading = _looks(lattice, ground, sensor)
    poses = np.column_stack([lattice.points_px(place), heading])
    cell_px = int(np.clip(round(_CELL_SHARE * sensor.range_px), 1, _CELL_LIMIT_PX))
    grid = world.grid(cell_px)
    views = views_from(world, poses, sensor, grid)
    chosen = best_views(views, cell_worth(world, ground.inside, grid), max_readings)
    # Corners of the way take readings from the looks that show least.
    n_looks = min(len(chosen), max(1, int(_LOOK_SHARE * max_readings)))
    while True:
        looks = chosen[:n_looks]
        tour = _tour(lattice, place[looks], heading[looks], ground)
        if len(tour) <= max_readings:
            return Trajectory(poses=tour)
        n_looks = max(1, int(_LESS * n_looks * max_readings / len(tour)))


def _lattice(ground: _Ground) -> Lattice:
    """Return the lattice over the inside, without the smallest of its parts."""
    step_px = int(np.ceil(np.sqrt(np.count_nonzero(ground.inside) / _MAX_NODES)))
    cost = np.where(ground.roomy, 1.0, _CLOSE_COST)
    lattice = build_lattice(ground.clear, step_px, cost)
    if not len(lattice):  # passages of a pixel or two
        lattice = build_lattice(ground.inside, 1, cost)
    part = lattice.parts()
    size = np.bincount(part)
    return lattice.take((size >= min(_LEAST_PART * len(lattice), size.max()))[part])


def _looks(
    lattice: Lattice, ground: _Ground, sensor: Sensor
) -> tuple[IntArray, FloatArray]:
    """Return nodes to look from and headings, one view each.

    One node in each square of a spacing's side; one with less than the comfortable
    clearance only where no neighbour has more.
    """
    clearance = ground.clearance[lattice.row, lattice.col]
    links = lattice.graph.tocoo()
    around = clearance.copy()
    np.maximum.at(around, links.row, clearance[links.col])
    nodes = np.flatnonzero(clearance >= around)
    least_px = np.sqrt(np.count_nonzero(ground.inside) / _MAX_POSITIONS)
    spacing_px = max(_SPACING_SHARE * sensor.range_px, float(least_px))
    x, y = lattice.points_px(nodes).T / spacing_px
    square = np.floor(y) * (np.floor(x).max() + 1.0) + np.floor(x)
    off_centre = np.hypot(x % 1.0 - 0.5, y % 1.0 - 0.5)
    order = np.lexsort((off_centre, square))
    _, first = np.unique(square[order], return_index=True)
    # In no order of place: of views that show as much, those chosen lie far apart.
    spots = np.random.default_rng(0).permutation(nodes[order[first]])
    all_around = sensor.fov_rad >= _ALL_AROUND_RAD
    headings = (0.0,) if all_around else CARDINAL_HEADINGS_RAD
    return np.repeat(spots, len(headings)), np.tile(headings, spots.size)


def _tour(
    lattice: Lattice, place: IntArray, heading: FloatArray, ground: _Ground
) -> FloatArray:
    """Return the poses of a walk in each part of the building, the largest first."""
    part = lattice.parts()
    walks = []
    for one in np.argsort(-np.bincount(part), kind="stable"):
        here, nodes = part[place] == one, np.flatnonzero(part == one)
        if here.any():
            stop = np.searchsorted(nodes, place[here])
            walks.append(_walk(lattice.take(part == one), stop, heading[here], ground))
    return np.concatenate(walks)


def _walk(
    lattice: Lattice, place: IntArray, heading: FloatArray, ground: _Ground
) -> FloatArray:
    """Return the poses of a walk to all places, with the headings wanted there."""
    order = np.lexsort((heading, place))
    stops, first = np.unique(place[order], return_index=True)
    looks_at = np.split(heading[order], first[1:])
    poses: list[tuple[float, float, float]] = []
    here = stops[:0]
    for which, nodes in shortest_walk(lattice, stops):
        points = lattice.points_px(np.concatenate([here, nodes]))
        points = points[corners(ground.roomy, ground.clear, points)]
        dx, dy = np.diff(points, axis=0).T
        ways = snap_heading(np.arctan2(dy, dx))
        turns = zip(points[1:-1], ways[1:], strict=True)
        poses += [(x, y, way) for (x, y), way in turns]
        # It turns on the spot from the heading it arrives with, clockwise on screen.
        looks = looks_at[which]
        facing = ways[-1] if ways.size else 0.0
        if looks.size > 1:
            nearest = int(np.argmin(np.abs(wrap_angle(looks - facing))))
            looks = np.roll(looks, -nearest)
        poses += [(*points[-1], look) for look in looks]
        here = nodes[-1:]
    return np.array(poses)


def random_poses(
    world: World,
    n: int,
    *,
    rng: np.random.Generator,
    headings_rad: Sequence[float] | None = CARDINAL_HEADINGS_RAD,
    clearance_px: float = 0.0,
) -> Trajectory:
    """Return independent poses, uniform over the free space.

    Parameters
    ----------
    world : World
        Ground truth.
    n : int
        Poses, 1 or more.
    rng : numpy.random.Generator
        Decides; the same state gives the same poses.
    headings_rad : sequence of float or None, default right, down, left, up
        Headings to choose from, rad; None for any.
    clearance_px : float, default 0
        Least distance of the pose's pixel from walls, px.

    Returns
    -------
    Trajectory
        `n` poses at the centres of free pixels.

    Raises
    ------
    TrajectoryError
        Where there is no free space with that clearance.
    ParameterError
        Where `n`, a heading or the clearance lies outside its domain.
    """
    if n < 1:
        raise ParameterError(f"n must be 1 or more; got {n!r}")
    if headings_rad is not None:
        _require_headings(headings_rad)
    pixels = np.flatnonzero(free_space(world, clearance_px))
    if not pixels.size:
        raise _no_free_space(clearance_px)
    rows, cols = np.divmod(rng.choice(pixels, n), world.shape[1])
    if headings_rad is None:
        theta = rng.uniform(-np.pi, np.pi, n)
    else:
        theta = rng.choice(np.asarray(headings_rad, dtype=np.float64), n)
    return Trajectory(poses=np.stack([cols + 0.5, rows + 0.5, theta], axis=1))


def _require_headings(headings_rad: Sequence[float]) -> None:
    if not len(headings_rad) or not np.isfinite(headings_rad).all():
        raise ParameterError(
            f"headings_rad must be one or more finite angles; got {headings_rad!r}"
        )


def _no_free_space(clearance_px: float) -> TrajectoryError:
    return TrajectoryError(
        f"the world has no free space {clearance_px:g} px or more from its walls; "
        "a robot needs at least one such pixel to stand on"
    )

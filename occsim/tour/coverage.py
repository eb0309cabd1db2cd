"""Tours that cover the free space, and random poses in it."""

from collections.abc import Sequence

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError, TrajectoryError
from occsim.geometry import CARDINAL_HEADINGS_RAD, wrap_angle
from occsim.sensor import Sensor
from occsim.tour.lattice import Lattice, build_lattice, spread
from occsim.tour.space import clearance_map, free_space, inside_building
from occsim.tour.walk import corners, shortest_walk
from occsim.trajectory import Trajectory
from occsim.world import World

# Nodes over the whole drawing: six pixels apart at 1500 x 1000 px. More of them find
# narrower passages and take longer.
_MAX_NODES = 45_000
# A robot as wide as two fifths of a door, where the range is a door's length.
_CLEARANCE_SHARE = 0.2
_CLEARANCE_LIMITS_PX = (2.0, 8.0)
# Smaller steps than this share of the range show little that is new.
_SPACING_SHARE = 0.75
# At least about 6 x 6 positions, so that a far-seeing robot still makes a tour.
_SPACINGS_ACROSS = 6.0
# A position farther from every wall than this share of the range sees none well.
_NEAR_WALL_SHARE = 0.8
# Of the readings allowed, those that positions get; turns of the walk take the rest.
_SHARE_OF_POSITIONS = 0.85
# A connected part smaller than this share of the inside is not worth a visit.
_LEAST_PART = 0.03
_ENOUGH = 0.6
# Where the cone opens wider than this, one reading sees all around.
_ALL_AROUND_RAD = 1.5 * np.pi


def coverage_tour(
    world: World,
    spacing_px: float,
    *,
    headings_rad: Sequence[float] = CARDINAL_HEADINGS_RAD,
    clearance_px: float = 4.0,
    region: BoolArray | None = None,
) -> Trajectory:
    """Return a tour that leaves no free place far from one of its positions.

    Parameters
    ----------
    world : World
        Ground truth.
    spacing_px : float
        Between neighbouring positions, px, above 0.
    headings_rad : sequence of float, default right, down, left, up
        At every position, one reading each, rad.
    clearance_px : float, default 4
        Least distance from walls, px.
    region : ndarray of bool, shape (H, W), optional
        Where positions are wanted; by default inside the building where there is an
        inside, else everywhere.

    Returns
    -------
    Trajectory
        Through the largest connected part of the free space. Where the straight line
        from one position to the next is not free, the walk's corners are poses
        too, each looking along the way, so that every step is a free straight line.

    Raises
    ------
    TrajectoryError
        Where there is no free space with that clearance in the region.
    ParameterError
        Where the spacing, a heading or the clearance lies outside its domain.
    """
    _require_coverage(spacing_px, headings_rad)
    lattice = _lattice(world, free_space(world, clearance_px))
    wanted = lattice.at(_wanted_region(world) if region is None else region)
    parts = _parts(lattice, wanted)
    if not parts:
        raise _no_free_space(clearance_px)
    legs = _visit(lattice, parts[0], spacing_px)
    return Trajectory(poses=_poses(legs, headings_rad)[0])


def default_tour(
    world: World, sensor: Sensor, *, max_readings: int = 400
) -> Trajectory:
    """Return a tour that maps an unknown building at once.

    Parameters
    ----------
    world : World
        Ground truth, or the wall mask that serves as one.
    sensor : Sensor
        Its range sets clearance and spacing, its field of view the headings.
    max_readings : int, default 400
        Most poses; at least 4.

    Returns
    -------
    Trajectory
        A walk inside the building, with the four headings at each position (one, for
        a sensor that sees all around) and the walk's corners between. Where the
        readings do not suffice, positions are farther apart, and looks at no
        wall within range are left out. Where doors are closed, so that no part holds
        most of the building, the parts are walked one after another.

    Raises
    ------
    TrajectoryError
        Where the world has no free pixel.
    ParameterError
        Where `max_readings` is below 4.

    Notes
    -----
    Deterministic. What is inside is a guess, see `inside_building`.
    """
    if max_readings < len(CARDINAL_HEADINGS_RAD):
        raise ParameterError(f"max_readings must be 4 or more; got {max_readings!r}")
    all_around = sensor.fov_rad >= _ALL_AROUND_RAD
    headings = (0.0,) if all_around else CARDINAL_HEADINGS_RAD
    distance = clearance_map(world)
    lattice, wanted = _roomy_lattice(world, distance, sensor.range_px)
    parts = _parts(lattice, wanted)[: max_readings // len(CARDINAL_HEADINGS_RAD)]
    if not parts:
        raise _no_free_space(0.0)
    n_positions = max_readings / len(headings)
    spacing_px = _spacing(lattice, parts, sensor.range_px, n_positions)
    if spacing_px > sensor.range_px:
        # Too few to see everything: stay where there are walls to see.
        near = lattice.at(distance <= _NEAR_WALL_SHARE * sensor.range_px)
        parts = [part & near if (part & near).any() else part for part in parts]
        spacing_px = _spacing(lattice, parts, sensor.range_px, n_positions)
    poses, is_look = _walk_within(lattice, parts, spacing_px, headings, max_readings)
    keep = _best_looks(poses, is_look, world, sensor.range_px, max_readings)
    return Trajectory(poses=poses[keep])


def _spacing(
    lattice: Lattice, parts: list[BoolArray], range_px: float, n_positions: float
) -> float:
    """Return the spacing, px, that suits the range and spends the positions allowed."""
    area_px2 = sum(int(part.sum()) for part in parts) * float(lattice.step_px**2)
    affordable = np.sqrt(area_px2 / max(1.0, _SHARE_OF_POSITIONS * n_positions))
    useful = min(_SPACING_SHARE * range_px, np.sqrt(area_px2) / _SPACINGS_ACROSS)
    return float(max(affordable, useful))


def _walk_within(
    lattice: Lattice,
    parts: list[BoolArray],
    spacing_px: float,
    headings_rad: Sequence[float],
    max_readings: int,
) -> tuple[FloatArray, BoolArray]:
    """Return poses and looks as `_poses`, farther apart where the walk is too long."""
    while True:
        legs = [leg for part in parts for leg in _visit(lattice, part, spacing_px)]
        poses, is_look = _poses(legs, headings_rad)
        # The corners must stay, and one look at each position.
        needed = np.count_nonzero(~is_look) + len(legs)
        if needed <= max_readings or len(legs) == len(parts):
            return poses, is_look
        spacing_px *= 1.3


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


def _require_coverage(spacing_px: float, headings_rad: Sequence[float]) -> None:
    if not 0.0 < spacing_px < np.inf:
        raise ParameterError(
            f"spacing_px must be above 0 and finite; got {spacing_px!r}"
        )
    _require_headings(headings_rad)


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


def _wanted_region(world: World) -> BoolArray:
    """Return the inside of the building, or everywhere where there is none."""
    inside = inside_building(world) & ~world.occupied
    # Scattered walls in the open make pockets of "inside" that are no building.
    if np.count_nonzero(inside) < 0.1 * np.count_nonzero(~world.occupied):
        return ~world.occupied
    return np.asarray(inside)


def _lattice(world: World, free: BoolArray, step_px: int = 1) -> Lattice:
    fewest = int(np.ceil(np.sqrt(world.occupied.size / _MAX_NODES)))
    return build_lattice(free, max(step_px, fewest))


def _roomy_lattice(
    world: World, distance: FloatArray, range_px: float
) -> tuple[Lattice, BoolArray]:
    """Return the lattice, and its nodes inside, of the widest robot that gets around.

    A wide robot keeps well away from walls; where it would lose much of the building
    behind narrow doors, a narrower one is taken.
    """
    region = _wanted_region(world)
    widest = float(np.clip(_CLEARANCE_SHARE * range_px, *_CLEARANCE_LIMITS_PX))
    best = None
    for clearance_px in (widest, 0.5 * widest, 0.0):
        free = (distance >= clearance_px) & ~world.occupied
        lattice = _lattice(world, free, step_px=2 if min(world.shape) > 40 else 1)
        wanted = lattice.at(region)
        reach = max((int(part.sum()) for part in _parts(lattice, wanted)), default=0)
        total = np.count_nonzero(region) / lattice.step_px**2
        if best is None or reach > 1.3 * best[0]:
            best = reach, lattice, wanted
        if reach > _ENOUGH * total:
            break
    assert best is not None
    return best[1], best[2]


def _parts(lattice: Lattice, wanted: BoolArray) -> list[BoolArray]:
    """Return the wanted nodes of each connected part worth a visit, largest first.

    Only the largest where it holds most of them.
    """
    from scipy.sparse.csgraph import connected_components  # slow to import

    if not wanted.any():
        return []
    _, label = connected_components(lattice.graph, directed=False)
    size = np.bincount(label[wanted])
    order = np.argsort(-size, kind="stable")
    if size[order[0]] >= _ENOUGH * size.sum():
        order = order[:1]
    worth = [k for k in order if size[k] >= _LEAST_PART * size.sum()] or order[:1]
    return [wanted & (label == k) for k in worth]


def _visit(lattice: Lattice, part: BoolArray, spacing_px: float) -> list[FloatArray]:
    """Return the legs of a walk: each the corners (x, y) that lead to a position.

    A leg's last row is the position; the rows before it are turns on the way.
    """
    positions = spread(lattice, part, spacing_px)
    legs = []
    here: IntArray = np.empty(0, dtype=np.int64)
    for nodes in shortest_walk(lattice, positions):
        points = lattice.points_px(np.concatenate([here, nodes]))
        legs.append(points[corners(lattice.free, points)][len(here) :])
        here = nodes[-1:]
    return legs


def _poses(
    legs: list[FloatArray], headings_rad: Sequence[float]
) -> tuple[FloatArray, BoolArray]:
    """Return the poses of a walk, and which of them are looks around at a position.

    The robot turns on the spot from the heading it arrives with, clockwise on
    the screen; at a corner it looks along the way.
    """
    poses: list[tuple[float, float, float]] = []
    is_look: list[bool] = []
    facing = 0.0
    around = np.sort(np.mod(headings_rad, 2.0 * np.pi))
    for leg in legs:
        ahead = np.diff(leg, axis=0)
        ways = np.arctan2(ahead[:, 1], ahead[:, 0])
        poses += [(x, y, w) for (x, y), w in zip(leg[:-1], ways, strict=True)]
        if poses:
            last = leg[-1] - np.array(poses[-1][:2])
            facing = float(np.arctan2(last[1], last[0]))
        first = int(np.argmin(np.abs(wrap_angle(around - facing))))
        poses += [(*leg[-1], theta) for theta in np.roll(around, -first)]
        is_look += [False] * (len(leg) - 1) + [True] * len(around)
    return np.array(poses), np.array(is_look)


def _best_looks(
    poses: FloatArray,
    is_look: BoolArray,
    world: World,
    range_px: float,
    max_readings: int,
) -> IntArray:
    """Return which poses to keep, in order, where there are too many.

    Corners stay, and one look at each position; then looks that meet a wall; then
    the others. Of the kind that does not fit entirely, evenly spread ones.
    """
    kind = np.zeros(len(poses), dtype=np.int64)
    kind[is_look] = np.where(_meets_wall(poses[is_look], world, range_px), 1, 2)
    first = is_look & np.any(np.diff(poses[:, :2], axis=0, prepend=-1.0) != 0, axis=1)
    kind[first] = 0
    keep: list[int] = []
    for k in range(3):
        of_kind = np.flatnonzero(kind == k)
        room = max_readings - len(keep)
        if len(of_kind) > room:
            spread_out = np.linspace(0, len(of_kind) - 1, room).astype(np.int64)
            of_kind = of_kind[spread_out]
        keep += of_kind.tolist()
    return np.sort(np.array(keep, dtype=np.int64))


def _meets_wall(poses: FloatArray, world: World, range_px: float) -> BoolArray:
    """Return whether the straight view ahead ends at a wall, shape (S,)."""
    height, width = world.shape
    reach = np.arange(1.0, min(range_px, float(np.hypot(height, width))))
    x, y, theta = poses.T[:, :, None]
    cols = np.floor(x + reach * np.cos(theta)).astype(np.int64)
    rows = np.floor(y + reach * np.sin(theta)).astype(np.int64)
    within = (rows >= 0) & (rows < height) & (cols >= 0) & (cols < width)
    walls = world.occupied[np.where(within, rows, 0), np.where(within, cols, 0)]
    return np.asarray((walls & within).any(axis=1))

"""The class of buildings, and the tour that each opens with."""

import hashlib
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from occsim._types import BoolArray
from occsim.corrections import Corrections
from occsim.errors import DrawingError, ParameterError
from occsim.imaging import Drawing
from occsim.imaging.transform import Transform
from occsim.sensor import Sensor
from occsim.tour import default_tour
from occsim.trajectory import (
    Trajectory,
    drop_poses,
    inside_walls,
    outside_drawing,
)
from occsim.walls import WallParams, detect_walls
from occsim.world import World

TOUR_READINGS = 1000
"""Most readings in a drawing's first tour: a longer replay takes long to watch."""

DOOR_WIDTH_M = 0.9
"""Clear width of a usual door, m: the scale of a drawing that states none."""

Sketch = tuple[tuple[float, float, bool], ...]


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class Building:
    """A drawing and all that is needed to map it.

    Parameters
    ----------
    drawing : Drawing
        What the architect gives, shape (H, W).
    trajectory : Trajectory
        Where the readings are taken.
    found : ndarray of bool, shape (H, W), optional
        Walls found in the drawing. By default they are detected with `wall_params` on
        first use.
    corrections : Corrections, optional
        Corrections made to them by hand; none by default.
    unknown : ndarray of bool, shape (H, W), optional
        Pixels of which the drawing says nothing, as a robot's map of what it never
        saw: a prior made from it is one half there. None by default.
    truth : ndarray of bool, shape (H, W), optional
        Ground truth, in register with the drawing: structure only, doors open. Without
        one the corrected walls serve as the world.
    wall_params : WallParams
        Settings of the wall detection.
    sensor : Sensor
        The sensor proposed for this building: its range is the length of a door.
    tour : Trajectory, optional
        The tour planned for the building, if any. While the trajectory is this tour,
        `transformed` plans a new one.
    sketch : tuple of (float, float, bool)
        Sketch of a trajectory: x, y of its corners, px, and whether the corner is a
        waypoint set by hand or a point of a freehand line. May be empty.
    door_px : float, optional
        Length of a door leaf, px, where it is known.
    metres_per_px : float, optional
        Scale of the drawing, where it is known.
    name : str
        Short name; the drawing's by default. Samples have ``"a"`` to ``"e"``.
    title : str
        What the building is.
    about : str
        What the drawing shows, a sentence or two.

    Raises
    ------
    DrawingError
        Where a mask is not bool or differs in size from the drawing.
    ParameterError
        Where a length is not above 0 and finite.

    Notes
    -----
    Computed values are cached on the object and dropped by `dataclasses.replace`. To
    avoid a new detection after an edit, pass the walls as `found`.

    Examples
    --------
    >>> from occsim import load_sample
    >>> load_sample("a")
    Building('a': 460 x 350 px, 420 poses)
    """

    drawing: Drawing
    trajectory: Trajectory
    found: BoolArray | None = None
    # None becomes an empty overlay below: its size is the drawing's.
    corrections: Corrections = None  # type: ignore[assignment]
    unknown: BoolArray | None = None
    truth: BoolArray | None = None
    wall_params: WallParams = WallParams()
    sensor: Sensor = Sensor()
    tour: Trajectory | None = None
    sketch: Sketch = ()
    door_px: float | None = None
    metres_per_px: float | None = None
    name: str = ""
    title: str = "Your building"
    about: str = ""

    def __post_init__(self) -> None:
        shape = self.drawing.shape
        if self.corrections is None:
            object.__setattr__(self, "corrections", Corrections.none(shape))
        if not self.name:
            object.__setattr__(self, "name", self.drawing.name)
        _check_mask("wall mask", self.found, shape)
        _check_mask("unknown pixels", self.unknown, shape)
        _check_mask("ground truth", self.truth, shape)
        _check_size("corrections", self.corrections.shape, shape)
        for what in ("door_px", "metres_per_px"):
            value = getattr(self, what)
            if value is not None and not 0.0 < value < np.inf:
                raise ParameterError(f"{what} must be above 0 and finite; got {value}")

    def __repr__(self) -> str:
        height, width = self.drawing.shape
        size = f"{width} x {height} px, {len(self.trajectory)} poses"
        return f"Building({self.name!r}: {size})"

    @cached_property
    def walls_found(self) -> BoolArray:
        """Walls found in the drawing, ndarray of bool of shape (H, W)."""
        if self.found is not None:
            return self.found
        return detect_walls(self.drawing, self.wall_params).mask

    @cached_property
    def wall_mask(self) -> BoolArray:
        """Walls of the prior: those found, corrected; bool of shape (H, W)."""
        return self.corrections.apply(self.walls_found)

    @cached_property
    def world(self) -> World:
        """What the sensor sees: the ground truth, else the wall mask."""
        return World(occupied=self.wall_mask if self.truth is None else self.truth)

    @cached_property
    def digest(self) -> str:
        """Identifies everything that a result can depend on."""
        content = hashlib.sha256(self.drawing.digest.encode())
        parts = [self.wall_mask, self.world.occupied, self.trajectory.poses]
        if self.unknown is not None:
            parts.append(self.unknown)
        for part in parts:
            content.update(repr((part.shape, part.dtype.str)).encode())
            content.update(np.ascontiguousarray(part).data)
        return content.hexdigest()

    @property
    def likely_metres_per_px(self) -> float:
        """The scale; where it is unknown, the sensor's range is taken for a door."""
        return self.metres_per_px or DOOR_WIDTH_M / self.sensor.range_px

    @property
    def n_added(self) -> int:
        """Number of wall pixels that were not found but added by hand."""
        return int((self.wall_mask & ~self.walls_found).sum())

    @property
    def n_erased(self) -> int:
        """Number of wall pixels that were found and erased by hand."""
        return int((self.walls_found & ~self.wall_mask).sum())

    @cached_property
    def is_outside(self) -> BoolArray:
        """Which poses lie outside the drawing, ndarray of bool of shape (S,)."""
        return outside_drawing(self.trajectory, self.world)

    @cached_property
    def is_inside_walls(self) -> BoolArray:
        """Which poses stand in a wall of the world, ndarray of bool of shape (S,)."""
        return inside_walls(self.trajectory, self.world)

    @property
    def n_outside(self) -> int:
        """Number of poses outside the drawing."""
        return int(self.is_outside.sum())

    @property
    def n_inside_walls(self) -> int:
        """Number of poses that stand in a wall of the world."""
        return int(self.is_inside_walls.sum())

    def valid_trajectory(self) -> Trajectory:
        """Return the trajectory without poses outside the drawing or in walls.

        Raises
        ------
        TrajectoryError
            Where no pose would remain.
        """
        return drop_poses(self.trajectory, self.is_outside | self.is_inside_walls)

    def transformed(self, transform: Transform) -> "Building":
        """Return the building with its drawing transformed; walls are detected again.

        Parameters
        ----------
        transform : Transform
            Of the drawing's shape.

        Returns
        -------
        Building
            Masks, poses and sketch are transformed too; poses may end up outside. A
            planned tour is planned again.

        Raises
        ------
        DrawingError
            Where the drawing has another shape.
        TrajectoryError
            Where a tour is to be planned and no free space is left.
        """
        scale = transform.scale
        corners = transform.points([(x, y) for x, y, _ in self.sketch]).tolist()
        moved = replace(
            self,
            drawing=transform.drawing(self.drawing),
            found=None,
            corrections=self.corrections.transformed(transform),
            unknown=None if self.unknown is None else transform.mask(self.unknown),
            truth=None if self.truth is None else transform.mask(self.truth),
            trajectory=Trajectory(poses=transform.poses(self.trajectory.poses)),
            tour=None,
            sensor=replace(self.sensor, range_px=self.sensor.range_px * scale),
            sketch=tuple(
                (x, y, is_waypoint)
                for (x, y), (*_, is_waypoint) in zip(corners, self.sketch, strict=True)
            ),
            door_px=self.door_px and self.door_px * scale,
            metres_per_px=self.metres_per_px and self.metres_per_px / scale,
        )
        if self.trajectory is not self.tour:
            return moved
        tour = first_tour(moved.world, moved.sensor)
        return replace(moved, found=moved.walls_found, trajectory=tour, tour=tour)


def _check_mask(what: str, mask: BoolArray | None, shape: tuple[int, int]) -> None:
    if mask is None:
        return
    if mask.dtype != np.bool_:
        raise DrawingError(f"the {what} must be an array of bool; got {mask.dtype}")
    _check_size(what, mask.shape, shape)


def _check_size(what: str, got: tuple[int, ...], shape: tuple[int, int]) -> None:
    if got != shape:
        raise DrawingError(
            f"the {what} must have the drawing's size, {shape[1]} x {shape[0]} px; "
            f"got {' x '.join(str(side) for side in reversed(got))} px"
        )


def first_tour(world: World, sensor: Sensor) -> Trajectory:
    """Return the tour that a drawing opens with."""
    return default_tour(world, sensor, max_readings=TOUR_READINGS)

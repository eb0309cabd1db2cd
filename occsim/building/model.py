"""What a building is: drawing, masks with their corrections, trajectory, scale."""

import hashlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from occsim._types import BoolArray
from occsim.errors import DrawingError
from occsim.imaging import Drawing
from occsim.strokes import MAX_POINTS, MAX_STROKES, Stroke, apply_strokes
from occsim.trajectory import (
    Trajectory,
    inside_walls,
    outside,
    without,
)
from occsim.walls import WallParams
from occsim.world import World

DOOR_WIDTH_M = 0.9
"""Clear width of a usual door, m: the scale of a drawing that states none."""


@dataclass(frozen=True, eq=False)
class CorrectedMask:
    """A mask as it came, and the strokes that correct it.

    Parameters
    ----------
    base : ndarray of bool, shape (H, W)
        True on wall pixels, before any correction.
    strokes : tuple of Stroke
        Corrections by hand, in their order.
    """

    base: BoolArray
    strokes: tuple[Stroke, ...] = ()

    @cached_property
    def mask(self) -> BoolArray:
        """The corrected mask, ndarray of bool of shape (H, W)."""
        return apply_strokes(self.base, self.strokes)

    def with_strokes(self, strokes: tuple[Stroke, ...]) -> "CorrectedMask":
        """Return the same base with other strokes.

        Parameters
        ----------
        strokes : tuple of Stroke
            All of them, not only the new ones.

        Returns
        -------
        CorrectedMask
        """
        corrected = CorrectedMask(self.base, strokes)
        n_known = len(self.strokes)
        if strokes[:n_known] == self.strokes:
            # Only what is new is drawn: the thousandth stroke costs what the first did.
            mask = apply_strokes(self.mask, strokes[n_known:])
            corrected.__dict__["mask"] = mask
        return corrected

    def with_few_strokes(self) -> "CorrectedMask":
        """Return the same mask with no more strokes than can be read back.

        Returns
        -------
        CorrectedMask
            The oldest strokes of too many, or of too many points, are in its base.
        """
        n_points = n_kept = 0
        for stroke in reversed(self.strokes):
            n_points += len(stroke.points)
            if n_points > MAX_POINTS or n_kept == MAX_STROKES:
                break
            n_kept += 1
        n_old = len(self.strokes) - n_kept
        base = apply_strokes(self.base, self.strokes[:n_old])
        return CorrectedMask(base, self.strokes[n_old:])


def empty_mask(drawing: Drawing) -> CorrectedMask:
    """Return a mask of a drawing's size without any wall.

    Parameters
    ----------
    drawing : Drawing
        Gives the size.

    Returns
    -------
    CorrectedMask
    """
    return CorrectedMask(np.zeros(drawing.shape, dtype=bool))


@dataclass(frozen=True, eq=False, kw_only=True)
class Building:
    """What a student maps: drawing, walls found in it, ground truth, trajectory.

    Parameters
    ----------
    drawing : Drawing
        What the architect gave.
    walls : CorrectedMask
        Walls found in the drawing, corrected by hand: the prior comes from these.
    truth : CorrectedMask or None
        Ground truth. Without one the wall mask serves as the world.
    trajectory : Trajectory
        Where the readings are taken.
    wall_params : WallParams
        Settings with which the walls were found.
    sketch : tuple of (float, float, bool)
        Sketch of a trajectory: x, y of its corners, px, and whether the corner is a
        waypoint set by hand or one of the many of a free line. May be empty.
    door_px : float or None
        Length of a door, px, where it was measured.
    metres_per_px : float or None
        Scale of the drawing, where it is known.
    title, about : str
        Words for the screen.

    Raises
    ------
    DrawingError
        Where the images differ in size.
    """

    drawing: Drawing
    walls: CorrectedMask
    trajectory: Trajectory
    truth: CorrectedMask | None = None
    wall_params: WallParams = WallParams()
    sketch: tuple[tuple[float, float, bool], ...] = ()
    door_px: float | None = None
    metres_per_px: float | None = None
    title: str = "Your building"
    about: str = ""

    def __post_init__(self) -> None:
        height, width = self.drawing.shape
        sizes = {"wall mask": self.walls.base.shape}
        if self.truth is not None:
            sizes["ground truth"] = self.truth.base.shape
        for what, (h, w) in sizes.items():
            if (h, w) != (height, width):
                raise DrawingError(
                    f"the {what} must have the drawing's size, {width} x {height} px; "
                    f"got {w} x {h} px"
                )

    @property
    def wall_mask(self) -> BoolArray:
        """Walls of the prior, ndarray of bool of shape (H, W)."""
        return self.walls.mask

    @cached_property
    def world(self) -> World:
        """What the sensor sees: the ground truth, else the wall mask."""
        return World(occupied=(self.truth or self.walls).mask)

    @cached_property
    def digest(self) -> str:
        """Identifies everything that a result can depend on."""
        content = hashlib.sha256(self.drawing.digest.encode())
        for part in (self.wall_mask, self.world.occupied, self.trajectory.poses):
            content.update(repr((part.shape, part.dtype.str)).encode())
            content.update(part.tobytes())
        return content.hexdigest()

    @cached_property
    def is_outside(self) -> BoolArray:
        """Which poses lie outside the drawing, ndarray of bool of shape (S,)."""
        return outside(self.trajectory, self.world)

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
        return without(self.trajectory, self.is_outside | self.is_inside_walls)

"""Buildings from samples and drawings, and trajectories through them."""

from collections.abc import Sequence

import numpy as np

from occsim.building.model import DOOR_WIDTH_M, Building, CorrectedMask
from occsim.imaging import MAX_SIDE_PX, Drawing
from occsim.imaging.transform import fit_to
from occsim.samples import load_sample
from occsim.sensor import Sensor
from occsim.tour import default_tour, random_poses
from occsim.trajectory import HeadingMode, Trajectory, resample
from occsim.walls import WallParams, detect_walls
from occsim.world import World, world_from_image

TOUR_READINGS = 1000
"""Most readings of the first tour of a drawing: a replay of more is long to watch."""


def building_from_sample(name: str, params: WallParams | None = None) -> Building:
    """Return a reference drawing as a building, its walls detected.

    Parameters
    ----------
    name : str
        One of `occsim.sample_names`.
    params : WallParams, optional
        Settings of the detection; automatic by default.

    Returns
    -------
    Building
    """
    sample = load_sample(name)
    params = params or WallParams()
    found = detect_walls(sample.drawing, params)
    return Building(
        drawing=sample.drawing,
        walls=CorrectedMask(found.mask),
        truth=CorrectedMask(sample.world.occupied),
        trajectory=sample.trajectory,
        wall_params=params,
        door_px=sample.door_px,
        metres_per_px=DOOR_WIDTH_M / sample.door_px,
        title=sample.title,
        about=sample.about,
    )


def building_from_drawing(
    drawing: Drawing,
    sensor: Sensor,
    params: WallParams | None = None,
    *,
    working_px: int = MAX_SIDE_PX,
) -> Building:
    """Return a building from a drawing alone, ready to be mapped.

    The walls found serve as the world until a ground truth is given, and the
    trajectory is a default tour of the free space.

    Parameters
    ----------
    drawing : Drawing
        What the architect gave.
    sensor : Sensor
        The tour shows the building to it, in `TOUR_READINGS` at most.
    params : WallParams, optional
        Settings of the detection; automatic by default.
    working_px : int, optional
        Longer side to which a larger drawing is scaled down, px; by default it is not.

    Returns
    -------
    Building
        It says about itself from what size it was scaled down.

    Raises
    ------
    TrajectoryError
        Where the walls leave no free space to drive in.
    """
    params = params or WallParams()
    height, width = drawing.shape
    drawing = fit_to(drawing, working_px)
    is_smaller = drawing.shape != (height, width)
    found = detect_walls(drawing, params)
    world = World(occupied=found.mask)
    return Building(
        drawing=drawing,
        walls=CorrectedMask(found.mask),
        trajectory=default_tour(world, sensor, max_readings=TOUR_READINGS),
        wall_params=params,
        title=drawing.name,
        about=f"Scaled down from {width} × {height} px." if is_smaller else "",
    )


def truth_from_image(image: Drawing, shape: tuple[int, int]) -> CorrectedMask:
    """Return a ground truth from its picture: black is wall, white is free.

    Parameters
    ----------
    image : Drawing
        Of the drawing's size, or of the size that the drawing had before it was scaled
        down to its working size.
    shape : tuple of int
        Height and width of the drawing, px.

    Returns
    -------
    CorrectedMask
        Of the image's own size where that does not fit, to be refused by `Building`.
    """
    fitted = fit_to(image, max(shape))
    chosen = fitted if fitted.shape == shape else image
    return CorrectedMask(world_from_image(chosen).occupied)


def random_trajectory(world: World, n: int, seed: int) -> Trajectory:
    """Return random poses in free space, the same ones for the same seed.

    Parameters
    ----------
    world : World
        What the robot stands in.
    n : int
        Poses, 1 or more.
    seed : int
        Decides, 0 or more.

    Returns
    -------
    Trajectory
        With the four cardinal headings.

    Raises
    ------
    TrajectoryError
        Where there is no free space.
    """
    return random_poses(world, n, rng=np.random.default_rng(seed))


def sketched_trajectory(
    sketch: Sequence[tuple[float, float, bool]],
    step_px: float,
    heading_mode: HeadingMode = HeadingMode.ALONG,
    turn: bool = False,
) -> Trajectory:
    """Return the readings along a sketch.

    Parameters
    ----------
    sketch : sequence of (float, float, bool)
        As in `Building`; at least one corner.
    step_px : float
        Between readings, px.
    heading_mode : HeadingMode, default HeadingMode.ALONG
        Where the robot looks.
    turn : bool, default False
        Whether it turns on the spot at waypoints set by hand.

    Returns
    -------
    Trajectory

    Raises
    ------
    TrajectoryError, ParameterError
        As `occsim.resample` does.
    """
    return resample(
        [(x, y) for x, y, _ in sketch],
        step_px,
        heading_mode=heading_mode,
        turn_at_waypoints=[turn and is_waypoint for *_, is_waypoint in sketch],
    )

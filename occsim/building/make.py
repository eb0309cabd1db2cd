"""A building from a drawing alone, and a ground truth from its picture."""

from occsim._types import BoolArray
from occsim.building.building import Building, first_tour
from occsim.imaging import MAX_SIDE_PX, Drawing
from occsim.imaging.transform import Transform
from occsim.sensor import Sensor
from occsim.walls import WallDetection, WallParams, detect_walls, propose_scale
from occsim.world import World, world_from_image


def building_from_drawing(
    drawing: Drawing,
    sensor: Sensor | None = None,
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
    sensor : Sensor, optional
        The tour shows the building to it, in `TOUR_READINGS` at most. By default its
        range is the length of a door that is proposed for the drawing, as in the
        source; see `occsim.walls.propose_scale`.
    params : WallParams, optional
        Settings of the detection; automatic by default.
    working_px : int, optional
        Longer side to which a larger drawing is scaled down, px; by default it is not.

    Returns
    -------
    Building
        Its `about` states the size before scaling down.

    Raises
    ------
    TrajectoryError
        Where the walls leave no free space to drive in.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.building import building_from_drawing
    >>> building = building_from_drawing(load_sample("d").drawing)
    >>> len(building.trajectory) > 10
    True
    """
    height, width = drawing.shape
    drawing = Transform.fit(drawing.shape, working_px).drawing(drawing)
    is_smaller = drawing.shape != (height, width)
    params = params or WallParams()
    found = detect_walls(drawing, params)
    sensor = sensor or proposed_sensor(found)
    tour = first_tour(World(occupied=found.mask), sensor)
    return Building(
        drawing=drawing,
        found=found.mask,
        trajectory=tour,
        tour=tour,
        wall_params=params,
        sensor=sensor,
        title=drawing.name,
        about=f"Scaled down from {width} × {height} px." if is_smaller else "",
    )


def proposed_sensor(found: WallDetection) -> Sensor:
    """Return the sensor whose range is the length of a door that is proposed.

    Parameters
    ----------
    found : WallDetection
        The walls of a drawing.

    Returns
    -------
    Sensor
        The default one where no door is proposed; see `occsim.walls.propose_scale`.
    """
    proposal = propose_scale(found)
    return Sensor() if proposal is None else Sensor(range_px=proposal.door_px)


def truth_from_image(image: Drawing, shape: tuple[int, int]) -> BoolArray:
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
    ndarray of bool
        Scaling down keeps every wall. An image of any other size is returned at its own
        size, which `Building` refuses.
    """
    return mask_of_size(world_from_image(image).occupied, shape)


def mask_of_size(mask: BoolArray, shape: tuple[int, int]) -> BoolArray:
    """Return a mask scaled down to a drawing's size, if it is one of that drawing.

    Parameters
    ----------
    mask : ndarray of bool
        Of the drawing's size, or of that which it had before it was scaled down.
    shape : tuple of int
        Height and width of the drawing, px.

    Returns
    -------
    ndarray of bool
        As it is where it has any other size.
    """
    height, width = mask.shape
    fit = Transform.fit((height, width), max(shape))
    return fit.mask(mask) if fit.new_shape == shape else mask

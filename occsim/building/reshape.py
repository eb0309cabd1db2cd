"""A building whose drawing is cropped or turned; all that was made on it follows."""

from dataclasses import replace

from occsim.building.model import Building, CorrectedMask
from occsim.imaging.transform import Transform
from occsim.strokes import Stroke
from occsim.trajectory import Trajectory
from occsim.walls import detect_walls


def transformed(building: Building, transform: Transform) -> Building:
    """Return the building on its drawing, moved; its walls are found anew.

    Parameters
    ----------
    building : Building
        All that was made on its drawing moves along; poses may come to lie outside.
    transform : Transform
        Of the drawing's shape.

    Returns
    -------
    Building

    Raises
    ------
    DrawingError
        Where the drawing has another shape.
    """
    drawing, truth = transform.drawing(building.drawing), building.truth
    if truth is not None:
        strokes = _moved(truth.strokes, transform)
        truth = CorrectedMask(transform.mask(truth.base), strokes)
    walls = CorrectedMask(
        detect_walls(drawing, building.wall_params).mask,
        _moved(building.walls.strokes, transform),
    )
    corners = transform.points([(x, y) for x, y, _ in building.sketch]).tolist()
    return replace(
        building,
        drawing=drawing,
        walls=walls,
        truth=truth,
        trajectory=Trajectory(poses=transform.poses(building.trajectory.poses)),
        sketch=tuple(
            (x, y, is_waypoint)
            for (x, y), (*_, is_waypoint) in zip(corners, building.sketch, strict=True)
        ),
    )


def _moved(strokes: tuple[Stroke, ...], transform: Transform) -> tuple[Stroke, ...]:
    return tuple(
        replace(stroke, points=tuple(map(tuple, transform.points(stroke.points))))
        for stroke in strokes
    )

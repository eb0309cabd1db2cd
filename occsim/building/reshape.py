"""A building whose drawing is cropped or turned; all that was made on it follows."""

import math
from dataclasses import replace

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.building.model import Building, CorrectedMask
from occsim.imaging import Drawing
from occsim.imaging.transform import (
    crop,
    crop_matrix,
    deskew,
    deskew_matrix,
    move_points,
    rotate90,
    rotate90_matrix,
)
from occsim.strokes import Stroke
from occsim.trajectory import Trajectory
from occsim.walls import detect_walls


def cropped(
    building: Building, x_px: int, y_px: int, width_px: int, height_px: int
) -> Building:
    """Return the building in a rectangle of its drawing.

    Parameters
    ----------
    building : Building
        Anything made on its drawing moves with it; poses may come to lie outside.
    x_px, y_px, width_px, height_px : int
        The rectangle, px.

    Returns
    -------
    Building
        Its walls found anew.

    Raises
    ------
    DrawingError
        Where too little remains.
    """
    drawing = crop(building.drawing, x_px, y_px, width_px, height_px)
    return _moved(building, drawing, crop_matrix(x_px, y_px))


def turned(building: Building, quarter_turns: int) -> Building:
    """Return the building with its drawing turned by quarter turns.

    Parameters
    ----------
    building : Building
        Anything made on its drawing turns with it.
    quarter_turns : int
        Clockwise; negative ones the other way.

    Returns
    -------
    Building
        Its walls found anew.
    """
    drawing = rotate90(building.drawing, quarter_turns)
    matrix = rotate90_matrix(building.drawing.shape, quarter_turns)
    return _moved(building, drawing, matrix)


def straightened(building: Building, tilt_rad: float) -> Building:
    """Return the building with its drawing turned back by its tilt.

    Parameters
    ----------
    building : Building
        Anything made on its drawing turns with it; rectangles drawn by hand keep two of
        their corners and stay upright.
    tilt_rad : float
        As from `occsim.imaging.tilt.estimate_tilt`, rad.

    Returns
    -------
    Building
        Its walls found anew.

    Raises
    ------
    DrawingError, ParameterError
        As `occsim.imaging.transform.deskew` does.
    """
    drawing = deskew(building.drawing, tilt_rad)
    matrix = deskew_matrix(building.drawing.shape, tilt_rad)
    return _moved(building, drawing, matrix)


def _moved(building: Building, drawing: Drawing, matrix: FloatArray) -> Building:
    """Return the building on a new drawing, moved there by a rigid motion."""
    truth = building.truth
    if truth is not None:
        base = _moved_mask(truth.base, matrix, drawing.shape)
        truth = CorrectedMask(base, _moved_strokes(truth.strokes, matrix))
    walls = CorrectedMask(
        detect_walls(drawing, building.wall_params).mask,
        _moved_strokes(building.walls.strokes, matrix),
    )
    return replace(
        building,
        drawing=drawing,
        walls=walls,
        truth=truth,
        trajectory=_moved_trajectory(building.trajectory, matrix),
        sketch=tuple(
            (*_moved_point((x, y), matrix), is_waypoint)
            for x, y, is_waypoint in building.sketch
        ),
    )


def _moved_mask(
    mask: BoolArray, matrix: FloatArray, shape: tuple[int, int]
) -> BoolArray:
    centred = matrix.copy()
    # OpenCV counts from the centre of the first pixel, this library from its corner.
    centred[:, 2] += matrix[:, :2] @ (0.5, 0.5) - 0.5
    moved = cv2.warpAffine(
        mask.astype(np.uint8), centred, shape[::-1], flags=cv2.INTER_NEAREST
    )
    return np.asarray(moved > 0)


def _moved_strokes(
    strokes: tuple[Stroke, ...], matrix: FloatArray
) -> tuple[Stroke, ...]:
    return tuple(
        replace(stroke, points=tuple(_moved_point(p, matrix) for p in stroke.points))
        for stroke in strokes
    )


def _moved_point(point: tuple[float, float], matrix: FloatArray) -> tuple[float, float]:
    x, y = move_points([point], matrix)[0].tolist()
    return x, y


def _moved_trajectory(trajectory: Trajectory, matrix: FloatArray) -> Trajectory:
    turn = math.atan2(matrix[1, 0], matrix[0, 0])
    xy = move_points(trajectory.poses[:, :2], matrix)
    return Trajectory(poses=np.column_stack([xy, trajectory.poses[:, 2] + turn]))

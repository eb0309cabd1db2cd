"""Bringing a drawing into shape: working size, crop, quarter turns, straightening.

Each operation returns a new `Drawing` of the same name. Beside each stands the matrix
of shape (2, 3) that takes a point x, y (px) of the old drawing to the new one; with
`move_points`, what was sketched on the old drawing follows.
"""

import cv2
import numpy as np
import numpy.typing as npt

from occsim._types import ByteArray, FloatArray
from occsim.errors import DrawingError, ParameterError
from occsim.imaging.drawing import Drawing
from occsim.imaging.source import MAX_PIXELS, MAX_SIDE_PX, MIN_SIDE_PX


def move_points(points_px: npt.ArrayLike, matrix: FloatArray) -> FloatArray:
    """Return points of the old drawing in the new one.

    Parameters
    ----------
    points_px : array_like of shape (K, 2)
        x, y, px.
    matrix : ndarray of float64, shape (2, 3)
        From one of this module's functions.

    Returns
    -------
    ndarray of float64, shape (K, 2)
    """
    points = np.asarray(points_px, dtype=np.float64)
    return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def fit_to(drawing: Drawing, max_side_px: int) -> Drawing:
    """Return the drawing, scaled down so that its longer side fits.

    Parameters
    ----------
    drawing : Drawing
        Any size.
    max_side_px : int
        Longer side allowed, px, at least `MIN_SIDE_PX`.

    Returns
    -------
    Drawing
        The drawing itself where it fits. Otherwise each new pixel is the mean of
        those it covers, so that thin lines grow pale but do not vanish.

    Raises
    ------
    ParameterError
        Where `max_side_px` is too small.
    """
    height, width = _fitted(drawing.shape, max_side_px)
    if (height, width) == drawing.shape:
        return drawing
    rgb = cv2.resize(drawing.rgb, (width, height), interpolation=cv2.INTER_AREA)
    return _renewed(drawing, rgb)


def fit_matrix(shape: tuple[int, int], max_side_px: int) -> FloatArray:
    """Return the matrix of `fit_to`.

    Parameters
    ----------
    shape : tuple of int
        Height and width of the old drawing, px.
    max_side_px : int
        As in `fit_to`.

    Returns
    -------
    ndarray of float64, shape (2, 3)
    """
    height, width = _fitted(shape, max_side_px)
    return np.array([[width / shape[1], 0.0, 0.0], [0.0, height / shape[0], 0.0]])


def _fitted(shape: tuple[int, int], max_side_px: int) -> tuple[int, int]:
    if max_side_px < MIN_SIDE_PX:
        raise ParameterError(
            f"max_side_px must be {MIN_SIDE_PX} or more; got {max_side_px!r}"
        )
    scale = min(1.0, max_side_px / max(shape))
    height, width = (max(1, round(side * scale)) for side in shape)
    return height, width


def crop(
    drawing: Drawing, x_px: int, y_px: int, width_px: int, height_px: int
) -> Drawing:
    """Return a rectangle of the drawing.

    Parameters
    ----------
    drawing : Drawing
        Any size.
    x_px, y_px : int
        Top left corner of the rectangle, px.
    width_px, height_px : int
        Its size, px, at least `MIN_SIDE_PX` each. What reaches beyond the drawing is
        left out.

    Returns
    -------
    Drawing

    Raises
    ------
    DrawingError
        Where less than `MIN_SIDE_PX` each way remains.
    """
    height, width = drawing.shape
    left, top, right, bottom = _box(x_px, y_px, width_px, height_px, (height, width))
    if min(right - left, bottom - top) < MIN_SIDE_PX:
        raise DrawingError(
            f"a crop must keep at least {MIN_SIDE_PX} px each way of the drawing's "
            f"{width} x {height} px; got {max(right - left, 0)} x "
            f"{max(bottom - top, 0)} px"
        )
    return _renewed(drawing, drawing.rgb[top:bottom, left:right])


def crop_matrix(x_px: int, y_px: int) -> FloatArray:
    """Return the matrix of `crop`.

    Parameters
    ----------
    x_px, y_px : int
        As in `crop`.

    Returns
    -------
    ndarray of float64, shape (2, 3)
    """
    return np.array([[1.0, 0.0, -max(x_px, 0)], [0.0, 1.0, -max(y_px, 0)]])


def _box(
    x_px: int, y_px: int, width_px: int, height_px: int, shape: tuple[int, int]
) -> tuple[int, int, int, int]:
    """Return left, top, right and bottom of a rectangle, inside the drawing."""
    right, bottom = min(x_px + width_px, shape[1]), min(y_px + height_px, shape[0])
    return max(x_px, 0), max(y_px, 0), right, bottom


def rotate90(drawing: Drawing, turns: int = 1) -> Drawing:
    """Return the drawing turned by quarter turns.

    Parameters
    ----------
    drawing : Drawing
        Any size.
    turns : int, default 1
        Quarter turns clockwise; negative ones the other way.

    Returns
    -------
    Drawing
        The same pixels, none lost.
    """
    return _renewed(drawing, np.rot90(drawing.rgb, -turns))


def rotate90_matrix(shape: tuple[int, int], turns: int = 1) -> FloatArray:
    """Return the matrix of `rotate90`.

    Parameters
    ----------
    shape : tuple of int
        Height and width of the old drawing, px.
    turns : int, default 1
        As in `rotate90`.

    Returns
    -------
    ndarray of float64, shape (2, 3)
    """
    height, width = shape
    return np.array(
        [
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[0.0, -1.0, height], [1.0, 0.0, 0.0]],
            [[-1.0, 0.0, width], [0.0, -1.0, height]],
            [[0.0, 1.0, 0.0], [-1.0, 0.0, width]],
        ][turns % 4]
    )


def deskew(drawing: Drawing, tilt_rad: float) -> Drawing:
    """Return the drawing turned back by its tilt.

    Parameters
    ----------
    drawing : Drawing
        Any size.
    tilt_rad : float
        As from `estimate_tilt`, rad: the direction on the page, from +x towards +y,
        of what should be horizontal; at most a quarter of pi either way.

    Returns
    -------
    Drawing
        Larger, so that no corner is lost; new corners are white.

    Raises
    ------
    ParameterError
        Where the tilt is larger or not finite.
    DrawingError
        Where the larger drawing would have more pixels than allowed.
    """
    matrix = deskew_matrix(drawing.shape, tilt_rad)
    height, width = _deskewed(drawing.shape, tilt_rad)
    if width * height > MAX_PIXELS or max(width, height) > MAX_SIDE_PX:
        raise DrawingError(
            f"a drawing may have at most {MAX_PIXELS / 1e6:.0f} megapixels; turned "
            f"upright it would have {width:,} x {height:,} px"
        )
    # OpenCV counts from the centre of the first pixel, this library from its corner.
    matrix[:, 2] += matrix[:, :2] @ (0.5, 0.5) - 0.5
    rgb = cv2.warpAffine(
        drawing.rgb,
        matrix,
        (width, height),
        flags=cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(255, 255, 255),
    )
    return _renewed(drawing, rgb)


def deskew_matrix(shape: tuple[int, int], tilt_rad: float) -> FloatArray:
    """Return the matrix of `deskew`: a turn about the drawing's centre.

    Parameters
    ----------
    shape : tuple of int
        Height and width of the old drawing, px.
    tilt_rad : float
        As in `deskew`.

    Returns
    -------
    ndarray of float64, shape (2, 3)

    Raises
    ------
    ParameterError
        As in `deskew`.
    """
    height, width = _deskewed(shape, tilt_rad)
    cos, sin = np.cos(tilt_rad), np.sin(tilt_rad)
    turn = np.array([[cos, sin], [-sin, cos]])
    old_centre = np.array([shape[1], shape[0]]) / 2.0
    shift = np.array([width, height]) / 2.0 - turn @ old_centre
    return np.column_stack([turn, shift])


def _deskewed(shape: tuple[int, int], tilt_rad: float) -> tuple[int, int]:
    """Return the height and width that hold a turned page."""
    if not abs(tilt_rad) <= np.pi / 4:
        raise ParameterError(
            f"tilt_rad must lie in [-pi/4, pi/4]; got {tilt_rad!r}; "
            "larger turns are for rotate90"
        )
    height, width = shape
    cos, sin = np.cos(tilt_rad), abs(np.sin(tilt_rad))
    # A hair of rounding must not add a row to a drawing that is not turned.
    new_height = np.ceil(height * cos + width * sin - 1e-6)
    new_width = np.ceil(width * cos + height * sin - 1e-6)
    return int(new_height), int(new_width)


def _renewed(drawing: Drawing, rgb: npt.ArrayLike) -> Drawing:
    pixels: ByteArray = np.array(rgb, dtype=np.uint8, order="C")
    return Drawing(rgb=pixels, name=drawing.name)

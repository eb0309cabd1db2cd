"""One transform of a drawing: crop, quarter turns, straightening or working size.

A `Transform` holds the matrix that takes a point x, y (px) of the old drawing to the
new one. It is applied to the drawing and to everything located on it: masks, points,
poses.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.errors import DrawingError, ParameterError
from occsim.imaging.drawing import Drawing
from occsim.imaging.source import MAX_PIXELS, MAX_SIDE_PX, MIN_SIDE_PX

Shape = tuple[int, int]

WHITE = (255, 255, 255)

EDGE_EPS_PX = 1e-9
"""Far above the rounding of a position in a drawing, far below a visible shift."""

# Cosine and sine of the quarter turns, clockwise on the screen.
_QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


@dataclass(frozen=True, eq=False)
class Transform:
    """A transform of a drawing and of everything located on it.

    Made by `crop`, `quarter_turns`, `straighten` or `fit`.

    Parameters
    ----------
    matrix : ndarray of float64, shape (2, 3)
        Takes x, y, 1 of the old drawing to x, y of the new one, px. A private copy is
        kept, never written to.
    old_shape, new_shape : tuple of int
        Height and width of the drawing before and after, px.

    Examples
    --------
    >>> turn = Transform.quarter_turns((30, 40))
    >>> turn.new_shape
    (40, 30)
    >>> turn.points([[0.0, 0.0]]).tolist()
    [[30.0, 0.0]]
    """

    matrix: FloatArray
    old_shape: Shape
    new_shape: Shape

    def __post_init__(self) -> None:
        matrix = np.array(self.matrix, dtype=np.float64)
        matrix.setflags(write=False)
        object.__setattr__(self, "matrix", matrix)

    @classmethod
    def crop(
        cls, shape: Shape, x_px: int, y_px: int, width_px: int, height_px: int
    ) -> "Transform":
        """Keep a rectangle of the drawing.

        Parameters
        ----------
        shape : tuple of int
            Height and width of the drawing, px.
        x_px, y_px : int
            Top left corner of the rectangle, px.
        width_px, height_px : int
            Its size, px. The part beyond the drawing is left out.

        Returns
        -------
        Transform

        Raises
        ------
        DrawingError
            Where less than `MIN_SIDE_PX` each way remains.
        """
        left, top = max(x_px, 0), max(y_px, 0)
        width = max(min(x_px + width_px, shape[1]) - left, 0)
        height = max(min(y_px + height_px, shape[0]) - top, 0)
        if min(width, height) < MIN_SIDE_PX:
            raise DrawingError(
                f"a crop must keep at least {MIN_SIDE_PX} px each way of the drawing's "
                f"{shape[1]} x {shape[0]} px; got {width} x {height} px"
            )
        return cls(np.array([[1, 0, -left], [0, 1, -top]]), shape, (height, width))

    @classmethod
    def quarter_turns(cls, shape: Shape, turns: int = 1) -> "Transform":
        """Turn the drawing by quarter turns; no pixel is lost.

        Parameters
        ----------
        shape : tuple of int
            Height and width of the drawing, px.
        turns : int, default 1
            Clockwise; negative for counter-clockwise.

        Returns
        -------
        Transform
        """
        new_shape = shape if turns % 2 == 0 else shape[::-1]
        return cls(_turned(*_QUARTERS[turns % 4], shape, new_shape), shape, new_shape)

    @classmethod
    def straighten(cls, shape: Shape, tilt_rad: float) -> "Transform":
        """Turn the drawing back by its tilt, about its centre.

        Parameters
        ----------
        shape : tuple of int
            Height and width of the drawing, px.
        tilt_rad : float
            As from `occsim.imaging.tilt.estimate_tilt`, rad: the direction on the page,
            from +x towards +y, of what should be horizontal; at most pi / 4 either way.

        Returns
        -------
        Transform
            The new drawing is larger, so that no corner is lost.

        Raises
        ------
        ParameterError
            Where the tilt is larger or not finite.
        DrawingError
            Where the larger drawing would have more pixels than allowed.
        """
        if not abs(tilt_rad) <= np.pi / 4:
            raise ParameterError(
                f"tilt_rad must lie in [-pi/4, pi/4]; got {tilt_rad!r}; "
                "larger turns are quarter turns"
            )
        cos, sin = float(np.cos(tilt_rad)), float(np.sin(tilt_rad))
        new_shape = _turned_shape(shape, cos, abs(sin))
        if new_shape[0] * new_shape[1] > MAX_PIXELS or max(new_shape) > MAX_SIDE_PX:
            raise DrawingError(
                f"a drawing may have at most {MAX_PIXELS / 1e6:.0f} megapixels; turned "
                f"upright it would have {new_shape[1]:,} x {new_shape[0]:,} px"
            )
        return cls(_turned(cos, -sin, shape, new_shape), shape, new_shape)

    @classmethod
    def fit(cls, shape: Shape, max_side_px: int) -> "Transform":
        """Scale the drawing down so that its longer side fits.

        Parameters
        ----------
        shape : tuple of int
            Height and width of the drawing, px.
        max_side_px : int
            Longer side allowed, px, at least `MIN_SIDE_PX`.

        Returns
        -------
        Transform
            The identity where the drawing fits.

        Raises
        ------
        ParameterError
            Where `max_side_px` is too small.
        """
        if max_side_px < MIN_SIDE_PX:
            raise ParameterError(
                f"max_side_px must be {MIN_SIDE_PX} or more; got {max_side_px!r}"
            )
        scale = min(1.0, max_side_px / max(shape))
        height, width = (max(1, round(side * scale)) for side in shape)
        down, across = height / shape[0], width / shape[1]
        return cls(np.array([[across, 0, 0], [0, down, 0]]), shape, (height, width))

    def drawing(self, drawing: Drawing) -> Drawing:
        """Return the drawing, moved.

        Parameters
        ----------
        drawing : Drawing
            Of the old shape.

        Returns
        -------
        Drawing
            Of the same name; the same object for the identity. New corners are white.
            Scaled down, a pixel is the mean of those it covers: thin lines grow pale
            but do not vanish.

        Raises
        ------
        DrawingError
            Where the drawing has another shape.
        """
        self._check(drawing.shape, "drawing")
        if self._is_identity:
            return drawing
        if self.scale < 1.0:
            size = self.new_shape[::-1]
            rgb = cv2.resize(drawing.rgb, size, interpolation=cv2.INTER_AREA)
        else:
            rgb = self._warped(drawing.rgb, cv2.INTER_CUBIC, WHITE)
        pixels: ByteArray = np.array(rgb, dtype=np.uint8, order="C")
        return Drawing(rgb=pixels, name=drawing.name)

    def mask(self, mask: BoolArray) -> BoolArray:
        """Return a mask, moved.

        Parameters
        ----------
        mask : ndarray of bool, shape (H, W)
            Of the old shape.

        Returns
        -------
        ndarray of bool
            Of the new shape; new corners are False. Scaled down, a pixel is True where
            any True pixel falls into it: no line is lost, however thin.

        Raises
        ------
        DrawingError
            Where the mask has another shape.
        """
        self._check(mask.shape, "mask")
        if self._is_identity:
            return mask
        if self.scale == 1.0:
            moved = self._warped(mask.astype(np.uint8), cv2.INTER_NEAREST, (0,))
            return np.asarray(moved > 0)
        rows, cols = np.nonzero(mask)
        centres = self.points(np.stack([cols, rows], axis=1) + 0.5)
        # A centre on the edge of two pixels belongs to the second, however it rounds.
        places = (centres + EDGE_EPS_PX).astype(np.int64)
        out = np.zeros(self.new_shape, dtype=bool)
        out[places[:, 1], places[:, 0]] = True
        return out

    def points(self, points_px: npt.ArrayLike) -> FloatArray:
        """Return points of the old drawing in the new one.

        Parameters
        ----------
        points_px : array_like of shape (K, 2)
            x, y, px.

        Returns
        -------
        ndarray of float64, shape (K, 2)
            They may lie outside.
        """
        points = np.asarray(points_px, dtype=np.float64).reshape(-1, 2)
        return np.asarray(points @ self.matrix[:, :2].T + self.matrix[:, 2])

    def poses(self, poses: npt.ArrayLike) -> FloatArray:
        """Return poses on the old drawing in the new one.

        Parameters
        ----------
        poses : array_like of shape (S, 3)
            x_px, y_px, theta_rad.

        Returns
        -------
        ndarray of float64, shape (S, 3)
            Headings turned along. Poses may lie outside.
        """
        rows = np.asarray(poses, dtype=np.float64)
        turn = np.arctan2(self.matrix[1, 0], self.matrix[0, 0])
        return np.column_stack([self.points(rows[:, :2]), rows[:, 2] + turn])

    @property
    def scale(self) -> float:
        """Length in the new drawing of what was one pixel long; 1 for turns."""
        scale = float(np.sqrt(abs(np.linalg.det(self.matrix[:, :2]))))
        # The rounding of a sine must not make a turn look like a change of size.
        return scale if scale < 1.0 - 1e-9 else 1.0

    @property
    def _is_identity(self) -> bool:
        is_same = bool((self.matrix == np.eye(2, 3)).all())
        return is_same and self.new_shape == self.old_shape

    def _warped(
        self, image: ByteArray, interpolation: int, border: tuple[int, ...]
    ) -> ByteArray:
        matrix = self.matrix.copy()
        # OpenCV counts from the centre of the first pixel, this library from its
        # corner.
        matrix[:, 2] += matrix[:, :2] @ (0.5, 0.5) - 0.5
        # Whole pixels are copied, not interpolated.
        is_whole = bool((matrix == np.round(matrix)).all())
        warped = cv2.warpAffine(
            image,
            matrix,
            self.new_shape[::-1],
            flags=cv2.INTER_NEAREST if is_whole else interpolation,
            borderMode=cv2.BORDER_CONSTANT,
            borderValue=border,
        )
        return np.asarray(warped, dtype=np.uint8)

    def _check(self, shape: tuple[int, ...], what: str) -> None:
        if shape != self.old_shape:
            height, width = self.old_shape
            raise DrawingError(
                f"the {what} must have shape ({height}, {width}), that of the drawing "
                f"to be moved; got {shape}"
            )


def _turned(cos: float, sin: float, shape: Shape, new_shape: Shape) -> FloatArray:
    """Return the matrix of a turn that takes the old centre to the new one."""
    turn = np.array([[cos, -sin], [sin, cos]])
    old_centre, new_centre = (np.array(s[::-1]) / 2.0 for s in (shape, new_shape))
    return np.column_stack([turn, new_centre - turn @ old_centre])


def _turned_shape(shape: Shape, cos: float, sin: float) -> Shape:
    """Return the height and width that hold a turned page."""
    height, width = shape
    # The rounding of a sine must not add a row to a drawing that is not turned.
    new_height = np.ceil(height * cos + width * sin - 1e-6)
    new_width = np.ceil(width * cos + height * sin - 1e-6)
    return int(new_height), int(new_width)

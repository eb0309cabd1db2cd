"""The image frame, headings, and angles.

One frame everywhere: x to the right, y **down**, origin at the outer corner of the
top-left pixel, unit pixel. Pixel (row r, col c) covers [c, c+1) x [r, r+1) and has its
centre at (c + 0.5, r + 0.5). A heading is in radians, from +x towards +y, so that
pi/2 points down on the screen. Frames with y up (ROS, TUM, CARMEN) are converted in
:mod:`occsim.io` and nowhere else.
"""

import numpy as np
import numpy.typing as npt

from occsim._types import FloatArray

CARDINAL_HEADINGS_RAD = (0.0, 0.5 * np.pi, np.pi, 1.5 * np.pi)
"""Right, down, left, up: the source's headings, its 3 pi/4 corrected to 3 pi/2."""


def wrap_angle(angle_rad: npt.ArrayLike) -> FloatArray:
    """Return the same angle in [-pi, pi).

    Parameters
    ----------
    angle_rad : array_like
        Angles, rad.

    Returns
    -------
    ndarray of float64, the shape of `angle_rad`
        Equivalent angles, rad.

    Examples
    --------
    >>> from occsim.geometry import wrap_angle
    >>> wrap_angle([0.0, np.pi, 7.0]).round(3)
    array([ 0.   , -3.142,  0.717])
    """
    angle = np.asarray(angle_rad, dtype=np.float64)
    wrapped = np.mod(angle + np.pi, 2.0 * np.pi) - np.pi
    # An angle within an ulp below -pi is rounded to pi itself.
    return np.asarray(np.where(wrapped >= np.pi, -np.pi, wrapped), dtype=np.float64)


def snap_heading(theta_rad: npt.ArrayLike) -> FloatArray:
    """Return the nearest of the four cardinal headings.

    Parameters
    ----------
    theta_rad : array_like
        Headings, rad.

    Returns
    -------
    ndarray of float64, the shape of `theta_rad`
        One of `CARDINAL_HEADINGS_RAD` for each; half-way goes to the next one
        clockwise on the screen.

    Examples
    --------
    >>> from occsim.geometry import snap_heading
    >>> snap_heading([0.1, -1.5]).round(3)
    array([0.   , 4.712])
    """
    quarter = 0.5 * np.pi
    turns = np.floor(np.asarray(theta_rad, dtype=np.float64) / quarter + 0.5)
    return np.asarray(np.mod(turns, 4.0) * quarter, dtype=np.float64)

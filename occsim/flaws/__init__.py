"""What a drawing gets wrong: errors put into a wall mask, to see what they cost.

They touch the mask that a prior is made from and never the world. They are applied in
this order: walls are left out and false ones drawn, walls are made thinner or thicker,
then the whole sheet is scaled and turned about its centre and shifted.
"""

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray
from occsim.errors import ParameterError, bool_array, expect
from occsim.flaws.moving import moved_walls
from occsim.flaws.params import DrawingFlaws
from occsim.flaws.pieces import redrawn_walls
from occsim.flaws.thickness import thickened_walls, thinned_walls

__all__ = ["DrawingFlaws", "flawed_mask"]


def flawed_mask(mask: npt.ArrayLike, flaws: DrawingFlaws) -> BoolArray:
    """Return a wall mask with errors.

    Parameters
    ----------
    mask : array_like of bool, shape (H, W)
        Walls of the drawing.
    flaws : DrawingFlaws
        What is wrong with it.

    Returns
    -------
    ndarray of bool, shape (H, W)
        A new mask; the given one itself where there are no flaws. The same on every
        machine.

    Raises
    ------
    TypeError
        Where the mask is not bool, or the flaws no `DrawingFlaws`.
    ParameterError
        Where the mask is not two-dimensional.

    Notes
    -----
    Length is counted along the walls' centre lines. Missing and false walls come in
    pieces of `occsim.flaws.pieces.PIECE_IN_WALLS` mean thicknesses, the last one
    shorter: squares about points of the centre lines. A false piece is a copy of such a
    square, so of the drawing's thicknesses and directions, placed where it covers no
    wall; where the sheet has no room for more, fewer are drawn.

    Thinning keeps the number of connected pieces, and beyond the sheet is free.
    Thickening reaches every pixel whose centre is within `thickness_px` of a wall
    pixel's. A shift is exact in whole px. After scaling and turning a pixel is wall if
    the centre of a wall pixel falls into it, or its own centre into a wall pixel: no
    line is lost. What leaves the sheet is gone.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import DrawingFlaws, flawed_mask
    >>> wall = np.array([[False, True, True, False]] * 3)
    >>> flawed_mask(wall, DrawingFlaws(shift_x_px=2))[0]
    array([False, False, False,  True])
    """
    expect("flaws", flaws, DrawingFlaws)
    walls = bool_array("mask", mask)
    if walls.ndim != 2:
        raise ParameterError(f"mask must have shape (H, W); got {walls.shape}")
    if flaws.are_none or not walls.any():
        return np.asarray(mask, dtype=np.bool_)
    walls = np.ascontiguousarray(walls)
    if flaws.missing_share or flaws.false_share:
        shares = flaws.missing_share, flaws.false_share
        walls = redrawn_walls(walls, *shares, flaws.seed)
    if flaws.thickness_px > 0:
        walls = thickened_walls(walls, flaws.thickness_px)
    elif flaws.thickness_px < 0:
        walls = thinned_walls(walls, -flaws.thickness_px)
    shift = flaws.shift_x_px, flaws.shift_y_px
    return moved_walls(walls, flaws.scale, flaws.rotation_rad, shift)

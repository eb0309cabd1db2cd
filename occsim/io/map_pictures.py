"""Maps as pictures: belief in grey, outcomes and changes in given colours.

A picture has the size of the drawing, so that one can be laid over the other; each
cell is a square of `cell_px` pixels, cut at the right and bottom edge.
"""

from dataclasses import dataclass
from enum import Enum
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, ByteArray, FloatArray
from occsim.errors import ParameterError, choice
from occsim.grid import Grid, cells_of
from occsim.logodds import is_occupied
from occsim.mapping import OccupancyMap
from occsim.metrics import Region
from occsim.metrics.counts import outcome_of

Cell = TypeVar("Cell", bound=np.generic)
HATCH_PERIOD_PX = 6
"""Distance between the hatching lines of unscored cells, along a row."""

UNSEEN = 4
"""Outcome of a cell that is not scored; 0 to 3 are those of `Outcome`."""
FADED = 0.15
"""How much of its colour a cell keeps that is not among those shown."""


class Outcome(Enum):
    """What a map says of a cell, and what is so: 2 * truth + declared wall."""

    FREE = 0
    FALSE_WALL = 1
    MISSED_WALL = 2
    HIT = 3


@dataclass(frozen=True, kw_only=True, slots=True)
class OutcomeColours:
    """Colours of a map compared with the ground truth, each as ``"#rrggbb"``.

    Parameters
    ----------
    hit, false_wall, missed_wall, free : str
        True positives, false positives, false negatives, true negatives.
    unseen, hatch : str
        Cells that are not scored, and the lines drawn over them.
    """

    hit: str
    false_wall: str
    missed_wall: str
    free: str
    unseen: str
    hatch: str


def belief_picture(p_free: FloatArray, grid: Grid, zoom: int = 1) -> ByteArray:
    """Return a map in grey: black is occupied, white is free.

    Parameters
    ----------
    p_free : ndarray of float64, shape (R, C)
        Probability of free.
    grid : Grid
        The cells.
    zoom : int, default 1
        Pixels of the picture to one of the drawing.

    Returns
    -------
    ndarray of uint8, shape (zoom * H, zoom * W)
        ``round(255 * p_free)``, the same grey on every map.

    Raises
    ------
    ParameterError
        Where the array does not have the grid's shape.
    """
    grey = np.rint(255.0 * p_free).astype(np.uint8)
    return _cells_to_pixels(grey, grid, zoom)


def outcome_picture(
    occupancy_map: OccupancyMap,
    truth: BoolArray,
    colours: OutcomeColours,
    region: Region = Region.EXPLORED,
    zoom: int = 1,
    shown: BoolArray | None = None,
) -> ByteArray:
    """Return a picture of the walls that a map finds, misses and wrongly declares.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    colours : OutcomeColours
        One colour for each outcome; cells that are not scored are hatched too.
    region : Region, default Region.EXPLORED
        Which cells are scored.
    zoom : int, default 1
        Pixels of the picture to one of the drawing.
    shown : ndarray of bool, shape (R, C), optional
        Cells that keep their colour, as from `outcome_cells`; all others fade to a
        middle grey. By default no cell fades.

    Returns
    -------
    ndarray of uint8, shape (zoom * H, zoom * W, 3)
        Red, green, blue.

    Raises
    ------
    TypeError
        Where the truth is not bool.
    ParameterError
        Where it does not have the grid's shape, or the region is no `Region`.
    """
    truth = cells_of("truth", truth, occupancy_map.grid)
    code = outcome_of(is_occupied(occupancy_map.log_odds), truth)
    scored = choice("region", region, Region).scored(occupancy_map.n_updates)
    code = np.where(scored, code, UNSEEN)
    by_code = (colours.free, colours.false_wall, colours.missed_wall, colours.hit)
    table = np.array([_rgb(c) for c in (*by_code, colours.unseen)], dtype=np.uint8)
    pixels = _cells_to_pixels(code.astype(np.uint8), occupancy_map.grid, zoom)
    picture = table[pixels]
    height, width = pixels.shape
    diagonal = np.arange(height)[:, None] + np.arange(width)
    lines = diagonal % (HATCH_PERIOD_PX * zoom) < zoom
    picture[lines & (pixels == UNSEEN)] = _rgb(colours.hatch)
    if shown is None:
        return picture
    shown = cells_of("shown", shown, occupancy_map.grid)
    fades = ~_cells_to_pixels(shown, occupancy_map.grid, zoom)
    grey = np.array(_rgb(colours.unseen), dtype=np.float64)
    picture[fades] = np.rint(FADED * picture[fades] + (1.0 - FADED) * grey)
    return picture


def outcome_cells(
    occupancy_map: OccupancyMap, truth: BoolArray, outcome: Outcome, region: Region
) -> BoolArray:
    """Return the cells of a region that have an outcome.

    Parameters
    ----------
    occupancy_map : OccupancyMap
        The map.
    truth : ndarray of bool, shape (R, C)
        Cells that are wall in truth.
    outcome : Outcome
        What the map says of them, and what is so.
    region : Region
        Which cells are scored.

    Returns
    -------
    ndarray of bool, shape (R, C)
        As many are true as `occsim.score` counts.

    Raises
    ------
    TypeError
        Where the truth is not bool.
    ParameterError
        Where it does not have the grid's shape, or the outcome or the region is none.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, OccupancyMap, Region
    >>> grid = Grid(height_px=1, width_px=3, cell_px=1)
    >>> seen = OccupancyMap(grid, np.array([[-1.0, -1.0, 1.0]]), np.array([[1, 1, 0]]))
    >>> truth = np.array([[True, False, True]])
    >>> outcome_cells(seen, truth, Outcome.FALSE_WALL, Region.EXPLORED)
    array([[False,  True, False]])
    """
    truth = cells_of("truth", truth, occupancy_map.grid)
    wanted = choice("outcome", outcome, Outcome).value
    scored = choice("region", region, Region).scored(occupancy_map.n_updates)
    found = outcome_of(is_occupied(occupancy_map.log_odds), truth) == wanted
    return np.asarray(found & scored, dtype=np.bool_)


def change_picture(
    change: FloatArray,
    grid: Grid,
    colours: tuple[str, str, str],
    limit: float = 1.0,
    zoom: int = 1,
) -> ByteArray:
    """Return signed values on a scale that diverges from zero.

    Parameters
    ----------
    change : ndarray of float64, shape (R, C)
        Values, such as the difference of two maps' p_free.
    grid : Grid
        The cells.
    colours : tuple of three str
        Colours ``"#rrggbb"`` at ``-limit``, 0 and ``+limit``, straight lines between.
    limit : float, default 1
        End of the scale; values beyond it take the colour of the end.
    zoom : int, default 1
        Pixels of the picture to one of the drawing.

    Returns
    -------
    ndarray of uint8, shape (zoom * H, zoom * W, 3)
        Red, green, blue.

    Raises
    ------
    ParameterError
        Where the array does not have the grid's shape.
    """
    stops = np.array([_rgb(colour) for colour in colours], dtype=np.float64)
    levels = np.clip(change / limit, -1.0, 1.0)
    channels = [np.interp(levels, (-1.0, 0.0, 1.0), stops[:, c]) for c in range(3)]
    rgb = np.rint(np.stack(channels, axis=-1)).astype(np.uint8)
    return _cells_to_pixels(rgb, grid, zoom)


def _cells_to_pixels(
    values: npt.NDArray[Cell], grid: Grid, zoom: int
) -> npt.NDArray[Cell]:
    _require_shape(values, grid)
    side = grid.cell_px * zoom
    wide = np.repeat(np.repeat(values, side, axis=0), side, axis=1)
    return wide[: grid.height_px * zoom, : grid.width_px * zoom]


def _require_shape(values: npt.NDArray[np.generic], grid: Grid) -> None:
    if values.shape[:2] != grid.shape:
        raise ParameterError(
            f"the map must have the grid's shape {grid.shape}; got {values.shape[:2]}"
        )


def _rgb(colour: str) -> tuple[int, int, int]:
    red, green, blue = bytes.fromhex(colour.removeprefix("#"))
    return red, green, blue

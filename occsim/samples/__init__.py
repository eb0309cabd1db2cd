"""The five reference drawings, each with world, trajectory and sensor.

They are drawings of this project of the five kinds that the source uses [1]_: (a) a
labelled floor plan, (b) a furnished one, (c) a section with stairs and double doors,
(d) a section of walls and doors only, (e) a section with text and a door at an angle.
The ground truths hold structure only. The files beside this module are package data;
``python -m assets.samples.make`` makes drawings and truths in a checkout; the
trajectories are data.

References
----------
.. [1] C. Georgiou, "Constructing informative Bayesian priors to improve SLAM map
   quality", Figs 4.3 and 4.4; C. Georgiou, S. Anderson and T. Dodd, IJRR 2017,
   doi 10.1177/0278364916687027.
"""

import json
from functools import lru_cache
from pathlib import Path

import numpy as np

from occsim._types import BoolArray
from occsim.building import DOOR_WIDTH_M, Building
from occsim.errors import ParameterError, expect, shown
from occsim.imaging import load_drawing
from occsim.io.trajectories import load_trajectory
from occsim.sensor import Sensor
from occsim.world import world_from_image

FOLDER = Path(__file__).resolve().parent
"""Folder of the files: drawings, truths, trajectories and ``samples.json``."""


Sample = Building
"""A reference drawing is a building like any other, with a ground truth.

Examples
--------
>>> from occsim import Sample, load_sample
>>> isinstance(load_sample("a"), Sample)
True
"""


@lru_cache(maxsize=1)
def _index() -> dict[str, dict[str, str | float]]:
    """Return titles, texts and sensors by name, in order."""
    entries: dict[str, dict[str, str | float]] = json.loads(
        (FOLDER / "samples.json").read_text(encoding="utf-8")
    )
    return entries


OTHER_DRAWINGS = ("own", "mirrored", "empty")
"""What `prior_drawing` takes beside the names of samples."""


def prior_drawing(building: Building, which: str = "own") -> BoolArray:
    """Return the walls of the drawing that a prior is made from, right or wrong.

    Parameters
    ----------
    building : Building
        The building that is mapped.
    which : str, default "own"
        ``"own"``; ``"mirrored"``, its own with left and right exchanged; ``"empty"``, a
        sheet without walls; or the name of a sample of the same size.

    Returns
    -------
    ndarray of bool, shape (H, W)

    Raises
    ------
    TypeError
        Where the building is no `Building`, or the name no text.
    ParameterError
        Where there is no such drawing, or it has another size.

    Examples
    --------
    >>> from occsim import load_sample, prior_drawing
    >>> building = load_sample("c")
    >>> wrong = prior_drawing(building, "d")
    >>> bool((wrong == load_sample("d").wall_mask).all())
    True
    """
    expect("building", building, Building)
    expect("which", which, str)
    if which == "own":
        return building.wall_mask
    if which == "mirrored":
        return np.ascontiguousarray(building.wall_mask[:, ::-1])
    if which == "empty":
        return np.zeros_like(building.wall_mask)
    fitting = drawings_of_size(building.drawing.shape)
    if which not in fitting:
        names = ", ".join(repr(name) for name in (*OTHER_DRAWINGS, *fitting))
        raise ParameterError(
            f"the drawing of this prior must be one of {names}; got {shown(which)}"
        )
    return load_sample(which).wall_mask


def prior_unknown(building: Building, which: str = "own") -> BoolArray | None:
    """Return of which pixels the drawing that a prior is made from says nothing.

    Parameters
    ----------
    building, which
        As in `prior_drawing`.

    Returns
    -------
    ndarray of bool, shape (H, W), or None
        None where all is known: in a sample, a sheet without walls, and in most
        drawings of one's own.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.samples import prior_unknown
    >>> prior_unknown(load_sample("c")) is None
    True
    """
    unknown = building.unknown
    if unknown is None or which == "own":
        return unknown
    if which == "mirrored":
        return np.ascontiguousarray(unknown[:, ::-1])
    return np.zeros_like(unknown)


def drawings_of_size(shape: tuple[int, int]) -> tuple[str, ...]:
    """Return the names of the samples whose drawing has this height and width, px."""
    return tuple(n for n in sample_names() if load_sample(n).drawing.shape == shape)


def sample_names() -> tuple[str, ...]:
    """Return the names of the samples, the five references first.

    Returns
    -------
    tuple of str
        ``"a"`` to ``"e"``.

    Examples
    --------
    >>> from occsim import sample_names
    >>> sample_names()
    ('a', 'b', 'c', 'd', 'e')
    """
    return tuple(_index())


@lru_cache(maxsize=8)
def load_sample(name: str) -> Building:
    """Return a sample; the same object each time.

    Parameters
    ----------
    name : str
        One of `sample_names`.

    Returns
    -------
    Building
        Its walls are detected on first use.

    Raises
    ------
    ParameterError
        Where there is no sample of that name.

    Examples
    --------
    >>> from occsim import load_sample
    >>> sample = load_sample("d")
    >>> sample.drawing.shape == sample.world.shape
    True
    """
    if name not in _index():
        raise ParameterError(
            f"a sample is one of {', '.join(sample_names())}; got {name!r}"
        )
    entry = _index()[name]
    title, door_px = str(entry["title"]), float(entry["door_px"])
    truth = world_from_image(load_drawing(FOLDER / f"{name}_truth.png"))
    return Building(
        name=name,
        title=title,
        about=str(entry["about"]),
        door_px=door_px,
        metres_per_px=DOOR_WIDTH_M / door_px,
        drawing=load_drawing(FOLDER / f"{name}_drawing.png", name=title),
        truth=truth.occupied,
        trajectory=load_trajectory(FOLDER / f"{name}_trajectory.csv"),
        sensor=Sensor(
            range_px=float(entry["range_px"]),
            fov_rad=float(np.deg2rad(float(entry["fov_deg"]))),
        ),
    )

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

from occsim.building import DOOR_WIDTH_M, Building
from occsim.errors import ParameterError
from occsim.imaging import load_drawing
from occsim.io.trajectories import load_trajectory
from occsim.sensor import Sensor
from occsim.world import world_from_image

FOLDER = Path(__file__).resolve().parent
"""Folder of the files: drawings, truths, trajectories and ``samples.json``."""


Sample = Building
"""A reference drawing is a building like any other, with a ground truth."""


@lru_cache(maxsize=1)
def _index() -> dict[str, dict[str, str | float]]:
    """Return titles, texts and sensors by name, in order."""
    entries: dict[str, dict[str, str | float]] = json.loads(
        (FOLDER / "samples.json").read_text(encoding="utf-8")
    )
    return entries


def sample_names() -> tuple[str, ...]:
    """Return the names of the samples, the five references first.

    Returns
    -------
    tuple of str
        ``"a"`` to ``"e"``.
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

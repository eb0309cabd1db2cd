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
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from occsim.errors import ParameterError
from occsim.imaging import Drawing, load_drawing
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory
from occsim.world import World

FOLDER = Path(__file__).resolve().parent
"""Where the files lie: drawings, truths, trajectories and ``samples.json``."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sample:
    """A drawing and all that is needed to map it.

    Parameters
    ----------
    name : str
        Short name, ``"a"`` to ``"e"`` for the five references.
    title : str
        What the building is.
    about : str
        What the drawing shows, a sentence or two.
    door_px : float
        Length of a door leaf, px.
    drawing : Drawing
        What the architect gives, shape (H, W).
    world : World
        Ground truth in register with the drawing: structure only, doors open.
    trajectory : Trajectory
        Poses in free space that cover the building, four headings.
    sensor : Sensor
        Range of one door length, field of view of pi / 6, as in the source.
    """

    name: str
    title: str
    about: str
    door_px: float
    drawing: Drawing
    world: World
    trajectory: Trajectory
    sensor: Sensor


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
def load_sample(name: str) -> Sample:
    """Return a sample; the same object each time.

    Parameters
    ----------
    name : str
        One of `sample_names`.

    Returns
    -------
    Sample

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
    title = str(entry["title"])
    truth = load_drawing(FOLDER / f"{name}_truth.png").gray
    return Sample(
        name=name,
        title=title,
        about=str(entry["about"]),
        door_px=float(entry["door_px"]),
        drawing=load_drawing(FOLDER / f"{name}_drawing.png", name=title),
        world=World(occupied=truth < 128),
        trajectory=_trajectory(FOLDER / f"{name}_trajectory.csv"),
        sensor=Sensor(
            range_px=float(entry["range_px"]),
            fov_rad=float(np.deg2rad(float(entry["fov_deg"]))),
        ),
    )


def _trajectory(path: Path) -> Trajectory:
    """Read a trajectory of ours: a comment, a header, then x_px, y_px, theta_deg."""
    poses = np.loadtxt(path, delimiter=",", skiprows=2, ndmin=2)
    poses[:, 2] = np.deg2rad(poses[:, 2])
    return Trajectory(poses=poses)

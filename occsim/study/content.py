"""The files of one drawing, read, and the building that they make."""

import hashlib
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from occsim._files import read_source
from occsim._types import BoolArray
from occsim.building import TOUR_READINGS, Building, proposed_sensor, truth_from_image
from occsim.errors import DrawingError, TrajectoryError
from occsim.imaging import MAX_FILE_BYTES, load_drawing
from occsim.io.trajectories import MAX_FILE_BYTES as MAX_TABLE_BYTES
from occsim.io.trajectories import load_trajectory
from occsim.samples import load_sample
from occsim.sensor import Sensor
from occsim.study.sources import DrawingSource
from occsim.tour import default_tour
from occsim.trajectory import Trajectory
from occsim.walls import WallDetection, detect_walls

NO_TRAJECTORY = Trajectory(poses=np.zeros((1, 3)))
"""Stands in a building until its tour is planned, which takes the building's world."""


@dataclass(frozen=True, kw_only=True, slots=True)
class SensorChoice:
    """What is said of the sensor of drawings that are no samples.

    Parameters
    ----------
    range_px : float, optional
        Reach, px; by default the length of a door that is proposed for the drawing, as
        in the source.
    fov_rad : float, default pi / 6
        Field of view, rad.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.
    """

    range_px: float | None = None
    fov_rad: float = Sensor().fov_rad

    def __post_init__(self) -> None:
        Sensor(range_px=self.range_px or 1.0, fov_rad=self.fov_rad)
        if self.range_px is not None:
            Sensor(range_px=self.range_px)

    def sensor(self, found: WallDetection) -> Sensor:
        """Return the sensor for a drawing with these walls."""
        range_px = self.range_px
        if range_px is None:
            range_px = proposed_sensor(found).range_px
        return Sensor(range_px=range_px, fov_rad=self.fov_rad)


@dataclass(frozen=True, kw_only=True, slots=True)
class NamedFile:
    """The content of a file, and what to call it."""

    name: str
    data: bytes

    @property
    def digest(self) -> str:
        """SHA-256 of the content."""
        return hashlib.sha256(self.data).hexdigest()


@dataclass(frozen=True, kw_only=True, slots=True)
class DrawingContent:
    """The files of one drawing, read: all that another machine needs to map it.

    Parameters
    ----------
    name : str
        Of the drawing.
    drawing : NamedFile, optional
        None for the sample of that name.
    truth, trajectory : NamedFile, optional
        As in `DrawingSource`.
    sensor : SensorChoice
        Samples have their own.
    """

    name: str
    drawing: NamedFile | None = None
    truth: NamedFile | None = None
    trajectory: NamedFile | None = None
    sensor: SensorChoice = SensorChoice()

    @property
    def inputs(self) -> dict[str, Any]:
        """Everything that a result depends on, as digests and plain values."""
        if self.drawing is None:
            return {"sample": self.name, "digest": _sample_digest(self.name)}
        files = {"truth": self.truth, "trajectory": self.trajectory}
        return {
            "name": self.name,
            "drawing": self.drawing.digest,
            **{what: file and file.digest for what, file in files.items()},
            "range_px": self.sensor.range_px,
            "fov_rad": self.sensor.fov_rad,
        }

    def building(self) -> Building:
        """Return the building, its walls detected.

        Raises
        ------
        DrawingError, TrajectoryError
            Where a file cannot be used, or the walls leave no room to drive in.
        """
        return _building(self)


def read_content(
    source: DrawingSource, sensor: SensorChoice | None = None
) -> DrawingContent:
    """Read the files of one drawing.

    Parameters
    ----------
    source : DrawingSource
        From `find_drawings`.
    sensor : SensorChoice, optional
        For a drawing that is no sample.

    Returns
    -------
    DrawingContent

    Raises
    ------
    DrawingError, TrajectoryError
        Where a file cannot be read.
    """
    sensor = sensor or SensorChoice()
    if source.path is None:
        return DrawingContent(name=source.name)
    return DrawingContent(
        name=source.name,
        drawing=_read(source.path),
        truth=_read(source.truth) if source.truth else None,
        trajectory=_read_table(source.trajectory) if source.trajectory else None,
        sensor=sensor,
    )


def _read(path: Path) -> NamedFile:
    data, name = read_source(
        path,
        what="drawing",
        needed="an image",
        max_bytes=MAX_FILE_BYTES,
        error=DrawingError,
    )
    return NamedFile(name=name, data=data)


def _read_table(path: Path) -> NamedFile:
    data, name = read_source(
        path,
        what="trajectory",
        needed="a table of x, y, theta",
        max_bytes=MAX_TABLE_BYTES,
        error=TrajectoryError,
    )
    return NamedFile(name=name, data=data)


@lru_cache(maxsize=8)
def _sample_digest(name: str) -> str:
    # Without the walls found: these would have to be detected first.
    sample = load_sample(name)
    content = hashlib.sha256(sample.drawing.digest.encode())
    for part in (sample.world.occupied, sample.trajectory.poses):
        content.update(np.ascontiguousarray(part).data)
    content.update(repr(sample.sensor).encode())
    return content.hexdigest()


# The cases of one drawing follow one another in a process: its walls are detected and
# its tour is planned once.
@lru_cache(maxsize=1)
def _building(content: DrawingContent) -> Building:
    if content.drawing is None:
        return load_sample(content.name)
    drawing = load_drawing(content.drawing.data, name=content.drawing.name)
    found = detect_walls(drawing)
    building = Building(
        name=content.name,
        title=content.drawing.name,
        drawing=drawing,
        found=found.mask,
        truth=_truth(content.truth, drawing.shape),
        sensor=content.sensor.sensor(found),
        trajectory=_trajectory(content.trajectory) or NO_TRAJECTORY,
    )
    if content.trajectory is not None:
        return building
    tour = default_tour(building.world, building.sensor, max_readings=TOUR_READINGS)
    return replace(building, trajectory=tour, tour=tour)


def _truth(file: NamedFile | None, shape: tuple[int, int]) -> BoolArray | None:
    if file is None:
        return None
    return truth_from_image(load_drawing(file.data, name=file.name), shape)


def _trajectory(file: NamedFile | None) -> Trajectory | None:
    return None if file is None else load_trajectory(file.data, name=file.name)

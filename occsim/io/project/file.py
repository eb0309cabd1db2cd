"""A project as one file, and back."""

import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from occsim._files import read_source
from occsim._plain import plain
from occsim._types import BoolArray
from occsim._version import __version__
from occsim.building import Building
from occsim.corrections import Corrections
from occsim.errors import OccsimError
from occsim.imaging import MAX_FILE_BYTES, Drawing, load_drawing
from occsim.io.images import drawing_png, mask_png, png
from occsim.io.project.archive import (
    CORRECTIONS,
    DRAWING,
    FOUND,
    IMAGES,
    JSON_NAME,
    TRAJECTORY_NAME,
    TRUTH,
    UNKNOWN,
    WALLS,
    ProjectError,
    check_images,
    unpacked_project,
)
from occsim.io.project.checks import written_text
from occsim.io.project.robot import (
    RobotData,
    read_robot,
    robot_document,
    robot_files,
)
from occsim.io.project.values import (
    FORMAT,
    VERSION,
    read_values,
)
from occsim.io.trajectories import (
    TrajectoryFormat,
    dump_trajectory,
    load_trajectory,
)
from occsim.world import world_from_image

ERASED_LEVEL, SAME_LEVEL, ADDED_LEVEL = 0, 128, 255
"""Brightness in the picture of the corrections."""

# Fixed, so that the same project gives the same bytes; zip's earliest date.
_DATE = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Project:
    """The content of one project file.

    Parameters
    ----------
    building : Building
        Drawing, walls, ground truth, trajectory, scale.
    settings : mapping of str to str
        Settings of the application, as text.
    robot : RobotData
        A robot's data; none by default.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.io.project import Project
    >>> Project(building=load_sample("d"), settings={"note": "a"}).settings["note"]
    'a'
    """

    building: Building
    settings: Mapping[str, str] = field(default_factory=dict)
    robot: RobotData = RobotData()


def dump_project(project: Project) -> bytes:
    """Return the content of a project file.

    Parameters
    ----------
    project : Project
        Its settings must be text.

    Returns
    -------
    bytes
        A zip archive; the same project gives the same bytes.

    Raises
    ------
    ProjectError
        Where the robot's log is too large to be read back.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.io.project import Project, dump_project
    >>> dump_project(Project(building=load_sample("d")))[:2]
    b'PK'
    """
    building = project.building
    document = _description(building, project.settings)
    document["robot"] = robot_document(project.robot)
    files = {
        JSON_NAME: json.dumps(document, indent=1).encode("ascii"),
        DRAWING: drawing_png(building.drawing),
        FOUND: mask_png(building.walls_found),
        CORRECTIONS: _corrections_png(building.corrections),
        WALLS: mask_png(building.wall_mask),
        TRAJECTORY_NAME: dump_trajectory(building.trajectory, TrajectoryFormat.CSV),
    }
    for name, mask in ((UNKNOWN, building.unknown), (TRUTH, building.truth)):
        if mask is not None:
            files[name] = mask_png(mask)
    files |= robot_files(project.robot)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, _DATE), content, _packing(name))
    return out.getvalue()


def _packing(name: str) -> int:
    """Return how to store a file: PNG is compressed already."""
    return zipfile.ZIP_STORED if name in IMAGES else zipfile.ZIP_DEFLATED


def _corrections_png(corrections: Corrections) -> bytes:
    added, erased = corrections.planes
    levels = np.where(added, ADDED_LEVEL, np.where(erased, ERASED_LEVEL, SAME_LEVEL))
    return png(levels.astype(np.uint8))


def _description(building: Building, settings: Mapping[str, str]) -> dict[str, Any]:
    """Return the content of the JSON."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "occsim": __version__,
        "title": written_text(building.title),
        "about": written_text(building.about),
        "name": written_text(building.drawing.name),
        "short_name": written_text(building.name),
        "door_px": building.door_px,
        "metres_per_px": building.metres_per_px,
        "sensor": plain(building.sensor),
        "is_planned": building.trajectory is building.tour,
        "sketch": [list(corner) for corner in building.sketch],
        "wall_params": plain(building.wall_params),
        "settings": {written_text(k): written_text(v) for k, v in settings.items()},
    }


def load_project(source: bytes | str | Path, *, name: str | None = None) -> Project:
    """Return the project in a file that `dump_project` wrote; all of it is checked.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    name : str, optional
        What to call the file in messages.

    Returns
    -------
    Project

    Raises
    ------
    ProjectError
        Where the file is not such an archive, is damaged, too large or of another
        version, or where a part or a value in it is out of bounds.

    Examples
    --------
    >>> from occsim import load_sample
    >>> from occsim.io.project import Project, dump_project, load_project
    >>> sample = load_sample("d")
    >>> again = load_project(dump_project(Project(building=sample))).building
    >>> bool((again.wall_mask == sample.wall_mask).all())
    True
    """
    data, file_name = read_source(
        source,
        what=name or "the project file",
        needed="a project file (.zip) saved by this application",
        max_bytes=MAX_FILE_BYTES,
        error=ProjectError,
    )
    name = name or file_name
    try:
        return _project(unpacked_project(data))
    except OccsimError as error:
        raise ProjectError(f"{name} cannot be opened: {error}") from None


def _project(files: Mapping[str, bytes]) -> Project:
    values = read_values(files[JSON_NAME])
    check_images(files)
    trajectory = load_trajectory(files[TRAJECTORY_NAME], name=TRAJECTORY_NAME)
    found = _mask(files, FOUND)
    building = Building(
        drawing=_image(files, DRAWING, values.drawing_name),
        trajectory=trajectory,
        found=found,
        corrections=_corrections(files, found, values.version),
        unknown=_mask(files, UNKNOWN) if UNKNOWN in files else None,
        truth=_mask(files, TRUTH) if TRUTH in files else None,
        tour=trajectory if values.is_planned else None,
        **values.parts,
    )
    robot = read_robot(values.robot, files)
    return Project(building=building, settings=values.settings, robot=robot)


def _image(files: Mapping[str, bytes], name: str, title: str) -> Drawing:
    drawing = load_drawing(files[name], name=name)
    return Drawing(rgb=drawing.rgb, name=title, digest=drawing.digest)


def _mask(files: Mapping[str, bytes], name: str) -> BoolArray:
    return world_from_image(_image(files, name, name)).occupied


def _corrections(
    files: Mapping[str, bytes], found: BoolArray, version: int
) -> Corrections:
    needed = WALLS if version == 1 else CORRECTIONS
    if needed not in files:
        raise ProjectError(f"{needed} is missing")
    if needed == WALLS:
        return Corrections.between(found, _mask(files, WALLS))
    levels = _image(files, CORRECTIONS, CORRECTIONS).gray
    # Thresholds half-way between the levels: users may have edited the picture.
    added = levels > (SAME_LEVEL + ADDED_LEVEL) // 2
    erased = levels < (SAME_LEVEL + ERASED_LEVEL) // 2
    return Corrections.from_masks(np.asarray(added), np.asarray(erased))

"""Project files: a building and the settings beside it, in one zip archive.

The archive holds images as PNG (``drawing``, ``walls_found``, ``corrections``, and
``unknown`` and ``truth`` where there are such), ``trajectory.csv`` and ``project.json``
with everything else: sketch, scale, sensor, the settings of wall detection, the
settings of the application as text, where a drawing lies on a robot's map, versions.
A robot's ``log`` is in it as it was uploaded, up to 20 MB, with the trajectory of timed
scans; ``traced.png`` has walls traced on its map, and that map's size. In
``corrections.png`` black is erased, white added and grey neither; ``walls.png``, the
two together, is for people. Version 1 had no ``corrections.png``: there the corrections
are the difference between ``walls_found.png`` and ``walls.png``.

An archive is not trusted: only these names are read, never as paths, each within its
own limit of bytes and all within a total limit; images must have the drawing's size
before they are decoded; every value of the JSON must have its type and lie in its
bounds. Walls are not detected again, so a project keeps its walls when the detection
improves.
"""

from occsim.io.project.archive import MAX_LOG_BYTES, ProjectError
from occsim.io.project.file import Project, dump_project, load_project
from occsim.io.project.robot import RobotData

__all__ = [
    "MAX_LOG_BYTES",
    "Project",
    "ProjectError",
    "RobotData",
    "dump_project",
    "load_project",
]

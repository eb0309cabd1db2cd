"""The five reference drawings: what is made of each plan, and the files."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from occsim.samples import FOLDER

from .floor_plans import plan_a, plan_b
from .plan import Plan
from .sections import plan_c, plan_d, plan_e

FOV_DEG = 30.0  # the source's phi = pi / 6


@dataclass(frozen=True, kw_only=True)
class Brief:
    """One drawing: how it is called and drawn.

    The world is flat and holds structure only, as in the source, so that the
    trajectories cross stairs as if they were floor.
    """

    draw: Callable[[], Plan]
    title: str
    about: str
    door_px: float


BRIEFS = {
    "a": Brief(
        draw=plan_a,
        title="House, ground floor",
        about=(
            "A floor plan with solid walls of several thicknesses, room labels, "
            "stairs, double doors and built-in furniture. Labels, stairs and "
            "fittings are not in the building the robot sees."
        ),
        door_px=40.0,
    ),
    "b": Brief(
        draw=plan_b,
        title="Furnished flat",
        about=(
            "A floor plan whose walls are two lines with white between them, crowded "
            "with suggested furniture, tiles and sanitary ware."
        ),
        door_px=40.0,
    ),
    "c": Brief(
        draw=plan_c,
        title="Teaching wing with stairs",
        about=(
            "A section of a larger drawing: solid structure and columns, hollow "
            "partitions, a dog-leg staircase, double doors and grid axes."
        ),
        door_px=20.0,
    ),
    "d": Brief(
        draw=plan_d,
        title="Offices, walls and doors only",
        about=(
            "A plain section: solid walls and doors, nothing else. "
            "The easiest of the five to read."
        ),
        door_px=20.0,
    ),
    "e": Brief(
        draw=plan_e,
        title="Wing's end with an oblique facade",
        about=(
            "A section with a hatched facade at an angle, grey partitions, a door "
            "at 45 degrees, stairs, axes, labels and dimensions."
        ),
        door_px=20.0,
    ),
}


def png(image: np.ndarray) -> bytes:
    """Encode a grey picture."""
    return cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 9])[1].tobytes()


def files_of(name: str) -> dict[str, bytes]:
    """Names and contents of a drawing's picture and its ground truth."""
    plan = BRIEFS[name].draw()
    wall = plan.truth()
    return {
        f"{name}_drawing.png": png(plan.sheet.picture()),
        f"{name}_truth.png": png(np.where(wall, 0, 255).astype(np.uint8)),
    }


def index() -> bytes:
    """Title, text and sensor of every drawing, as JSON."""
    entries = {
        name: {
            "title": brief.title,
            "about": brief.about,
            "door_px": brief.door_px,
            "range_px": brief.door_px,  # the source: range is the length of a door
            "fov_deg": FOV_DEG,
        }
        for name, brief in BRIEFS.items()
    }
    return (json.dumps(entries, indent=2) + "\n").encode()


def build(folder: Path = FOLDER) -> None:
    """Write all files."""
    (folder / "samples.json").write_bytes(index())
    for name in BRIEFS:
        for file, content in files_of(name).items():
            (folder / file).write_bytes(content)

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
from .sections import facade_x, plan_c, plan_d, plan_e
from .sheet import Point
from .tour import plan_tour

FOV_DEG = 30.0  # the source's phi = pi / 6


@dataclass(frozen=True, kw_only=True)
class Brief:
    """One drawing: how it is called, drawn and toured.

    `interior` is the floor of the building (a polygon), `start` where the tour begins;
    px. The world is flat and holds structure only, as in the source, so that tours
    cross stairs as if they were floor.
    """

    draw: Callable[[], Plan]
    title: str
    about: str
    door_px: float
    interior: tuple[Point, ...]
    start: Point
    n_poses: int
    spacing_px: int
    clearance_px: float


def upright(x0: float, y0: float, x1: float, y1: float) -> tuple[Point, ...]:
    """Corners of a box."""
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


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
        interior=upright(54, 48, 430, 302),
        start=(239, 286),
        n_poses=420,
        spacing_px=8,
        clearance_px=7.0,
    ),
    "b": Brief(
        draw=plan_b,
        title="Furnished flat",
        about=(
            "A floor plan whose walls are two lines with white between them, crowded "
            "with suggested furniture, tiles and sanitary ware."
        ),
        door_px=40.0,
        interior=upright(32, 30, 428, 302),
        start=(251, 46),
        n_poses=450,
        spacing_px=8,
        clearance_px=7.0,
    ),
    "c": Brief(
        draw=plan_c,
        title="Teaching wing with stairs",
        about=(
            "A section of a larger drawing: solid structure and columns, hollow "
            "partitions, a dog-leg staircase, double doors and grid axes."
        ),
        door_px=20.0,
        interior=upright(42, 34, 300, 206),
        start=(52, 120),
        n_poses=450,
        spacing_px=4,
        clearance_px=4.0,
    ),
    "d": Brief(
        draw=plan_d,
        title="Offices, walls and doors only",
        about=(
            "A plain section: solid walls and doors, nothing else. "
            "The easiest of the five to read."
        ),
        door_px=20.0,
        interior=upright(27, 27, 273, 213),
        start=(36, 116),
        n_poses=450,
        spacing_px=4,
        clearance_px=4.0,
    ),
    "e": Brief(
        draw=plan_e,
        title="Wing's end with an oblique facade",
        about=(
            "A section with a hatched facade at an angle, grey partitions, a door "
            "at 45 degrees, stairs, axes, labels and dimensions."
        ),
        door_px=20.0,
        interior=((0, 34), (facade_x(34) - 4, 34), (facade_x(204) - 4, 204), (0, 204)),
        start=(158, 196),
        n_poses=450,
        spacing_px=4,
        clearance_px=4.0,
    ),
}


def floor_mask(brief: Brief, shape: tuple[int, int]) -> np.ndarray:
    """(H, W) bool: pixels of the building's inside, its walls there included."""
    mask = np.zeros(shape, np.uint8)
    corners = np.round(np.array(brief.interior)).astype(np.int32)
    cv2.fillPoly(mask, [corners], 1)
    return mask > 0


def tour_of(brief: Brief, wall: np.ndarray) -> np.ndarray:
    """Poses (S, 3): x_px, y_px, theta_deg."""
    return plan_tour(
        wall,
        floor=floor_mask(brief, wall.shape),
        start=brief.start,
        range_px=brief.door_px,
        fov_deg=FOV_DEG,
        spacing=brief.spacing_px,
        clearance_px=brief.clearance_px,
        count=brief.n_poses,
    )


def png(image: np.ndarray) -> bytes:
    """Encode a grey picture."""
    return cv2.imencode(".png", image, [cv2.IMWRITE_PNG_COMPRESSION, 9])[1].tobytes()


def csv(name: str, brief: Brief, poses: np.ndarray) -> bytes:
    """Encode a trajectory; whole degrees, half pixels."""
    head = (
        f"# Drawing {name} ({brief.title}): {len(poses)} poses; x right, y down from "
        "the top-left corner, theta from +x towards +y\n"
        "x_px,y_px,theta_deg\n"
    )
    rows = "".join(f"{x:.1f},{y:.1f},{t:.0f}\n" for x, y, t in poses)
    return (head + rows).encode()


def files_of(name: str) -> dict[str, bytes]:
    """Names and contents of a drawing's three files."""
    brief = BRIEFS[name]
    plan = brief.draw()
    wall = plan.truth()
    return {
        f"{name}_drawing.png": png(plan.sheet.picture()),
        f"{name}_truth.png": png(np.where(wall, 0, 255).astype(np.uint8)),
        f"{name}_trajectory.csv": csv(name, brief, tour_of(brief, wall)),
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

"""A drawing registered on the map of a log: its place, its agreement, its worth.

Nothing here imports Streamlit.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

from occsim import (
    Agreement,
    Registration,
    Trajectory,
    agreement,
    flawed_mask,
    held_out_bits,
    refine_registration,
    register_by_points,
    registered_walls,
)
from occsim._types import BoolArray
from occsim.building import DOOR_WIDTH_M, Building
from occsim.corrections import pack_mask, unpack_mask
from occsim.io.metric import MetricFrame, poses_to_image, poses_to_metric
from occsim.io.replay import pack_walls
from occsim.prior import Prior, prior_from_cells
from pages._ui import compute
from pages._ui.choices import CellModel
from pages._ui.columns import FLAWS, Column
from pages._ui.components.board import BoardPoint
from pages._ui.components.player import Part
from pages._ui.robot_data.played import PlayedLog
from pages._ui.shared import shared

N_FOLDS = 5
Points = tuple[BoardPoint, ...]

SPOTS = ((0.2, 0.2), (0.8, 0.8))
"""Places of the drawing, as shares of its width and height, at which it opens."""
MISSED_M = ((0.5, -0.35), (-0.4, 0.5))
"""Errors of the points on the map, on purpose, m."""


@dataclass(frozen=True)
class Registrations:
    """The points on drawing and map, and all registrations so far, the last in force.

    ``about`` says of which drawing and map.
    """

    about: str
    drawing_points: Points = ()
    map_points: Points = ()
    steps: tuple[Registration, ...] = ()

    @property
    def now(self) -> Registration | None:
        """The registration in force."""
        return self.steps[-1] if self.steps else None


@dataclass(frozen=True, eq=False)
class Walls:
    """A wall mask in px of the map, and what tells it from others."""

    mask: BoolArray

    @property
    def packed(self) -> bytes:
        """The mask as a board takes it."""
        return pack_mask(self.mask)

    @property
    def digest(self) -> str:
        """Identifies the mask."""
        return hashlib.sha256(self.packed).hexdigest()


def about(map_id: str, building: Building) -> str:
    """What tells registrations of a drawing on a map from others."""
    return f"{map_id} {building.drawing.digest}"


def by_points(drawing: Points, on_map: Points) -> Registration:
    """The registration that two pairs of points give."""
    return register_by_points(_places(drawing), _places(on_map))


def opening(about: str, building: Building, made: PlayedLog) -> Registrations:
    """A rough registration of a drawing on the map of its own simulated log."""
    height_px, width_px = building.drawing.shape
    scale = building.metres_per_px or DOOR_WIDTH_M / building.sensor.range_px
    frame = MetricFrame(height_px=height_px, metres_per_px=scale)
    drawing, on_map = [], []
    for (across, down), (miss_x, miss_y) in zip(SPOTS, MISSED_M, strict=True):
        x, y = across * width_px, down * height_px
        drawing.append(BoardPoint(x_px=x, y_px=y))
        (pose,) = poses_to_metric(Trajectory(((x, y, 0.0),)), frame)
        place = [(pose[0] + miss_x, pose[1] + miss_y, 0.0)]
        on_map.append(_on(made, poses_to_image(place, made.scans.frame)))
    pairs = tuple(drawing), tuple(on_map)
    return Registrations(about, *pairs, (by_points(*pairs),))


def _on(made: PlayedLog, place: Trajectory) -> BoardPoint:
    x, y, _ = place.poses[0].tolist()
    return BoardPoint(
        x_px=min(max(x, 0.0), float(made.grid.width_px)),
        y_px=min(max(y, 0.0), float(made.grid.height_px)),
    )


def _places(points: Points) -> list[tuple[float, float]]:
    return [(point.x_px, point.y_px) for point in points]


def walls_on_map(
    walls: BoolArray, registration: Registration, made: PlayedLog
) -> Walls:
    """The walls of a registered drawing, on the map."""
    return Walls(registered_walls(walls, registration, made.grid))


def traced(packed: bytes, made: PlayedLog) -> Walls:
    """Walls that were traced on the map itself."""
    return Walls(unpack_mask(packed, (made.grid.height_px, made.grid.width_px)))


def agrees(walls: BoolArray, registration: Registration, made: PlayedLog) -> Agreement:
    """How well a registered drawing agrees with the log."""
    with compute.core():
        return agreement(walls, made.totals, registration)


def refined(
    walls: BoolArray, registration: Registration, made: PlayedLog
) -> Registration:
    """A registration that agrees better, if there is one near."""
    reach_px = min(max(0.8 / made.scans.frame.metres_per_px, 4.0), 100.0)
    with compute.core():
        return refine_registration(walls, made.totals, registration, reach_px=reach_px)


def parts(walls: Walls, columns: Sequence[Column]) -> tuple[Part, ...]:
    """The walls that some maps need, as the player names them."""
    flaws = dict.fromkeys(column.flaw for column in columns)
    return tuple(
        Part(
            "walls",
            f"own {flaw.value} 1",
            pack_walls(flawed_mask(walls.mask, FLAWS[flaw])),
        )
        for flaw in flaws
    )


def held_out(log_key: str, made: PlayedLog, walls: Walls, column: Column) -> float:
    """Bits per cell of one map on scans held out; NaN where it cannot be said."""
    return _held_out(log_key, walls.digest, column, made, walls)


@shared("Holding out scans")
def _held_out(
    log_key: str, walls_digest: str, column: Column, _made: PlayedLog, _walls: Walls
) -> float:
    n_scans = len(_made.trajectory)
    if n_scans < N_FOLDS or column.model is CellModel.HITS_VISITS:
        return float("nan")
    prior = Prior(p_wall=column.p_wall, p_space=column.p_space)
    if column.uninformative:
        prior = Prior.uninformative()
    with compute.core():
        cells = flawed_mask(_walls.mask, FLAWS[column.flaw])
        prior_map = prior_from_cells(cells, _made.grid, prior)
        return held_out_bits(_made.evidence, prior_map, column.rule, N_FOLDS).bits

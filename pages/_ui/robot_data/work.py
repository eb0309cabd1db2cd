"""What a student made on the page Robot data; a reload and an undo bring it back."""

from dataclasses import dataclass, replace

from occsim import Corrections
from occsim._types import BoolArray
from occsim.building import Building
from occsim.corrections import unpack_mask
from occsim.io.metric import MetricFrame
from occsim.io.project import MAX_LOG_BYTES, RobotData
from pages._ui import logs
from pages._ui.components.board import BoardPoint
from pages._ui.logs import LogFile
from pages._ui.robot_data import registered
from pages._ui.robot_data.registered import Points, Registrations
from pages._ui.settings import Settings


@dataclass(frozen=True, eq=False)
class Traced:
    """Walls traced on the map of a log; ``about`` says on which."""

    about: str
    strokes: Corrections


@dataclass(frozen=True, eq=False)
class Placed:
    """Where a drawing lies that was made of a robot's map; ``digest`` says which."""

    digest: str
    frame: MetricFrame


@dataclass(frozen=True, eq=False, kw_only=True)
class RobotWork:
    """The uploaded log, the registration of a drawing on its map, and traced walls.

    How a log is mapped is part of the settings.
    """

    log: LogFile | None = None
    registrations: Registrations | None = None
    traced: Traced | None = None
    placed: Placed | None = None

    @property
    def is_empty(self) -> bool:
        """Whether nothing was made."""
        parts = self.log, self.registrations, self.traced, self.placed
        return all(part is None for part in parts)

    @property
    def is_log_too_large(self) -> bool:
        """Whether the log has to be uploaded again after a reload."""
        return self.log is not None and self.log.n_bytes > MAX_LOG_BYTES

    def bounded(self) -> "RobotWork":
        """The same without a log that is too large to be kept."""
        return replace(self, log=None) if self.is_log_too_large else self


EMPTY = RobotWork()


# --- In a project file ----------------------------------------------------------------


def to_project(work: RobotWork, building: Building, settings: Settings) -> RobotData:
    """What a project file holds of it: what belongs to the map that is shown now."""
    data = RobotData(origin=_origin(work, building))
    if work.registrations is None and work.traced is None and work.log is None:
        return data
    log = work.log or logs.simulated(building)
    map_id = logs.map_id(log, settings)
    data = replace(data, map_id=map_id)
    kept = work.bounded().log
    if kept is not None:
        data = replace(
            data, log=kept.data, log_name=kept.name, log_poses=kept.trajectory
        )
    so_far, traced = work.registrations, work.traced
    if so_far is not None and so_far.about == registered.about(map_id, building):
        data = replace(
            data,
            registration=so_far.now,
            drawing_points=_pairs(so_far.drawing_points),
            map_points=_pairs(so_far.map_points),
        )
    if traced is not None and traced.about == map_id:
        data = replace(data, traced=_mask(traced.strokes))
    return data


def of_project(data: RobotData, building: Building) -> RobotWork:
    """What a project file says of it."""
    about = registered.about(data.map_id, building)
    log = so_far = traced = None
    if data.log is not None:
        log = LogFile(data.log_name, data.log, trajectory=data.log_poses)
    if data.drawing_points or data.map_points or data.registration:
        pairs = _points(data.drawing_points), _points(data.map_points)
        steps = () if data.registration is None else (data.registration,)
        so_far = Registrations(about, *pairs, steps)
    if data.traced is not None:
        nothing = unpack_mask(b"", data.traced.shape)
        traced = Traced(data.map_id, Corrections.between(nothing, data.traced))
    placed = _placed(data, building)
    return RobotWork(log=log, registrations=so_far, traced=traced, placed=placed)


def _origin(work: RobotWork, building: Building) -> tuple[float, float, float] | None:
    placed = work.placed
    if placed is None or placed.digest != building.drawing.digest:
        return None
    frame = placed.frame
    return frame.origin_x_m, frame.origin_y_m, frame.origin_yaw_rad


def _placed(data: RobotData, building: Building) -> Placed | None:
    if data.origin is None or building.metres_per_px is None:
        return None
    x_m, y_m, yaw_rad = data.origin
    frame = MetricFrame(
        height_px=building.drawing.shape[0],
        metres_per_px=building.metres_per_px,
        origin_x_m=x_m,
        origin_y_m=y_m,
        origin_yaw_rad=yaw_rad,
    )
    return Placed(building.drawing.digest, frame)


def _pairs(points: Points) -> tuple[tuple[float, float], ...]:
    return tuple((point.x_px, point.y_px) for point in points)


def _points(pairs: tuple[tuple[float, float], ...]) -> Points:
    return tuple(BoardPoint(x_px=x, y_px=y) for x, y in pairs)


def _mask(strokes: Corrections) -> BoolArray:
    return strokes.apply(unpack_mask(b"", strokes.shape))

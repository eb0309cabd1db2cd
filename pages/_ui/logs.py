"""Robots' logs as maps, computed in the worker and shared by all sessions."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from occsim.building import Building
from pages._ui import compute
from pages._ui.choices import CellModel, Laps
from pages._ui.columns import LOG_COLUMNS, Column
from pages._ui.components.player import Part, Replay
from pages._ui.robot_data import files
from pages._ui.robot_data.played import (
    LogOptions,
    PlayedLog,
    pack_log_counts,
    play_log,
    simulated_log,
)
from pages._ui.settings import Settings
from pages._ui.shared import shared
from pages._ui.worker import WORKERS

PAPER = "Hits of all scans"


@dataclass(frozen=True, eq=False)
class LogFile:
    """A log as a student gave it, or one simulated in a building."""

    name: str
    data: bytes
    is_simulated: bool = False
    trajectory: bytes | None = None
    """A TUM file that places timed scans."""

    @property
    def n_bytes(self) -> int:
        """Size of what was uploaded."""
        return len(self.data) + len(self.trajectory or b"")

    @cached_property
    def digest(self) -> str:
        """Identifies the content."""
        parts = self.data, self.trajectory or b""
        return "".join(hashlib.sha256(part).hexdigest() for part in parts)


def options(settings: Settings) -> LogOptions:
    """How the settings say that a log is mapped."""
    return LogOptions(
        cell_m=settings.log_cell_m,
        usable_range_m=float(settings.usable_range_m),
        max_range_m=float(settings.log_max_range_m) or None,
        behind_hit=settings.log_behind_hit,
        clear_no_hit=settings.log_clear_no_hit,
    )


def map_id(log: LogFile, settings: Settings) -> str:
    """What tells a log's map from others."""
    return f"{log.digest} {options(settings)}"


def played(log: LogFile, settings: Settings) -> PlayedLog:
    """A log on its map.

    Raises
    ------
    OccsimError
        Where the log is refused, or its map would be too large.
    """
    return _played(log.digest, options(settings), log.data, log.trajectory)


@shared("Mapping the log")
def _played(
    digest: str, given: LogOptions, _data: bytes, _trajectory: bytes | None
) -> PlayedLog:
    with compute.core():
        return WORKERS.call(play_log, _data, given, _trajectory)


@shared("Counting beams")
def _counts(digest: str, given: LogOptions, _made: PlayedLog) -> bytes:
    with compute.core():
        return WORKERS.call(pack_log_counts, _made)


def picture(log: LogFile, settings: Settings) -> bytes:
    """The map without a drawing, to draw on."""
    return _picture(log.digest, options(settings), log)


@shared()
def _picture(digest: str, given: LogOptions, _log: LogFile) -> bytes:
    made = _played(digest, given, _log.data, _log.trajectory)
    with compute.core():
        return files.picture(made.blank_map, made.scans.frame)


def simulated(building: Building) -> LogFile:
    """A log that a robot would write on its tour of a building."""
    data = _simulated(building.digest, compute.anonymous(building))
    return LogFile("simulated", data, is_simulated=True)


@shared("Driving the robot")
def _simulated(digest: str, _building: Building) -> bytes:
    with compute.core():
        return WORKERS.call(simulated_log, _building)


def replay(
    log: LogFile, settings: Settings, columns: Sequence[Column] = LOG_COLUMNS
) -> Replay:
    """What the player needs for the maps of a log."""
    made, given = played(log, settings), options(settings)
    counts = []
    if any(one.model is CellModel.HITS_VISITS for one in columns):
        counts = [Part("log", "counts 1", _counts(log.digest, given, made))]
    return Replay(
        base=repr((log.digest, given)),
        parts=(
            Part("scene", "", made.scene),
            Part("beams", "", made.beams),
            Part("log", f"{given.behind_hit.value} 1", made.log),
            Part("walls", "own found 1", made.no_walls),
            *counts,
        ),
        drawings=(),
        has_truth=False,
        has_prior=False,
        paper=PAPER,
    )


def fixed(settings: Settings) -> Mapping[str, object]:
    """What the page chooses of every map of a log."""
    behind_hit = settings.log_behind_hit.value
    return {"behind_hit": behind_hit, "cell_px": 1, "laps": Laps.ONE.value}

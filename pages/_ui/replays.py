"""What the map player needs, packed and shared by all sessions."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from occsim import MappingRun, MapSettings, ScanSettings, Sensor
from occsim.building import Building
from occsim.io.replay import pack_log, pack_scene, pack_walls
from occsim.io.replay_beams import pack_beams, pack_counts
from occsim.scan import beam_counts
from pages._ui import compute
from pages._ui.choices import CellModel
from pages._ui.columns import FLAWS, Column
from pages._ui.components.player import Part, Replay
from pages._ui.settings import Settings
from pages._ui.shared import shared


def replay(building: Building, settings: Settings) -> Replay:
    """What the player needs for the map of some settings."""
    drawn = {settings.column: compute.prior_key(building, settings)}
    return _replay(building, settings, drawn)


def replay_of(
    building: Building, settings: Settings, columns: Sequence[Column]
) -> Replay:
    """What the player needs for several maps of one building."""
    drawn = {
        one: compute.fitting(building, one.prior_drawing, FLAWS[one.flaw])
        for one in columns
    }
    return _replay(building, settings, drawn)


def _replay(
    building: Building, settings: Settings, drawn: Mapping[Column, compute.PriorKey]
) -> Replay:
    parts = [Part("scene", "", _scene(building.digest, settings.sensor, building))]
    for one, key in drawn.items():
        mapping = settings.mapping_of(one)
        behind, drawing = one.behind_hit.value, one.prior_drawing.value
        name = f"{behind} {one.cell_px}"
        if one.model is CellModel.HITS_VISITS:
            name = f"counts {one.cell_px}"
            log = _counts(building.digest, _with_beams(mapping, settings), building)
        else:
            log = _log(building.digest, mapping, building)
        walls = _walls(building.digest, key, mapping, building)
        parts += [
            Part("log", name, log),
            Part("walls", f"{drawing} {one.flaw.value} {one.cell_px}", walls),
        ]
    beams = _beams(building.digest, settings.mapping, building)
    if beams is not None:
        parts.append(Part("beams", "", beams))
    # All that the names of the parts do not say.
    rest = building.digest, settings.mapping_of(Column())
    drawings = tuple(compute.prior_drawings(building))
    return Replay(repr(rest), tuple(dict.fromkeys(parts)), drawings)


@shared()
def _scene(digest: str, sensor: Sensor, _building: Building) -> bytes:
    with compute.core():
        return pack_scene(
            _building.world,
            trajectory=_building.trajectory,
            sensor=sensor,
            drawing=_building.drawing,
        )


@shared("Simulating the readings")
def _log(digest: str, settings: MapSettings, _building: Building) -> bytes:
    run = compute.mapped(_building, settings)
    with compute.core():
        return pack_log(
            run.evidence, truth=run.truth_cells, trajectory=run.building.trajectory
        )


@shared()
def _beams(digest: str, settings: MapSettings, _building: Building) -> bytes | None:
    """The beams of the readings; None where these are exact."""
    scan_log = compute.mapped(_building, settings).scan_log
    if scan_log is None:
        return None
    with compute.core():
        # They are measured at the true poses, at which the robot is drawn.
        return pack_beams(scan_log, settings.sensor)


def _with_beams(mapping: MapSettings, settings: Settings) -> MapSettings:
    """The same with beams to count: exact readings have none."""
    scan = mapping.scan or ScanSettings(n_beams=settings.dense_beams)
    return replace(mapping, scan=scan)


@shared("Counting beams")
def _counts(digest: str, settings: MapSettings, _building: Building) -> bytes:
    with compute.core():
        run = MappingRun(compute.anonymous(_building), settings)
        return pack_counts(
            beam_counts(run.scan_log, settings.sensor, run.grid),
            truth=run.truth_cells,
            trajectory=run.building.trajectory,
        )


@shared()
def _walls(
    digest: str, drawn: compute.PriorKey, settings: MapSettings, _building: Building
) -> bytes:
    run = compute.drawn_run(_building, settings, drawn)
    with compute.core():
        return pack_walls(run.wall_cells, run.unknown_cells)

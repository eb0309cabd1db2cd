"""A log made ready for the player, in the process that opens uploaded files.

Nothing here imports Streamlit.
"""

from dataclasses import dataclass

from occsim import (
    BehindHit,
    EvidenceLog,
    OccupancyMap,
    Prior,
    Trajectory,
    World,
    build_prior,
    fuse,
)
from occsim.building import Building
from occsim.corrections import unpack_mask
from occsim.evidence_log import EvidenceTotals
from occsim.grid import Grid
from occsim.io.log_run import hits_drawing, map_log, open_log, tour_log
from occsim.io.replay import pack_log, pack_scene, pack_walls, unpack_log
from occsim.io.replay_beams import pack_beams, pack_counts
from occsim.io.scans import MetricScans
from occsim.scan import RANGE_FINDERS, beam_counts
from occsim.sensor import Sensor


@dataclass(frozen=True, kw_only=True, slots=True)
class LogOptions:
    """How a log is mapped.

    Parameters
    ----------
    cell_m : float
        Side of a cell, m; also the scale of the map: one cell is one pixel.
    usable_range_m : float
        Beyond it nothing is mapped.
    max_range_m : float, optional
        A reading at or beyond it is no return; by default as the log says.
    behind_hit : BehindHit
        What is said behind a hit.
    clear_no_hit : bool
        Whether a beam without return clears its sector.
    """

    cell_m: float
    usable_range_m: float
    max_range_m: float | None
    behind_hit: BehindHit
    clear_no_hit: bool


@dataclass(frozen=True, eq=False)
class PlayedLog:
    """A log on its map: what the player draws, and the totals of each cell.

    ``scans`` are those that were used, every n-th of ``n_scans``.
    """

    scans: MetricScans
    sensor: Sensor
    every: int
    n_scans: int
    totals: EvidenceTotals
    scene: bytes
    beams: bytes
    log: bytes
    no_walls: bytes

    @property
    def grid(self) -> Grid:
        """The cells."""
        return self.totals.grid

    @property
    def trajectory(self) -> Trajectory:
        """Where the scans were taken, px of the map."""
        return self.scans.scan_log.trajectory

    @property
    def evidence(self) -> EvidenceLog:
        """What each scan says."""
        return unpack_log(self.log)[0]

    @property
    def blank_map(self) -> OccupancyMap:
        """The map without a drawing."""
        nothing = unpack_mask(b"", self.grid.shape)
        return fuse(self.totals, build_prior(nothing, self.grid, Prior.uninformative()))


def play_log(
    data: bytes, options: LogOptions, trajectory: bytes | None = None
) -> PlayedLog:
    """Open a log, map it and pack it for the player."""
    opened = open_log(
        data,
        trajectory=trajectory,
        metres_per_px=options.cell_m,
        max_range_m=options.max_range_m,
        usable_range_m=options.usable_range_m,
    )
    run = map_log(
        opened, behind_hit=options.behind_hit, clear_no_hit=options.clear_no_hit
    )
    used, grid = run.scans.scan_log, run.evidence.grid
    nothing = unpack_mask(b"", (grid.height_px, grid.width_px))
    sums, counts = run.evidence.totals()
    return PlayedLog(
        scans=run.scans,
        sensor=run.sensor,
        every=run.every,
        n_scans=run.n_scans,
        totals=EvidenceTotals(grid, sums, counts),
        scene=pack_scene(
            World(nothing),
            trajectory=used.trajectory,
            sensor=run.sensor,
            drawing=hits_drawing(run.scans),
        ),
        beams=pack_beams(used, run.sensor),
        log=pack_log(run.evidence, truth=nothing, trajectory=used.trajectory),
        no_walls=pack_walls(nothing),
    )


ROBOT = RANGE_FINDERS["urg-04lx"]
"""What the simulated robot carries."""
SEED = 1
"""Of the errors of its ranges."""


def pack_log_counts(played: PlayedLog) -> bytes:
    """Return gmapping's counts of a log, packed for the player."""
    scan_log = played.scans.scan_log
    return pack_counts(
        beam_counts(scan_log, played.sensor, played.grid),
        truth=unpack_mask(b"", played.grid.shape),
        trajectory=scan_log.trajectory,
    )


def simulated_log(building: Building) -> bytes:
    """Return the log of a robot that drives through a building."""
    return tour_log(building, ROBOT, SEED)

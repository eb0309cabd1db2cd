"""Scans in a replay: their beams, to be drawn, and gmapping's counts, to be mapped.

Counts are a log whose values are 1 for each visit and `HIT` for each hit. Beams are one
more part: one zlib stream; numbers little-endian, S scans of B beams.

====== ================= ========================================================
offset type              content
====== ================= ========================================================
0      4 bytes           ``OGB2``
4      uint32 [2]        S, B
12     uint32            zero
16     float64           reach, px
24     float32 [B]       bearings, rad
next   uint16 [S, B]     65534 times the range by the reach; 65534 where the beam
                         passes the reach without a hit, 65535 where it says nothing
====== ================= ========================================================
"""

import struct
import zlib

import numpy as np

from occsim._types import BoolArray
from occsim.evidence_log import EvidenceLog
from occsim.io.replay import ZLIB_LEVEL, pack_log
from occsim.scan import BeamCounts, ScanLog
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory

BEAMS = b"OGB2"
HEADER = struct.Struct("<4s3Id")
REACH, NOTHING = 65534, 65535
HIT = 2.0**-20
"""So small that a scan's hits of one cell stay below 1; the values are exact."""
MAX_SHOWN = 2_000_000
"""Most ranges in a replay, 4 MB; of more beams, every n-th is shown."""


def pack_beams(scan_log: ScanLog, sensor: Sensor) -> bytes:
    """Return the beams of all scans as bytes; see the module's text.

    Parameters
    ----------
    scan_log : ScanLog
        S scans.
    sensor : Sensor
        What is believed of them: as in `occsim.evidence_from_scans`.

    Returns
    -------
    bytes
    """
    every = -(-scan_log.ranges_px.size // MAX_SHOWN)
    ranges = scan_log.ranges_px[:, ::every]
    reach = min(sensor.range_px, scan_log.max_range_px)
    levels = np.full(ranges.shape, NOTHING, dtype="<u2")
    is_hit = ranges < reach  # neither NaN nor infinity
    share = np.floor(ranges[is_hit] / reach * REACH)
    levels[is_hit] = np.minimum(share, REACH - 1)
    passes = (ranges >= reach) & (np.isfinite(ranges) | sensor.clear_no_hit)
    levels[passes] = REACH
    return zlib.compress(
        HEADER.pack(BEAMS, *ranges.shape, 0, reach)
        + scan_log.bearings_rad[::every].astype("<f4").tobytes()
        + levels.tobytes(),
        ZLIB_LEVEL,
    )


def pack_counts(
    counts: BeamCounts, *, truth: BoolArray, trajectory: Trajectory
) -> bytes:
    """Return gmapping's counts as bytes: a log of `occsim.io.replay`.

    Parameters
    ----------
    counts : BeamCounts
        Of the scans.
    truth, trajectory
        As in `occsim.io.replay.pack_log`.

    Returns
    -------
    bytes
    """
    values = counts.visits + HIT * counts.hits
    coded = EvidenceLog.known_sound(counts.grid, counts.indptr, counts.cell, values)
    return pack_log(coded, truth=truth, trajectory=trajectory)

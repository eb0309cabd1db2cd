"""The replay: all that a player needs to redraw a mapping run, in compact form.

A replay holds the evidence log, the two classes of every cell, the poses and a preview
of the drawing. It holds no prior: the player fuses any prior with the log by itself.

Layout, version 1. The whole is one zlib stream. Inside it every number is
little-endian, S is the number of readings, N of entries, M of runs, V of distinct
log-odds, R and C of rows and columns of cells:

====== ================ ==========================================================
offset type             content
====== ================ ==========================================================
0      4 bytes          ``OGR1``
4      uint32 [3]       height_px, width_px, cell_px
16     uint32 [4]       S, N, M, V
32     uint32           width w of a value index, bytes: 1, 2 or 4
36     uint32           size P of the preview, bytes
40     uint32 [2]       zero
48     float64 [2]      range_px, fov_rad
64     float64 [V]      the distinct log-odds, ascending, nats
next   float32 [S, 3]   poses: x_px, y_px, theta_rad (to draw the robot, no more)
next   uint32 [S]       number of runs of each reading
next   uint32 [M]       cells skipped before the run since the last one's end, from
                        cell 0 at each reading's start
next   uint32 [M]       cells in the run
next   uint w [N]       index of each entry's log-odds
next   ceil(R C / 8)    wall cells, one bit each, row-major, high bit first
next   ceil(R C / 8)    the ground truth's wall cells, the same
next   P bytes          preview of the drawing, PNG or JPEG
====== ================ ==========================================================

A *run* is a stretch of consecutive flat cells that one reading updated: a cone covers
few rows, so that runs are several times fewer than entries.
"""

import struct
import zlib
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, ByteArray, FloatArray, IntArray
from occsim.errors import ParameterError
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.imaging import Drawing
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory

MAX_ENTRIES = 12_000_000
"""Most cell updates: more could exhaust the memory of a browser tab."""
MAGIC = b"OGR1"
HEADER = struct.Struct("<4s11I2d")
PREVIEW_MAX_PX = 1200
"""Longest side of the preview, px: no screen shows more."""
PREVIEW_STEP = 17
"""Quantisation of the preview: 16 levels, black and white among them."""
PNG_MAX_BYTES = 96_000
"""A preview beyond this is a photograph or a noisy scan, where JPEG may be smaller."""
JPEG_QUALITY = 75
ZLIB_LEVEL = 6
COLOUR_SPREAD = 12
"""Channels that differ by less than this are one grey."""


@dataclass(frozen=True, eq=False)
class Replay:
    """The content of a replay's bytes.

    Parameters
    ----------
    evidence : EvidenceLog
        The log on its grid, exact.
    is_wall, truth : ndarray of bool, shape (R, C)
        Wall cells of the drawing and of the ground truth.
    poses : ndarray of float32, shape (S, 3)
        Columns x_px, y_px, theta_rad, rounded to single precision.
    range_px, fov_rad : float
        Reach and opening angle of the sensor.
    preview : bytes
        PNG or JPEG of the drawing.
    """

    evidence: EvidenceLog
    is_wall: BoolArray
    truth: BoolArray
    poses: npt.NDArray[np.float32]
    range_px: float
    fov_rad: float
    preview: bytes


def pack_replay(
    evidence: EvidenceLog,
    *,
    is_wall: BoolArray,
    truth: BoolArray,
    trajectory: Trajectory,
    sensor: Sensor,
    drawing: Drawing,
) -> bytes:
    """Return a mapping run as bytes; the module's text describes them.

    Parameters
    ----------
    evidence : EvidenceLog
        What the readings said.
    is_wall, truth : ndarray of bool, shape (R, C)
        Wall cells of the drawing (the prior's) and of the ground truth.
    trajectory : Trajectory
        The poses of the readings, one each.
    sensor : Sensor
        Its range and field of view are drawn.
    drawing : Drawing
        Shown beside the map.

    Returns
    -------
    bytes

    Raises
    ------
    ParameterError
        Where readings and poses differ in number, sizes differ, or the run is longer
        than `MAX_ENTRIES`.
    """
    _check_sizes(evidence, is_wall, truth, trajectory, drawing)
    grid = evidence.grid
    cell, log_odds = _sorted_entries(evidence)
    runs, gap, length = _runs(cell, evidence.indptr)
    values, index = _value_index(log_odds)
    preview = encode_preview(drawing)
    header = HEADER.pack(
        MAGIC,
        *(grid.height_px, grid.width_px, grid.cell_px),
        *(evidence.n_readings, cell.size, gap.size, values.size),
        *(index.itemsize, len(preview), 0, 0),
        *(sensor.range_px, sensor.fov_rad),
    )
    sections = (
        header,
        values.astype("<f8").tobytes(),
        trajectory.poses.astype("<f4").tobytes(),
        *(part.astype("<u4").tobytes() for part in (runs, gap, length)),
        index.astype(f"<u{index.itemsize}").tobytes(),
        np.packbits(is_wall).tobytes(),
        np.packbits(truth).tobytes(),
        preview,
    )
    return zlib.compress(b"".join(sections), ZLIB_LEVEL)


def unpack_replay(packed: bytes) -> Replay:
    """Return what `pack_replay` packed.

    Parameters
    ----------
    packed : bytes
        One replay.

    Returns
    -------
    Replay

    Raises
    ------
    ParameterError
        Where the bytes are not a replay of this version, or are cut short.
    """
    try:
        return _read(zlib.decompress(packed))
    except (zlib.error, struct.error, ValueError, IndexError) as error:
        raise ParameterError(
            f"packed must be a replay of version 1, whole; got {len(packed)} bytes "
            f"that are not ({error})"
        ) from None


def encode_preview(drawing: Drawing) -> bytes:
    """Return a small picture of a drawing, for the screen only.

    Parameters
    ----------
    drawing : Drawing
        The drawing at full size.

    Returns
    -------
    bytes
        PNG of 16 levels a channel, at most `PREVIEW_MAX_PX` long; JPEG where a
        photograph or noisy scan is smaller that way.
    """
    image = _screen_pixels(drawing)
    levels = (np.rint(np.arange(256) / PREVIEW_STEP) * PREVIEW_STEP).astype(np.uint8)
    png = _encode(".png", levels[image], [])
    if len(png) <= PNG_MAX_BYTES:
        return png
    jpeg = _encode(".jpg", image, [int(cv2.IMWRITE_JPEG_QUALITY), JPEG_QUALITY])
    return min(png, jpeg, key=len)


def _screen_pixels(drawing: Drawing) -> ByteArray:
    """Return the drawing at screen size, one channel where it has no colour."""
    rgb = drawing.rgb
    shrink = PREVIEW_MAX_PX / max(drawing.shape)
    if shrink < 1.0:
        height, width = (max(1, round(side * shrink)) for side in drawing.shape)
        rgb = np.asarray(
            cv2.resize(rgb, (width, height), interpolation=cv2.INTER_AREA), np.uint8
        )
    red, green, blue = cv2.split(rgb)
    spread = max(
        cv2.absdiff(red, green).max(initial=0), cv2.absdiff(green, blue).max(initial=0)
    )
    if spread < COLOUR_SPREAD:
        return np.asarray(green, dtype=np.uint8)
    return np.asarray(cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR), dtype=np.uint8)


def _encode(extension: str, image: ByteArray, options: list[int]) -> bytes:
    _, encoded = cv2.imencode(extension, image, options)
    return encoded.tobytes()


def _check_sizes(
    evidence: EvidenceLog,
    is_wall: BoolArray,
    truth: BoolArray,
    trajectory: Trajectory,
    drawing: Drawing,
) -> None:
    grid = evidence.grid
    for name, cells in (("is_wall", is_wall), ("truth", truth)):
        if cells.shape != grid.shape:
            raise ParameterError(
                f"{name} must have the grid's shape {grid.shape}; got {cells.shape}"
            )
    if evidence.cell.size > MAX_ENTRIES:
        raise ParameterError(
            f"a replay holds at most {MAX_ENTRIES:,} cell updates; this run has "
            f"{evidence.cell.size:,}: choose larger cells, a shorter range, a narrower "
            "field of view or fewer readings"
        )
    if len(trajectory) != evidence.n_readings:
        raise ParameterError(
            f"trajectory must have one pose for each of the {evidence.n_readings} "
            f"readings; got {len(trajectory)}"
        )
    if drawing.shape != (grid.height_px, grid.width_px):
        raise ParameterError(
            "drawing must have the size of the grid, "
            f"({grid.height_px}, {grid.width_px}) px; got {drawing.shape}"
        )


def _sorted_entries(
    evidence: EvidenceLog,
) -> tuple[npt.NDArray[np.int32], FloatArray]:
    """Return cells and log-odds with each reading's cells ascending."""
    cell, log_odds = evidence.cell, evidence.log_odds
    falls = np.flatnonzero(cell[1:] <= cell[:-1]) + 1
    if np.isin(falls, evidence.indptr).all():
        return cell, log_odds
    order = np.lexsort((cell, evidence.reading))
    return cell[order], log_odds[order]


def _runs(
    cell: npt.NDArray[np.int32], indptr: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the runs of each reading (S,), and each run's gap and length (M,)."""
    begins = np.ones(cell.size, dtype=np.bool_)
    np.not_equal(cell[1:], cell[:-1] + 1, out=begins[1:])
    begins[indptr[:-1][indptr[:-1] < cell.size]] = True
    entry = np.flatnonzero(begins)
    length = np.diff(entry, append=cell.size)
    first_run = np.searchsorted(entry, indptr)
    first_cell = cell[entry].astype(np.int64)
    last_end = np.zeros(entry.size, dtype=np.int64)
    last_end[1:] = (first_cell + length)[:-1]
    last_end[first_run[:-1][first_run[:-1] < entry.size]] = 0
    return np.diff(first_run), first_cell - last_end, length


def _value_index(
    log_odds: FloatArray,
) -> tuple[FloatArray, npt.NDArray[np.unsignedinteger]]:
    """Return the distinct values (V,) and, in few bytes, each entry's index (N,)."""
    values = np.unique(log_odds)
    width = next(w for w in (1, 2, 4) if values.size <= 256**w)
    index = np.searchsorted(values, log_odds).astype(f"u{width}")
    return values, index


def _read(content: bytes) -> Replay:
    """Return the replay in a decompressed stream; raise where sizes do not agree."""
    magic, *numbers = HEADER.unpack_from(content)
    if magic != MAGIC:
        raise ValueError("the first four bytes differ")
    height, width, cell_px, n_readings, n_entries, n_runs, n_values = numbers[:7]
    index_bytes, preview_bytes, _, _, range_px, fov_rad = numbers[7:]
    grid = Grid(height_px=height, width_px=width, cell_px=cell_px)
    at = HEADER.size

    def take(dtype: str, count: int) -> Any:
        nonlocal at
        part = np.frombuffer(content, dtype, count, at)
        at += part.nbytes
        return part

    values = take("<f8", n_values)
    poses = take("<f4", 3 * n_readings).reshape(-1, 3)
    runs, gap, length = (take("<u4", n) for n in (n_readings, n_runs, n_runs))
    index = take(f"<u{index_bytes}", n_entries)
    bits = -(-grid.n_cells // 8)
    is_wall, truth = (_flags(take("<u1", bits), grid) for _ in range(2))
    return Replay(
        evidence=_evidence(grid, runs, gap, length, values[index]),
        is_wall=is_wall,
        truth=truth,
        poses=poses,
        range_px=range_px,
        fov_rad=fov_rad,
        preview=take("<u1", preview_bytes).tobytes(),
    )


def _flags(bits: ByteArray, grid: Grid) -> BoolArray:
    flags = np.unpackbits(bits, count=grid.n_cells)
    return flags.astype(np.bool_).reshape(grid.shape)


def _evidence(
    grid: Grid,
    runs: npt.NDArray[np.uint32],
    gap: npt.NDArray[np.uint32],
    length: npt.NDArray[np.uint32],
    log_odds: FloatArray,
) -> EvidenceLog:
    """Return the log whose runs are given."""
    counts = length.astype(np.int64)
    first_run = np.concatenate([[0], np.cumsum(runs, dtype=np.int64)])
    first_entry = np.concatenate([[0], np.cumsum(counts)])
    # Gaps and lengths add up to the first cell of a run, from each reading's start.
    ahead = np.cumsum(gap, dtype=np.int64) + first_entry[:-1]
    end = np.concatenate([[0], ahead + counts])
    reading_start = np.repeat(end[first_run[:-1]], np.diff(first_run))
    within = np.arange(first_entry[-1]) - np.repeat(first_entry[:-1], counts)
    cell = np.repeat(ahead - reading_start, counts) + within
    return EvidenceLog(
        grid=grid,
        indptr=first_entry[first_run],
        cell=cell.astype(np.int32),
        log_odds=log_odds,
    )

"""The replay: all that a player needs to redraw mapping runs, in compact parts.

A replay has three kinds of parts, each sent once and shared by all maps that need it:

- the *scene*: the drawing's preview, the poses, the sensor, the walls of the world;
- a *log* per sensor reading and cell size: the evidence and the ground truth's cells;
- *walls* per drawing of a prior and cell size: the prior's wall cells.

No part holds a prior or an update rule: the player fuses any prior with a log by
itself.

Layout, version 2. Each part is one zlib stream. Inside it every number is
little-endian. S is the number of readings, H and W the sides of the drawing in px, R
and C the rows and columns of cells; flags are one bit each, row-major, high bit first.

====== ================ ==========================================================
offset type             content of a scene
====== ================ ==========================================================
0      4 bytes          ``OGS2``
4      uint32 [4]       height_px, width_px, S, size P of the preview, bytes
20     uint32           zero
24     float64 [2]      range_px, fov_rad
40     float32 [S, 3]   poses: x_px, y_px, theta_rad (to draw the robot, no more)
next   ceil(H W / 8)    the world's wall pixels
next   P bytes          preview of the drawing, PNG or JPEG
====== ================ ==========================================================

====== ================ ==========================================================
offset type             content of a log, with N entries, M runs, V distinct log-odds
====== ================ ==========================================================
0      4 bytes          ``OGL2``
4      uint32 [3]       height_px, width_px, cell_px
16     uint32 [4]       S, N, M, V
32     uint32           width w of a value index, bytes: 1, 2 or 4
36     uint32           zero
40     float64 [V]      the distinct log-odds, ascending, nats
next   uint32 [S]       number of runs of each reading
next   uint32 [M]       cells skipped before the run since the last one's end, from
                        cell 0 at each reading's start
next   uint32 [M]       cells in the run
next   uint w [N]       index of each entry's log-odds
next   ceil(R C / 8)    the ground truth's wall cells
====== ================ ==========================================================

====== ================ ==========================================================
offset type             content of walls
====== ================ ==========================================================
0      4 bytes          ``OGW2``
4      uint32 [2]       R, C
12     ceil(R C / 8)    the prior's wall cells
next   ceil(R C / 8)    cells of which it says nothing; left out where there are none
====== ================ ==========================================================

A *run* is a stretch of consecutive flat cells that one reading updated: a cone covers
few rows, so that runs are several times fewer than entries.
"""

import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.errors import ParameterError
from occsim.evidence_log import EvidenceLog
from occsim.grid import Grid
from occsim.imaging import Drawing
from occsim.io.preview import encode_preview
from occsim.sensor import Sensor
from occsim.trajectory import Trajectory
from occsim.world import World

T = TypeVar("T")

MAX_ENTRIES = 12_000_000
"""Most cell updates: more could exhaust the memory of a browser tab."""
SCENE, LOG, WALLS = b"OGS2", b"OGL2", b"OGW2"
SCENE_HEADER = struct.Struct("<4s5I2d")
LOG_HEADER = struct.Struct("<4s9I")
WALLS_HEADER = struct.Struct("<4s2I")
ZLIB_LEVEL = 6


@dataclass(frozen=True, eq=False)
class Scene:
    """The content of a scene's bytes.

    Parameters
    ----------
    poses : ndarray of float32, shape (S, 3)
        Columns x_px, y_px, theta_rad, rounded to single precision.
    range_px, fov_rad : float
        Reach and opening angle of the sensor.
    occupied : ndarray of bool, shape (H, W)
        Wall pixels of the world.
    preview : bytes
        PNG or JPEG of the drawing.
    """

    poses: npt.NDArray[np.float32]
    range_px: float
    fov_rad: float
    occupied: BoolArray
    preview: bytes


def pack_scene(
    world: World, *, trajectory: Trajectory, sensor: Sensor, drawing: Drawing
) -> bytes:
    """Return what all maps of a building share as bytes; see the module's text.

    Parameters
    ----------
    world : World
        Its wall pixels judge maps of different cell sizes.
    trajectory : Trajectory
        The poses of the readings.
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
        Where drawing and world differ in size.
    """
    height, width = world.occupied.shape
    if drawing.shape != (height, width):
        raise ParameterError(
            f"drawing must have the size of the world, ({height}, {width}) px; got "
            f"{drawing.shape}"
        )
    preview = encode_preview(drawing)
    return _compressed(
        SCENE_HEADER.pack(
            SCENE,
            *(height, width, len(trajectory), len(preview), 0),
            *(sensor.range_px, sensor.fov_rad),
        ),
        trajectory.poses.astype("<f4").tobytes(),
        np.packbits(world.occupied).tobytes(),
        preview,
    )


def pack_log(
    evidence: EvidenceLog, *, truth: BoolArray, trajectory: Trajectory
) -> bytes:
    """Return a log and the cells it is judged by as bytes; see the module's text.

    Parameters
    ----------
    evidence : EvidenceLog
        What the readings said.
    truth : ndarray of bool, shape (R, C)
        The ground truth's wall cells.
    trajectory : Trajectory
        The poses of the readings, one each; they are packed with the scene.

    Returns
    -------
    bytes

    Raises
    ------
    ParameterError
        Where readings and poses differ in number, `truth` has another shape than the
        grid, or the run is longer than `MAX_ENTRIES`.
    """
    _check_log(evidence, truth, trajectory)
    grid = evidence.grid
    cell, log_odds = _sorted_entries(evidence)
    runs, gap, length = _runs(cell, evidence.indptr)
    values, index = _value_index(log_odds)
    return _compressed(
        LOG_HEADER.pack(
            LOG,
            *(grid.height_px, grid.width_px, grid.cell_px),
            *(evidence.n_readings, cell.size, gap.size, values.size),
            *(index.itemsize, 0),
        ),
        values.astype("<f8").tobytes(),
        *(part.astype("<u4").tobytes() for part in (runs, gap, length)),
        index.astype(f"<u{index.itemsize}").tobytes(),
        np.packbits(truth).tobytes(),
    )


def pack_walls(is_wall: BoolArray, is_unknown: BoolArray | None = None) -> bytes:
    """Return a prior's wall cells as bytes, and those of which it says nothing.

    Arrays of bool of shape (R, C); see the module's text.
    """
    header = WALLS_HEADER.pack(WALLS, *is_wall.shape)
    planes = [is_wall] if is_unknown is None else [is_wall, is_unknown]
    return _compressed(header, *(np.packbits(plane).tobytes() for plane in planes))


def unpack_scene(packed: bytes) -> Scene:
    """Return what `pack_scene` packed.

    Raises
    ------
    ParameterError
        Where the bytes are not a scene of this version, or are cut short.
    """
    return _unpacked(packed, SCENE_HEADER, SCENE, _read_scene)


def unpack_log(packed: bytes) -> tuple[EvidenceLog, BoolArray]:
    """Return the log and the truth cells that `pack_log` packed, exact.

    Raises
    ------
    ParameterError
        Where the bytes are not a log of this version, or are cut short.
    """
    return _unpacked(packed, LOG_HEADER, LOG, _read_log)


def unpack_walls(packed: bytes) -> tuple[BoolArray, BoolArray | None]:
    """Return the wall cells and the unknown cells that `pack_walls` packed.

    Raises
    ------
    ParameterError
        Where the bytes are not walls of this version, or are cut short.
    """
    return _unpacked(packed, WALLS_HEADER, WALLS, _read_walls)


def _compressed(*sections: bytes) -> bytes:
    return zlib.compress(b"".join(sections), ZLIB_LEVEL)


def _check_log(evidence: EvidenceLog, truth: BoolArray, trajectory: Trajectory) -> None:
    grid = evidence.grid
    if truth.shape != grid.shape:
        raise ParameterError(
            f"truth must have the grid's shape {grid.shape}; got {truth.shape}"
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


class _Reader:
    """The sections of a decompressed part, one after the other."""

    def __init__(self, content: bytes, at: int):
        self.content, self.at = content, at

    def take(self, dtype: str, count: int) -> Any:
        part = np.frombuffer(self.content, dtype, count, self.at)
        self.at += part.nbytes
        return part

    def flags(self, shape: tuple[int, int]) -> BoolArray:
        count = shape[0] * shape[1]
        bits = self.take("<u1", -(-count // 8))
        flags = np.unpackbits(bits, count=count)
        return np.asarray(flags.astype(np.bool_).reshape(shape))


def _unpacked(
    packed: bytes,
    header: struct.Struct,
    magic: bytes,
    read: Callable[[tuple[Any, ...], _Reader], T],
) -> T:
    """Return a part that was packed; raise where its sizes do not agree."""
    try:
        content = zlib.decompress(packed)
        found, *numbers = header.unpack_from(content)
        if found != magic:
            raise ValueError("the first four bytes differ")
        return read(tuple(numbers), _Reader(content, header.size))
    except (zlib.error, struct.error, ValueError, IndexError) as error:
        raise ParameterError(
            f"packed must be a part of a replay of version 2 ({magic.decode()}), "
            f"whole; got {len(packed)} bytes that are not ({error})"
        ) from None


def _read_scene(numbers: tuple[Any, ...], reader: _Reader) -> Scene:
    height, width, n_readings, preview_bytes, _, range_px, fov_rad = numbers
    return Scene(
        poses=reader.take("<f4", 3 * n_readings).reshape(-1, 3),
        range_px=range_px,
        fov_rad=fov_rad,
        occupied=reader.flags((height, width)),
        preview=reader.take("<u1", preview_bytes).tobytes(),
    )


def _read_log(
    numbers: tuple[Any, ...], reader: _Reader
) -> tuple[EvidenceLog, BoolArray]:
    height, width, cell_px, n_readings, n_entries, n_runs, n_values, w, _ = numbers
    grid = Grid(height_px=height, width_px=width, cell_px=cell_px)
    values = reader.take("<f8", n_values)
    runs, gap, length = (reader.take("<u4", n) for n in (n_readings, n_runs, n_runs))
    index = reader.take(f"<u{w}", n_entries)
    evidence = _evidence(grid, runs, gap, length, values[index])
    return evidence, reader.flags(grid.shape)


def _read_walls(
    numbers: tuple[Any, ...], reader: _Reader
) -> tuple[BoolArray, BoolArray | None]:
    shape = numbers[0], numbers[1]
    is_wall, is_complete = reader.flags(shape), reader.at == len(reader.content)
    return is_wall, None if is_complete else reader.flags(shape)


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

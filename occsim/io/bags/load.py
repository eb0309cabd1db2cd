"""The scans of a bag, on a map of their own."""

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from occsim._extras import needs_extra
from occsim._files import printable
from occsim._npz import unpacked
from occsim._types import FloatArray
from occsim.errors import OccsimError, RobotFileError, choice
from occsim.io.bags.limits import ARRAYS, MAX_SECONDS, PoseSource
from occsim.io.bags.parts import read_parts, suffix_of
from occsim.io.scans import MAX_RANGES, MetricScans, check_lengths, metric_scans

PROCESS = Path(__file__).with_name("process.py")


@dataclass(frozen=True, eq=False, repr=False)
class BagLog(MetricScans):
    """The scans of a bag on a map of their own.

    Parameters
    ----------
    scan_log, frame, width_px, usable_range_m
        As in `MetricScans`.
    times_s : ndarray of float64, shape (S,)
        When each scan was taken.
    scan_topic : str
        The topic of the scans.
    poses_from : str
        What said where they were taken: a topic, or frames.
    n_left_out : int
        Scans before the first pose or after the last, or with other beams than most.

    Examples
    --------
    >>> from dataclasses import fields
    >>> from occsim.io.bags import BagLog
    >>> [field.name for field in fields(BagLog)][4:]
    ['times_s', 'scan_topic', 'poses_from', 'n_left_out']
    """

    times_s: FloatArray
    scan_topic: str
    poses_from: str
    n_left_out: int


def is_readable() -> bool:
    """Return whether `rosbags` is installed."""
    return find_spec("rosbags") is not None


def load(
    source: bytes | str | Path,
    *,
    scan_topic: str | None = None,
    poses: PoseSource = PoseSource.AUTO,
    metres_per_px: float = 0.05,
    max_range_m: float | None = None,
    usable_range_m: float | None = None,
) -> BagLog:
    """Return the scans of a ROS bag.

    Parameters
    ----------
    source : bytes, str or Path
        The content of a file (.bag of ROS 1, .mcap or .db3 of ROS 2), or where it is.
        ROS 2 keeps a recording as a folder: that folder, or a zip file of it.
    scan_topic : str, optional
        A topic of ``sensor_msgs/LaserScan``; by default the one with the most scans.
    poses : PoseSource, default PoseSource.AUTO
        What says where the scans were taken. Poses are interpolated at their times.
    metres_per_px, usable_range_m
        As in `occsim.io.scans.metric_scans`.
    max_range_m : float, optional
        A reading at or beyond it is no return; by default the bag's ``range_max``.

    Returns
    -------
    BagLog
        A reading below the bag's ``range_min`` is invalid.

    Raises
    ------
    ImportError
        Where `rosbags` is not installed.
    RobotFileError
        Where the file is missing, damaged or too large, has no scans or no poses, or
        takes too long or too much memory to read.
    ParameterError
        Where a parameter lies outside its domain.

    Examples
    --------
    A bag is a file: ``bags.load("drive.mcap")``. Anything else is refused.

    >>> from occsim.io import bags
    >>> bags.load(b"FLASER 3 1 1 1")
    Traceback (most recent call last):
    occsim.errors.RobotFileError: the bag is none of ROS (.bag, .mcap or .db3)
    """
    wanted = choice("poses", poses, PoseSource)
    check_lengths(
        metres_per_px=metres_per_px,
        max_range_m=max_range_m,
        usable_range_m=usable_range_m,
    )
    parts, name = read_parts(source)
    facts, arrays = _extracted(parts, printable(name), scan_topic, wanted.value)
    ranges = np.asarray(arrays["ranges_m"], dtype=np.float64)
    most = float(arrays["max_range_m"]) if max_range_m is None else float(max_range_m)
    with np.errstate(invalid="ignore"):
        ranges = np.where(ranges >= most, np.inf, ranges)
    try:
        found = metric_scans(
            arrays["poses_m"],
            arrays["bearings_rad"],
            ranges,
            most,
            metres_per_px=metres_per_px,
            usable_range_m=usable_range_m,
        )
    except OccsimError as error:
        raise RobotFileError(f"{printable(name)}: {error}") from None
    times = np.asarray(arrays["times_s"], dtype=np.float64)
    return BagLog(**vars(found), times_s=times, **facts)


def _extracted(
    parts: list[bytes], name: str, scan_topic: str | None, poses: str
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what a bag's own process read."""
    with _as_files(parts, name) as paths:
        with needs_extra("ros", "a ROS bag"):
            import rosbags.interfaces  # noqa: F401
        request = {
            "paths": [str(path) for path in paths],
            "name": name,
            "scan_topic": scan_topic,
            "poses": poses,
            "max_ranges": MAX_RANGES,
        }
        answer = _asked(json.dumps(request), name)
    line, _, packed = answer.partition(b"\n")
    reply = json.loads(line)
    if "refused" in reply:
        raise RobotFileError(reply["refused"])
    arrays = unpacked(
        packed, ARRAYS, what="scans", max_values=MAX_RANGES, error=RobotFileError
    )
    return reply, arrays


@contextlib.contextmanager
def _as_files(parts: list[bytes], name: str) -> Iterator[list[Path]]:
    """Lend files with suffixes that `rosbags` knows, in a folder of their own each."""
    suffixes = [suffix_of(data, name) for data in parts]
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for index, (data, suffix) in enumerate(zip(parts, suffixes, strict=True)):
            paths.append(Path(folder, str(index), f"bag{suffix}"))
            paths[-1].parent.mkdir()
            paths[-1].write_bytes(data)
        yield paths


def _asked(request: str, name: str) -> bytes:
    """Return the answer of a process that reads the bag.

    In a bag, chunks can unpack to any size, and tables can be computed: only the
    system can bound that.
    """
    folders = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-S", "-B", str(PROCESS)],
            input=request.encode("ascii"),
            # Packages are found on this process's path; `site` is skipped: it is slow.
            env=os.environ | {"PYTHONPATH": folders, "OPENBLAS_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=MAX_SECONDS,
            check=True,
        )
    except subprocess.TimeoutExpired:
        raise RobotFileError(
            f"{name} takes longer than {MAX_SECONDS:.0f} s to read, more than a bag may"
        ) from None
    except (subprocess.CalledProcessError, OSError):
        raise RobotFileError(
            f"{name} is damaged, or takes more memory to read than a bag may"
        ) from None
    return done.stdout

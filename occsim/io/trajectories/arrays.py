"""Poses from NPY and JSON files."""

import io
import json
from typing import Any

import numpy as np

from occsim._files import printable
from occsim._npz import read_header
from occsim.errors import TrajectoryError
from occsim.io.trajectories.columns import find_columns
from occsim.io.trajectories.table import (
    MAX_POSES,
    TrajectoryTable,
    check_array,
    check_count,
    table_from,
)
from occsim.io.trajectories.text import decode

NPY_MARK = b"\x93NUMPY"

MAX_JSON_BYTES = 10_000_000
"""Largest JSON file, bytes: 200 a pose. All of it is in memory at once."""

MAX_JSON_VALUES = 12 * MAX_POSES
"""Most numbers and texts in one."""


def parse_npy(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a NumPy file; its header is checked before it is read.

    Parameters
    ----------
    data : bytes
        One array of real numbers, shape (S, 3), without pickled objects.
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
    """
    stream = io.BytesIO(data)
    try:
        shape, by_column, dtype = read_header(stream)
    except ValueError:
        raise TrajectoryError(f"the header of {name} is damaged or unknown") from None
    check_array(shape, dtype, name)
    start, count = stream.tell(), shape[0] * 3
    if len(data) - start < count * dtype.itemsize:
        raise TrajectoryError(
            f"{name} is cut short: {shape[0]:,} poses of 3 numbers are announced, "
            f"{len(data) - start:,} bytes follow"
        )
    values = np.frombuffer(data, dtype, count, start)
    values = values.reshape(shape, order="F" if by_column else "C")
    with np.errstate(over="ignore"):  # long doubles beyond float64 become infinite
        return table_from(values.astype(np.float64), {}, name)


def parse_json(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a JSON file.

    Parameters
    ----------
    data : bytes
        A list of ``[x, y, theta]`` or of ``{"x": .., "y": .., "theta": ..}``, or an
        object with such a list as ``"poses"`` and, if wanted, the titles of its
        columns as ``"columns"``.
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
    """
    _check_json_size(data, name)
    text = decode(data, name)
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        place = getattr(error, "lineno", None)
        where = f" (line {place})" if place else ""
        raise TrajectoryError(f"{name} is not valid JSON{where}") from None
    columns = ["x", "y", "theta"]
    if isinstance(content, dict):
        columns = content.get("columns", columns)
        content = content.get("poses")
    if not isinstance(content, list):
        raise TrajectoryError(
            f'{name} must hold a list of poses, or an object with one as "poses"'
        )
    check_count(len(content), name)
    if isinstance(content[0], dict):
        columns = list(content[0])
        content = [_ordered(pose, columns, k, name) for k, pose in enumerate(content)]
    return _json_rows(content, columns, name)


def _check_json_size(data: bytes, name: str) -> None:
    """Refuse, before parsing, a file that would take too much memory."""
    n_lists = max(data.count(b"["), data.count(b"{"))
    if (
        len(data) > MAX_JSON_BYTES
        or data.count(b",") > MAX_JSON_VALUES
        or n_lists > MAX_POSES + 100
    ):
        raise TrajectoryError(
            f"{name} is too long; a JSON file may have {MAX_JSON_BYTES / 1e6:.0f} MB, "
            f"{MAX_POSES:,} poses and {MAX_JSON_VALUES:,} values"
        )


def _json_rows(rows: list[Any], titles: Any, name: str) -> TrajectoryTable:
    columns = (
        find_columns([str(title) for title in titles])
        if isinstance(titles, list)
        else None
    )
    if columns is None:
        raise TrajectoryError(
            f"the poses of {name} must have x, y and theta "
            "(or x_px, y_px, theta_deg or theta_rad)"
        )
    values = np.empty((len(rows), len(columns.indices)))
    for k, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != len(titles):
            raise TrajectoryError(
                f"{name}, pose {k + 1}: a list of {len(titles)} numbers is needed; "
                f"got {_short(row)}"
            )
        values[k] = [_json_number(row[i], k, name) for i in columns.indices]
    return table_from(columns.poses(values), columns.units, name)


def _ordered(pose: Any, keys: list[str], k: int, name: str) -> list[Any]:
    """Return the values of an object in the order of the first one's keys."""
    if not isinstance(pose, dict) or not set(keys) <= set(pose):
        raise TrajectoryError(
            f"{name}, pose {k + 1}: the keys of the first pose are needed "
            f"({printable(', '.join(keys)[:60])}); got {_short(pose)}"
        )
    return [pose[key] for key in keys]


def _json_number(value: Any, k: int, name: str) -> float:
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            return float("inf")
    raise TrajectoryError(
        f"{name}, pose {k + 1}: every value must be a number; got {_short(value)}"
    )


def _short(value: object) -> str:
    """Return a value that can be quoted; lists may be nested deeply."""
    if isinstance(value, list | dict):
        return f"a {'list' if isinstance(value, list) else 'object'} of {len(value)}"
    return printable(json.dumps(value)[:40])

"""Poses from NPY, MAT and JSON files."""

import io
import json
import zlib
from typing import Any, Literal

import numpy as np

from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.trajectory_files.table import (
    MAX_POSES,
    TrajectoryTable,
    check_count,
    column_axis,
    find_columns,
    table_from,
)
from occsim.trajectory_files.text import decode

NPY_MARK = b"\x93NUMPY"
HDF5_MARK = b"\x89HDF\r\n\x1a\n"
MATLAB_5_MARK = b"MATLAB 5.0 MAT-file"
MATLAB_73_MARK = b"MATLAB 7.3 MAT-file"

MAX_INFLATED_BYTES = 100_000_000
"""Most that the compressed variables of a MAT file may hold, bytes."""

# In a MAT 5 file each variable opens with a tag of two 32-bit words, its type and
# its length; this type is a variable compressed by zlib.
_MAT5_HEADER_BYTES = 128
_MAT5_COMPRESSED = 15


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
        read_header = {
            (1, 0): np.lib.format.read_array_header_1_0,
            (2, 0): np.lib.format.read_array_header_2_0,
        }[np.lib.format.read_magic(stream)]
        shape, by_column, dtype = read_header(stream)
    except Exception:  # damaged headers end in errors of many types
        raise TrajectoryError(f"the header of {name} is damaged or unknown") from None
    _check_array(shape, dtype, name)
    start, count = stream.tell(), shape[0] * 3
    if len(data) - start < count * dtype.itemsize:
        raise TrajectoryError(
            f"{name} is cut short: {shape[0]:,} poses of 3 numbers are announced, "
            f"{len(data) - start:,} bytes follow"
        )
    values = np.frombuffer(data, dtype, count, start)
    values = values.reshape(shape, order="F" if by_column else "C")
    return table_from(_float64(values), {}, name)


def parse_mat(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a MATLAB file of version 4 to 7.

    Parameters
    ----------
    data : bytes
        Holds one array of shape (S, 3) under any name, or one called
        "trajectory", "poses" or "path" (with "_deg" or "_rad" or not).
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
    """
    import scipy.io  # here, because few trajectories are MAT files

    if data.startswith((MATLAB_73_MARK, HDF5_MARK)):
        raise TrajectoryError(
            f"{name} is a MATLAB 7.3 file; versions 4 to 7 are allowed "
            "(in MATLAB: save(..., '-v7'))"
        )
    _check_inflated(data, name)
    try:
        variable = _choose_variable(scipy.io.whosmat(io.BytesIO(data)), name)
        read = scipy.io.loadmat(io.BytesIO(data), variable_names=[variable])
        values = np.asarray(read[variable])
    except TrajectoryError:
        raise
    except Exception:  # damaged files end in errors of many types
        raise TrajectoryError(
            f"{name} is damaged or not a MATLAB file of version 4 to 7"
        ) from None
    _check_array(values.shape, values.dtype, name)
    unit = column_axis(f"theta_{variable.rsplit('_', 1)[-1]}")[1]
    return table_from(_float64(values), {"theta": unit}, name)


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
    try:
        content = json.loads(decode(data, name))
    except TrajectoryError:
        raise
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
        columns = [str(key) for key in content[0]]
        content = [_ordered(pose, columns, k, name) for k, pose in enumerate(content)]
    return _json_rows(content, columns, name)


def _json_rows(rows: list[Any], columns: Any, name: str) -> TrajectoryTable:
    found = (
        find_columns([str(title) for title in columns])
        if isinstance(columns, list)
        else None
    )
    if found is None:
        raise TrajectoryError(
            f"the poses of {name} must have x, y and theta "
            "(or x_px, y_px, theta_deg or theta_rad)"
        )
    indices, units = found
    values = np.empty((len(rows), 3))
    for k, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != len(columns):
            raise TrajectoryError(
                f"{name}, pose {k + 1}: a list of {len(columns)} numbers is needed; "
                f"got {_short(row)}"
            )
        values[k] = [_json_number(row[i], k, name) for i in indices]
    return table_from(values, units, name)


def _ordered(pose: Any, keys: list[str], k: int, name: str) -> list[Any]:
    """Return the values of an object in the order of the first one's keys."""
    if not isinstance(pose, dict) or not set(keys) <= set(pose):
        raise TrajectoryError(
            f"{name}, pose {k + 1}: the keys of the first pose are needed "
            f"({', '.join(keys)[:60]}); got {_short(pose)}"
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
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def _check_array(shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> None:
    if len(shape) != 2 or shape[1] != 3:
        raise TrajectoryError(
            f"the array in {name} must have shape (S, 3), rows of x, y, theta; "
            f"got {tuple(shape)}"
        )
    if dtype.kind not in "iuf":
        raise TrajectoryError(
            f"the array in {name} must hold real numbers; got {dtype}"
        )
    check_count(shape[0], name)


def _float64(values: np.ndarray[Any, Any]) -> FloatArray:
    return np.ascontiguousarray(values, dtype=np.float64)


def _choose_variable(
    variables: list[tuple[str, tuple[int, ...], str]], name: str
) -> str:
    """Return the variable that is the trajectory, of (name, shape, class) of each."""
    numeric = {"double", "single"} | {
        f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)
    }
    fits = [
        variable
        for variable, shape, kind in variables
        if len(shape) == 2 and shape[1] == 3 and kind in numeric
    ]
    usual = ("trajectory", "poses", "path")
    named = [
        v for v in fits if v.removesuffix("_deg").removesuffix("_rad").lower() in usual
    ]
    if len(fits) != 1 and len(named) != 1:
        listed = ", ".join(f"{v} {s}" for v, s, _ in variables[:5]) or "nothing"
        raise TrajectoryError(
            f"{name} must hold one array of shape (S, 3), or one called trajectory; "
            f"got {listed[:120]}"
        )
    variable = (named or fits)[0]
    shape = next(s for v, s, _ in variables if v == variable)
    check_count(shape[0], name)
    return variable


def _check_inflated(data: bytes, name: str) -> None:
    """Refuse a MAT 5 file whose compressed variables would fill the memory."""
    endian: dict[bytes, Literal["little", "big"]] = {b"IM": "little", b"MI": "big"}
    order = endian.get(data[126:128])
    if order is None:  # a MAT 4 file: never compressed
        return
    left, at = MAX_INFLATED_BYTES, _MAT5_HEADER_BYTES
    while at + 8 <= len(data):
        kind = int.from_bytes(data[at : at + 4], order)
        size = int.from_bytes(data[at + 4 : at + 8], order)
        at += 8
        if kind == _MAT5_COMPRESSED:
            left -= _inflated_bytes(data[at : at + size], left + 1, name)
        if left < 0:
            raise TrajectoryError(
                f"{name} unpacks to more than {MAX_INFLATED_BYTES / 1e6:.0f} MB; "
                f"an array of at most {MAX_POSES:,} x 3 numbers is needed"
            )
        at += size


def _inflated_bytes(packed: bytes, limit: int, name: str) -> int:
    """Return how many bytes unpack, counting up to `limit`."""
    inflater, total = zlib.decompressobj(), 0
    try:
        while total < limit and packed:
            piece = inflater.decompress(packed, 1_000_000)
            total += len(piece)
            packed = inflater.unconsumed_tail if piece else b""
    except zlib.error:
        raise TrajectoryError(f"{name} is damaged: its data do not unpack") from None
    return total

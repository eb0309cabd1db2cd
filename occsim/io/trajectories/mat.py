"""Poses from MATLAB files of version 4 to 7.

Read here and not by SciPy, whose reader trusts the lengths stated in a file: a few
changed bytes can crash the process. Only full real matrices at the top level are read
(of version 4, little-endian ones).
"""

import itertools
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from occsim._files import printable
from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.io.trajectories.columns import column_axis
from occsim.io.trajectories.table import (
    MAX_POSES,
    TrajectoryTable,
    check_count,
    table_from,
)

HDF5_MARK = b"\x89HDF\r\n\x1a\n"
MATLAB_5_MARK = b"MATLAB 5.0 MAT-file"
MATLAB_73_MARK = b"MATLAB 7.3 MAT-file"

MAX_INFLATED_BYTES = 40_000_000
"""Most that the compressed variables of a file may hold, bytes."""

MAX_VARIABLES = 1000
"""Most variables in a file."""

USUAL_NAMES = ("trajectory", "poses", "path")

# Version 5: the header's length; types of data elements; classes of arrays.
_HEADER_BYTES = 128
_MATRIX, _COMPRESSED = 14, 15
_ELEMENT_TYPES = {
    **{1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4"},
    **{6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"},
}
_REAL_CLASSES = range(6, 16)  # double, single, and integers of 8 to 64 bits
_COMPLEX_FLAG = 0x08

# Version 4: types of elements by the tens digit of a matrix's type.
_MAT4_TYPES = ("f8", "f4", "i4", "i2", "u2", "u1")


@dataclass(frozen=True, eq=False, kw_only=True)
class _Variable:
    """A matrix whose elements are not read yet."""

    name: str
    shape: tuple[int, ...]
    is_real: bool
    dtype: str = "<f8"
    data: memoryview = memoryview(b"")

    @property
    def fits(self) -> bool:
        return self.is_real and len(self.shape) == 2 and self.shape[1] == 3

    def values(self) -> FloatArray:
        """Return the matrix, shape (S, 3); ValueError where elements are missing."""
        count = self.shape[0] * self.shape[1]
        flat = np.frombuffer(self.data, self.dtype, count)
        return np.ascontiguousarray(flat.reshape(self.shape, order="F"), np.float64)


def parse_mat(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a MATLAB file of version 4 to 7.

    Parameters
    ----------
    data : bytes
        Holds one matrix of shape (S, 3) under any name, or one called
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
    if data.startswith((MATLAB_73_MARK, HDF5_MARK)):
        raise TrajectoryError(
            f"{name} is a MATLAB 7.3 file; versions 4 to 7 are allowed "
            "(in MATLAB: save(..., '-v7'))"
        )
    try:
        variables = list(itertools.islice(_variables(data, name), MAX_VARIABLES))
        variable = _choose(variables, name)
        values = variable.values()
    except TrajectoryError:
        raise
    except (ValueError, LookupError, struct.error, zlib.error):
        raise TrajectoryError(
            f"{name} is damaged or not a MATLAB file of version 4 to 7"
        ) from None
    unit = column_axis(f"theta_{variable.name.rsplit('_', 1)[-1]}")[1]
    return table_from(values, {"theta": unit}, name)


def _choose(variables: list[_Variable], name: str) -> _Variable:
    """Return the variable that is the trajectory."""
    fits = [variable for variable in variables if variable.fits]
    named = [
        variable
        for variable in fits
        if variable.name.lower().removesuffix("_deg").removesuffix("_rad")
        in USUAL_NAMES
    ]
    if len(fits) != 1 and len(named) != 1:
        listed = ", ".join(f"{v.name} {v.shape}" for v in variables[:5]) or "nothing"
        raise TrajectoryError(
            f"{name} must hold one real matrix of shape (S, 3), or one called "
            f"trajectory; got {printable(listed[:120])}"
        )
    chosen = (named or fits)[0]
    check_count(chosen.shape[0], name)
    return chosen


def _variables(data: bytes, name: str) -> Iterator[_Variable]:
    """Return the matrices of a file, whatever its version."""
    order = {b"IM": "<", b"MI": ">"}.get(data[126:_HEADER_BYTES])
    if order is None:
        yield from _mat4_matrices(data)
        return
    left = MAX_INFLATED_BYTES
    for kind, body in _elements(memoryview(data)[_HEADER_BYTES:], order):
        if kind == _COMPRESSED:
            inflated = zlib.decompressobj().decompress(body, left + 1)
            left -= len(inflated)
            if left < 0:
                raise TrajectoryError(
                    f"{name} unpacks to more than {MAX_INFLATED_BYTES / 1e6:.0f} MB; "
                    f"a matrix of at most {MAX_POSES:,} x 3 numbers is needed"
                )
            kind, body = next(_elements(memoryview(inflated), order), (0, body))
        if kind == _MATRIX:
            yield _mat5_matrix(body, order)


def _elements(data: memoryview, order: str) -> Iterator[tuple[int, memoryview]]:
    """Return type and content of each data element of a version 5 file."""
    at = 0
    for _ in range(MAX_VARIABLES):
        if at + 8 > len(data):
            return
        kind, size = struct.unpack_from(order + "II", data, at)
        start, following = at + 8, at + 8 + size
        if kind >> 16:  # a small element: size, type and content in eight bytes
            kind, size, start, following = kind & 0xFFFF, kind >> 16, at + 4, at + 8
        elif kind != _COMPRESSED:
            following += -size % 8
        if start + size > min(len(data), following):
            raise ValueError("an element reaches beyond its end")
        yield kind, data[start : start + size]
        at = following


def _mat5_matrix(body: memoryview, order: str) -> _Variable:
    """Return a matrix of a version 5 file: flags, dimensions, name, real part."""
    parts = list(itertools.islice(_elements(body, order), 4))
    (flags,) = struct.unpack_from(order + "I", parts[0][1])
    if flags & 0xFF not in _REAL_CLASSES:
        return _Variable(name="(no numbers)", shape=(), is_real=False)
    shape = np.frombuffer(parts[1][1], order + "i4")
    kind, numbers = parts[3]
    return _Variable(
        name=bytes(parts[2][1]).decode("latin-1"),
        shape=tuple(shape.tolist()),
        is_real=not flags >> 8 & _COMPLEX_FLAG,
        dtype=order + _ELEMENT_TYPES[kind],
        data=numbers,
    )


def _mat4_matrices(data: bytes) -> Iterator[_Variable]:
    """Return the matrices of a version 4 file."""
    at, header = 0, struct.Struct("<5i")
    while at < len(data):
        kind, n_rows, n_cols, imaginary, name_size = header.unpack_from(data, at)
        dtype = np.dtype("<" + _MAT4_TYPES[kind // 10])
        start = at + header.size + name_size
        size = n_rows * n_cols * dtype.itemsize
        at = start + size * (2 if imaginary else 1)
        if not 0 <= kind < 100 or min(n_rows, n_cols, size) < 0 or name_size < 1:
            raise ValueError("not a matrix of version 4, little-endian")
        if at > len(data):
            raise ValueError("the file is cut short")
        yield _Variable(
            name=data[start - name_size : start].rstrip(b"\0").decode("latin-1"),
            shape=(n_rows, n_cols),
            is_real=not imaginary and kind % 10 == 0,
            dtype=dtype.str,
            data=memoryview(data)[start : start + size],
        )

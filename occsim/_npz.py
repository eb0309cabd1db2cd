"""Arrays in NumPy's NPZ format, read within limits and without pickled objects."""

import io
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from occsim import _archives
from occsim.errors import OccsimError, shown

Array = npt.NDArray[np.generic]

HEADER_BYTES = 1_000
"""Most that the header of an array may take beside its values."""


def packed(arrays: Mapping[str, Array]) -> bytes:
    """Return arrays as the content of an NPZ file."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # allow_pickle
    return file.getvalue()


def unpacked(
    data: bytes,
    dtypes: Mapping[str, npt.DTypeLike],
    *,
    what: str,
    max_values: int,
    error: type[OccsimError],
    any_real: bool = False,
) -> dict[str, Array]:
    """Return the arrays of an NPZ file.

    Parameters
    ----------
    data : bytes
        The file's content.
    dtypes : mapping
        The type of each array by its name: all of them must be there, no other may.
    what : str
        What the file is, for messages.
    max_values : int
        Most values that an array may have.
    error : type of OccsimError
        What to raise.
    any_real : bool, default False
        Whether real numbers of other types, of at most 8 bytes, are taken, too, as a
        program of another author writes them.

    Returns
    -------
    dict of ndarray

    Raises
    ------
    OccsimError
        Of the type given, where the file is damaged or holds anything else.
    """
    kinds = {f"{name}.npy": np.dtype(kind) for name, kind in dtypes.items()}
    limits = {
        name: max_values * dtype.itemsize + HEADER_BYTES
        for name, dtype in kinds.items()
    }
    try:
        files = _archives.unpacked(
            data,
            limits,
            required=limits,
            max_bytes=sum(limits.values()),
            what=what,
            needed="NPZ",
        )
        return {
            name.removesuffix(".npy"): _array(name, files[name], dtype, any_real)
            for name, dtype in kinds.items()
        }
    except ValueError as reason:  # an ArchiveError, too
        raise error(f"it is not an undamaged file of {what}: {reason}") from None


def read_header(content: io.BytesIO) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Return what the header of an NPY file says, read up to the values.

    Parameters
    ----------
    content : BytesIO
        The file, at its start.

    Returns
    -------
    shape : tuple of int
    by_column : bool
    dtype : dtype

    Raises
    ------
    ValueError
        Where it is damaged or unknown.
    """
    try:
        read = {
            (1, 0): np.lib.format.read_array_header_1_0,
            (2, 0): np.lib.format.read_array_header_2_0,
        }[np.lib.format.read_magic(content)]
        shape, by_column, dtype = read(content)
    except Exception:  # damaged headers end in errors of many types
        raise ValueError("the header is damaged or unknown") from None
    return shape, by_column, dtype


def _array(
    name: str, data: bytes, dtype: np.dtype[np.generic], any_real: bool
) -> Array:
    content = io.BytesIO(data)
    # Type, shape and length are compared before any value is read: numpy would else
    # set memory aside for what a header announces.
    try:
        shape, by_column, found = read_header(content)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    is_real = found.kind in "iuf" and found.itemsize <= np.float64().itemsize
    if found != dtype and not (any_real and is_real):
        raise ValueError(f"{name} must be of type {dtype}; got {found!s:.40}")
    count = int(np.prod(shape, dtype=object))
    start = content.tell()
    if len(data) - start != count * found.itemsize:
        raise ValueError(f"{name} must be as long as its shape says, {shown(shape)}")
    values = np.frombuffer(data, found, count, start)
    values = values.reshape(shape, order="F" if by_column else "C")
    return values.astype(dtype, "C", copy=False)

"""Arrays in NumPy's NPZ format, read within limits and without pickled objects."""

import io
import zipfile
import zlib
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from occsim.errors import OccsimError

Array = npt.NDArray[np.generic]

MAX_ENTRIES = 50
"""Most entries of the table of contents, which zipfile reads before it can be
checked."""

HEADER_BYTES = 1_000
"""Most that the header of an array may take beside its values."""

_ENTRY_MARK = b"PK\x01\x02"

# What zipfile and numpy raise on damage: ValueError covers UnicodeDecodeError.
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    EOFError,
    OSError,
    OverflowError,
    NotImplementedError,
    ValueError,
    TypeError,
    SyntaxError,
    KeyError,
)


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

    Returns
    -------
    dict of ndarray

    Raises
    ------
    OccsimError
        Of the type given, where the file is damaged or holds anything else.
    """
    try:
        if data.count(_ENTRY_MARK) > MAX_ENTRIES:
            raise ValueError("too many entries")
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = {entry.filename: entry for entry in archive.infolist()}
            if set(entries) != {f"{name}.npy" for name in dtypes}:
                raise KeyError("other arrays")
            wanted = {
                name: (entries[f"{name}.npy"], np.dtype(kind))
                for name, kind in dtypes.items()
            }
            for entry, dtype in wanted.values():
                _check_size(entry, max_values * dtype.itemsize + HEADER_BYTES)
            return {
                name: _array(archive, entry, dtype)
                for name, (entry, dtype) in wanted.items()
            }
    except _DAMAGE:
        raise error(
            f"it is not an undamaged file of {what}, of at most {max_values:,} values"
        ) from None


def _check_size(entry: zipfile.ZipInfo, most: int) -> None:
    if entry.file_size > most or entry.flag_bits & 1:
        raise ValueError("too large, or encrypted")
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError("another way of packing")


def _array(
    archive: zipfile.ZipFile, entry: zipfile.ZipInfo, dtype: np.dtype[np.generic]
) -> Array:
    with archive.open(entry) as file:  # no further than the size that was checked
        content = io.BytesIO(file.read(entry.file_size))
    # Type, shape and length are compared before any value is read: numpy would else
    # set memory aside for what a header announces.
    if np.lib.format.read_magic(content) != (1, 0):
        raise ValueError("another version")
    shape, by_column, found = np.lib.format.read_array_header_1_0(content)
    count = int(np.prod(shape, dtype=object))
    start = content.tell()
    n_bytes = content.getbuffer().nbytes - start
    if found != dtype or by_column or n_bytes != count * dtype.itemsize:
        raise ValueError("another type or length")
    return np.frombuffer(content.getvalue(), dtype, count, start).reshape(shape)

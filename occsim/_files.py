"""Reading a file of any kind, once its size is known to be sensible."""

import errno
import stat
from pathlib import Path

from occsim.errors import OccsimError

LONGEST_NAME = 100


def printable(name: str) -> str:
    r"""Return a file's name as one line of valid text, to be shown in messages.

    Parameters
    ----------
    name : str
        May hold line breaks, or bytes that are not text.

    Returns
    -------
    str
        Of at most 100 characters.

    Examples
    --------
    >>> printable("plan\n.png")
    'plan\ufffd.png'
    """
    shown = name if len(name) <= LONGEST_NAME else f"...{name[3 - LONGEST_NAME :]}"
    return "".join(c if c.isprintable() else "\ufffd" for c in shown)


def read_source(
    source: bytes | str | Path,
    *,
    what: str,
    needed: str,
    max_bytes: int,
    error: type[OccsimError],
) -> tuple[bytes, str]:
    """Return a file's content and its name, once its size is known to be sensible.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    what : str
        Name for content that comes without a file.
    needed : str
        What the file should be, for the messages.
    max_bytes : int
        Largest size allowed, bytes; a larger file is not read.
    error : type of OccsimError
        What to raise.

    Returns
    -------
    data : bytes
    name : str

    Raises
    ------
    OccsimError
        Of the type given, where the file is missing, empty or too large.
    """
    if isinstance(source, bytes | bytearray | memoryview):
        data, name, size = bytes(source), what, len(source)
    else:
        path = Path(source)
        name = printable(path.name)
        try:
            status = path.stat()
            # A device or a pipe has no size to check, and may have no end.
            if not stat.S_ISREG(status.st_mode):
                raise OSError(errno.EINVAL, "not a regular file")
            size = status.st_size
            data = path.read_bytes() if size <= max_bytes else b""
        except (OSError, ValueError) as cause:  # ValueError: NUL in the path
            reason = getattr(cause, "strerror", None) or "no such file"
            message = f"{name} cannot be opened ({reason}); {needed} is needed"
            raise error(message) from None
    if size > max_bytes:
        raise error(
            f"{name} has {size / 1e6:.1f} MB; at most {max_bytes / 1e6:.0f} MB "
            "are allowed"
        )
    if size == 0:
        raise error(f"{name} is empty (0 bytes); {needed} is needed")
    return data, name

"""The process that reads a bag: a request in, a line of JSON and an NPZ file out.

Started by path and not by name: the packages around it would import OpenCV and the rest
of the library first, and take several times as long.
"""

import contextlib
import json
import os
import sys
from pathlib import Path
from types import ModuleType

FOLDER = Path(__file__).resolve().parent


def _leave_packages_out() -> None:
    """Put empty packages in place of those that lead to this folder."""
    folders = FOLDER.parents[1], FOLDER.parent, FOLDER
    names = "occsim", "occsim.io", "occsim.io.bags"
    for name, folder in zip(names, folders, strict=True):
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package


def main() -> None:
    """Read one bag; an unexpected error ends the process."""
    import numpy as np

    from occsim._npz import packed
    from occsim.errors import OccsimError
    from occsim.io.bags.extract import extract
    from occsim.io.bags.limits import ARRAYS

    request = json.loads(sys.stdin.buffer.read())
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDWR), 1)  # no library prints to the pipe
    _limit_memory()
    content = b""
    try:
        reply, arrays = extract(**request)
        content = packed(
            {name: np.asarray(arrays[name], kind) for name, kind in ARRAYS.items()}
        )
    except OccsimError as error:
        reply = {"refused": str(error)}
    replies.write(json.dumps(reply).encode("ascii") + b"\n" + content)
    replies.flush()


def _limit_memory() -> None:
    from occsim.io.bags.limits import MAX_MEMORY_BYTES

    try:
        import resource
    except ImportError:  # Windows
        return
    with contextlib.suppress(ValueError, OSError):  # some systems lack the limit
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY_BYTES, hard))


if __name__ == "__main__":
    _leave_packages_out()
    main()

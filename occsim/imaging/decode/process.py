"""The bounds that a decoder's process sets for itself."""

import contextlib
import math
import os
import sys
import threading
import time
from pathlib import Path

from occsim.imaging.decode.limits import MAX_MEMORY_BYTES, MAX_SECONDS

SPENT_BYTES = 150_000_000
"""A process that has more in memory is replaced, bytes."""

try:
    import resource
except ImportError:  # Windows
    HAS_LIMITS = False
else:
    HAS_LIMITS = True


def limit_process() -> None:
    """Bound the memory of this process, and let others go first.

    On Linux the system enforces the bound. On macOS, which does not, the process
    watches itself ten times a second. Windows has neither: there only the size in a
    file's header and the time that decoding takes are bounded.
    """
    if not HAS_LIMITS:
        return
    os.nice(2)
    _lower(resource.RLIMIT_CORE, 0)  # no gigabytes on disk where a decoder breaks
    if sys.platform == "linux":
        _lower(resource.RLIMIT_AS, MAX_MEMORY_BYTES)
    else:
        threading.Thread(target=_watch_memory, daemon=True).start()


def limit_time() -> None:
    """Let the system end this process where the next file takes too long."""
    if HAS_LIMITS:
        used = resource.getrusage(resource.RUSAGE_SELF)
        spent_s = used.ru_utime + used.ru_stime
        _lower(resource.RLIMIT_CPU, math.ceil(spent_s) + MAX_SECONDS)


def is_spent() -> bool:
    """Return whether this process took so much memory that a new one should follow.

    What PDFium and glibc took for a large file, they keep.
    """
    return HAS_LIMITS and _memory_bytes() > SPENT_BYTES


def _memory_bytes() -> int:
    """Return what this process has in memory, or on macOS ever had."""
    if sys.platform == "linux":
        # The peak that Linux tells is that of the process which started this one.
        pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
        return int(pages) * resource.getpagesize()
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def _lower(kind: int, value: int) -> None:
    _, hard = resource.getrlimit(kind)
    with contextlib.suppress(ValueError, OSError):  # not every system knows each limit
        resource.setrlimit(kind, (value, hard))


def _watch_memory() -> None:
    while _memory_bytes() < MAX_MEMORY_BYTES:
        time.sleep(0.1)
    os._exit(1)

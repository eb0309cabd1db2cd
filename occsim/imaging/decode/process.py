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
    """Limit the memory of this process and lower its priority.

    On Linux the system enforces the bound. On macOS, which does not, the process
    watches itself ten times a second. Windows has neither: there only the size in a
    file's header and the time that decoding takes are bounded.
    """
    if not HAS_LIMITS:
        return
    os.nice(2)
    _lower(resource.RLIMIT_CORE, 0)  # no core dump of gigabytes
    if sys.platform == "linux":
        _lower(resource.RLIMIT_AS, MAX_MEMORY_BYTES)
    else:
        threading.Thread(target=_watch_memory, daemon=True).start()


def limit_time() -> None:
    """Let the system end this process if the next file takes too long."""
    if HAS_LIMITS:
        used = resource.getrusage(resource.RUSAGE_SELF)
        spent_s = used.ru_utime + used.ru_stime
        _lower(resource.RLIMIT_CPU, math.ceil(spent_s) + MAX_SECONDS)


def is_spent() -> bool:
    """Return whether this process holds so much memory that it should be replaced.

    PDFium and glibc keep what they allocated for a large file.
    """
    return HAS_LIMITS and _memory_bytes() > SPENT_BYTES


def _memory_bytes() -> int:
    """Return the memory in use by this process; on macOS, its peak."""
    if sys.platform == "linux":
        # On Linux the peak is inherited from the process that started this one.
        pages = Path("/proc/self/statm").read_text(encoding="ascii").split()[1]
        return int(pages) * resource.getpagesize()
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def _lower(kind: int, value: int) -> None:
    _, hard = resource.getrlimit(kind)
    with contextlib.suppress(ValueError, OSError):  # some systems lack some limits
        resource.setrlimit(kind, (value, hard))


def _watch_memory() -> None:
    while _memory_bytes() < MAX_MEMORY_BYTES:
        time.sleep(0.1)
    os._exit(1)

"""Return freed memory to the system, which the C library does not do by itself.

By default glibc gives every thread an arena of its own and keeps what is freed in it.
Streamlit runs each script in a thread: thirty students leave hundreds of megabytes of
unused pieces in sixteen arenas, and more with every round.
"""

import ctypes
import time
from typing import Any

M_ARENA_MAX = -8  # from glibc's malloc.h
MAX_ARENAS = 2
TRIM_EVERY_S = 5.0
"""Shortest time between two trims: a page returned must be fetched again."""


def _c_library() -> Any:
    try:
        library = ctypes.CDLL(None)
    except (TypeError, OSError):  # Windows
        return None
    return library if hasattr(library, "malloc_trim") else None


_LIBRARY = _c_library()
_last_trim_s = 0.0


def use_few_arenas() -> None:
    """Let threads share arenas; call it before there are many threads."""
    if _LIBRARY is not None:
        _LIBRARY.mallopt(M_ARENA_MAX, MAX_ARENAS)


def return_freed() -> None:
    """Return unused pages, if that was not done a moment ago; does nothing but with
    glibc."""
    global _last_trim_s
    now = time.monotonic()
    if _LIBRARY is None or now - _last_trim_s < TRIM_EVERY_S:
        return
    _last_trim_s = now
    _LIBRARY.malloc_trim(0)

"""Buildings of the students' own, kept on the server so that a reload finds them.

A link cannot hold a drawing. What is kept here is found by a key that nobody can
guess, for as long as the server runs, within bounds of bytes and of age; who opens a
link with the key sees the building and goes on with a copy of it.
"""

import dataclasses
import secrets
import threading

from cachetools import TTLCache

from occsim.building import Building
from pages._ui.shared import size_of

MAX_BYTES = 600_000_000
"""All buildings together; the one that was kept longest ago goes first."""
MAX_AGE_S = 24 * 3600
"""How long a building is kept after its last change."""


class Works:
    """The store; safe in threads."""

    def __init__(self, max_bytes: int = MAX_BYTES, max_age_s: float = MAX_AGE_S):
        self._kept: TTLCache[str, Building] = TTLCache(
            max_bytes, max_age_s, getsizeof=lambda building: size_of([building])
        )
        self._lock = threading.Lock()

    def keep(self, building: Building, key: str | None = None) -> str | None:
        """Keep a building, under a new key unless one is given; None if too large."""
        key = key or secrets.token_urlsafe(12)
        with self._lock:
            try:
                self._kept[key] = dataclasses.replace(building)
            except ValueError:  # larger than all that may be kept
                return None
        return key

    def find(self, key: str) -> Building | None:
        """Return what was kept under a key; None where nothing is, or no longer."""
        with self._lock:
            return self._kept.get(key)


WORKS = Works()

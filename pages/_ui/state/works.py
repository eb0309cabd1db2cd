"""Students' own buildings, kept on the server so that a reload finds them.

A link cannot hold a drawing. A building is kept here under an unguessable key, while
the server runs, within limits of size and age. Whoever opens a link with the key sees
the building and edits a copy of it.
"""

import secrets
import threading

from cachetools import TTLCache

from occsim.building import Building
from pages._ui.state.packed import Packed

MAX_BYTES = 100_000_000
"""Limit of all buildings together, packed, bytes; the oldest is dropped first. A plan
of lines takes 0.1 MB, a coloured scan of 1500 px 3 MB."""
MAX_AGE_S = 24 * 3600
"""How long a building is kept after its last change."""


class Works:
    """The store; safe in threads."""

    def __init__(self, max_bytes: int = MAX_BYTES, max_age_s: float = MAX_AGE_S):
        self._kept: TTLCache[str, Packed] = TTLCache(
            max_bytes, max_age_s, getsizeof=lambda packed: len(packed.data)
        )
        self._lock = threading.Lock()

    @property
    def n_bytes(self) -> int:
        """Size of all buildings together, packed, bytes."""
        return int(self._kept.currsize)

    def keep(self, building: Building, key: str | None = None) -> str | None:
        """Keep a building, under a new key unless one is given; None if too large."""
        key = key or secrets.token_urlsafe(12)
        packed = Packed.of(building)
        with self._lock:
            try:
                self._kept[key] = packed
            except ValueError:  # larger than the limit
                return None
        return key

    def find(self, key: str) -> Building | None:
        """Return the building kept under a key; None if there is none."""
        with self._lock:
            packed = self._kept.get(key)
        return packed and packed.opened()


WORKS = Works()

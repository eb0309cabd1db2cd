"""Students' own buildings and logs, kept on the server so that a reload finds them.

A link cannot hold a drawing. A building, and what was made on the page Robot data, is
kept here under an unguessable key, while the server runs, within limits of size and
age. Whoever opens a link with the key sees them and edits a copy.
"""

import secrets
import threading
from dataclasses import dataclass

from cachetools import TTLCache

from occsim.building import Building
from pages._ui.robot_data.work import EMPTY, RobotWork
from pages._ui.shared import size_of
from pages._ui.state.packed import Packed

MAX_BYTES = 100_000_000
"""Limit of all works together, bytes; the oldest is dropped first. The building of a
plan of lines takes 0.1 MB packed, of a coloured scan of 1500 px 3 MB."""
MAX_AGE_S = 24 * 3600
"""How long a work is kept after its last change."""


@dataclass(frozen=True, eq=False)
class Work:
    """A building of a student's own, or none, and what was made of a robot's data."""

    building: Building | None = None
    robot: RobotWork = EMPTY

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing to keep."""
        return self.building is None and self.robot.is_empty

    def is_as(self, other: "Work") -> bool:
        """Whether nothing differs, by identity."""
        return self.building is other.building and self.robot is other.robot


@dataclass(frozen=True, eq=False)
class _Kept:
    building: Packed | None
    robot: RobotWork

    @property
    def n_bytes(self) -> int:
        return size_of([self.building, self.robot])


class Works:
    """The store; safe in threads."""

    def __init__(self, max_bytes: int = MAX_BYTES, max_age_s: float = MAX_AGE_S):
        self._kept: TTLCache[str, _Kept] = TTLCache(
            max_bytes, max_age_s, getsizeof=lambda kept: kept.n_bytes
        )
        self._lock = threading.Lock()

    @property
    def n_bytes(self) -> int:
        """Size of all works together, bytes."""
        return int(self._kept.currsize)

    def keep(self, work: Work, key: str | None = None) -> str | None:
        """Keep a work, under a new key unless one is given; None if too large."""
        key = key or secrets.token_urlsafe(12)
        packed = work.building and Packed.of(work.building)
        kept = _Kept(packed, work.robot.bounded())
        with self._lock:
            try:
                self._kept[key] = kept
            except ValueError:  # larger than the limit
                return None
        return key

    def find(self, key: str) -> Work | None:
        """Return the work kept under a key; None if there is none."""
        with self._lock:
            kept = self._kept.get(key)
        if kept is None:
            return None
        return Work(kept.building and kept.building.opened(), kept.robot)


WORKS = Works()

"""Buildings packed small: those of the history and those kept for a reload."""

import pickle
import zlib
from dataclasses import dataclass, replace

from occsim.building import Building


@dataclass(frozen=True, eq=False, slots=True)
class Packed:
    """A building in compressed form; a drawing of lines shrinks to a hundredth."""

    data: bytes

    @classmethod
    def of(cls, building: Building) -> "Packed":
        """Pack a building without what was computed from it."""
        drawing = replace(building.drawing)
        return cls(zlib.compress(pickle.dumps(replace(building, drawing=drawing)), 1))

    def opened(self) -> Building:
        """Return the building, equal in all its parts."""
        building: Building = pickle.loads(zlib.decompress(self.data))
        return building

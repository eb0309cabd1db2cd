"""Frames of a robot, and the way from one to another."""

from array import array
from typing import Self

import numpy as np

from occsim._files import printable
from occsim._types import BoolArray, FloatArray
from occsim.errors import RobotFileError
from occsim.io.bags.limits import MAX_FRAMES, MAX_TRANSFORMS
from occsim.io.rigid import covered, poses_at


class Edge:
    """Where a frame lies in its parent, by time."""

    def __init__(self, parent: str, child: str, *, is_fixed: bool) -> None:
        self.parent, self.child, self.is_fixed = parent, child, is_fixed
        self.has_another = False
        """Whether rows of another parent were given, too."""
        self._rows = array("d")

    def add(self, row: tuple[float, ...]) -> None:
        """Add t, x, y, z, qx, qy, qz, qw."""
        self._rows.extend(row)

    @property
    def samples(self) -> FloatArray:
        """All rows; of a fixed frame the last."""
        rows = np.array(self._rows).reshape(-1, 8)
        return rows[-1:] if self.is_fixed else rows

    @property
    def moves(self) -> bool:
        """Whether it is not the same at all times."""
        return bool(np.ptp(self.samples[:, 1:], axis=0).any())

    def covers(self, times_s: FloatArray) -> BoolArray:
        """Return at which times it is known."""
        return covered(times_s, self.samples)

    def at(self, times_s: FloatArray) -> FloatArray:
        """Return it at some times, as in `poses_at`."""
        return poses_at(times_s, self.samples)


class Edges:
    """Frames by their names, each in one parent."""

    def __init__(self) -> None:
        self._by_child, self._count = dict[str, Edge](), 0

    def __len__(self) -> int:
        return self._count

    def add(
        self, parent: str, child: str, row: tuple[float, ...], is_fixed: bool
    ) -> None:
        """Add where a frame lies in its parent at a time.

        Raises
        ------
        RobotFileError
            Where there are too many.
        """
        parent, child = parent.strip("/"), child.strip("/")
        self._count += 1
        edge = self._by_child.get(child)
        if edge is None:
            edge = self._by_child[child] = Edge(parent, child, is_fixed=is_fixed)
        if self._count > MAX_TRANSFORMS or len(self._by_child) > MAX_FRAMES:
            raise RobotFileError(
                f"a bag may have {MAX_TRANSFORMS:,} transforms of {MAX_FRAMES:,} "
                "frames; it has more"
            )
        edge.has_another |= edge.parent != parent
        edge.add(row)

    def all(self) -> list[Edge]:
        """Return them in the order in which they came first."""
        return list(self._by_child.values())

    def of(self, child: str) -> Edge | None:
        """Return where a frame lies, if it is known."""
        return self._by_child.get(child)

    def fixed(self) -> Self:
        """Return those that never change."""
        kept = type(self)()
        kept._by_child = {
            child: edge for child, edge in self._by_child.items() if not edge.moves
        }
        return kept


def led_to(frame: str, edges: Edges, start: str | None = None) -> list[Edge]:
    """Return the way to a frame, from the uppermost one or from a given one.

    Parameters
    ----------
    frame : str
        Where it ends.
    edges : Edges
        All that is known.
    start : str, optional
        Where it begins; by default the frame that has no parent.

    Returns
    -------
    list of Edge
        Empty where there is no way; then a range finder is taken to sit in the middle
        of the robot.

    Raises
    ------
    RobotFileError
        Where a frame on it has two parents, or is its own.
    """
    way, seen = list[Edge](), set[str]()
    while frame != start and (edge := edges.of(frame)) is not None:
        if frame in seen or edge.has_another:
            raise RobotFileError(
                f"the frame {printable(frame)} must have one parent, and not be its "
                "own; the bag gives it more"
            )
        seen.add(frame)
        way.append(edge)
        frame = edge.parent
    return way[::-1] if start is None or frame == start else []

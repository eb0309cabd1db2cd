"""Free space as a lattice of nodes, linked where a straight step is free."""

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray

# Right, down, and the two diagonals downwards; the other four are their reverses.
_STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))


@dataclass(frozen=True, eq=False, kw_only=True)
class Lattice:
    """Nodes every few pixels, and the links between them.

    Parameters
    ----------
    row, col : ndarray of int64, shape (N,)
        Pixel of each node.
    graph : scipy.sparse.csr_array, shape (N, N)
        Cost of each link; symmetric.
    """

    row: IntArray
    col: IntArray
    graph: Any

    def __len__(self) -> int:
        return len(self.row)

    def take(self, kept: BoolArray) -> "Lattice":
        """Return some of the nodes and the links between them."""
        graph = self.graph[kept][:, kept]
        return Lattice(row=self.row[kept], col=self.col[kept], graph=graph)

    def parts(self) -> IntArray:
        """Return the number of the connected part of each node, shape (N,)."""
        from scipy.sparse.csgraph import connected_components  # slow to import

        return np.asarray(connected_components(self.graph, directed=False)[1])

    def points_px(self, nodes: IntArray) -> FloatArray:
        """Return the centres x, y of the nodes' pixels, shape (K, 2), px."""
        corner = np.stack([self.col[nodes], self.row[nodes]], axis=1)
        return corner.astype(np.float64) + 0.5


def build_lattice(free: BoolArray, step_px: int, cost: FloatArray) -> Lattice:
    """Return the lattice over some free space.

    Parameters
    ----------
    free : ndarray of bool, shape (H, W)
        Where a robot may stand.
    step_px : int
        Between neighbouring nodes, px, 1 or more.
    cost : ndarray of float64, shape (H, W)
        Of one pixel of way, above 0.

    Returns
    -------
    Lattice
        Two neighbours, diagonals included, are linked where every pixel of the
        straight step between them is free.
    """
    from scipy.sparse import coo_array  # here, because it takes long to import

    first = step_px // 2
    sampled = free[first::step_px, first::step_px]
    node = np.where(sampled, np.cumsum(sampled).reshape(sampled.shape) - 1, -1)
    row, col = (np.argwhere(sampled) * step_px + first).T
    pairs, lengths = [], []
    for step in _STEPS:
        pairs.append(_linked(free.astype(np.uint8), node, step, step_px))
        lengths.append(np.full(pairs[-1].shape[1], step_px * np.hypot(*step)))
    start, end = np.concatenate(pairs, axis=1)
    weight = np.concatenate(lengths)
    weight *= 0.5 * (cost[row[start], col[start]] + cost[row[end], col[end]])
    both_ways = np.concatenate([start, end]), np.concatenate([end, start])
    graph = coo_array((np.tile(weight, 2), both_ways), (len(row),) * 2).tocsr()
    return Lattice(row=row, col=col, graph=graph)


def _linked(
    image: np.ndarray[Any, Any], node: IntArray, step: tuple[int, int], step_px: int
) -> IntArray:
    """Return the pairs of nodes, (2, L), one step apart with nothing between them."""
    down, right = step
    length = step_px + 1
    kernel = np.ones((length if down else 1, length if right else 1), np.uint8)
    if down and right:
        # With the pixels beside it: a diagonal line of wall pixels is closed.
        offset = np.abs(np.subtract.outer(np.arange(length), np.arange(length)))
        kernel = (offset <= 1).astype(np.uint8)[:, ::right].copy()
    # The anchor is the end that the step starts from.
    anchor = (0 if right >= 0 else step_px, 0)
    clear = cv2.erode(image, kernel, anchor=anchor, borderValue=0) > 0
    first = step_px // 2
    row, col = np.nonzero(clear[first::step_px, first::step_px] & (node >= 0))
    framed = np.pad(node, ((0, 1), (1, 1)), constant_values=-1)
    pairs = np.stack([node[row, col], framed[row + down, col + right + 1]])
    return pairs[:, pairs[1] >= 0]

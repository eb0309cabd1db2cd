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
    free : ndarray of bool, shape (H, W)
        Where a robot may stand.
    step_px : int
        Between neighbouring nodes, px.
    node : ndarray of int64, shape (R, C)
        Number of the node at each place of the lattice; -1 where there is none.
    rows, cols : ndarray of int64, shape (N,)
        Pixel of each node.
    graph : scipy.sparse.csr_array, shape (N, N)
        Length of each link, px; symmetric.
    """

    free: BoolArray
    step_px: int
    node: IntArray
    rows: IntArray
    cols: IntArray
    graph: Any

    def __len__(self) -> int:
        return len(self.rows)

    def at(self, image: BoolArray) -> BoolArray:
        """Return an image's values at the nodes, shape (N,)."""
        return np.asarray(image[self.rows, self.cols])

    def points_px(self, nodes: IntArray) -> FloatArray:
        """Return the centres x, y of the nodes' pixels, shape (K, 2), px."""
        corner = np.stack([self.cols[nodes], self.rows[nodes]], axis=1)
        return corner.astype(np.float64) + 0.5


def build_lattice(free: BoolArray, step_px: int) -> Lattice:
    """Return the lattice over some free space.

    Parameters
    ----------
    free : ndarray of bool, shape (H, W)
        Where a robot may stand.
    step_px : int
        Between neighbouring nodes, px, 1 or more.

    Returns
    -------
    Lattice
        Two neighbours, diagonals included, are linked where every pixel of the
        straight step between them is free.
    """
    from scipy.sparse import coo_array  # here, because it takes long to import

    first = step_px // 2
    image = free.astype(np.uint8)
    sampled = free[first::step_px, first::step_px]
    node = np.where(sampled, np.cumsum(sampled).reshape(sampled.shape) - 1, -1)
    places = np.argwhere(sampled)
    starts, ends, lengths = [], [], []
    for step in _STEPS:
        start, end = _linked(image, node, step, step_px)
        starts += [start, end]
        ends += [end, start]
        lengths.append(np.full(2 * len(start), step_px * np.hypot(*step)))
    links = (np.concatenate(starts), np.concatenate(ends))
    graph = coo_array((np.concatenate(lengths), links), (len(places),) * 2).tocsr()
    rows, cols = (places * step_px + first).T
    return Lattice(
        free=free, step_px=step_px, node=node, rows=rows, cols=cols, graph=graph
    )


def _linked(
    image: np.ndarray[Any, Any], node: IntArray, step: tuple[int, int], step_px: int
) -> tuple[IntArray, IntArray]:
    """Return the pairs of nodes, one step apart, with nothing between them."""
    down, right = step
    length = step_px + 1
    kernel = np.ones((length if down else 1, length if right else 1), np.uint8)
    if down and right:
        kernel = np.eye(length, dtype=np.uint8)[:, ::right].copy()
    # The anchor is the end that the step starts from.
    anchor = (0 if right >= 0 else step_px, 0)
    clear = cv2.erode(image, kernel, anchor=anchor, borderValue=0) > 0
    first = step_px // 2
    starts = clear[first::step_px, first::step_px] & (node >= 0)
    rows, cols = np.nonzero(starts)
    n_rows, n_cols = node.shape
    other_rows, other_cols = rows + down, cols + right
    exists = (other_rows < n_rows) & (other_cols >= 0) & (other_cols < n_cols)
    rows, cols = rows[exists], cols[exists]
    start, end = node[rows, cols], node[other_rows[exists], other_cols[exists]]
    both = end >= 0
    return start[both], end[both]


def spread(lattice: Lattice, wanted: BoolArray, spacing_px: float) -> IntArray:
    """Return positions that leave no wanted node far from one.

    First the wanted nodes of a coarser square lattice; then, wherever wanted nodes
    are farther than the spacing from them all, along free space, the middle of those.

    Parameters
    ----------
    lattice : Lattice
        N nodes.
    wanted : ndarray of bool, shape (N,)
        Nodes to spread over.
    spacing_px : float
        Between positions, px.

    Returns
    -------
    ndarray of int64, shape (K,)
        Nodes; empty where none is wanted.
    """
    every = max(1, round(spacing_px / lattice.step_px))
    floor = (lattice.node >= 0).astype(np.uint8)
    open_to = np.zeros_like(floor)
    places = np.nonzero(lattice.node >= 0)
    open_to[places] = wanted
    chosen = np.zeros_like(floor)
    chosen[every // 2 :: every, every // 2 :: every] = 1
    chosen &= open_to
    left = open_to & ~_within(chosen, floor, every)
    while left.any():
        # The node deepest within what is left, so that one position serves most.
        depth = cv2.distanceTransform(np.pad(left, 1), cv2.DIST_L1, 3)[1:-1, 1:-1]
        row, col = divmod(int(np.argmax(depth)), depth.shape[1])
        chosen[row, col] = 1
        top, first = max(row - every, 0), max(col - every, 0)
        near = np.s_[top : row + every + 1, first : col + every + 1]
        here = np.zeros_like(floor[near])
        here[row - top, col - first] = 1
        left[near] &= ~_within(here, floor[near], every)
    return np.asarray(lattice.node[chosen > 0])


def _within(
    seeds: np.ndarray[Any, Any], floor: np.ndarray[Any, Any], steps: int
) -> np.ndarray[Any, Any]:
    """Return, as 0 and 1, what is reached from the seeds in so many steps.

    Steps aside and diagonal steps take turns, so that the reach is an octagon.
    """
    shapes = [
        cv2.getStructuringElement(shape, (3, 3))
        for shape in (cv2.MORPH_CROSS, cv2.MORPH_RECT)
    ]
    reached = seeds
    for step in range(steps):
        before, reached = reached, cv2.dilate(reached, shapes[step % 2]) & floor
        if step % 2 and np.array_equal(before, reached):
            break
    return reached

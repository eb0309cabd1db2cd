"""One walk through many positions: their order, and the way between them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.tour.lattice import Lattice

# Improving the order of more positions than this takes longer than it is worth.
_MAX_IMPROVED = 250
_IMPROVEMENTS = 300


@dataclass(frozen=True, eq=False, kw_only=True)
class _Links:
    """Which positions neighbour each other along free space.

    Each node belongs to its nearest position; two positions are neighbours where
    nodes of theirs are linked. All shortest ways follow from those between
    neighbours, which takes one search over the nodes instead of one a position.
    """

    toward: IntArray  # (N,) next node on the way to the node's own position
    distance_px: FloatArray  # (K, K) along free space; inf where there is no way
    via: IntArray  # (K, K) last position before the second on the way from the first
    gate: dict[tuple[int, int], tuple[int, int]]  # neighbours: nodes where they meet


def shortest_walk(lattice: Lattice, positions: IntArray) -> list[IntArray]:
    """Return a short walk through all positions.

    Parameters
    ----------
    lattice : Lattice
        Free space.
    positions : ndarray of int64, shape (K,)
        Nodes in one connected part of it, K at least 1.

    Returns
    -------
    list of ndarray of int64
        K legs. Each is the nodes from one position (left out) to the next
        (its last); the first leg is the first position alone.

    Notes
    -----
    Nearest neighbour first, then 2-opt; not the shortest walk there is.
    """
    if len(positions) == 1:
        return [positions]
    links = _link(lattice, positions)
    order = _improved(links.distance_px, _nearest_first(links.distance_px))
    legs = [positions[order[:1]]]
    for start, end in zip(order[:-1], order[1:], strict=True):
        legs.append(_way(links, positions, start, end))
    return legs


def _link(lattice: Lattice, positions: IntArray) -> _Links:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    far_px, toward, source = dijkstra(
        lattice.graph, indices=positions, min_only=True, return_predecessors=True
    )
    number = np.full(len(lattice), -1)
    number[positions] = np.arange(len(positions))
    # Parts of free space without a position stay without an owner.
    owner = np.where(source >= 0, number[np.maximum(source, 0)], -1)
    pairs = lattice.graph.tocoo()
    border = owner[pairs.row] != owner[pairs.col]
    start, end, step = pairs.row[border], pairs.col[border], pairs.data[border]
    length = far_px[start] + step + far_px[end]
    # Of the places where two positions' nodes meet, the one on the shortest way.
    by_length = np.lexsort((end, start, length))
    key = owner[start] * len(positions) + owner[end]
    _, first = np.unique(key[by_length], return_index=True)
    best = by_length[first]
    ends = owner[start[best]], owner[end[best]]
    graph = coo_array((length[best], ends), (len(positions),) * 2).tocsr()
    distance, via = dijkstra(graph, return_predecessors=True)
    meet = zip(start[best].tolist(), end[best].tolist(), strict=True)
    gate = dict(zip(zip(*map(np.ndarray.tolist, ends), strict=True), meet, strict=True))
    return _Links(toward=toward, distance_px=distance, via=via, gate=gate)


def _way(links: _Links, positions: IntArray, start: int, end: int) -> IntArray:
    """Return the nodes from one position (left out) to another, by the shortest way."""
    stops = [end]
    while stops[-1] != start:
        stops.append(int(links.via[start, stops[-1]]))
    nodes: list[int] = []
    for here, there in zip(stops[::-1][:-1], stops[::-1][1:], strict=True):
        leave, enter = links.gate[here, there]
        nodes += _home(links, leave)[::-1][1:] + _home(links, enter)
    return np.array(nodes, dtype=np.int64)


def _home(links: _Links, node: int) -> list[int]:
    """Return the nodes from this one to the position that it belongs to."""
    way = [node]
    while (following := int(links.toward[way[-1]])) >= 0:
        way.append(following)
    return way


def _nearest_first(distance: FloatArray) -> list[int]:
    """Order by nearest neighbour, from one end of the two that are farthest apart."""
    start = int(np.argmax(np.where(np.isfinite(distance), distance, -1.0).max(axis=1)))
    order = [start]
    left = np.ones(len(distance), bool)
    left[start] = False
    while left.any():
        order.append(int(np.argmin(np.where(left, distance[order[-1]], np.inf))))
        if not left[order[-1]]:  # no way to what is left
            raise AssertionError("positions must be connected")
        left[order[-1]] = False
    return order


def _improved(distance: FloatArray, order: list[int]) -> list[int]:
    """Reverse stretches of the walk, the most rewarding first, while any rewards."""
    if not 3 < len(order) <= _MAX_IMPROVED:
        return order
    walk = np.array(order)
    later = np.triu(np.ones((len(walk) - 1, len(walk)), bool), 1)
    for _ in range(_IMPROVEMENTS):
        between = distance[np.ix_(walk, walk)]
        # Reversing walk[i+1..j] replaces the links i to i+1 and j to j+1 by i to j and
        # i+1 to j+1; after the last position there is no link.
        link = np.append(np.diagonal(between, 1), 0.0)
        joined = np.pad(between[1:, 1:], ((0, 0), (0, 1)))
        gain = link[:-1, None] + link[None, :] - between[:-1] - joined
        gain = np.where(later, gain, 0.0)
        i, j = np.unravel_index(int(np.argmax(gain)), gain.shape)
        if gain[i, j] <= 1e-6:
            break
        walk[i + 1 : j + 1] = walk[i + 1 : j + 1][::-1].copy()
    return [int(position) for position in walk]


def corners(free: BoolArray, points_px: FloatArray) -> IntArray:
    """Return which points of a way to keep, so that straight lines between are free.

    Parameters
    ----------
    free : ndarray of bool, shape (H, W)
        Where a robot may stand.
    points_px : ndarray of float64, shape (L, 2)
        x, y; each step is free. L at least 1.

    Returns
    -------
    ndarray of int64
        Indices, the first and the last point among them.
    """
    kept = [0]
    last = len(points_px) - 1
    while (here := kept[-1]) < last:
        seen, hidden = here + 1, last
        if straight_is_free(free, points_px[here], points_px[last]):
            seen = last
        # Halving finds the farthest point in sight where sight, once lost, stays
        # lost; elsewhere it finds a nearer one, which does as well.
        while seen != last and hidden - seen > 1:
            middle = (seen + hidden) // 2
            if straight_is_free(free, points_px[here], points_px[middle]):
                seen = middle
            else:
                hidden = middle
        kept.append(seen)
    return np.array(kept, dtype=np.int64)


def straight_is_free(free: BoolArray, start_px: Any, end_px: Any) -> bool:
    """Return whether every pixel on the straight line between two points is free.

    Parameters
    ----------
    free : ndarray of bool, shape (H, W)
        Where a robot may stand.
    start_px, end_px : array_like of shape (2,)
        x, y inside the drawing.

    Returns
    -------
    bool
        Sampled every half pixel.
    """
    start, end = np.asarray(start_px, float), np.asarray(end_px, float)
    count = int(2.0 * np.hypot(*(end - start))) + 2
    points = start + np.linspace(0.0, 1.0, count)[:, None] * (end - start)
    cols, rows = np.floor(points).astype(np.int64).T
    return bool(free[rows, cols].all())

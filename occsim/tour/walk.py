"""One walk through many positions: their order, and the way between them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.tour.lattice import Lattice

# Over all reversals; later passes shorten the walk by less than a hundredth.
_PASSES = 8
_LEAST_GAIN = 1e-6
# Of more positions than these, only the ways to near ones are all known: as near as so
# many steps from neighbour to neighbour.
_ALL_PAIRS = 800
_NEAR_STEPS = 12.0
_FAR = 1e9


@dataclass(frozen=True, eq=False, kw_only=True)
class _Links:
    """Which positions neighbour each other along free space.

    Each node belongs to its nearest position; two positions are neighbours where
    nodes of theirs are linked. All shortest ways follow from those between
    neighbours, which takes one search over the nodes instead of one a position.
    """

    toward: IntArray  # (N,) next node on the way to the node's own position
    graph: Any  # (K, K) cost of the way between neighbours
    gate: dict[tuple[int, int], tuple[int, int]]  # neighbours: nodes where they meet
    cost: FloatArray  # (K, K) of the way from each to each; _FAR where not known
    via: IntArray  # (K, K) last position before the second on the way from the first

    def ways_from(self, start: int) -> tuple[FloatArray, IntArray]:
        """Return that position's costs and last positions, (K,), near or far."""
        from scipy.sparse.csgraph import dijkstra

        cost, via = dijkstra(self.graph, indices=start, return_predecessors=True)
        return cost, via


def shortest_walk(lattice: Lattice, positions: IntArray) -> list[tuple[int, IntArray]]:
    """Return a short walk through all positions.

    Parameters
    ----------
    lattice : Lattice
        Free space.
    positions : ndarray of int64, shape (K,)
        Different nodes in one connected part of it, K at least 1.

    Returns
    -------
    list of (int, ndarray of int64)
        Of each position in the order of the walk, its index, and the nodes that lead
        to it from the one before, which is left out.

    Notes
    -----
    Nearest neighbour first, then 2-opt; not the shortest walk there is.
    """
    links = _link(lattice, positions)
    order = _improved(links.cost, _nearest_first(links)).tolist()
    legs = [(order[0], positions[order[:1]])]
    for start, end in zip(order[:-1], order[1:], strict=True):
        legs.append((end, _way(links, start, end)))
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
    near = _NEAR_STEPS * np.median(graph.data) if len(positions) > _ALL_PAIRS else _FAR
    cost, via = dijkstra(graph, return_predecessors=True, limit=near)
    cost[np.isinf(cost)] = _FAR
    meet = zip(start[best].tolist(), end[best].tolist(), strict=True)
    gate = dict(zip(zip(*map(np.ndarray.tolist, ends), strict=True), meet, strict=True))
    return _Links(toward=toward, graph=graph, gate=gate, cost=cost, via=via)


def _way(links: _Links, start: int, end: int) -> IntArray:
    """Return the nodes from one position (left out) to another, by the shortest way."""
    is_near = links.cost[start, end] < _FAR
    via = links.via[start] if is_near else links.ways_from(start)[1]
    stops = [end]
    while stops[-1] != start:
        stops.append(int(via[stops[-1]]))
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


def _nearest_first(links: _Links) -> list[int]:
    """Order by nearest neighbour, from an end of the two that are farthest apart."""
    order = [int(np.argmax(links.cost.max(axis=1)))]
    left = np.ones(len(links.cost), bool)
    left[order[0]] = False
    while left.any():
        cost = np.where(left, links.cost[order[-1]], np.inf)
        if cost.min() == _FAR:
            cost = np.where(left, links.ways_from(order[-1])[0], np.inf)
        order.append(int(np.argmin(cost)))
        left[order[-1]] = False
    return order


def _improved(cost: FloatArray, order: list[int]) -> IntArray:
    """Reverse stretches of the walk while any reversal makes it shorter (2-opt)."""
    walk = np.array(order)
    link = cost[walk[:-1], walk[1:]]
    for _ in range(_PASSES):
        before = walk.copy()
        for i in range(len(walk) - 2):
            # Reversing walk[i+1..j] replaces the links i to i+1 and j to j+1 by i to j
            # and i+1 to j+1; after the last position there is no link.
            here, ahead, later = walk[i], walk[i + 1], walk[i + 2 :]
            gain = link[i] - cost[here].take(later)
            gain[:-1] += link[i + 2 :] - cost[ahead].take(later[1:])
            j = int(gain.argmax())
            if gain[j] > _LEAST_GAIN:
                walk[i + 1 : i + 3 + j] = walk[i + 1 : i + 3 + j][::-1].copy()
                part = walk[i : i + 4 + j]
                link[i : i + 3 + j] = cost[part[:-1], part[1:]]
        if np.array_equal(walk, before):
            break
    return walk


def corners(roomy: BoolArray, free: BoolArray, points_px: FloatArray) -> IntArray:
    """Return which points of a way to keep, so that straight steps between are free.

    Parameters
    ----------
    roomy : ndarray of bool, shape (H, W)
        Where steps should stay.
    free : ndarray of bool, shape (H, W)
        Where they may go as long as the way leaves them no choice.
    points_px : ndarray of float64, shape (L, 2)
        x, y; the line from each to the next is free. L at least 1.

    Returns
    -------
    ndarray of int64
        Indices, the first and the last point among them.
    """
    cols, rows = np.floor(points_px).astype(np.int64).T
    tight = ~roomy[rows, cols]
    kept = [0]
    last = len(points_px) - 1
    while (here := kept[-1]) < last:
        seen = _farthest(roomy, points_px, here, last)
        if seen == here + 1:
            # As far as the narrow place goes, and no corner of a room is cut.
            roomy_again = np.flatnonzero(~tight[seen:])
            stop = seen + int(roomy_again[0]) if roomy_again.size else last
            seen = _farthest(free, points_px, here, stop)
        kept.append(seen)
    return np.array(kept, dtype=np.int64)


def _farthest(free: BoolArray, points_px: FloatArray, here: int, last: int) -> int:
    """Return the farthest point, up to the last, that a step leads to; at least one on.

    Halving finds it where sight, once lost, stays lost; elsewhere it finds a nearer
    one, which does as well.
    """
    if straight_is_free(free, points_px[here], points_px[last]):
        return last
    seen, hidden = here + 1, last
    while hidden - seen > 1:
        middle = (seen + hidden) // 2
        if straight_is_free(free, points_px[here], points_px[middle]):
            seen = middle
        else:
            hidden = middle
    return seen


def straight_is_free(free: BoolArray, start_px: Any, end_px: Any) -> bool:
    """Return whether the pixels on the straight line between two points are free.

    Parameters
    ----------
    free : ndarray of bool, shape (H, W)
        Where a robot may go.
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

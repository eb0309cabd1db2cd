"""A tour of a building that covers it: positions on a lattice, the four headings.

Poses are chosen greedily: each time the one that shows most of what has not been seen,
wall surfaces counting more than floor and worth a second and a third look. Then the
positions are ordered into one walk through the doors, short along the free space.
"""

import heapq

import cv2
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components, dijkstra

HEADINGS_DEG = (0, 90, 180, 270)
RAYS = 31  # one a degree over the field of view of 30 degrees
WALL_WORTH = (
    24,
    6,
    2,
)  # of the first, second and third look at a pixel of wall surface
FLOOR_WORTH = (2, 1)  # of the first and second look at a pixel of floor


def lattice(free: np.ndarray, spacing: int, clearance_px: float) -> np.ndarray:
    """Positions (N, 2) int, row and column, at least `clearance_px` from any wall."""
    padded = np.pad(free.astype(np.uint8), 1)  # the picture's edge is as good as a wall
    distance = cv2.distanceTransform(padded, cv2.DIST_L2, 5)[1:-1, 1:-1]
    rows, cols = np.nonzero(distance >= clearance_px)
    kept = (rows % spacing == spacing // 2) & (cols % spacing == spacing // 2)
    return np.stack([rows[kept], cols[kept]], 1)


def walk_graph(nodes: np.ndarray, spacing: int) -> coo_array:
    """Links between lattice neighbours, diagonals included, weighted by length."""
    index = {tuple(node): k for k, node in enumerate(nodes.tolist())}
    links = []
    for (row, col), k in index.items():
        for dr, dc in ((0, 1), (1, 0), (1, 1), (1, -1)):
            other = index.get((row + dr * spacing, col + dc * spacing))
            if other is not None:
                links.append((k, other, spacing * np.hypot(dr, dc)))
    start, end, length = np.array(links).T
    shape = (len(nodes), len(nodes))
    return coo_array((length, (start.astype(int), end.astype(int))), shape).tocsr()


def nearest(nodes: np.ndarray, spot) -> int:
    """Index of the node nearest to `spot`, (x_px, y_px)."""
    return int(np.argmin(np.hypot(*(nodes + 0.5 - np.array(spot)[::-1]).T)))


def reachable(nodes: np.ndarray, spacing: int, start) -> np.ndarray:
    """Nodes that can be walked to from the one nearest to `start`."""
    _, part = connected_components(walk_graph(nodes, spacing), directed=False)
    return nodes[part == part[nearest(nodes, start)]]


def views(wall, nodes, range_px, fov_deg) -> list[np.ndarray]:
    """Flat indices of the pixels seen from each node at each heading, node-major.

    A ray sees floor up to, and including, the first pixel of wall that it meets.
    """
    height, width = wall.shape
    steps = np.arange(1.0, range_px)
    seen = []
    spread = np.linspace(-fov_deg / 2, fov_deg / 2, RAYS)
    for heading in HEADINGS_DEG:
        angles = np.radians(heading + spread)[:, None]
        rows = np.floor(nodes[:, :1, None] + 0.5 + steps * np.sin(angles)).astype(int)
        cols = np.floor(nodes[:, 1:, None] + 0.5 + steps * np.cos(angles)).astype(int)
        inside = (rows >= 0) & (rows < height) & (cols >= 0) & (cols < width)
        flat = np.where(inside, rows * width + cols, 0)
        met = wall.ravel()[flat] | ~inside
        before = np.cumsum(met, axis=2) - met == 0  # no wall nearer than this step
        visible = before & inside
        seen.append([np.unique(f[v]) for f, v in zip(flat, visible, strict=True)])
    return [seen[h][n] for n in range(len(nodes)) for h in range(len(HEADINGS_DEG))]


def choose(views_of: list[np.ndarray], wall: np.ndarray, inside, count: int):
    """Indices of the `count` views picked greedily; lazily, as worth only falls."""
    looks = np.zeros(wall.size, int)
    worth = np.zeros((2, count + 2), int)
    worth[0, : len(FLOOR_WORTH)] = FLOOR_WORTH
    worth[1, : len(WALL_WORTH)] = WALL_WORTH
    kind = wall.ravel().astype(int)
    views_of = [view[inside.ravel()[view]] for view in views_of]

    def gain(k: int) -> int:
        view = views_of[k]
        return int(worth[kind[view], looks[view]].sum())

    queue = [(-gain(k), k) for k in range(len(views_of))]
    heapq.heapify(queue)
    chosen: list[int] = []
    while len(chosen) < count and queue:
        _, k = heapq.heappop(queue)
        now = gain(k)
        if queue and now < -queue[0][0]:
            heapq.heappush(queue, (-now, k))
            continue
        chosen.append(k)
        looks[views_of[k]] += 1
    return chosen


def short_walk(distance: np.ndarray, start: int) -> list[int]:
    """Order of all places from `start`: nearest neighbour, then 2-opt to its rest."""
    left = set(range(len(distance))) - {start}
    order = [start]
    while left:
        order.append(min(left, key=lambda k: (distance[order[-1], k], k)))
        left.remove(order[-1])
    while (better := _two_opt_move(distance, order)) is not None:
        order = better
    return order


def _two_opt_move(distance: np.ndarray, order: list[int]) -> list[int] | None:
    """Reverse the stretch that shortens the open walk most; None if none does."""
    at = np.array(order)
    link = distance[at[:-1], at[1:]]
    # Reversing at[i+1..j] replaces links (i, i+1) and (j, j+1); the last has no link.
    after = np.append(link, 0.0)
    joined = np.zeros((len(at), len(at)))
    joined[:, :-1] = distance[at[1:, None], at[None, 1:]][
        np.minimum(np.arange(len(at)), len(at) - 2)
    ]
    change = distance[at[:, None], at[None, :]] + joined
    change -= after[:, None] + after[None, :]
    valid = np.triu(np.ones_like(change, bool), 2)
    valid[-1] = False
    change = np.where(valid, change, 0.0)
    i, j = np.unravel_index(np.argmin(change), change.shape)
    if change[i, j] > -1e-6:
        return None
    return order[: i + 1] + order[i + 1 : j + 1][::-1] + order[j + 1 :]


def in_sight(clear: np.ndarray, start, end) -> bool:
    """Whether the straight way between two nodes stays on `clear` floor."""
    n = 2 * int(np.abs(np.subtract(end, start)).max()) + 1  # half a pixel a step
    rows, cols = np.floor(np.linspace(start, end, n) + 0.5).astype(int).T
    return bool(clear[rows, cols].all())


def stops_between(clear, nodes, before: np.ndarray, start: int, end: int) -> list[int]:
    """Nodes to pass from start to end so that each is in sight of the one before.

    before : (N,) int, each node's predecessor on its shortest way from start.
    """
    way = [end]
    while way[-1] != start:
        way.append(int(before[way[-1]]))
    way.reverse()
    stops, here = [], 0
    while not in_sight(clear, nodes[way[here]], nodes[end]):
        ahead = range(here + 1, len(way))
        seen = [k for k in ahead if in_sight(clear, nodes[way[here]], nodes[way[k]])]
        here = max(seen, default=here + 1)
        stops.append(way[here])
    return stops


def facing_along(start, end) -> int:
    """Which of the four headings is nearest to the direction from start to end."""
    rows, cols = np.subtract(end, start)
    if abs(cols) >= abs(rows):
        return 0 if cols > 0 else 2
    return 1 if rows > 0 else 3


def with_headings(stops, nodes, headings: dict[int, list[int]]) -> np.ndarray:
    """Poses (S, 3), x_px, y_px, theta_deg; at each stop turn on by the nearer way.

    A stop that is only passed, (node, True), is passed facing the next one.
    """
    poses, facing = [], 0
    for k, (place, passed) in enumerate(stops):
        row, col = nodes[place]
        if passed:
            wanted = {facing_along(nodes[place], nodes[stops[k + 1][0]])}
        else:
            wanted = set(headings[place])
        while wanted:
            facing = min(wanted, key=lambda h: (min((h - facing) % 4, 3), h))
            wanted.remove(facing)
            poses.append((col + 0.5, row + 0.5, HEADINGS_DEG[facing]))
    return np.array(poses)


def plan_tour(wall, *, floor, start, range_px, fov_deg, spacing, clearance_px, count):
    """Poses (S, 3) of a walk that shows walls and `floor`: `count` chosen for what
    they show and, between rooms, a few more in the doorways.

    wall, floor : (H, W) bool; start : position (x_px, y_px) near which it begins.
    """
    nodes = reachable(lattice(~wall & floor, spacing, clearance_px), spacing, start)
    seen = views(wall, nodes, range_px, fov_deg)
    headings: dict[int, list[int]] = {}
    for k in choose(seen, wall, floor | wall, count):
        headings.setdefault(k // 4, []).append(k % 4)
    places = sorted(headings)
    distance, before = dijkstra(
        walk_graph(nodes, spacing),
        directed=False,
        indices=places,
        return_predecessors=True,
    )
    clear = cv2.erode((~wall).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    order = short_walk(distance[:, places], nearest(nodes[places], start))
    stops = [(places[order[0]], False)]
    for here, there in zip(order[:-1], order[1:], strict=True):
        between = stops_between(clear, nodes, before[here], places[here], places[there])
        stops += [(k, True) for k in between] + [(places[there], False)]
    return with_headings(stops, nodes, headings)

"""Deliberately naive versions of the library's kernels, as nested loops.

They follow the definitions word for word, share only the parameters with the library,
and run only on small worlds.
"""

import math

from occsim.sensor import BehindHit

EPS = 1e-9  # the tolerance that the library states for every edge of the view
OWN_PIXEL_EPS_PX = 5e-7
SURFACE_DEPTH_PX = 1.5


def slab(origin, direction, low, high):
    """Distances at which a ray enters and leaves low <= coordinate <= high."""
    if direction == 0.0:
        inside = low <= origin <= high
        return (-math.inf, math.inf) if inside else (math.inf, -math.inf)
    near, far = (low - origin) / direction, (high - origin) / direction
    return min(near, far), max(near, far)


def entry(x, y, ux, uy, row, col, margin):
    """Where the ray from (x, y) enters pixel (row, col) grown by a margin, else None.

    A robot that touches the pixel from outside is not in it unless the ray leads into
    it: the ray must leave the square at a positive distance.
    """
    in_x, out_x = slab(x, ux, col - margin, col + 1 + margin)
    in_y, out_y = slab(y, uy, row - margin, row + 1 + margin)
    enters, leaves = max(in_x, in_y), min(out_x, out_y)
    if enters > leaves or leaves < 1e-6:
        return None
    return max(enters, 0.0)


def first_hit(occupied, x, y, ux, uy):
    """Distance z at which the ray first meets a wall pixel; infinite for none."""
    nearest = math.inf
    for row, line in enumerate(occupied):
        for col, is_wall in enumerate(line):
            if not is_wall:
                continue
            # Touching counts; the margin only decides *whether* a corner is touched.
            touched = entry(x, y, ux, uy, row, col, EPS)
            if touched is not None:
                exact = entry(x, y, ux, uy, row, col, 0.0)
                nearest = min(nearest, touched if exact is None else exact)
    return nearest


def in_view(dx, dy, theta, sensor):
    """Whether a pixel centre at (dx, dy) from the robot is in the field of view."""
    if math.hypot(dx, dy) > sensor.range_px + EPS:
        return False
    off = (math.atan2(dy, dx) - theta + math.pi) % (2 * math.pi) - math.pi
    return abs(off) <= sensor.fov_rad / 2 + EPS


def classify(occupied, pose, row, col, sensor):
    """The class of one pixel in one reading: "empty", "object" or None."""
    x, y, theta = pose
    dx, dy = col + 0.5 - x, row + 0.5 - y
    distance = math.hypot(dx, dy)
    if distance <= OWN_PIXEL_EPS_PX:
        return "object" if occupied[row][col] else "empty"
    if not in_view(dx, dy, theta, sensor):
        return None
    z = first_hit(occupied, x, y, dx / distance, dy / distance)
    if z > sensor.range_px + EPS:
        return "empty" if sensor.clear_no_hit else None
    if distance < z:
        return "empty"
    if sensor.behind_hit is BehindHit.OCCUPIED:
        return "object"
    on_surface = occupied[row][col] and distance - z <= SURFACE_DEPTH_PX + EPS
    return "object" if on_surface else None


def naive_reading(occupied, pose, sensor, cell_px):
    """{flat cell: (n_empty, n_object)} of one reading, cells ascending."""
    n_cols = -(-len(occupied[0]) // cell_px)
    counts = {}
    for row in range(len(occupied)):
        for col in range(len(occupied[0])):
            kind = classify(occupied, pose, row, col, sensor)
            if kind is not None:
                cell = (row // cell_px) * n_cols + col // cell_px
                empty, objects = counts.get(cell, (0, 0))
                is_empty = kind == "empty"
                counts[cell] = (empty + is_empty, objects + (not is_empty))
    return dict(sorted(counts.items()))


def naive_log_odds(n_empty, n_object):
    """Eq. 4.22 for one cell and reading, with the empty share clipped."""
    q = n_empty / (n_empty + n_object)
    p_free = min(max(q, 0.1), 0.9)
    return math.log(p_free / (1 - p_free))


def naive_evidence(world, trajectory, sensor, cell_px):
    """Per reading a list of (flat cell, log-odds), cells ascending."""
    occupied = world.occupied.tolist()
    return [
        [
            (cell, naive_log_odds(*counts))
            for cell, counts in naive_reading(occupied, pose, sensor, cell_px).items()
        ]
        for pose in trajectory.poses.tolist()
    ]


def naive_sectors(bearings, fov_rad):
    """[(begin, end, beam)] by ascending bearing, unwrapped; ends half-way to others."""
    beams = sorted(range(len(bearings)), key=lambda beam: bearings[beam])
    ordered = [bearings[beam] for beam in beams]
    middles = [(a + b) / 2 for a, b in zip(ordered, ordered[1:], strict=False)]
    if middles:
        before, after = middles[0] - ordered[0], ordered[-1] - middles[-1]
    else:
        before = after = fov_rad / 2
    begin, end = ordered[0] - before, ordered[-1] + after
    # Beams all round have no edge: the first and the last are neighbours too.
    if ordered[0] + 2 * math.pi - ordered[-1] <= 1.01 * (before + after):
        begin = (ordered[-1] - 2 * math.pi + ordered[0]) / 2
        end = begin + 2 * math.pi
        edges = [begin - EPS, *(m - EPS for m in middles), end - EPS]
    else:
        edges = [begin - EPS, *(m - EPS for m in middles), end + EPS]
    return list(zip(edges, edges[1:], beams, strict=False))


def classify_in_scan(pose, row, col, sectors, ranges, max_range_px, sensor):
    """The class of one pixel in one scan: "empty", "object" or None."""
    x, y, theta = pose
    dx, dy = col + 0.5 - x, row + 0.5 - y
    distance = math.hypot(dx, dy)
    valid = [z for z in ranges if not math.isnan(z)]
    if distance <= OWN_PIXEL_EPS_PX:
        if not valid:
            return None
        return "object" if max(valid) <= OWN_PIXEL_EPS_PX else "empty"
    reach = min(sensor.range_px, max_range_px)
    if distance > reach + EPS:
        return None
    bearing = math.atan2(dy, dx) - theta
    for begin, end, beam in sectors:
        if (bearing - begin) % (2 * math.pi) < end - begin:
            z = ranges[beam]
            break
    else:
        return None
    if math.isnan(z):
        return None
    if z == math.inf:  # no return
        return "empty" if sensor.clear_no_hit else None
    # Also before a hit beyond the range that is used.
    if distance < z - EPS:
        return "empty"
    if sensor.behind_hit is BehindHit.OCCUPIED:
        return "object"
    return "object" if distance - z <= SURFACE_DEPTH_PX + EPS else None


def naive_scan_evidence(scan_log, sensor, grid):
    """Per scan a list of (flat cell, log-odds), cells ascending."""
    sectors = naive_sectors(scan_log.bearings_rad.tolist(), sensor.fov_rad)
    readings = []
    for pose, ranges in zip(
        scan_log.poses.tolist(), scan_log.ranges_px.tolist(), strict=True
    ):
        counts = {}
        for row in range(grid.height_px):
            for col in range(grid.width_px):
                kind = classify_in_scan(
                    pose, row, col, sectors, ranges, scan_log.max_range_px, sensor
                )
                if kind is not None:
                    cell = (row // grid.cell_px) * grid.n_cols + col // grid.cell_px
                    empty, objects = counts.get(cell, (0, 0))
                    is_empty = kind == "empty"
                    counts[cell] = (empty + is_empty, objects + (not is_empty))
        readings.append(
            [(cell, naive_log_odds(*n)) for cell, n in sorted(counts.items())]
        )
    return readings

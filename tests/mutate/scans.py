"""Kept mutations of scans, their noise, and the formats that they come in."""

from tests.mutate.mutation import Mutation

SCANS: tuple[Mutation, ...] = (
    Mutation(
        "occsim/scan/sectors.py",
        "between = 0.5 * (bearing[1:] + bearing[:-1])",
        "between = bearing[1:]",
        ("tests/test_scan.py",),
        "a beam stands for the sector half-way to its neighbours",
    ),
    Mutation(
        "occsim/scan/sectors.py",
        "if gap <= (first + last) * WRAP_SLACK:",
        "if gap <= -1.0:",
        ("tests/test_scan.py",),
        "beams all round have no edge",
    ),
    Mutation(
        "occsim/scan/sectors.py",
        "inner = between - EDGE_EPS - middle",
        "inner = between + EDGE_EPS - middle",
        ("tests/test_scan.py",),
        "half-way between two beams belongs to the clockwise one",
    ),
    Mutation(
        "occsim/scan/sectors.py",
        "hit = np.maximum(ranges_px - EDGE_EPS, OWN_RADIUS_PX)",
        "hit = np.maximum(ranges_px + EDGE_EPS, OWN_RADIUS_PX)",
        ("tests/test_scan.py",),
        "a pixel at the range itself is object",
    ),
    Mutation(
        "occsim/scan/sectors.py",
        "return np.where(np.isnan(ranges_px), OWN_RADIUS_PX, radii)",
        "return radii",
        ("tests/test_scan.py",),
        "an invalid beam says nothing",
    ),
    Mutation(
        "occsim/scan/evidence.py",
        "ranges = scan_log.ranges_px[part][:, sectors.order]",
        "ranges = scan_log.ranges_px[part]",
        ("tests/test_scan.py",),
        "beams may come in any order",
    ),
    Mutation(
        "occsim/scan/simulate.py",
        "bearings = ((np.arange(n_beams) + 0.5) / n_beams - 0.5) * sensor.fov_rad",
        "bearings = (np.arange(n_beams) / n_beams - 0.5) * sensor.fov_rad",
        ("tests/test_scan.py",),
        "beams point at the middles of equal sectors",
    ),
    Mutation(
        "occsim/scan/noise.py",
        "beyond = np.maximum(z_m - self.sigma_from_m, 0.0)",
        "beyond = np.maximum(z_m, 0.0)",
        ("tests/test_scan_noise.py",),
        "range noise grows from the distance at which it is least",
    ),
    Mutation(
        "occsim/scan/noise.py",
        "np.sqrt(noise.alpha_3 * step_m**2 + by_turning)",
        "np.sqrt(noise.alpha_3 * step_m + by_turning)",
        ("tests/test_scan_noise.py",),
        "a step's variance grows with its square, as in Table 5.6",
    ),
    Mutation(
        "occsim/scan/noise.py",
        "measured[dropped] = np.inf",
        "measured[dropped] = 0.0",
        ("tests/test_scan_noise.py",),
        "a dropped return is no return",
    ),
    Mutation(
        "occsim/scan/simulate.py",
        "ranges = _exact(seen, poses, sensor, bearings)",
        "ranges = _exact(world, poses, sensor, bearings)",
        ("tests/test_scan_noise.py",),
        "range finders look through glass",
    ),
)

"""Kept mutations of evidence, fusion, scores, fronts, search, tours and tilt."""

from tests.mutate.mutation import Mutation

ARITHMETIC: tuple[Mutation, ...] = (
    Mutation(
        "occsim/mapping.py",
        "np.ones_like(k) if once else 1.0 - k",
        "np.ones_like(k) if once else 1.0 - np.minimum(k, 40.0)",
        ("tests/test_mapping.py",),
        "the prior is taken off at every reading, also after forty",
    ),
    Mutation(
        "occsim/mapping.py",
        "np.ones_like(k) if once else 1.0 - k",
        "1.0 - k if once else np.ones_like(k)",
        ("tests/test_mapping.py",),
        "the two rules are not exchanged",
    ),
    Mutation(
        "occsim/logodds.py",
        "LATTICE_NATS = 2.0**-36",
        "LATTICE_NATS = 2.0**-20",
        ("tests/test_mapping.py", "tests/test_metrics.py", "tests/test_hand_worked.py"),
        "the lattice of log-odds is fine",
    ),
    Mutation(
        "occsim/logodds.py",
        "steps = np.rint(np.asarray(log_odds, dtype=np.float64) / LATTICE_NATS)",
        "steps = np.asarray(log_odds, dtype=np.float64) / LATTICE_NATS",
        ("tests/test_mapping.py", "tests/test_metrics.py"),
        "log-odds are rounded to the lattice",
    ),
    Mutation(
        "occsim/priors/exact.py",
        "new = wall.fp[row] + space.fp - 0.5 * area",
        "new = wall.fp[row] + space.fp + 0.5 * area",
        ("tests/test_pareto.py",),
        "of pairs that score alike the one with the largest rectangle is given",
    ),
    Mutation(
        "occsim/priors/nsga2.py",
        "values = (*bounds, ONE_HALF) if inside else bounds",
        "values = (ONE_HALF,) if inside else ()",
        ("tests/test_nsga2.py",),
        "the search starts with the corners of the box",
    ),
    Mutation(
        "occsim/priors/nsga2.py",
        "values = (*bounds, ONE_HALF) if inside else bounds",
        "values = bounds",
        ("tests/test_nsga2.py",),
        "the search starts with priors of one half",
    ),
    Mutation(
        "occsim/sensor.py",
        "EDGE_EPS = 1e-9",
        "EDGE_EPS = 1e-7",
        ("tests/test_evidence.py", "tests/test_sensor.py"),
        "the field of view reaches no further than its tolerance",
    ),
    Mutation(
        "occsim/sensor.py",
        "logit(np.clip(q, P_FREE_MIN, P_FREE_MAX))",
        "logit(q)",
        ("tests/test_sensor.py", "tests/test_evidence.py"),
        "mixed cells are kept within 0.1 to 0.9",
    ),
    Mutation(
        "occsim/imaging/tilt.py",
        "return float(fine @ weight / weight.sum())",
        "return float(fine[int(np.argmax(weight))])",
        ("tests/test_tilt.py",),
        "the centre of the peak of a tilt is taken",
    ),
    Mutation(
        "occsim/tour/walk.py",
        "if gain[j] > _LEAST_GAIN:",
        "if False:",
        ("tests/test_tour.py",),
        "the order of a walk is improved",
    ),
    Mutation(
        "occsim/tour/views.py",
        "        left[cell] = 0.0\n",
        "",
        ("tests/test_tour.py",),
        "a cell that was shown is not worth showing again",
    ),
    Mutation(
        "occsim/rays/reach.py",
        "half = min(0.5 * sensor.fov_rad + EDGE_EPS, np.pi)",
        "half = min(sensor.fov_rad + EDGE_EPS, np.pi)",
        ("tests/test_evidence.py", "tests/test_hand_worked.py"),
        "the field of view is the full opening angle",
    ),
)

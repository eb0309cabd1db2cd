"""A drawing on a robot's map: by points, by the evidence, and as a mask."""

import functools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    EvidenceLog,
    Grid,
    ParameterError,
    Prior,
    Registration,
    ScanLog,
    ScanNoise,
    Sensor,
    Trajectory,
    agreement,
    detect_walls,
    evidence_from_scans,
    flawed_mask,
    load_sample,
    logit,
    refine_registration,
    register_by_points,
    registered_walls,
    simulate_scans,
)
from occsim.flaws import DrawingFlaws
from occsim.registration.agreement import wall_gains

angles = st.floats(-math.pi, math.pi - 1e-6)
shifts = st.floats(-1000, 1000)
registrations = st.builds(
    Registration,
    scale=st.floats(0.05, 20),
    rotation_rad=angles,
    shift_x_px=shifts,
    shift_y_px=shifts,
)


def test_two_pairs_by_hand():
    """(0, 0) to (3, 4) and (0, 10) to (-17, 4): twice as long, a quarter turn: down on
    the drawing is left on the map."""
    lies = register_by_points([[0, 0], [0, 10]], [[3, 4], [-17, 4]])
    assert lies.scale == pytest.approx(2)
    assert lies.rotation_rad == pytest.approx(math.pi / 2)
    assert (lies.shift_x_px, lies.shift_y_px) == pytest.approx((3, 4))
    np.testing.assert_allclose(lies.points([[1, 0]]), [[3, 6]], atol=1e-12)


@given(registrations)
def test_points_that_were_placed_give_the_registration_back(lies):
    drawing = [[0.0, 0.0], [100.0, 20.0], [40.0, 80.0]]
    found = register_by_points(drawing, lies.points(drawing))
    np.testing.assert_allclose(
        found.points(drawing), lies.points(drawing), atol=1e-8, rtol=1e-9
    )
    np.testing.assert_allclose(
        found.drawing_points(lies.points(drawing)), drawing, atol=1e-6
    )


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20)
def test_of_many_pairs_the_squared_distances_are_least(seed):
    rng = np.random.default_rng(seed)
    drawing = rng.uniform(0, 100, (5, 2))
    log = 2.0 * drawing + rng.normal(0, 5, (5, 2)) + 30
    found = register_by_points(drawing, log)
    cost = ((found.points(drawing) - log) ** 2).sum()
    for name in ("scale", "rotation_rad", "shift_x_px", "shift_y_px"):
        for step in (-1e-3, 1e-3):
            fields = {n: getattr(found, n) for n in Registration.__slots__}
            other = Registration(**fields | {name: fields[name] + step})
            assert ((other.points(drawing) - log) ** 2).sum() >= cost


@pytest.mark.parametrize(
    ("drawing", "log", "sentence"),
    [
        ([[1, 1]], [[1, 1]], "two or more pairs; got 1 and 1"),
        ([[1, 1], [2, 2]], [[1, 1]], "got 2 and 1 points"),
        ([[1, 1], [1, 1]], [[1, 1], [2, 2]], "drawing_points must lie apart"),
        ([[1, 1], [2, 2]], [[5, 5], [5, 5]], "log_points must lie apart"),
        ([[1, 1], [2, math.nan]], [[5, 5], [6, 5]], "drawing_points must be finite"),
        ([[0, 0], [1, 0]], [[0, 0], [5000, 0]], r"scale must lie in \[0.01, 100\]"),
        ([[0, 0], [1e300, 0]], [[0, 0], [5, 0]], "must lie within 1e.07 px"),
    ],
)
def test_points_that_tell_nothing_are_refused(drawing, log, sentence):
    with pytest.raises(ParameterError, match=sentence):
        register_by_points(drawing, log)


def test_a_turn_is_kept_within_one_turn():
    assert Registration(rotation_rad=5 * math.pi).rotation_rad == pytest.approx(
        -math.pi
    )


def naive_walls(walls, lies, shape):
    """Pixel by pixel: what `registered_walls` says of itself, save the bridges."""
    out = np.zeros(shape, bool)
    rows, cols = np.nonzero(walls)
    for x, y in lies.points(np.stack([cols, rows], axis=1) + 0.5) + 1e-6:
        if 0 <= x < shape[1] and 0 <= y < shape[0]:
            out[int(y), int(x)] = True
    for row in range(shape[0]):
        for col in range(shape[1]):
            ((x, y),) = lies.drawing_points([[col + 0.5, row + 0.5]]) - 1e-6
            if 0 <= x < walls.shape[1] and 0 <= y < walls.shape[0]:
                out[row, col] |= walls[int(y), int(x)]
    return out


@pytest.mark.parametrize("scale", [0.3, 1.0, 2.7])
@pytest.mark.parametrize("turn", [0.0, 0.4, -2.0])
def test_walls_lie_where_their_pixels_do(scale, turn):
    walls = np.zeros((30, 24), bool)
    walls[5], walls[:, 17] = True, True  # thin lines
    lies = Registration(
        scale=scale, rotation_rad=turn, shift_x_px=21.3, shift_y_px=17.1
    )
    grid = Grid(height_px=50, width_px=70, cell_px=1)
    found = registered_walls(walls, lies, grid)
    expected = naive_walls(walls, lies, found.shape)
    assert not (expected & ~found).any()
    # A turn joins pixels that touch at a corner; nothing else is added.
    assert (found & ~expected).sum() <= 0.02 * expected.sum() + 2


def test_a_drawing_registered_where_it_lies_is_itself():
    walls = load_sample("c").world.occupied
    grid = Grid(height_px=walls.shape[0], width_px=walls.shape[1], cell_px=3)
    np.testing.assert_array_equal(registered_walls(walls, Registration(), grid), walls)
    shifted = registered_walls(walls, Registration(shift_x_px=5), grid)
    flaws = DrawingFlaws(shift_x_px=5)
    np.testing.assert_array_equal(shifted, flawed_mask(walls, flaws))


def test_a_drawing_beyond_the_map_draws_nothing_on_it():
    grid = Grid(height_px=5, width_px=5, cell_px=1)
    far = Registration(shift_x_px=1e6)
    assert not registered_walls(np.ones((9, 9), bool), far, grid).any()
    assert agreement(np.ones((9, 9), bool), two_cells(grid), far).bits == 0.0


def two_cells(grid):
    return EvidenceLog(grid, [0, 2, 3], [0, 1, 1], logit([0.9, 0.1, 0.1]))


def test_agreement_by_hand():
    """p_free 0.18 and 0.81. Cell 0, odds 9 for free: (0.18 * 9 + 0.82) / (0.81 * 9 +
    0.19) = 2.44 / 7.48. Cell 1, odds 1/81: (0.18 / 81 + 0.82) / (0.81 / 81 + 0.19) =
    0.822222 / 0.2. Cell 2 was never read: 1."""
    grid = Grid(height_px=1, width_px=3, cell_px=1)
    found = agreement(np.ones((1, 3), bool), two_cells(grid), Registration())
    expected = math.log2(2.44 / 7.48) + math.log2(0.8222222222 / 0.2)
    assert found.bits == pytest.approx(expected)
    assert (found.n_walls_seen, found.n_found, found.share_found) == (2, 1, 0.5)
    none = agreement(np.zeros((1, 3), bool), two_cells(grid), Registration())
    assert none.bits == 0.0
    assert math.isnan(none.share_found)


def test_a_cell_counts_at_most_a_few_bits_however_often_it_was_read():
    found = wall_gains(np.array([-4000.0, 0.0, 4000.0]), Prior())
    expected = np.log([0.82 / 0.19, 1.0, 0.18 / 0.81])
    np.testing.assert_allclose(found, expected, atol=1e-15)


@functools.cache
def drive(name, scale, turn):
    """Walls found in a sample's drawing, what a robot sees of its world on a map of its
    own, and where the drawing lies on that map.

    Every fifth pose of the sample's tour; 180 beams over 270 degrees, 2 cm of noise.
    """
    sample = load_sample(name)
    log = simulate_scans(
        sample.world,
        Trajectory(sample.trajectory.poses[::5]),
        Sensor(range_px=80, fov_rad=1.5 * np.pi),
        180,
        ScanNoise(metres_per_px=0.05, sigma_0_m=0.02, sigma_2_per_m=0.0),
        np.random.default_rng(1),
    )
    height, width = sample.world.shape
    corners = Registration(scale=scale, rotation_rad=turn).points(
        [[0, 0], [width, 0], [0, height], [width, height]]
    )
    shift = 20.0 - corners.min(axis=0)
    size = np.ceil(corners.max(axis=0) + shift + 20.0).astype(int)
    lies = Registration(
        scale=scale, rotation_rad=turn, shift_x_px=shift[0], shift_y_px=shift[1]
    )
    poses = np.column_stack([lies.points(log.poses[:, :2]), log.poses[:, 2] + turn])
    on_map = ScanLog(
        poses, log.bearings_rad, log.ranges_px * scale, log.max_range_px * scale
    )
    grid = Grid(height_px=int(size[1]), width_px=int(size[0]), cell_px=1)
    sensor = Sensor(
        range_px=on_map.max_range_px, behind_hit="unseen", clear_no_hit=False
    )
    evidence = evidence_from_scans(on_map, sensor, grid)
    return detect_walls(sample.drawing).mask, evidence, lies


def moved(lies, shape, shift_px, turn_rad, growth):
    """The registration moved about the drawing's centre."""
    centre = complex(shape[1], shape[0]) / 2
    factor = lies.factor * growth * np.exp(1j * turn_rad)
    place = lies.factor * centre + lies.shift + shift_px
    return Registration.from_complex(complex(factor), complex(place - factor * centre))


def corners_off(one, other, shape):
    corners = [[0, 0], [shape[1], 0], [0, shape[0]], [shape[1], shape[0]]]
    return np.hypot(*(one.points(corners) - other.points(corners)).T).max()


@pytest.mark.parametrize("name", "abcde")
@pytest.mark.parametrize(("scale", "turn"), [(1.3, 0.4), (0.6, -2.5)])
def test_a_start_that_is_off_leads_back(name, scale, turn):
    """30 px, 5 degrees and 5 % at the larger scale, as much of the building at the
    smaller one. What remains are corners of the drawing 3 px off and 0.2 degrees:
    measured 2.2 px and 0.11 degrees on b, whose furniture is drawn; at most 1 px on the
    others."""
    walls, evidence, lies = drive(name, scale, turn)
    rng = np.random.default_rng(0)
    for _ in range(3):
        sign = rng.choice([-1, 1], 2)
        start = moved(
            lies,
            walls.shape,
            30 * scale / 1.3 * np.exp(2j * np.pi * rng.random()),
            sign[0] * np.radians(5),
            1 + 0.05 * sign[1],
        )
        found = refine_registration(walls, evidence, start)
        before, after = (corners_off(r, lies, walls.shape) for r in (start, found))
        assert before > 20
        assert after < 3
        assert abs(np.degrees(found.rotation_rad - lies.rotation_rad)) < 0.2
        at_start, at_end = (agreement(walls, evidence, r) for r in (start, found))
        assert at_end.bits > at_start.bits
        assert at_end.share_found > 0.5


def test_cells_of_several_pixels_lead_back_too():
    """The same evidence in cells of 4 px: half a cell of the corners' place is lost."""
    walls, evidence, lies = drive("d", 1.3, 0.4)
    fine = evidence.grid
    grid = Grid(height_px=fine.height_px, width_px=fine.width_px, cell_px=4)
    row, col = np.divmod(evidence.cell, fine.n_cols)
    sums = np.bincount(
        row // 4 * grid.n_cols + col // 4, evidence.log_odds, grid.n_cells
    )
    cells = np.flatnonzero(sums)
    coarse = EvidenceLog(
        grid, [0, cells.size], cells.astype(np.int32), np.clip(sums[cells], -9, 9)
    )
    start = moved(lies, walls.shape, 12 - 9j, 0.05, 1.03)
    found = refine_registration(walls, coarse, start)
    assert corners_off(found, lies, walls.shape) < 4


def test_a_start_is_never_made_worse():
    """From far away no way leads back; and another building's drawing has none."""
    walls, evidence, lies = drive("e", 1.3, 0.4)
    other, _, _ = drive("d", 1.3, 0.4)
    for mask, start in (
        (walls, moved(lies, walls.shape, 300 + 200j, 1.0, 0.5)),
        (other, moved(lies, walls.shape, 20j, 0.3, 1.0)),
        (walls, lies),
    ):
        found = refine_registration(mask, evidence, start)
        bits = [agreement(mask, evidence, r).bits for r in (start, found)]
        assert bits[1] >= bits[0]


def test_where_nothing_was_seen_or_drawn_the_start_remains():
    grid = Grid(height_px=20, width_px=20, cell_px=1)
    start = Registration(shift_x_px=1)
    free = EvidenceLog(grid, [0, 1], [5], logit([0.9]))
    for walls in (np.ones((5, 5), bool), np.zeros((5, 5), bool)):
        assert refine_registration(walls, free, start) is start
    wall = EvidenceLog(grid, [0, 1], [5], logit([0.1]))
    assert refine_registration(np.zeros((5, 5), bool), wall, start) is start
    one = np.zeros((5, 5), bool)
    one[2, 2] = True  # a single pixel: no scale, no turn
    assert isinstance(refine_registration(one, wall, start), Registration)


@pytest.mark.parametrize("reach", [0, 1.9, math.inf, math.nan, 1001])
def test_a_reach_outside_its_domain_is_refused(reach):
    grid = Grid(height_px=3, width_px=3, cell_px=1)
    with pytest.raises(ParameterError, match=r"reach_px must lie in \[2, 1000\]"):
        refine_registration(
            np.ones((3, 3), bool), two_cells(grid), Registration(), reach_px=reach
        )

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    Grid,
    ParameterError,
    Sensor,
    Trajectory,
    World,
    collect_evidence,
    collect_totals,
    stream_evidence,
)
from occsim.geometry import wrap_angle
from occsim.rays.faces import wall_faces
from tests.oracles import naive_evidence


def readings(evidence):
    """Per reading a list of (cell, log-odds), in the oracle's form."""
    bounds = zip(evidence.indptr[:-1], evidence.indptr[1:], strict=True)
    return [
        list(zip(evidence.cell[a:b].tolist(), evidence.log_odds[a:b], strict=True))
        for a, b in bounds
    ]


def assert_same_readings(evidence, expected):
    found = readings(evidence)
    assert len(found) == len(expected)
    for ours, theirs in zip(found, expected, strict=True):
        assert [cell for cell, _ in ours] == [cell for cell, _ in theirs]
        np.testing.assert_allclose(
            # The library's log-odds are rounded to a lattice of 1.5e-11 nats.
            [value for _, value in ours],
            [value for _, value in theirs],
            atol=1e-11,
        )


SIDES = st.integers(1, 14)
# Halves and wholes put the robot on pixel centres, edges and corners.
PLACES = st.one_of(
    st.integers(-4, 36).map(lambda k: k / 2),
    st.integers(-200, 1800).map(lambda k: k / 100),
)
HEADINGS = st.one_of(
    st.sampled_from([0.0, np.pi / 2, np.pi, 3 * np.pi / 2, np.pi / 4]),
    st.floats(-7, 7).map(lambda a: round(a, 3)),
)
FIELDS = st.one_of(
    st.sampled_from([np.pi / 6, np.pi / 2, np.pi, 1.5 * np.pi, 2 * np.pi]),
    st.floats(0.02, 6.28).map(lambda a: round(a, 3)),
)
SENSORS = st.builds(
    Sensor,
    range_px=st.one_of(
        st.integers(1, 40).map(lambda k: k / 2),
        st.floats(0.1, 20).map(lambda r: round(r, 2)),
    ),
    fov_rad=FIELDS,
    behind_hit=st.sampled_from(BehindHit),
    clear_no_hit=st.booleans(),
)


@st.composite
def worlds(draw):
    """Speckle of any density, or a few bars, which leave long views."""
    shape = draw(SIDES), draw(SIDES)
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    occupied = rng.random(shape) < draw(st.sampled_from([0.0, 0.03, 0.1, 0.3, 0.7, 1]))
    for _ in range(draw(st.integers(0, 2))):
        row, col = rng.integers(0, shape)
        occupied[row, col : col + rng.integers(1, 9)] = True
        occupied[row : row + rng.integers(1, 9), col] = True
    return World(occupied=occupied)


@settings(max_examples=300, deadline=None)
@given(
    world=worlds(),
    poses=st.lists(st.tuples(PLACES, PLACES, HEADINGS), min_size=1, max_size=4),
    sensor=SENSORS,
    cell_px=st.integers(1, 6),
    many_faces=st.sampled_from([0, 100]),
)
@example(
    # Standing on the corner of four pixels, three of them wall.
    world=World(occupied=np.array([[True, True], [True, False]])),
    poses=[(1.0, 1.0, 0.0)],
    sensor=Sensor(range_px=3.0, fov_rad=2 * np.pi),
    cell_px=1,
    many_faces=100,
)
@example(
    # Half a turn without a hit: only the own pixel is known.
    world=World(occupied=np.array([[False, False]])),
    poses=[(1.5, 0.5, 0.0)] * 4,
    sensor=Sensor(range_px=0.5, fov_rad=np.pi, clear_no_hit=False),
    cell_px=1,
    many_faces=100,
)
@example(
    # A full turn has a seam straight behind the robot, here through a pixel's centre.
    world=World(occupied=np.array([[True]])),
    poses=[(0.51, 0.51, np.pi / 4)],
    sensor=Sensor(range_px=0.5, fov_rad=2 * np.pi),
    cell_px=1,
    many_faces=100,
)
@example(
    # A diagonal line one pixel wide is closed: the ray through its joints is stopped.
    world=World(occupied=np.eye(6, dtype=bool)[::-1]),
    poses=[(0.5, 0.5, np.pi / 4)],
    sensor=Sensor(range_px=9.0),
    cell_px=1,
    many_faces=100,
)
def test_every_reading_is_that_of_the_naive_loop(
    world, poses, sensor, cell_px, many_faces
):
    trajectory = Trajectory(poses=np.array(poses))
    with pytest.MonkeyPatch.context() as patch:
        # At 0, hidden faces are looked for first, as in worlds of very many faces.
        patch.setattr("occsim.evidence.MANY_FACES", many_faces)
        evidence = collect_evidence(world, trajectory, sensor, world.grid(cell_px))
    assert_same_readings(evidence, naive_evidence(world, trajectory, sensor, cell_px))


@pytest.mark.parametrize("behind_hit", BehindHit)
def test_on_a_full_turn_the_heading_does_not_matter(behind_hit):
    """Diagonal rays from a pixel's centre graze corners, wherever the robot looks."""
    rng = np.random.default_rng(4)
    world = World(occupied=rng.random((14, 16)) < 0.15)
    sensor = Sensor(range_px=12.0, fov_rad=2 * np.pi, behind_hit=behind_hit)
    grid = world.grid(1)
    places = rng.integers(0, 14, (40, 2)) + 0.5
    logs = [
        collect_evidence(
            world,
            Trajectory(poses=np.column_stack([places, np.full(40, heading)])),
            sensor,
            grid,
        )
        for heading in np.arange(8) * np.pi / 4
    ]
    for log in logs[1:]:
        np.testing.assert_array_equal(log.indptr, logs[0].indptr)
        np.testing.assert_array_equal(log.cell, logs[0].cell)
        np.testing.assert_array_equal(log.log_odds, logs[0].log_odds)


def test_a_grid_of_another_size_is_refused():
    world = World(occupied=np.zeros((4, 5), dtype=bool))
    trajectory = Trajectory(poses=np.zeros((1, 3)))
    grid = Grid(height_px=5, width_px=4, cell_px=2)
    with pytest.raises(ParameterError, match=r"world of \(4, 5\) px; got \(5, 4\) px"):
        collect_evidence(world, trajectory, Sensor(), grid)


def dense(evidence):
    """All readings as an array (S, R, C), NaN where a reading has no entry."""
    cells = np.full((evidence.n_readings, evidence.grid.n_cells), np.nan)
    cells[evidence.reading, evidence.cell] = evidence.log_odds
    return cells.reshape(-1, *evidence.grid.shape)


def room(side=40):
    """A room with a pillar and a doorway."""
    occupied = np.zeros((side, side), dtype=bool)
    occupied[:3] = occupied[-3:] = occupied[:, :3] = occupied[:, -3:] = True
    occupied[15:21, 22:26] = True
    occupied[10:16, -3:] = False
    return World(occupied=occupied)


def poses_in(world, n, seed):
    rng = np.random.default_rng(seed)
    rows, cols = np.nonzero(~world.occupied)
    k = rng.integers(0, rows.size, n)
    x, y = cols[k] + rng.random(n), rows[k] + rng.random(n)
    return np.stack([x, y, rng.uniform(-np.pi, np.pi, n)], axis=1)


@settings(max_examples=60, deadline=None)
@given(world=worlds(), poses=st.lists(st.tuples(PLACES, PLACES, HEADINGS), min_size=1))
@pytest.mark.parametrize("behind_hit", BehindHit)
def test_turning_world_and_poses_turns_the_evidence(behind_hit, world, poses):
    # Clockwise on the screen, (x, y) goes to (height - y, x), and cells of 1 px too.
    sensor = Sensor(range_px=8.0, fov_rad=2.0, behind_hit=behind_hit)
    poses = np.array(poses)
    x, y, theta = poses.T
    turned_world = World(occupied=np.rot90(world.occupied, -1))
    turned = np.stack([world.shape[0] - y, x, theta + np.pi / 2], axis=1)
    before = collect_evidence(world, Trajectory(poses=poses), sensor, world.grid(1))
    after = collect_evidence(
        turned_world, Trajectory(poses=turned), sensor, turned_world.grid(1)
    )
    np.testing.assert_allclose(
        dense(after), np.rot90(dense(before), -1, axes=(1, 2)), atol=1e-12
    )


def test_the_order_of_scans_does_not_matter_for_totals():
    world, sensor = room(), Sensor(range_px=15.0, fov_rad=1.0)
    poses = poses_in(world, 50, seed=4)
    shuffled = poses[np.random.default_rng(0).permutation(50)]
    logs = [
        collect_evidence(world, Trajectory(poses=p), sensor, world.grid(3))
        for p in (poses, shuffled)
    ]
    (sums, counts), (sums_2, counts_2) = (log.totals() for log in logs)
    np.testing.assert_array_equal(sums, sums_2)
    np.testing.assert_array_equal(counts, counts_2)


def test_hidden_faces_are_left_out_without_changing_a_reading():
    # Speckle on a larger scale than the naive loop can follow.
    rng = np.random.default_rng(8)
    world = World(occupied=rng.random((150, 150)) < 0.05)
    trajectory = Trajectory(poses=poses_in(world, 20, seed=8))
    sensor = Sensor(range_px=90.0, fov_rad=5.0, behind_hit=BehindHit.UNSEEN)
    logs = []
    for many_faces in (0, 10**9):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("occsim.evidence.MANY_FACES", many_faces)
            log = collect_evidence(world, trajectory, sensor, world.grid(4))
            logs.append(dense(log))
    np.testing.assert_array_equal(*logs)


def test_batches_change_nothing_and_report_progress(monkeypatch):
    world, sensor = room(), Sensor(range_px=30.0, fov_rad=6.0)
    trajectory = Trajectory(poses=poses_in(world, 25, seed=1))
    whole = collect_evidence(world, trajectory, sensor, world.grid(4))
    monkeypatch.setattr("occsim.evidence.READINGS_AT_ONCE", 10)
    monkeypatch.setattr("occsim.rays.outline.PAIRS_AT_ONCE", 50)
    calls = []
    parts = collect_evidence(
        world, trajectory, sensor, world.grid(4), lambda *call: calls.append(call)
    )
    assert calls == [(10, 25), (20, 25), (25, 25)]
    for name in ("indptr", "cell", "log_odds"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(parts, name))


@pytest.mark.parametrize("at_once", [7, 1000])
def test_parts_and_totals_are_those_of_the_log(monkeypatch, at_once):
    monkeypatch.setattr("occsim.evidence.READINGS_AT_ONCE", at_once)
    world, sensor = room(), Sensor(range_px=30.0, fov_rad=6.0)
    asked = world, Trajectory(poses=poses_in(world, 25, seed=1)), sensor, world.grid(4)
    log, totals = collect_evidence(*asked), collect_totals(*asked)
    for ours, theirs in zip(totals.totals(), log.totals(), strict=True):
        np.testing.assert_array_equal(ours, theirs)
        assert not ours.flags.writeable
    parts = list(stream_evidence(*asked))
    assert len(parts) == -(-25 // at_once)
    for name in ("cell", "log_odds"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(joined, getattr(log, name))


def test_faces_are_found_once_a_world(monkeypatch):
    calls = []

    def counted(occupied):
        calls.append(occupied.shape)
        return wall_faces(occupied)

    monkeypatch.setattr("occsim.evidence.wall_faces", counted)
    world, other = room(), room()
    for asked in (world, world, other, world):
        one_reading(asked, (20.0, 20.0, 0.0))
    assert len(calls) == 2


@pytest.mark.parametrize("theta", [1e16, -1e16, 1e300, 7e8])
@pytest.mark.parametrize("fov_rad", [1.0, 5.0])
def test_a_heading_of_many_turns_is_the_heading_within_one(theta, fov_rad):
    seen = [
        one_reading(room(), (20.5, 20.5, angle), range_px=30.0, fov_rad=fov_rad)
        for angle in (theta, float(wrap_angle(theta)))
    ]
    np.testing.assert_array_equal(*seen)


def test_types_and_order_of_the_log():
    world = room()
    trajectory = Trajectory(poses=poses_in(world, 9, seed=2))
    log = collect_evidence(world, trajectory, Sensor(), world.grid(3))
    assert (log.indptr.dtype, log.cell.dtype) == (np.int64, np.int32)
    assert log.log_odds.dtype == np.float64
    assert log.n_readings == 9
    for a, b in zip(log.indptr[:-1], log.indptr[1:], strict=True):
        assert (np.diff(log.cell[a:b]) > 0).all()


def one_reading(world, pose, cell_px=1, **sensor):
    trajectory = Trajectory(poses=[pose])
    return dense(
        collect_evidence(world, trajectory, Sensor(**sensor), world.grid(cell_px))
    )[0]


@pytest.mark.parametrize("place", [(1.5, 1.5), (1.2, 1.9), (1.0, 1.4)])
def test_a_robot_inside_wall_sees_only_object(place):
    # The last place is the edge between two wall pixels: inside the wall too.
    world = World(occupied=np.array([[0, 0, 0], [1, 1, 0], [0, 0, 0]], dtype=bool))
    seen = one_reading(world, (*place, 0.3), range_px=9, fov_rad=2 * np.pi)
    np.testing.assert_allclose(seen, np.full((3, 3), -np.log(9)))


def test_a_robot_against_a_wall_sees_the_free_side():
    # It stands on the left edge of the wall pixel: to the right all is object.
    world = World(occupied=np.array([[0, 0, 1, 0]], dtype=bool))
    seen = one_reading(world, (2.0, 0.5, 0.0), range_px=9, fov_rad=2 * np.pi)
    np.testing.assert_allclose(seen, [np.log([9, 9, 1 / 9, 1 / 9])])


def test_a_robot_outside_the_drawing_sees_its_walls():
    world = World(occupied=np.array([[0, 1, 0, 0]], dtype=bool))
    seen = one_reading(world, (-1.5, 0.5, 0.0), range_px=4.5, fov_rad=1.0)
    np.testing.assert_allclose(seen, [[np.log(9), -np.log(9), -np.log(9), np.nan]])


def test_the_own_pixel_is_seen_whatever_the_heading_and_its_width():
    world = World(occupied=np.zeros((3, 3), dtype=bool))
    for theta in (0.0, 1.0, np.pi / 2, 4.0):
        seen = one_reading(world, (1.5, 1.5, theta), range_px=0.4, fov_rad=1e-6)
        np.testing.assert_allclose(seen[1, 1], np.log(9))
        assert np.isnan(seen).sum() == 8


@pytest.mark.parametrize("x", [1e9, -1e18, 1e300])
@pytest.mark.parametrize("range_px", [20.0, 1e300])
def test_a_robot_far_outside_sees_nothing(x, range_px):
    world = room()
    near = poses_in(world, 1, seed=0)[0]
    log = collect_evidence(
        world,
        Trajectory(poses=[near, (x, 5.0, 0.0), (5.0, x, 0.0)]),
        Sensor(range_px=range_px, fov_rad=1.0),
        world.grid(3),
    )
    assert log.indptr[1] > 0
    np.testing.assert_array_equal(log.indptr[1:], log.indptr[1])


def test_a_reading_that_sees_nothing_is_an_empty_entry():
    world = World(occupied=np.zeros((5, 5), dtype=bool))
    log = collect_evidence(
        world,
        Trajectory(poses=[(2.2, 2.2, 0.0)]),
        Sensor(clear_no_hit=False),
        world.grid(2),
    )
    np.testing.assert_array_equal(log.indptr, [0, 0])
    assert (log.totals()[1] == 0).all()


def test_cells_wider_than_the_world_are_one_cell():
    world = room()
    seen = one_reading(world, (9.5, 9.5, 0.0), cell_px=100, fov_rad=2.0)
    assert seen.shape == (1, 1)
    assert 0 < seen.item() <= np.log(9)

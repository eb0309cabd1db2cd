"""The map that grows scan by scan, and its file."""

import io
import json
import zipfile

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from occsim import (
    Grid,
    Mapper,
    ParameterError,
    Prior,
    RobotFileError,
    Scan,
    Sensor,
    TrajectoryError,
    UpdateRule,
    build_prior,
    evidence_from_scans,
    fuse,
    load_sample,
    logit,
    simulate_scans,
)
from tests.test_evidence import SENSORS
from tests.test_scan import GRIDS, scan_logs


def prior_on(grid, seed=0):
    mask = np.random.default_rng(seed).random((grid.height_px, grid.width_px)) < 0.2
    return build_prior(mask, grid, Prior())


def enter_all(mapper, log):
    for index, pose in enumerate(log.poses):
        mapper.update(pose, log.scan(index))
    return mapper.map


@settings(max_examples=150, deadline=None)
@given(scan_logs(), SENSORS, GRIDS, st.sampled_from(UpdateRule))
def test_scan_by_scan_gives_the_map_of_all_scans_to_the_last_bit(
    log, sensor, grid, rule
):
    prior_map = prior_on(grid)
    found = enter_all(Mapper(grid, prior_map, rule, sensor=sensor), log)
    whole = fuse(evidence_from_scans(log, sensor, grid), prior_map, rule)
    np.testing.assert_array_equal(found.log_odds, whole.log_odds)
    np.testing.assert_array_equal(found.n_updates, whole.n_updates)
    assert found.n_updates.dtype == np.int64


SAMPLE = load_sample("d")
GRID = SAMPLE.world.grid(3)
LOG = simulate_scans(SAMPLE.world, SAMPLE.trajectory, SAMPLE.sensor, 31)
PRIOR_MAP = build_prior(SAMPLE.world.occupied, GRID, Prior())


def test_without_a_sensor_all_that_a_scan_says_is_entered():
    found = enter_all(Mapper(GRID, PRIOR_MAP), LOG)
    whole = fuse(
        evidence_from_scans(LOG, Sensor(range_px=LOG.max_range_px), GRID), PRIOR_MAP
    )
    np.testing.assert_array_equal(found.log_odds, whole.log_odds)


def test_range_finders_may_take_turns():
    """The sectors of the last one are kept; another one's must not be used."""
    pose = SAMPLE.trajectory.poses[0]
    few = Scan([-0.2, 0.2], [10.0, 12.0], 20.0)
    more = Scan([-0.5, 0.0, 0.5], [9.0, 14.0, 12.0], 20.0)
    both, one, other = (Mapper(GRID, PRIOR_MAP) for _ in range(3))
    for scan in (few, more, few):
        both.update(pose, scan)
    one.update(pose, few)
    one.update(pose, few)
    other.update(pose, more)
    apart = one.map.log_odds + other.map.log_odds - PRIOR_MAP.log_odds
    np.testing.assert_array_equal(both.map.log_odds, apart)


def test_a_map_once_taken_does_not_change():
    mapper = Mapper(GRID, PRIOR_MAP)
    before = mapper.map
    mapper.update(LOG.poses[0], LOG.scan(0))
    np.testing.assert_array_equal(before.log_odds, PRIOR_MAP.log_odds)
    assert not before.n_updates.any()
    assert mapper.map.n_updates.any()


def test_points_are_looked_up_in_their_cell_and_unknown_outside():
    mapper = Mapper(GRID, PRIOR_MAP)
    enter_all(mapper, LOG)
    p_free = mapper.map.p_free
    assert mapper.p_free_at(0.0, 0.0) == p_free[0, 0]
    x, y = np.array([3.0, 2.999, 10.5]), np.array([[0.0], [61.2]])
    expected = [[p_free[0, 1], p_free[0, 0], p_free[0, 3]]]
    expected += [[p_free[20, 1], p_free[20, 0], p_free[20, 3]]]
    np.testing.assert_array_equal(mapper.p_free_at(x, y), expected)
    assert np.isnan(mapper.p_free_at([-0.1, GRID.width_px, np.nan], [5, 5, 5])).all()


def test_saturation_bounds_the_cells_that_are_updated_and_no_others():
    strong = build_prior(SAMPLE.world.occupied, GRID, Prior(p_wall=0.01, p_space=1.0))
    mapper = Mapper(GRID, strong, saturation=0.8)
    found = enter_all(mapper, LOG)
    seen = found.n_updates > 0
    assert np.abs(found.log_odds[seen]).max() == logit(0.8)
    np.testing.assert_array_equal(found.log_odds[~seen], strong.log_odds[~seen])
    free = Mapper(GRID, strong)
    assert np.abs(enter_all(free, LOG).log_odds).max() > logit(0.99)


def test_a_saturated_map_changes_its_mind_sooner():
    """Ten times free, then wall: the bound is crossed after two readings, not ten."""
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    blank = build_prior([[False]], grid, Prior.uninformative())
    clear, wall = Scan([0.0], [np.inf], 9.0), Scan([0.0], [0.0], 9.0)
    mapper = Mapper(grid, blank, saturation=0.95)
    for scan in [clear] * 10 + [wall] * 2:
        mapper.update((0.5, 0.5, 0.0), scan)
    assert mapper.p_free_at(0.5, 0.5) < 0.5


@pytest.mark.parametrize("rule", UpdateRule)
@pytest.mark.parametrize(
    ("sensor", "saturation"),
    [(None, None), (Sensor(behind_hit="unseen", clear_no_hit=False), 0.97)],
)
def test_a_saved_map_goes_on_where_it_stopped(tmp_path, rule, sensor, saturation):
    half = LOG.n_scans // 2
    mapper = Mapper(GRID, PRIOR_MAP, rule, sensor=sensor, saturation=saturation)
    for index in range(half):
        mapper.update(LOG.poses[index], LOG.scan(index))
    path = tmp_path / "map.npz"
    mapper.save(path)
    loaded = Mapper.load(path)
    for name in ("grid", "rule", "sensor", "saturation"):
        assert getattr(loaded, name) == getattr(mapper, name)
    np.testing.assert_array_equal(loaded.prior_map.p_free, PRIOR_MAP.p_free)
    for one in (mapper, loaded):
        for index in range(half, LOG.n_scans):
            one.update(LOG.poses[index], LOG.scan(index))
    np.testing.assert_array_equal(loaded.map.log_odds, mapper.map.log_odds)
    np.testing.assert_array_equal(loaded.map.n_updates, mapper.map.n_updates)
    assert Mapper.load(path.read_bytes()).map.n_updates.any()


def saved(raw=None, **changed):
    """The content of a small map's file, with arrays replaced or left out."""
    grid = Grid(height_px=4, width_px=6, cell_px=2)
    about = {
        "format": "occsim mapper",
        "version": 1,
        "grid": {"height_px": 4, "width_px": 6, "cell_px": 2},
        "rule": "prior_once",
        "sensor": None,
        "saturation": None,
    } | changed.pop("about", {})
    arrays = {
        "about": np.frombuffer(json.dumps(about).encode(), np.uint8),
        "is_wall": np.zeros(grid.shape, bool),
        "prior_p_free": np.full(grid.shape, 0.5),
        "log_odds": np.zeros(grid.shape),
        "n_updates": np.zeros(grid.shape, np.int32),
    } | changed
    if raw is not None:
        arrays["about"] = np.frombuffer(raw, np.uint8)
    file = io.BytesIO()
    np.savez(file, **{k: v for k, v in arrays.items() if v is not None})
    return file.getvalue()


def test_the_small_file_is_good():
    assert Mapper.load(saved()).grid.shape == (2, 3)


CELLS = (2, 3)
HOSTILE = {
    "nothing": b"",
    "no archive": b"PK but no more",
    "cut": saved()[:-30],
    "an array too few": saved(n_updates=None),
    "an array too many": saved(more=np.zeros(3)),
    "objects": saved(log_odds=np.full(CELLS, None)),
    "another type": saved(log_odds=np.zeros(CELLS, np.float32)),
    "another shape": saved(log_odds=np.zeros((3, 2))),
    "text": saved(n_updates=np.full(CELLS, "a")),
    "negative counts": saved(n_updates=np.full(CELLS, -1, np.int32)),
    "no number": saved(log_odds=np.full(CELLS, np.nan)),
    "infinite": saved(log_odds=np.full(CELLS, np.inf)),
    "no probability": saved(prior_p_free=np.full(CELLS, 1.0)),
    "another format": saved(about={"format": "something"}),
    "a newer version": saved(about={"version": 2}),
    "a huge grid": saved(
        about={"grid": {"height_px": 2**31 - 1, "width_px": 2**31 - 1, "cell_px": 1}}
    ),
    "an unknown rule": saved(about={"rule": "guess"}),
    "a sensor of nothing": saved(about={"sensor": {"range_px": -1}}),
    "a sensor of another kind": saved(about={"sensor": {"colour": 1}}),
    "a saturation of text": saved(about={"saturation": "much"}),
    "no JSON": saved(raw=b'{"format'),
    "deep JSON": saved(raw=b"[" * 5000),
    "many entries": b"PK\x01\x02" * 400,
}


@pytest.mark.parametrize("content", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_file_is_refused_in_a_sentence(content):
    with pytest.raises(RobotFileError) as refused:
        Mapper.load(content)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 200


def test_a_file_that_unpacks_to_very_much_is_refused_before_it_is_unpacked(
    monkeypatch,
):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("about", "is_wall", "prior_p_free", "log_odds", "n_updates"):
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                for _ in range(201 if name == "log_odds" else 0):
                    entry.write(bytes(1_000_000))
    assert len(file.getvalue()) < 1_000_000

    def unpack(*_):
        pytest.fail("something was unpacked")

    monkeypatch.setattr(zipfile.ZipFile, "open", unpack)
    with pytest.raises(RobotFileError, match="not an undamaged file"):
        Mapper.load(file.getvalue())


@pytest.mark.parametrize("bad", [0.5, 1.0, np.nan, "x"])
def test_a_saturation_outside_its_domain_is_refused(bad):
    with pytest.raises(ParameterError, match="saturation must"):
        Mapper(GRID, PRIOR_MAP, saturation=bad)


def test_wrong_arguments_are_refused_in_a_sentence():
    with pytest.raises(TypeError, match="prior_map must be of type PriorMap"):
        Mapper(GRID, GRID)
    with pytest.raises(TypeError, match="sensor must be of type Sensor or NoneType"):
        Mapper(GRID, PRIOR_MAP, sensor=20.0)
    with pytest.raises(ParameterError, match="rule must be one of"):
        Mapper(GRID, PRIOR_MAP, "twice")
    other = SAMPLE.world.grid(4)
    with pytest.raises(ParameterError, match="must lie on the same grid"):
        Mapper(other, PRIOR_MAP)
    mapper = Mapper(GRID, PRIOR_MAP)
    with pytest.raises(TypeError, match="scan must be of type Scan; got ScanLog"):
        mapper.update((0, 0, 0), LOG)
    for pose in ((0, 0), (0, 0, np.nan)):
        with pytest.raises(TrajectoryError):
            mapper.update(pose, LOG.scan(0))
    with pytest.raises(ParameterError, match="must broadcast"):
        mapper.p_free_at([0, 1], [0, 1, 2])
    assert not mapper.map.n_updates.any()

"""Errors of simulated scans and of the poses at which they enter the map."""

import numpy as np
import pytest
from scipy import stats

from occsim import (
    RANGE_FINDERS,
    ParameterError,
    ScanNoise,
    Sensor,
    Trajectory,
    World,
    load_sample,
    simulate_scans,
)
from occsim.scan.noise import estimated_poses, without_glass

SCALE = 0.05
N = 20_000


def rng(seed=0):
    return np.random.default_rng(seed)


def ranges_at(distance_px, noise, *, n=N, range_px=200.0, seed=0):
    """Many measurements of one wall, straight ahead."""
    occupied = np.zeros((3, 400), dtype=bool)
    occupied[:, 200:] = True
    poses = Trajectory(np.tile([200.0 - distance_px, 1.5, 0.0], (n, 1)))
    sensor = Sensor(range_px=range_px, fov_rad=0.01)
    log = simulate_scans(World(occupied), poses, sensor, 1, noise, rng(seed))
    return log.ranges_px.ravel()


def test_the_kinects_noise_grows_as_published():
    """Nguyen et al. 2012: sigma = 0.0012 + 0.0019 (z - 0.4)^2, in metres."""
    noise = RANGE_FINDERS["kinect"].noise(SCALE)
    for z_m, sigma_m in ((0.4, 0.0012), (1.4, 0.0031), (4.0, 0.025824)):
        measured = ranges_at(z_m / SCALE, noise) * SCALE
        # Four standard errors of mean and of standard deviation.
        assert measured.mean() == pytest.approx(z_m, abs=4 * sigma_m / N**0.5)
        assert measured.std() == pytest.approx(sigma_m, rel=4 / (2 * N) ** 0.5)
    assert noise.sigma_px(0.2 / SCALE) * SCALE == pytest.approx(0.0012)


def test_hits_drop_out_by_their_share():
    noise = ScanNoise(metres_per_px=SCALE, dropout_share=0.2)
    measured = ranges_at(50, noise)
    assert np.mean(measured == np.inf) == pytest.approx(0.2, abs=4 * 0.4 / N**0.5)
    assert set(measured) == {50.0, np.inf}


def test_short_returns_lie_evenly_between_robot_and_wall():
    noise = ScanNoise(metres_per_px=SCALE, short_share=0.3, dropout_share=0.1)
    measured = ranges_at(80, noise)
    short = measured[measured < 80.0]
    assert short.size / N == pytest.approx(0.3, abs=4 * 0.46 / N**0.5)
    assert stats.kstest(short / 80.0, "uniform").pvalue > 0.001
    # Also where nothing is within reach.
    assert np.mean(ranges_at(100, noise, range_px=60) < 60) == pytest.approx(
        0.3, abs=0.02
    )


def test_what_would_lie_beyond_the_reach_gives_no_return():
    noise = ScanNoise(metres_per_px=SCALE, sigma_0_m=0.5)
    measured = ranges_at(60, noise, range_px=60)
    assert np.mean(measured == np.inf) == pytest.approx(0.5, abs=0.02)
    assert measured[measured < np.inf].max() <= 60
    assert ranges_at(1, noise).min() == 0.0


def test_the_range_finder_looks_through_glass():
    world = load_sample("a").world
    for share in (0.1, 0.3, 0.8):
        noise = ScanNoise(metres_per_px=SCALE, glass_share=share)
        seen = without_glass(world, noise, rng=rng(3))
        assert not (seen.occupied & ~world.occupied).any()
        lost = 1 - seen.occupied.sum() / world.occupied.sum()
        assert lost == pytest.approx(share, abs=0.02)
    glass = ScanNoise(metres_per_px=SCALE, glass_share=1.0)
    assert set(ranges_at(50, glass, n=10)) == {np.inf}


def test_glass_comes_in_panes_not_in_pixels():
    world = World(np.ones((100, 100), dtype=bool))
    noise = ScanNoise(metres_per_px=SCALE, glass_share=0.4)
    seen = without_glass(world, noise, rng=rng(3)).occupied
    panes = seen.reshape(5, 20, 5, 20).mean(axis=(1, 3))  # 1 m is 20 px
    assert set(panes.ravel()) == {0.0, 1.0}
    assert panes.mean() == 0.6


def test_ranges_are_taken_at_true_poses_and_entered_at_estimated_ones():
    sample = load_sample("c")
    noise = ScanNoise(metres_per_px=SCALE, position_sigma_m=0.1, heading_sigma_rad=0.02)
    args = sample.world, sample.trajectory, sample.sensor, 9
    exact, noisy = simulate_scans(*args), simulate_scans(*args, noise, rng())
    np.testing.assert_array_equal(noisy.ranges_px, exact.ranges_px)
    error = noisy.poses - sample.trajectory.poses
    n = len(error)
    for column, sigma in zip(error.T, (2.0, 2.0, 0.02), strict=True):
        assert column.std() == pytest.approx(sigma, rel=4 / (2 * n) ** 0.5)
        assert abs(column.mean()) < 4 * sigma / n**0.5
    assert abs(np.corrcoef(error[1:, 0], error[:-1, 0])[0, 1]) < 4 / n**0.5


ALPHAS = {"alpha_1": 0.02, "alpha_2": 0.01, "alpha_3": 0.05, "alpha_4": 0.03}


def test_one_motion_errs_by_the_variances_of_the_odometry_model():
    """Probabilistic Robotics, Table 5.6, worked by hand for one motion.

    From heading 0 the robot turns by 0.5, drives 2 m and turns by -0.3:
    var(turn 1) = 0.02 * 0.25 + 0.01 * 4 = 0.045, var(step) = 0.05 * 4 + 0.03 * (0.25 +
    0.09) = 0.2102, var(turn 2) = 0.02 * 0.09 + 0.01 * 4 = 0.0418.
    """
    noise = ScanNoise(metres_per_px=SCALE, **ALPHAS)
    start = np.array([10.0, 20.0, 0.0])
    step_px = 2.0 / SCALE
    end = start + [step_px * np.cos(0.5), step_px * np.sin(0.5), 0.2]
    ends = np.array(
        [
            estimated_poses(np.array([start, end]), noise, rng=rng(seed))[1]
            for seed in range(4000)
        ]
    )
    dx, dy = (ends[:, :2] - start[:2]).T * SCALE
    # Below zero the step goes backwards; that is 4.4 standard deviations away.
    turn_1, step = np.arctan2(dy, dx), np.hypot(dx, dy)
    turn_2 = ends[:, 2] - turn_1
    for found, mean, variance in (
        (turn_1, 0.5, 0.045),
        (step, 2.0, 0.2102),
        (turn_2, -0.3, 0.0418),
    ):
        assert found.mean() == pytest.approx(mean, abs=4 * (variance / 4000) ** 0.5)
        assert found.var() == pytest.approx(variance, rel=4 * (2 / 4000) ** 0.5)


def test_drift_starts_at_the_first_pose_and_grows():
    """Straight on, the heading's variance grows with the number of steps."""
    noise = ScanNoise(metres_per_px=SCALE, alpha_2=0.001)
    poses = np.stack([np.arange(101) * 20.0, np.zeros(101), np.zeros(101)], axis=1)
    many = np.array([estimated_poses(poses, noise, rng=rng(s)) for s in range(500)])
    np.testing.assert_array_equal(many[:, 0], np.zeros((500, 3)))
    heading = many[:, :, 2].std(axis=0)
    for step in (1, 25, 100):  # two turns a step, each of variance 0.001
        assert heading[step] == pytest.approx((0.002 * step) ** 0.5, rel=0.15)
    assert many[:, 100, 1].std() > 10 * many[:, 10, 1].std()


def test_a_turn_on_the_spot_has_no_direction():
    noise = ScanNoise(metres_per_px=SCALE, alpha_4=0.0, alpha_1=1e-12)
    poses = np.array([[5.0, 5.0, 0.0], [5.0, 5.0, 2.0], [5.0, 5.0, -2.0]])
    counted = estimated_poses(poses, noise, rng=rng())
    np.testing.assert_allclose(counted[:, :2], poses[:, :2], atol=1e-9)
    # Headings may differ by whole turns.
    np.testing.assert_allclose(np.cos(counted[:, 2]), np.cos(poses[:, 2]), atol=1e-4)


def test_noise_of_nothing_changes_nothing():
    sample = load_sample("c")
    args = sample.world, sample.trajectory, sample.sensor, 9
    none = simulate_scans(*args, ScanNoise(metres_per_px=SCALE), rng())
    exact = simulate_scans(*args)
    np.testing.assert_array_equal(none.ranges_px, exact.ranges_px)
    np.testing.assert_array_equal(none.poses, exact.poses)


def test_a_seed_gives_the_same_scans_and_another_gives_others():
    sample = load_sample("c")
    noise = ScanNoise(
        metres_per_px=SCALE, sigma_0_m=0.02, short_share=0.1, glass_share=0.2, **ALPHAS
    )
    args = sample.world, sample.trajectory, sample.sensor, 9, noise
    one, same, other = (simulate_scans(*args, rng(s)) for s in (1, 1, 2))
    np.testing.assert_array_equal(one.ranges_px, same.ranges_px)
    np.testing.assert_array_equal(one.poses, same.poses)
    assert not np.array_equal(one.ranges_px, other.ranges_px)
    assert not np.array_equal(one.poses, other.poses)


def test_one_kind_of_error_does_not_shift_what_another_draws():
    sample = load_sample("c")
    args = sample.world, sample.trajectory, sample.sensor, 9
    few = ScanNoise(metres_per_px=SCALE, dropout_share=0.1)
    more = ScanNoise(metres_per_px=SCALE, dropout_share=0.2, position_sigma_m=0.1)
    hits = simulate_scans(*args).is_hit
    kept = simulate_scans(*args, few, rng()).is_hit
    kept_of_more = simulate_scans(*args, more, rng()).is_hit
    assert (kept_of_more <= kept).all()
    assert (kept <= hits).all()
    assert kept_of_more.sum() < kept.sum() < hits.sum()


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"metres_per_px": 0}, "metres_per_px must be above 0"),
        ({"metres_per_px": np.inf}, "metres_per_px must be above 0 and finite"),
        ({"sigma_0_m": -0.1}, "sigma_0_m must be 0 or more"),
        ({"alpha_1": np.nan}, "alpha_1 must be 0 or more"),
        ({"glass_share": 1.2}, r"glass_share must lie in \[0, 1\]; got 1.2"),
        (
            {"dropout_share": 0.6, "short_share": 0.5},
            "dropout_share and short_share must not exceed 1 together; got 1.1",
        ),
        ({"short_share": "all"}, "short_share must be a number"),
    ],
)
def test_noise_outside_its_domain_is_refused(values, sentence):
    with pytest.raises(ParameterError, match=sentence):
        ScanNoise(**{"metres_per_px": SCALE, **values})


def test_noise_needs_a_generator():
    sample = load_sample("c")
    args = sample.world, sample.trajectory, sample.sensor, 9
    with pytest.raises(TypeError, match="rng must be of type Generator; got NoneType"):
        simulate_scans(*args, ScanNoise(metres_per_px=SCALE))

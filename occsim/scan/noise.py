"""What range finders and odometry get wrong."""

from dataclasses import dataclass

import numpy as np

from occsim._bounds import Bounds, bounded, check_bounds, slider_of
from occsim._types import FloatArray
from occsim.errors import ParameterError, real_number
from occsim.geometry import wrap_angle
from occsim.world import World

PANE_M = 1.0
"""Side of the squares in which walls are glass or not, m: about a door's width."""

STANDING_M = 1e-9
"""A step shorter than this is a turn on the spot: it has no direction."""

_ANY = (0.0, np.inf)
_SHARE = Bounds(0.0, 0.5, 0.01), (0.0, 1.0)
_DRIFT = Bounds(0.0, 0.1, 0.001), _ANY


@dataclass(frozen=True, kw_only=True, slots=True)
class ScanNoise:
    """Errors of ranges and of poses; by default none.

    Parameters
    ----------
    metres_per_px : float
        Scale of the world, above 0: errors are in metres.
    sigma_0_m, sigma_2_per_m, sigma_from_m : float, default 0
        The standard deviation of a range z is
        ``sigma_0_m + sigma_2_per_m * (z - sigma_from_m)**2``, m, and `sigma_0_m` below
        `sigma_from_m`.
    dropout_share : float, default 0
        Share of hits that give no return.
    short_share : float, default 0
        Share of beams that end somewhere before what they should meet, evenly between
        it and the robot: someone walks past. Both shares together are at most 1.
    glass_share : float, default 0
        Share of the walls that the range finder looks through, in squares of `PANE_M`.
    position_sigma_m, heading_sigma_rad : float, default 0
        Standard deviations of independent errors of each pose, along x and y, and of
        its heading.
    alpha_1, alpha_2, alpha_3, alpha_4 : float, default 0
        Drift of the odometry, from the first pose on: variance of a turn by turning
        (no unit) and by driving (rad^2/m^2), of a step by driving (no unit) and by
        turning (m^2/rad^2).

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.

    References
    ----------
    .. [1] S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", sec. 6.3 (ranges)
       and Table 5.6 (odometry).

    Examples
    --------
    >>> from occsim import ScanNoise
    >>> ScanNoise(metres_per_px=0.05, dropout_share=0.02).dropout_share
    0.02
    """

    metres_per_px: float
    sigma_0_m: float = bounded(0.0, Bounds(0.0, 0.3, 0.005), _ANY)
    sigma_2_per_m: float = bounded(0.0, Bounds(0.0, 0.02, 0.0001), _ANY)
    sigma_from_m: float = bounded(0.0, Bounds(0.0, 10.0, 0.1), _ANY)
    dropout_share: float = bounded(0.0, *_SHARE)
    short_share: float = bounded(0.0, *_SHARE)
    glass_share: float = bounded(0.0, Bounds(0.0, 1.0, 0.05))
    position_sigma_m: float = bounded(0.0, Bounds(0.0, 0.3, 0.01), _ANY)
    heading_sigma_rad: float = bounded(0.0, Bounds(0.0, np.pi / 18, np.pi / 360), _ANY)
    alpha_1: float = bounded(0.0, *_DRIFT)
    alpha_2: float = bounded(0.0, *_DRIFT)
    alpha_3: float = bounded(0.0, *_DRIFT)
    alpha_4: float = bounded(0.0, *_DRIFT)

    def __post_init__(self) -> None:
        scale = real_number("metres_per_px", self.metres_per_px)
        if not 0.0 < scale < np.inf:
            raise ParameterError(
                f"metres_per_px must be above 0 and finite; got {scale}"
            )
        object.__setattr__(self, "metres_per_px", scale)
        check_bounds(self)
        together = self.dropout_share + self.short_share
        if together > 1.0:
            raise ParameterError(
                f"dropout_share and short_share must not exceed 1 together; got "
                f"{together:g}"
            )

    @classmethod
    def bounds(cls, name: str) -> Bounds:
        """Return the range that a slider offers for an error; more is allowed.

        Raises
        ------
        ParameterError
            Where there is no error of that name.
        """
        return slider_of(cls, name, "error of a scan")

    def sigma_px(self, ranges_px: FloatArray | float) -> FloatArray:
        """Return the standard deviation of ranges, px, of the same shape."""
        z_m = np.asarray(ranges_px, dtype=np.float64) * self.metres_per_px
        beyond = np.maximum(z_m - self.sigma_from_m, 0.0)
        sigma_m = self.sigma_0_m + self.sigma_2_per_m * beyond**2
        return np.asarray(sigma_m / self.metres_per_px)

    @property
    def drifts(self) -> bool:
        """Whether the odometry drifts."""
        return any((self.alpha_1, self.alpha_2, self.alpha_3, self.alpha_4))


def without_glass(world: World, noise: ScanNoise, *, rng: np.random.Generator) -> World:
    """Return the walls that a range finder sees: those that are not glass.

    Parameters
    ----------
    world : World
        All walls.
    noise : ScanNoise
        Share of glass, and scale.
    rng : numpy.random.Generator
        Says which squares of `PANE_M` are glass.

    Returns
    -------
    World
        Squares are taken until they hold the share of wall pixels, the last one only
        if that comes nearer.
    """
    if not noise.glass_share:
        return world
    pane_px = max(round(PANE_M / noise.metres_per_px), 1)
    row, col = np.nonzero(world.occupied)
    pane = row // pane_px * (world.shape[1] // pane_px + 1) + col // pane_px
    _, pane, n_pixels = np.unique(pane, return_inverse=True, return_counts=True)
    order = rng.permutation(n_pixels.size)
    taken = n_pixels[order].cumsum()
    wanted = noise.glass_share * row.size
    is_glass = np.zeros(n_pixels.size, dtype=np.bool_)
    is_glass[order[taken - 0.5 * n_pixels[order] <= wanted]] = True
    seen = world.occupied.copy()
    seen[row, col] = ~is_glass[pane]
    return World(seen)


def noisy_ranges(
    ranges_px: FloatArray,
    max_range_px: float,
    noise: ScanNoise,
    *,
    rng: np.random.Generator,
) -> FloatArray:
    """Return measured ranges.

    Parameters
    ----------
    ranges_px : ndarray of float64, shape (S, B)
        True ranges; infinity is no return.
    max_range_px : float
        What would lie beyond it gives no return.
    noise : ScanNoise
        Errors of ranges.
    rng : numpy.random.Generator
        Draws the same numbers for each beam whatever the errors are, so that two
        settings differ by their settings alone.

    Returns
    -------
    ndarray of float64, shape (S, B)
    """
    error, what, where = (
        draw(ranges_px.shape) for draw in (rng.standard_normal, rng.random, rng.random)
    )
    is_hit = np.isfinite(ranges_px)
    true = np.where(is_hit, ranges_px, max_range_px)
    measured = np.maximum(true + error * noise.sigma_px(true), 0.0)
    measured[~is_hit | (measured > max_range_px)] = np.inf
    dropped = what < noise.dropout_share
    measured[dropped] = np.inf
    short = ~dropped & (what < noise.dropout_share + noise.short_share)
    measured[short] = (where * true)[short]
    return measured


def estimated_poses(
    poses: FloatArray, noise: ScanNoise, *, rng: np.random.Generator
) -> FloatArray:
    """Return where a robot believes to be.

    Parameters
    ----------
    poses : ndarray of float64, shape (S, 3)
        x_px, y_px, theta_rad, true.
    noise : ScanNoise
        Drift of the odometry, which starts at the first pose, and independent errors
        on top of it.
    rng : numpy.random.Generator
        Draws the same numbers whatever the errors are.

    Returns
    -------
    ndarray of float64, shape (S, 3)
        The poses as they are where the noise has no errors of poses.
    """
    drift, error = (rng.standard_normal((len(poses), 3)) for _ in range(2))
    if noise.drifts:
        poses = _drifted(poses, noise, drift[1:])
    xy_px = noise.position_sigma_m / noise.metres_per_px
    return poses + error * [xy_px, xy_px, noise.heading_sigma_rad]


def _drifted(poses: FloatArray, noise: ScanNoise, drawn: FloatArray) -> FloatArray:
    """Return poses as odometry counts them: Probabilistic Robotics, Table 5.6.

    Each motion is a turn, a step straight ahead and a second turn; each of the three
    has its own error, of the variances below.
    """
    dx, dy, turn = np.diff(poses, axis=0).T
    theta = poses[:-1, 2]
    step_m = np.hypot(dx, dy) * noise.metres_per_px
    moves = step_m > STANDING_M
    turn_1 = np.where(moves, wrap_angle(np.arctan2(dy, dx) - theta), 0.0)
    turn_2 = wrap_angle(turn - turn_1)
    # The table's lines 5 to 7.
    by_driving = noise.alpha_2 * step_m**2
    by_turning = noise.alpha_4 * (turn_1**2 + turn_2**2)
    step_m = step_m + drawn[:, 1] * np.sqrt(noise.alpha_3 * step_m**2 + by_turning)
    turn_1 = turn_1 + drawn[:, 0] * np.sqrt(noise.alpha_1 * turn_1**2 + by_driving)
    turn_2 = turn_2 + drawn[:, 2] * np.sqrt(noise.alpha_1 * turn_2**2 + by_driving)
    # Lines 8 to 10, from pose to pose.
    counted = poses.copy()
    counted[1:, 2] = theta[0] + (turn_1 + turn_2).cumsum()
    along = counted[:-1, 2] + turn_1
    step_px = step_m / noise.metres_per_px
    counted[1:, 0] = poses[0, 0] + (step_px * np.cos(along)).cumsum()
    counted[1:, 1] = poses[0, 1] + (step_px * np.sin(along)).cumsum()
    return counted

"""What a sensor's errors do to maps: repeated with other seeds, with an interval."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import t as student_t

from occsim._types import FloatArray, Progress, ShortRepr
from occsim.errors import ParameterError, whole_number
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.prior import Prior
from occsim.run.run import MappingRun

CONFIDENCE = 0.95
MAX_SEEDS = 1000


@dataclass(frozen=True, eq=False, repr=False)
class NoiseEffect(ShortRepr):
    """A score without the errors and, seed by seed, with them.

    Parameters
    ----------
    exact : float
        The score of the same beams without errors.
    noisy : ndarray of float64, shape (N,)
        The score with the errors of each seed.
    """

    exact: float
    noisy: FloatArray

    @property
    def mean(self) -> float:
        """Mean over the seeds."""
        return float(self.noisy.mean())

    @property
    def change(self) -> float:
        """Mean change that the errors make."""
        return self.mean - self.exact

    @property
    def half_width(self) -> float:
        """Half of the 95 % interval of the mean: Student's t with N - 1 degrees."""
        n = self.noisy.size
        spread = float(self.noisy.std(ddof=1)) / np.sqrt(n)
        return float(student_t.ppf(0.5 + 0.5 * CONFIDENCE, n - 1) * spread)


def noise_effect(
    run: MappingRun,
    priors: Sequence[Prior],
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
    *,
    n_seeds: int = 10,
    on_progress: Progress | None = None,
) -> list[NoiseEffect]:
    """Return what the errors of a run do to the F2 of the maps of some priors.

    Parameters
    ----------
    run : MappingRun
        Its settings must ask for scans with noise.
    priors : sequence of Prior
        All are tried on the same scans.
    rule, region
        As in `MappingRun.scores`.
    n_seeds : int, default 10
        Seeds 0 to N - 1, 2 to 1,000.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` after each seed.

    Returns
    -------
    list of NoiseEffect
        One for each prior.

    Raises
    ------
    ParameterError
        Where the run has no errors, or a value lies outside its domain.

    Examples
    --------
    >>> from occsim import MapSettings, MappingRun, Prior, ScanNoise, ScanSettings
    >>> from occsim import load_sample
    >>> from occsim.run import noise_effect
    >>> noise = ScanNoise(metres_per_px=0.045, sigma_0_m=0.1)
    >>> scan = ScanSettings(n_beams=20, noise=noise)
    >>> sample = load_sample("d")
    >>> run = MappingRun(sample, MapSettings(sensor=sample.sensor, scan=scan))
    >>> [blank] = noise_effect(run, [Prior.uninformative()], n_seeds=2)
    >>> blank.change < 0
    True
    """
    n_seeds = whole_number("n_seeds", n_seeds, 2, MAX_SEEDS)
    scan = run.settings.scan
    if scan is None or scan.noise is None:
        raise ParameterError("the run's settings must have scan with noise; got none")

    def scores_of(seed: int | None) -> list[float]:
        own = replace(scan, noise=None) if seed is None else replace(scan, seed=seed)
        settings = replace(run.settings, scan=own)
        one = MappingRun(run.building, settings, prior_mask=run.prior_mask)
        return [one.scores(prior, rule, region).f2 for prior in priors]

    exact, noisy = scores_of(None), []
    for seed in range(n_seeds):
        noisy.append(scores_of(seed))
        if on_progress is not None:
            on_progress(seed + 1, n_seeds)
    return [
        NoiseEffect(without, np.array(with_errors))
        for without, with_errors in zip(exact, zip(*noisy, strict=True), strict=True)
    ]

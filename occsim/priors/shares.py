"""How many individuals of each front controlled elitism keeps."""

from collections.abc import Sequence

import numpy as np


def geometric_shares(sizes: Sequence[int], n_survive: int, ratio: float) -> list[int]:
    """Return how many individuals of each front survive, geometrically fewer.

    Front i of K may keep N_i = N (1 - r) / (1 - r^K) r^(i - 1) of N survivors; places
    that a smaller front leaves empty pass to the next [1]_. Places that remain at the
    end are filled from the first front on.

    Parameters
    ----------
    sizes : sequence of int
        Individuals in each front, best front first, N or more in all.
    n_survive : int
        Number N of survivors.
    ratio : float
        r, in (0, 1).

    Returns
    -------
    list of int
        Survivors of each front; they sum to N.

    References
    ----------
    .. [1] K. Deb and T. Goel, EMO 2001, doi 10.1007/3-540-44719-9_5.
    """
    k = len(sizes)
    ideal = n_survive * (1 - ratio) / (1 - ratio**k) * ratio ** np.arange(k)
    kept: list[int] = []
    passed_on = 0.0
    for size, share in zip(sizes, ideal, strict=True):
        allowed = share + passed_on
        # Rounding errors are passed on too, so that the shares keep their sum.
        kept.append(min(size, int(np.floor(allowed + 0.5)), n_survive - sum(kept)))
        passed_on = allowed - kept[-1]
    for i, size in enumerate(sizes):
        kept[i] += min(size - kept[i], n_survive - sum(kept))
    return kept

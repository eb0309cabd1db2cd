"""What more laps of the same tour would do to a map."""

from occsim.errors import expect, whole_number
from occsim.evidence_log import EvidenceTotals
from occsim.mapping import UpdateRule, fuse
from occsim.metrics import Region, Scores, score
from occsim.prior import Prior
from occsim.run.run import MappingRun

MAX_LAPS = 1_000


def lap_scores(
    run: MappingRun,
    prior: Prior,
    laps: int,
    rule: UpdateRule = UpdateRule.PRIOR_ONCE,
    region: Region = Region.EXPLORED,
) -> Scores:
    """Return how good a map is after some laps of the run's tour.

    Poses and sensor are exact, so each lap adds the same readings again.

    Parameters
    ----------
    run : MappingRun
        One lap.
    prior : Prior
        What the map starts from.
    laps : int
        1 to 1,000.
    rule : UpdateRule, default UpdateRule.PRIOR_ONCE
        How a reading enters the map.
    region : Region, default Region.EXPLORED
        Which cells count.

    Returns
    -------
    Scores
        With one lap, those of ``run.scores``.

    Raises
    ------
    TypeError, ParameterError
        Where an argument is of another type or out of bounds.

    Examples
    --------
    >>> from occsim import MapSettings, load_sample
    >>> sample = load_sample("c")
    >>> run = MappingRun(sample, MapSettings(cell_px=5, sensor=sample.sensor))
    >>> lap_scores(run, Prior(), 1) == run.scores(Prior())
    True
    """
    expect("run", run, MappingRun)
    n = whole_number("laps", laps, 1, MAX_LAPS)
    sums, counts = run.evidence.totals()
    seen = EvidenceTotals(run.grid, n * sums, n * counts)
    return score(fuse(seen, run.prior_map(prior), rule), run.truth_cells, region)

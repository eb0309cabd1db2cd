"""Print what a drawing is worth on the five samples: ``python -m tests.findings``.

The figures that the lessons and the changelog quote, computed again.
"""

from dataclasses import replace

from occsim import (
    BehindHit,
    MappingRun,
    MapSettings,
    Prior,
    Region,
    UpdateRule,
    load_sample,
    log_loss,
    prior_drawing,
    sample_names,
)

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
BLANK = Prior.uninformative()
MAPS = {
    "blank": (BLANK, ONCE),
    "subtract": (Prior(), SUBTRACT),
    "once": (Prior(), ONCE),
}
SHARES = (0.1, 0.25, 0.5, 1.0)


def run_of(name: str, behind_hit: BehindHit = BehindHit.OCCUPIED) -> MappingRun:
    """A sample with cells of 3 px and its own sensor."""
    sample = load_sample(name)
    sensor = replace(sample.sensor, behind_hit=behind_hit)
    return MappingRun(sample, MapSettings(cell_px=3, sensor=sensor))


def f2_row(run: MappingRun, prior: Prior, rule: UpdateRule) -> str:
    """F2 in percent, looked at | all cells, after each share of the readings."""
    n = run.evidence.n_readings
    cells = []
    for share in SHARES:
        step = round(share * n)
        looked, everywhere = (
            100 * run.scores(prior, rule, region, step).f2
            for region in (Region.EXPLORED, Region.ALL)
        )
        cells.append(f"{looked:5.1f} | {everywhere:5.1f}")
    return "   ".join(cells)


def bits_row(run: MappingRun, prior: Prior, rule: UpdateRule) -> str:
    """Bits per cell over all cells at reading 0, a quarter, all."""
    n = run.evidence.n_readings
    truth = run.truth_cells
    steps = (0, n // 4, n)
    return ", ".join(f"{log_loss(run.map(prior, rule, s), truth):.2f}" for s in steps)


def pairs_row(run: MappingRun) -> str:
    """Calibrated and best pair with their bits, and those of the blank map."""
    wall, space = run.calibrated
    prior = Prior(p_wall=wall, p_space=space, scale=1.0)
    own = log_loss(run.map(prior), run.truth_cells)
    best = run.best_in_bits()
    blank = log_loss(run.map(BLANK), run.truth_cells)
    return (
        f"calibrated ({wall:.3f}, {space:.4f}) {own:.4f} bits; best "
        f"({best[0]:.3f}, {best[1]:.4f}) {best[2]:.4f} bits; blank {blank:.3f} bits"
    )


def line_up(name: str, drawings: tuple[str, ...], rule: UpdateRule) -> str:
    """F2 looked at with the drawing of each building as the prior."""
    run = run_of(name)
    masks = {which: prior_drawing(run.building, which) for which in drawings}
    return ", ".join(
        f"{which} {100 * run.with_prior_mask(mask).scores(Prior(), rule).f2:.1f}"
        for which, mask in masks.items()
    )


def main() -> None:
    """Print every table."""
    print("F2 in percent, looked at | all cells, at 10, 25, 50, 100 % of the readings")
    for name in sample_names():
        run = run_of(name)
        for what, (prior, rule) in MAPS.items():
            print(f"{name} {what:9}{f2_row(run, prior, rule)}")
    print("\nBits per cell, unseen behind a hit, at reading 0, a quarter, all")
    for name in sample_names():
        run = run_of(name, BehindHit.UNSEEN)
        for what, (prior, rule) in MAPS.items():
            print(f"{name} {what:9}{bits_row(run, prior, rule)}")
    print("\nPriors that state probabilities, counted once, all cells")
    for name in sample_names():
        print(f"{name} {pairs_row(run_of(name))}")
    print("\nBuilding c, F2 looked at by drawing")
    for rule in (ONCE, SUBTRACT):
        print(f"{rule.value}: {line_up('c', ('own', 'd', 'e', 'mirrored'), rule)}")


if __name__ == "__main__":
    main()

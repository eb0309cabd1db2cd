"""Kept mutations of drawings' errors, proper scores and what follows from them."""

from tests.mutate.mutation import Mutation

FLAWS = ("tests/test_flaws.py",)
SCORES = ("tests/test_proper_scores.py",)
LOSS = ("tests/test_loss.py",)
CURVES = ("tests/test_metrics.py",)

PROPER: tuple[Mutation, ...] = (
    Mutation(
        "occsim/flaws/thickness.py",
        "return one_group & two & ~near[side]",
        "return one_group & ~near[side]",
        FLAWS,
        "the ends of lines are kept",
    ),
    Mutation(
        "occsim/flaws/thickness.py",
        "return one_group & two & ~near[side]",
        "return two & ~near[side]",
        FLAWS,
        "the last link between two walls is kept",
    ),
    Mutation(
        "occsim/flaws/thickness.py",
        "in (0, 4, 6, 2):",
        "in (0, 4, 6):",
        FLAWS,
        "all four sides are thinned",
    ),
    Mutation(
        "occsim/flaws/moving.py",
        "forth = b * col + a * row + shift[0], a * col - b * row + shift[1]",
        "forth = a * row - b * col + shift[0], a * col + b * row + shift[1]",
        FLAWS,
        "a sheet turns from x towards y",
    ),
    Mutation(
        "occsim/flaws/moving.py",
        "        walls = _bridged(walls)\n",
        "        pass\n",
        FLAWS,
        "a slanting line is not broken by turning",
    ),
    Mutation(
        "occsim/flaws/moving.py",
        "moved.ravel()[np.flatnonzero(near)[inside]] = walls.ravel()[at]",
        "pass",
        FLAWS,
        "a pixel is wall too where its own centre falls into a wall",
    ),
    Mutation(
        "occsim/flaws/pieces.py",
        "PIECE_IN_WALLS = 5\n",
        "PIECE_IN_WALLS = 9\n",
        FLAWS,
        "a missing piece is about a door long",
    ),
    Mutation(
        "occsim/flaws/pieces.py",
        "if (taken[place] & piece).any():",
        "if False:",
        FLAWS,
        "false walls stand in free space",
    ),
    Mutation(
        "occsim/metrics/counts.py",
        "explored if self is Region.EXPLORED else ~explored",
        "explored",
        CURVES,
        "cells not looked at are others than those looked at",
    ),
    Mutation(
        "occsim/metrics/curves.py",
        "change -= surprise_bits(before, wall) * left",
        "change -= surprise_bits(before, wall)",
        CURVES,
        "a cell enters the explored ones with no earlier loss",
    ),
    Mutation(
        "occsim/metrics/proper.py",
        "np.where(wall, log_odds, np.negative(log_odds))",
        "np.where(wall, np.negative(log_odds), log_odds)",
        SCORES,
        "what is true is what should be probable",
    ),
    Mutation(
        "occsim/metrics/proper.py",
        'log_odds, side="right")',
        'log_odds, side="left")',
        SCORES,
        "a bin holds its lower bound",
    ),
    Mutation(
        "occsim/metrics/proper.py",
        "gap @ self.count[used], self.count.sum()",
        "gap.sum(), used.sum()",
        SCORES,
        "bins weigh by their cells in the calibration error",
    ),
    Mutation(
        "occsim/metrics/worth.py",
        "theirs >= ours[n] - SAME_SCORE",
        "theirs > ours[n] + SAME_SCORE",
        ("tests/test_worth.py",),
        "at least as good is enough",
    ),
    Mutation(
        "occsim/priors/loss.py",
        "np.unique(sums + 1j * weight, return_counts=True)",
        "np.unique(sums + 0j * weight + 1j, return_counts=True)",
        LOSS,
        "cells of other numbers of readings are not the same",
    ),
    Mutation(
        "occsim/priors/loss.py",
        "new = level - step if low < level - step < high else 0.5 * (low + high)",
        "new = level - step",
        LOSS,
        "the search stays in its bracket",
    ),
    Mutation(
        "occsim/prior.py",
        "((int(n) + 1) / (int(of) + 2) for n, of in counts)",
        "((int(n) + 1) / (int(of) + 1) for n, of in counts)",
        SCORES,
        "a calibrated prior is never certain",
    ),
    Mutation(
        "occsim/run/run.py",
        "replace(self, log=log, prior_mask=mask, prior_unknown=unknown)",
        "replace(self, prior_mask=mask, prior_unknown=unknown)",
        ("tests/test_run.py",),
        "another prior does not simulate the readings again",
    ),
)

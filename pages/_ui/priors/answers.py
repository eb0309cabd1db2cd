"""Answers to "which prior is best?", each to a question of its own."""

from collections.abc import Mapping
from dataclasses import dataclass

from occsim import Prior, Region, UpdateRule
from occsim.priors import recommend
from pages._ui import state
from pages._ui.choices import Handover
from pages._ui.priors import solving
from pages._ui.runs import Run


@dataclass(frozen=True, slots=True)
class Answer:
    """A prior, the rule of its map, and the question that it answers.

    ``prior`` is None where the question has no answer.
    """

    kind: Handover
    question: str
    prior: Prior | None
    rule: UpdateRule


QUESTIONS: Mapping[Handover, str] = {
    Handover.CALIBRATED: "How often is a cell of the drawing free in truth? Needs no "
    "reading.",
    Handover.BITS: "Which prior gives the final map the fewest bits per cell, over all "
    "cells?",
    Handover.ONCE: "Which pair of the Pareto front has the highest F2 on the cells "
    "looked at?",
    Handover.SUBTRACT: "The same, with the drawing taken off at every reading (the "
    "source, as we reconstruct it).",
    Handover.CHOSEN: "The pair that you chose on this page or another.",
}


def all_answers(run: Run) -> list[Answer]:
    """Every answer for a run, the recommended one first."""
    once, subtract = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
    found = {
        Handover.CALIBRATED: (solving.calibrated(run), once),
        Handover.BITS: (solving.best_in_bits(run, once), once),
        Handover.ONCE: (best_f2(run, once), once),
        Handover.SUBTRACT: (best_f2(run, subtract), subtract),
        Handover.CHOSEN: (state.prior(), state.settings().rule),
    }
    return [
        Answer(kind, QUESTIONS[kind], prior, rule)
        for kind, (prior, rule) in found.items()
    ]


def best_f2(
    run: Run, rule: UpdateRule, region: Region = Region.EXPLORED
) -> Prior | None:
    """The pair with the highest F2 within set C of a front; None if that is empty."""
    front = run.mapped.front(rule, region)
    index = recommend(front, state.settings().min_recall)
    if index is None:
        return None
    pair = front.p_wall[index], front.p_space[index]
    return Prior(p_wall=float(pair[0]), p_space=float(pair[1]))


def handed_over(answers: list[Answer]) -> Answer:
    """The answer that was asked for; the recommended one where it has no prior."""
    wanted = state.settings().handover
    return next(
        (one for one in answers if one.kind is wanted and one.prior is not None),
        answers[0],
    )

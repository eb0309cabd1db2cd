"""Sentences on a front and on the marked priors, each computed from what is shown."""

from occsim import Prior
from occsim.prior import SOURCE_PAIR
from occsim.priors import recommend, set_c
from pages._ui.priors import fronts, maps
from pages._ui.priors.marks import CALIBRATED, IN_BITS, MarkedPrior
from pages._ui.priors.scores import BLANK
from pages._ui.runs import Run
from pages._ui.words import number, percent


def front_text(run: Run) -> str:
    """How long a front is, what that means, and which pairs lie on it."""
    pairs, points = fronts.pairs_of(run.front), fronts.scores_at(run.front)
    if not pairs:
        return "No pair of priors finds a wall: there is no front."
    if len(pairs) == 1:
        pair = maps.pair_text(*pairs[0])
        return (
            f"One point: {pair} attains the highest precision and the highest recall "
            f"of all pairs, so nothing has to be given up. {_direction(pairs[0])}"
        )
    first, last = points[0], points[-1]
    return (
        f"{len(pairs)} points: to raise recall from {percent(first[1])} to "
        f"{percent(last[1])}, precision falls from {percent(first[0])} to "
        f"{percent(last[0])}. {_negatives(pairs)}"
    )


def found_text(found: Run) -> str:
    """How long the front of the drawing without errors is, to compare with."""
    n = len(found.front)
    return f"With the drawing as it is, this front has {n} point{'s' * (n != 1)}."


def _direction(pair: fronts.Pair) -> str:
    if fronts.is_negative(pair):
        return (
            "But p_wall is above p_space: this prior is the drawing's negative, which "
            "calls drawn walls free rather than the space between them."
        )
    if fronts.is_constant(pair):
        return "But it knows nothing of the drawing: p_wall equals p_space."
    return "It agrees with the drawing: p_wall is below p_space."


def _negatives(pairs: list[fronts.Pair]) -> str:
    said = []
    for is_so, words in (
        (fronts.is_negative, "p_wall above p_space: the drawing's negative"),
        (fronts.is_constant, "p_wall equal to p_space: nothing of the drawing"),
    ):
        n = sum(map(is_so, pairs))
        if n:
            which = "All" if n == len(pairs) else f"{n} of them"
            said.append(f"{which} {'has' if which == '1 of them' else 'have'} {words}.")
    return " ".join(said) or "All agree with the drawing: p_wall is below p_space."


def recommended_text(run: Run, min_recall: float) -> str:
    """How much of the front is in set C, and the pair with the best F2 there."""
    best = recommend(run.front, min_recall)
    if best is None:
        return "Set C is empty: no point of the front has a recall above its bound."
    n_inside = len(set_c(run.front, min_recall))
    pair = maps.pair_text(*fronts.pairs_of(run.front)[best])
    return f"{n_inside} in set C (full marks); {pair} has the highest F2 of them."


def source_text(run: Run) -> str:
    """Where the source's pair lies beside the blank map."""
    source, blank = run.scores(Prior()), run.scores(BLANK)
    change = tuple(
        # As shown: to a tenth of a point, and without a negative zero.
        round(100.0 * (getattr(source, name) - getattr(blank, name)), 1) + 0.0
        for name in ("precision", "recall")
    )
    pair = maps.pair_text(*SOURCE_PAIR)
    if any(value != value for value in change):
        return f"The source's {pair} cannot be compared with the blank map."
    first, second = (number(one, "+.1f") for one in change)
    gains = f"precision {first}, recall {second} points"
    return f"Beside the blank map the source's {pair} is {_verdict(change)}: {gains}."


def _verdict(change: tuple[float, ...]) -> str:
    first, second = ((value > 0.0) - (value < 0.0) for value in change)
    said = {-1: "worse", 0: "level", 1: "better"}
    if first == second:
        return f"{said[first]} in both scores"
    return f"{said[first]} in precision and {said[second]} in recall"


def distance_text(run: Run, prior: Prior) -> str:
    """How far the chosen pair is from the front; empty where that is undefined."""
    gap = fronts.distance(run.front, run.scores(prior))
    if gap == 0.0:
        return "The chosen pair is on the front."
    if gap > 0.0:
        return (
            "The chosen pair is off the front: the nearest point is better by up to "
            f"{100 * gap:.1f} points."
        )
    return ""


def marks_text(marked: list[MarkedPrior]) -> str:
    """The values of the marked priors that differ between drawings and rules."""
    said = [one.text for one in marked if one.name in (CALIBRATED, IN_BITS)]
    return f"p_free on wall cells and elsewhere: {'; '.join(said)}."

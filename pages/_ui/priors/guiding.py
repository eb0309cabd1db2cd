"""The steps of the page "Best prior", and what a mapping step costs."""

from collections.abc import Mapping
from dataclasses import asdict

import streamlit as st

from occsim import Prior, PriorMap, UpdateRule, coverage, log_loss, score
from occsim.io.images import drawing_png, mask_png
from occsim.io.prior_map import (
    Plain,
    prior_csv,
    prior_json,
    prior_npy,
    prior_png,
)
from occsim.priors import set_c
from pages._ui import compute, controls, palette, shell, state, words
from pages._ui.choices import CHOICES, FrontAxes, Handover, Picture
from pages._ui.controls import chart
from pages._ui.priors import front_figures, marks, reliability, scores, solving
from pages._ui.priors.answers import Answer, handed_over
from pages._ui.priors.front_figures import Mark
from pages._ui.runs import Run
from pages._ui.your_building import detecting


def drawing(run: Run) -> None:
    """Step 1: the architect's drawing."""
    building = run.building
    height, width = building.drawing.shape
    head(1, f"Drawing: {words.plain(building.title)}")
    st.image(drawing_png(building.drawing), width="stretch", alt="The drawing")
    st.caption(
        f"{width} × {height} px. Choose another above, or upload your own on the "
        "page *Your building*."
    )


def walls(run: Run) -> None:
    """Step 2: the walls found in it, which the prior is made of."""
    building = run.building
    head(2, "Walls of the prior")
    if run.has_errors:
        st.image(
            compute.errors_picture(building, run.settings),
            width="stretch",
            alt="The walls of the prior over those found in the drawing",
        )
        st.caption(controls.ERRORS_LEGEND)
        return
    st.image(mask_png(building.wall_mask), width="stretch", alt="The walls found")
    if building.truth is None:
        st.caption("There is no ground truth, so these walls serve as the world too.")
        return
    found = detecting.comparison(building)
    st.caption(
        f"By image processing, so with errors: {words.percent(found.precision)} of "
        f"these pixels are wall in truth, and {words.percent(found.recall)} of the "
        "true walls are found (within 2 px)."
    )


def evidence(run: Run) -> None:
    """Step 3: what the readings say, shown as the map without a drawing."""
    blank = Prior.uninformative()
    head(3, "Evidence of the readings")
    st.image(
        run.picture(blank, Picture.BELIEF),
        width="stretch",
        alt="The map of the uninformative prior",
    )
    share = words.percent(coverage(run.map(blank)))
    st.caption(
        f"{run.evidence.n_readings} readings saw {share} of the cells. Simulated once, "
        f"they serve every prior; without a drawing: {_short(run, blank)}."
    )


def front(run: Run, answers: list[Answer]) -> None:
    """Step 4: the best compromises of precision and recall, under one rule."""
    min_recall, chosen = state.settings().min_recall, handed_over(answers)
    run = run.under(chosen.rule)
    head(4, "Pareto front")
    figure = front_figures.front_figure(
        run.front, FrontAxes.SCORES, _marks(run, chosen), min_recall
    )
    st.plotly_chart(figure, config=chart("pareto_front"), key="path_front")
    n, n_inside = len(run.front), len(set_c(run.front, min_recall))
    st.caption(
        f"{n} point{'' if n == 1 else 's'}, exact; {n_inside} with a recall above "
        f"{min_recall:.2f} (set C). The rule is that of the answer to hand over: "
        f"{CHOICES[chosen.rule].lower()}."
    )


def _marks(run: Run, chosen: Answer) -> list[Mark]:
    wanted = [("blank map", Prior.uninformative(), "square", palette.UNSEEN)]
    if chosen.prior is not None:
        wanted.append(("handed over", chosen.prior, "circle-open", palette.MARK))
    scored = [(name, run.scores(p), symbol, color) for name, p, symbol, color in wanted]
    return [Mark(n, s.precision, s.recall, symbol, c) for n, s, symbol, c in scored]


def answer(run: Run, given: Answer) -> None:
    """One answer: its question, its prior, its map, and the scores of the map."""
    title = CHOICES[given.kind]
    recommended = given.kind is Handover.CALIBRATED
    st.markdown(f"**{title}{' (recommended)' if recommended else ''}**")
    st.caption(given.question)
    if given.prior is None:
        st.caption("Set C is empty, so no pair of the front can be recommended.")
        return
    under = run.under(given.rule)
    st.image(
        under.picture(given.prior, Picture.BELIEF),
        width="stretch",
        alt=f"The map of this answer: {title}",
    )
    st.markdown(words.maths(prior_text(given.prior)))
    if is_negative(given.prior):
        st.caption(
            "This prior is the negative of the drawing: it gives wall cells a higher "
            "probability of free than the others."
        )
    if given.kind is Handover.CALIBRATED:
        st.caption(words.maths(_estimate(run)))
    if given.kind is Handover.CHOSEN:
        for name in ("p_wall", "p_space"):
            controls.slider(name)


def _estimate(run: Run) -> str:
    if run.building.truth is None:
        return (
            "Estimated from the reference drawings, which have a ground truth; this "
            f"building has none.{_errors_of_others(run)}"
        )
    return (
        "Counted in this building's ground truth. Where there is none, the other "
        f"reference drawings estimate it: {prior_text(solving.estimated(run))}"
        f"{_errors_of_others(run)}"
    )


def _errors_of_others(run: Run) -> str:
    if not any(other.has_errors for other in solving.other_drawings(run)):
        return ""
    return " The errors that are set were given to those drawings too."


def scores_table(run: Run, answers: list[Answer]) -> str:
    """The scores of each answer's map, looked at and not; the blank map's below."""
    names = ("Precision", "Recall", "F2", "Bits per cell")
    heads = [
        f"{words.term(name)}, {words.term(where)}"
        for where in scores.COLUMNS.values()
        for name in names
    ]
    lines = [f"| Map | {' | '.join(heads)} |", "|---|" + "---:|" * len(heads)]
    for title, one in with_blank(answers):
        found = scores.values(run, one.prior, one.rule)
        cells = [value for of in found for value in of.shown().values()]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    return "\n".join(lines)


def with_blank(answers: list[Answer]) -> list[tuple[str, Answer]]:
    """The answers that have a prior with their titles, and no drawing as the last."""
    blank = Answer(Handover.CHOSEN, "", Prior.uninformative(), UpdateRule.PRIOR_ONCE)
    given = [(CHOICES[one.kind], one) for one in answers if one.prior is not None]
    return [*given, ("No drawing (blank map)", blank)]


def prior_text(prior: Prior) -> str:
    """The probabilities of free that a prior starts from."""
    return (
        f"p_free is {marks.shown(prior.p_free_wall)} on wall cells and "
        f"{marks.shown(prior.p_free_space)} elsewhere."
    )


def is_negative(prior: Prior) -> bool:
    """Whether a prior calls wall cells free rather than the others."""
    return prior.p_wall > prior.p_space


@shell.fragment
def transfer(run: Run, answers: list[Answer]) -> None:
    """Step 7: each answer on the other drawings, and on other tours."""
    st.markdown(transfer_table(run, answers))
    errors = any(other.has_errors for other in solving.other_drawings(run))
    same = ", with the same errors of the drawing" if errors else ""
    st.caption(
        "F2 of the cells looked at, and bits per cell over all cells (less is better). "
        "Other drawings: the mean over the reference drawings except the one shown, "
        f"each with its own walls and tour{same}. Other tours: the mean over an "
        "automatic tour of half as many readings at most and as many random poses, in "
        "this building."
    )


def transfer_table(run: Run, answers: list[Answer]) -> str:
    """F2 and bits of each answer here, on other drawings and on other tours."""
    places = solving.transfer_runs(run)
    heads = " | ".join(places)
    lines = [f"| Prior | {heads} |", "|---|" + "---:|" * len(places)]
    for title, one in with_blank(answers):
        cells = (_mean_scores(runs, one) for runs in places.values())
        lines.append(f"| {title} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _mean_scores(runs: list[Run], of: Answer) -> str:
    """Mean F2 and bits over the runs in which they are defined."""
    made = [run.mapped.map(of.prior, of.rule) for run in runs]
    truths = [run.mapped.truth_cells for run in runs]
    pairs = list(zip(made, truths, strict=True))
    f2 = _mean([score(final, truth).f2 for final, truth in pairs])
    bits = _mean([log_loss(final, truth) for final, truth in pairs])
    return f"{words.percent(f2)}, {scores.bits(bits)} bits"


def _mean(values: list[float]) -> float:
    defined = [value for value in values if value == value]
    return sum(defined) / len(defined) if defined else float("nan")


def hand_over(run: Run, given: Answer) -> None:
    """Step 6: the prior map, to download; the drawing's negative after a warning."""
    prior = given.prior or Prior.uninformative()
    made = run.prior_map(prior)
    picture, files, honesty = st.columns(3, gap="large")
    with picture:
        st.image(prior_png(made), width="stretch", alt="The prior map")
    with files:
        st.markdown(words.maths(f"**{CHOICES[given.kind]}.** {prior_text(prior)}"))
        st.caption(
            f"{made.grid.n_rows} × {made.grid.n_cols} cells of {made.grid.cell_px} px."
        )
        if not is_negative(prior) or _is_accepted(given.rule):
            _downloads(run, given, made)
        _use_everywhere(prior)
        cost(run, prior)
    with honesty:
        st.markdown("**Does its map mean what it says?**")
        reliability.diagram(run, given)


OPPOSITE: Mapping[UpdateRule, str] = {
    UpdateRule.PRIOR_ONCE: "A robot that counts it once believes the opposite of what "
    "is drawn, which can help only where the drawing misleads.",
    UpdateRule.SUBTRACT_PRIOR: "It was chosen for a robot that takes the drawing off "
    "at every reading, which pushes a cell away from its prior from the second reading "
    "on. A robot that counts the drawing once, as Bayes' rule asks, must not start "
    "from it.",
}
"""What the negative of a drawing is for, by the rule of its map."""


def _is_accepted(rule: UpdateRule) -> bool:
    st.warning(
        "This prior map is the negative of the drawing: it gives drawn walls a higher "
        f"probability of free than the space between them. {OPPOSITE[rule]}"
    )
    return st.checkbox(
        "I know that this map is the negative of the drawing; show the downloads.",
        **state.bind_view("negative_accepted", False),
    )


def _downloads(run: Run, given: Answer, made: PriorMap) -> None:
    prior = given.prior or Prior.uninformative()
    settings = prior_json(made, prior, run.building.drawing, chosen_on(run, given))
    files = {
        "png": (prior_png(made), "image/png"),
        "npy": (prior_npy(made), "application/octet-stream"),
        "csv": (prior_csv(made), "text/csv"),
        "json": (settings, "application/json"),
    }
    with st.container(horizontal=True):
        for suffix, (data, mime) in files.items():
            st.download_button(
                suffix.upper(),
                data,
                file_name=f"prior_map.{suffix}",
                mime=mime,
                on_click="ignore",
                help="The settings that made it." if suffix == "json" else None,
            )


def _use_everywhere(prior: Prior) -> None:
    pair = state.nearest_pair(prior)
    st.button(
        "Use this pair on every page",
        on_click=state.choose_pair,
        args=pair,
        disabled=pair == state.pair(),
        help="The sliders of the other pages set p_free = 0.9 × p and end at p = 1, "
        f"so this becomes ({pair[0]:g}, {pair[1]:g}) there.",
    )


def chosen_on(run: Run, given: Answer) -> dict[str, Plain]:
    """The conditions under which the pair was chosen, for the settings file."""
    settings, prior = run.settings, given.prior or Prior.uninformative()
    found = run.under(given.rule).scores(prior)
    final = run.mapped.map(prior, given.rule)
    return {
        "building": run.building.title,
        "building_digest": run.building.digest,
        "has_ground_truth": run.building.truth is not None,
        "n_readings": run.evidence.n_readings,
        "range_px": settings.range_px,
        "fov_deg": settings.fov_deg,
        "behind_hit": settings.behind_hit.value,
        "clear_no_hit": settings.clear_no_hit,
        "wall_share": settings.wall_share,
        "truth_share": settings.truth_share,
        "prior_drawing": settings.prior_drawing.value,
        "flaws": asdict(settings.flaws),
        "update_rule": given.rule.value,
        "region": settings.region.value,
        "chosen_by": given.kind.value,
        "question": given.question,
        "set_c_min_recall": state.settings().min_recall,
        "n_front_points": len(run.mapped.front(given.rule)),
        "precision": found.precision,
        "recall": found.recall,
        "f2": found.f2,
        "bits_per_cell_all_cells": log_loss(final, run.mapped.truth_cells),
    }


@shell.fragment
def cost(run: Run, prior: Prior) -> None:
    """The measured cost of a mapping step with this prior and without one."""
    if not run.evidence.n_readings:
        return
    with_drawing, blank = solving.step_costs(run, [prior, Prior.uninformative()])
    st.caption(
        "**What does the prior cost while mapping?** Nothing: a step, the update of "
        "the cells of one reading, takes the same operations on the same cells with "
        f"any prior. Measured just now, fastest of {len(blank.seconds)} runs over "
        f"{run.evidence.n_readings} readings: {with_drawing.range_us[0]:.1f} µs with "
        f"this prior, {blank.range_us[0]:.1f} µs with the uninformative one."
    )


def head(number: int, title: str) -> None:
    """The heading of a step."""
    st.markdown(f"**{number}. {title}**")


def _short(run: Run, prior: Prior) -> str:
    found = run.scores(prior)
    return (
        f"precision {words.percent(found.precision)}, recall "
        f"{words.percent(found.recall)}, F2 {words.percent(found.f2)}"
    )

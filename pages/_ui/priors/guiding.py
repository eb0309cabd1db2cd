"""The six steps of the page "Best prior", and what a mapping step costs."""

import streamlit as st

from occsim import Prior, coverage
from occsim.io.images import drawing_png, mask_png
from occsim.io.prior_map import (
    Plain,
    prior_csv,
    prior_json,
    prior_npy,
    prior_png,
)
from occsim.priors import recommend, set_c
from pages._ui import compute, palette, shell, state, words
from pages._ui.choices import FrontAxes, Handover, Picture
from pages._ui.controls import CHART_CONFIG
from pages._ui.priors import front_figures, maps
from pages._ui.priors.front_figures import Mark
from pages._ui.runs import Run


def recommended(run: Run) -> Prior | None:
    """The pair with the highest F2 within set C; None where set C is empty."""
    index = recommend(run.front, state.settings().min_recall)
    if index is None:
        return None
    pair = run.front.p_wall[index], run.front.p_space[index]
    return Prior(p_wall=float(pair[0]), p_space=float(pair[1]))


def handed_over(run: Run) -> Prior:
    """The prior that the path recommends, or the one chosen by hand."""
    best = recommended(run)
    if state.settings().handover is Handover.CHOSEN or best is None:
        return state.prior()
    return best


def drawing(run: Run) -> None:
    """Step 1: the architect's drawing."""
    building = run.building
    height, width = building.drawing.shape
    _head(1, f"Drawing: {words.plain(building.title)}")
    st.image(drawing_png(building.drawing), width="stretch", alt="The drawing")
    st.caption(
        f"{width} × {height} px. Choose another above, or upload your own on the "
        "page *Your building*."
    )


def walls(run: Run) -> None:
    """Step 2: the walls found in it, which the prior is made of."""
    building = run.building
    _head(2, "Walls found in it")
    st.image(mask_png(building.wall_mask), width="stretch", alt="The walls found")
    if building.truth is None:
        st.caption("There is no ground truth, so these walls serve as the world too.")
        return
    found = compute.comparison(building)
    st.caption(
        f"By image processing, so with errors: {words.percent(found.precision)} of "
        f"these pixels are wall in truth, and {words.percent(found.recall)} of the "
        "true walls are found (within 2 px)."
    )


def evidence(run: Run) -> None:
    """Step 3: what the readings say, shown as the map without a drawing."""
    blank = Prior.uninformative()
    _head(3, "Evidence of the readings")
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


def front(run: Run) -> None:
    """Step 4: the best compromises."""
    settings = state.settings()
    _head(4, "Pareto front of all priors")
    figure = front_figures.front_figure(
        run.front, FrontAxes.SCORES, _marks(run), settings.min_recall
    )
    st.plotly_chart(figure, config=CHART_CONFIG, key="path_front")
    n, n_inside = len(run.front), len(set_c(run.front, settings.min_recall))
    st.caption(
        f"{n} point{'' if n == 1 else 's'}, exact; {n_inside} with a recall above "
        f"{settings.min_recall:.2f} (set C)."
    )


def _marks(run: Run) -> list[Mark]:
    wanted = [
        ("uninformative", Prior.uninformative(), "square", palette.UNSEEN),
        ("handed over", handed_over(run), "circle-open", palette.MARK),
    ]
    scored = [(name, run.scores(p), symbol, color) for name, p, symbol, color in wanted]
    return [Mark(n, s.precision, s.recall, symbol, c) for n, s, symbol, c in scored]


def best_map(run: Run, prior: Prior) -> None:
    """Step 5: the pair, and the map that it gives."""
    is_recommended = prior == recommended(run)
    _head(5, "Recommended pair" if is_recommended else "Pair chosen by hand")
    if recommended(run) is None:
        st.caption("Set C is empty, so no pair can be recommended.")
    st.image(
        run.picture(prior, Picture.BELIEF), width="stretch", alt="The map of this pair"
    )
    pair = maps.pair_text(prior.p_wall, prior.p_space)
    why = "highest F2 within set C" if is_recommended else "see the explorer"
    st.caption(words.maths(f"(p_wall, p_space) = {pair}, {why}: {_short(run, prior)}."))
    maps.against_uninformative(run, prior)
    if prior.p_wall > prior.p_space:
        st.caption(
            "Caution: this prior is the negative of the drawing. It gives wall "
            "cells a higher probability of free than the others. It can win where "
            "the prior is subtracted at every reading, which pushes a cell away "
            "from its prior from the second reading on; no map should start from "
            "it. Compare with *Count the drawing once*."
        )
    st.button(
        "Use this pair on every page",
        on_click=state.choose_pair,
        args=(prior.p_wall, prior.p_space),
        disabled=prior == state.prior(),
    )


def prior_map(run: Run, prior: Prior) -> None:
    """Step 6: the prior map, to download."""
    made = run.prior_map(prior)
    _head(6, "Prior map")
    st.image(prior_png(made), width="stretch", alt="The prior map")
    st.caption(
        f"{words.maths('p_free')} is {prior.p_free_wall:.3g} on wall cells and "
        f"{prior.p_free_space:.3g} "
        f"elsewhere; {made.grid.n_rows} × {made.grid.n_cols} cells of "
        f"{made.grid.cell_px} px."
    )
    settings = prior_json(made, prior, run.building.drawing, chosen_on(run, prior))
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


def chosen_on(run: Run, prior: Prior) -> dict[str, Plain]:
    """The conditions under which the pair was chosen, for the settings file."""
    settings, scores = run.settings, run.scores(prior)
    best = prior == recommended(run)
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
        "update_rule": settings.rule.value,
        "region": settings.region.value,
        "chosen_by": "best F2 within set C" if best else "hand",
        "set_c_min_recall": state.settings().min_recall,
        "n_front_points": len(run.front),
        "precision": scores.precision,
        "recall": scores.recall,
        "f2": scores.f2,
    }


@shell.fragment
def cost(run: Run, prior: Prior) -> None:
    """The measured cost of a mapping step with this prior and without one."""
    if not run.evidence.n_readings:
        return
    with_drawing, blank = compute.step_costs(run, [prior, Prior.uninformative()])
    st.caption(
        "**What does the prior cost while mapping?** Nothing: a step, the update of "
        "the cells of one reading, takes the same operations on the same cells with "
        f"any prior. Measured just now, fastest of {len(blank.seconds)} runs over "
        f"{run.evidence.n_readings} readings: {with_drawing.range_us[0]:.1f} µs with "
        f"this prior, {blank.range_us[0]:.1f} µs with the uninformative one."
    )


def _head(number: int, title: str) -> None:
    st.markdown(f"**{number}. {title}**")


def _short(run: Run, prior: Prior) -> str:
    scores = run.scores(prior)
    return (
        f"precision {words.percent(scores.precision)}, recall "
        f"{words.percent(scores.recall)}, F2 {words.percent(scores.f2)}"
    )

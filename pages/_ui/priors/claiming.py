"""The section "Claims" of the page "Study": which claims hold, and when."""

from enum import Enum

import streamlit as st

from occsim import Building, OccsimError, Region, UpdateRule
from occsim.sensor import BehindHit
from occsim.study.claims import (
    CHOICES,
    CLAIMS,
    CONDITIONS,
    SOURCE_CONDITION,
    Condition,
    Count,
    Judged,
    Walls,
    behind,
    cases_csv,
    claims_json,
    counts_csv,
    judged,
    matching,
    tally,
)
from occsim.study.published import SOURCE_CELLS_PX
from pages._ui import shell, state, words
from pages._ui.priors import solving

LABELS = {
    "rule": "Update rule",
    "behind_hit": "Behind a hit",
    "region": "Scored cells",
    "walls": "Walls of the drawing",
    "readings": "Readings",
    "reach": "Range",
}
WORDS: dict[Enum, str] = {
    UpdateRule.SUBTRACT_PRIOR: "Taken off each reading",
    UpdateRule.PRIOR_ONCE: "Counted once",
    BehindHit.OCCUPIED: "Occupied",
    BehindHit.UNSEEN: "Unseen",
    Region.EXPLORED: "Looked at",
    Region.ALL: "All",
}
ANY = "Any"
ANSWERS = {True: "yes", False: "no", None: words.DASH}


@st.fragment
def section(drawings: list[Building]) -> None:
    """Count the claims when asked to, and show the counts."""
    st.markdown("## Claims")
    st.markdown(
        f"Each claim of the source, judged under {len(CONDITIONS)} conditions: the "
        "same drawings, other rules. A claim that holds under one condition only says "
        "more about the condition than about the prior."
    )
    asked = tuple((drawing.digest, drawing.sensor) for drawing in drawings)
    if state.view("claims", None) != asked:
        label = "Judge the claims (about half a minute)"
        if not st.button(label, type="primary"):
            return
        state.set_view("claims", asked)
    results = _judged(drawings)
    counts = tally(results)
    st.markdown(verdict(counts))
    conditions = _filters()
    _counts(results, counts, conditions)
    _downloads(results, counts)


def _judged(drawings: list[Building]) -> list[Judged]:
    """All cases; those that are not yet known are computed, and a bar shows how far."""
    pairs = [(drawing, px) for drawing in drawings for px in SOURCE_CELLS_PX]
    bar = st.progress(0.0, "Judging the claims")
    cases, refused = [], {}
    for done, (drawing, cell_px) in enumerate(pairs):

        def show(part: int, whole: int, done: int = done) -> None:
            if part % 40 == 0:
                share = (done + part / whole) / len(pairs)
                bar.progress(share, f"{done} of {len(pairs)} cases judged")

        try:
            cases.append(solving.claims_case(drawing, cell_px, show))
        except OccsimError as error:
            refused[drawing.name] = str(error)
    bar.empty()
    for name, reason in refused.items():
        shell.say_error(f"Drawing {name} is left out: {reason}")
    return list(judged(cases))


def verdict(counts: dict[str, Count]) -> str:
    """What the counts say of pattern and method, in their own numbers."""
    thinned = Condition(walls=Walls.THINNED_2)
    once = Condition(rule=UpdateRule.PRIOR_ONCE)
    pair = words.maths("(p_wall, p_space) = (0.2, 0.9)")
    return (
        "**A pattern reproduced is not a method confirmed.** With the rule that we "
        "reconstruct for the source, recall peaks only with "
        f"{words.maths('p_space')} = 1 in {_of(counts['C2'], SOURCE_CONDITION)} cases "
        f"as the walls are found, and in {_of(counts['C2'], thinned)} if they are "
        f"thinned by 2 px. With those, {pair} raises F2 over no drawing in "
        f"{_of(counts['C11a'], thinned)}. Counted once, the pattern appears in "
        f"{_of(counts['C2'], once)}, and the pair raises F2 in "
        f"{_of(counts['C11a'], once)}."
    )


def _of(count: Count, condition: Condition) -> str:
    holds, applies, _ = count.over([condition])
    return f"{holds} of {applies}"


def _filters() -> tuple[Condition, ...]:
    chosen: dict[str, Enum | None] = {}
    with st.container(horizontal=True):
        for name, values in CHOICES.items():
            options = {_word(value): value for value in values}
            word = st.selectbox(
                LABELS[name],
                [*options, ANY],
                width=185,
                **state.bind_view(f"claims_{name}", next(iter(options))),
            )
            chosen[name] = options.get(word)
    return matching(chosen)


def _word(value: Enum) -> str:
    return WORDS.get(value) or str(value.value).capitalize()


def _counts(
    results: list[Judged], counts: dict[str, Count], conditions: tuple[Condition, ...]
) -> None:
    names = list(CLAIMS)
    over = [counts[name].over(conditions) for name in names]
    table = {
        "claim": names,
        "says": [claim.sentence for claim in CLAIMS.values()],
        "where": [claim.where for claim in CLAIMS.values()],
        "holds in": [holds for holds, _, _ in over],
        "of": [applies for _, applies, _ in over],
        "judged on": [claim.unit.value for claim in CLAIMS.values()],
        "mean value": [mean for *_, mean in over],
        "value": [claim.value for claim in CLAIMS.values()],
    }
    st.caption("Choose a row to see the cases behind its count.")
    event = st.dataframe(
        table,
        hide_index=True,
        height="content",
        on_select="rerun",
        selection_mode="single-row",
        key="claims_table",
        column_config={"mean value": st.column_config.NumberColumn(format="%.3g")},
    )
    rows = event["selection"]["rows"]
    if rows:
        _behind(results, names[rows[0]], conditions)


def _behind(
    results: list[Judged], name: str, conditions: tuple[Condition, ...]
) -> None:
    cases = behind(results, name, conditions)
    data: dict[str, list[object]] = {
        "case": [case.label for case in cases],
        "holds": [ANSWERS[case.holds] for case in cases],
        CLAIMS[name].value: [case.value for case in cases],
    }
    for field, values in CHOICES.items():
        if len({getattr(condition, field) for condition in conditions}) == len(values):
            data[LABELS[field]] = [
                _word(getattr(case.condition, field)) for case in cases
            ]
    st.markdown(f"**{name}: {CLAIMS[name].sentence}**")
    st.dataframe(data, hide_index=True, key="claims_cases")


def _downloads(results: list[Judged], counts: dict[str, Count]) -> None:
    files = {
        "claims.csv": ("Counts (CSV)", lambda: counts_csv(counts)),
        "cases.csv": ("Cases (CSV)", lambda: cases_csv(results)),
        "claims.json": ("Counts and versions (JSON)", lambda: claims_json(counts)),
    }
    with st.container(horizontal=True):
        for name, (label, data) in files.items():
            st.download_button(label, data, file_name=name, on_click="ignore")
    st.caption("The same on a command line, for any drawings:")
    st.code("python -m occsim claims FOLDER --out results", language="bash")

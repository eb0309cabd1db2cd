"""A study as tables: Tables 4.1 and 4.2 beside the published ones, and its fronts."""

import csv
import io
from collections.abc import Iterable, Sequence

import numpy as np

from occsim.priors import MIN_RECALL, Objective
from occsim.study.published import PublishedMaximum, published_maximum
from occsim.study.run import LOW_SPACE, Pattern, StudyCase, pattern

_TITLES = {
    Objective.PRECISION: "Maximum precision (Table 4.1)",
    Objective.RECALL: "Maximum recall (Table 4.2)",
}

MAXIMA_COLUMNS = (
    "objective",
    "cell_px",
    "drawing",
    "percent",
    "pairs",
    "published_percent",
    "published_pairs",
)
"""Columns of `maxima_rows`; pairs are (p_wall, p_space)."""

FRONT_COLUMNS = (
    "drawing",
    "cell_px",
    "precision",
    "recall",
    "f2",
    "p_wall",
    "p_space",
    "p_wall_low",
    "p_wall_high",
    "p_space_low",
    "p_space_high",
    "in_set_c",
    "recommended",
)
"""Columns of `front_rows`."""

Row = tuple[str | int | float | bool, ...]


def maxima_rows(cases: Iterable[StudyCase]) -> list[Row]:
    """Return the maxima of all cases, beside the published ones.

    Parameters
    ----------
    cases : iterable of StudyCase
        In any order; rows come by objective and cell size.

    Returns
    -------
    list of tuple
        One row a case and objective, columns `MAXIMA_COLUMNS`; undefined percentages
        are NaN, as are the published ones of drawings other than the samples.
    """
    by_size = sorted(cases, key=lambda case: case.cell_px)
    rows: list[Row] = []
    for objective in Objective:
        for case in by_size:
            best = case.maxima(objective)
            printed = _printed(case, objective)
            percent, pairs = printed or (float("nan"), "")
            found = (100.0 * best.value, best.text)
            rows.append(
                (objective.value, case.cell_px, case.name, *found, percent, pairs)
            )
    return rows


def _printed(case: StudyCase, objective: Objective) -> PublishedMaximum | None:
    if not case.is_reference:
        return None
    return published_maximum(objective, case.cell_px, case.name)


def front_rows(cases: Iterable[StudyCase], min_recall: float = MIN_RECALL) -> list[Row]:
    """Return the points of all fronts.

    Parameters
    ----------
    cases : iterable of StudyCase
        In any order.
    min_recall : float, default 0.40
        Threshold of set C.

    Returns
    -------
    list of tuple
        One row a point, columns `FRONT_COLUMNS`.
    """
    rows: list[Row] = []
    for case in cases:
        front, chosen = case.front, case.recommended(min_recall)
        bounds = front.rectangles
        if bounds is None:
            bounds = np.full((len(front), 4), np.nan)
        columns = (
            front.precision.tolist(),
            front.recall.tolist(),
            front.f2.tolist(),
            front.p_wall.tolist(),
            front.p_space.tolist(),
            *bounds.T.tolist(),
            (front.recall > min_recall).tolist(),
            [i == chosen for i in range(len(front))],
        )
        points = zip(*columns, strict=True)
        rows += [(case.name, case.cell_px, *point) for point in points]
    return rows


def maxima_csv(cases: Iterable[StudyCase]) -> str:
    """Return `maxima_rows` as CSV text with a header; undefined is empty."""
    return _csv(MAXIMA_COLUMNS, maxima_rows(cases))


def fronts_csv(cases: Iterable[StudyCase], min_recall: float = MIN_RECALL) -> str:
    """Return `front_rows` as CSV text with a header; undefined is empty."""
    return _csv(FRONT_COLUMNS, front_rows(cases, min_recall))


def sweeps_csv(cases: Iterable[StudyCase]) -> str:
    """Return every pair of every case with its counts, as CSV text with a header."""
    rows: list[Row] = []
    for case in cases:
        sweep = case.sweep
        p_wall, p_space = np.meshgrid(sweep.p_wall, sweep.p_space, indexing="ij")
        counts = (sweep.tp, sweep.fp, sweep.fn, sweep.tn)
        tables = (p_wall, p_space, *counts, sweep.precision, sweep.recall)
        pairs = zip(*(table.ravel().tolist() for table in tables), strict=True)
        rows += [(case.name, case.cell_px, *pair) for pair in pairs]
    names = ("p_wall", "p_space", "tp", "fp", "fn", "tn", "precision", "recall")
    return _csv(("drawing", "cell_px", *names), rows)


def maxima_text(cases: Iterable[StudyCase]) -> str:
    """Return both tables of maxima as text for a terminal."""
    rows = maxima_rows(cases)
    parts = []
    for objective in Objective:
        lines = [("cell px", "drawing", "%", "at", "published %", "at")]
        for kind, cell_px, name, percent, pairs, printed, printed_at in rows:
            if kind == objective.value:
                numbers = (_percent(float(percent)), _percent(float(printed)))
                first = (str(cell_px), str(name), numbers[0], str(pairs))
                lines.append((*first, numbers[1], str(printed_at) or "–"))
        parts.append(f"{_TITLES[objective]}\n{_aligned(lines)}")
    return "\n\n".join(parts)


def pattern_text(cases: Iterable[StudyCase]) -> str:
    """Return sentences on how far the source's pattern appears."""
    found: Pattern = pattern(cases)
    n = found.n_cases
    return "\n".join(
        (
            f"Recall peaks with p_space = 1 in {found.recall_at_full_space} of {n} "
            f"cases, and nowhere else in {found.recall_only_at_full_space}.",
            f"Precision peaks with p_space at most {LOW_SPACE:g} in "
            f"{found.precision_at_low_space} of {n} cases, and nowhere else in "
            f"{found.precision_only_at_low_space}.",
            f"Precision and recall conflict, no pair attaining both maxima, in "
            f"{found.conflicts} of {n} cases.",
        )
    )


def _percent(value: float) -> str:
    return "–" if np.isnan(value) else f"{value:.2f}"


def _aligned(lines: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(
            cell.ljust(width) for cell, width in zip(line, widths, strict=True)
        ).rstrip()
        for line in lines
    )


def _csv(columns: Sequence[str], rows: Iterable[Row]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        writer.writerow(["" if _undefined(value) else value for value in row])
    return text.getvalue()


def _undefined(value: str | int | float | bool) -> bool:
    return isinstance(value, float) and np.isnan(value)

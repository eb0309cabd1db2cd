"""A study as tables: Tables 4.1 and 4.2 beside the published ones, and its fronts."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TextIO

import numpy as np

from occsim.errors import choice
from occsim.priors import MIN_RECALL, Objective
from occsim.study.published import PublishedMaximum, published_maximum
from occsim.study.run import LOW_SPACE, Pattern, StudyCase, pattern

_PLAIN_TITLES = {
    Objective.PRECISION: "Maximum precision",
    Objective.RECALL: "Maximum recall",
}
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

SWEEP_COLUMNS = (
    "drawing",
    "cell_px",
    "p_wall",
    "p_space",
    "tp",
    "fp",
    "fn",
    "tn",
    "precision",
    "recall",
)
"""Columns of `sweep_rows`."""

Row = tuple[str | int | float | bool, ...]


def maxima_rows(cases: Iterable[StudyCase]) -> Iterator[Row]:
    """Yield the maxima of all cases, beside the published ones.

    Parameters
    ----------
    cases : iterable of StudyCase
        Taken one at a time.

    Yields
    ------
    tuple
        Two rows a case, one an objective, columns `MAXIMA_COLUMNS`; undefined
        percentages are NaN, as are the published ones of drawings other than the
        samples.
    """
    for case in cases:
        for objective in Objective:
            best = case.maxima(objective)
            printed = _printed(case, objective)
            percent, pairs = printed or (float("nan"), "")
            found = (100.0 * best.value, best.text)
            yield (objective.value, case.cell_px, case.name, *found, percent, pairs)


def maxima_table(cases: Iterable[StudyCase], objective: Objective) -> list[Row]:
    """Return the rows of one objective by cell size, as the source prints them.

    Parameters
    ----------
    cases : iterable of StudyCase
        In any order.
    objective : Objective
        Precision (Table 4.1) or recall (Table 4.2).

    Returns
    -------
    list of tuple
        Columns `MAXIMA_COLUMNS`.
    """
    chosen = choice("objective", objective, Objective).value
    rows = (row for row in maxima_rows(cases) if row[0] == chosen)
    return sorted(rows, key=lambda row: int(row[1]))


def _printed(case: StudyCase, objective: Objective) -> PublishedMaximum | None:
    if not case.is_reference:
        return None
    return published_maximum(objective, case.cell_px, case.name)


def front_rows(
    cases: Iterable[StudyCase], min_recall: float = MIN_RECALL
) -> Iterator[Row]:
    """Yield the points of all fronts.

    Parameters
    ----------
    cases : iterable of StudyCase
        Taken one at a time.
    min_recall : float, default 0.40
        Threshold of set C.

    Yields
    ------
    tuple
        One row a point, columns `FRONT_COLUMNS`.
    """
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
        for point in zip(*columns, strict=True):
            yield (case.name, case.cell_px, *point)


def sweep_rows(cases: Iterable[StudyCase]) -> Iterator[Row]:
    """Yield every pair of every case with its counts.

    Parameters
    ----------
    cases : iterable of StudyCase
        Taken one at a time.

    Yields
    ------
    tuple
        Columns `SWEEP_COLUMNS`.
    """
    for case in cases:
        sweep = case.sweep
        p_wall, p_space = np.meshgrid(sweep.p_wall, sweep.p_space, indexing="ij")
        counts = (sweep.tp, sweep.fp, sweep.fn, sweep.tn)
        tables = (p_wall, p_space, *counts, sweep.precision, sweep.recall)
        for pair in zip(*(table.ravel().tolist() for table in tables), strict=True):
            yield (case.name, case.cell_px, *pair)


def maxima_csv(cases: Iterable[StudyCase]) -> str:
    """Return `maxima_rows` as CSV text with a header; undefined is empty."""
    return csv_text(MAXIMA_COLUMNS, maxima_rows(cases))


def fronts_csv(cases: Iterable[StudyCase], min_recall: float = MIN_RECALL) -> str:
    """Return `front_rows` as CSV text with a header; undefined is empty."""
    return csv_text(FRONT_COLUMNS, front_rows(cases, min_recall))


def sweeps_csv(cases: Iterable[StudyCase]) -> str:
    """Return `sweep_rows` as CSV text with a header; undefined is empty."""
    return csv_text(SWEEP_COLUMNS, sweep_rows(cases))


def maxima_text(cases: Iterable[StudyCase]) -> str:
    """Return both tables of maxima as text for a terminal.

    Parameters
    ----------
    cases : iterable of StudyCase
        Asked twice, so no iterator.

    Returns
    -------
    str
        Without the published columns where no case is a sample.
    """
    parts = []
    for objective in Objective:
        rows = maxima_table(cases, objective)
        lines = [("cell px", "drawing", "%", "at", "published %", "at")]
        for _, cell_px, name, percent, pairs, printed, printed_at in rows:
            numbers = (_percent(float(percent)), _percent(float(printed)))
            first = (str(cell_px), str(name), numbers[0], str(pairs))
            lines.append((*first, numbers[1], str(printed_at) or "–"))
        is_published = any(row[6] for row in rows)
        shown = lines if is_published else [line[:4] for line in lines]
        title = _TITLES[objective] if is_published else _PLAIN_TITLES[objective]
        parts.append(f"{title}\n{aligned(shown)}")
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


def aligned(lines: Sequence[Sequence[str]]) -> str:
    """Return lines of words as text in columns."""
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(
            cell.ljust(width) for cell, width in zip(line, widths, strict=True)
        ).rstrip()
        for line in lines
    )


def csv_text(columns: Sequence[str], rows: Iterable[Row]) -> str:
    """Return rows as CSV text with a header; undefined is empty."""
    text = io.StringIO()
    _write_rows(text, columns, rows)
    return text.getvalue()


def write_csv(path: Path, columns: Sequence[str], rows: Iterable[Row]) -> None:
    """Write rows as a CSV file with a header, as they come; undefined is empty."""
    with path.open("w", encoding="utf-8", newline="") as file:
        _write_rows(file, columns, rows)


def _write_rows(file: TextIO, columns: Sequence[str], rows: Iterable[Row]) -> None:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        writer.writerow(["" if _undefined(value) else value for value in row])


def _undefined(value: str | int | float | bool) -> bool:
    return isinstance(value, float) and np.isnan(value)

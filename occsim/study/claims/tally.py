"""How often each claim holds, and the cases behind each count."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import NamedTuple

import numpy as np

from occsim._types import BoolArray, FloatArray, IntArray
from occsim.study.batch import Document, software
from occsim.study.claims.case import ClaimsCase, Findings, findings_of
from occsim.study.claims.conditions import CONDITIONS, Condition, departures
from occsim.study.claims.judging import CLAIMS, pairs_in_common, peaks_move_little
from occsim.study.tables import Row, aligned, csv_text, write_csv

CONDITION_COLUMNS = tuple(one.name for one in fields(Condition))

COUNT_COLUMNS = ("claim", *CONDITION_COLUMNS, "holds", "of", "mean_value")
"""Columns of `count_rows`."""

CASE_COLUMNS = (
    "drawing",
    "cell_px",
    *CONDITION_COLUMNS,
    *(column for claim in CLAIMS for column in (claim, f"{claim}_value")),
)
"""Columns of `case_rows`."""


@dataclass(frozen=True, eq=False)
class Judged:
    """What claims come to on one case, one drawing or one cell size.

    Parameters
    ----------
    name : str
        Of the drawing; empty for a claim on a cell size.
    cell_px : int or None
        Cell size, px; None for a claim on a drawing.
    findings : dict
        `Findings` by the claim's number.
    """

    name: str
    cell_px: int | None
    findings: Mapping[str, Findings]

    @property
    def label(self) -> str:
        """Short name for a table."""
        size = "" if self.cell_px is None else f"{self.cell_px} px"
        return ", ".join(part for part in (self.name, size) if part)


@dataclass(frozen=True, eq=False)
class Count:
    """How often one claim holds, by condition.

    Parameters
    ----------
    holds, applies : ndarray of int64, shape (N,)
        Cases (drawings, cell sizes) in which it holds, and to which it applies, in the
        order of `CONDITIONS`.
    total : ndarray of float64, shape (N,)
        Sum of the values where it applies.
    """

    holds: IntArray
    applies: IntArray
    total: FloatArray

    @property
    def mean_value(self) -> FloatArray:
        """Mean of the values, (N,); NaN where the claim applies to nothing."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self.total / self.applies)

    def over(self, conditions: Sequence[Condition]) -> tuple[int, int, float]:
        """Return how often it holds, applies, and the mean value, of some conditions.

        Parameters
        ----------
        conditions : sequence of Condition
            Their counts are added.

        Returns
        -------
        holds, applies : int
        mean_value : float
            NaN where it applies to nothing.
        """
        at = [CONDITIONS.index(condition) for condition in conditions]
        holds, applies = int(self.holds[at].sum()), int(self.applies[at].sum())
        mean = float(self.total[at].sum()) / applies if applies else float("nan")
        return holds, applies, mean


def judged(cases: Iterable[ClaimsCase]) -> Iterator[Judged]:
    """Yield what the claims come to, of cases, of drawings and of cell sizes.

    Parameters
    ----------
    cases : iterable of ClaimsCase
        Taken one at a time; the cell sizes of a drawing follow one another.

    Yields
    ------
    Judged
        Every case; after the last case of a drawing, the drawing; at the end, every
        cell size.
    """
    common: dict[int, tuple[int, BoolArray]] = {}
    name, peaks = "", list[BoolArray]()
    for case in cases:
        if case.name != name:
            yield from _of_drawing(name, peaks)
            name, peaks = case.name, []
        yield Judged(case.name, case.cell_px, case.findings)
        peaks.append(case.peaks)
        n, near = common.get(case.cell_px, (0, np.ones_like(case.near)))
        common[case.cell_px] = n + 1, near & case.near
    yield from _of_drawing(name, peaks)
    for cell_px, (n, near) in sorted(common.items()):
        # What all have in common stands for each of them.
        found = [pairs_in_common(np.stack([pairs] * min(n, 2))) for pairs in near]
        yield Judged("", cell_px, {"C7": findings_of(found)})


def _of_drawing(name: str, peaks: Sequence[BoolArray]) -> Iterator[Judged]:
    if peaks:
        by_condition = np.stack(peaks, axis=1)
        found = [peaks_move_little(those) for those in by_condition]
        yield Judged(name, None, {"C10": findings_of(found)})


def tally(results: Iterable[Judged]) -> dict[str, Count]:
    """Return how often each claim holds.

    Parameters
    ----------
    results : iterable of Judged
        Taken one at a time.

    Returns
    -------
    dict
        `Count` by the claim's number, in the order of `CLAIMS`.
    """
    n = len(CONDITIONS)
    counts = {
        claim: Count(np.zeros(n, np.int64), np.zeros(n, np.int64), np.zeros(n))
        for claim in CLAIMS
    }
    for one in results:
        for claim, found in one.findings.items():
            count = counts[claim]
            count.holds[:] += [holds is True for holds in found.holds]
            count.applies[:] += [holds is not None for holds in found.holds]
            count.total[:] += np.nan_to_num(found.values)
    return counts


def count_rows(counts: Mapping[str, Count]) -> Iterator[Row]:
    """Yield the counts of every claim under every condition.

    Parameters
    ----------
    counts : dict
        From `tally`.

    Yields
    ------
    tuple
        Columns `COUNT_COLUMNS`.
    """
    for claim, count in counts.items():
        columns = count.holds, count.applies, count.mean_value
        numbers = zip(*(column.tolist() for column in columns), strict=True)
        for condition, row in zip(CONDITIONS, numbers, strict=True):
            yield (claim, *condition.words, *row)


def case_rows(results: Iterable[Judged]) -> Iterator[Row]:
    """Yield what is behind the counts: every case under every condition.

    Parameters
    ----------
    results : iterable of Judged
        Taken one at a time.

    Yields
    ------
    tuple
        Columns `CASE_COLUMNS`: yes or no and the value of each claim, empty where it
        does not apply. Claims on a drawing have rows without a cell size, claims on a
        cell size rows without a drawing.
    """
    for one in results:
        size = "" if one.cell_px is None else one.cell_px
        for i, condition in enumerate(CONDITIONS):
            cells: list[str | float] = []
            for claim in CLAIMS:
                found = one.findings.get(claim)
                holds = None if found is None else found.holds[i]
                value = float("nan") if found is None else float(found.values[i])
                cells += ["" if holds is None else ("yes" if holds else "no"), value]
            yield (one.name, size, *condition.words, *cells)


class Behind(NamedTuple):
    """One case behind a count."""

    label: str
    condition: Condition
    holds: bool | None
    """None where the claim does not apply."""
    value: float


def behind(
    results: Iterable[Judged], claim: str, conditions: Sequence[Condition]
) -> list[Behind]:
    """Return the cases behind a count.

    Parameters
    ----------
    results : iterable of Judged
        What the claims come to.
    claim : str
        The claim's number.
    conditions : sequence of Condition
        Those that were counted.

    Returns
    -------
    list of Behind
    """
    at = [CONDITIONS.index(condition) for condition in conditions]
    return [
        Behind(one.label, CONDITIONS[i], found.holds[i], float(found.values[i]))
        for one in results
        if (found := one.findings.get(claim)) is not None
        for i in at
    ]


def cases_csv(results: Iterable[Judged]) -> str:
    """Return `case_rows` as CSV text with a header."""
    return csv_text(CASE_COLUMNS, case_rows(results))


def counts_csv(counts: Mapping[str, Count]) -> str:
    """Return `count_rows` as CSV text with a header."""
    return csv_text(COUNT_COLUMNS, count_rows(counts))


def claims_json(counts: Mapping[str, Count]) -> str:
    """Return the claims, the conditions and the counts with all versions, as JSON."""
    document: Document = {
        "format": "occsim claims",
        "version": 1,
        "software": software(),
        "conditions": [
            dict(zip(CONDITION_COLUMNS, condition.words, strict=True))
            for condition in CONDITIONS
        ],
        "claims": {
            name: {
                "sentence": claim.sentence,
                "where": claim.where,
                "judged_on": claim.unit.value,
                "value": claim.value,
                "holds": counts[name].holds.tolist(),
                "of": counts[name].applies.tolist(),
                "mean_value": [
                    None if np.isnan(value) else round(value, 6)
                    for value in counts[name].mean_value.tolist()
                ],
            }
            for name, claim in CLAIMS.items()
        },
    }
    return json.dumps(document, allow_nan=False)


def save_claims(folder: Path, cases: Iterable[ClaimsCase]) -> dict[str, Count]:
    """Write counts and cases as CSV, and the counts as JSON; return the counts.

    Parameters
    ----------
    folder : Path
        An existing folder.
    cases : iterable of ClaimsCase
        Asked twice, so no iterator.

    Returns
    -------
    dict
        `Count` by the claim's number.
    """
    counts = tally(judged(cases))
    write_csv(folder / "claims.csv", COUNT_COLUMNS, count_rows(counts))
    write_csv(folder / "cases.csv", CASE_COLUMNS, case_rows(judged(cases)))
    (folder / "claims.json").write_text(claims_json(counts), encoding="utf-8")
    return counts


SOURCE_LEGEND = (
    "source: the conditions of the source, as we reconstruct them; its update rule, "
    "the drawing taken off at every reading, is inferred.\n"
    "Each other column differs from it in one condition; the last counts all."
)
"""What the columns of `claims_text` are."""

_SHORT = {
    "rule": {"prior_once": "once"},
    "behind_hit": {"unseen": "unseen"},
    "region": {"all": "all cells"},
    "walls": {
        "thinned by 1 px": "thin 1",
        "thinned by 2 px": "thin 2",
        "thinned by 3 px": "thin 3",
        "the true walls": "true",
    },
    "readings": {
        "every 2nd reading": "1 of 2",
        "every 4th reading": "1 of 4",
        "three laps": "3 laps",
    },
    "reach": {"doubled": "range x2"},
}


def claims_text(counts: Mapping[str, Count]) -> str:
    """Return the counts as text: the source's condition and what departs from it.

    Parameters
    ----------
    counts : dict
        From `tally`.

    Returns
    -------
    str
    """
    shown = departures()
    lines = [["", *map(_title, shown), f"all {len(CONDITIONS)}"]]
    for claim, count in counts.items():
        at = [CONDITIONS.index(condition) for condition in shown]
        cells = [f"{count.holds[i]}/{count.applies[i]}" for i in at]
        lines.append([claim, *cells, f"{count.holds.sum()}/{count.applies.sum()}"])
    legend = [
        f"{name}: {claim.sentence} ({claim.where})" for name, claim in CLAIMS.items()
    ]
    return "\n".join((aligned(lines), "", SOURCE_LEGEND, "", *legend))


def _title(condition: Condition) -> str:
    base = Condition()
    for name, words in _SHORT.items():
        value = getattr(condition, name)
        if value is not getattr(base, name):
            return words[value.value]
    return "source"

"""One case of the claims: every claim under every condition, as plain values."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from occsim._types import BoolArray, FloatArray
from occsim.building import Building
from occsim.priors import Objective
from occsim.study.batch import Document, Kind
from occsim.study.claims.conditions import CONDITIONS
from occsim.study.claims.facts import facts_of
from occsim.study.claims.judging import ON_A_CASE, Finding
from occsim.study.files import mapped_values

DIGITS = 6
"""Significant digits of a value in a file."""

_LETTERS = {True: "y", False: "n", None: "-"}
_ANSWERS: dict[str, bool | None] = {letter: a for a, letter in _LETTERS.items()}


@dataclass(frozen=True, eq=False)
class Findings:
    """What one claim comes to under all conditions.

    Parameters
    ----------
    holds : tuple of (bool or None)
        By condition, in the order of `CONDITIONS`; None where it does not apply.
    values : ndarray of float64, shape (N,)
        The numbers that decide it; NaN where it does not apply.
    """

    holds: tuple[bool | None, ...]
    values: FloatArray


@dataclass(frozen=True, eq=False)
class ClaimsCase:
    """One drawing at one cell size under all N conditions.

    Parameters
    ----------
    name : str
        The drawing's.
    cell_px : int
        Cell size, px.
    findings : dict
        `Findings` of each claim that one case decides, by its number.
    near : ndarray of bool, shape (N, 10, 10)
        Pairs of the sweep on the front, within 3 points.
    peaks : ndarray of bool, shape (N, 2, 10, 10)
        Pairs of the sweep with the best precision, and with the best recall.
    """

    name: str
    cell_px: int
    findings: dict[str, Findings]
    near: BoolArray
    peaks: BoolArray


def judge_case(
    building: Building,
    cell_px: int,
    on_progress: Callable[[int, int], None] | None = None,
) -> ClaimsCase:
    """Return every claim under every condition for one drawing at one cell size.

    Parameters
    ----------
    building : Building
        What is mapped, by its own sensor.
    cell_px : int
        Cell size, px.
    on_progress : callable, optional
        Called as ``on_progress(done, total)`` after each condition.

    Returns
    -------
    ClaimsCase

    Raises
    ------
    TrajectoryError
        Where no pose stands in free space.
    """
    found: dict[str, list[Finding]] = {claim: [] for claim in ON_A_CASE}
    near, peaks = [], []
    for done, facts in enumerate(facts_of(building, cell_px), start=1):
        for claim, judge in ON_A_CASE.items():
            found[claim].append(judge(facts))
        near.append(facts.near)
        peaks.append([facts.peak(objective) for objective in Objective])
        if on_progress is not None:
            on_progress(done, len(CONDITIONS))
    return ClaimsCase(
        name=building.name,
        cell_px=cell_px,
        findings={claim: findings_of(those) for claim, those in found.items()},
        near=np.array(near),
        peaks=np.array(peaks),
    )


def findings_of(found: list[Finding]) -> Findings:
    """Return the findings of one claim, condition by condition, as one object."""
    values = np.array([one.value for one in found], dtype=np.float64)
    return Findings(tuple(one.holds for one in found), values)


def claims_document(building: Building, cell_px: int, settings: object) -> Document:
    """Return what `judge_case` finds as plain values; `settings` are none."""
    case = judge_case(building, cell_px)
    return mapped_values(building) | {
        "has_truth": building.truth is not None,
        "answers": {
            claim: "".join(_LETTERS[answer] for answer in found.holds)
            for claim, found in case.findings.items()
        },
        "values": {
            claim: [_short(value) for value in found.values.tolist()]
            for claim, found in case.findings.items()
        },
        "near": _packed(case.near),
        "peaks": _packed(case.peaks),
    }


def read_claims(document: Document) -> ClaimsCase:
    """Return the case that a document holds.

    Parameters
    ----------
    document : dict
        From `claims_document`, with the ``cell_px`` of its inputs.

    Returns
    -------
    ClaimsCase
    """
    n = len(CONDITIONS)
    findings = {}
    for claim in ON_A_CASE:
        holds = tuple(_ANSWERS[letter] for letter in document["answers"][claim])
        values = np.array(document["values"][claim], dtype=np.float64)
        if not len(holds) == len(values) == n:
            raise ValueError(f"{claim} is not judged under {n} conditions")
        findings[claim] = Findings(holds, values)
    return ClaimsCase(
        name=document["drawing"]["name"],
        cell_px=document["cell_px"],
        findings=findings,
        near=_unpacked(document["near"], (n, 10, 10)),
        peaks=_unpacked(document["peaks"], (n, 2, 10, 10)),
    )


def _short(value: float) -> float | None:
    return None if np.isnan(value) else float(f"{value:.{DIGITS}g}")


def _packed(flags: BoolArray) -> str:
    return np.packbits(flags).tobytes().hex()


def _unpacked(text: str, shape: tuple[int, ...]) -> BoolArray:
    bits: Any = np.unpackbits(np.frombuffer(bytes.fromhex(text), np.uint8))
    return bits[: int(np.prod(shape))].astype(np.bool_).reshape(shape)  # type: ignore[no-any-return]


JUDGED = Kind(
    name="occsim claims case", version=1, work=claims_document, read=read_claims
)
"""What the claims compute of a case."""

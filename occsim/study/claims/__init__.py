"""The source's claims, each judged under many conditions and counted."""

from occsim.study.claims.case import (
    JUDGED,
    ClaimsCase,
    Findings,
    claims_document,
    judge_case,
    read_claims,
)
from occsim.study.claims.conditions import (
    CHOICES,
    CONDITIONS,
    SOURCE_CONDITION,
    Condition,
    Reach,
    Readings,
    Walls,
    departures,
)
from occsim.study.claims.facts import Facts, facts_of
from occsim.study.claims.judging import CLAIMS, Claim, Finding, Unit
from occsim.study.claims.tally import (
    Count,
    Judged,
    behind,
    case_rows,
    claims_json,
    claims_text,
    count_rows,
    counts_csv,
    judged,
    save_claims,
    tally,
)

__all__ = [
    "CHOICES",
    "CLAIMS",
    "CONDITIONS",
    "JUDGED",
    "SOURCE_CONDITION",
    "Claim",
    "ClaimsCase",
    "Condition",
    "Count",
    "Facts",
    "Finding",
    "Findings",
    "Judged",
    "Reach",
    "Readings",
    "Unit",
    "Walls",
    "behind",
    "case_rows",
    "claims_document",
    "claims_json",
    "claims_text",
    "count_rows",
    "counts_csv",
    "departures",
    "facts_of",
    "judge_case",
    "judged",
    "read_claims",
    "save_claims",
    "tally",
]

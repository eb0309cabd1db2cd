"""The command ``occsim study``."""

import argparse
import sys
from collections.abc import Iterable
from enum import Enum
from pathlib import Path

from occsim.cli.drawings import Commands, add_arguments, run_on_drawings
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.sensor import BehindHit
from occsim.study import (
    FRONT_COLUMNS,
    MAXIMA_COLUMNS,
    STUDY,
    SWEEP_COLUMNS,
    Kept,
    StudyCase,
    StudySettings,
    front_rows,
    maxima_rows,
    maxima_text,
    pattern_text,
    plain,
    save_figures,
    sweep_rows,
    write_csv,
)

MOST_SHOWN = 60
"""Cases up to which tables are printed and figures drawn; beyond, nobody could read
them."""

_CHOICES: tuple[tuple[str, Enum, str], ...] = (
    # The study repeats the source, which subtracted the prior, as we reconstruct it.
    (
        "--rule",
        UpdateRule.SUBTRACT_PRIOR,
        "how a reading enters the map; the default is the source's, as we reconstruct "
        "it",
    ),
    ("--region", Region.EXPLORED, "which cells are scored"),
    ("--behind-hit", BehindHit.OCCUPIED, "what a reading says of pixels behind a wall"),
)
"""Options that take a member of an enum: name, default, help."""


def add_command(commands: Commands) -> None:
    """Add the command to those of the parser."""
    study = commands.add_parser(
        "study",
        help="sweep the priors of drawings at several cell sizes",
        description="Sweep the priors and find the exact Pareto front of drawings at "
        "several cell sizes; write tables, fronts and figures. Cases that the folder "
        "already holds under the same inputs are not computed again. A drawing that "
        "cannot be used is reported, and the others go on.",
    )
    add_arguments(study, "study")
    for name, default, words in _CHOICES:
        values = [choice.value for choice in type(default)]
        help_text = f"{words} ({default.value})"
        study.add_argument(name, choices=values, default=default.value, help=help_text)
    study.set_defaults(run=_study)


def _study(options: argparse.Namespace) -> None:
    settings = StudySettings(
        rule=UpdateRule(options.rule),
        region=Region(options.region),
        behind_hit=BehindHit(options.behind_hit),
    )
    cases, coverage = run_on_drawings(options, STUDY, settings, plain(settings))
    text = f"{_text(cases)}\n\n{coverage.text}"
    _write_tables(options.out, cases, text)
    try:
        if len(cases) <= MOST_SHOWN:
            save_figures(options.out, list(cases))
    except ImportError as error:
        print(f"occsim: no figures: {error}", file=sys.stderr)
    print(f"\n{text}\n\nWritten to {options.out}", flush=True)


def _text(cases: Kept[StudyCase]) -> str:
    if len(cases) > MOST_SHOWN:
        return pattern_text(cases)
    return f"{maxima_text(cases)}\n\n{pattern_text(cases)}"


def _write_tables(out: Path, cases: Iterable[StudyCase], text: str) -> None:
    write_csv(out / "maxima.csv", MAXIMA_COLUMNS, maxima_rows(cases))
    write_csv(out / "fronts.csv", FRONT_COLUMNS, front_rows(cases))
    write_csv(out / "sweeps.csv", SWEEP_COLUMNS, sweep_rows(cases))
    (out / "pattern.txt").write_text(f"{text}\n", encoding="utf-8")

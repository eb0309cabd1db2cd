"""The command ``occsim claims``."""

import argparse

from occsim.cli.drawings import Commands, add_arguments, run_on_drawings
from occsim.study.claims import CONDITIONS, JUDGED, claims_text, save_claims


def add_command(commands: Commands) -> None:
    """Add the command to those of the parser."""
    claims = commands.add_parser(
        "claims",
        help="count how often the source's claims hold, and under which conditions",
        description=f"Judge the source's claims under {len(CONDITIONS)} conditions: "
        "update rule, behind a hit, scored region, walls of the drawing, readings per "
        "cell and range. Writes the counts (claims.csv, claims.json) and the cases "
        "behind them (cases.csv). That a pattern is reproduced does not show that a "
        "method is right.",
    )
    add_arguments(claims, "claims")
    claims.set_defaults(run=_claims)


def _claims(options: argparse.Namespace) -> None:
    cases, coverage = run_on_drawings(options, JUDGED, None, {})
    counts = save_claims(options.out, cases)
    text = f"{claims_text(counts)}\n\n{coverage.text}"
    print(f"\n{text}\n\nWritten to {options.out}", flush=True)

"""``occsim exercises``: prove a folder of exercises."""

import argparse
import sys
from pathlib import Path
from typing import Any

from occsim.errors import OccsimError
from occsim.exercises import load_exercise, load_exercises

OURS = Path(__file__).resolve().parents[2] / "assets" / "exercises"
"""The exercises of a checkout."""


def add_command(commands: Any) -> None:
    """Add the command to a parser.

    Parameters
    ----------
    commands : argparse subparsers
        Of the main parser.
    """
    parser = commands.add_parser(
        "exercises",
        help="prove exercises: not solved at the set-up, solved at the witness",
        description="Prove each exercise of a folder. The exit status is 1 where one "
        "is refused, and a sentence says why.",
    )
    parser.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=OURS,
        help="folder of TOML files; by default those of this project's checkout",
    )
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int:
    refused = 0
    for file in sorted(options.folder.glob("*.toml")):
        try:
            load_exercise(file)
        except OccsimError as error:
            print(error, file=sys.stderr)
            refused += 1
    if refused:
        return 1
    found = load_exercises(options.folder)
    print(f"{len(found)} exercises, each proven")
    return 0

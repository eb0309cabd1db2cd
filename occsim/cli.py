"""The command line: ``occsim``, or ``python -m occsim``."""

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from enum import Enum
from pathlib import Path

from occsim import __version__
from occsim.errors import OccsimError, ParameterError
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.samples import sample_names
from occsim.sensor import BehindHit, Sensor
from occsim.study import (
    StudyCase,
    StudySettings,
    fronts_csv,
    maxima_csv,
    maxima_text,
    pattern_text,
    save_figures,
    study_cases,
    study_drawing,
    sweeps_csv,
)
from occsim.study.published import SOURCE_CELLS_PX

PROG = "occsim"

_CHOICES: tuple[tuple[str, Enum, str], ...] = (
    # The study repeats the source, which subtracted the prior at every reading.
    ("--rule", UpdateRule.SUBTRACT_PRIOR, "how a reading enters the map"),
    ("--region", Region.EXPLORED, "which cells are scored"),
    ("--behind-hit", BehindHit.OCCUPIED, "what a reading says of pixels behind a wall"),
)
"""Options of the study that take a member of an enum: name, default, help."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process by default.

    Returns
    -------
    int
        Exit status: 0; 2 after a message on bad input; 128 plus the signal's number for
        a command that was interrupted or whose output pipe was closed.
    """
    options = _parser().parse_args(arguments)
    try:
        options.run(options)
    except BrokenPipeError:
        # The reader closed the pipe (``| head``): no error. Python flushes its buffer
        # at exit; without a valid file it would print an error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + 13  # SIGPIPE, which Windows does not define
    except OccsimError as error:
        return _refuse(str(error))
    except OSError as error:
        return _refuse(f"{error.filename} cannot be used ({error.strerror})")
    except KeyboardInterrupt:
        print("\nStopped; run the same command again to continue.", file=sys.stderr)
        return 130
    return 0


def _refuse(sentence: str) -> int:
    print(f"{PROG}: {sentence}", file=sys.stderr)
    return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=PROG,
        description="Occupancy grid mapping with informative priors: which prior is "
        "best, for several drawings and cell sizes.",
    )
    parser.add_argument("--version", action="version", version=f"{PROG} {__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    study = commands.add_parser(
        "study",
        help="sweep the priors of drawings at several cell sizes",
        description="Sweep the priors and find the exact Pareto front of drawings at "
        "several cell sizes; write tables, fronts and figures. Cases that the folder "
        "already holds under the same settings are not computed again.",
    )
    _add_study_arguments(study)
    study.set_defaults(run=_study)
    return parser


def _add_study_arguments(study: argparse.ArgumentParser) -> None:
    study.add_argument(
        "drawings",
        metavar="DRAWING",
        nargs="*",
        help=f"a sample ({', '.join(sample_names())}) or an image file, whose detected "
        "walls then serve as the world; all samples by default",
    )
    sizes = list(SOURCE_CELLS_PX)
    study.add_argument(
        "--cells",
        type=int,
        nargs="+",
        metavar="PX",
        default=sizes,
        help=f"cell sizes, px ({' '.join(map(str, sizes))})",
    )
    study.add_argument(
        "--out", type=Path, default=Path("study"), help="folder to write to (study)"
    )
    study.add_argument(
        "--range-px", type=float, default=20.0, help="reach for image files, px (20)"
    )
    for name, default, words in _CHOICES:
        values = [choice.value for choice in type(default)]
        help_text = f"{words} ({default.value})"
        study.add_argument(name, choices=values, default=default.value, help=help_text)


def _study(options: argparse.Namespace) -> None:
    out: Path = options.out
    cases = list(_cases(options, out / "cases"))
    _write_tables(out, cases)
    try:
        save_figures(out, cases)
    except ImportError as error:
        print(f"{PROG}: no figures: {error}", file=sys.stderr)
    tables = f"{maxima_text(cases)}\n\n{pattern_text(cases)}"
    print(f"\n{tables}\n\nWritten to {out}", flush=True)


def _cases(options: argparse.Namespace, folder: Path) -> Iterator[StudyCase]:
    settings = StudySettings(
        rule=UpdateRule(options.rule),
        region=Region(options.region),
        behind_hit=BehindHit(options.behind_hit),
    )
    cells: list[int] = sorted(set(options.cells))
    if cells[0] < 1:
        raise ParameterError(f"--cells must be 1 px or more; got {cells[0]}")
    sensor = Sensor(range_px=options.range_px)
    sources = dict.fromkeys(options.drawings or sample_names())
    drawings = [study_drawing(source, sensor) for source in sources]
    folder.mkdir(parents=True, exist_ok=True)
    for case, done, total, is_kept in study_cases(drawings, cells, settings, folder):
        how = "kept" if is_kept else "computed"
        print(f"[{done}/{total}] {case.name}, {case.cell_px} px: {how}", flush=True)
        yield case


def _write_tables(out: Path, cases: Sequence[StudyCase]) -> None:
    tables = {
        "maxima.csv": maxima_csv(cases),
        "fronts.csv": fronts_csv(cases),
        "sweeps.csv": sweeps_csv(cases),
        "pattern.txt": f"{maxima_text(cases)}\n\n{pattern_text(cases)}\n",
    }
    for name, text in tables.items():
        (out / name).write_text(text, encoding="utf-8")

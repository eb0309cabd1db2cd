"""The command line: ``python -m occsim study [DRAWING ...]``."""

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from occsim.errors import OccsimError, ParameterError
from occsim.io.images import png
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.samples import sample_names
from occsim.sensor import BehindHit, Sensor
from occsim.study import (
    StudyCase,
    StudyDrawing,
    StudySettings,
    case_path,
    case_settings,
    fronts_csv,
    fronts_picture,
    load_case,
    maps_picture,
    maxima_csv,
    maxima_text,
    pattern_text,
    run_case,
    save_case,
    study_drawing,
    sweeps_csv,
)
from occsim.study.published import SOURCE_CELLS_PX


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process by default.

    Returns
    -------
    int
        Exit status: 0, 2 after a sentence on bad input, or as a shell has it for a
        command that was stopped or whose reader went away.
    """
    options = _parser().parse_args(arguments)
    try:
        _study(options)
    except BrokenPipeError:
        # Whoever read the output has had enough (``| head``): no error. What Python
        # still holds back must go somewhere at exit, or it complains.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + 13  # SIGPIPE, a name that Windows lacks
    except OccsimError as error:
        print(f"{_PROG}: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            f"{_PROG}: {error.filename} cannot be used ({error.strerror})",
            file=sys.stderr,
        )
        return 2
    except KeyboardInterrupt:
        print("\nStopped; the same command goes on from here.", file=sys.stderr)
        return 130
    return 0


_PROG = "python -m occsim"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=_PROG,
        description="Occupancy grid mapping with informative priors: which prior is "
        "best, for several drawings and cell sizes.",
    )
    commands = parser.add_subparsers(dest="command", required=True)
    study = commands.add_parser(
        "study",
        help="sweep the priors of drawings at several cell sizes",
        description="Sweep the priors and find the exact Pareto front of drawings at "
        "several cell sizes; write tables, fronts and pictures. Cases that the folder "
        "already holds under the same settings are not computed again.",
    )
    study.add_argument(
        "drawings",
        metavar="DRAWING",
        nargs="*",
        help=f"a sample ({', '.join(sample_names())}) or an image file, whose detected "
        "walls then serve as the world; all samples by default",
    )
    study.add_argument(
        "--cells",
        type=int,
        nargs="+",
        metavar="PX",
        default=list(SOURCE_CELLS_PX),
        help="cell sizes, px (3 5 10)",
    )
    study.add_argument(
        "--out", type=Path, default=Path("study"), help="folder to write to (study)"
    )
    study.add_argument(
        "--range-px", type=float, default=20.0, help="reach for image files, px (20)"
    )
    usual = StudySettings()
    for name, default, words in (
        ("--rule", usual.rule, "how a reading enters the map"),
        ("--region", usual.region, "which cells are scored"),
        ("--behind-hit", usual.behind_hit, "what is said of pixels behind a wall"),
    ):
        study.add_argument(
            name,
            choices=[choice.value for choice in type(default)],
            default=default.value,
            help=f"{words} ({default.value})",
        )
    return parser


def _study(options: argparse.Namespace) -> None:
    settings = StudySettings(
        rule=UpdateRule(options.rule),
        region=Region(options.region),
        behind_hit=BehindHit(options.behind_hit),
    )
    out: Path = options.out
    cells: list[int] = sorted(set(options.cells))
    if cells[0] < 1:
        raise ParameterError(f"--cells must be 1 px or more; got {cells[0]}")
    drawings = _drawings(options.drawings, Sensor(range_px=options.range_px))
    (out / "cases").mkdir(parents=True, exist_ok=True)
    pairs = [(drawing, cell_px) for drawing in drawings for cell_px in cells]
    cases = []
    for done, (drawing, cell_px) in enumerate(pairs, start=1):
        case, known = _case(drawing, cell_px, settings, out / "cases")
        cases.append(case)
        how = "kept" if known else "computed"
        print(f"[{done}/{len(pairs)}] {drawing.name}, {cell_px} px: {how}", flush=True)
    _write(out, cases)
    tables = f"{maxima_text(cases)}\n\n{pattern_text(cases)}"
    print(f"\n{tables}\n\nWritten to {out}", flush=True)


def _drawings(sources: Sequence[str], sensor: Sensor) -> list[StudyDrawing]:
    drawings = [
        study_drawing(source, sensor)
        for source in dict.fromkeys(sources or sample_names())
    ]
    names = [drawing.name for drawing in drawings]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ParameterError(
            f"drawings must differ in name; got {', '.join(twice)} more than once"
        )
    return drawings


def _case(
    drawing: StudyDrawing, cell_px: int, settings: StudySettings, folder: Path
) -> tuple[StudyCase, bool]:
    # The case, and whether the folder already held it.
    described = case_settings(drawing, cell_px, settings)
    path = case_path(folder, described)
    known = load_case(path, described)
    if known is not None:
        return known, True
    case = run_case(drawing, cell_px, settings)
    save_case(path, case, described)
    return case, False


def _write(out: Path, cases: Sequence[StudyCase]) -> None:
    tables = {
        "maxima.csv": maxima_csv(cases),
        "fronts.csv": fronts_csv(cases),
        "sweeps.csv": sweeps_csv(cases),
        "pattern.txt": f"{maxima_text(cases)}\n\n{pattern_text(cases)}\n",
    }
    for name, text in tables.items():
        (out / name).write_text(text, encoding="utf-8")
    for cell_px in sorted({case.cell_px for case in cases}):
        same = [case for case in cases if case.cell_px == cell_px]
        (out / f"maps_{cell_px}px.png").write_bytes(png(maps_picture(same)))
        (out / f"fronts_{cell_px}px.png").write_bytes(png(fronts_picture(same)))

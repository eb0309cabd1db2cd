"""What the commands on many drawings share: arguments, the run, its coverage."""

import argparse
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from occsim.cli.progress import shown
from occsim.errors import ParameterError
from occsim.run import MapSettings
from occsim.samples import sample_names
from occsim.study import (
    Batch,
    Kept,
    Kind,
    Machines,
    SensorChoice,
    Step,
    find_drawings,
    run_batch,
)
from occsim.study.published import SOURCE_CELLS_PX

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"
"""What `argparse` adds a command to; it has no public name."""

MOST_LISTED = 20
"""Drawings without a result that are named on the screen; a file has all."""


def add_arguments(command: argparse.ArgumentParser, out: str) -> None:
    """Add the arguments that name drawings and machines."""
    command.add_argument(
        "drawings",
        metavar="DRAWING",
        nargs="*",
        help=f"a sample ({', '.join(sample_names())}), an image file or a folder of "
        "them; all samples by default. Beside NAME.png its ground truth is looked for "
        "as NAME_truth.png or NAME_walls.png (without one, the walls found are the "
        "world), its trajectory as NAME.poses, NAME.csv, NAME_trajectory.csv and so on "
        "(without one, a tour is planned)",
    )
    for what, words in (("truth", "ground truth"), ("trajectory", "trajectory")):
        command.add_argument(
            f"--{what}",
            type=Path,
            metavar="PATH",
            help=f"{words} of a single drawing, or a folder in which it is looked for",
        )
    command.add_argument(
        "--range",
        "--range-px",
        dest="range_px",
        type=float,
        metavar="PX",
        help="reach for image files, px (the length of a door in the drawing)",
    )
    command.add_argument(
        "--fov",
        dest="fov_deg",
        type=float,
        metavar="DEG",
        help="field of view for image files, degrees (30)",
    )
    sizes = list(SOURCE_CELLS_PX)
    command.add_argument(
        "--cell",
        "--cells",
        dest="cells",
        type=int,
        nargs="+",
        metavar="PX",
        default=sizes,
        help=f"cell sizes, px ({' '.join(map(str, sizes))})",
    )
    command.add_argument(
        "--out", type=Path, default=Path(out), help=f"folder to write to ({out})"
    )
    command.add_argument(
        "--processes", type=int, default=1, metavar="N", help="on this machine (1)"
    )
    command.add_argument(
        "--dask",
        metavar="ADDRESS",
        help="work on the Dask cluster whose scheduler is at this address, such as "
        "tcp://host:8786",
    )


@dataclass(frozen=True, slots=True)
class Coverage:
    """Which drawings gave results.

    Parameters
    ----------
    n_drawings : int
        Drawings asked for.
    n_complete : int
        Those with a result at every cell size.
    n_untold : int
        Those among them without a ground truth: the walls found are their world.
    paths : tuple of Path
        Files of the results, drawings in their order.
    failed : tuple of Step
        Cases without a result.
    """

    n_drawings: int
    n_complete: int
    n_untold: int
    paths: tuple[Path, ...]
    failed: tuple[Step, ...]

    @property
    def text(self) -> str:
        """Sentences for the screen."""
        lines = [
            f"{self.n_complete} of {self.n_drawings} drawings gave a result at every "
            "cell size."
        ]
        if self.n_untold:
            lines.append(
                f"Without a ground truth: {self.n_untold} of them. There the walls "
                "found serve as the world, so the prior is right everywhere."
            )
        reasons = {step.name: step.reason for step in self.failed}
        listed = list(reasons.items())[:MOST_LISTED]
        lines += [f"  {name}: {reason}" for name, reason in listed]
        if len(reasons) > MOST_LISTED:
            lines.append(f"  and {len(reasons) - MOST_LISTED} more in coverage.json")
        return "\n".join(lines)

    @property
    def plain(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "drawings": self.n_drawings,
            "complete": self.n_complete,
            "without_ground_truth": self.n_untold,
            "failed": [
                {"drawing": step.name, "cell_px": step.cell_px, "reason": step.reason}
                for step in self.failed
            ],
        }


def run_on_drawings(
    options: argparse.Namespace, kind: Kind, settings: Any, described: dict[str, Any]
) -> tuple[Kept[Any], Coverage]:
    """Run what a command computes, and keep it in the folder of the options.

    Parameters
    ----------
    options : argparse.Namespace
        From `add_arguments`.
    kind : Kind
        What is computed of a case.
    settings : object
        Of the command.
    described : dict
        The settings as plain values.

    Returns
    -------
    kept : Kept
        The results.
    coverage : Coverage

    Raises
    ------
    ParameterError
        Where an argument lies outside its domain, or there is no result at all.
    """
    cells: list[int] = sorted(set(options.cells))
    for cell_px in cells:
        if cell_px < 1:
            raise ParameterError(f"--cell must be 1 px or more; got {cell_px}")
        MapSettings(cell_px=cell_px)
    batch = Batch(
        kind=kind,
        sources=find_drawings(options.drawings, options.truth, options.trajectory),
        cells=cells,
        settings=settings,
        described=described,
        folder=options.out / "cases",
        sensor=_sensor(options),
    )
    machines = Machines(processes=options.processes, dask=options.dask)
    batch.folder.mkdir(parents=True, exist_ok=True)
    coverage = _coverage(batch, list(shown(run_batch(batch, machines))))
    if not coverage.paths:
        raise ParameterError(coverage.failed[0].reason)
    text = json.dumps(coverage.plain, indent=1)
    (options.out / "coverage.json").write_text(text, encoding="utf-8")
    return Kept(kind, coverage.paths), coverage


def _sensor(options: argparse.Namespace) -> SensorChoice:
    if options.fov_deg is None:
        return SensorChoice(range_px=options.range_px)
    return SensorChoice(
        range_px=options.range_px, fov_rad=math.radians(options.fov_deg)
    )


def _coverage(batch: Batch, steps: Sequence[Step]) -> Coverage:
    rank = {source.name: i for i, source in enumerate(batch.sources)}
    in_order = sorted(steps, key=lambda step: (rank[step.name], step.cell_px))
    failed = [step for step in in_order if step.path is None]
    bad = {step.name for step in failed}
    complete = [source for source in batch.sources if source.name not in bad]
    untold = [source.path is not None and source.truth is None for source in complete]
    return Coverage(
        n_drawings=len(rank),
        n_complete=len(complete),
        n_untold=sum(untold),
        paths=tuple(step.path for step in in_order if step.path is not None),
        failed=tuple(failed),
    )

"""Many drawings at several cell sizes: worked on, kept as files, and taken up again."""

import hashlib
import json
import os
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

import cv2
import numpy as np

from occsim._version import __version__
from occsim.errors import OccsimError
from occsim.study.content import DrawingContent, SensorChoice, read_content
from occsim.study.machines import Failure, Machines, spread
from occsim.study.sources import DrawingSource

R = TypeVar("R")

Document = dict[str, Any]
"""Plain values, as JSON holds them."""

ALL_CELLS_FROM = 4
"""From this many drawings a process, one job does all cell sizes of a drawing: its
walls are detected once. With fewer, single cases keep all processes busy to the end."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Kind:
    """What is computed of a case.

    Parameters
    ----------
    name : str
        Format of the files.
    version : int
        Of the format.
    work : callable
        A function of a module: building, cell size in px and settings give a document.
    read : callable
        Makes the result of a document with its inputs.
    """

    name: str
    version: int
    work: Callable[..., Document]
    read: Callable[[Document], Any]


@dataclass(frozen=True, kw_only=True, slots=True)
class Batch:
    """Drawings times cell sizes, and where their results are kept.

    Parameters
    ----------
    kind : Kind
        What is computed.
    sources : sequence of DrawingSource
        The drawings.
    cells : sequence of int
        Cell sizes, px.
    settings : object
        Passed to the work.
    described : dict
        The settings as plain values.
    folder : Path
        An existing folder, one file a case.
    sensor : SensorChoice
        For drawings that are no samples.
    """

    kind: Kind
    sources: Sequence[DrawingSource]
    cells: Sequence[int]
    settings: Any
    described: Document
    folder: Path
    sensor: SensorChoice = SensorChoice()


class Step(NamedTuple):
    """One case of a batch, and the batch's progress."""

    name: str
    """Of the drawing."""
    cell_px: int
    done: int
    """Cases so far, including this one."""
    total: int
    path: Path | None
    """Where its result is; None where there is none."""
    is_kept: bool
    """Whether the folder held it already."""
    reason: str
    """Why there is no result, in one sentence; else empty."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Job:
    """Cell sizes of one drawing, as sent to a process."""

    work: Callable[..., Document]
    content: DrawingContent
    cells: tuple[int, ...]
    settings: Any


def run_batch(batch: Batch, machines: Machines | None = None) -> Iterator[Step]:
    """Yield every case as soon as its result is kept, or known to be missing.

    A case whose result the folder holds is not computed again: the file's name has a
    digest of all inputs and versions. A drawing that cannot be used is a step with a
    reason; the others go on, and it is tried again next time.

    Parameters
    ----------
    batch : Batch
        What to do.
    machines : Machines, optional
        What does it; this process by default.

    Yields
    ------
    Step

    Raises
    ------
    OSError
        Where a result cannot be written.
    ParameterError
        Where a cluster cannot be reached, or is lost.
    """
    machines, done = machines or Machines(), 0
    todo: list[tuple[DrawingSource, tuple[int, ...]]] = []
    for steps in (_looked_up(batch, todo), _worked_on(batch, todo, machines)):
        for step in steps:
            done += 1
            total = len(batch.sources) * len(batch.cells)
            yield step._replace(done=done, total=total)


def _step(
    name: str,
    cell_px: int,
    path: Path | None = None,
    *,
    is_kept: bool = False,
    reason: str = "",
) -> Step:
    return Step(name, cell_px, 0, 0, path, is_kept, reason)


def _looked_up(
    batch: Batch, todo: list[tuple[DrawingSource, tuple[int, ...]]]
) -> Iterator[Step]:
    """Yield the cases that are kept or cannot be read; add the others to the list."""
    for source in batch.sources:
        try:
            inputs = read_content(source, batch.sensor).inputs
        except OccsimError as error:
            for cell_px in batch.cells:
                yield _step(source.name, cell_px, reason=str(error))
            continue
        missing = []
        for cell_px in batch.cells:
            described = _described(batch, inputs, cell_px)
            path = result_path(batch.folder, source.name, described)
            if load_result(path, described, batch.kind.read) is None:
                missing.append(cell_px)
            else:
                yield _step(source.name, cell_px, path, is_kept=True)
        if missing:
            todo.append((source, tuple(missing)))


def _worked_on(
    batch: Batch,
    todo: list[tuple[DrawingSource, tuple[int, ...]]],
    machines: Machines,
) -> Iterator[Step]:
    unreadable: list[Step] = []
    jobs = _jobs(batch, todo, machines, unreadable)
    for job, results in spread(work_on, jobs, machines):
        yield from _saved(batch, job, results)
    yield from unreadable


def _jobs(
    batch: Batch,
    todo: list[tuple[DrawingSource, tuple[int, ...]]],
    machines: Machines,
    unreadable: list[Step],
) -> Iterator[Job]:
    all_cells = len(todo) >= ALL_CELLS_FROM * machines.processes
    for source, cells in todo:
        try:
            content = read_content(source, batch.sensor)
        except OccsimError as error:  # readable a moment ago
            unreadable += [_step(source.name, c, reason=str(error)) for c in cells]
            continue
        for some in [cells] if all_cells else [(cell_px,) for cell_px in cells]:
            yield Job(
                work=batch.kind.work,
                content=content,
                cells=some,
                settings=batch.settings,
            )


def work_on(job: Job) -> dict[int, Document | Failure]:
    """Return the document of every cell size of a job, or why there is none.

    Parameters
    ----------
    job : Job
        Cell sizes of one drawing.

    Returns
    -------
    dict
        By cell size, px.

    Raises
    ------
    OccsimError
        Where the drawing cannot be used at all.
    """
    building = job.content.building()
    results: dict[int, Document | Failure] = {}
    for cell_px in job.cells:
        try:
            results[cell_px] = job.work(building, cell_px, job.settings)
        except OccsimError as error:
            results[cell_px] = Failure(str(error))
    return results


def _saved(
    batch: Batch, job: Job, results: dict[int, Document | Failure] | Failure
) -> Iterator[Step]:
    """Keep the results of a job, and yield its steps."""
    name = job.content.name
    for cell_px in job.cells:
        result = results if isinstance(results, Failure) else results[cell_px]
        if isinstance(result, Failure):
            yield _step(name, cell_px, reason=result.reason)
            continue
        described = _described(batch, job.content.inputs, cell_px)
        path = result_path(batch.folder, name, described)
        save_result(path, described | result)
        yield _step(name, cell_px, path)


def _described(batch: Batch, inputs: Document, cell_px: int) -> Document:
    """Return all that a result depends on."""
    return {
        "format": batch.kind.name,
        "version": batch.kind.version,
        "software": software(),
        "inputs": inputs,
        "cell_px": cell_px,
        "settings": batch.described,
    }


def software() -> dict[str, str]:
    """Return the versions that a result depends on."""
    return {
        "occsim": __version__,
        "numpy": np.__version__,
        "opencv": cv2.__version__,
    }


# --- Files of results -----------------------------------------------------------------


def result_path(folder: Path, name: str, described: Document) -> Path:
    """Return the path of a case; other inputs give another file.

    Parameters
    ----------
    folder : Path
        Of the batch.
    name : str
        Of the drawing.
    described : dict
        All inputs, with a ``cell_px``.

    Returns
    -------
    Path
    """
    content = json.dumps(described, sort_keys=True).encode()
    key = hashlib.sha256(content).hexdigest()[:16]
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", name)[-40:]
    return folder / f"{plain}_{described['cell_px']}px_{key}.json"


def save_result(path: Path, document: Document) -> None:
    """Write a result, wholly or not at all.

    Parameters
    ----------
    path : Path
        From `result_path`; its folder exists.
    document : dict
        The inputs and the result.
    """
    # Two commands may work on one folder.
    partial = path.with_suffix(f".{os.getpid()}.part")
    text = json.dumps(document, allow_nan=False, separators=(",", ":"))
    partial.write_text(text, encoding="utf-8")
    os.replace(partial, path)


def load_result(
    path: Path, described: Document, read: Callable[[Document], R]
) -> R | None:
    """Return a result that was kept under the same inputs.

    Parameters
    ----------
    path : Path
        From `result_path`.
    described : dict
        All inputs.
    read : callable
        Makes the result of the document.

    Returns
    -------
    What `read` makes, or None
        None where there is no such file or it is damaged: compute it then.
    """
    try:
        document: Document = json.loads(path.read_text(encoding="utf-8"))
        same = all(document[name] == value for name, value in described.items())
        return read(document) if same else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


@dataclass(frozen=True, slots=True)
class Kept(Generic[R]):
    """Results in files, read one at a time: thousands need no memory.

    Parameters
    ----------
    kind : Kind
        What they are.
    paths : sequence of Path
        Their files, from the steps of `run_batch`.
    """

    kind: Kind
    paths: Sequence[Path]

    def __len__(self) -> int:
        return len(self.paths)

    def __iter__(self) -> Iterator[R]:
        for path in self.paths:
            document = json.loads(path.read_text(encoding="utf-8"))
            yield self.kind.read(document)

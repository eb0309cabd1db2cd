"""Cases of a study as JSON files, so that a stopped study can continue."""

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np

from occsim._types import FloatArray
from occsim.building import Building
from occsim.errors import ParameterError
from occsim.metrics import Scores
from occsim.priors import ParetoFront, PriorSweep
from occsim.study.run import StudyCase, StudySettings, is_reference, run_case

FORMAT = "occsim study case"
VERSION = 2

_COUNTS = ("tp", "fp", "fn", "tn")
_POINTS = ("p_wall", "p_space", "precision", "recall")


class StudyStep(NamedTuple):
    """One case of a study, and the study's progress."""

    case: StudyCase
    done: int
    """Cases so far, including this one."""
    total: int
    is_kept: bool
    """Whether the case was read from the folder."""


def study_cases(
    drawings: Iterable[Building],
    cells: Sequence[int],
    settings: StudySettings | None = None,
    folder: Path | None = None,
) -> Iterator[StudyStep]:
    """Yield every drawing at every cell size, the drawings in turn.

    Parameters
    ----------
    drawings : iterable of Building
        Of different names.
    cells : sequence of int
        Cell sizes, px.
    settings : StudySettings, optional
        The source's by default.
    folder : Path, optional
        An existing folder: cases that it holds under the same settings are read, the
        others are computed and saved there, so that a stopped study can continue.

    Yields
    ------
    StudyStep

    Raises
    ------
    ParameterError
        Where two drawings have one name or a cell size lies outside its domain.
    TrajectoryError
        Where no pose of a drawing stands in free space.

    Examples
    --------
    >>> from occsim.study import study_cases, study_drawing
    >>> steps = study_cases([study_drawing("d")], cells=(5, 10))
    >>> [(step.case.name, step.case.cell_px, step.done, step.total) for step in steps]
    [('d', 5, 1, 2), ('d', 10, 2, 2)]
    """
    settings = settings or StudySettings()
    drawings = list(drawings)
    _require_different_names(drawings)
    pairs = [(drawing, cell_px) for drawing in drawings for cell_px in cells]
    for done, (drawing, cell_px) in enumerate(pairs, start=1):
        case, is_kept = _kept_or_run(drawing, cell_px, settings, folder)
        yield StudyStep(case, done, len(pairs), is_kept)


def _require_different_names(drawings: Sequence[Building]) -> None:
    names = [drawing.name for drawing in drawings]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ParameterError(
            f"drawings must differ in name; got {', '.join(twice)} more than once"
        )


def _kept_or_run(
    drawing: Building, cell_px: int, settings: StudySettings, folder: Path | None
) -> tuple[StudyCase, bool]:
    if folder is None:
        return run_case(drawing, cell_px, settings), False
    described = case_settings(drawing, cell_px, settings)
    path = case_path(folder, described)
    kept = load_case(path, described)
    if kept is not None:
        return kept, True
    case = run_case(drawing, cell_px, settings)
    save_case(path, case, described)
    return case, False


def case_settings(
    drawing: Building, cell_px: int, settings: StudySettings
) -> dict[str, Any]:
    """Return all inputs of a case, as plain values.

    Parameters
    ----------
    drawing : Building
        What is mapped.
    cell_px : int
        Cell size, px.
    settings : StudySettings
        Of the study.

    Returns
    -------
    dict
        Format, versions, the drawing's name and digest, sensor, cell size, settings.
    """
    # The package imports its modules before it knows its version.
    from occsim import __version__

    return {
        "format": FORMAT,
        "version": VERSION,
        "software": {
            "occsim": __version__,
            "numpy": np.__version__,
            "opencv": cv2.__version__,
        },
        "drawing": {
            "name": drawing.name,
            "digest": drawing.digest,
            "is_reference": is_reference(drawing),
            "n_poses": len(drawing.valid_trajectory()),
        },
        "sensor": _plain(drawing.sensor),
        "cell_px": cell_px,
        "settings": _plain(settings),
    }


def case_path(folder: Path, described: dict[str, Any]) -> Path:
    """Return the path of a case; other settings give another file.

    Parameters
    ----------
    folder : Path
        Of the study.
    described : dict
        From `case_settings`.

    Returns
    -------
    Path
    """
    content = json.dumps(described, sort_keys=True).encode()
    key = hashlib.sha256(content).hexdigest()[:16]
    name = re.sub(r"[^A-Za-z0-9_-]+", "_", described["drawing"]["name"])[:40]
    return folder / f"{name}_{described['cell_px']}px_{key}.json"


def save_case(path: Path, case: StudyCase, described: dict[str, Any]) -> None:
    """Write a case, wholly or not at all.

    Parameters
    ----------
    path : Path
        From `case_path`; its folder exists.
    case : StudyCase
        The result.
    described : dict
        From `case_settings`.
    """
    sweep, front = case.sweep, case.front
    bounds = front.rectangles
    result = {
        "sweep": {name: getattr(sweep, name).tolist() for name in _COUNTS}
        | {"p_wall": sweep.p_wall.tolist(), "p_space": sweep.p_space.tolist()},
        "front": {name: getattr(front, name).tolist() for name in _POINTS}
        | {"rectangles": None if bounds is None else bounds.tolist()},
        "blank": {name: getattr(case.blank, name) for name in _COUNTS},
    }
    partial = path.with_suffix(".part")
    partial.write_text(
        json.dumps(described | result, indent=1, allow_nan=False), encoding="utf-8"
    )
    os.replace(partial, path)


def load_case(path: Path, described: dict[str, Any]) -> StudyCase | None:
    """Return a case that was saved under the same settings.

    Parameters
    ----------
    path : Path
        From `case_path`.
    described : dict
        From `case_settings`.

    Returns
    -------
    StudyCase or None
        None where there is no such file or it is damaged: compute it then.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        same = all(document[name] == value for name, value in described.items())
        return _case(document) if same else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _case(document: dict[str, Any]) -> StudyCase:
    return StudyCase(
        name=document["drawing"]["name"],
        cell_px=document["cell_px"],
        sweep=_sweep(document["sweep"]),
        front=_front(document["front"]),
        blank=Scores(**{name: int(document["blank"][name]) for name in _COUNTS}),
        is_reference=document["drawing"]["is_reference"],
    )


def _sweep(table: dict[str, Any]) -> PriorSweep:
    p_wall, p_space = (_floats(table[name], (-1,)) for name in ("p_wall", "p_space"))
    shape = (p_wall.size, p_space.size)
    tp, fp, fn, tn = (
        np.array(table[name], dtype=np.int64).reshape(shape) for name in _COUNTS
    )
    return PriorSweep(p_wall, p_space, tp=tp, fp=fp, fn=fn, tn=tn)


def _front(points: dict[str, Any]) -> ParetoFront:
    size = len(points["p_wall"])
    p_wall, p_space, precision, recall = (
        _floats(points[name], (size,)) for name in _POINTS
    )
    bounds = points["rectangles"]
    rectangles = None if bounds is None else _floats(bounds, (size, 4))
    return ParetoFront(p_wall, p_space, precision, recall, rectangles)


def _floats(values: Any, shape: tuple[int, ...]) -> FloatArray:
    return np.array(values, dtype=np.float64).reshape(shape)


def _plain(parameters: Any) -> dict[str, Any]:
    return {
        name: value.value if isinstance(value, Enum) else value
        for name, value in asdict(parameters).items()
    }

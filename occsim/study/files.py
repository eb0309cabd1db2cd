"""Cases of a study as plain values, as files of results hold them."""

from typing import Any

import numpy as np

from occsim._plain import plain
from occsim._types import FloatArray
from occsim.building import Building
from occsim.metrics import Scores
from occsim.priors import ParetoFront, PriorSweep
from occsim.study.batch import Document, Kind, software
from occsim.study.run import StudyCase, StudySettings, is_reference, run_case

FORMAT = "occsim study case"
VERSION = 3

_COUNTS = ("tp", "fp", "fn", "tn")
_POINTS = ("p_wall", "p_space", "precision", "recall")


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
    return {
        "format": FORMAT,
        "version": VERSION,
        "software": software(),
        **mapped_values(drawing),
        "cell_px": cell_px,
        "settings": plain(settings),
    }


def mapped_values(drawing: Building) -> Document:
    """Return which building was mapped, and by which sensor, as plain values."""
    return {
        "drawing": {
            "name": drawing.name,
            "digest": drawing.digest,
            "is_reference": is_reference(drawing),
            "n_poses": len(drawing.valid_trajectory()),
        },
        "sensor": plain(drawing.sensor),
    }


def study_document(
    drawing: Building, cell_px: int, settings: StudySettings
) -> Document:
    """Return the sweep and the front of a case as plain values; see `run_case`.

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
        What was mapped and the result; `read_case` makes a case of it.

    Raises
    ------
    ParameterError, TrajectoryError
        As in `run_case`.
    """
    case = run_case(drawing, cell_px, settings)
    sweep, front = case.sweep, case.front
    bounds = front.rectangles
    return mapped_values(drawing) | {
        "sweep": {name: getattr(sweep, name).tolist() for name in _COUNTS}
        | {"p_wall": sweep.p_wall.tolist(), "p_space": sweep.p_space.tolist()},
        "front": {name: getattr(front, name).tolist() for name in _POINTS}
        | {"rectangles": None if bounds is None else bounds.tolist()},
        "blank": {name: getattr(case.blank, name) for name in _COUNTS},
    }


def read_case(document: Document) -> StudyCase:
    """Return the case that a document holds.

    Parameters
    ----------
    document : dict
        From `study_document`, with the ``cell_px`` of its inputs.

    Returns
    -------
    StudyCase
    """
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


STUDY = Kind(name=FORMAT, version=VERSION, work=study_document, read=read_case)
"""What a study computes of a case."""

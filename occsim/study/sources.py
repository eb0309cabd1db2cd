"""Where the drawings of a study come from: samples, files and folders of files.

A drawing's ground truth and trajectory stand beside it and are found by name: for
``plan.png`` (or ``plan_drawing.png``) the pictures ``plan_truth.*`` or ``plan_walls.*``
and the files ``plan.poses``, ``plan.csv``, ``plan_trajectory.csv`` and so on.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from occsim._files import printable
from occsim.errors import ParameterError
from occsim.samples import sample_names

DRAWING_SUFFIXES = (
    ".png",
    ".jpg",
    ".jpeg",
    ".tif",
    ".tiff",
    ".bmp",
    ".gif",
    ".webp",
    ".pdf",
)
"""Endings by which a folder's drawings are told from its other files."""

TRUTH_ENDINGS = ("_truth", "_walls")
"""What follows a drawing's name in the name of its ground truth."""

TRAJECTORY_ENDINGS = ("", "_trajectory", "_poses", "_tour")
TRAJECTORY_SUFFIXES = (".poses", ".csv", ".tum", ".npy", ".mat")
PLAIN_SUFFIXES = (".txt", ".json")
"""Files of many purposes: trajectories only where the name says so."""

# ``plan_walls224.png`` is a picture of walls too, though not one of the drawing's size.
_IS_TRUTH = re.compile(rf"({'|'.join(TRUTH_ENDINGS)})\d*$", re.IGNORECASE)


@dataclass(frozen=True, kw_only=True, slots=True)
class DrawingSource:
    """One drawing of a study, and the files that belong to it.

    Parameters
    ----------
    name : str
        Of the drawing, different from all others of the study.
    path : Path, optional
        Its file; None for a sample, which has everything of its own.
    truth : Path, optional
        Picture of the structure alone. Without one the walls found are the world.
    trajectory : Path, optional
        Poses, px. Without one a tour is planned.

    Examples
    --------
    >>> from occsim.study import DrawingSource, find_drawings
    >>> isinstance(find_drawings(["a"])[0], DrawingSource)
    True
    """

    name: str
    path: Path | None = None
    truth: Path | None = None
    trajectory: Path | None = None


def find_drawings(
    places: Sequence[str | Path] = (),
    truth: Path | None = None,
    trajectory: Path | None = None,
) -> list[DrawingSource]:
    """Return the drawings that some places hold.

    Parameters
    ----------
    places : sequence of str or Path
        Names of samples, image files, and folders, which are searched to any depth; all
        samples by default.
    truth, trajectory : Path, optional
        A file, for a single drawing, or a folder in which those of all drawings are
        looked for by name. By default they are looked for beside each drawing.

    Returns
    -------
    list of DrawingSource
        In the order of the places, a folder's by path, each once. Files are not opened.

    Raises
    ------
    ParameterError
        Where a place is none of these, a folder holds no drawing, or one file is given
        for several drawings.

    Examples
    --------
    >>> from occsim.study import find_drawings
    >>> [source.name for source in find_drawings(["b", "a"])]
    ['b', 'a']
    """
    _files_of.cache_clear()
    found: dict[object, DrawingSource] = {}
    for place in places or sample_names():
        for source in _drawings_of(str(place)):
            found.setdefault(source.path or source.name, source)
    sources = _with_different_names(list(found.values()))
    for what, given in (("truth", truth), ("trajectory", trajectory)):
        sources = _with_given(what, given, sources)
    return sources


def _drawings_of(place: str) -> Iterator[DrawingSource]:
    path = Path(place)
    if place in sample_names():
        yield DrawingSource(name=place)
    elif path.is_dir():
        yield from _drawings_in(path)
    elif path.exists():
        yield _source(path, path.stem)
    else:
        raise ParameterError(
            f"a drawing is a sample ({', '.join(sample_names())}), an image file or a "
            f"folder of image files; got {place!r}"
        )


def _drawings_in(folder: Path) -> Iterator[DrawingSource]:
    paths = sorted(path for path in folder.rglob("*") if _is_drawing(path))
    if not paths:
        raise ParameterError(
            f"a folder of drawings holds images ({', '.join(DRAWING_SUFFIXES)}); none "
            f"is in {str(folder)!r}"
        )
    for path in paths:
        yield _source(path, path.relative_to(folder).with_suffix("").as_posix())


def _is_drawing(path: Path) -> bool:
    return (
        path.suffix.lower() in DRAWING_SUFFIXES
        and not path.name.startswith(".")
        and not _IS_TRUTH.search(path.stem)
        and path.is_file()
    )


def _source(path: Path, name: str) -> DrawingSource:
    return DrawingSource(
        name=printable(name),
        path=path,
        truth=_beside("truth", path, path.parent),
        trajectory=_beside("trajectory", path, path.parent),
    )


def _beside(what: str, drawing: Path, folder: Path) -> Path | None:
    """Return the file of a drawing's truth or trajectory in a folder, if any."""
    there = _files_of(folder)
    for stem in dict.fromkeys((drawing.stem, drawing.stem.removesuffix("_drawing"))):
        for name in _names(what, stem):
            path = there.get(name.lower())
            if path is not None and path != drawing:
                return path
    return None


def _names(what: str, stem: str) -> Iterator[str]:
    if what == "truth":
        pictures = (s for s in DRAWING_SUFFIXES if s != ".pdf")
        yield from (f"{stem}{e}{s}" for s in pictures for e in TRUTH_ENDINGS)
        return
    for ending in TRAJECTORY_ENDINGS:
        plain = PLAIN_SUFFIXES if ending else ()
        yield from (f"{stem}{ending}{s}" for s in (*TRAJECTORY_SUFFIXES, *plain))


@lru_cache(maxsize=1)
def _files_of(folder: Path) -> dict[str, Path]:
    # One listing serves all drawings of a folder.
    return {path.name.lower(): path for path in sorted(folder.iterdir())}


def _with_given(
    what: str, given: Path | None, sources: list[DrawingSource]
) -> list[DrawingSource]:
    """Return the sources with a truth or a trajectory from the place given."""
    if given is None:
        return sources
    if not given.exists():
        raise ParameterError(f"there is no file or folder {str(given)!r} ({what})")
    if given.is_dir():
        return [
            _with(what, one, _beside(what, one.path, given)) if one.path else one
            for one in sources
        ]
    if len(sources) > 1 or sources[0].path is None:
        raise ParameterError(
            f"one {what} file belongs to one drawing file; got {len(sources)} "
            "drawings: name a folder, where it is looked for by name"
        )
    return [_with(what, sources[0], given)]


def _with(what: str, source: DrawingSource, path: Path | None) -> DrawingSource:
    if what == "truth":
        return replace(source, truth=path)
    return replace(source, trajectory=path)


def _with_different_names(sources: list[DrawingSource]) -> list[DrawingSource]:
    """Return the sources, those of one name told apart by their files' paths."""
    sources = _longer(sources, lambda path, name: name + path.suffix)
    return _longer(sources, lambda path, name: str(path))


def _longer(
    sources: list[DrawingSource], rename: Callable[[Path, str], str]
) -> list[DrawingSource]:
    count = Counter(source.name for source in sources)
    return [
        replace(one, name=printable(rename(one.path, one.name)))
        if one.path and count[one.name] > 1
        else one
        for one in sources
    ]

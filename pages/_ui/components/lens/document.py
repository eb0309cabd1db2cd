"""What the student has chosen in the lens, and the texts that a link holds of it.

The browser commits the same texts, so that one reader checks both.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from occsim import BehindHit, UpdateRule, lens_world

CELL_SIZES = (2, 4, 8)
"""Sides of the cells, px; each divides the world."""
RANGE_PX = 5, 58
"""Bounds of the range; 58 px is the diagonal of the world."""
FOV_DEG = 5, 360
P_FREE = 0.02, 0.98
"""Bounds of the prior: the number line from -4 to 4."""
MAX_CHIPS = 8
"""Readings that are added up at most: as many bars as can be read."""
LIKE_PRIOR = "e", "o"
"""Chips without pixels: a cell read as entirely empty, as entirely object."""


@dataclass(frozen=True, kw_only=True, slots=True)
class LensDocument:
    """What the student has chosen in the lens.

    Parameters
    ----------
    rev : int
        Counts the times that Python imposed a document; the lens echoes it.
    x_px, y_px, heading_deg : float
        The robot, on a free pixel of the world; clockwise on the screen, in [0, 360).
    cell_px : int
        Side of the cells, one of `CELL_SIZES`.
    row, col : int
        The selected cell.
    range_px, fov_deg : int
        Of the sensor.
    behind_hit : BehindHit
        What is said of pixels behind a wall.
    clear_no_hit : bool
        Whether a ray that meets nothing clears its pixels.
    p_free : float
        The prior of the readings that add up.
    rule : UpdateRule
        How they are added.
    chips : tuple of str
        The readings: one of `LIKE_PRIOR`, or the numbers of empty and of object pixels,
        as ``"8.8"``.
    """

    rev: int = 1
    x_px: float = 8.5
    y_px: float = 10.5
    heading_deg: float = 0.0
    cell_px: int = 4
    row: int = 2
    col: int = 9
    range_px: int = 36
    fov_deg: int = 30
    behind_hit: BehindHit = BehindHit.OCCUPIED
    clear_no_hit: bool = True
    p_free: float = 0.18
    rule: UpdateRule = UpdateRule.PRIOR_ONCE
    chips: tuple[str, ...] = ("e",)


OPENING = LensDocument()


def to_texts(document: LensDocument) -> dict[str, str]:
    """Return the student's choices as texts."""
    return {name: write(document) for name, (write, _) in PARTS.items()}


def link_texts(document: LensDocument) -> dict[str, str]:
    """Return the texts that differ from the opening ones."""
    opening = to_texts(OPENING)
    return {n: t for n, t in to_texts(document).items() if t != opening[n]}


def with_texts(
    document: LensDocument, texts: Mapping[str, object]
) -> tuple[LensDocument, list[str]]:
    """Return a document with what the texts say, and the names of unusable ones.

    The input is not trusted: what is missing or wrong leaves its part as it is.
    """
    wrong = []
    for name, (_, read) in PARTS.items():
        if name not in texts:
            continue
        try:
            document = replace(document, **read(_short(texts[name]), document))
        except (ValueError, OverflowError):
            wrong.append(name)
    return document, wrong


def decode_commit(commit: object, document: LensDocument) -> LensDocument:
    """Return the document that a browser committed; one of another rev is ignored."""
    if not isinstance(commit, Mapping) or commit.get("rev") != document.rev:
        return document
    return with_texts(document, commit)[0]


# --- One reader a part: text in, fields out; ValueError where it is unusable ---------

Fields = dict[str, Any]


def _short(text: object) -> str:
    if not isinstance(text, str) or len(text) > 100:
        raise ValueError("what is read must be a short text")
    return text


def _pose(text: str, _: LensDocument) -> Fields:
    x, y, heading = (float(part) for part in text.split("_"))
    height, width = lens_world().shape
    # Also false for NaN, which compares with nothing.
    if not (0 <= x < width and 0 <= y < height and math.isfinite(heading)):
        raise ValueError("the robot must stand in the world")
    if lens_world().occupied[int(y), int(x)]:
        raise ValueError("the robot must stand on a free pixel")
    # A heading just below 0 is 360 after rounding.
    return {"x_px": x, "y_px": y, "heading_deg": heading % 360 % 360}


def _size(text: str, document: LensDocument) -> Fields:
    size = int(_one_of(text, [str(one) for one in CELL_SIZES]))
    n_rows, n_cols = (side // size for side in lens_world().shape)
    cell = {"row": min(document.row, n_rows - 1), "col": min(document.col, n_cols - 1)}
    return {"cell_px": size, **cell}


def _cell(text: str, document: LensDocument) -> Fields:
    row, col = (int(part) for part in text.split("_"))
    n_rows, n_cols = (side // document.cell_px for side in lens_world().shape)
    if not (0 <= row < n_rows and 0 <= col < n_cols):
        raise ValueError("the cell must lie in the world")
    return {"row": row, "col": col}


def _chips(text: str, _: LensDocument) -> Fields:
    chips = tuple(text.split("_")) if text else ()
    if len(chips) > MAX_CHIPS or not all(map(_is_chip, chips)):
        raise ValueError(f"there are at most {MAX_CHIPS} readings, e, o or 8.8")
    return {"chips": chips}


def _is_chip(chip: str) -> bool:
    if chip in LIKE_PRIOR:
        return True
    empty, _, objects = chip.partition(".")
    if not (empty.isascii() and empty.isdigit()):
        return False
    if not (objects.isascii() and objects.isdigit()):
        return False
    return 0 < int(empty) + int(objects) <= max(CELL_SIZES) ** 2


def _one_of(text: str, options: tuple[str, ...] | list[str]) -> str:
    if text not in options:
        raise ValueError(f"must be one of {', '.join(options)}; got {text!r}")
    return text


def _number(text: str, bounds: tuple[float, float]) -> float:
    number = float(text)
    if not bounds[0] <= number <= bounds[1]:
        raise ValueError(f"must lie in {bounds[0]} to {bounds[1]}; got {text!r}")
    return number


def _rounded(value: float) -> str:
    return f"{value:.10g}"


PARTS: Mapping[
    str,
    tuple[Callable[[LensDocument], str], Callable[[str, LensDocument], Fields]],
] = {
    "pose": (
        lambda d: "_".join(map(_rounded, (d.x_px, d.y_px, d.heading_deg))),
        _pose,
    ),
    "size": (lambda d: str(d.cell_px), _size),
    "cell": (lambda d: f"{d.row}_{d.col}", _cell),
    "range": (
        lambda d: str(d.range_px),
        lambda text, _: {"range_px": int(_number(text, RANGE_PX))},
    ),
    "fov": (
        lambda d: str(d.fov_deg),
        lambda text, _: {"fov_deg": int(_number(text, FOV_DEG))},
    ),
    "behind": (
        lambda d: d.behind_hit.value,
        lambda text, _: {"behind_hit": BehindHit(text)},
    ),
    "clear": (
        lambda d: str(int(d.clear_no_hit)),
        lambda text, _: {"clear_no_hit": _one_of(text, ["0", "1"]) == "1"},
    ),
    "prior": (
        lambda d: _rounded(d.p_free),
        lambda text, _: {"p_free": round(_number(text, P_FREE), 2)},
    ),
    "rule": (lambda d: d.rule.value, lambda text, _: {"rule": UpdateRule(text)}),
    "chips": (lambda d: "_".join(d.chips), _chips),
}
"""How each part of a document is written, and how it is read; the size of the cells
comes before the cell."""

"""The words and colours of the player."""

from collections.abc import Mapping, Sequence
from enum import Enum

from occsim import BehindHit, UpdateRule
from occsim.prior import SOURCE_PAIR
from pages._ui import palette
from pages._ui.choices import CHOICES, CellModel, Flaw, Laps, Overlay, PriorDrawing
from pages._ui.columns import MAX_COLUMNS
from pages._ui.course import COURSE
from pages._ui.glossary import meaning

ABOUT = {
    UpdateRule.SUBTRACT_PRIOR: "Each reading adds its log-odds less the prior's, l_0.",
    UpdateRule.PRIOR_ONCE: "Each reading adds its log-odds; the prior counts once.",
}
SCORES = (
    ("precision", "Precision", "right of the declared", "share"),
    ("recall", "Recall", "found of the walls", "share"),
    ("f2", "F2", "recall counts double", "share"),
    ("bits", "Bits per cell", "log loss: less is better", "bits"),
)
"""Of one map: name, label, what it is, unit."""
CURVES = (
    ("f2", "F2", "cells looked at", "share", "looked"),
    ("bits", "Bits per cell", "all cells: less is better", "bits", "all"),
    ("found", "Walls found", "cells not looked at", "cells", "unseen"),
    ("falseWalls", "False walls", "cells not looked at", "cells", "unseen"),
)
"""Of several maps: the same, and the cells that count."""
ERRORS = (
    ("hit", "hit"),
    ("false_wall", "false wall"),
    ("missed_wall", "missed wall"),
    ("free", "free"),
)
WORD_NAMES = {
    "drawing": "Drawing for the prior",
    "pair": "Prior pair: p_wall, p_space",
    "rule": "Update rule",
    "flaw": "The drawing's errors",
    "behind_hit": "Behind a hit",
    "cell_px": "Cell size",
    "model": "Cell model",
    "laps": "Laps of the same tour",
}
RULES = {
    UpdateRule.PRIOR_ONCE: "once",
    UpdateRule.SUBTRACT_PRIOR: "taken off at every reading",
}
BEHIND = {
    BehindHit.OCCUPIED: "occupied behind a hit",
    BehindHit.UNSEEN: "unseen behind a hit",
}
DRAWINGS = {
    PriorDrawing.OWN: "this drawing",
    PriorDrawing.MIRRORED: "its mirror image",
    PriorDrawing.EMPTY: "an empty sheet",
}
MODELS = {
    CellModel.LOG_ODDS: "log-odds",
    CellModel.HITS_VISITS: "hits by visits (gmapping)",
}
NO_DRAWING = {"value": "none", "label": "no drawing"}
CELL_SIZES_PX = (1, 2, 3, 5, 10)

STORY = {
    "maps": {
        "none": "No drawing",
        "own": "This building's drawing",
        "other": "Another building's drawing",
    },
    "watch": "Where the robot looks, it finds out. Where it does not look, it believes "
    "the drawing.",
    "question": COURSE[0].predict,
    "answers": {name: said.capitalize() for name, said in COURSE[0].options.items()},
    "switch": "Count the drawing",
    "rules": {
        UpdateRule.PRIOR_ONCE.value: "once",
        UpdateRule.SUBTRACT_PRIOR.value: "again at every reading",
    },
    "meanings": {
        name: meaning(name)
        for name in ("looked at", "not looked at", "walls found", "false walls", "F2")
    },
}
"""The home page's replay: its maps by what they start from, and what it says."""


def _option(value: Enum | int, label: str) -> dict[str, str]:
    return {
        "value": str(value.value) if isinstance(value, Enum) else str(value),
        "label": label,
    }


def _options(kind: type[Enum]) -> list[dict[str, str]]:
    return [{**_option(one, CHOICES[one]), "about": ABOUT.get(one, "")} for one in kind]


def _pair_text(p_wall: float, p_space: float, about: str) -> dict[str, str]:
    # As the browser writes numbers: 1, not 1.0.
    texts = [f"{value:g}" for value in (p_wall, p_space)]
    return {"value": ",".join(texts), "label": f"{', '.join(texts)} ({about})"}


def _laps_text(laps: Laps) -> str:
    return f"{laps.value} lap{'s' * (laps is not Laps.ONE)}"


def header_words(
    drawings: Sequence[PriorDrawing], fixed: Mapping[str, object]
) -> dict[str, list[dict[str, str]]]:
    """The choices for each word of a map's header; drawings of the building's size.

    Of what the page chooses, its choice alone.
    """
    words = _header_words(drawings)
    for name, value in fixed.items():
        if name in words:
            words[name] = [one for one in words[name] if one["value"] == str(value)]
    return words


def _header_words(drawings: Sequence[PriorDrawing]) -> dict[str, list[dict[str, str]]]:
    titles = {one: f"the drawing of {one.value}" for one in drawings} | DRAWINGS
    return {
        "drawing": [*(_option(one, titles[one]) for one in drawings), NO_DRAWING],
        "pair": [
            _pair_text(*SOURCE_PAIR, "the source"),
            _pair_text(0.1, 1.0, "bold"),
            {"value": "calibrated", "label": "calibrated on the truth"},
        ],
        "rule": [_option(one, label) for one, label in RULES.items()],
        "flaw": [_option(one, CHOICES[one]) for one in Flaw],
        "behind_hit": [_option(one, label) for one, label in BEHIND.items()],
        "cell_px": [_option(size, f"{size} px cells") for size in CELL_SIZES_PX],
        "model": [_option(one, label) for one, label in MODELS.items()],
        "laps": [_option(one, _laps_text(one)) for one in Laps],
    }


def overlay_options(*, has_truth: bool) -> list[dict[str, str]]:
    """What can be shown over a map; without a truth, nothing that needs one."""
    needs_truth = {Overlay.TRUTH.value, Overlay.ERRORS.value}
    options = _options(Overlay)
    return [one for one in options if has_truth or one["value"] not in needs_truth]


TEXTS = {
    "rules": _options(UpdateRule),
    "scores": [
        {"name": k, "label": n, "about": a, "unit": u, "meaning": meaning(n)}
        for k, n, a, u in SCORES
    ],
    "curves": [
        {
            "name": k,
            "label": n,
            "about": a,
            "unit": u,
            "region": r,
            "meaning": meaning(n),
        }
        for k, n, a, u, r in CURVES
    ],
    "errors": [{"mark": k, "label": n} for k, n in ERRORS],
    "wordNames": WORD_NAMES,
    "answers": [
        *({"value": i, "label": "ABC"[i]} for i in range(MAX_COLUMNS)),
        {"value": MAX_COLUMNS, "label": "none more than another"},
    ],
    "story": STORY,
}
COLOURS = {
    "beliefOccupied": palette.BELIEF_OCCUPIED,
    "beliefFree": palette.BELIEF_FREE,
    "evidenceWall": palette.EVIDENCE_WALL,
    "evidenceFree": palette.EVIDENCE_FREE,
    "hit": palette.HIT,
    "falseWall": palette.FALSE_WALL,
    "missedWall": palette.MISSED_WALL,
    "free": palette.FREE,
    "unseen": palette.UNSEEN,
    "hatchDark": palette.HATCH_DARK,
    "hatchLight": palette.HATCH_LIGHT,
    "paper": palette.PAPER,
    "ink": palette.ON_PAPER,
    "line": palette.UNSEEN,
    "wallMask": palette.WALL_MASK,
    "groundTruth": palette.GROUND_TRUTH,
    "path": palette.PATH,
    "robot": palette.ROBOT,
    "sensor": palette.SENSOR,
    "halo": palette.HALO,
    "crosshair": palette.CROSSHAIR,
    "blank": palette.GUIDE,
    "columns": palette.COLUMNS,
}

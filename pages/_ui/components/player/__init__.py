"""The map player: a mapping run replayed in the browser, with controls for the prior.

One Streamlit component. Python sends a replay (`occsim.io.replay`) and a document
once; the player fuses, scores and draws by itself and tells Python what the student
chose at the end of each gesture. The scripts beside this file are plain functions,
joined here in a fixed order into the single module that Streamlit expects.
"""

import zlib
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from enum import Enum
from pathlib import Path
from typing import Any

from occsim import Region, UpdateRule
from occsim.logodds import DECISION_EPS
from occsim.prior import PRIOR_SCALE
from pages._ui import palette
from pages._ui.choices import CHOICES, Overlay
from pages._ui.components import component, keep_state, packed
from pages._ui.settings import TABLE, Settings, with_changes

FOLDER = Path(__file__).parent
SCRIPTS = (
    "replay.js",
    "model.js",
    "cells.js",
    "stage.js",
    "draw.js",
    "curves.js",
    "terms.js",
    "playback.js",
    "controls.js",
    "inspector.js",
    "player.js",
)
COMPONENT = "map_player"
SPEEDS = (5, 15, 30, 60, 120)
"""Readings per second."""
SHARED = ("p_wall", "p_space", "uninformative", "rule", "region", "overlay")
"""Fields of a document that are settings of the app as well."""
BOUND = 1_000_000
"""More than any drawing's pixels along a side, or any trajectory's poses."""


@dataclass(frozen=True, kw_only=True, slots=True)
class PlayerDocument:
    """What the student has chosen in the player.

    Parameters
    ----------
    rev : int
        Counts the times that Python imposed a document; the player echoes it.
    p_wall, p_space : float
        The prior, within the bounds of the settings.
    uninformative : bool
        Whether the prior is one half everywhere, whatever p_wall and p_space are.
    rule : UpdateRule
        How a reading enters the map.
    region : Region
        Cells that are scored.
    overlay : Overlay
        What the map shows.
    step : int
        Number of readings in the map; the player clamps it to the run's number.
    speed : int or None
        Readings per second, one of `SPEEDS`; None lets a replay last about 10 s.
    pin_px : tuple of float or None
        Point x, y of the drawing, px, whose cell is pinned.
    compact : bool
        A replay that runs by itself and has no controls but play and pause.
    """

    rev: int = 0
    p_wall: float = 0.2
    p_space: float = 0.9
    uninformative: bool = False
    rule: UpdateRule = UpdateRule.PRIOR_ONCE
    region: Region = Region.EXPLORED
    overlay: Overlay = Overlay.NONE
    step: int = 0
    speed: int | None = None
    pin_px: tuple[float, float] | None = None
    compact: bool = False


ABOUT = {
    UpdateRule.SUBTRACT_PRIOR: "Each reading adds its log-odds less the prior's, l_0.",
    UpdateRule.PRIOR_ONCE: "Each reading adds its log-odds; the prior counts once.",
}
SCORES = (
    ("precision", "Precision", "declared walls that are walls"),
    ("recall", "Recall", "walls that were declared"),
    ("f2", "F2", "recall weighs twice as much"),
    ("coverage", "Coverage", "cells seen at least once"),
)
ERRORS = (
    ("hit", "hit"),
    ("false_wall", "false wall"),
    ("missed_wall", "missed wall"),
    ("free", "free"),
    ("unseen", "unseen"),
)


def _options(kind: type[Enum]) -> list[dict[str, str]]:
    return [
        {"value": one.value, "label": CHOICES[one], "about": ABOUT.get(one, "")}
        for one in kind
    ]


TEXTS = {
    "rules": _options(UpdateRule),
    "overlays": _options(Overlay),
    "regions": _options(Region),
    "scores": [{"name": k, "label": n, "about": a} for k, n, a in SCORES],
    "errors": [{"mark": k, "label": n} for k, n in ERRORS],
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
    "unseenHatch": palette.UNSEEN_HATCH,
    "paper": palette.PAPER,
    "wallMask": palette.WALL_MASK,
    "groundTruth": palette.GROUND_TRUTH,
    "path": palette.PATH,
    "robot": palette.ROBOT,
    "sensor": palette.SENSOR,
    "halo": palette.HALO,
    "crosshair": palette.CROSSHAIR,
    "mark": palette.MARK,
}


def map_player(
    replay: bytes,
    document: PlayerDocument,
    *,
    key: str,
    on_commit: Callable[[], None] | None = None,
) -> PlayerDocument:
    """Show the player; return what the student has chosen in it.

    How the caller keeps state. Hold two documents: the one *imposed* (the argument
    here) and the one that is *current* (what this call returned last). Pass the imposed
    one unchanged from run to run: replay and document travel together, and any change
    sends both. Impose another, ``replace(current, rev=rev + 1, ...)``, only where the
    change comes from outside the player (reset, share link), and where `key` is not in
    session state, because then the page was left and the browser dropped the player's
    state. A commit that echoes an older rev is ignored, so that a late one never undoes
    what was imposed. A new replay under the same rev (a changed cell size) stops a
    running playback and leaves the student's choices as they are, the step clamped to
    the number of readings.

    Parameters
    ----------
    replay : bytes
        From `occsim.io.replay.pack_replay`.
    document : PlayerDocument
        The imposed document.
    key : str
        Key of the component.
    on_commit : callable, optional
        Called before the run in which a commit arrives.

    Returns
    -------
    PlayerDocument
        The last commit on this rev, decoded and checked; before the first, the imposed
        document.
    """
    result = component(COMPONENT, FOLDER, SCRIPTS)(
        key=key,
        data=player_data(replay, document, key),
        on_committed_change=on_commit or keep_state,
    )
    return decode_commit(result.get("committed"), document)


def player_data(replay: bytes, document: PlayerDocument, key: str) -> bytes:
    """Return what the browser gets: header and replay."""
    header = {
        "key": key,
        "digest": f"{len(replay)}-{zlib.crc32(replay)}",
        "document": encode_document(document),
        "constants": {"decisionEps": DECISION_EPS, "priorScale": PRIOR_SCALE},
        "limits": {name: _limits(name) for name in ("p_wall", "p_space")},
        "speeds": SPEEDS,
        "colours": COLOURS,
        "texts": TEXTS,
    }
    return packed(header, replay)


def _limits(name: str) -> dict[str, float]:
    setting = TABLE[name]
    return {"min": setting.low, "max": setting.high, "step": setting.step}


def encode_document(document: PlayerDocument) -> dict[str, object]:
    """Return the document as JSON values."""
    return {
        name: value.value if isinstance(value, Enum) else value
        for name, value in asdict(document).items()
    }


def decode_commit(commit: object, document: PlayerDocument) -> PlayerDocument:
    """Return the document that a browser committed, every field checked.

    The input is not trusted: a value that is not a mapping, or echoes another rev,
    leaves `document` unchanged; a field that is missing or of the wrong kind keeps its
    value.
    """
    if not isinstance(commit, Mapping) or commit.get("rev") != document.rev:
        return document
    choices = {
        name: _checked(name, commit.get(name), getattr(document, name))
        for name in SHARED
    }
    speed = commit.get("speed")
    step = _bounded(commit.get("step"))
    return replace(
        document,
        **choices,
        step=document.step if step is None else int(step),
        speed=speed if speed in SPEEDS else document.speed,
        pin_px=_point(commit.get("pin_px")),
    )


def _checked(name: str, value: object, otherwise: Any) -> Any:
    """Return a value that the settings accept, else the default given."""
    try:
        return getattr(with_changes(Settings(), {name: value}), name)
    except (ValueError, TypeError, OverflowError):
        return otherwise


def _bounded(value: object) -> float | None:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return value if 0 <= value <= BOUND else None


def _point(value: object) -> tuple[float, float] | None:
    if not isinstance(value, (list, tuple)) or len(value) != 2:
        return None
    x, y = (_bounded(v) for v in value)
    return None if x is None or y is None else (float(x), float(y))

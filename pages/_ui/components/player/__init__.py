"""The map player: one mapping run or several on one clock, replayed in the browser.

One Streamlit component. Python sends the parts of a replay (`occsim.io.replay`) and a
document once; the player fuses, scores and draws by itself and tells Python what the
student chose at the end of each gesture. The scripts beside this file are plain
functions, joined here in a fixed order into the single module that Streamlit expects.
"""

import zlib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from occsim import __version__
from occsim.io.replay_beams import HIT
from occsim.logodds import DECISION_EPS
from occsim.prior import PRIOR_SCALE
from occsim.scan.cell_model import OCCUPIED_ABOVE
from occsim.sensor import LOG_ODDS_MAX
from pages._ui.choices import PriorDrawing
from pages._ui.columns import Column
from pages._ui.components import SAVING, component, keep_state, packed
from pages._ui.components.player.document import (
    SPEEDS,
    PlayerDocument,
    decode_commit,
    encode_document,
    held_parts,
)
from pages._ui.components.player.texts import (
    COLOURS,
    TEXTS,
    header_words,
    overlay_options,
)
from pages._ui.limits import NONE, Limits
from pages._ui.settings import TABLE

__all__ = [
    "SCRIPTS",
    "SPEEDS",
    "Part",
    "PlayerDocument",
    "Replay",
    "decode_commit",
    "encode_document",
    "held_parts",
    "map_player",
    "player_data",
]

FOLDER = Path(__file__).parent
SCRIPTS = (
    *SAVING,
    "replay.js",
    "model.js",
    "scores.js",
    "verdicts.js",
    "parts.js",
    "cells.js",
    "stage.js",
    "draw.js",
    "curves.js",
    "terms.js",
    "feet.js",
    "limits.js",
    "playback.js",
    "controls.js",
    "inspector.js",
    "headers.js",
    "referee.js",
    "several.js",
    "story.js",
    "figures.js",
    "gif.js",
    "film.js",
    "report.js",
    "commits.js",
    "player.js",
)
COMPONENT = "map_player"
CONSTANTS = {
    "decisionEps": DECISION_EPS,
    "priorScale": PRIOR_SCALE,
    "hit": HIT,
    "occupiedAbove": OCCUPIED_ABOVE,
    "declared": LOG_ODDS_MAX,
}
"""Numbers of the library that the player computes with."""


@dataclass(frozen=True)
class Part:
    """One part of a replay: a scene, a log, walls or beams, from `occsim.io`.

    The name says which log or walls it is; ``parts.js`` builds the same names from the
    setting of a map.
    """

    kind: str
    name: str
    data: bytes

    @cached_property
    def id(self) -> str:
        """What tells it from parts with other bytes."""
        return f"{len(self.data):x}-{zlib.crc32(self.data):x}"


@dataclass(frozen=True, eq=False)
class Replay:
    """The parts that some maps need, and what their names rest on.

    ``base`` changes with the building, the sensor and all else that a part's name does
    not say. ``drawings`` are those that the prior of this building can be made from.
    Without a truth there are no scores, without a prior no controls of one. ``paper``
    names the picture beside a single map.
    """

    base: str
    parts: tuple[Part, ...]
    drawings: tuple[PriorDrawing, ...]
    has_truth: bool = True
    has_prior: bool = True
    paper: str = "Drawing"


def map_player(
    replay: Replay,
    document: PlayerDocument,
    *,
    key: str,
    held: Collection[str] = (),
    fixed: Mapping[str, object] | None = None,
    examples: Sequence[tuple[str, tuple[Column, ...]]] = (),
    asks: bool = True,
    limits: Limits = NONE,
) -> None:
    """Show the player.

    How the caller keeps state. Hold two documents: the one *imposed* (the argument
    here) and the one that is *current*: ``decode_commit(commit, imposed)`` of what the
    session's state holds as "committed" under `key`. Pass the imposed one unchanged
    from run to run. Impose another, ``replace(current, rev=rev + 1, ...)``, only where
    the change comes from outside the player (reset, share link), and where `key` is
    not in session state, because then the page was left and the browser dropped the
    player's state. A commit that echoes an older rev is ignored, so that a late one
    never undoes what was imposed. New parts under the same rev (a changed cell size)
    stop a running playback and leave the student's choices as they are, the step
    clamped to the number of readings.

    Parameters
    ----------
    replay : Replay
        The parts that the current document's columns need.
    document : PlayerDocument
        The imposed document.
    key : str
        Key of the component.
    held : collection of str
        Ids of the parts that the browser has: `held_parts` of the last commit. They
        are not sent again.
    fixed : mapping, optional
        Fields of every column that the page chooses, not the player.
    examples : sequence of (str, tuple of Column)
        Settings of several maps that a button each sets.
    asks : bool
        Whether several maps ask, before they start, which will find more.
    limits : Limits
        What is hidden and locked; Python holds the values, the player its controls.
    """
    component(COMPONENT, FOLDER, SCRIPTS)(
        key=key,
        data=player_data(replay, document, key, held, fixed, examples, asks, limits),
        on_committed_change=keep_state,
    )


def player_data(
    replay: Replay,
    document: PlayerDocument,
    key: str,
    held: Collection[str] = (),
    fixed: Mapping[str, object] | None = None,
    examples: Sequence[tuple[str, tuple[Column, ...]]] = (),
    asks: bool = True,
    limits: Limits = NONE,
) -> bytes:
    """Return what the browser gets: the header, and the parts that it does not hold."""
    parts = [{"kind": p.kind, "name": p.name, "id": p.id} for p in replay.parts]
    header = {
        "key": key,
        "digest": f"{zlib.crc32(repr((replay.base, parts, fixed)).encode()):x}",
        "hidden": sorted(limits.hidden),
        "locked": sorted(limits.locked),
        "together": limits.together,
        "base": replay.base,
        "parts": parts,
        "document": encode_document(document),
        "fixed": dict(fixed or {}),
        "hasTruth": replay.has_truth,
        "hasPrior": replay.has_prior,
        "paper": replay.paper,
        "constants": CONSTANTS,
        "limits": {name: _limits(name) for name in ("p_wall", "p_space")},
        "speeds": SPEEDS,
        "software": f"occsim {__version__}",
        "colours": COLOURS,
        "texts": {
            **TEXTS,
            "words": header_words(replay.drawings, fixed or {}),
            "overlays": overlay_options(has_truth=replay.has_truth),
            "presets": [_example(*example) for example in examples],
            "answers": TEXTS["answers"] if asks else [],
        },
    }
    return packed(header, *(b"" if p.id in held else p.data for p in replay.parts))


def _limits(name: str) -> dict[str, float]:
    setting = TABLE[name]
    return {"min": setting.low, "max": setting.high, "step": setting.step}


def _example(label: str, columns: tuple[Column, ...]) -> dict[str, Any]:
    encoded = encode_document(PlayerDocument(columns=columns))
    return {"label": label, "columns": encoded["columns"]}

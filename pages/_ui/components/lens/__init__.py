"""The lens: one reading at pixel level, and how readings add up.

One Streamlit component. Python sends the world and a document once; the lens casts the
rays, counts and draws by itself and tells Python what the student chose at the end of
each gesture. The scripts beside this file are plain functions, joined here in a fixed
order into the single module that Streamlit expects.
"""

import json
from pathlib import Path

from occsim import World, __version__, lens_world
from occsim.sensor import (
    EDGE_EPS,
    OWN_PIXEL_EPS_PX,
    P_FREE_MAX,
    P_FREE_MIN,
    SURFACE_DEPTH_PX,
)
from pages._ui import palette
from pages._ui.components import SAVING, component, keep_state
from pages._ui.components.lens.document import (
    CELL_SIZES,
    FOV_DEG,
    MAX_CHIPS,
    P_FREE,
    RANGE_PX,
    LensDocument,
    to_texts,
)
from pages._ui.limits import NONE, Limits

FOLDER = Path(__file__).parent
SCRIPTS = (
    *SAVING,
    "optics.js",
    "adding.js",
    "document.js",
    "stage.js",
    "pointer.js",
    "cell.js",
    "line.js",
    "counting.js",
    "controls.js",
    "figures.js",
    "lens.js",
)
COMPONENT = "sensor_lens"
COLOURS = {
    "paper": palette.PAPER,
    "halo": palette.HALO,
    "wall": palette.WALL,
    "empty": palette.READ_EMPTY,
    "object": palette.READ_OBJECT,
    "hidden": palette.READ_HIDDEN,
    "unsaid": palette.UNSEEN,
    "ink": palette.ON_PAPER,
    "robot": palette.ROBOT,
    "sensor": palette.SENSOR,
    "crosshair": palette.CROSSHAIR,
    "evidenceFree": palette.EVIDENCE_FREE,
    "evidenceWall": palette.EVIDENCE_WALL,
    "prior": palette.GUIDE,
}
CONSTANTS = {
    "edgeEps": EDGE_EPS,
    "ownPixelEps": OWN_PIXEL_EPS_PX,
    "surfaceDepth": SURFACE_DEPTH_PX,
    "pFreeMin": P_FREE_MIN,
    "pFreeMax": P_FREE_MAX,
}


def lens(document: LensDocument, *, key: str, limits: Limits = NONE) -> None:
    """Show the lens; `decode_commit` reads what it commits.

    Parameters
    ----------
    document : LensDocument
        The imposed document; the same one from run to run, see `map_player`.
    key : str
        Key of the component: the last commit is its state "committed".
    limits : Limits
        What is hidden and locked.
    """
    component(COMPONENT, FOLDER, SCRIPTS)(
        key=key, data=lens_data(document, key, limits), on_committed_change=keep_state
    )


def lens_data(document: LensDocument, key: str, limits: Limits = NONE) -> str:
    """Return what the browser gets, as JSON."""
    header = {
        "key": key,
        "document": {"rev": document.rev, **to_texts(document)},
        "hidden": sorted(limits.hidden),
        "locked": sorted(limits.locked),
        "world": picture_of(lens_world()),
        "constants": CONSTANTS,
        "limits": {"range": RANGE_PX, "fov": FOV_DEG, "prior": P_FREE},
        "cellSizes": CELL_SIZES,
        "maxChips": MAX_CHIPS,
        "colours": COLOURS,
        "software": f"occsim {__version__}",
    }
    return json.dumps(header, allow_nan=False)


def picture_of(world: World) -> list[str]:
    """A world as rows of text: # is wall, a full stop is free."""
    return ["".join(".#"[wall] for wall in row) for row in world.occupied.tolist()]

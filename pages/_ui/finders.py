"""Range finders that robots carry, as settings of the simulated sensor."""

import math
from typing import Any

from occsim import BehindHit
from occsim.scan import RANGE_FINDERS
from pages._ui.settings import TABLE, Settings

EXACT = "exact"
"""The source's cone: every pixel looked at, without errors."""
NAMES = (EXACT, *RANGE_FINDERS)
OF_SENSOR = ("range_px", "fov_deg", "behind_hit")
OF_READINGS = (
    "beams",
    "sigma_0_m",
    "sigma_2_per_m",
    "sigma_from_m",
    "dropout_share",
    "short_share",
    "glass_share",
)
OF_POSES = ("position_sigma_m", "heading_sigma_deg", "odometry_drift")
OF_ERRORS = (*OF_READINGS, *OF_POSES)
"""The settings of beams and errors; without any of them readings are exact."""


def title(name: str) -> str:
    """What a range finder is called on screen."""
    return "Exact cone" if name == EXACT else RANGE_FINDERS[name].title


def changes(name: str, opening: Settings, metres_per_px: float) -> dict[str, Any]:
    """The settings that a range finder sets, within what the sliders allow.

    `opening` has the exact cone's.
    """
    default = {one: getattr(opening, one) for one in (*OF_SENSOR, *OF_ERRORS)}
    if name == EXACT:
        return default
    finder = RANGE_FINDERS[name]
    return default | {
        "range_px": _within("range_px", round(finder.max_range_m / metres_per_px)),
        "fov_deg": _within("fov_deg", round(math.degrees(finder.fov_rad))),
        "behind_hit": BehindHit.UNSEEN,
        "beams": finder.n_beams,
        "sigma_0_m": finder.sigma_0_m,
        "sigma_2_per_m": finder.sigma_2_per_m,
        "sigma_from_m": finder.sigma_from_m,
    }


def _within(name: str, value: int) -> int:
    bounds = TABLE[name]
    return int(min(max(value, bounds.low), bounds.high))


def current(settings: Settings, opening: Settings, metres_per_px: float) -> str | None:
    """The range finder that some settings are; None where they are none of them."""
    for name in NAMES:
        wanted = changes(name, opening, metres_per_px)
        if all(getattr(settings, one) == value for one, value in wanted.items()):
            return name
    return None


def reach_note(name: str | None, metres_per_px: float) -> str:
    """Where a sheet's range exceeds what the slider allows, a sentence."""
    if name in (None, EXACT):
        return ""
    most_m = TABLE["range_px"].high * metres_per_px
    reach_m = RANGE_FINDERS[name].max_range_m
    if reach_m <= most_m:
        return ""
    return f"It reaches {reach_m:g} m; here, {most_m:.1f} m."

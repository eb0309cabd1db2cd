"""Named sets of conditions: by Bayes' rule, and as in the source."""

from collections.abc import Mapping
from typing import Any

from occsim import BehindHit, Region, UpdateRule
from pages._ui.choices import Preset
from pages._ui.settings import Settings

PRESETS: Mapping[Preset, Mapping[str, Any]] = {
    Preset.BAYES: {
        "rule": UpdateRule.PRIOR_ONCE,
        "behind_hit": BehindHit.OCCUPIED,
        "region": Region.EXPLORED,
        "thickness_px": 0,
    },
    Preset.SOURCE: {
        "rule": UpdateRule.SUBTRACT_PRIOR,
        "behind_hit": BehindHit.OCCUPIED,
        "region": Region.EXPLORED,
        "thickness_px": -2,
    },
}
"""The settings that each preset sets. The source's rule and the thickness of its walls
are our reconstruction: it prints neither."""
_PARTS = {
    "rule": "update rule",
    "behind_hit": "behind a hit",
    "region": "scored region",
    "thickness_px": "thickness of the drawing's walls",
}


def departures(settings: Settings, preset: Preset) -> list[str]:
    """Name the parts in which some settings differ from a preset."""
    return [
        _PARTS[name]
        for name, value in PRESETS[preset].items()
        if getattr(settings, name) != value
    ]


def nearest(settings: Settings) -> Preset:
    """Return the preset with the fewest departures; by Bayes' rule if they tie."""
    return min(Preset, key=lambda preset: len(departures(settings, preset)))


def current(settings: Settings) -> Preset | None:
    """Return the preset that some settings are; None where they left every one."""
    preset = nearest(settings)
    return None if departures(settings, preset) else preset

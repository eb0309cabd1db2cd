"""How a setting is declared: its default, bounds and texts on screen."""

from dataclasses import dataclass, field
from typing import Any

from occsim import DrawingFlaws, ScanNoise


@dataclass(frozen=True, kw_only=True, slots=True)
class Setting:
    """One setting: its bounds or choices, and its texts on screen."""

    label: str
    help: str
    low: float = 0.0
    high: float = 1.0
    step: float = 1.0
    unit: str = ""


def setting(default: Any, **declared: Any) -> Any:
    """Return a field of `Settings` with its bounds and texts."""
    return field(default=default, metadata={"setting": Setting(**declared)})


def flaw(name: str, **declared: Any) -> Any:
    """Return a field that is a field of `DrawingFlaws`: the library has its bounds."""
    bounds = DrawingFlaws.bounds(name)
    default = getattr(DrawingFlaws(), name)
    return setting(
        int(default) if bounds.step == int(bounds.step) else default,
        low=bounds.low,
        high=bounds.high,
        step=bounds.step,
        **declared,
    )


def error(name: str, **declared: Any) -> Any:
    """Return a field that is a field of `ScanNoise`: the library has its bounds."""
    bounds = ScanNoise.bounds(name)
    return setting(0.0, low=bounds.low, high=bounds.high, step=bounds.step, **declared)

"""Parameter classes as plain values, as JSON holds them."""

from dataclasses import asdict
from enum import Enum
from typing import Any


def plain(parameters: Any) -> dict[str, Any]:
    """Return the fields of a parameter class as plain values."""
    return {
        name: value.value if isinstance(value, Enum) else value
        for name, value in asdict(parameters).items()
    }

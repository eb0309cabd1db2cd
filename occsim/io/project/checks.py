"""Checks of single values of a project's JSON."""

import math

MAX_TEXT = 2000
"""Longest title or setting, characters."""


def is_text(value: object) -> bool:
    """Whether a value is text, can be encoded, and is not too long."""
    if not isinstance(value, str) or len(value) > MAX_TEXT:
        return False
    # JSON may hold a lone surrogate.
    return not any("\ud800" <= character <= "\udfff" for character in value)


def is_number(value: object) -> bool:
    """Whether a value is a finite number of usual size."""
    # bool is an int to Python; a huge int has no float.
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) < 1e15 and math.isfinite(value)


def written_text(text: str) -> str:
    """Return a text that can be read back: valid Unicode and not too long."""
    return text.encode("utf-8", "replace").decode()[:MAX_TEXT]

"""Settings from outside values, checked, and as the text of a link."""

from collections.abc import Mapping
from dataclasses import fields, replace
from enum import Enum
from typing import Any

from pages._ui.columns import Column, columns_given, columns_text, plain
from pages._ui.settings.settings import TABLE, Settings


def with_changes(settings: Settings, changes: Mapping[str, Any]) -> Settings:
    """Return the settings with some replaced; values out of bounds are refused.

    Raises
    ------
    ValueError
        With one sentence: what is wrong, what is allowed, what was got.
    """
    checked = {name: _checked(name, value) for name, value in changes.items()}
    return replace(settings, **checked)


def encode(settings: Settings, defaults: Settings | None = None) -> dict[str, str]:
    """Return the settings that differ from some defaults, as text for a link."""
    given = defaults or Settings()
    return {
        one.name: _text(getattr(settings, one.name))
        for one in fields(Settings)
        if getattr(settings, one.name) != getattr(given, one.name)
    }


def decode(
    query: Mapping[str, str], defaults: Settings | None = None
) -> tuple[Settings, list[str]]:
    """Return the settings of a link, and the names of those it gives wrong values.

    A missing or wrong value leaves the default; unknown names are ignored.
    """
    good: dict[str, Any] = {}
    wrong: list[str] = []
    for one in fields(Settings):
        if one.name not in query:
            continue
        try:
            good[one.name] = _checked(one.name, query[one.name])
        except (ValueError, OverflowError):
            wrong.append(one.name)
    return replace(defaults or Settings(), **good), wrong


def column_with(column: Column, changes: Mapping[str, Any]) -> Column:
    """Return a column with some fields replaced; the same checks as for settings.

    Raises
    ------
    ValueError
        With one sentence: what is wrong, what is allowed, what was got.
    """
    default = Column()
    checked = {
        name: _converted(name, getattr(default, name, None), value)
        for name, value in changes.items()
    }
    return replace(column, **checked)


def _text(value: Any) -> str:
    return columns_text(value) if isinstance(value, tuple) else plain(value)


def _checked(name: str, value: Any) -> Any:
    """Return a value in the type and bounds of its setting, from text or as it is."""
    return _converted(name, getattr(Settings(), name, None), value)


def _converted(name: str, default: Any, value: Any) -> Any:
    if default is None:
        raise ValueError(f"there is no setting called {name!r}")
    if isinstance(default, tuple):
        return value if isinstance(value, tuple) else _columns(value)
    if isinstance(default, Enum):
        return type(default)(value.value if isinstance(value, Enum) else value)
    if isinstance(default, bool):
        if value in (True, "1"):
            return True
        if value in (False, "0"):
            return False
        raise ValueError(f"{name} must be 0 or 1; got {value!r}")
    number = float(value)
    bounds = TABLE[name]
    if not bounds.low <= number <= bounds.high:
        raise ValueError(
            f"{name} must lie in {bounds.low} to {bounds.high}; got {value!r}"
        )
    return int(number) if isinstance(default, int) else number


def _columns(text: str) -> tuple[Column, ...]:
    return tuple(column_with(Column(), given) for given in columns_given(text))

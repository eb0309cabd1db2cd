"""Results that all sessions share, within one bound of bytes.

Keys are digests and frozen parameters, never large arrays. Stored values are never
written to and hold no text by a student.
"""

import contextlib
import dataclasses
import functools
import inspect
import threading
from collections.abc import Callable, Iterable
from typing import Any, ParamSpec, TypeVar

import streamlit as st
from cachetools import LRUCache

P = ParamSpec("P")
T = TypeVar("T")

MAX_BYTES = 150_000_000
"""Limit of all results together, bytes; the least recently used is dropped first."""


def size_of(parts: Iterable[object]) -> int:
    """Return the bytes of all arrays and texts in some objects, shared ones once."""
    seen: set[int] = set()
    total, todo = 0, list(parts)
    while todo:
        part: Any = todo.pop()
        if id(part) in seen:
            continue
        seen.add(id(part))
        if isinstance(part, (bytes, str)):
            total += len(part)
        elif hasattr(part, "nbytes"):
            total += part.nbytes
        elif isinstance(part, dict):
            todo += part.values()
        elif isinstance(part, (list, tuple)):
            todo += part
        elif dataclasses.is_dataclass(part):
            todo += [getattr(part, one.name) for one in dataclasses.fields(part)]
            # Values computed from the fields and cached.
            todo += getattr(part, "__dict__", {}).values()
    return total


class Store:
    """Results by key; a caller waits for a result that another is computing."""

    def __init__(self, max_bytes: int = MAX_BYTES):
        self._kept: LRUCache[Any, Any] = LRUCache(
            max_bytes, getsizeof=lambda result: size_of([result])
        )
        self._making: dict[Any, threading.Lock] = {}
        self._lock = threading.Lock()

    @property
    def n_bytes(self) -> int:
        """Size of all results together, bytes."""
        return int(self._kept.currsize)

    def get(self, key: Any, make: Callable[[], T]) -> T:
        """Return the result under a key, computed now if it is not there."""
        with self._lock:
            if key in self._kept:
                return self._kept[key]
            making = self._making.setdefault(key, threading.Lock())
        with making:
            with self._lock:
                if key in self._kept:
                    return self._kept[key]
            try:
                result = make()
                # A result larger than the limit is not kept.
                with self._lock, contextlib.suppress(ValueError):
                    self._kept[key] = result
            finally:
                self._making.pop(key, None)
        return result


STORE = Store()


def shared(spinner: str = "") -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Make a function's results shared by all sessions.

    Parameters whose names begin with an underscore are not part of the key: the others
    must determine the result.
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        signature = inspect.signature(function)
        in_key = [name for name in signature.parameters if not name.startswith("_")]

        @functools.wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> T:
            given = signature.bind(*args, **kwargs).arguments
            key = function.__qualname__, *(given[name] for name in in_key)

            def make() -> T:
                with st.spinner(spinner) if spinner else contextlib.nullcontext():
                    return function(*args, **kwargs)

            return STORE.get(key, make)

        return call

    return decorate

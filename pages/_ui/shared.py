"""Results that all sessions share, within one bound of bytes.

Keys are digests and frozen parameters, never large arrays. Stored values are never
written to and hold no text by a student.
"""

import contextlib
import dataclasses
import functools
import inspect
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterable
from typing import Any, ParamSpec, TypeVar

import streamlit as st

P = ParamSpec("P")
T = TypeVar("T")

MAX_BYTES = 100_000_000
"""Limit of all results together, bytes; the least recently used is dropped first."""
FILLED = 0.9
"""Share of the limit that is left filled when results are dropped."""


def size_of(parts: Iterable[object], seen: set[int] | None = None) -> int:
    """Return the bytes of all arrays and texts in some objects, shared ones once.

    Those `seen` before, by their identity, count nothing; those found are added.
    """
    seen = set() if seen is None else seen
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
        self._max_bytes = max_bytes
        self._kept: OrderedDict[Any, Any] = OrderedDict()
        self._estimate = 0
        self._making: dict[Any, threading.Lock] = {}
        self._lock = threading.Lock()

    @property
    def n_bytes(self) -> int:
        """Size of all results together, bytes; parts that several share count once."""
        with self._lock:
            return size_of(self._kept.values())

    def get(self, key: Any, make: Callable[[], T]) -> T:
        """Return the result under a key, computed now if it is not there."""
        with self._lock:
            if key in self._kept:
                return self._used(key)
            making = self._making.setdefault(key, threading.Lock())
        with making:
            with self._lock:
                if key in self._kept:
                    return self._used(key)
            try:
                result = make()
                with self._lock:
                    self._keep(key, result)
            finally:
                self._making.pop(key, None)
        return result

    def _used(self, key: Any) -> Any:
        self._kept.move_to_end(key)
        return self._kept[key]

    def _keep(self, key: Any, result: Any) -> None:
        """Keep a result unless it is larger than the limit; drop the oldest for it."""
        n_bytes = size_of([result])
        if n_bytes > self._max_bytes:
            return
        self._kept[key] = result
        self._estimate += n_bytes
        if self._estimate > self._max_bytes:
            self._drop_oldest()

    def _drop_oldest(self) -> None:
        """Measure all results again and keep the newest, some room beside them.

        A run grows while pages ask for its surfaces and fronts, and runs of one
        building share its arrays: the sum of their sizes when they were made is an
        estimate. Measuring takes 80 ms for 300 runs, so there must be room for a while.
        """
        seen: set[int] = set()
        n_bytes = 0
        for key in reversed([*self._kept]):
            more = n_bytes + size_of([self._kept[key]], seen)
            if more > FILLED * self._max_bytes and n_bytes:
                del self._kept[key]
            else:
                n_bytes = more
        self._estimate = n_bytes


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

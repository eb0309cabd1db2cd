"""Freed memory goes back to the system, not more often than it is worth."""

from pages._ui import memory


class Library:
    """Notes what it is asked for."""

    def __init__(self):
        self.calls = []

    def malloc_trim(self, left):
        self.calls.append(("trim", left))

    def mallopt(self, option, value):
        self.calls.append((option, value))


def test_memory_is_returned_once_in_a_while(monkeypatch):
    library, now = Library(), [100.0]
    monkeypatch.setattr(memory, "_LIBRARY", library)
    monkeypatch.setattr(memory, "_last_trim_s", 0.0)
    monkeypatch.setattr(memory.time, "monotonic", lambda: now[0])
    for now[0] in (100.0, 101.0, 104.9, 105.1, 106.0):
        memory.return_freed()
    assert library.calls == [("trim", 0)] * 2


def test_threads_share_two_arenas(monkeypatch):
    library = Library()
    monkeypatch.setattr(memory, "_LIBRARY", library)
    memory.use_few_arenas()
    assert library.calls == [(-8, 2)]  # M_ARENA_MAX of glibc's malloc.h


def test_a_c_library_without_these_calls_is_left_alone(monkeypatch):
    monkeypatch.setattr(memory.ctypes, "CDLL", lambda _: object())
    assert memory._c_library() is None
    monkeypatch.setattr(memory, "_LIBRARY", None)
    memory.use_few_arenas()
    memory.return_freed()

"""Classes kept on the server under a short code, within limits of size and age."""

import secrets
import threading

from cachetools import TTLCache

from pages._ui.classroom.prepared import (
    MAX_BYTES,
    ClassError,
    Prepared,
    from_json,
    to_json,
)

ALPHABET = "23456789abcdefghjkmnpqrstuvwxyz"
"""Without letters and digits that are read for one another."""
CODE_CHARS = 12
MAX_TOTAL_BYTES = 20_000_000
MAX_AGE_S = 60 * 24 * 3600


def new_code(n_chars: int = CODE_CHARS) -> str:
    """Return an unguessable code that can be typed."""
    return "".join(secrets.choice(ALPHABET) for _ in range(n_chars))


def typed(text: str) -> str:
    """Return a code as it was meant: without spaces, dashes and capitals."""
    return "".join(char for char in text.lower()[:100] if char in ALPHABET)


class Classes:
    """The store; safe in threads. The oldest class is dropped first."""

    def __init__(
        self, max_bytes: int = MAX_TOTAL_BYTES, max_age_s: float = MAX_AGE_S
    ) -> None:
        self._kept: TTLCache[str, bytes] = TTLCache(max_bytes, max_age_s, getsizeof=len)
        self._lock = threading.Lock()

    def keep(self, prepared: Prepared) -> str:
        """Keep a class, and return its code.

        Raises
        ------
        ClassError
            Where it is too large.
        """
        content, code = to_json(prepared), new_code()
        if len(content) > MAX_BYTES:
            raise ClassError(f"a class has at most {MAX_BYTES:,} bytes")
        with self._lock:
            self._kept[code] = content
        return code

    def find(self, code: str) -> Prepared | None:
        """Return the class under a code; None if there is none."""
        with self._lock:
            content = self._kept.get(code)
        return None if content is None else from_json(content)


CLASSES = Classes()

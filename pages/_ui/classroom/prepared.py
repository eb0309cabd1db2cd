"""What a teacher prepared for a class: a state, its limits, exercises of their own.

It travels in two ways: kept on the server under a short code, or whole in a long link,
which needs no server that remembers. Both are read with the same checks.
"""

import base64
import binascii
import contextlib
import hashlib
import json
import zlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

from occsim.errors import OccsimError
from pages._ui.limits import NAMES

MAX_BYTES = 200_000
"""Most bytes of a class, as JSON."""
MAX_LINK = 6_000
"""Most characters of the part of a link that holds a class; servers and programs that
pass links on cut longer ones."""
MAX_TEXTS = 100
MAX_EXERCISES = 20
CHECK_CHARS = 10
"""Length of the sum that tells an edited link; it is no secret."""


class ClassError(OccsimError):
    """A class cannot be read."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Prepared:
    """What the students of a class find.

    Parameters
    ----------
    page : str
        The page that the link opens, by its path.
    texts : mapping of str to str
        The state, as in the link to it.
    hide, lock : tuple of str
        Controls, of `NAMES`.
    exercises : tuple of str
        Files of exercises, TOML.
    """

    page: str
    texts: Mapping[str, str] = field(default_factory=dict)
    hide: tuple[str, ...] = ()
    lock: tuple[str, ...] = ()
    exercises: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for names in (self.hide, self.lock):
            unknown = next((name for name in names if name not in NAMES), None)
            if unknown is not None:
                raise ClassError(f"there is no control called {unknown[:40]!r}")
        if len(self.texts) > MAX_TEXTS or len(self.exercises) > MAX_EXERCISES:
            raise ClassError(
                f"a class has at most {MAX_TEXTS} settings and {MAX_EXERCISES} "
                "exercises"
            )


def to_json(prepared: Prepared) -> bytes:
    """Return a class as it is kept."""
    return json.dumps(asdict(prepared), separators=(",", ":")).encode()


def from_json(content: bytes) -> Prepared:
    """Return the class of `to_json`.

    Raises
    ------
    ClassError
        Where it is anything else.
    """
    if len(content) > MAX_BYTES:
        raise ClassError(f"a class has at most {MAX_BYTES:,} bytes")
    with contextlib.suppress(ValueError, TypeError, KeyError, RecursionError):
        given = json.loads(content)
        if isinstance(given, dict) and _is_plain(given):
            lists = {name: tuple(given[name]) for name in ("hide", "lock", "exercises")}
            return Prepared(page=given["page"], texts=given["texts"], **lists)
    raise ClassError("this is not a class of this program")


def _is_plain(given: Mapping[str, object]) -> bool:
    texts = given.get("texts")
    lists = [given.get(name) for name in ("hide", "lock", "exercises")]
    return (
        isinstance(given.get("page"), str)
        and isinstance(texts, dict)
        and all(isinstance(value, str) for value in texts.values())
        and all(isinstance(one, list) for one in lists)
        and all(isinstance(name, str) for one in lists for name in one)
    )


def packed(prepared: Prepared) -> str | None:
    """Return a class as the part of a link; None where that would be too long."""
    content = zlib.compress(to_json(prepared), 9)
    text = base64.urlsafe_b64encode(content).decode().rstrip("=")
    whole = f"{_sum(text)}{text}"
    return whole if len(whole) <= MAX_LINK else None


def unpacked(text: str) -> Prepared:
    """Return the class of `packed`.

    Raises
    ------
    ClassError
        Where the text was cut or edited.
    """
    check, content = text[:CHECK_CHARS], text[CHECK_CHARS:]
    if len(text) > MAX_LINK or _sum(content) != check:
        raise ClassError("the link of this class was cut or edited")
    try:
        raw = base64.urlsafe_b64decode(content + "=" * (-len(content) % 4))
        opened = zlib.decompressobj().decompress(raw, MAX_BYTES + 1)
    except (binascii.Error, zlib.error, ValueError) as error:
        raise ClassError("the link of this class was cut or edited") from error
    return from_json(opened)


def _sum(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:CHECK_CHARS]

"""Votes: anonymous counts under a room code, in the server's memory for some hours."""

import hmac
import secrets
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from cachetools import TTLCache

from occsim.errors import OccsimError
from pages._ui.classroom.kept import new_code

ROOM_CHARS = 6
MAX_ROOMS = 300
MAX_VOTERS = 1_000
"""Most answers of one room."""
MAX_AGE_S = 3 * 3600
MIN_OPTIONS, MAX_OPTIONS = 2, 5
MAX_QUESTION, MAX_OPTION = 300, 80
"""Most characters of a question and of an option."""


class RoomError(OccsimError):
    """A room cannot be opened or an answer not be counted."""


@dataclass(frozen=True, slots=True)
class Seen:
    """A room as one of those in it sees it.

    Parameters
    ----------
    question : str
    options : tuple of str
    n_answers : int
        How many have answered.
    counts : tuple of int or None
        Answers of each option; None until they are shown to all.
    mine : int or None
        The option that this voter chose.
    """

    question: str
    options: tuple[str, ...]
    n_answers: int
    counts: tuple[int, ...] | None
    mine: int | None


@dataclass(slots=True)
class _Room:
    key: str
    question: str
    options: tuple[str, ...]
    answers: dict[str, int] = field(default_factory=dict)
    is_shown: bool = False


class Rooms:
    """The rooms of all classes; safe in threads.

    Parameters
    ----------
    max_rooms : int
        A room beyond these is refused: no other is closed for it.
    max_age_s : float
        How long a room stays after it was opened, s.
    timer : callable
        The clock.
    """

    def __init__(
        self,
        max_rooms: int = MAX_ROOMS,
        max_age_s: float = MAX_AGE_S,
        timer: Callable[[], float] = time.monotonic,
    ) -> None:
        self._rooms: TTLCache[str, _Room] = TTLCache(max_rooms, max_age_s, timer)
        self._lock = threading.Lock()

    def open(self, question: str, options: Sequence[str]) -> tuple[str, str]:
        """Open a room; return its code, and the key of who opened it.

        Raises
        ------
        RoomError
            Where the question or its options are too long or too few, or too many
            rooms are open.
        """
        wanted = tuple(option.strip() for option in options if option.strip())
        _require(question.strip(), wanted)
        room = _Room(secrets.token_hex(8), question.strip(), wanted)
        with self._lock:
            self._rooms.expire()
            if len(self._rooms) >= self._rooms.maxsize:
                raise RoomError("Too many rooms are open on this server; try later.")
            code = new_code(ROOM_CHARS)
            while code in self._rooms:
                code = new_code(ROOM_CHARS)
            self._rooms[code] = room
        return code, room.key

    def answer(self, code: str, voter: str, option: int) -> None:
        """Count an answer; a voter's later one takes the place of the one before.

        Raises
        ------
        RoomError
            Where there is no such room or option, the answers are shown already, or
            the room is full.
        """
        with self._lock:
            room = self._room(code)
            if room.is_shown:
                raise RoomError("The answers are shown already; yours stays as it is.")
            if option not in range(len(room.options)):
                raise RoomError("There is no such option.")
            if voter not in room.answers and len(room.answers) >= MAX_VOTERS:
                raise RoomError("This room is full.")
            room.answers[voter] = option

    def seen(self, code: str, voter: str = "") -> Seen | None:
        """Return a room as a voter sees it; None if there is none."""
        with self._lock:
            room = self._rooms.get(code)
            if room is None:
                return None
            found = Counter(room.answers.values())
            counts = tuple(found[i] for i in range(len(room.options)))
            return Seen(
                room.question,
                room.options,
                len(room.answers),
                counts if room.is_shown else None,
                room.answers.get(voter),
            )

    def is_key(self, code: str, key: str) -> bool:
        """Whether a key is that of the room."""
        with self._lock:
            room = self._rooms.get(code)
            return room is not None and hmac.compare_digest(
                room.key.encode(), key.encode("utf-8", "replace")
            )

    def show(self, code: str, key: str, shown: bool = True) -> None:
        """Show the answers to all, or hide them again.

        Raises
        ------
        RoomError
            Where there is no such room, or the key is another's.
        """
        if not self.is_key(code, key):
            raise RoomError(
                "Only the person who opened this room can show its answers."
            )
        with self._lock:
            self._room(code).is_shown = shown

    def close(self, code: str, key: str) -> None:
        """Close a room, for those who are in it as well.

        Raises
        ------
        RoomError
            Where there is no such room, or the key is another's.
        """
        if not self.is_key(code, key):
            raise RoomError("Only who opened this room can close it.")
        with self._lock:
            self._rooms.pop(code, None)

    def _room(self, code: str) -> _Room:
        room = self._rooms.get(code)
        if room is None:
            raise RoomError("This room is closed: rooms are kept for three hours.")
        return room


def _require(question: str, options: tuple[str, ...]) -> None:
    if not 0 < len(question) <= MAX_QUESTION:
        raise RoomError(
            f"A question has 1 to {MAX_QUESTION} characters; got {len(question)}."
        )
    if not MIN_OPTIONS <= len(options) <= MAX_OPTIONS:
        raise RoomError(
            f"A question has {MIN_OPTIONS} to {MAX_OPTIONS} options; got "
            f"{len(options)}."
        )
    long = next((option for option in options if len(option) > MAX_OPTION), None)
    if long is not None:
        raise RoomError(f"An option has at most {MAX_OPTION} characters.")
    if len(set(options)) < len(options):
        raise RoomError("Two options are the same.")


ROOMS = Rooms()

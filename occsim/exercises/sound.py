"""What a file of an exercise must keep to, so that links and files can hold it."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

from occsim.errors import ParameterError, shown
from occsim.exercises.exercise import Exercise, Question, quantities
from occsim.exercises.facts import is_fact
from occsim.exercises.grammar import names_of

ID = re.compile(r"[a-z0-9_]{1,40}")
LAST_LESSON = 9
MAX_OPTION = 200
"""Most characters of an option; a progress holds what was chosen."""
MAX_QUESTIONS = 20
CONTROL_KEYS = ("show", "lock", "hide", "together", "needs")


def require_controls(controls: Mapping[str, Any]) -> None:
    """Refuse a key that would otherwise be passed over, and hold nothing."""
    for name in controls:
        if name not in CONTROL_KEYS:
            raise ParameterError(
                f"a key of controls must be one of {', '.join(CONTROL_KEYS)}; got "
                f"{shown(name)}"
            )


def require_sound(made: Exercise) -> None:
    """Refuse what no link and no progress could hold, and gaps that nothing fills."""
    if not ID.fullmatch(made.id):
        raise ParameterError(
            f"id must be 1 to 40 of a to z, 0 to 9 and _; got {shown(made.id)}"
        )
    if made.lesson > LAST_LESSON:
        raise ParameterError(f"lesson must be 0 to {LAST_LESSON}; got {made.lesson}")
    if len(made.questions) > MAX_QUESTIONS:
        raise ParameterError(
            f"an exercise has at most {MAX_QUESTIONS} questions; got "
            f"{len(made.questions)}"
        )
    for question in _asked(made):
        _require_question(question)
    for sentence in (*(one.distance for one in made.checks), *_said(made)):
        _require_filled(sentence)


def _asked(made: Exercise) -> Iterator[Question]:
    yield from made.questions
    for one in (made.prediction, made.reason):
        if one is not None:
            yield one
    if made.prediction is not None and not made.prediction.options:
        raise ParameterError("predict needs options")
    names = [one.name for one in made.questions]
    if len(set(names)) < len(names):
        raise ParameterError("two questions have the same name")


def _said(made: Exercise) -> Iterator[str]:
    return (one.say for one in made.near_misses)


def _require_question(question: Question) -> None:
    name, options = question.name, question.options
    if not ID.fullmatch(name):
        raise ParameterError(
            f"a question's name must be 1 to 40 of a to z, 0 to 9 and _; got "
            f"{shown(name)}"
        )
    if len(options) == 1 or len(set(options)) < len(options):
        raise ParameterError(
            f"the options of {name} must be two or more, no two alike; got "
            f"{shown(list(options))}"
        )
    long = next((one for one in options if not 0 < len(one) <= MAX_OPTION), None)
    if long is not None:
        raise ParameterError(
            f"an option of {name} must have 1 to {MAX_OPTION} characters; got "
            f"{len(long)}"
        )


def _require_filled(sentence: str) -> None:
    for tree in quantities(sentence):
        for name in names_of(tree):
            if not is_fact(name) and "." not in name:
                raise ParameterError(f"there is no fact called {shown(name)}")

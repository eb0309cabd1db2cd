"""Exercises from TOML files: read, checked and proven."""

import re
import tomllib
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from occsim.errors import OccsimError, ParameterError, shown
from occsim.exercises.exercise import (
    REASON,
    Draw,
    Exercise,
    NearMiss,
    Question,
    parsed_checks,
    quantities,
)
from occsim.exercises.facts import GROUPS, Context, Readings, is_fact, simulated
from occsim.exercises.grammar import Tree, names_of, parse
from occsim.exercises.proof import POINTED, moved_by_witness, run_proof
from occsim.exercises.sound import CONTROL_KEYS, require_controls, require_sound
from occsim.exercises.state import FLAWS, SETTINGS, ExerciseState, changed

MAX_BYTES = 100_000
MAX_FILES = 500
FEWEST_HINTS = 2
FEWEST_DRAWN = 2
TOGETHER = ("p_wall", "p_space")
"""Controls that can be made to move together."""
PAGES = (
    "what_the_sensor_says",
    "build_a_map",
    "two_maps",
    "your_building",
    "sweep_the_priors",
    "pareto_explorer",
    "best_prior",
    "study",
)
CONTROLS = (
    *(name for name in SETTINGS if name not in (*POINTED, "step")),
    *FLAWS,
    *("transport", "errors", "laps", "study_rule", "scores", "ladder"),
)
"""What can be shown, locked and hidden: settings, the transport of the replay, the
errors shown on the map, the laps of a tour, the rule of the study; and two outputs,
which vanish only where they are hidden: the scores, a cell's readings one by one."""
_KEYS = {
    *("id", "title", "lesson", "minutes", "page", "goal", "open", "other", "lineup"),
    *("setup", "controls", "predict", "question", "reason", "check", "near_miss"),
    *("hint", "after", "proof", "reference", "draw"),
}


def load_exercises(
    folder: str | PathLike[str], *, prove: bool = True
) -> tuple[Exercise, ...]:
    """Return the exercises of a folder, each proven.

    Parameters
    ----------
    folder : path
        Holds files ``NN_name.toml``.
    prove : bool, default True
        As in `load_exercise`.

    Returns
    -------
    tuple of Exercise
        In the order of their file names.

    Raises
    ------
    ParameterError
        Where the folder has none, or one of them is refused; with the name of the file.

    Examples
    --------
    >>> len(load_exercises("assets/exercises"))  # doctest: +SKIP
    23
    """
    files = sorted(Path(folder).glob("*.toml"))[:MAX_FILES]
    if not files:
        raise ParameterError(f"the folder {shown(str(folder))} has no exercise (.toml)")
    found = tuple(load_exercise(file, prove=prove) for file in files)
    ids = [one.id for one in found]
    twice = next((name for name in ids if ids.count(name) > 1), None)
    if twice is not None:
        raise ParameterError(f"two exercises have the id {twice!r}")
    return found


def load_exercise(
    source: str | PathLike[str] | bytes,
    *,
    name: str = "exercise",
    readings: Readings = simulated,
    prove: bool = True,
) -> Exercise:
    """Return the exercise of one file, proven.

    Parameters
    ----------
    source : path or bytes
        A TOML file, or its content.
    name : str, optional
        Name of the file, where its content is given.
    readings : callable, optional
        As in `Facts`; the proof needs them.
    prove : bool, default True
        Whether the proof is run: it simulates, where reading the file takes a
        millisecond. One who lists exercises may prove each when it is opened.

    Returns
    -------
    Exercise

    Raises
    ------
    ParameterError
        With one sentence: an unknown key, setting or name, a value out of bounds, a
        check that is true at the set-up or at the wrong answer or false at the witness,
        fewer than two hints, or a control that the witness needs and nobody sees.
    """
    if isinstance(source, bytes):
        content = source
    else:
        name, content = Path(source).name, _read(Path(source))
    try:
        given = _tables(content)
        made = _exercise(given, name)
        if prove and not made.is_open:
            run_proof(made, _table(given, "proof"), readings)
    except OccsimError as error:
        raise ParameterError(f"{name}: {error}") from error
    return made


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(MAX_BYTES + 1)
    except OSError as error:
        raise ParameterError(
            f"the exercise {shown(str(path))} cannot be read ({error.strerror})"
        ) from error


def _tables(content: bytes) -> dict[str, Any]:
    if len(content) > MAX_BYTES:
        raise ParameterError(f"an exercise has at most {MAX_BYTES:,} bytes")
    try:
        return tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise ParameterError(f"not a TOML file: {error}") from error


def _exercise(given: Mapping[str, Any], name: str) -> Exercise:
    unknown = sorted(set(given) - _KEYS)
    if unknown:
        raise ParameterError(f"there is no key called {unknown[0]!r} in an exercise")
    settings = _table(given, "setup")
    controls = _table(given, "controls")
    require_controls(controls)
    reason = given.get("reason")
    made = Exercise(
        number=_number(name),
        id=_text(given, "id"),
        title=_text(given, "title"),
        page=_page(_text(given, "page")),
        goal=_text(given, "goal"),
        lesson=_whole(given, "lesson"),
        minutes=_whole(given, "minutes"),
        setup=changed(ExerciseState(), settings),
        settings=settings,
        show=_names(controls, "show"),
        lock=_names(controls, "lock"),
        hide=_names(controls, "hide"),
        together=_together(controls, settings),
        needs=_needs(controls, _table(given, "proof")),
        draw=_draw(_table(given, "draw")),
        prediction=_question(given.get("predict"), "predict"),
        questions=tuple(
            _asked(one, _text(one, "name")) for one in _rows(given, "question")
        ),
        reason=_question(reason, REASON),
        right_reason=_right(reason),
        checks=parsed_checks(_checked_rows(given)),
        near_misses=tuple(
            NearMiss(parse(_text(one, "when")), _text(one, "say"))
            for one in _rows(given, "near_miss")
        ),
        hints=tuple(_text(one, "say") for one in _rows(given, "hint")),
        after=_text(_table(given, "after"), "say"),
        context=Context(
            other=given.get("other", "own"),
            lineup=tuple(given.get("lineup", ())),
            reference=_table(given, "reference"),
        ),
        is_open=given.get("open", False) is True,
    )
    _require_parts(made)
    return made


def _number(name: str) -> int:
    found = re.match(r"(\d+)_", name)
    return int(found.group(1)) if found else 0


def _text(given: Mapping[str, Any], key: str) -> str:
    value = given.get(key)
    if not isinstance(value, str) or not value.strip():
        raise ParameterError(f"{key} must be a text; got {shown(value)}")
    return value


def _whole(given: Mapping[str, Any], key: str) -> int:
    value = given.get(key)
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= 999:
        raise ParameterError(f"{key} must be a whole number; got {shown(value)}")
    return value


def _table(given: Mapping[str, Any], key: str) -> dict[str, Any]:
    value = given.get(key, {})
    if not isinstance(value, dict):
        raise ParameterError(f"{key} must be a table; got {shown(value)}")
    return value


def _names(controls: Mapping[str, Any], key: str) -> tuple[str, ...]:
    names = controls.get(key, [])
    if not isinstance(names, list):
        raise ParameterError(f"{key} must be a list of controls; got {shown(names)}")
    for name in names:
        if name not in CONTROLS:
            raise ParameterError(
                f"there is no control called {shown(name)}; the controls are "
                f"{', '.join(CONTROLS)}"
            )
    return tuple(names)


def _needs(controls: Mapping[str, Any], proof: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the controls that a file names, and those that its witness moves."""
    named = [name for key in CONTROL_KEYS for name in _names(controls, key)]
    return tuple(dict.fromkeys([*named, *moved_by_witness(proof)]))


def _together(
    controls: Mapping[str, Any], settings: Mapping[str, Any]
) -> tuple[str, ...]:
    """Return the controls that move together, which open at the same value."""
    names = _names(controls, "together")
    for name in names:
        if name not in TOGETHER:
            raise ParameterError(
                f"the controls that move together are some of {', '.join(TOGETHER)}; "
                f"got {name}"
            )
    if any(settings.get(name) != settings.get(names[0]) for name in names):
        raise ParameterError(f"{' and '.join(names)} move together and open apart")
    return names


def _draw(given: Mapping[str, Any]) -> Draw | None:
    """Return what is drawn by lot: one setting, and two values of it or more."""
    if not given:
        return None
    [(name, values), *others] = given.items()
    if others or name not in (*SETTINGS, *FLAWS):
        raise ParameterError(f"draw must name one setting; got {shown(list(given))}")
    if not isinstance(values, list) or len(values) < FEWEST_DRAWN:
        raise ParameterError(
            f"an exercise draws from {FEWEST_DRAWN} values or more; got {shown(values)}"
        )
    for value in values:
        changed(ExerciseState(), {name: value})  # refused here if it is out of bounds
    return Draw(name, tuple(values))


def _rows(given: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
    value = given.get(key, [])
    if not isinstance(value, list) or not all(isinstance(one, dict) for one in value):
        raise ParameterError(f"{key} must be written as [[{key}]] tables")
    return value


def _checked_rows(given: Mapping[str, Any]) -> list[dict[str, Any]]:
    rows = _rows(given, "check")
    for row in rows:
        _text(row, "that")
    return rows


def _page(page: str) -> str:
    if page not in PAGES:
        raise ParameterError(
            f"page must be one of {', '.join(PAGES)}; got {shown(page)}"
        )
    return page


def _question(given: Any, name: str) -> Question | None:
    if given is None:
        return None
    if not isinstance(given, dict):
        raise ParameterError(f"{name} must be a table; got {shown(given)}")
    return _asked(given, name)


def _asked(given: Mapping[str, Any], name: str) -> Question:
    options = given.get("options", [])
    if not isinstance(options, list) or not all(isinstance(o, str) for o in options):
        raise ParameterError(
            f"the options of {name} must be texts; got {shown(options)}"
        )
    return Question(name, _text(given, "question"), tuple(options))


def _right(reason: Any) -> str:
    if reason is None:
        return ""
    right = _text(reason, "right")
    if right not in reason.get("options", []):
        raise ParameterError(f"the right reason is none of its options: {shown(right)}")
    return right


def _require_parts(made: Exercise) -> None:
    if len(made.hints) < FEWEST_HINTS:
        raise ParameterError(
            f"an exercise needs {FEWEST_HINTS} hints or more; got {len(made.hints)}"
        )
    require_sound(made)
    if made.is_open:
        return
    if not made.checks:
        raise ParameterError("an exercise that is not open needs a [[check]]")
    for tree in _trees(made):
        _require_names(tree, made)


def _trees(made: Exercise) -> Iterator[Tree]:
    for check in made.checks:
        yield check.tree
        yield from quantities(check.distance)
    for miss in made.near_misses:
        yield miss.tree


def _require_names(tree: Tree, made: Exercise) -> None:
    """Every name with a point is a fact, every answer is asked for."""
    asked = {question.name for question in made.questions}
    for name in names_of(tree):
        group, point, rest = name.partition(".")
        if group == "answer" and point and rest not in asked:
            raise ParameterError(f"no question asks for {name}")
        if point and not is_fact(name):
            known = ", ".join(sorted(GROUPS))
            raise ParameterError(
                f"there is no fact called {name!r}; the groups of facts are {known}"
            )

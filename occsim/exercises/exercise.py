"""An exercise, and how the state of a student is judged by it."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from occsim.errors import ParameterError, expect, shown
from occsim.exercises.facts import SHARES, Context, Facts, Readings, simulated
from occsim.exercises.grammar import (
    Tree,
    Value,
    holds,
    names_of,
    parse,
    parse_sum,
    value,
)
from occsim.exercises.state import ExerciseState, changed

REASON = "reason"
"""Name of the answer to the question "because"."""
_GAP = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True, slots=True)
class Question:
    """A question to the student.

    Parameters
    ----------
    name : str
        Of the answer, as in ``answer.name``.
    text : str
        The question.
    options : tuple of str
        Choices; empty where a number is asked for.
    """

    name: str
    text: str
    options: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Check:
    """What must hold, and how the distance from it is said.

    Parameters
    ----------
    tree : Number, Name or Apply
        The check.
    distance : str
        A sentence with quantities in braces.
    """

    tree: Tree
    distance: str


@dataclass(frozen=True, slots=True)
class NearMiss:
    """A state that is not right for a known reason."""

    tree: Tree
    say: str


@dataclass(frozen=True, slots=True)
class Verdict:
    """How a state was judged.

    Parameters
    ----------
    is_solved : bool
        Whether the check, and the reason where one is asked, are right.
    distance : str
        How far the state is from the check; empty where nothing is said.
    near_miss : str
        Why a state that looks right is not; empty where no such case holds.
    """

    is_solved: bool
    distance: str = ""
    near_miss: str = ""


@dataclass(frozen=True, slots=True)
class Draw:
    """A setting that is drawn by lot when an exercise opens, and its values."""

    setting: str
    values: tuple[Value, ...]


@dataclass(frozen=True, kw_only=True, slots=True)
class Exercise:
    """One exercise, parsed and proven.

    Parameters
    ----------
    number : int
        Place in the order, from the name of its file.
    id, title, page, goal : str
        Name in links, title, page that it opens, and what is to be done.
    lesson, minutes : int
        Where it belongs, and how long it takes.
    setup : ExerciseState
        The state in which it opens.
    settings : mapping
        The values that the set-up names, as written.
    show, lock, hide : tuple of str
        Controls that stay, if only some do; those that cannot be moved; and controls
        and outputs that are not seen.
    together : tuple of str
        Controls that always have the same value: one that is moved moves all.
    needs : tuple of str
        Controls that it cannot do without: all that ``[controls]`` names and all that
        the witness moves. A class that holds a control leaves it to the exercise.
    draw : Draw or None
        What is drawn by lot; `with_draw` gives the exercise with a value of it.
    prediction : Question or None
        Asked first, stored and not judged.
    questions : tuple of Question
        Asked, and judged by the checks.
    reason : Question or None
        Why; asked after the checks hold.
    right_reason : str
        The right one of its options.
    checks : tuple of Check
        One after another: the next counts once the one before held.
    near_misses : tuple of NearMiss
    hints : tuple of str
    after : str
        Explanation, shown once it is solved.
    context : Context
    is_open : bool
        Whether nothing is judged.
    """

    number: int
    id: str
    title: str
    page: str
    goal: str
    lesson: int
    minutes: int
    setup: ExerciseState
    settings: Mapping[str, Any] = field(default_factory=dict)
    show: tuple[str, ...] = ()
    lock: tuple[str, ...] = ()
    hide: tuple[str, ...] = ()
    together: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()
    draw: Draw | None = None
    prediction: Question | None = None
    questions: tuple[Question, ...] = ()
    reason: Question | None = None
    right_reason: str = ""
    checks: tuple[Check, ...] = ()
    near_misses: tuple[NearMiss, ...] = ()
    hints: tuple[str, ...] = ()
    after: str = ""
    context: Context = field(default_factory=Context)
    is_open: bool = False


def with_draw(exercise: Exercise, value: Value) -> Exercise:
    """Return an exercise that opens with one of the values that it draws from.

    Parameters
    ----------
    exercise : Exercise
        One with a ``draw``.
    value : float, bool or str
        One of ``exercise.draw.values``.

    Returns
    -------
    Exercise

    Raises
    ------
    TypeError
        Where the exercise is none.
    ParameterError
        Where it draws nothing, or not this value.

    Examples
    --------
    >>> from pathlib import Path
    >>> from occsim.exercises import load_exercise
    >>> folder = Path("assets/exercises")
    >>> file = folder / "15_which_rule_is_running.toml"
    >>> exercise = load_exercise(file, prove=False)  # doctest: +SKIP
    >>> with_draw(exercise, "subtract_prior").setup.rule  # doctest: +SKIP
    <UpdateRule.SUBTRACT_PRIOR: 'subtract_prior'>
    """
    expect("exercise", exercise, Exercise)
    values = exercise.draw.values if exercise.draw else ()
    if exercise.draw is None or value not in values:
        raise ParameterError(
            f"value must be one that the exercise draws from ({shown(values)}); got "
            f"{shown(value)}"
        )
    drawn = {exercise.draw.setting: value}
    return replace(
        exercise,
        setup=changed(exercise.setup, drawn),
        settings={**exercise.settings, **drawn},
    )


def judge(
    exercise: Exercise,
    state: ExerciseState,
    stage: int = 0,
    readings: Readings = simulated,
) -> Verdict:
    """Judge a student's state by one check of an exercise.

    Parameters
    ----------
    exercise : Exercise
        From `load_exercises`.
    state : ExerciseState
        What the student set, pinned and answered.
    stage : int, default 0
        Which of its checks; those before it are solved.
    readings : callable, optional
        As in `Facts`.

    Returns
    -------
    Verdict
        An open exercise is never solved.

    Raises
    ------
    TypeError
        Where an argument is of another type.
    ParameterError
        Where there is no such check.
    """
    expect("exercise", exercise, Exercise)
    expect("state", state, ExerciseState)
    if exercise.is_open:
        return Verdict(False)
    if not 0 <= stage < len(exercise.checks):
        raise ParameterError(
            f"stage must be 0 to {len(exercise.checks) - 1}; got {stage!r}"
        )
    facts = Facts(state, exercise.context, readings)
    check = exercise.checks[stage]
    last = stage == len(exercise.checks) - 1
    right = holds(check.tree, facts.value) and (
        not last or _has_reason(exercise, state)
    )
    if right:
        return Verdict(True)
    near = next(
        (one.say for one in exercise.near_misses if holds(one.tree, facts.value)), ""
    )
    return Verdict(False, filled(check.distance, facts), near)


def _has_reason(exercise: Exercise, state: ExerciseState) -> bool:
    if exercise.reason is None:
        return True
    return state.answers.get(REASON) == exercise.right_reason


def filled(sentence: str, facts: Facts) -> str:
    """Return a sentence with its quantities filled in; shares are in percent."""

    def fill(gap: re.Match[str]) -> str:
        tree = parse_sum(gap.group(1))
        return _shown(value(tree, facts.value), _is_share(tree))

    return _GAP.sub(fill, sentence)


def quantities(sentence: str) -> list[Tree]:
    """Return the quantities in the braces of a sentence."""
    return [parse_sum(text) for text in _GAP.findall(sentence)]


def _is_share(tree: Tree) -> bool:
    return any(name.rpartition(".")[2] in SHARES for name in names_of(tree))


def _shown(given: Value, is_share: bool) -> str:
    if isinstance(given, (str, bool)):
        return str(given)
    if given != given:
        return "–"
    if is_share:
        return f"{100 * given:.1f} %"
    is_count = given == round(given)
    return f"{given:{',.0f' if is_count else '.4g'}}".replace("-", "−")


def parsed_checks(rows: Sequence[Mapping[str, str]]) -> tuple[Check, ...]:
    """Return the checks of a file's ``[[check]]`` tables."""
    return tuple(Check(parse(row["that"]), row.get("distance", "")) for row in rows)

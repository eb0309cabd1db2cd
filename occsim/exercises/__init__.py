"""Exercises: a grammar of checks, proofs that each can be solved, and judging.

An exercise is a TOML file. It is refused when it is read if its check holds already at
its set-up, does not hold at its witness, or holds at its wrong answer.
"""

from occsim.exercises.exercise import (
    Check,
    Draw,
    Exercise,
    Question,
    Verdict,
    judge,
    with_draw,
)
from occsim.exercises.facts import Context, Facts
from occsim.exercises.load import CONTROLS, load_exercise, load_exercises
from occsim.exercises.state import ExerciseState, changed

__all__ = [
    "CONTROLS",
    "Check",
    "Context",
    "Draw",
    "Exercise",
    "ExerciseState",
    "Facts",
    "Question",
    "Verdict",
    "changed",
    "judge",
    "load_exercise",
    "load_exercises",
    "with_draw",
]

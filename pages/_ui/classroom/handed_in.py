"""What a class handed in, judged again: a table, the predictions, a file for sheets."""

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from occsim.errors import OccsimError
from occsim.exercises import Exercise
from pages._ui.judging import Judged, judged
from pages._ui.progress import MAX_CHARS, Progress, ProgressError, from_text

MAX_FILES = 60
FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""A sheet runs a cell that begins with one of these."""
SOLVED, TRIED, PREDICTED = "solved", "tried", "predicted"
DIFFERS = "differs from its states"


@dataclass(frozen=True, slots=True)
class Student:
    """One file: who, and each exercise as it is judged now.

    Parameters
    ----------
    name : str
        What the student is called; the file's name where nothing was given.
    progress : Progress
    judged : mapping of str to Judged
        By the exercise's id.
    """

    name: str
    progress: Progress
    judged: Mapping[str, Judged]


def read(data: bytes, file_name: str) -> Progress:
    """Return what a file holds; its name stands in for the student's.

    Raises
    ------
    ProgressError
        With the name of the file and one sentence.
    """
    try:
        if len(data) > 4 * MAX_CHARS:
            raise ProgressError(f"a progress has at most {MAX_CHARS:,} characters")
        return from_text(data.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise ProgressError(f"{file_name}: this is not JSON") from error
    except OccsimError as error:
        raise ProgressError(f"{file_name}: {error}") from error


def student_of(
    progress: Progress, file_name: str, exercises: Sequence[Exercise]
) -> Student:
    """Return a student, every attempt judged again."""
    found = {
        one.id: judged(one, progress.attempts[one.id])
        for one in exercises
        if one.id in progress.attempts
    }
    return Student(progress.name.strip() or file_name, progress, found)


def status(student: Student, exercise: Exercise) -> str:
    """What a student did with an exercise, in a word or two; empty if nothing."""
    attempt = student.progress.attempts.get(exercise.id)
    if attempt is None:
        return ""
    again = student.judged[exercise.id]
    if not again.is_as_claimed:
        return DIFFERS
    if again.is_solved:
        return SOLVED
    return f"{TRIED} {attempt.n_checks}" if attempt.n_checks else PREDICTED


def begun(students: Sequence[Student], exercises: Sequence[Exercise]) -> list[Exercise]:
    """The exercises that somebody has begun."""
    return [
        one
        for one in exercises
        if any(one.id in student.progress.attempts for student in students)
    ]


def column_names(exercises: Sequence[Exercise]) -> dict[str, str]:
    """What each exercise is called in a table, by its id; no two alike."""
    titles = Counter(title(one) for one in exercises)
    return {
        one.id: title(one) if titles[title(one)] == 1 else f"{title(one)} ({one.id})"
        for one in exercises
    }


def title(exercise: Exercise) -> str:
    """An exercise in a list."""
    return f"{exercise.number}. {exercise.title}"


def n_unknown(students: Sequence[Student], exercises: Sequence[Exercise]) -> int:
    """How many exercises the files hold that are not among some."""
    begun_ids = {name for student in students for name in student.progress.attempts}
    return len(begun_ids - {one.id for one in exercises})


COLUMNS = (
    *("student", "exercise", "status", "predicted", "checks", "hints"),
    *("numbers", "state", "time", "version"),
)


def as_csv(students: Sequence[Student], exercises: Sequence[Exercise]) -> str:
    """One row for each student and exercise, as a file for sheets."""
    file = io.StringIO()
    writer = csv.writer(file)
    writer.writerow(COLUMNS)
    for student in students:
        for one in begun([student], exercises):
            writer.writerow([cell(value) for value in _row(student, one)])
    return file.getvalue()


def _row(student: Student, exercise: Exercise) -> list[str | int]:
    attempt = student.progress.attempts[exercise.id]
    numbers = student.judged[exercise.id].numbers
    last = attempt.tried[max(attempt.tried)] if attempt.tried else None
    return [
        student.name,
        exercise.id,
        status(student, exercise),
        attempt.first or "",
        attempt.n_checks,
        attempt.n_hints,
        "; ".join(f"{name} {value:.4g}" for name, value in numbers.items()),
        last.link if last else "",
        last.time if last else "",
        student.progress.version,
    ]


def cell(value: str | int) -> str | int:
    """A value of a table that a sheet may open: what it would work out stays text."""
    is_formula = isinstance(value, str) and value.startswith(FORMULA)
    return f"'{value}" if is_formula else value

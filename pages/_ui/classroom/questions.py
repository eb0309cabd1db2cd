"""The questions that the app asks before something is shown: one list of all of them.

A class can vote on each, and what was predicted of it is in the files handed in.
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from occsim.exercises import Exercise
from pages._ui.course import COURSE, Lesson, lessons_of
from pages._ui.exercise_pages import shown_option
from pages._ui.progress import Progress


@dataclass(frozen=True, slots=True)
class Asked:
    """One question.

    Parameters
    ----------
    title : str
        Where it is asked.
    text : str
        The question.
    options : mapping of str to str
        Its answers as they are shown, by the name that is stored.
    lesson : int or None
        The lesson that asks it.
    exercise : str
        The id of the exercise that does, if no lesson.
    """

    title: str
    text: str
    options: Mapping[str, str]
    lesson: int | None = None
    exercise: str = ""

    def answer(self, progress: Progress) -> str | None:
        """What was predicted in a progress; None if nothing that is an answer."""
        if self.lesson is not None:
            given = lessons_of(progress.lessons).get(self.lesson)
        else:
            attempt = progress.attempts.get(self.exercise)
            given = attempt.first if attempt else None
        return given if given in self.options else None


def questions(exercises: Iterable[Exercise]) -> tuple[Asked, ...]:
    """Every question: of the home page, of the lessons, of some exercises."""
    return (
        *(_of_lesson(lesson) for lesson in COURSE),
        *(_of_exercise(one) for one in exercises if one.prediction is not None),
    )


def _of_lesson(lesson: Lesson) -> Asked:
    where = f"Lesson {lesson.number}" if lesson.number else "Home"
    return Asked(
        f"{where}: {lesson.title}", lesson.asked, lesson.options, lesson.number
    )


def _of_exercise(exercise: Exercise) -> Asked:
    asked = exercise.prediction
    return Asked(
        f"Exercise {exercise.number}: {exercise.title}",
        " ".join(asked.text.split()),
        {option: shown_option(option) for option in asked.options},
        exercise=exercise.id,
    )


def counts(asked: Asked, handed_in: Iterable[Progress]) -> dict[str, int]:
    """How often each answer was given; those that nobody gave as well."""
    found = Counter(asked.answer(progress) for progress in handed_in)
    return {option: found[option] for option in asked.options}

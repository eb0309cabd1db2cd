"""A prediction: asked first, stored, and shown again beside what came out."""

import streamlit as st

from occsim import OccsimError
from pages._ui import state, words
from pages._ui.course import Lesson
from pages._ui.outcomes import OUTCOMES, Outcome, filled


def ask(lesson: Lesson) -> None:
    """Ask for the prediction; once it is made, show it beside the result.

    It is not judged: whether the two agree is said, and nothing else.
    """
    said = state.prediction(lesson.number)
    with st.container(key=f"predict_{lesson.number}"):
        if said is None:
            _question(lesson)
        else:
            st.markdown(words.maths(_result(lesson, said)))


def _question(lesson: Lesson) -> None:
    try:
        question = filled(lesson.number, lesson.predict)
    except OccsimError as error:
        st.error(words.plain(str(error)))
        return
    st.markdown(f"**Predict.** {words.maths(question)}")
    with st.container(horizontal=True):
        for answer, label in lesson.options.items():
            st.button(
                words.maths(label),
                key=f"answer {lesson.number} {answer}",
                on_click=state.keep_prediction,
                args=(lesson.number, answer),
            )


def _result(lesson: Lesson, said: str) -> str:
    try:
        outcome = OUTCOMES[lesson.number]()
    except OccsimError as error:
        outcome = Outcome(words.plain(str(error)))
    text = f"**You predicted:** {lesson.options[said]}. **Result:** {outcome.text}"
    if not outcome.answer:
        return text
    agree = "agree" if outcome.answer == said else "do not agree"
    return f"{text} Prediction and result {agree}."

"""Collect: the files of a class, judged anew. Nothing of them is kept."""

import streamlit as st

from occsim import OccsimError
from pages._ui import shell, state, words
from pages._ui.classroom import handed_in
from pages._ui.classroom.handed_in import MAX_FILES, Student
from pages._ui.exercise_pages import shown_option

MAX_FILE_MB = 1


def section() -> None:
    """Draw the section: the files, the table, the predictions, the CSV."""
    st.markdown(
        "Students download *Progress as a file* on the page Exercises and send it to "
        "you. Drop the files here: every result is judged anew from the state in the "
        "file, so that an edited one shows. Nothing is kept on this server."
    )
    files = st.file_uploader(
        "Progress files",
        type="json",
        accept_multiple_files=True,
        max_upload_size=MAX_FILE_MB,
        key="class_collected",
    )
    if len(files) > MAX_FILES:
        shell.say_error(f"At most {MAX_FILES} files are judged at once.")
    students = [
        student
        for file in files[:MAX_FILES]
        if (student := _student(file.name, file.getvalue())) is not None
    ]
    if students:
        _table(students)
        _predictions(students)


def _student(name: str, data: bytes) -> Student | None:
    try:
        progress = handed_in.read(data, name)
    except OccsimError as error:
        shell.say_error(str(error))
        return None
    return handed_in.student_of(progress, name, state.exercises())


def _table(students: list[Student]) -> None:
    found = handed_in.begun(students, state.exercises())
    rows = [
        {"student": one.name}
        | {f"{e.number}. {e.title}": handed_in.status(one, e) for e in found}
        for one in students
    ]
    st.dataframe(rows, hide_index=True, width="stretch")
    differ = sum(
        not judged.is_as_claimed for one in students for judged in one.judged.values()
    )
    if differ:
        what = "1 result differs" if differ == 1 else f"{differ} results differ"
        st.warning(
            f"{what} from what the state in the file gives: the file was edited, or "
            "comes from another version of this program."
        )
    st.download_button(
        "Table as CSV",
        handed_in.as_csv(students, found),
        file_name="class.csv",
        mime="text/csv",
        on_click="ignore",
    )


def _predictions(students: list[Student]) -> None:
    asked = [
        one
        for one in handed_in.begun(students, state.exercises())
        if one.prediction is not None
    ]
    if not asked:
        return
    st.header("What was predicted", anchor=False)
    titles = {one.id: f"{one.number}. {one.title}" for one in asked}
    chosen = st.selectbox(
        "Exercise", list(titles), format_func=titles.__getitem__, width=480
    )
    exercise = next(one for one in asked if one.id == chosen)
    st.markdown(words.prose(exercise.prediction.text.strip()))
    found = handed_in.predictions(students, exercise)
    for option, count in found.items():
        label = words.prose(shown_option(option))
        st.progress(count / max(1, sum(found.values())), text=f"{label}: {count}")

"""Collect: the files of a class, judged again. Nothing of them is kept."""

from collections.abc import Sequence

import streamlit as st

from occsim import OccsimError
from occsim.exercises import Exercise
from pages._ui import shell, words
from pages._ui.classroom import handed_in, own_files
from pages._ui.classroom.handed_in import MAX_FILES, Student
from pages._ui.classroom.questions import counts, questions

MAX_FILE_MB = 1


def section() -> None:
    """Draw the section: the files, the table, the predictions, the CSV."""
    st.markdown(
        "Students download *Progress as a file* on the page Exercises and send it to "
        "you. Upload the files here. Every result is judged again from the state in "
        "the file, so an edited result is recognised. The state has every setting, "
        "also those that were hidden. Nothing is kept on this server."
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
    known = own_files.known()
    students = [
        student
        for file in files[:MAX_FILES]
        if (student := _student(file.name, file.getvalue(), known)) is not None
    ]
    if students:
        found = handed_in.begun(students, known)
        _table(students, found)
        _say_unknown(handed_in.n_unknown(students, known))
        _predictions(students, known)


def _say_unknown(n: int) -> None:
    if n:
        what = "1 exercise" if n == 1 else f"{n} exercises"
        st.warning(
            f"The files also hold {what} that this page does not know. Give your own "
            "under Prepare, or open the link of the class first."
        )


def _student(name: str, data: bytes, known: Sequence[Exercise]) -> Student | None:
    try:
        progress = handed_in.read(data, name)
    except OccsimError as error:
        shell.say_error(str(error))
        return None
    return handed_in.student_of(progress, name, known)


def _table(students: list[Student], found: Sequence[Exercise]) -> None:
    names = handed_in.column_names(found)
    # The table's own button writes it as CSV.
    rows = [
        {"student": handed_in.cell(one.name)}
        | {names[e.id]: handed_in.status(one, e) for e in found}
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


def _predictions(students: list[Student], known: Sequence[Exercise]) -> None:
    files = [one.progress for one in students]
    asked = {
        one.title: one
        for one in questions(known)
        if any(one.answer(file) is not None for file in files)
    }
    if not asked:
        return
    st.header("What was predicted", anchor=False)
    chosen = asked[st.selectbox("Question", list(asked), width=480)]
    st.markdown(words.prose(chosen.text))
    found = counts(chosen, files)
    for option, count in found.items():
        label = words.prose(chosen.options[option])
        st.progress(count / max(1, sum(found.values())), text=f"{label}: {count}")

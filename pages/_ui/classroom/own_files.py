"""A teacher's own exercises: taken as files, proven at once, known on all sections."""

from typing import Any

import streamlit as st

from occsim import OccsimError
from occsim.exercises import Exercise
from pages._ui import compute, shell, state, words
from pages._ui.classroom import handed_in
from pages._ui.classroom.prepared import MAX_EXERCISES

MAX_FILE_MB = 1
GIVEN = "class_exercises"


def section() -> None:
    """Take files of exercises; say of each whether it is proven."""
    with st.expander("Exercises of your own"):
        st.markdown(
            "TOML files, as those in `assets/exercises`. Each is proven at once: not "
            "solved at its set-up, solved at its witness. They travel with the link."
        )
        given = st.file_uploader(
            "Files of exercises",
            type="toml",
            accept_multiple_files=True,
            max_upload_size=MAX_FILE_MB,
            **_bound_files(),
        )
        if len(given) > MAX_EXERCISES:
            shell.say_error(f"At most {MAX_EXERCISES} files are taken.")
        good, refused = _proven()
        for refusal in refused:
            shell.say_error(refusal)
        for one in compute.own_exercises(good):
            st.markdown(f"Proven: {words.plain(handed_in.title(one))}")


def texts() -> tuple[str, ...]:
    """The files that are proven, in their order, and those of the class after them."""
    prepared = state.class_now()
    return *_proven()[0], *(prepared.exercises if prepared else ())


def known() -> tuple[Exercise, ...]:
    """The teacher's own exercises, those of the class, and ours under other ids."""
    return compute.exercises_with(texts())


def _bound_files() -> dict[str, Any]:
    key = "class_files"
    return {"key": key, "on_change": lambda: _take_files(key)}


def _take_files(key: str) -> None:
    files = state.value(key) or []
    given = [
        (file.name, file.getvalue().decode("utf-8", "replace"))
        for file in files[:MAX_EXERCISES]
    ]
    state.set_view(GIVEN, tuple(given))


def _proven() -> tuple[tuple[str, ...], list[str]]:
    """The files that are proven, and why the others are not taken."""
    good: dict[str, str] = {}
    refused = []
    for name, text in state.view(GIVEN, ()):
        try:
            found = compute.proven(text, name)
        except OccsimError as error:
            refused.append(str(error))
            continue
        if found.id in good:
            refused.append(f"{name}: another file has the id {found.id!r} as well")
        good.setdefault(found.id, text)
    return tuple(good.values()), refused

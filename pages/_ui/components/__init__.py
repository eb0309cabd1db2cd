"""A Streamlit component made of the files of one folder: html, css and scripts."""

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

import streamlit as st


def component(
    name: str, folder: Path, scripts: tuple[str, ...]
) -> Callable[..., Mapping[str, object]]:
    """Return the component `name`; its html and css are named after the folder.

    Registered on each run: a registry lives as long as its server, which in tests is
    shorter than this module. The same definition again costs and says nothing.
    """
    return st.components.v2.component(name, **_sources(folder, scripts))


def keep_state() -> None:
    """Do nothing: Streamlit keeps a state value only if there is a callback for it."""


@cache
def _sources(folder: Path, scripts: tuple[str, ...]) -> dict[str, str]:
    """The texts of a component; the scripts joined in order into one module."""

    def text(name: str) -> str:
        return (folder / name).read_text(encoding="utf-8")

    return {
        "html": text(f"{folder.name}.html"),
        "css": text(f"{folder.name}.css"),
        "js": "\n".join(text(name) for name in scripts),
    }

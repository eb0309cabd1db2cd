"""Streamlit components built from files: html, css and scripts, shared ones first."""

import json
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

import streamlit as st

SHARED = Path(__file__).parent / "shared"
SAVING = ("saving/png.js", "saving/figure.js", "saving/save.js")
"""Scripts of components that save what they show."""
SHARED_SCRIPTS = ("bytes.js", "colours.js", "dom.js", "logodds.js", "text.js")


def component(
    name: str, folder: Path, scripts: tuple[str, ...]
) -> Callable[..., Mapping[str, object]]:
    """Return the component `name`; its html is named after the folder.

    Registered on each run: a registry lives as long as its server, which in tests is
    shorter than this module. Registering the same definition again has no effect.
    """
    return st.components.v2.component(name, **_sources(folder, scripts))


def packed(header: Mapping[str, object], *payloads: bytes) -> bytes:
    """Return header and payloads as one string of bytes, the one way to send bytes.

    Four bytes with the length of the header (little-endian), the header (JSON, UTF-8,
    with the payloads' sizes), the payloads. ``readPacked`` in ``shared/bytes.js``
    unpacks them.
    """
    sized = {**header, "sizes": [len(payload) for payload in payloads]}
    encoded = json.dumps(sized, separators=(",", ":"), allow_nan=False).encode()
    return b"".join((len(encoded).to_bytes(4, "little"), encoded, *payloads))


def keep_state() -> None:
    """Do nothing: Streamlit keeps a state value only if there is a callback for it."""


def script_paths(folder: Path, scripts: tuple[str, ...]) -> tuple[Path, ...]:
    """The scripts of a component in the order in which they are joined.

    Those of another folder are named with it.
    """
    shared = (SHARED / name for name in SHARED_SCRIPTS)
    own = (SHARED.parent / one if "/" in one else folder / one for one in scripts)
    return (*shared, *own)


@cache
def _sources(folder: Path, scripts: tuple[str, ...]) -> dict[str, str]:
    """The texts of a component; the scripts joined into one module."""

    def text(*paths: Path) -> str:
        return "\n".join(path.read_text(encoding="utf-8") for path in paths)

    paths = script_paths(folder, scripts)
    folders = dict.fromkeys((SHARED, *(path.parent for path in paths)))
    styles = (path for one in folders for path in sorted(one.glob("*.css")))
    return {
        "html": text(folder / f"{folder.name}.html"),
        "css": text(*styles),
        "js": text(*paths),
    }

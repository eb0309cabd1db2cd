"""Pages of the site that are not in its folder: MkDocs calls the functions ``on_...``.

The reference has one page for each room of the library, with all that `occsim` exports
from it, so that a new name needs no line here. The model, the decisions and the guides
for teachers are the files beside this one. Each how-to has a notebook made from it. A
picture that a how-to shows is the one that its own code saves.
"""

import ast
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
HOW_TOS = HERE / "site" / "how-to"

# Pages in the order in which one meets them, and the rooms on each; others follow.
PAGES = {
    "Buildings and runs": ("building", "run", "samples", "corrections"),
    "Drawings and walls": ("imaging", "walls", "flaws"),
    "World and trajectory": ("world", "grid", "trajectory", "tour", "io"),
    "Sensor and readings": ("sensor", "evidence", "evidence_log", "reading"),
    "Scans": ("scan", "registration"),
    "Priors and maps": ("prior", "mapping", "logodds"),
    "Scores": ("metrics",),
    "Surfaces, fronts, best pairs": ("priors",),
    "Errors": ("errors",),
}
# Modules that are used under their own name.
MODULES = {
    "occsim.building": ("building_from_drawing",),
    "occsim.io.ros_map": ("RosMap", "MapMode", "load", "dump", "save"),
    "occsim.io.carmen": ("load", "CarmenLog", "PoseSource"),
    "occsim.io.bags": ("load", "BagLog", "PoseSource"),
    "occsim.io.timed": ("load", "TimedScans"),
    "occsim.io.scans": ("metric_scans", "MetricScans", "dump", "load"),
    "occsim.io.metric": ("MetricFrame", "poses_to_image", "poses_to_metric"),
    "occsim.io.trajectories": ("read_trajectory_table", "TrajectoryTable"),
    "occsim.io.project": (
        "Project",
        "RobotData",
        "dump_project",
        "load_project",
        "ProjectError",
    ),
    "occsim.io.prior_map": ("prior_png", "prior_npy", "prior_csv", "prior_json"),
    "occsim.study": (
        "find_drawings",
        "DrawingSource",
        "StudySettings",
        "run_case",
        "StudyCase",
        "Machines",
    ),
}


def exported() -> dict[str, list[str]]:
    """Return what `occsim` exports, by the title of its page."""
    title_of = {room: title for title, rooms in PAGES.items() for room in rooms}
    pages: dict[str, list[str]] = {title: [] for title in PAGES}
    source = (ROOT / "occsim" / "__init__.py").read_text("utf-8")
    for node in ast.parse(source).body:
        room = getattr(node, "module", "").partition(".")[2].partition(".")[0]
        if isinstance(node, ast.ImportFrom) and not room.startswith("_"):
            title = title_of.get(room, room.capitalize())
            pages.setdefault(title, []).extend(alias.name for alias in node.names)
    return pages


def reference() -> dict[str, str]:
    """Return the pages of the reference, Markdown by title."""
    named = [(title, "occsim", names) for title, names in exported().items()]
    named += [(module, module, names) for module, names in MODULES.items()]
    return {
        title: f"# {title}\n\nImport from `{module}`.\n\n"
        + "".join(f"::: {module}.{name}\n\n" for name in sorted(names, key=str.lower))
        for title, module, names in named
    }


def cells(how_to: str) -> list[dict[str, Any]]:
    """Return the cells of a notebook: text, and each block of Python.

    A block marked ``text`` is what the code before it prints.
    """
    found: list[dict[str, Any]] = []
    for part in re.split(r"^(```\w+\n.*?^```)$", how_to, flags=re.S | re.M):
        language, _, body = part.removesuffix("```").partition("\n")
        if language == "```python":
            code = {"execution_count": None, "outputs": []}
            found.append({"cell_type": "code", **code, "source": body.strip()})
        elif language == "```text":
            printed = {"output_type": "stream", "name": "stdout", "text": body}
            found[-1]["outputs"].append(printed)
        elif part.strip():
            found.append({"cell_type": "markdown", "source": part.strip()})
    for place, cell in enumerate(found):
        cell |= {"id": f"cell-{place}", "metadata": {}}
    return found


def notebook(how_to: str) -> str:
    """Return a how-to as a Jupyter notebook, format 4.5."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    content = {
        "cells": cells(how_to),
        "metadata": {"kernelspec": kernel},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(content, indent=1)


def pictures(how_to: str) -> dict[str, bytes]:
    """Return the pictures that the code of a how-to saves, by name.

    The code of a how-to that shows none is not run.
    """
    shown = re.findall(r"!\[[^]]*\]\(([\w.]+\.svg)\)", how_to)
    if not shown:
        return {}
    code = [one["source"] for one in cells(how_to) if one["cell_type"] == "code"]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [sys.executable, "-c", "\n\n".join(code)],
            cwd=folder,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            stdout=subprocess.DEVNULL,
            check=True,
        )
        return {name: (Path(folder) / name).read_bytes() for name in shown}


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Complete the navigation."""
    how_tos = sorted(path.name for path in HOW_TOS.glob("*.md"))
    guides = sorted(HERE.glob("teaching/*.md"))
    config.nav = [
        {"Home": "index.md"},
        {"How-to": [f"how-to/{name}" for name in how_tos]},
        {"Reference": [{title: _page(title)} for title in reference()]},
        {"Model": ["model.md", "decisions.md"]},
    ]
    if guides:
        config.nav.append({"Teaching": [f"teaching/{path.name}" for path in guides]})
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are made, and those beside the site's folder."""
    for title, text in reference().items():
        files.append(File.generated(config, _page(title), content=text))
    for path in HOW_TOS.glob("*.md"):
        name = f"how-to/{path.stem}.ipynb"
        content = notebook(path.read_text("utf-8"))
        files.append(File.generated(config, name, content=content))
        for name, picture in pictures(path.read_text("utf-8")).items():
            files.append(File.generated(config, f"how-to/{name}", content=picture))
    beside = [*HERE.glob("*.md"), *HERE.glob("teaching/**/*.*")]
    for path in beside:
        name = path.relative_to(HERE).as_posix()
        files.append(File.generated(config, name, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Name a how-to's notebook below its text."""
    path = Path(page.file.src_uri)
    if path.parent.name != "how-to":
        return markdown
    return f"{markdown}\n\nThis page [as a notebook]({path.stem}.ipynb).\n"


def _page(title: str) -> str:
    return f"reference/{re.sub(r'[^a-z_]+', '-', title.lower())}.md"

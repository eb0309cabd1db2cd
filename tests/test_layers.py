"""Imports run one way, and each layer imports only what it may."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# A module may import only from lines above its own (rows of one line are peers and
# do not import each other).
ORDER = [
    {"_extras", "_types", "_version", "errors"},
    {"_archives", "_bounds", "_files", "_plain", "logodds"},
    {"_npz"},
    {"geometry"},
    {"grid"},
    {"imaging"},
    {"walls"},
    {"flaws"},
    {"world"},
    {"corrections"},
    {"prior"},
    {"trajectory"},
    {"sensor"},
    {"rays", "evidence_log"},
    {"evidence"},
    {"reading"},
    {"tour"},
    {"mapping"},
    {"scan"},
    {"registration"},
    {"metrics"},
    {"priors"},
    {"building"},
    {"run"},
    {"io"},
    {"samples"},
    {"study"},
    {"exercises"},
    {"cli"},
    {"__init__"},
    {"__main__"},
]
RANK = {name: rank for rank, names in enumerate(ORDER) for name in names}


def imported_modules(path: Path) -> set[str]:
    """Every module that a file imports, at any depth of the code."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def python_files(folder: str) -> list[Path]:
    return sorted((ROOT / folder).rglob("*.py"))


def layer(path: Path) -> str:
    """The row of the table that a file of occsim belongs to."""
    inside = path.relative_to(ROOT / "occsim")
    return inside.parts[0].removesuffix(".py")


@pytest.mark.parametrize("path", python_files("occsim"), ids=lambda p: p.stem)
def test_occsim_imports_only_from_layers_above(path):
    own = layer(path)
    assert own in RANK, f"{own} has no row in the table of layers"
    for module in imported_modules(path):
        parts = module.split(".")
        if parts[0] != "occsim" or len(parts) == 1:
            continue
        other = parts[1]
        if other in RANK and other != own:
            assert RANK[other] < RANK[own], f"{own} imports {other}"


@pytest.mark.parametrize("path", python_files("occsim"), ids=lambda p: p.stem)
def test_occsim_knows_nothing_of_the_page(path):
    top_level = {module.split(".")[0] for module in imported_modules(path)}
    assert not top_level & {"streamlit", "plotly", "pages"}


@pytest.mark.parametrize("path", python_files("occsim"), ids=lambda p: p.stem)
def test_occsim_prints_only_on_its_command_line(path):
    if layer(path) == "cli":
        return
    calls = [
        node.func.id
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    ]
    assert "print" not in calls


@pytest.mark.parametrize(
    "path", [ROOT / "app.py", *python_files("pages")], ids=lambda p: p.stem
)
def test_pages_do_no_arithmetic_on_arrays(path):
    top_level = {module.split(".")[0] for module in imported_modules(path)}
    assert not top_level & {"numpy", "cv2", "scipy", "pandas"}


@pytest.mark.parametrize(
    "path", python_files("pages/_ui/settings"), ids=lambda p: p.stem
)
def test_settings_are_declared_without_streamlit(path):
    assert "streamlit" not in {m.split(".")[0] for m in imported_modules(path)}


@pytest.mark.parametrize(
    "path", [ROOT / "app.py", *python_files("pages")], ids=lambda p: p.stem
)
def test_session_state_is_touched_in_one_place(path):
    if path.parent == ROOT / "pages" / "_ui" / "state":
        return
    assert "session_state" not in path.read_text(encoding="utf-8")

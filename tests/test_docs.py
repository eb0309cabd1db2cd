"""The site builds without a warning and offline, and its how-tos run as notebooks."""

import contextlib
import doctest
import io
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import occsim

pytest.importorskip("mkdocs", reason="mkdocs builds the site")

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "assets" / "docs"
HOW_TOS = sorted(path.stem for path in DOCS.glob("site/how-to/*.md"))


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict"]
    done = subprocess.run(
        [*command, "-f", str(DOCS / "mkdocs.yml"), "-d", str(folder)],
        # The theme announces its successor on every run.
        env=os.environ | {"NO_MKDOCS_2_WARNING": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr
    return folder


def pages(site):
    return {path: path.read_text("utf-8") for path in site.rglob("*.html")}


def test_the_reference_has_every_public_name(site):
    """As a heading of its own, which links can name."""
    reference = "".join(
        path.read_text("utf-8") for path in (site / "reference").glob("*.html")
    )
    missing = [n for n in occsim.__all__ if f'id="occsim.{n}"' not in reference]
    assert missing == []


def test_every_entry_of_the_reference_has_an_example(site):
    for path in (site / "reference").glob("*.html"):
        entries = re.split(r'<h2 id="(occsim\.[\w.]+)"', path.read_text("utf-8"))[1:]
        assert entries, path
        for name, text in zip(entries[::2], entries[1::2], strict=True):
            assert "&gt;&gt;&gt; " in text, name


def test_the_model_the_decisions_and_the_guides_are_pages(site):
    beside = [*DOCS.glob("*.md"), *DOCS.glob("teaching/*.md")]
    names = [path.relative_to(DOCS).with_suffix(".html") for path in beside]
    assert Path("model.html") in names
    assert [str(name) for name in names if not (site / name).is_file()] == []


def test_nothing_is_loaded_from_elsewhere(site):
    loads = re.compile(r"<(?:script|img|link|iframe)\b[^>]*?(?:src|href)=\"?(\w+:)?//")
    assert [path.name for path, text in pages(site).items() if loads.search(text)] == []


def test_there_are_five_how_tos_and_each_names_its_notebook(site):
    assert len(HOW_TOS) >= 5
    for name in HOW_TOS:
        page = (site / "how-to" / f"{name}.html").read_text("utf-8")
        assert f'href="{name}.ipynb"' in page


def test_the_convergence_of_beams_is_plotted_by_the_page_that_shows_it(site):
    """The line falls, as the distances do that the page's code computes."""
    page = (site / "how-to" / "3_own_scans.html").read_text("utf-8")
    assert re.search(r'<img\b[^>]*src="beams.svg"', page)
    svg = (site / "how-to" / "beams.svg").read_text("utf-8")
    lines = re.findall(r'<path d="(M [^"]*?)" clip-path', svg)
    points = [re.findall(r"[ML] (-?[\d.]+) (-?[\d.]+)", line) for line in lines]
    (heights,) = ([float(y) for _, y in one] for one in points if len(one) == 4)
    assert heights == sorted(heights)  # y of SVG points down
    assert heights[-1] - heights[0] > 50


@pytest.mark.filterwarnings("default")  # of distributed, as its cluster closes
@pytest.mark.parametrize("name", HOW_TOS)
def test_the_notebook_of_a_how_to_runs_and_prints_what_the_page_says(
    name, site, tmp_path, monkeypatch
):
    pytest.importorskip("distributed")
    notebook = json.loads((site / "how-to" / f"{name}.ipynb").read_text("utf-8"))
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    same = doctest.OutputChecker().check_output
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 4
    for cell in cells:
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(compile(cell["source"], name, "exec"), names)
        said = "".join(output["text"] for output in cell["outputs"])
        assert same(said, printed.getvalue(), doctest.ELLIPSIS), printed.getvalue()

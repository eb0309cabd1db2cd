"""The wheel, installed outside the checkout, holds all that the library needs."""

import os
import re
import subprocess
import sys
import sysconfig
import tomllib
import zipfile
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

import occsim
from tests.library_requirements import requirements
from tests.test_layers import imported_modules, python_files
from tests.test_public_names import readme_examples

pytest.importorskip("hatchling", reason="hatchling builds the wheel")

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))[
    "project"
]


def pip(*arguments):
    offline = ("--disable-pip-version-check", "--no-deps", "--no-index", "--quiet")
    subprocess.run([sys.executable, "-m", "pip", *arguments, *offline], check=True)


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dist")
    pip("wheel", "--no-build-isolation", "--wheel-dir", str(folder), str(ROOT))
    (built,) = folder.iterdir()
    return built


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    site = tmp_path_factory.mktemp("site")
    pip("install", "--target", str(site), str(wheel))
    return site


@pytest.fixture
def run(installed, tmp_path):
    """Run Python in an empty folder, where only the wheel and its needs can be found.

    ``-S`` leaves out what an editable install adds to the path.
    """
    packages = [installed, sysconfig.get_path("purelib"), sysconfig.get_path("platlib")]
    path = os.pathsep.join(map(str, packages))
    environment = os.environ | {"PYTHONPATH": path}

    def call(*arguments):
        return subprocess.run(
            [sys.executable, "-S", *map(str, arguments)],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        )

    return call


def test_the_wheel_holds_the_whole_package_and_nothing_else(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = {n for n in archive.namelist() if ".dist-info/" not in n}
    here = (path for path in (ROOT / "occsim").rglob("*") if path.is_file())
    expected = {str(path.relative_to(ROOT).as_posix()) for path in here}
    assert names == {name for name in expected if "__pycache__" not in name}
    assert {"occsim/py.typed", "occsim/samples/e_truth.png"} < names


def test_the_readme_examples_run_from_the_wheel_word_for_word(run, installed):
    code = "\n".join((*readme_examples(), "import occsim", "print(occsim.__file__)"))
    *printed, where = run("-c", code).stdout.splitlines()
    assert Path(where).is_relative_to(installed)
    scores = re.findall(r"\d\.\d+", " ".join(printed))
    assert scores
    assert all(0.0 < float(score) <= 1.0 for score in scores)


def test_the_command_of_the_wheel_studies_a_sample(run, installed, tmp_path):
    command = installed / "bin" / "occsim"
    assert run(command, "--version").stdout == f"occsim {occsim.__version__}\n"
    result = run(command, "study", "a", "--cells", "10", "--out", tmp_path / "x")
    assert result.stderr == "[1/1] a, 10 px: computed\n"
    written = {path.name for path in (tmp_path / "x").iterdir()}
    assert {"maxima.csv", "maps_10px.png", "fronts_10px.png"} < written


def test_the_core_needs_neither_matplotlib_nor_pymoo_nor_the_app(run, tmp_path):
    """The study included: it says in one sentence how to get its figures."""
    absent = ("matplotlib", "pymoo", "distributed", "streamlit", "plotly", "pandas")
    code = (
        f"import sys; sys.modules.update(dict.fromkeys({absent}))\n"
        "import occsim.cli; sys.exit(occsim.cli.main(sys.argv[1:]))"
    )
    result = run("-c", code, "study", "d", "--cells", "50", "--out", tmp_path / "x")
    assert "Written to" in result.stdout
    assert result.stderr == (
        "[1/1] d, 50 px: computed\n"
        "occsim: no figures: a figure needs matplotlib: pip install 'occsim[study]'\n"
    )


def test_the_search_says_how_to_install_pymoo(monkeypatch):
    monkeypatch.setitem(sys.modules, "pymoo.algorithms.moo.nsga2", None)
    sentence = r"NSGA-II needs pymoo: pip install 'occsim\[study\]'"
    with pytest.raises(ImportError, match=sentence):
        occsim.nsga2_front(lambda pairs: pairs, seed=1)


def listed(name):
    """The requirements of a file, those that it reads from another left out."""
    lines = (ROOT / name).read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and line[0] not in "#-"]


def test_requirements_files_are_the_lists_of_pyproject():
    extras = PROJECT["optional-dependencies"]
    own = {
        extra: [one for one in needed if not one.startswith("occsim[")]
        for extra, needed in extras.items()
    }
    app = PROJECT["dependencies"] + own["study"] + own["app"]
    assert listed("requirements.txt") == sorted(app)
    assert listed("requirements-dev.txt") == sorted(own["dev"])


@pytest.mark.parametrize(
    ("folder", "files"),
    [
        ("occsim", ["requirements.txt", "requirements-dev.txt"]),
        ("pages", ["requirements.txt"]),
        ("tests", ["requirements.txt", "requirements-dev.txt"]),
    ],
)
def test_everything_imported_is_asked_for_by_name(folder, files):
    """Not left to come along with another package, which may drop it."""
    imported = set().union(*map(imported_modules, python_files(folder)))
    modules = {name.partition(".")[0] for name in imported}
    modules -= {*sys.stdlib_module_names, "occsim", "pages", "tests", "assets"}
    named = {re.split("[>=]", one)[0] for file in files for one in listed(file)}
    found = packages_distributions()
    assert [m for m in sorted(modules) if not named & set(found.get(m, ()))] == []


def test_the_lock_pins_everything_that_the_app_asks_for():
    text = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    pinned = set(re.findall(r"^([a-z0-9-]+)==", text, re.MULTILINE))
    assert {re.split("[>=]", one)[0] for one in listed("requirements.txt")} <= pinned
    entries = re.split(r"\n(?=\S)", text.split("\n", 2)[2])
    assert all("--hash=sha256:" in entry for entry in entries if entry.strip())


def test_the_oldest_versions_are_the_lower_bounds():
    """Each requirement of core and study, ``a>=1.2,<3``, becomes ``a==1.2``."""
    ranges = PROJECT["dependencies"] + PROJECT["optional-dependencies"]["study"]
    floors = [one.partition(",")[0].replace(">=", "==") for one in ranges]
    assert requirements("oldest")[: len(floors)] == floors


def test_the_citation_has_the_version_of_the_package():
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {occsim.__version__}\n" in text

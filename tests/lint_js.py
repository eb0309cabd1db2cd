"""Lint the components' scripts: python -m tests.lint_js.

The scripts of a component are one module for the browser, so they are linted as one:
that finds names that nothing defines and functions that nothing calls.
"""

import re
import subprocess
import sys
import tempfile
from collections import Counter
from importlib import import_module
from pathlib import Path

from pages._ui.components import SHARED, script_paths

ROOT = Path(__file__).resolve().parents[1]
CONFIG = Path(__file__).parent / "node" / "oxlint.json"
COMPLAINT = re.compile(r"^.*?:(\d+):(\d+): (.*)$")


def main() -> int:
    found: Counter[tuple[Path, int, str]] = Counter()
    folders = sorted(SHARED.parent.glob("*/__init__.py"))
    for folder in (path.parent for path in folders):
        component = import_module(f"pages._ui.components.{folder.name}")
        found.update(complaints(script_paths(folder, component.SCRIPTS)))
    # Each shared function must be called by some component, not by each of them.
    wrong = [
        (path, line, words)
        for (path, line, words), times in sorted(found.items())
        if path.parent != SHARED or "unused" not in words or times == len(folders)
    ]
    for path, line, words in wrong:
        print(f"{path.relative_to(ROOT)}:{line}: {words}")
    print(f"{len(wrong)} complaints about the scripts of {len(folders)} components")
    return 1 if wrong else 0


def complaints(paths: tuple[Path, ...]) -> list[tuple[Path, int, str]]:
    """The linter's findings in these scripts, joined: script, line in it, message."""
    lines = [
        (path, number, text)
        for path in paths
        for number, text in enumerate(path.read_text().splitlines(), start=1)
    ]
    with tempfile.TemporaryDirectory() as scratch:
        joined = Path(scratch) / "joined.js"
        joined.write_text("\n".join(text for _, _, text in lines))
        said = oxlint(joined)
    places = (COMPLAINT.match(line) for line in said.splitlines())
    return [(*lines[int(at[1]) - 1][:2], at[3]) for at in places if at]


def oxlint(path: Path) -> str:
    command = [Path(sys.executable).parent / "oxlint", "--format", "unix"]
    done = subprocess.run(
        [*command, "--config", CONFIG, path],
        capture_output=True,
        text=True,
        check=False,
    )
    # A linter that failed to run also reports no findings.
    if done.returncode not in (0, 1) or done.stderr:
        raise RuntimeError(f"oxlint did not run: {done.stdout}{done.stderr}")
    return done.stdout


if __name__ == "__main__":
    sys.exit(main())
